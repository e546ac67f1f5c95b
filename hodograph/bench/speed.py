"""How quick d_norm is beside a few other ways, and the memory it takes, held to bounds.

The measurement is that of `work_precision`, on more kinds of launches and with fewer ways.
"""

import math
import os
import platform
import subprocess
import sys
import textwrap
from dataclasses import dataclass
from pathlib import Path

from hodograph.bench import measurement, methods, packages
from hodograph.bench.measurement import DIGITS, Domain, Measurement, Sizes, Way, log
from hodograph.bench.methods import one_by_one
from hodograph.level import d_norm
from hodograph.report import clock, folder, tables
from hodograph.report.versions import versions

COMMAND = "hodograph bench speed --out ."
FILE = "speed.csv"
MANY = 10_000_000  # launches in the call whose memory is measured
SIZES = Sizes(many=10_000, each=50, few=0, checked=50, seconds=8.0, rounds=21)

MIXED = Domain("v_norm 0.1-20", (0.1, 20.0))
MIXED_LOG = Domain("v_norm 0.1-20, log", (0.1, 20.0), log=True)
PAPER, AT_ONE = Domain("v_norm 0.1-1.5", (0.1, 1.5)), Domain("v_norm 1", (1.0, 1.0))
AT_FAST = Domain("v_norm 1e8", (1e8, 1e8))
ENGINE, SCALAR = "d_norm", "d_norm, one launch a call"
SOLVE_IVP, QUAD, DIFFRAX = "solve_ivp", "quad + Newton, one launch a call", "diffrax"


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

    rows: list[Measurement]
    targets: list[Target]
    conditions: str


def _entries(sizes: Sizes) -> list[tuple[Domain, Way]]:
    engine = Way(ENGINE, "", d_norm, sizes.many, checked=True)
    solve_ivp, quad, scalar = (
        Way(name, "", one_by_one(compute), sizes.each, checked=True)
        for name, compute in (
            (SOLVE_IVP, methods.by_solve_ivp),
            (QUAD, methods.by_quad),
            (SCALAR, d_norm),
        )
    )
    mixed = [engine, solve_ivp, scalar, quad]
    diffrax = packages.by_diffrax()
    if diffrax is not None:
        mixed.append(Way(DIFFRAX, "", diffrax, sizes.many, checked=True))
    return [
        *((MIXED, way) for way in mixed),
        (MIXED_LOG, engine),
        (MIXED_LOG, solve_ivp),
        *((where, engine) for where in (PAPER, AT_ONE, AT_FAST)),
    ]


def measure(sizes: Sizes = SIZES, *, many: int | None = MANY) -> Speed:
    """Time d_norm and others, and find the memory that a call with `many` launches takes.

    With None that call is left out.
    """
    with clock.one_core() as core:
        rows = measurement.measure(_entries(sizes), sizes)
    memory = math.nan
    if many is not None:
        log.info(f"memory of one call with {many} launches")
        memory = peak_memory(many)
    where = "one core" if core else "not held to one core"
    conditions = (
        f"{versions(*measurement.PACKAGES)}; {platform.system()} {platform.machine()}, {where}; "
        f"{sizes.rounds} rounds; errors over {sizes.checked} launches"
    )
    return Speed(rows, _targets(rows, memory, many), conditions)


# --- memory -------------------------------------------------------------------------------


def peak_memory(count: int) -> float:
    """MB that one call of d_norm takes at its peak, above the arrays in and out.

    Measured in a process of its own by the operating system; NaN where that does not say (Linux
    does).
    """
    script = "from hodograph.bench import speed; print(speed._growth(int(input())))"
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
    inputs = MIXED.launches(count)
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


def _targets(rows: list[Measurement], memory: float, many: int | None) -> list[Target]:
    row = {(row.domain, row.family): row for row in rows}
    engine = {name: row[name, ENGINE] for name, family in row if family == ENGINE}
    mixed = engine[MIXED.name]

    def times(family: str) -> float:
        slow = row.get((MIXED.name, family))
        return math.nan if slow is None else slow.over(mixed)

    def most(what: str, bound: float, value: float, form: str, *, least: bool = False) -> Target:
        limit = f"{'>=' if least else '<='} {bound:g}"
        if math.isnan(value):
            return Target(what, limit, "-", None)
        return Target(what, limit, form.format(value), value >= bound if least else value <= bound)

    paper = engine[PAPER.name].microseconds
    scalar = row[MIXED.name, SCALAR].over(row[MIXED.name, QUAD])
    fast = engine[AT_FAST.name].over(engine[AT_ONE.name])
    size = "large call" if many is None else f"{many:.0e} launches"
    return [
        most("times faster than solve_ivp", 1500, times(SOLVE_IVP), "{:.0f}", least=True),
        most("times faster than diffrax", 30, times(DIFFRAX), "{:.1f}", least=True),
        most("microseconds, v_norm to 1.5", 3.5, paper, "{:.2f}"),
        most("one call, over quad + Newton", 0.1, scalar, "{:.3f}"),
        most("v_norm 1e8, over v_norm 1", 3, fast, "{:.2f}"),
        most(f"MB above in and out, {size}", 300, memory, "{:.0f}"),
    ]


def speed_table(speed: Speed) -> str:
    """The rows, then the targets, then what they mean, as plain text."""
    engine = {row.domain: row for row in speed.rows if row.family == ENGINE}
    rows = [
        (
            f"{row.family}, {row.domain}",
            str(row.launches),
            f"{row.microseconds:.4g}",
            f"{row.largest:.1e}",
            f"{row.over(engine[row.domain]):.3g}",
        )
        for row in speed.rows
    ]
    verdicts = {True: "met", False: "missed", None: "not measured"}
    targets = [
        (target.what, target.bound, target.measured, verdicts[target.met])
        for target in speed.targets
    ]
    words = (
        "Launches are spread evenly in v_norm (log: in its logarithm), and in "
        "alpha0 from 5 to 89.9 degrees; those flown one by one are the first "
        "of the same. solve_ivp is DOP853 at 1e-10/1e-13; diffrax is Dopri8 at 1e-13/1e-16, with "
        "jit and vmap. Times are medians over the rounds, 'over d_norm' the median of the ratios "
        f"within a round. Errors are relative, against mpmath at {DIGITS} digits."
    )
    lines = [
        *tables.plain(("", "launches", "µs a launch", "max error", "over d_norm"), rows),
        "",
        *tables.plain(("target", "bound", "measured", ""), targets, left=(0, 3)),
        "",
        textwrap.fill(words, 96),
        textwrap.fill(speed.conditions, 96),
    ]
    return "\n".join(lines) + "\n"


def bench(out: str | os.PathLike[str] | None, *, quick: bool = False, force: bool = False) -> Speed:
    """Measure, and write `FILE` into the folder `out`, if there is one.

    With `quick` the call whose memory is measured is left out.  Errors are as for
    `work_precision.bench`.
    """
    if out is not None:
        folder.check(out, [FILE], force=force)
    speed = measure(many=None if quick else MANY)
    if out is not None:
        text = measurement.csv_text(speed.rows, SIZES, COMMAND) + "".join(
            f"# target: {target.what} {target.bound}; measured {target.measured}\n"
            for target in speed.targets
        )
        for path in folder.write(out, {FILE: text}, force=force):
            log.info(f"wrote {path}")
    return speed
