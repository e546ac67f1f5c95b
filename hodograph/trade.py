"""What accuracy costs: error against time a launch, for every way to d_norm.

All ways compute the same launches, in one process and on one core.  A slow way takes the first
few of them only; the launches are points of the R2 sequence, so that the first few stand for all.
"""

from __future__ import annotations

import csv
import io
import math
import os
import statistics
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import mpmath
import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from hodograph import clock, dial, laws, reference, rivals, steppers, timing
from hodograph.distance import d_norm
from hodograph.domain import BoolArray, FloatArray
from hodograph.figures import pdf
from hodograph.files import check_targets, write_whole
from hodograph.landing import landing_angle
from hodograph.position import BLOCK, layer, quadrature
from hodograph.rivals import time_scale
from hodograph.velocity import slope_drop, start

COMMAND = "hodograph bench trade"
FILES = ("trade.png", "trade.pdf", "trade.csv")
DIGITS = 40  # of the truth
TOLERANCES = tuple(10.0**-k for k in range(2, 13))
ALIKE = 1.1  # times no further apart than this are taken to be the same

STEPS = (8, 32, 128, 512)  # in `time_scale`
TOLERANCES_IVP = (1e-4, 1e-6, 1e-8, 1e-10)
TOLERANCES_DIAL = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
NODES = (4, 6, 8, 12, 16, 32, 64)
PRECISIONS = (15, 30)


class Domain(NamedTuple):
    """A set of launches: ranges of v_norm and of alpha0 in degrees."""

    name: str
    v_norm: tuple[float, float]
    alpha0_deg: tuple[float, float]

    def launches(self, count: int) -> tuple[FloatArray, FloatArray]:
        """v_norm and alpha0 in radians of the first `count` launches, spread evenly."""
        turns = (np.arange(1, count + 1)[:, np.newaxis] * timing.R2) % 1
        ends = np.array([self.v_norm, np.deg2rad(self.alpha0_deg)])
        v, a0 = (ends[:, 0] + turns * (ends[:, 1] - ends[:, 0])).T
        return np.ascontiguousarray(v), np.ascontiguousarray(a0)


DOMAINS = (
    Domain("paper", (0.0, 1.5), (1.0, 89.0)),
    Domain("wide", (0.1, 20.0), (5.0, 89.9)),
)


class Sizes(NamedTuple):
    """How many launches each kind of way takes, and how long to repeat it.

    `many` for what is quick on arrays, `several` for fixed steps, `few` one by one, `checked`
    to judge the engine by mpmath; `rounds` a way, but no more than fit into so many `seconds`.
    """

    many: int = 10_000
    several: int = 2_000
    few: int = 16
    checked: int = 64
    seconds: float = 0.4
    rounds: int = 15


SIZES = Sizes()


@dataclass(frozen=True)
class Point:
    """One way at one setting, on one set of launches.

    Attributes
    ----------
    domain, family, setting
        Name of the `Domain`, of the way, and what was set.
    microseconds
        Time a launch, the median over the rounds.
    median, largest
        Of the relative error, over the answers given; NaN if there were none.
    failed
        Share of the launches without an answer.
    launches
        How many a call took.
    general
        Whether it can be called as it is, and answered all launches of the set.
    """

    domain: str
    family: str
    setting: str
    microseconds: float
    median: float
    largest: float
    failed: float
    launches: int
    general: bool


@dataclass(frozen=True, eq=False)
class _Way:
    family: str
    setting: str
    compute: Callable[[FloatArray, FloatArray], Iterable[Any]]
    launches: int
    general: bool = True
    v_max: float = math.inf
    checked: bool = False  # as good as the engine: mpmath alone can judge it


# --- the ways -----------------------------------------------------------------------------

EULER, CROMER, RK2, RK4 = "Euler", "Euler-Cromer", "RK2", "RK4"
STEPPERS = {EULER: "euler", CROMER: "euler_cromer", RK2: "rk2", RK4: "rk4"}
SOLVERS = ("RK45", "DOP853", "LSODA")
IVP = "solve_ivp {}"
PAPER, ENGINE, TIER, DIAL = "paper's own route", "engine, n nodes", "method=...", "rtol=..."
LAW, MPMATH, DIFFRAX = "law", "mpmath", "diffrax Dopri8"
BALLISTICCALC = {"rk4": "py-ballisticcalc RK4", "dop853": "py-ballisticcalc DOP853"}
LAWS = {
    "table_1": laws.table_1,
    "d_norm_law": laws.d_norm_law,
    "d_norm_law_all": laws.d_norm_law_all,
}


def by_steps(v_norm: FloatArray, alpha0: FloatArray, *, method: str, steps: int) -> FloatArray:
    """d_norm by fixed steps in time, many launches together.

    Parameters
    ----------
    v_norm, alpha0 : ndarray
        Launch speeds over terminal speed, positive, and angles in radians between 0 and pi/2.
    method : str
        One of `steppers.FIXED`.
    steps : int
        How many in `rivals.time_scale`.

    Returns
    -------
    ndarray
        d_norm; NaN where the step was too long.

    Examples
    --------
    >>> import numpy as np
    >>> by_steps(np.array([1.0]), np.array([np.pi / 4]), method="rk4", steps=64).round(6)
    array([0.589012])
    """
    unit = time_scale(v_norm, np.sin(alpha0))  # of time; lengths are in v_lim times it, and so g is
    flights = steppers.integrate(v_norm, alpha0, 1.0, dt=1 / steps, method=method, g=unit)
    return np.asarray(flights.impact.x * unit / (v_norm**2 * np.sin(2 * alpha0)))


def by_nodes(v_norm: FloatArray, alpha0: FloatArray, *, nodes: int) -> FloatArray:
    """d_norm by the engine's landing and its quadrature, with as many nodes for every launch.

    Parameters
    ----------
    v_norm, alpha0 : ndarray
        Launch speeds over terminal speed, positive, and angles in radians between 0 and pi/2.
    nodes : int
        How many nodes from the launch to the landing.

    Returns
    -------
    ndarray
        d_norm.

    Examples
    --------
    >>> import numpy as np
    >>> by_nodes(np.array([1.0]), np.array([np.pi / 4]), nodes=16).round(8)
    array([0.5890118])
    """
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    delta = slope_drop(cos0, alpha0, landing_angle(v_norm, alpha0))
    begin, eta = start(v_norm**2, sin0, cos0), layer(v_norm**2)
    length = np.log1p(delta / eta)
    x = np.empty_like(delta)
    width = max(BLOCK // nodes, 1)
    for first in range(0, x.size, width):
        at = np.arange(first, min(first + width, x.size))
        x[at] = quadrature(nodes, begin.at(at), eta[at], length[at], ("x",))[0]
    return np.asarray(x / (2 * sin0))


def _each(compute: Callable[[float, float], Any]) -> Callable[[FloatArray, FloatArray], list[Any]]:
    def batch(v_norm: FloatArray, alpha0: FloatArray) -> list[Any]:
        pairs = zip(v_norm.tolist(), alpha0.tolist(), strict=True)
        return [compute(v, a0) for v, a0 in pairs]

    return batch


def _ways(sizes: Sizes) -> Iterator[_Way]:
    many, several, few = sizes.many, sizes.several, sizes.few
    for name, method in STEPPERS.items():
        for steps in STEPS:
            compute = partial(by_steps, method=method, steps=steps)
            yield _Way(name, f"{steps} steps", compute, several)
    for method in SOLVERS:
        for rtol in TOLERANCES_IVP:
            one = partial(
                rivals.by_solve_ivp, method=method, rtol=rtol, atol=1e-3 * rtol, scaled=True
            )
            yield _Way(IVP.format(method), f"rtol={rtol:.0e}", _each(one), few)
    yield _Way(PAPER, "", _each(rivals.by_paper), few)
    for nodes in NODES:
        compute = partial(by_nodes, nodes=nodes)
        yield _Way(ENGINE, f"{nodes} nodes", compute, many, general=False, checked=True)
    for tier in dial.METHODS:
        compute = partial(d_norm, method=tier)
        v_max, exact = dial.V_MAX.get(tier, math.inf), tier == "exact"
        yield _Way(TIER, f"method={tier!r}", compute, many, v_max=v_max, checked=exact)
    for rtol in TOLERANCES_DIAL:
        yield _Way(DIAL, f"rtol={rtol:.0e}", partial(d_norm, rtol=rtol), many)
    for name, law in LAWS.items():
        yield _Way(LAW, name, law, many)
    for dps in PRECISIONS:
        one = partial(reference.d_norm, dps=dps)
        yield _Way(MPMATH, f"{dps} digits", _each(one), few, checked=True)
    for rtol in TOLERANCES_IVP[1:]:
        batch = rivals.by_diffrax(rtol=rtol, atol=1e-3 * rtol, scaled=True)
        if batch is not None:
            yield _Way(DIFFRAX, f"rtol={rtol:.0e}", batch, several)
    for steps in STEPS[:-1]:
        fire = rivals.by_ballisticcalc(steps=steps)
        if fire is not None:
            yield _Way(BALLISTICCALC["rk4"], f"{steps} steps", _each(fire), few)
    for rtol in TOLERANCES_IVP:
        fire = rivals.by_ballisticcalc(rtol=rtol)
        if fire is not None:
            yield _Way(BALLISTICCALC["dop853"], f"rtol={rtol:.0e}", _each(fire), few)


# --- the measurement ----------------------------------------------------------------------


def measure(
    domains: tuple[Domain, ...] = DOMAINS,
    sizes: Sizes = SIZES,
    *,
    progress: Callable[[str], None] = lambda message: None,
) -> list[Point]:
    """Time every way, and find its errors.

    Parameters
    ----------
    domains : tuple of Domain, optional
        The sets of launches.
    sizes : Sizes, optional
        How many launches, and how often.
    progress : callable, optional
        Called with a short message now and then.

    Returns
    -------
    list of Point
        By set, then by way.
    """
    with clock.one_core():
        return [
            point
            for where in domains
            for point in _points(where, sizes, partial(_named, where.name, progress))
        ]


def _named(name: str, progress: Callable[[str], None], message: str) -> None:
    progress(f"{name}: {message}")


def _points(where: Domain, sizes: Sizes, progress: Callable[[str], None]) -> list[Point]:
    progress("the truth, by mpmath")
    launches = where.launches(max(sizes.many, sizes.several, sizes.checked, sizes.few))
    checked = max(sizes.checked, sizes.few)
    exact = _each(partial(reference.d_norm, dps=DIGITS))
    truth = exact(*(part[:checked] for part in launches))
    engine = d_norm(*launches)
    floor = float(np.median(_errors(engine[:checked], truth)))
    truth += engine[checked:].tolist()
    ways, calls, errors = list(_ways(sizes)), [], []
    for index, way in enumerate(ways):
        if index == 0 or way.family != ways[index - 1].family:
            progress(way.family)
        within = launches[0][: way.launches] <= way.v_max
        call = partial(way.compute, *(part[: way.launches][within] for part in launches))
        judged = np.flatnonzero(within[: checked if way.checked else None])
        found = _errors(call(), [truth[at] for at in judged])
        by_engine = judged[: found.size] >= checked  # where the engine has an error too, not seen
        found[by_engine] = np.maximum(found[by_engine], floor)
        calls.append(call)
        errors.append((found, within))
    spent = clock.in_turn(calls, sizes.rounds, seconds=sizes.seconds, progress=progress)
    return [
        _point(where, way, *judged, statistics.median(own.values()))
        for way, judged, own in zip(ways, errors, spent, strict=True)
    ]


def _point(
    where: Domain, way: _Way, errors: FloatArray, within: BoolArray, seconds: float
) -> Point:
    given = errors[np.isfinite(errors)]
    median, largest = (
        (float(np.median(given)), float(given.max())) if given.size else (math.nan, math.nan)
    )
    failed = 1 - given.size / errors.size if errors.size else math.nan
    launches = int(within.sum())
    return Point(
        where.name,
        way.family,
        way.setting,
        1e6 * seconds / max(launches, 1),
        median,
        largest,
        failed,
        launches,
        way.general and bool(within.all()) and not failed,
    )


def _errors(answers: Iterable[Any], truth: list[Any]) -> FloatArray:
    with mpmath.workdps(DIGITS):  # or the truth would be rounded first
        pairs = zip(answers, truth, strict=False)
        return np.array([float(abs((mpmath.mpf(found) - right) / right)) for found, right in pairs])


# --- the table ----------------------------------------------------------------------------


def cheapest(points: Iterable[Point], tolerance: float) -> Point | None:
    """The quickest general way whose largest error was no more than `tolerance`.

    Of ways that are within a tenth of the quickest, it is the dial, which promises the error,
    and the loosest setting.

    Parameters
    ----------
    points : iterable of Point
        Of one set of launches.
    tolerance : float
        Largest relative error that will do.

    Returns
    -------
    Point or None
        None if there was no such way.
    """
    good = [point for point in points if point.general and point.largest <= tolerance]
    least = min((point.microseconds for point in good), default=math.nan)
    near = [point for point in good if point.microseconds <= ALIKE * least]
    return max(near, key=lambda point: (point.family == DIAL, point.largest), default=None)


def call(point: Point) -> str:
    """What to call, in words.

    Parameters
    ----------
    point : Point
        A way and its setting.

    Returns
    -------
    str
        The words.
    """
    if point.family in (TIER, DIAL):
        return f"d_norm(..., {point.setting})"
    if point.family == LAW:
        return f"laws.{point.setting}"
    if point.family == MPMATH:
        return f"reference.d_norm, {point.setting}"
    return f"{point.family}, {point.setting}".rstrip(", ")


def choice_table(points: list[Point], tolerances: tuple[float, ...] = TOLERANCES) -> str:
    """For each tolerance what to use and what it costs, as plain text.

    Parameters
    ----------
    points : list of Point
        What `measure` gave.
    tolerances : tuple of float, optional
        The largest relative errors that will do.

    Returns
    -------
    str
        One table for each set of launches, and what they mean.
    """
    lines = []
    for name in dict.fromkeys(point.domain for point in points):
        own = [point for point in points if point.domain == name]
        lines += [
            f"{_words(name)}:",
            f"{'error at most':<15}{'use':<34}{'µs a launch':>12}{'max error':>11}{'median':>9}",
        ]
        for tolerance in tolerances:
            best = cheapest(own, tolerance)
            lead = f"{tolerance:<15.0e}"
            if best is None:
                lines.append(f"{lead}none of those measured")
                continue
            lines.append(
                f"{lead}{call(best):<34}{best.microseconds:>12.3g}{best.largest:>11.1e}"
                f"{best.median:>9.1e}"
            )
        lines.append("")
    lines += [
        "The quickest way whose largest error was no more than that, of those that can be called",
        "as they are and answered every launch of the set; if the dial, rtol=..., is within a",
        "tenth of it, the dial at its loosest setting. Errors are relative, of the range on level",
        f"ground, against mpmath at {DIGITS} digits for the first launches and the engine for the",
        "others; only those of rtol=... are promised beforehand. Times are medians, on one",
        "core, of calls with an array of launches, or one by one where a way takes no more.",
    ]
    return "\n".join(lines) + "\n"


def _words(name: str) -> str:
    for where in DOMAINS:
        if where.name == name:
            (v0, v1), (a0, a1) = where.v_norm, where.alpha0_deg
            lead = "the paper's domain, " if name == "paper" else ""
            return f"{lead}v_norm {v0:g} to {v1:g}, alpha0 {a0:g} to {a1:g} degrees"
    return name


COLUMNS = (
    "domain", "way", "setting", "launches", "microseconds", "median_error", "max_error", "failed",
    "general",
)  # fmt: skip


def csv_text(points: list[Point]) -> str:
    """The points as CSV: one row a way, a setting and a set of launches.

    Parameters
    ----------
    points : list of Point
        What `measure` gave.

    Returns
    -------
    str
        The content of the file.
    """
    stream = io.StringIO()
    stream.write(
        "# time a launch in microseconds, and relative errors of d_norm\n"
        "# failed: share of the launches without an answer; general: 1 if the way can be called\n"
        "# as it is and answered every launch of the set\n"
        f"# {timing._conditions(SIZES.rounds, SIZES.few, True).partition(';')[0]}\n"
        f"# remade by: {COMMAND}\n"
    )
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow(COLUMNS)
    for point in points:
        rows.writerow(
            [
                point.domain,
                point.family,
                point.setting,
                point.launches,
                f"{point.microseconds:.4g}",
                f"{point.median:.3e}",
                f"{point.largest:.3e}",
                f"{point.failed:.3g}",
                int(point.general),
            ]
        )
    return stream.getvalue()


# --- the figure ---------------------------------------------------------------------------

TEXT = 9  # points
WIDTH, HEIGHT, DPI = 25 / 2.54, 15 / 2.54, 150  # inches, inches, dots an inch
LOWEST, HIGHEST = 1e-17, 10.0
# Colours told apart by the colour-blind (Okabe and Ito); a family has a marker of its own.
ORANGE, SKY, GREEN, BLUE, RED, PURPLE = (
    "#e69f00", "#56b4e9", "#009e73", "#0072b2", "#d55e00", "#cc79a7"
)  # fmt: skip
YELLOW, BLACK, GREY = "#c7b800", "#000000", "#6b7280"
STYLES = {
    EULER: (GREY, "o"),
    CROMER: (GREY, "s"),
    RK2: (GREY, "^"),
    RK4: (GREY, "D"),
    IVP.format("RK45"): (ORANGE, "o"),
    IVP.format("DOP853"): (ORANGE, "s"),
    IVP.format("LSODA"): (ORANGE, "^"),
    DIFFRAX: (ORANGE, "D"),
    BALLISTICCALC["rk4"]: (YELLOW, "D"),
    BALLISTICCALC["dop853"]: (YELLOW, "s"),
    PAPER: (PURPLE, "X"),
    MPMATH: (BLACK, "P"),
    ENGINE: (SKY, "v"),
    LAW: (GREEN, "h"),
    TIER: (RED, "*"),
    DIAL: (BLUE, "o"),
}
LABELS = {TIER: 'd_norm(method="..."), the tiers', DIAL: "d_norm(rtol=...), the dial", LAW: "laws"}
ALONE = (LAW, TIER, PAPER)  # families whose points are no sequence


def figure(points: list[Point]) -> Figure:
    """Error against time a launch, one panel for each set of launches.

    Parameters
    ----------
    points : list of Point
        What `measure` gave.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    names = list(dict.fromkeys(point.domain for point in points))
    drawn = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
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
        axes.set_title(_words(name), fontsize=TEXT)
        axes.set_xlabel("time a launch, µs", fontsize=TEXT)
        axes.tick_params(labelsize=TEXT)
        axes.xaxis.set_major_locator(LogLocator(10, numticks=12))
        axes.yaxis.set_major_locator(LogLocator(100, numticks=12))
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_minor_formatter(NullFormatter())
        axes.grid(alpha=0.25)
    panels[0].set_ylabel("relative error of d_norm", fontsize=TEXT)
    families = {point.family for point in points}
    drawn.legend(
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
        frameon=False,
        fontsize=TEXT,
    )  # fmt: skip
    return drawn


def _draw(axes: Any, points: list[Point], colour: str, marker: str, *, joined: bool) -> None:
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


def bench_trade(
    out: str | os.PathLike[str],
    *,
    domains: tuple[Domain, ...] = DOMAINS,
    sizes: Sizes = SIZES,
    force: bool = False,
    progress: Callable[[str], None] = lambda message: None,
) -> list[Point]:
    """Measure, and write ``trade.png``, ``.pdf`` and ``.csv``; a minute or so.

    Parameters
    ----------
    out : path-like
        The folder; made if it is not there.
    domains, sizes : optional
        As for `measure`.
    force : bool, optional
        Replace files that are there.
    progress : callable, optional
        Called with a short message now and then.

    Returns
    -------
    list of Point
        What was measured.

    Raises
    ------
    OSError
        The folder cannot be written, or, as `FileExistsError`, it holds one of the files already.
        Both are found out before the computation.
    """
    folder = Path(out)
    check_targets(*(folder / name for name in FILES), force=force)
    points = measure(domains, sizes, progress=progress)
    drawn = figure(points)
    stream = io.BytesIO()
    drawn.savefig(stream, format="png", dpi=DPI, metadata={"Software": None})
    contents: tuple[bytes | str, ...] = (stream.getvalue(), pdf(drawn), csv_text(points))
    for name, content in zip(FILES, contents, strict=True):
        progress(f"wrote {write_whole(folder / name, content, force=force)}")
    return points
