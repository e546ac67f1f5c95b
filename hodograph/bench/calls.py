"""One launch a call, way by way; and what a launch costs as a call takes more of them.

Programs that ask for one launch at a time (a loop, an optimizer, a frame of a game) pay for the
call itself as well as for the flight.
"""

import math
import os
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure

from hodograph import laws
from hodograph.bench import by_size, measurement, scene, targets, ways
from hodograph.bench import work_precision as look
from hodograph.bench.by_size import Cost
from hodograph.bench.measurement import DIGITS, DOMAINS, Measurement, Sizes, log
from hodograph.bench.targets import Target
from hodograph.launch import Launch
from hodograph.level import optimal_angle
from hodograph.reach import best_angle
from hodograph.report import clock, folder, style, tables

COMMAND = "hodograph bench calls"
FILES = ("calls.png", "calls.pdf", "calls.csv", "calls_by_size.csv")
SIZES = Sizes(each=100, few=0, checked=100, seconds=3.0, rounds=21)
QUICK = 10**5  # the most launches a call, when it is to be quick
FLOWN = 20  # of the launches, in calls that ask for something else than d_norm
EXPONENTS = (2.0, 1.0, 3.0)

DEFAULTS = ways.IVP.format("RK45")
RIVALS = {  # what is compared: the families, and how many times ahead d_norm is to be
    "py-ballisticcalc, compiled": (tuple(ways.BALLISTICCALC.values()), 2),
    "quad + Newton": ((ways.QUAD,), 8),
    "solve_ivp at its defaults": ((DEFAULTS,), 25),
}
OWN = ways.TIER, ways.DIAL
LABELS = {ways.TIER: "d_norm", ways.DIAL: "d_norm"}
BUILT = "Launch(...)"
LEVEL = {ways.EXACT: 45, "rtol=1e-08": 40, "rtol=1e-03": 12}  # µs, of d_norm
ASKED = {BUILT: 12, f"{BUILT}.range()": 60, f"{BUILT}.landing()": 80, "laws.d_norm_law": 8,
         "optimal_angle": 400}  # fmt: skip  # µs, n = 2
MEGABYTES = 300  # above arrays in and out, whatever their size


@dataclass(frozen=True)
class Calls:
    """One launch a call by every way; the cost by size; µs of other questions, by exponent."""

    rows: list[Measurement]
    costs: list[Cost]
    asked: dict[str, dict[str, float]]  # NaN where there is no such call
    targets: list[Target]
    conditions: str


def measure(
    sizes: Sizes = SIZES, *, counts: Sequence[int] = by_size.COUNTS, remembered: bool = True
) -> Calls:
    """Time every way one launch a call, all in turn; then d_norm in calls of `counts` launches.

    Where `remembered`, the memory of these calls is found too.
    """
    with clock.one_core() as core:
        entries = [(where, way) for where in DOMAINS for way in ways.ways_alone(sizes.each)]
        rows = measurement.measure(entries, sizes)
        asked = ask(sizes)
        costs = by_size.measure(sizes, counts, remembered=remembered)
    held = _targets(rows, costs, asked)
    return Calls(rows, costs, asked, held, targets.conditions(sizes, core=core))


def ask(sizes: Sizes) -> dict[str, dict[str, float]]:
    """Microseconds of one call for other things than d_norm, by exponent: scenes built anew."""
    v_norm, alpha0 = scene.LAUNCHES.launches(FLOWN)
    v_lim = scene.V_LIM

    def launch(v: float, a: float, n: float) -> Launch[Any]:
        return Launch(v * v_lim, a, v_lim, n=n)

    questions: dict[str, Callable[[float, float, float], object]] = {
        BUILT: launch,
        f"{BUILT}.range()": lambda v, a, n: launch(v, a, n).range(),
        f"{BUILT}.landing()": lambda v, a, n: launch(v, a, n).landing(),
        f"{BUILT}.apex()": lambda v, a, n: launch(v, a, n).apex(),
        "optimal_angle": lambda v, a, n: optimal_angle(v, n=n),
        "best_angle, from 2 m": lambda v, a, n: best_angle(v * v_lim, v_lim, n=n, height=2.0),
        "laws.d_norm_law": lambda v, a, n: laws.d_norm_law(v, a),
    }
    kinds = [
        (question, n)
        for question in questions
        for n in EXPONENTS
        if n == 2 or not question.startswith("laws")
    ]

    def call(question: str, n: float) -> Callable[[], object]:
        pairs = list(zip(v_norm.tolist(), alpha0.tolist(), strict=True))
        return lambda: [questions[question](v, a, n) for v, a in pairs]

    log.info("one call of each kind")
    spent = clock.medians([call(*kind) for kind in kinds], sizes.rounds, seconds=sizes.seconds)
    found = {question: {f"n={n:g}": math.nan for n in EXPONENTS} for question in questions}
    for (question, n), seconds in zip(kinds, spent, strict=True):
        found[question][f"n={n:g}"] = 1e6 * seconds / FLOWN
    return found


# --- the targets --------------------------------------------------------------------------


def _targets(
    rows: list[Measurement], costs: list[Cost], asked: dict[str, dict[str, float]]
) -> list[Target]:
    found = []
    for where in dict.fromkeys(row.domain for row in rows):
        own = [row for row in rows if row.domain == where]
        for name, (families, bound) in RIVALS.items():
            for ours, words in ((OWN, "no larger an error"), ((ways.TIER,), "exact")):
                what = f"{where}: times ahead of {name}, {words}"
                found.append(targets.at_least(what, bound, ahead(own, families, ours)))
        for setting, bound in LEVEL.items():
            (row,) = (row for row in own if row.family in OWN and row.setting == setting)
            found.append(targets.at_most(f"{where}: µs, {setting}", bound, row.microseconds))
    for name, bound in ASKED.items():
        found.append(targets.at_most(f"µs of {name}", bound, asked[name]["n=2"]))
    most = max(cost.launches for cost in costs)
    taken = max(cost.megabytes for cost in costs)
    found.append(targets.at_most(f"MB above in and out, {most:.0e} launches", MEGABYTES, taken))
    return found


def ahead(rows: Sequence[Measurement], families: Sequence[str], own: Sequence[str] = OWN) -> float:
    """How many times as long as d_norm these take on one set of launches, at their best setting.

    Each setting is set beside the quickest of `own` with no larger an error.  0 if there is none;
    NaN if none of the families was measured.
    """

    def ratio(theirs: Measurement) -> float:
        ours = [row for row in rows if row.family in own and row.largest <= theirs.largest]
        quickest = min(ours, key=lambda row: row.microseconds, default=None)
        return 0.0 if quickest is None else theirs.over(quickest)

    theirs = [row for row in rows if row.family in families and row.general]
    return min(map(ratio, theirs), default=math.nan)


# --- the tables ---------------------------------------------------------------------------


def calls_table(calls: Calls) -> str:
    """The ways, the cost by size, what else one call costs, and the targets, as plain text."""
    lines = []
    for name in dict.fromkeys(row.domain for row in calls.rows):
        heads = (measurement.domain_words(name), "µs a call", "over exact", "max error", "failed")
        own = [row for row in calls.rows if row.domain == name]
        (exact,) = (row for row in own if row.setting == ways.EXACT)
        ways_ = [
            (
                f"{LABELS.get(row.family, row.family)}, {row.setting}".rstrip(", "),
                f"{row.microseconds:.3g}",
                f"{row.over(exact):.3g}",
                f"{row.largest:.1e}",
                f"{row.failed:.0%}",
            )
            for row in own
        ]
        lines += [*tables.plain(heads, ways_), ""]
    lines += [*by_size.lines(calls.costs), "", *_asked_lines(calls.asked), ""]
    words = (
        "One launch a call, as plain numbers, but where it says launches a call. Times are medians "
        "over the rounds, 'over exact' the median of the ratios within a round; errors are "
        f"relative, of d_norm, against mpmath at {DIGITS} digits. py-ballisticcalc has its "
        "compiled engines; solve_ivp has units and a first step that suit the flight. MB: at the "
        "peak of a first call, above the arrays in and out. Times ahead: the least over the "
        "other's settings, each beside the quickest of d_norm with no larger an error, or beside "
        "exact answers."
    )
    lines += [*targets.lines(calls.targets), ""]
    lines += [textwrap.fill(words, 96), textwrap.fill(calls.conditions, 96)]
    return "\n".join(lines) + "\n"


def _asked_lines(asked: dict[str, dict[str, float]]) -> list[str]:
    columns = list(next(iter(asked.values())))
    rows = [(name, *(tables.number(row[n]) for n in columns)) for name, row in asked.items()]
    return tables.plain(("µs a call", *columns), rows)


# --- the figure ---------------------------------------------------------------------------

WIDTH, HEIGHT = 25, 14  # cm
KEY = {ways.TIER: "d_norm, exact", ways.DIAL: "d_norm(rtol=...)"}
LINES = dict(zip(by_size.DIALS, ((look.RED, 6), (look.BLUE, 6), (look.GREEN, -14)), strict=True))


def figure(calls: Calls) -> Figure:
    """Error against the time of a call, and the time of a launch against launches a call."""
    drawn = style.new_figure(HEIGHT, WIDTH)
    left, right = drawn.subplots(1, 2)
    own = [row for row in calls.rows if row.domain == DOMAINS[0].name]
    look.panel(left, own)
    style.title(left, f"one launch a call\n{measurement.domain_words(DOMAINS[0].name)}")
    left.set_xlabel("time a call, µs", fontsize=style.TEXT)
    left.set_ylabel("relative error of d_norm", fontsize=style.TEXT)
    _draw_costs(right, calls.costs)
    for place, (name, (families, _)) in enumerate(RIVALS.items()):
        times = [row.microseconds for row in own if row.family in families and row.general]
        if times:
            right.axhline(min(times), color=style.GREY, linestyle=":", linewidth=1)
            at = 1 - 0.4 * (place % 2), min(times)  # so that two of one height do not cover another
            where = right.get_yaxis_transform()
            style.note(right, name, at, (-4, 2), ha="right", color=style.GREY, xycoords=where)
    shown = (row.family for row in own)
    style.legend(drawn, handles=look.key(shown, KEY), loc="outside lower center", ncols=3)
    return drawn


def _draw_costs(axes: Any, costs: list[Cost]) -> None:
    for name, (colour, up) in LINES.items():
        own = [cost for cost in costs if cost.setting == name]
        counts, times = [[cost[at] for cost in own] for at in (1, 2)]
        axes.plot(counts, times, color=colour, marker="o", markersize=4, linewidth=style.LINE)
        megabytes = own[-1].megabytes
        words = name if math.isnan(megabytes) else f"{name}, {megabytes:.0f} MB"
        style.note(axes, words, (counts[-1], times[-1]), (0, up), ha="right", color=colour)
    axes.set(xscale="log", yscale="log")
    look.decades(axes)
    style.title(axes, "d_norm of arrays, and its memory in the largest\ndotted: one launch a call")
    axes.set_xlabel("launches a call", fontsize=style.TEXT)
    axes.set_ylabel("time a launch, µs", fontsize=style.TEXT)


# --- the files ----------------------------------------------------------------------------


def bench(out: str | os.PathLike[str], *, quick: bool = False, force: bool = False) -> Calls:
    """Measure, and write `FILES` into the folder `out`.

    With `quick` no call takes more than `QUICK` launches.  Errors are as for
    `work_precision.bench`.
    """
    folder.check(out, FILES, force=force)
    calls = measure(counts=[count for count in by_size.COUNTS if not quick or count <= QUICK])
    ways_text = measurement.csv_text(calls.rows, SIZES, COMMAND) + targets.comments(calls.targets)
    contents = style.files("calls", figure(calls), dpi=look.DPI)
    texts: dict[str, bytes | str] = {
        "calls.csv": ways_text,
        "calls_by_size.csv": by_size.csv_text(calls.costs, COMMAND),
    }
    for path in folder.write(out, texts | contents, force=force):
        log.info(f"wrote {path}")
    return calls
