"""What accuracy costs: error against time a launch, for every way to d_norm.

All ways compute the same launches, in one process and on one core.  A slow way takes the first
few of them only; the launches are points of the R2 sequence, so that the first few stand for all.
"""

from __future__ import annotations

import csv
import io
import math
import statistics
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import mpmath
import numpy as np

from hodograph import laws, reference
from hodograph.bench import methods as rivals
from hodograph.bench import timing
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.level import d_norm
from hodograph.report import clock
from hodograph.tiers import dial

COMMAND = "hodograph bench trade"
DIGITS = 40  # of the truth
TOLERANCES = tuple(10.0**-k for k in range(2, 13))
ALIKE = 1.1  # times no further apart than this are taken to be the same

STEPS = (8, 32, 128, 512)  # in `rivals.time_scale`
TOLERANCES_IVP = (1e-4, 1e-6, 1e-8, 1e-10)
NODES = (4, 6, 8, 12, 16, 32, 64)
PRECISIONS = (15, 30)


class Domain(NamedTuple):
    """A set of launches: ranges of v_norm and of alpha0 in degrees."""

    name: str
    v_norm: tuple[float, float]
    alpha0_deg: tuple[float, float]

    def launches(self, count: int) -> tuple[FloatArray, FloatArray]:
        """v_norm and alpha0 in radians of the first `count` launches, spread evenly."""
        low, high = self.alpha0_deg
        return timing.launches(count, *self.v_norm, low_deg=low, high_deg=high)


DOMAINS = (
    Domain("paper", (0.0, 1.5), (1.0, 89.0)),
    Domain("wide", (0.1, 20.0), (5.0, 89.9)),
)


class Sizes(NamedTuple):
    """How many launches each kind of way takes, and how long to repeat it.

    `many` for what is quick on arrays, `several` for what integrates arrays in time, `each` for
    what takes one at a time, `few` for mpmath; `checked` of them to judge the engine by mpmath;
    `rounds` a way, but no more than fit into so many `seconds`.
    """

    many: int = 10_000
    several: int = 2_000
    each: int = 250
    few: int = 16
    checked: int = 64
    seconds: float = 0.5
    rounds: int = 15


SIZES = Sizes()


@dataclass(frozen=True)
class Measurement:
    """One way at one setting, on one set of launches.

    Attributes
    ----------
    domain, family, setting
        Name of the `Domain`, of the way, and what was set.
    microseconds
        Time a launch, the median over the rounds.
    median, largest
        Of the relative error, over the answers given; NaN if there were none.  An answer that is
        the engine's own has the engine's median error where mpmath did not judge it.
    failed
        Share of the launches without an answer.
    launches
        How many a call took.
    general
        Whether it can be called as it is, and answered all launches of the set.
    promise
        What its relative error is certified to be at most; infinite if nothing is.
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
    promise: float = math.inf


@dataclass(frozen=True, eq=False)
class _Way:
    family: str
    setting: str
    compute: Callable[[FloatArray, FloatArray], Iterable[Any]]
    launches: int
    general: bool = True
    v_max: float = math.inf
    checked: bool = False  # as good as the engine: mpmath alone can judge it
    promise: float = math.inf


# --- the ways -----------------------------------------------------------------------------

EULER, CROMER, RK2, RK4 = "Euler", "Euler-Cromer", "RK2", "RK4"
STEPPERS = {EULER: "euler", CROMER: "euler_cromer", RK2: "rk2", RK4: "rk4"}
SOLVERS = ("RK45", "DOP853", "LSODA")
IVP = "solve_ivp {}"
PAPER, ENGINE, TIER, DIAL = "paper's own route", "engine, always n nodes", "method=...", "rtol=..."
LAW, MPMATH, DIFFRAX = "law", "mpmath", "diffrax Dopri8"
BALLISTICCALC = {"rk4": "py-ballisticcalc RK4", "rk45": "py-ballisticcalc Dormand-Prince"}
LAWS = {
    "table_1": laws.table_1,
    "d_norm_law": laws.d_norm_law,
    "d_norm_law_all": laws.d_norm_law_all,
}


def _ways(sizes: Sizes) -> Iterator[_Way]:
    many, several, each, few = sizes.many, sizes.several, sizes.each, sizes.few
    for name, method in STEPPERS.items():
        for steps in STEPS:
            compute = partial(rivals.by_steps, method=method, steps=steps)
            yield _Way(name, f"{steps} steps", compute, several)
    for method in SOLVERS:
        for rtol in TOLERANCES_IVP:
            one = partial(
                rivals.by_solve_ivp, method=method, rtol=rtol, atol=1e-3 * rtol, scaled=True
            )
            yield _Way(IVP.format(method), f"rtol={rtol:.0e}", rivals.one_by_one(one), each)
    yield _Way(PAPER, "", rivals.one_by_one(rivals.by_paper), each)
    for nodes in NODES:
        compute = partial(rivals.by_nodes, nodes=nodes)
        yield _Way(ENGINE, f"{nodes} nodes", compute, many, general=False, checked=True)
    for tier in dial.METHODS:
        compute = partial[FloatArray](d_norm, method=tier)
        v_max, exact = dial.V_MAX.get(tier, math.inf), tier == "exact"
        promise = dial.PROMISE if exact else float(dial.bounds()[tier].max())
        yield _Way(
            TIER, f"method={tier!r}", compute, many, v_max=v_max, checked=exact, promise=promise
        )
    for rtol in TOLERANCES:
        yield _Way(
            DIAL, f"rtol={rtol:.0e}", partial[FloatArray](d_norm, rtol=rtol), many, promise=rtol
        )
    for name, law in LAWS.items():
        yield _Way(LAW, name, law, many)
    for dps in PRECISIONS:
        one = partial(reference.d_norm, dps=dps)
        yield _Way(MPMATH, f"{dps} digits", rivals.one_by_one(one), few, checked=True)
    for rtol in TOLERANCES_IVP[1:]:
        batch = rivals.by_diffrax(rtol=rtol, atol=1e-3 * rtol, scaled=True)
        if batch is not None:
            yield _Way(DIFFRAX, f"rtol={rtol:.0e}", batch, several)
    for steps in STEPS:
        fire = rivals.by_ballisticcalc(steps=steps)
        if fire is not None:
            yield _Way(BALLISTICCALC["rk4"], f"{steps} steps", rivals.one_by_one(fire), each)
    for rtol in TOLERANCES_IVP:
        fire = rivals.by_ballisticcalc(rtol=rtol)
        if fire is not None:
            yield _Way(BALLISTICCALC["rk45"], f"rtol={rtol:.0e}", rivals.one_by_one(fire), each)


# --- the measurement ----------------------------------------------------------------------


def measure(
    domains: tuple[Domain, ...] = DOMAINS,
    sizes: Sizes = SIZES,
    *,
    progress: Callable[[str], None] = lambda message: None,
) -> list[Measurement]:
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
    list of Measurement
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


def _points(where: Domain, sizes: Sizes, progress: Callable[[str], None]) -> list[Measurement]:
    progress("the truth, by mpmath")
    launches = where.launches(max(sizes[:5]))
    checked = max(sizes.checked, sizes.few)
    exact = rivals.one_by_one(partial(reference.d_norm, dps=DIGITS))
    truth = exact(*(part[:checked] for part in launches)).tolist()
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
) -> Measurement:
    given = errors[np.isfinite(errors)]
    median, largest = (
        (float(np.median(given)), float(given.max())) if given.size else (math.nan, math.nan)
    )
    failed = 1 - given.size / errors.size if errors.size else math.nan
    launches = int(within.sum())
    return Measurement(
        where.name,
        way.family,
        way.setting,
        1e6 * seconds / max(launches, 1),
        median,
        largest,
        failed,
        launches,
        way.general and bool(within.all()) and not failed,
        way.promise,
    )


def _errors(answers: Iterable[Any], truth: list[Any]) -> FloatArray:
    context = mpmath.MPContext()
    context.dps = DIGITS  # or the truth would be rounded first

    def error(found: Any, true: Any) -> float:
        right = context.mpf(true)
        return float(abs((context.mpf(found) - right) / right))

    return np.array(list(map(error, answers, truth)))  # as many as there are of both


# --- the table ----------------------------------------------------------------------------


def cheapest(points: Iterable[Measurement], tolerance: float) -> Measurement | None:
    """The quickest general way whose largest error was no more than `tolerance`.

    The dial counts only where it promises as much.  Of ways that are within a tenth of the
    quickest, it is one that does, and the loosest setting.

    Parameters
    ----------
    points : iterable of Measurement
        Of one set of launches.
    tolerance : float
        Largest relative error that will do.

    Returns
    -------
    Measurement or None
        None if there was no such way.
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
    """What to call, in words.

    Parameters
    ----------
    point : Measurement
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


def choice_table(points: list[Measurement], tolerances: tuple[float, ...] = TOLERANCES) -> str:
    """For each tolerance what to use and what it costs, as plain text.

    Parameters
    ----------
    points : list of Measurement
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
            f"{domain_words(name)}:",
            f"{'error at most':<15}{'use':<30}{'µs a launch':>12}{'max error':>11}{'median':>9}"
            f"{'promised':>10}",
        ]
        for tolerance in tolerances:
            best = cheapest(own, tolerance)
            lead = f"{tolerance:<15.0e}"
            if best is None:
                lines.append(f"{lead}none of those measured")
                continue
            lines.append(
                f"{lead}{call(best):<30}{best.microseconds:>12.3g}{best.largest:>11.1e}"
                f"{best.median:>9.1e}"
                + (f"{best.promise:>10.1e}" if math.isfinite(best.promise) else f"{'-':>10}")
            )
        lines.append("")
    lines += [
        "The quickest way whose largest error was no more than that, of those that can be called",
        "as they are and answered every launch of the set; of ways within a tenth of it, one that",
        "promises the error beforehand, at its loosest setting. Errors are relative, of the range",
        f"on level ground, against mpmath at {DIGITS} digits for the first launches and the engine",
        "for the others. Times are medians, on one core, of calls with an array of launches, or",
        "one by one where a way takes no more.",
    ]
    return "\n".join(lines) + "\n"


def domain_words(name: str) -> str:
    """The ranges of a set of launches, in words.

    Parameters
    ----------
    name : str
        That of one of `DOMAINS`.

    Returns
    -------
    str
        The words; of another set its name.
    """
    for where in DOMAINS:
        if where.name == name:
            (v0, v1), (a0, a1) = where.v_norm, where.alpha0_deg
            lead = "the paper's domain, " if name == "paper" else ""
            return f"{lead}v_norm {v0:g} to {v1:g}, alpha0 {a0:g} to {a1:g} degrees"
    return name


COLUMNS = (
    "domain", "way", "setting", "launches", "microseconds", "median_error", "max_error", "failed",
    "general", "promise",
)  # fmt: skip


def csv_text(points: list[Measurement], sizes: Sizes = SIZES) -> str:
    """The points as CSV: one row a way, a setting and a set of launches.

    Parameters
    ----------
    points : list of Measurement
        What `measure` gave.
    sizes : Sizes, optional
        As for `measure`.

    Returns
    -------
    str
        The content of the file.
    """
    stream = io.StringIO()
    stream.write(
        "# time a launch in microseconds, and relative errors of d_norm\n"
        "# failed: share of the launches without an answer; general: 1 if the way can be called\n"
        "# as it is and answered every launch of the set; promise: a certified bound, if any\n"
        f"# {timing.versions()}; one core, where the system lets a process choose\n"
        f"# at most {sizes.rounds} rounds or {sizes.seconds:g} s a way\n"
        f"# remade by: {COMMAND}, with the extra `bench` for all of its rows\n"
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
                f"{point.promise:.3g}",
            ]
        )
    return stream.getvalue()
