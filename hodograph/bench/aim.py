"""Aim at targets in still air, beside ballistic-solver (extra ``bench``): time, and the miss."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hodograph.engine.domain import FloatArray
from hodograph.launch import Launch
from hodograph.reach import aim
from hodograph.report import clock, tables

COUNT, EACH, ROUNDS = 10_000, 200, 7
V_LIM, G = 40.0, 9.81
ARRAYS, ONE, OTHER = "aim, arrays", "aim, one shot a call", "ballistic-solver, one shot a call"


@dataclass(frozen=True, eq=False)
class Way:
    """Microseconds a shot, misses in m (median and worst), and what part was hit at all."""

    micros: float
    median: float
    worst: float
    answered: float


def scenes(count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Launch speeds, and targets on the paths of launches that rise or fall as they meet them.

    >>> v0, x, y = scenes(3)
    >>> v0.shape, bool((x > 0).all())
    ((3,), True)
    """
    rng = np.random.default_rng(1)
    v0 = V_LIM * rng.uniform(0.1, 1.5, count)
    launch = Launch(v0, rng.uniform(-0.5, 1.3, count), V_LIM, g=G)
    at = launch.at(t=rng.uniform(0.1, 1.5, count) * v0 / G)
    return v0, np.asarray(at.x), np.asarray(at.y)


def misses(v0: FloatArray, alpha0: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """How far each path passes from its target, by the state of the path at its distance."""
    state = Launch(v0, alpha0, V_LIM, g=G).at(x=x)
    return np.asarray(np.abs(state.y - y) * np.cos(state.alpha))


def by_ballistic_solver() -> Callable[[float, float, float], float] | None:
    """A function for one target by the compiled solver of ballistic-solver; None without it."""
    try:
        import ballistic_solver
    except ImportError:
        return None
    settings = ballistic_solver.BallisticParams()
    settings.g, settings.wind = G, [0.0, 0.0, 0.0]
    k = G / V_LIM**2
    solve, rest = ballistic_solver.solve, (0.0, 0.0, 0.0)

    def one(v0: float, x: float, y: float) -> float:
        found = solve((x, 0.0, y), rest, v0, k, params=settings)
        return float(found["theta"]) if found["success"] else math.nan

    return one


def measure(*, count: int = COUNT, each: int = EACH, rounds: int = ROUNDS) -> dict[str, Way]:
    """Time the ways in turn and see how far they miss."""
    v0, x, y = scenes(count)
    few = list(zip(v0[:each].tolist(), x[:each].tolist(), y[:each].tolist(), strict=True))
    other = by_ballistic_solver()
    ways: dict[str, tuple[Callable[[], Any], int]] = {
        ARRAYS: (lambda: aim(v0, x, y, V_LIM, g=G).alpha0, count),
        ONE: (lambda: [aim(*shot, V_LIM, g=G).alpha0 for shot in few], each),
    }
    if other is not None:
        ways[OTHER] = lambda: [other(*shot) for shot in few], each
    with clock.one_core():
        spent = clock.medians([run for run, _ in ways.values()], rounds)
    found = {}
    for (name, (run, units)), seconds in zip(ways.items(), spent, strict=True):
        alpha0 = np.asarray(run())
        told = ~np.isnan(alpha0)
        v0_, x_, y_ = (part[:units][told] for part in (v0, x, y))
        off = misses(v0_, alpha0[told], x_, y_)
        micros = 1e6 * seconds / units
        found[name] = Way(micros, float(np.median(off)), float(off.max()), float(told.mean()))
    return found


def targets_table(found: dict[str, Way]) -> str:
    """The ways as plain text, and below them what was aimed at."""
    rows = [
        (name, f"{way.micros:.3g}", f"{way.median:.1e}", f"{way.worst:.1e}", f"{way.answered:.3f}")
        for name, way in found.items()
    ]
    head = "way", "µs a shot", "median miss, m", "worst miss, m", "answered"
    words = (
        "Medians over the rounds, in turn, on one core. Launches of 0.1 to 1.5 times the terminal "
        f"speed, {V_LIM:g} m/s, at targets on paths of launches from -29 to 74 degrees, met "
        "climbing or falling; the low arc is asked for. ballistic-solver is of the extra bench."
    )
    return "\n".join([*tables.plain(head, rows), "", textwrap.fill(words, 90)]) + "\n"
