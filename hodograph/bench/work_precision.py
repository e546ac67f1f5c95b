"""What accuracy costs: error against time a launch, for every way to d_norm, and what to use."""

import math
import os
import textwrap
from collections.abc import Iterable

from hodograph.bench import measurement
from hodograph.bench.measurement import DIGITS, DOMAINS, Domain, Measurement, Sizes, log
from hodograph.bench.ways import DIAL, LAW, MPMATH, TIER, TOLERANCES, ways
from hodograph.bench.work_precision_figure import DPI, figure
from hodograph.report import clock, folder, style, tables

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
            for point in measurement.measure([(where, way) for way in ways(sizes)], sizes)
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
        if point.general and (point.promise if point.family == DIAL else point.largest) <= tolerance
    ]
    least = min((point.microseconds for point in good), default=math.nan)
    near = [point for point in good if point.microseconds <= ALIKE * least]
    return max(near, key=lambda point: (point.promise <= tolerance, point.largest), default=None)


def call(point: Measurement) -> str:
    """What to call, in words."""
    if point.family in (TIER, DIAL):
        return f"d_norm(..., {point.setting})"
    if point.family == LAW:
        return f"laws.{point.setting}"
    if point.family == MPMATH:
        return f"reference.d_norm, {point.setting}"
    return f"{point.family}, {point.setting}".rstrip(", ")


def choice_table(points: list[Measurement], tolerances: tuple[float, ...] = TOLERANCES) -> str:
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
