"""Ways to d_norm measured beside each other: their errors, and their time a launch.

All ways are timed in one process, on one core, turn by turn: each round times every way once, so
that a machine that slows down slows all.  A slow way takes the first few launches only; they are
points of the R2 sequence, so that the first few stand for all.
"""

import logging
import math
import statistics
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, NamedTuple

import mpmath
import numpy as np

from hodograph import reference
from hodograph.bench.methods import one_by_one
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.level import d_norm
from hodograph.report import clock, tables
from hodograph.report.versions import versions

log = logging.getLogger("hodograph")
DIGITS = 40  # of the values by mpmath that errors are taken against
R2 = 0.7548776662466927, 0.5698402909980532  # steps that fill a square: 1/x, 1/x^2
PACKAGES = ("numpy", "scipy", "mpmath", "jax", "diffrax", "py-ballisticcalc")


class Domain(NamedTuple):
    """A set of launches: ranges of v_norm and of alpha0 in degrees."""

    name: str
    v_norm: tuple[float, float]
    alpha0_deg: tuple[float, float] = (5.0, 89.9)
    log: bool = False  # evenly in the logarithm of v_norm

    def launches(self, count: int) -> tuple[FloatArray, FloatArray]:
        """v_norm and alpha0 in radians of the first `count` launches, spread evenly.

        >>> v_norm, alpha0 = Domain("wide", (0.1, 20.0)).launches(3)
        >>> v_norm.round(3), np.rad2deg(alpha0).round(3)
        (array([15.122, 10.244,  5.366]), array([53.379, 16.859, 65.238]))
        """
        v_norm, alpha0 = np.empty(count), np.empty(count)
        speeds = np.log(self.v_norm) if self.log else np.array(self.v_norm)
        ends = speeds, np.deg2rad(self.alpha0_deg)
        for array, step, (first, last) in zip((v_norm, alpha0), R2, ends, strict=True):
            array[:] = 1  # all in place: `speed` measures memory above that of these arrays alone
            np.cumsum(array, out=array)
            array *= step
            array %= 1
            array *= last - first
            array += first
        if self.log:
            np.exp(v_norm, out=v_norm)
        return v_norm, alpha0


DOMAINS = (  # of `work_precision`
    Domain("paper", (0.0, 1.5), (1.0, 89.0)),
    Domain("wide", (0.1, 20.0)),
)


def domain_words(name: str) -> str:
    """The ranges of one of `DOMAINS`, in words; of another set its name."""
    for where in DOMAINS:
        if where.name == name:
            (v0, v1), (a0, a1) = where.v_norm, where.alpha0_deg
            lead = "the paper's domain, " if name == "paper" else ""
            return f"{lead}v_norm {v0:g} to {v1:g}, alpha0 {a0:g} to {a1:g} degrees"
    return name


class Sizes(NamedTuple):
    """How many launches each kind of way takes, and how long to repeat it.

    `many` for ways that are quick on arrays, `several` where arrays are integrated in time, `each`
    where a way takes one launch at a time, `few` for mpmath.  On `checked` of them mpmath judges
    the engine.  Each way is timed `rounds` times, or as often as fits into so many `seconds`.
    """

    many: int = 10_000
    several: int = 2_000
    each: int = 250
    few: int = 16
    checked: int = 64
    seconds: float = 0.5
    rounds: int = 15


@dataclass(frozen=True, eq=False)
class Way:
    """A way to d_norm at one setting, and how many launches it takes."""

    family: str
    setting: str
    compute: Callable[[FloatArray, FloatArray], Iterable[Any]]
    launches: int
    general: bool = True  # a user can call it: it is no part taken out of the engine
    v_max: float = math.inf
    checked: bool = False  # as good as the engine, so that mpmath alone can judge it
    promise: float = math.inf  # what its relative error is certified to be at most, if anything is


@dataclass(frozen=True)
class Measurement:
    """One way at one setting, on one set of launches.

    Where the engine is the judge, an error counts as no less than the engine's own median error.
    """

    domain: str  # the names of the `Domain`, of the way, and what was set
    family: str
    setting: str
    microseconds: float  # a launch, the median over the rounds
    median: float  # of the relative error, over the answers given; NaN if there were none
    largest: float
    failed: float  # share of the launches without an answer
    launches: int  # in a call
    general: bool  # a user can call it, and it answered all launches of the set
    promise: float = math.inf  # as of `Way`
    rounds: dict[int, float] = field(default_factory=dict, repr=False, compare=False)  # µs a launch

    def over(self, other: "Measurement") -> float:
        """How many times as long as another way it takes: median of the ratios in a round."""
        both = self.rounds.keys() & other.rounds.keys()
        return statistics.median(self.rounds[turn] / other.rounds[turn] for turn in both)


def measure(entries: Sequence[tuple[Domain, Way]], sizes: Sizes) -> list[Measurement]:
    """Time every way on its launches, all in turn, and find its errors against mpmath.

    A truth of `DIGITS` digits is computed for the first launches of each domain, `sizes.checked`
    of them; beyond these the engine is taken for it.
    """
    truths = {
        where: _truth(where, max(way.launches for place, way in entries if place == where), sizes)
        for where in dict.fromkeys(where for where, _ in entries)
    }
    calls, judged, family = [], [], ""
    for where, way in entries:
        if way.family != family:
            family = way.family
            log.info(f"{where.name}: {family}")
        v_norm, alpha0 = (part[: way.launches] for part in truths[where].launches)
        within = v_norm <= way.v_max
        calls.append(partial(way.compute, v_norm[within], alpha0[within]))
        judged.append((_errors(way, within, calls[-1](), truths[where]), within))
    spent = clock.in_turn(calls, sizes.rounds, seconds=sizes.seconds)
    return [
        _measurement(where, way, *found, own)
        for (where, way), found, own in zip(entries, judged, spent, strict=True)
    ]


class _Truth(NamedTuple):
    """The launches of a domain, and d_norm there: by mpmath for the first, else by the engine."""

    launches: tuple[FloatArray, FloatArray]
    d_norm: list[Any]
    checked: int  # by mpmath
    floor: float  # the engine's median error: one judged by the engine counts as no less


def _truth(where: Domain, count: int, sizes: Sizes) -> _Truth:
    log.info(f"{where.name}: the truth, by mpmath")
    found, checked = where.launches(count), max(sizes.checked, sizes.few)
    exact = one_by_one(partial(reference.d_norm, dps=DIGITS))
    first = exact(*(part[:checked] for part in found)).tolist()
    engine = d_norm(*found)
    floor = float(np.median(relative_errors(engine, first)))
    return _Truth(found, first + engine[checked:].tolist(), checked, floor)


def _errors(way: Way, within: BoolArray, answers: Iterable[Any], truth: _Truth) -> FloatArray:
    judged = np.flatnonzero(within[: truth.checked if way.checked else None])
    found = relative_errors(answers, [truth.d_norm[at] for at in judged])
    by_engine = judged[: found.size] >= truth.checked
    found[by_engine] = np.maximum(found[by_engine], truth.floor)
    return found


def relative_errors(answers: Iterable[Any], truth: Iterable[Any]) -> FloatArray:
    """Relative errors of the first answers, as many of them as there are true values."""
    context = mpmath.MPContext()
    context.dps = DIGITS  # 15, the usual number, would round the true value first

    def error(found: Any, true: Any) -> float:
        right = context.mpf(true)
        return float(abs((context.mpf(found) - right) / right))

    return np.array(list(map(error, answers, truth)))


def _measurement(
    where: Domain, way: Way, errors: FloatArray, within: BoolArray, spent: dict[int, float]
) -> Measurement:
    given = errors[np.isfinite(errors)]
    median, largest = math.nan, math.nan
    if given.size:
        median, largest = float(np.median(given)), float(given.max())
    failed = 1 - given.size / errors.size if errors.size else math.nan
    launches = int(within.sum())
    rounds = {turn: 1e6 * seconds / max(launches, 1) for turn, seconds in spent.items()}
    return Measurement(
        where.name,
        way.family,
        way.setting,
        statistics.median(rounds.values()),
        median,
        largest,
        failed,
        launches,
        way.general and bool(within.all()) and not failed,
        way.promise,
        rounds,
    )


COLUMNS = {  # of the CSV: the field of a `Measurement`, and how it is written
    "domain": ("domain", ""), "way": ("family", ""), "setting": ("setting", ""),
    "launches": ("launches", ""), "microseconds": ("microseconds", ".4g"),
    "median_error": ("median", ".3e"), "max_error": ("largest", ".3e"), "failed": ("failed", ".3g"),
    "general": ("general", "d"), "promise": ("promise", ".3g"),
}  # fmt: skip


def csv_text(points: Iterable[Measurement], sizes: Sizes, command: str) -> str:
    """The measurements as CSV: one row a way, a setting and a set of launches."""
    about = (
        "time a launch in microseconds, and relative errors of d_norm",
        "failed: share of the launches without an answer; general: 1 if the way can be called",
        "as it is and answered every launch of the set; promise: a certified bound, if any",
        "one core, where the system lets a process choose",
        f"at most {sizes.rounds} rounds or {sizes.seconds:g} s a way",
    )
    rows = (
        [format(getattr(point, name), spec) for name, spec in COLUMNS.values()] for point in points
    )
    command = f"{command}, with the extra `bench` for all of its rows"
    return tables.csv_text(about, COLUMNS, rows, command=command, by=versions(*PACKAGES))
