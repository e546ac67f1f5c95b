"""What accuracy costs: error against time a launch, for every way to d_norm, and what to use."""

import math
import os
import textwrap
from collections.abc import Iterable, Mapping
from typing import Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from hodograph.bench import measurement, ways
from hodograph.bench.measurement import DIGITS, DOMAINS, Domain, Measurement, Sizes, log
from hodograph.report import clock, folder, style, tables
from hodograph.report.style import GREY, TEXT

COMMAND = "hodograph bench work-precision"
FILES = ("work_precision.png", "work_precision.pdf", "work_precision.csv")
ALIKE = 1.1  # times no further apart than this are taken to be the same

SIZES = Sizes()


def measure(domains: tuple[Domain, ...] = DOMAINS, sizes: Sizes = SIZES) -> list[Measurement]:
    """Time every way on each set of launches, and find its errors: by set, then by way."""
    with clock.one_core():
        return [
            point
            for where in domains
            for point in measurement.measure([(where, way) for way in ways.ways(sizes)], sizes)
        ]


# --- what to use --------------------------------------------------------------------------


def cheapest(points: Iterable[Measurement], tolerance: float) -> Measurement | None:
    """The quickest general way whose largest error was no more than `tolerance`; None without one.

    The dial counts only where its promise is within `tolerance`.  Of ways within a tenth of the
    quickest, those that promise as much come first, then the one with the largest error: the
    loosest setting.
    """
    good = [
        point
        for point in points
        if point.general
        and (point.promise if point.family == ways.DIAL else point.largest) <= tolerance
    ]
    least = min((point.microseconds for point in good), default=math.nan)
    near = [point for point in good if point.microseconds <= ALIKE * least]
    return max(near, key=lambda point: (point.promise <= tolerance, point.largest), default=None)


def call(point: Measurement) -> str:
    """What to call, in words."""
    if point.family in (ways.TIER, ways.DIAL):
        return f"d_norm(..., {point.setting})"
    if point.family == ways.LAW:
        return f"laws.{point.setting}"
    if point.family == ways.MPMATH:
        return f"reference.d_norm, {point.setting}"
    return f"{point.family}, {point.setting}".rstrip(", ")


def choice_table(points: list[Measurement], tolerances: tuple[float, ...] = ways.TOLERANCES) -> str:
    """For each set of launches and each tolerance what to use and what it costs, as plain text."""
    heads = ("error at most", "use", "µs a launch", "max error", "median", "promised")
    lines = []
    for name in dict.fromkeys(point.domain for point in points):
        own = [point for point in points if point.domain == name]
        rows = [_choice(tolerance, cheapest(own, tolerance)) for tolerance in tolerances]
        lines += [f"{measurement.domain_words(name)}:", *tables.plain(heads, rows, left=(0, 1)), ""]
    words = (
        "The quickest way whose largest error was no more than that, of those that can be called "
        "as they are and answered every launch of the set; of ways within a tenth of it, one that "
        "promises the error beforehand, at its loosest setting. Errors are relative, of the range "
        f"on level ground, against mpmath at {DIGITS} digits for the first launches and the engine "
        "for the others. Times are medians, on one core, of calls with an array of launches, or "
        "one by one where a way takes no more."
    )
    return "\n".join([*lines, textwrap.fill(words, 90)]) + "\n"


def _choice(tolerance: float, best: Measurement | None) -> tuple[str, ...]:
    if best is None:
        return f"{tolerance:.0e}", "none of those measured"
    return (
        f"{tolerance:.0e}",
        call(best),
        f"{best.microseconds:.3g}",
        f"{best.largest:.1e}",
        f"{best.median:.1e}",
        f"{best.promise:.1e}" if math.isfinite(best.promise) else "-",
    )


# --- the figure ---------------------------------------------------------------------------

WIDTH, HEIGHT, DPI = 25, 15, 150  # cm, cm, dots an inch
LOWEST, HIGHEST = 1e-17, 10.0
# Colours told apart by the colour-blind (Okabe and Ito); a family has a marker of its own.
ORANGE, SKY, GREEN, BLUE, RED, PURPLE = (
    "#e69f00", "#56b4e9", "#009e73", "#0072b2", "#d55e00", "#cc79a7"
)  # fmt: skip
YELLOW, BLACK = "#c7b800", "#000000"
STYLES = {
    ways.EULER: (GREY, "o"),
    ways.CROMER: (GREY, "s"),
    ways.RK2: (GREY, "^"),
    ways.RK4: (GREY, "D"),
    ways.IVP.format("RK45"): (ORANGE, "o"),
    ways.IVP.format("DOP853"): (ORANGE, "s"),
    ways.IVP.format("LSODA"): (ORANGE, "^"),
    ways.DIFFRAX: (ORANGE, "D"),
    ways.BALLISTICCALC["rk4"]: (YELLOW, "D"),
    ways.BALLISTICCALC["rk45"]: (YELLOW, "s"),
    ways.PAPER: (PURPLE, "X"),
    ways.QUAD: (SKY, "s"),
    ways.MPMATH: (BLACK, "P"),
    ways.ENGINE: (SKY, "v"),
    ways.LAW: (GREEN, "h"),
    ways.TIER: (RED, "*"),
    ways.DIAL: (BLUE, "o"),
}
LABELS = {
    ways.TIER: 'd_norm(method="..."), the tiers',
    ways.DIAL: "d_norm(rtol=...), the dial",
    ways.LAW: "laws",
}
ALONE = (ways.LAW, ways.TIER, ways.PAPER)  # not joined by a line: no setting runs through them


def figure(points: list[Measurement]) -> Figure:
    """Error against time a launch, of what `work_precision.measure` gave."""
    names = list(dict.fromkeys(point.domain for point in points))
    drawn = style.new_figure(HEIGHT, WIDTH)
    panels = drawn.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    for axes, name in zip(panels, names, strict=True):
        panel(axes, [point for point in points if point.domain == name])
        axes.set_title(measurement.domain_words(name), fontsize=TEXT)
        axes.set_xlabel("time a launch, µs", fontsize=TEXT)
    panels[0].set_ylabel("relative error of d_norm", fontsize=TEXT)
    families = (point.family for point in points)
    style.legend(drawn, handles=key(families), loc="outside lower center", ncols=4)
    return drawn


def panel(axes: Any, points: Iterable[Measurement]) -> None:
    """Error against time of the points of one set of launches."""
    seen = [point for point in points if math.isfinite(point.largest)]
    for family, (colour, marker) in STYLES.items():
        own = [point for point in seen if point.family == family]
        if own:
            _draw(axes, own, colour, marker, joined=family not in ALONE)
    axes.set(xscale="log", yscale="log", ylim=(LOWEST / 3, HIGHEST))
    axes.yaxis.set_major_locator(LogLocator(100, numticks=12))
    decades(axes)


def decades(axes: Any) -> None:
    """A tick at every decade in x, in the size of the figure, and a light grid."""
    axes.tick_params(labelsize=TEXT)
    axes.xaxis.set_major_locator(LogLocator(10, numticks=12))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(NullFormatter())
    axes.grid(alpha=0.25)


def key(families: Iterable[str], labels: Mapping[str, str] = LABELS) -> list[Line2D]:
    """What stands for each of the families, and for parts of a marker."""
    there = set(families)
    return [
        *(
            Line2D([], [], color=colour, marker=marker, label=labels.get(family, family),
                   linestyle="none" if family in ALONE else "-", linewidth=1, markersize=7)
            for family, (colour, marker) in STYLES.items() if family in there
        ),
        Line2D([], [], color=BLACK, marker="o", fillstyle="none", linestyle="none",
               label="hollow: fails for some, or not for all v_norm"),
        Line2D([], [], color=BLACK, marker="_", linestyle=":", linewidth=1,
               label="down to the median error"),
    ]  # fmt: skip


def _draw(axes: Any, points: list[Measurement], colour: str, marker: str, *, joined: bool) -> None:
    """Markers at the largest errors, and below each a dotted line down to the median."""
    times = [point.microseconds for point in points]
    largest = [max(point.largest, LOWEST) for point in points]
    middle = [max(point.median, LOWEST) for point in points]
    axes.vlines(times, middle, largest, color=colour, linestyle=":", linewidth=1)
    axes.plot(times, middle, color=colour, marker="_", linestyle="none", markersize=6)
    if joined:
        axes.plot(times, largest, color=colour, linewidth=1)
    for point, x, y in zip(points, times, largest, strict=True):
        partly = point.family != ways.ENGINE and not point.general
        axes.plot(x, y, color=colour, marker=marker, markersize=7,
                  markerfacecolor="white" if partly else colour)  # fmt: skip
        if point.largest < LOWEST:
            words = f"{point.setting}: {point.largest:.0e} ↓"
            style.note(axes, words, (x, y), (-8, -4), ha="right")


def bench(
    out: str | os.PathLike[str],
    *,
    domains: tuple[Domain, ...] = DOMAINS,
    sizes: Sizes = SIZES,
    force: bool = False,
) -> list[Measurement]:
    """Measure, and write `FILES` into the folder `out`; two minutes, or five with all packages.

    Raises `OSError` before the computation where the files could not be written after it: as
    `FileExistsError` if one is there, unless `force`.
    """
    folder.check(out, FILES, force=force)
    points = measure(domains, sizes)
    contents = style.files("work_precision", figure(points), dpi=DPI)
    text = measurement.csv_text(points, sizes, COMMAND)
    for path in folder.write(out, {**contents, "work_precision.csv": text}, force=force):
        log.info(f"wrote {path}")
    return points
