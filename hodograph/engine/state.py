"""The state of a flight where it is asked for, seen from the ground, as kernels of the driver."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from hodograph.engine import domain, ground, march, wind
from hodograph.engine.domain import MOST, RIGHT_ANGLE, FloatArray, Rule
from hodograph.engine.driver import Codes, Kernel
from hodograph.engine.extremes import REST
from hodograph.engine.fields import Scene
from hodograph.engine.flight import EPSILON
from hodograph.engine.goal import Found, Goal
from hodograph.engine.status import Status
from hodograph.engine.velocity import slope_drop
from hodograph.engine.wind import Frame

ROWS = ("t", "x", "y", "z", "speed", "alpha", "s")
# What a state may be asked by.
PLACES = {
    "t": Rule("in [0, 1e30] s", lambda a: (a >= 0) & (a <= MOST)),
    "x": domain.HEIGHT,
    "y": domain.HEIGHT,
    "s": Rule("in [0, 1e30] m", lambda a: (a >= 0) & (a <= MOST)),
    "alpha": domain.SLOPE_ANGLE,
}


def chosen(places: dict[str, Any], rising: Any, launch: Scene[Any]) -> tuple[str, Any]:
    """The one place that is given, by its name."""
    given = [name for name, value in places.items() if value is not None]
    if len(given) != 1:
        raise TypeError(
            f"give exactly one of {', '.join(places)}; got {', '.join(given) or 'none'}"
        )
    (name,) = given
    if rising is not None and (name != "y" or not isinstance(rising, bool | np.bool_)):
        raise TypeError(f"rising goes with y, and is True or False; got {rising!r} with {name}")
    if name == "alpha" and (np.any(launch.wind) or np.any(launch.crosswind)):
        raise ValueError(
            "alpha is no place in a wind: over the ground a path may have a slope twice, or never"
        )
    return name, places[name]


def states(place: str, rising: bool = False) -> Kernel:
    """The kernel that gives `ROWS` at a place: "t", "x", "y", "s" or "alpha"; see `_state`."""
    return partial(_state, place, rising)


@np.errstate(all="ignore")  # elements to which another case applies
def _state(place: str, rising: bool, *scene: FloatArray) -> tuple[Sequence[FloatArray], Codes]:
    v0, alpha0, v_lim, g, height, n, _slope, along, across, value = scene
    air = wind.frame(v0, alpha0, along, across)
    above = value - height
    time = {
        "t": value,
        "x": np.divide(np.abs(value), np.abs(along), out=np.zeros_like(v0), where=along != 0),
        "y": np.sqrt(np.abs(above) / g),
        "s": np.sqrt(value / g),
        "alpha": np.zeros_like(v0),
    }[place]
    own = units(air, v_lim, g, time)
    nil, one = np.zeros_like(v0), np.ones_like(v0)
    never = np.zeros(v0.shape, bool)
    if place == "alpha":
        delta = np.maximum(slope_drop(np.cos(alpha0), alpha0, value), 0.0)
        never = (value > alpha0) | ((v0 == 0) | (value == -RIGHT_ANGLE)) & (value != alpha0)
        found = march.at_slope(own.v, alpha0, np.where(never, 0.0, delta), n)
    else:
        if place == "t":
            goal = Goal(nil, nil, one, nil, value / own.time, one)
        elif place == "s":
            goal = Goal(nil, nil, nil, one, value / own.length, one)
        elif place == "y":
            goal = Goal(nil, one, nil, nil, above / own.length, one if rising else -one)
        else:
            backward = value < 0
            blown = np.where(v_lim < np.inf, along, 0.0)
            never = backward & (blown >= 0) | (value != 0) & (air.v_x == 0) & (blown == 0)
            way = np.where(backward, -1.0, 1.0)
            in_x, in_t = drawn(own, air)
            goal = Goal(in_x, nil, in_t, nil, value / own.length, way)
        found = march.follow(own.v, air.alpha0, n, goal, lag=not wind.is_still(air))
    rows = over_ground(own, air, found, height)
    start = (nil, nil, height, nil, v0, alpha0, nil)
    rows = [np.where(rows[0] == 0, first, row) for first, row in zip(start, rows, strict=True)]
    if place in ("y", "alpha"):
        rows[2 if place == "y" else 5] = value
    codes = np.where(never, np.int8(Status.UNREACHABLE), found.status)
    return rows, codes


class Units(NamedTuple):
    """The units of a launch, at a speed that can be computed with."""

    v: FloatArray
    speed: FloatArray  # in m/s
    time: FloatArray  # in s
    length: FloatArray  # in m
    rest: FloatArray  # the true speed over that one, a factor of what is level


def units(air: Frame, v_lim: FloatArray, g: FloatArray, time: FloatArray) -> Units:
    """Launches almost at rest are those of a speed that a fall of so long a time forgets."""
    speed = np.maximum(air.speed, REST * np.minimum(g * time, v_lim))
    speed = np.where(speed > 0, speed, np.minimum(v_lim, 1.0))
    return Units(speed / v_lim, speed, speed / g, speed * (speed / g), air.speed / speed)


def drawn(own: Units, air: Frame) -> tuple[FloatArray, FloatArray]:
    """What x over the ground is made of, in terms of x and t in the air: of t alone in vacuum."""
    empty = own.v == 0
    in_t = np.where(empty, air.v_x, air.wind) / own.speed
    return np.where(empty, 0.0, air.along * own.rest), in_t


def distance(own: Units, air: Frame, found: Found) -> tuple[FloatArray, FloatArray]:
    """x over the ground in a wind, and how large its terms are: the smaller ones of two forms."""
    t, lag = found.t * own.time, found.lag * own.time
    own_way, drift = air.along * found.x * own.length * own.rest, air.wind * t
    straight, late = air.v_x * t, air.ahead * lag
    carried, behind = np.abs(own_way) + np.abs(drift), np.abs(straight) + np.abs(late)
    first = (carried <= behind) | (air.wind == 0)
    return np.where(first, own_way + drift, straight - late), np.where(first, carried, behind)


def over_ground(own: Units, air: Frame, found: Found, height: FloatArray) -> list[FloatArray]:
    """`ROWS` over the ground."""
    t = found.t * own.time
    slowed = found.v_x / np.cos(air.alpha0)
    x, z, v_x, v_z = found.x * own.length * own.rest, 0 * t, air.v_x * slowed, 0 * t
    if not wind.is_still(air):
        lost = 1 - slowed
        x, _ = distance(own, air, found)
        z, v_z = air.crosswind * found.lag * own.time, air.crosswind * lost
        v_x = v_x + air.wind * lost
    level, v_y = np.hypot(v_x, v_z), found.v_y * own.speed
    return [
        t,
        x,
        height + found.y * own.length,
        z,
        np.hypot(level, v_y),
        np.arctan2(v_y, level),
        found.s * own.length,
    ]


@np.errstate(all="ignore")
def apexes(*scene: FloatArray) -> tuple[Sequence[FloatArray], Codes]:
    """The kernel that gives x, y and t of the highest point, in a wind."""
    v0, alpha0, v_lim, g, height, n, _slope, along, across = scene
    air = wind.frame(v0, alpha0, along, across)
    own = units(air, v_lim, g, np.zeros_like(v0))
    up = np.maximum(march.origin(air.alpha0).slope, 0.0)
    found = march.at_slope(own.v, air.alpha0, up, n, lag=True)
    t, x, y, *_ = over_ground(own, air, found, height)
    return [x, y, t], found.status


def landings(*names: str) -> Kernel:
    """The kernel that gives these quantities of the landing on any ground, in any wind."""
    return partial(_land, names)


def _error(
    own: Units, air: Frame, goal: Goal, found: Found, rows: dict[str, FloatArray]
) -> FloatArray:
    """Estimate of the relative error: of rounding, and how it grows where ground is met flatly.

    An error e of the height over the ground is one of e over its rate in the time, and of that
    times the speed in the place.
    """
    quick = np.hypot(found.v_x, found.v_y)
    rounding = EPSILON * (32 + 4 * np.log1p(own.v) + 8 * np.abs(np.log(quick)))
    e = rounding * (goal.size(found) + np.abs(found.y))
    rate = np.abs(goal.x * found.v_x + goal.y * found.v_y + goal.t)
    late = e / np.maximum(rate, np.sqrt(e))
    level = np.where(rows["alpha"] == -RIGHT_ANGLE, 0.0, np.cos(rows["alpha"]))
    moved = late * own.time * rows["speed"] * level
    moved = moved + np.where(air.wind == 0, 0.0, rounding * distance(own, air, found)[1])
    far = np.hypot(rows["x"], rows["z"])
    worst = np.maximum(late / found.t, np.where(moved == 0, 0.0, moved / far))
    return np.asarray(np.where(found.t == 0, rounding, rounding + 2 * worst))


@np.errstate(all="ignore")
def _land(names: tuple[str, ...], *scene: FloatArray) -> tuple[Sequence[FloatArray], Codes]:
    v0, alpha0, *_, height, _n, slope, _along, _across = scene
    own, air, goal, found = meet_ground(*scene)
    nil = np.zeros_like(v0)
    rows = dict(zip(ROWS, over_ground(own, air, found, height), strict=True))
    # a launch at rest on the ground is the last of ever slower ones, and lands as they do
    slowly = np.arctan(2 * np.tan(slope) - np.tan(alpha0))
    angle = np.where((v0 == 0) & (alpha0 > slope), slowly, alpha0)
    start = {"x": nil, "y": height, "z": nil, "speed": v0, "alpha": angle}
    for name, first in start.items():
        rows[name] = np.where(found.t == 0, first, rows[name])
    rows["arc_length"] = rows["s"]
    rows["y"] = rows["x"] * np.tan(slope)
    rows["error"] = _error(own, air, goal, found, rows)
    return [rows[name] for name in names], found.status


@np.errstate(all="ignore")
def meet_ground(*scene: FloatArray) -> tuple[Units, Frame, Goal, Found]:
    """The landing of launches, given as in `fields.FIELDS`, in units of those through the air."""
    v0, alpha0, v_lim, g, height, n, slope, along, across = scene
    air = wind.frame(v0, alpha0, along, across)
    tangent = np.tan(slope)
    drift = tangent * along  # what the ground climbs in a second under what drifts
    own = units(air, v_lim, g, np.sqrt(np.abs(height) / g) + np.abs(drift) / g)
    nil, one = np.zeros_like(v0), np.ones_like(v0)
    in_x, in_t = drawn(own, air)
    goal = Goal(-tangent * in_x, one, -tangent * in_t, nil, -height / own.length, -one)
    after, never = np.zeros_like(v0), np.zeros(v0.shape, bool)
    blown = np.flatnonzero(ground.is_blown(own.v, n, goal))
    if blown.size:
        after[blown], falls = ground.last_top(
            own.v[blown], air.alpha0[blown], n[blown], goal.at(blown)
        )
        never[blown] = ~falls
        goal = goal._replace(
            value=np.where(never, 0.0, goal.value), way=np.where(never, 1.0, goal.way)
        )
    lag = not wind.is_still(air)
    found = march.follow(own.v, air.alpha0, n, goal, lag, after if blown.size else None)
    codes = np.where(never, np.int8(Status.UNREACHABLE), found.status)
    return own, air, goal, found._replace(status=codes)
