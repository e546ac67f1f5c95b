"""Time and memory of d_norm, and the time of its rivals on the same launches.

All that is compared is timed in one process, on one core, turn by turn: each round times every
contestant once, and a ratio is the median over the rounds of the ratio within a round, so that
a machine that slows down slows both.
"""

from __future__ import annotations

import contextlib
import csv
import io
import math
import platform
import statistics
import subprocess
import sys
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np

from hodograph import reference
from hodograph.bench import methods as rivals
from hodograph.bench.methods import Batch
from hodograph.engine.domain import FloatArray
from hodograph.level import d_norm
from hodograph.report import clock

COMMAND = "hodograph bench speed"
V_LOW, V_HIGH, V_PAPER, V_FAST = 0.1, 20.0, 1.5, 1e8
LOW_DEG, HIGH_DEG = 5.0, 89.9
DIGITS = 20
SECONDS = 8.0  # of rounds a contestant, at most
MANY = 10_000_000  # launches in the call whose memory is measured
PACKAGES = ("hodograph", "numpy", "scipy", "mpmath", "jax", "diffrax", "py-ballisticcalc")
R2 = 0.7548776662466927, 0.5698402909980532  # 1/x and 1/x^2 with x^3 = x + 1


@dataclass(frozen=True)
class Row:
    """What was timed: median time, largest relative error, and the time over that of `to`.

    NaN where a figure was not measured; `note` says why.
    """

    what: str
    launches: int  # a round
    microseconds: float  # a launch
    error: float
    ratio: float
    to: str
    note: str = ""


@dataclass(frozen=True)
class Target:
    """A figure, the bound it is held to, and whether it keeps it: None if it was not measured."""

    what: str
    bound: str
    measured: str
    met: bool | None


@dataclass(frozen=True)
class Speed:
    """The rows, the targets, and where and how they were measured."""

    rows: list[Row]
    targets: list[Target]
    conditions: str


def launches(
    count: int,
    v_low: float = V_LOW,
    v_high: float = V_HIGH,
    *,
    low_deg: float = LOW_DEG,
    high_deg: float = HIGH_DEG,
    log: bool = False,
) -> tuple[FloatArray, FloatArray]:
    """Launches spread evenly over a range of v_norm and one of angles.

    They are points of the R2 sequence, so that the first few stand for all.

    Parameters
    ----------
    count : int
        How many.
    v_low, v_high : float, optional
        The range of v_norm.
    low_deg, high_deg : float, optional
        The range of angles, in degrees.
    log : bool, optional
        Spread them evenly in the logarithm of v_norm.

    Returns
    -------
    v_norm, alpha0 : ndarray
        Speeds over terminal speed, and radians.

    Examples
    --------
    >>> v_norm, alpha0 = launches(3)
    >>> v_norm.round(3), np.rad2deg(alpha0).round(3)
    (array([15.122, 10.244,  5.366]), array([53.379, 16.859, 65.238]))
    """
    v_norm, alpha0 = np.empty(count), np.empty(count)
    low, high = (math.log(v_low), math.log(v_high)) if log else (v_low, v_high)
    ends = (low, high), (math.radians(low_deg), math.radians(high_deg))
    for array, step, (first, last) in zip((v_norm, alpha0), R2, ends, strict=True):
        array[:] = 1  # in place: the memory of a large call is measured above these arrays
        np.cumsum(array, out=array)
        array *= step
        array %= 1
        array *= last - first
        array += first
    if log:
        np.exp(v_norm, out=v_norm)
    return v_norm, alpha0


# --- the contest --------------------------------------------------------------------------

RANGE = f"v_norm {V_LOW:g}-{V_HIGH:g}"
MIXED, MIXED_LOG = f"d_norm, {RANGE}", f"d_norm, {RANGE}, log"
PAPER = f"d_norm, v_norm {V_LOW:g}-{V_PAPER:g}"
AT_ONE, AT_FAST = "d_norm, v_norm 1", f"d_norm, v_norm {V_FAST:.0e}"
SOLVE_IVP, SOLVE_IVP_LOG = f"solve_ivp, {RANGE}", f"solve_ivp, {RANGE}, log"
DIFFRAX = f"diffrax, {RANGE}"
SCALAR, QUAD = "d_norm, one launch a call", "quad + Newton, one launch a call"


@dataclass(frozen=True, eq=False)
class _Contestant:
    what: str
    to: str
    compute: Batch
    v_norm: FloatArray
    alpha0: FloatArray


def _contestants(count: int, few: int) -> list[_Contestant]:
    v, a = launches(count)
    v_log, _ = launches(count, log=True)
    slow, _ = launches(count, V_LOW, V_PAPER)
    one, fast = np.ones(count), np.full(count, V_FAST)
    solve_ivp, quad = rivals.one_by_one(rivals.by_solve_ivp), rivals.one_by_one(rivals.by_quad)
    scalar = rivals.one_by_one(d_norm)
    first = slice(few)
    contestants = [
        _Contestant(MIXED, MIXED, d_norm, v, a),
        _Contestant(SOLVE_IVP, MIXED, solve_ivp, v[first], a[first]),
        _Contestant(MIXED_LOG, MIXED_LOG, d_norm, v_log, a),
        _Contestant(SOLVE_IVP_LOG, MIXED_LOG, solve_ivp, v_log[first], a[first]),
        _Contestant(PAPER, MIXED, d_norm, slow, a),
        _Contestant(AT_ONE, MIXED, d_norm, one, a),
        _Contestant(AT_FAST, AT_ONE, d_norm, fast, a),
        _Contestant(SCALAR, MIXED, scalar, v[first], a[first]),
        _Contestant(QUAD, SCALAR, quad, v[first], a[first]),
    ]
    diffrax = rivals.by_diffrax()
    if diffrax is not None:
        contestants.append(_Contestant(DIFFRAX, MIXED, diffrax, v, a))
    return contestants


def measure(
    *,
    count: int = 10_000,
    few: int = 50,
    rounds: int = 21,
    many: int | None = MANY,
    progress: Callable[[str], None] = lambda message: None,
) -> Speed:
    """Time d_norm and its rivals, and find the memory that a large call takes.

    Parameters
    ----------
    count : int, optional
        Launches in an array.
    few : int, optional
        Launches that are computed one by one: the first of the array.  The errors are the largest
        over as many.
    rounds : int, optional
        How often each contestant is timed; a slow one less often.
    many : int or None, optional
        Launches in the call whose memory is measured; None to skip it.
    progress : callable, optional
        Called with a short message now and then.

    Returns
    -------
    Speed
        What was measured.
    """
    with clock.one_core() as core:
        contestants = _contestants(count, few)
        progress("errors")
        errors = _errors(contestants, few)  # by calls that are not timed
        calls = [partial(one.compute, one.v_norm, one.alpha0) for one in contestants]
        spent = clock.in_turn(calls, rounds, seconds=SECONDS, progress=progress)
    times = {  # a launch, by round
        one.what: {turn: seconds / one.v_norm.size for turn, seconds in own.items()}
        for one, own in zip(contestants, spent, strict=True)
    }
    rows = []
    for contestant in contestants:
        own, others = times[contestant.what], times[contestant.to]
        ratios = [each / others[turn] for turn, each in own.items()]
        rows.append(
            Row(
                contestant.what,
                contestant.v_norm.size,
                1e6 * statistics.median(own.values()),
                errors[contestant.what],
                statistics.median(ratios),
                contestant.to,
            )
        )
    if DIFFRAX not in times:
        missing = (math.nan,) * 3
        rows.append(Row(DIFFRAX, count, *missing, MIXED, "not installed (extra: bench)"))
    memory = math.nan
    if many is not None:
        progress(f"memory of one call with {many} launches")
        memory = peak_memory(many)
    return Speed(rows, _targets(rows, memory, many), _conditions(rounds, few, core))


def _errors(contestants: list[_Contestant], few: int) -> dict[str, float]:
    """Largest relative error of each over its first launches, against mpmath."""
    truth = cache(partial(reference.d_norm, dps=DIGITS))  # many have the same launches
    errors = {}
    for contestant in contestants:
        found = contestant.compute(contestant.v_norm, contestant.alpha0)[:few].tolist()
        flown = zip(contestant.v_norm[:few].tolist(), contestant.alpha0[:few].tolist(), strict=True)
        exact = [truth(*launch) for launch in flown]
        errors[contestant.what] = max(
            float(abs(value - right) / right) for value, right in zip(found, exact, strict=True)
        )
    return errors


# --- memory -------------------------------------------------------------------------------


def peak_memory(count: int) -> float:
    """Memory that one call of d_norm takes at its peak, above the arrays in and out.

    What the operating system counts, in a process of its own.

    Parameters
    ----------
    count : int
        Launches in the call.

    Returns
    -------
    float
        In MB (10^6 bytes); NaN where the system does not tell (Linux does).
    """
    script = "from hodograph.bench import timing; print(timing._growth(int(input())))"
    child = subprocess.run(
        [sys.executable, "-c", script], input=str(count), capture_output=True, text=True
    )
    if child.returncode:
        problem = (child.stderr.strip().splitlines() or ["no message"])[-1]
        raise RuntimeError(f"the call with {count} launches failed: {problem}")
    return float(child.stdout)


def _growth(count: int) -> float:
    """The peak of this process in a first call, above what it held before and the array out."""
    if sys.platform != "linux":
        return math.nan
    inputs = launches(count)
    before = _resident("VmRSS")
    result = d_norm(*inputs)
    return float(_resident("VmHWM") - before - result.nbytes) / 1e6


def _resident(entry: str) -> int:
    """Bytes in memory: now (VmRSS), or at the peak (VmHWM).

    `resource.getrusage` will not do: its peak counts the process that this one was forked from.
    """
    lines = Path("/proc/self/status").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith(f"{entry}:"))


# --- the table ----------------------------------------------------------------------------


def _targets(rows: list[Row], memory: float, many: int | None) -> list[Target]:
    row = {row.what: row for row in rows}

    def bounded(what: str, bound: str, value: float, form: str, met: bool) -> Target:
        if math.isnan(value):
            return Target(what, bound, "-", None)
        return Target(what, bound, form.format(value), met)

    solve_ivp, diffrax = row[SOLVE_IVP].ratio, row[DIFFRAX].ratio
    paper, fast, scalar = row[PAPER].microseconds, row[AT_FAST].ratio, 1 / row[QUAD].ratio
    size = "large call" if many is None else f"{many:.0e} launches"
    return [
        bounded("times faster than solve_ivp", ">= 1500", solve_ivp, "{:.0f}", solve_ivp >= 1500),
        bounded("times faster than diffrax", ">= 30", diffrax, "{:.1f}", diffrax >= 30),
        bounded(f"microseconds, v_norm to {V_PAPER:g}", "<= 3.5", paper, "{:.2f}", paper <= 3.5),
        bounded("one call, over quad + Newton", "<= 0.1", scalar, "{:.3f}", scalar <= 0.1),
        bounded(f"v_norm {V_FAST:.0e}, over v_norm 1", "<= 3", fast, "{:.2f}", fast <= 3),
        bounded(f"MB above in and out, {size}", "<= 300", memory, "{:.0f}", memory <= 300),
    ]


def _conditions(rounds: int, few: int, core: bool) -> str:
    where = "one core" if core else "not held to one core"
    return (
        f"{versions()}; {platform.system()} {platform.machine()}, {where}; {rounds} rounds; "
        f"errors over {few} launches"
    )


def versions() -> str:
    """The versions of Python, and of what is installed of the packages that are measured.

    Returns
    -------
    str
        Names and versions, separated by commas.

    Examples
    --------
    >>> versions().split(", ")[2].split()[0]
    'numpy'
    """
    found = [f"Python {platform.python_version()}"]
    for name in PACKAGES:
        with contextlib.suppress(PackageNotFoundError):
            found.append(f"{name} {version(name)}")
    return ", ".join(found)


def speed_table(speed: Speed) -> str:
    """What was measured as plain text: the rows, then the targets.

    Parameters
    ----------
    speed : Speed
        What `measure` gave.

    Returns
    -------
    str
        Two tables, and what they mean.
    """
    width = max(len(row.what) for row in speed.rows)
    lines = [f"{'':<{width}}{'launches':>10}{'µs a launch':>13}{'max error':>11}{'time over':>11}"]
    for row in speed.rows:
        lead = f"{row.what:<{width}}{row.launches:>10}"
        if row.note:
            lines.append(f"{lead}  {row.note}")
            continue
        ratio = "" if row.what == row.to else f"{row.ratio:>11.3g} {row.to}"
        lines.append(f"{lead}{row.microseconds:>13.4g}{row.error:>11.1e}{ratio}")
    width = max(len(target.what) for target in speed.targets)
    lines += ["", f"{'target':<{width}}{'bound':>9}{'measured':>10}"]
    verdicts = {True: "met", False: "missed", None: "not measured"}
    for target in speed.targets:
        lines.append(
            f"{target.what:<{width}}{target.bound:>9}{target.measured:>10}  {verdicts[target.met]}"
        )
    lines += [
        "",
        "Launches are spread evenly in v_norm (log: in its logarithm), and in alpha0 from "
        f"{LOW_DEG:g} to {HIGH_DEG:g}",
        "degrees; those flown one by one are the first of the same. solve_ivp is DOP853 at",
        "1e-10/1e-13; diffrax is Dopri8 at 1e-13/1e-16, with jit and vmap. Times are medians over",
        "the rounds, 'time over' the median of the ratios within a round. Errors are relative,",
        f"against mpmath at {DIGITS} digits.",
        textwrap.fill(speed.conditions, 96),
    ]
    return "\n".join(lines) + "\n"


def csv_text(speed: Speed) -> str:
    """The rows and the targets as CSV.

    Parameters
    ----------
    speed : Speed
        What `measure` gave.

    Returns
    -------
    str
        The content of the file.
    """
    stream = io.StringIO()
    stream.write(f"# {speed.conditions}\n# remade by: {COMMAND} --out DIR\n")
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow(["what", "launches", "microseconds", "max_error", "ratio", "ratio_to", "note"])
    for row in speed.rows:
        figures = (f"{value:.4g}" for value in (row.microseconds, row.error, row.ratio))
        rows.writerow([row.what, row.launches, *figures, row.to, row.note])
    for target in speed.targets:
        stream.write(f"# target: {target.what} {target.bound}; measured {target.measured}\n")
    return stream.getvalue()
