"""What a launch costs as a call takes more of them: its time, and the memory of the call."""

import math
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from hodograph.bench import measurement
from hodograph.bench.measurement import DOMAINS, Sizes, log
from hodograph.bench.methods import one_by_one
from hodograph.level import d_norm
from hodograph.report import clock, tables

DIALS = {"exact": None, "rtol=1e-08": 1e-8, "rtol=1e-03": 1e-3}
COUNTS = (1, 3, 10, 30, 100, 300, 1000, 10**4, 10**5, 10**6, 10**7)  # launches a call
LEAST = 300  # launches timed together, in as many calls as they need


class Cost(NamedTuple):
    """What a launch costs in calls of so many."""

    setting: str
    launches: int
    microseconds: float  # a launch
    megabytes: float  # at the peak of a first call, above arrays in and out; NaN: not measured


def measure(sizes: Sizes, counts: Sequence[int], *, remembered: bool) -> list[Cost]:
    """The time a launch, and the memory of a call, by how many launches it takes."""
    kinds = [(name, count) for name in DIALS for count in counts]
    repeats = {count: math.ceil(LEAST / count) for count in counts}
    v_norm, alpha0 = DOMAINS[0].launches(max(count * repeats[count] for count in counts))

    def call(name: str, count: int) -> Callable[[], object]:
        compute = partial[Any](d_norm, rtol=DIALS[name])
        ends = range(count, count * repeats[count] + 1, count)
        if count == 1:  # a plain number, as it comes
            return partial(one_by_one(compute), v_norm[: ends[-1]], alpha0[: ends[-1]])
        parts = [(v_norm[end - count : end], alpha0[end - count : end]) for end in ends]
        return lambda: [compute(*part) for part in parts]

    log.info("launches a call")
    spent = clock.medians([call(*kind) for kind in kinds], sizes.rounds, seconds=sizes.seconds)
    found = []
    for (name, count), seconds in zip(kinds, spent, strict=True):
        if remembered:
            log.info(f"memory of {count} launches, {name}")
        megabytes = peak_memory(count, DIALS[name]) if remembered else math.nan
        found.append(Cost(name, count, 1e6 * seconds / count / repeats[count], megabytes))
    return found


def lines(costs: Iterable[Cost]) -> list[str]:
    """Microseconds a launch, and MB, as the lines of a table."""
    found = {(cost.setting, cost.launches): cost for cost in costs}
    rows = [
        (
            f"{count:,}",
            *(tables.number(found[name, count].microseconds) for name in DIALS),
            *(tables.number(found[name, count].megabytes, ".0f") for name in DIALS),
        )
        for count in dict.fromkeys(count for _, count in found)
    ]
    heads = (*(f"µs, {name}" for name in DIALS), *(f"MB, {name}" for name in DIALS))
    return tables.plain(("launches a call", *heads), rows, left=())


def csv_text(costs: Iterable[Cost], command: str) -> str:
    """The cost by size as CSV."""
    about = (
        "d_norm: microseconds a launch in calls of so many, and MB of a first call at its peak",
        measurement.domain_words(DOMAINS[0].name),
    )
    rows = ((name, count, f"{time:.4g}", f"{mb:.3g}") for name, count, time, mb in costs)
    return tables.csv_text(about, Cost._fields, rows, command=command)


# --- memory -------------------------------------------------------------------------------


def peak_memory(count: int, rtol: float | None = None) -> float:
    """MB that a first call of d_norm takes at its peak, above the arrays in and out.

    Measured in a process of its own by the operating system; NaN where that does not say (Linux
    does).
    """
    script = f"from hodograph.bench import by_size; print(by_size._growth({count}, {rtol}))"
    return in_a_process(script, f"the call with {count} launches")


def in_a_process(script: str, what: str) -> float:
    """The number that a script prints, run in a process of its own; `what` it is, if it fails."""
    child = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    if child.returncode:
        problem = (child.stderr.strip().splitlines() or ["no message"])[-1]
        raise RuntimeError(f"{what} failed: {problem}")
    return float(child.stdout)


def _growth(count: int, rtol: float | None) -> float:
    """The peak of this process in a first call, above what it held before and the array out."""
    inputs = DOMAINS[0].launches(count)
    before = resident("VmRSS")
    result = d_norm(*inputs, rtol=rtol)
    return resident("VmHWM") - before - result.nbytes / 1e6


def resident(entry: str) -> float:
    """MB in memory: now (VmRSS), or at the peak (VmHWM); NaN where the system does not say.

    `resource.getrusage` will not do: its peak counts the process that this one was forked from.
    """
    if sys.platform != "linux":
        return math.nan
    lines = Path("/proc/self/status").read_text().splitlines()
    return 1.024e-3 * next(int(line.split()[1]) for line in lines if line.startswith(f"{entry}:"))
