"""Error against time a launch, drawn: one panel for each set of launches."""

import math
from typing import Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from hodograph.bench import ways
from hodograph.bench.measurement import Measurement, domain_words
from hodograph.bench.ways import BALLISTICCALC, DIAL, ENGINE, IVP, LAW, PAPER, TIER
from hodograph.report.style import GREY, TEXT, legend, new_figure

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
    IVP.format("RK45"): (ORANGE, "o"),
    IVP.format("DOP853"): (ORANGE, "s"),
    IVP.format("LSODA"): (ORANGE, "^"),
    ways.DIFFRAX: (ORANGE, "D"),
    BALLISTICCALC["rk4"]: (YELLOW, "D"),
    BALLISTICCALC["rk45"]: (YELLOW, "s"),
    PAPER: (PURPLE, "X"),
    ways.MPMATH: (BLACK, "P"),
    ENGINE: (SKY, "v"),
    LAW: (GREEN, "h"),
    TIER: (RED, "*"),
    DIAL: (BLUE, "o"),
}
LABELS = {TIER: 'd_norm(method="..."), the tiers', DIAL: "d_norm(rtol=...), the dial", LAW: "laws"}
ALONE = (
    LAW,
    TIER,
    PAPER,
)  # families whose points are not joined: no one setting takes them from one to the next


def figure(points: list[Measurement]) -> Figure:
    """Error against time a launch, of what `work_precision.measure` gave."""
    names = list(dict.fromkeys(point.domain for point in points))
    drawn = new_figure(HEIGHT, WIDTH)
    panels = drawn.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    for axes, name in zip(panels, names, strict=True):
        for family, (colour, marker) in STYLES.items():
            own = [
                point
                for point in points
                if (point.domain, point.family) == (name, family) and math.isfinite(point.largest)
            ]
            if own:
                _draw(axes, own, colour, marker, joined=family not in ALONE)
        axes.set(xscale="log", yscale="log", ylim=(LOWEST / 3, HIGHEST))
        axes.set_title(domain_words(name), fontsize=TEXT)
        axes.set_xlabel("time a launch, µs", fontsize=TEXT)
        axes.tick_params(labelsize=TEXT)
        axes.xaxis.set_major_locator(LogLocator(10, numticks=12))
        axes.yaxis.set_major_locator(LogLocator(100, numticks=12))
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_minor_formatter(NullFormatter())
        axes.grid(alpha=0.25)
    panels[0].set_ylabel("relative error of d_norm", fontsize=TEXT)
    families = {point.family for point in points}
    legend(
        drawn,
        handles=[
            *(
                Line2D([], [], color=colour, marker=marker, label=LABELS.get(family, family),
                       linestyle="none" if family in ALONE else "-", linewidth=1, markersize=7)
                for family, (colour, marker) in STYLES.items() if family in families
            ),
            Line2D([], [], color=BLACK, marker="o", fillstyle="none", linestyle="none",
                   label="hollow: fails for some, or not for all v_norm"),
            Line2D([], [], color=BLACK, marker="_", linestyle=":", linewidth=1,
                   label="down to the median error"),
        ],
        loc="outside lower center",
        ncols=4,
    )  # fmt: skip
    return drawn


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
        partly = point.family != ENGINE and not point.general
        axes.plot(x, y, color=colour, marker=marker, markersize=7,
                  markerfacecolor="white" if partly else colour)  # fmt: skip
        if point.largest < LOWEST:
            axes.annotate(
                f"{point.setting}: {point.largest:.0e} ↓", (x, y), (-8, -4),
                textcoords="offset points", ha="right", fontsize=TEXT,
            )  # fmt: skip
