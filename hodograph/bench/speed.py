"""How quick d_norm is on arrays, beside other ways to high accuracy, held to bounds.

The measurement is that of `work_precision`, on more kinds of launches and with fewer ways; `calls`
has one launch a call, and what the number of launches changes.
"""

import math
import os
import textwrap
from dataclasses import dataclass

from hodograph.bench import measurement, methods, packages, targets
from hodograph.bench.measurement import DIGITS, Domain, Measurement, Sizes, Way, log
from hodograph.bench.methods import one_by_one
from hodograph.bench.targets import Target
from hodograph.level import d_norm
from hodograph.report import clock, folder, tables

COMMAND = "hodograph bench speed --out ."
FILE = "speed.csv"
SIZES = Sizes(many=10_000, each=50, few=0, checked=50, seconds=8.0, rounds=21)

MIXED = Domain("v_norm 0.1-20", (0.1, 20.0))
MIXED_LOG = Domain("v_norm 0.1-20, log", (0.1, 20.0), log=True)
PAPER, AT_ONE = Domain("v_norm 0.1-1.5", (0.1, 1.5)), Domain("v_norm 1", (1.0, 1.0))
AT_FAST = Domain("v_norm 1e8", (1e8, 1e8))
ENGINE, SOLVE_IVP, DIFFRAX = "d_norm", "solve_ivp", "diffrax"


@dataclass(frozen=True)
class Speed:
    """The rows, the targets, and where and how they were measured."""

    rows: list[Measurement]
    targets: list[Target]
    conditions: str


def _entries(sizes: Sizes) -> list[tuple[Domain, Way]]:
    engine = Way(ENGINE, "", d_norm, sizes.many, checked=True)
    solve_ivp = Way(SOLVE_IVP, "", one_by_one(methods.by_solve_ivp), sizes.each, checked=True)
    mixed = [engine, solve_ivp]
    diffrax = packages.by_diffrax()
    if diffrax is not None:
        mixed.append(Way(DIFFRAX, "", diffrax, sizes.many, checked=True))
    return [
        *((MIXED, way) for way in mixed),
        (MIXED_LOG, engine),
        (MIXED_LOG, solve_ivp),
        *((where, engine) for where in (PAPER, AT_ONE, AT_FAST)),
    ]


def measure(sizes: Sizes = SIZES) -> Speed:
    """Time d_norm of arrays, and others."""
    with clock.one_core() as core:
        rows = measurement.measure(_entries(sizes), sizes)
    return Speed(rows, _targets(rows), targets.conditions(sizes, core=core))


# --- the table ----------------------------------------------------------------------------


def _targets(rows: list[Measurement]) -> list[Target]:
    row = {(row.domain, row.family): row for row in rows}
    engine = {name: row[name, ENGINE] for name, family in row if family == ENGINE}

    def times(family: str) -> float:
        slow = row.get((MIXED.name, family))
        return math.nan if slow is None else slow.over(engine[MIXED.name])

    paper = engine[PAPER.name].microseconds
    fast = engine[AT_FAST.name].over(engine[AT_ONE.name])
    return [
        targets.at_least("times faster than solve_ivp", 1500, times(SOLVE_IVP)),
        targets.at_least("times faster than diffrax", 30, times(DIFFRAX)),
        targets.at_most("microseconds, v_norm to 1.5", 1.0, paper),
        targets.at_most("v_norm 1e8, over v_norm 1", 3, fast),
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
        *targets.lines(speed.targets),
        "",
        textwrap.fill(words, 96),
        textwrap.fill(speed.conditions, 96),
    ]
    return "\n".join(lines) + "\n"


def bench(out: str | os.PathLike[str] | None, *, force: bool = False) -> Speed:
    """Measure, and write `FILE` into the folder `out`, if there is one.

    Errors are as for `work_precision.bench`.
    """
    if out is not None:
        folder.check(out, [FILE], force=force)
    speed = measure()
    if out is not None:
        text = measurement.csv_text(speed.rows, SIZES, COMMAND) + targets.comments(speed.targets)
        for path in folder.write(out, {FILE: text}, force=force):
            log.info(f"wrote {path}")
    return speed
