"""What each element of a scene costs: quantity by quantity, drag law by drag law."""

import math
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from hodograph.bench.measurement import Domain
from hodograph.engine.domain import FloatArray
from hodograph.launch import Launch
from hodograph.level import landing_angle
from hodograph.report import clock, tables

COUNT, PATHS, ROUNDS = 10_000, 200, 7
LAUNCHES, V_LIM = Domain("scene", (0.1, 3.0)), 42.7  # m/s
PART = 0.5  # of the height of the apex: how far the landing is below, or above
POINTS = (10, 100)


@dataclass(frozen=True, eq=False)
class Scene:
    """Microseconds: `costs[quantity][scene]`; NaN where no function gives the quantity alone."""

    costs: dict[str, dict[str, float]]
    count: int
    paths: int
    rounds: int


def scenes(count: int) -> dict[str, Launch]:
    """The launches of each column: drag laws onto level ground, then other landing heights.

    >>> list(scenes(2))
    ['n=2', 'n=1', 'n=3', 'n=1.5', 'vacuum', 'below', 'above']
    """
    v_norm, alpha0 = LAUNCHES.launches(count)
    v0 = V_LIM * v_norm
    found = {f"n={n:g}": Launch(v0, alpha0, V_LIM, n=n) for n in (2.0, 1.0, 3.0, 1.5)}
    found["vacuum"] = Launch(v0, alpha0, math.inf)
    height = PART * found["n=2"].apex()[1]
    found["below"] = Launch(v0, alpha0, V_LIM, height=height)
    found["above"] = Launch(v0, alpha0, V_LIM, height=-height)
    return found


def _quantities() -> dict[str, Callable[[Launch], Any]]:
    """Each takes the launches and computes one quantity, or several."""

    def angle(launch: Launch) -> FloatArray:
        return np.asarray(landing_angle(launch.v_norm, launch.alpha0, n=launch.n))

    return {
        "range": lambda launch: launch.range(),
        "flight_time": lambda launch: launch.flight_time(),
        "landing_angle": angle,
        "apex": lambda launch: launch.apex(),
        "landing, all of it": lambda launch: launch.landing(),
        "landing and apex": lambda launch: (launch.landing(), launch.apex()),
    }


def measure(*, count: int = COUNT, paths: int = PATHS, rounds: int = ROUNDS) -> Scene:
    """Time each quantity in each scene, turn by turn: per launch, or per point of a trajectory.

    Arrays are of `count` launches, and of `paths` where trajectories are asked for.
    """
    many, fewer = scenes(count), scenes(paths)
    work: dict[tuple[str, str], tuple[Callable[[], Any], int]] = {}
    for quantity, compute in _quantities().items():
        for name, launch in many.items():
            if quantity == "landing_angle" and np.any(launch.height):
                continue  # it is a function of level ground
            work[quantity, name] = partial(compute, launch), count
    for n in POINTS:
        for name, launch in fewer.items():
            work[f"trajectory({n}), a point", name] = partial(launch.trajectory, n), paths * n
    with clock.one_core():
        spent = clock.medians([run for run, _ in work.values()], rounds)
    costs = {quantity: dict.fromkeys(many, math.nan) for quantity, _ in work}
    for ((quantity, name), (_, units)), seconds in zip(work.items(), spent, strict=True):
        costs[quantity][name] = 1e6 * seconds / units
    return Scene(costs, count, paths, rounds)


def scene_table(scene: Scene) -> str:
    """The times as plain text, and below them what the rows and columns are."""
    columns = list(next(iter(scene.costs.values())))
    rows = [
        (quantity, *(tables.number(row[name]) for name in columns))
        for quantity, row in scene.costs.items()
    ]
    lines = tables.plain(("µs a launch", *columns), rows)
    words = (
        f"Medians of {scene.rounds} rounds, on one core, over {scene.count} launches "
        f"({scene.paths} for trajectories) with v_norm from 0.1 to 3 and alpha0 "
        "from 5 to 89.9 degrees. Landing on level ground; with n = 2 also below "
        f"the launch, by {PART:g} of the height of the apex, and as far above it. A dash: the "
        "quantity has no call of its own there, and comes with the landing."
    )
    return "\n".join([*lines, "", textwrap.fill(words, 90)]) + "\n"
