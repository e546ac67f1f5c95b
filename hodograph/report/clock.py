"""Calls timed in turn, round by round, so that a busy machine delays all alike."""

import contextlib
import logging
import math
import os
import statistics
import sys
import time
from collections.abc import Callable, Iterator, Sequence

log = logging.getLogger("hodograph")


def in_turn(
    calls: Sequence[Callable[[], object]], rounds: int, *, seconds: float = math.inf
) -> list[dict[int, float]]:
    """Seconds that each call takes, by the number of the round.

    A call that may take no more than so many `seconds` in all, and is slow, takes part in every
    k-th round only.  One that compiles is to be called once before.

    >>> quick, slow = in_turn([lambda: None, lambda: time.sleep(0.01)], 8, seconds=0.02)
    >>> len(quick), 1 <= len(slow) <= 2
    (8, True)
    """
    spent: list[dict[int, float]] = [{} for _ in calls]
    every = [1] * len(calls)
    for turn in range(rounds):
        for index, call in enumerate(calls):
            if turn % every[index] == 0:
                begun = time.perf_counter()
                call()
                spent[index][turn] = time.perf_counter() - begun
                if turn == 0:
                    every[index] = max(1, math.ceil(rounds * spent[index][turn] / seconds))
        if (turn + 1) % 5 == 0 or turn + 1 == rounds:
            log.info(f"round {turn + 1} of {rounds}")
    return spent


def medians(
    calls: Sequence[Callable[[], object]], rounds: int, *, seconds: float = math.inf
) -> list[float]:
    """Seconds that each call takes: the median over the rounds of `in_turn`."""
    spent = in_turn(calls, rounds, seconds=seconds)
    return [statistics.median(own.values()) for own in spent]


@contextlib.contextmanager
def one_core() -> Iterator[bool]:
    """Keep this thread, and those that it starts, on one core; False if that cannot be."""
    if sys.platform != "linux":
        yield False
        return
    allowed = os.sched_getaffinity(0)
    try:
        os.sched_setaffinity(0, {max(allowed)})
    except OSError:
        yield False
        return
    try:
        yield True
    finally:
        os.sched_setaffinity(0, allowed)
