"""What a launch is asked, handed to the arrays, or to plain floats where it is a single one."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import atan2, hypot, isnan
from typing import Any, TypeAlias

import numpy as np

from hodograph.engine import domain, march_alone, one, scalar, scene, state
from hodograph.engine.domain import FloatArray
from hodograph.engine.driver import Codes, Kernel, apply
from hodograph.engine.fields import FIELDS, Scene
from hodograph.engine.status import Status

BARE = FIELDS[:6]  # of launches over level ground in still air
CONVERGED = np.int8(Status.CONVERGED)

Alone: TypeAlias = tuple[float, float, float, float, float, float]


def alone(launch: Scene[Any]) -> Alone | None:
    """`BARE` of a single launch over level ground in still air, as plain floats."""
    own = launch.__dict__
    if type(own["v0"]) is not np.float64 or own["slope"] or own["wind"] or own["crosswind"]:
        return None
    return (
        float(own["v0"]), float(own["alpha0"]), float(own["v_lim"]),
        float(own["g"]), float(own["height"]), float(own["n"]),
    )  # fmt: skip


def run(
    launch: Scene[Any], kernel: Kernel, rows: int, names: tuple[str, ...] = FIELDS, **options: Any
) -> tuple[list[Any], Any]:
    """The rows of a kernel of some fields, and the status."""
    arrays = [np.asarray(getattr(launch, name)) for name in names]
    return apply(kernel, arrays[0].shape, arrays, rows, exponent=5, **options)


def landing(launch: Scene[Any], *names: str) -> list[Any]:
    """Quantities of the landing, and the status."""
    by_one = partial(scene.landing_of_one, names)
    if (fields := alone(launch)) and (found := by_one(*fields)) is not None:
        return [*found, CONVERGED]
    if launch.is_bare:
        rows, status = run(launch, scene.landings(*names), len(names), BARE, alone=by_one)
    else:
        rows, status = run(launch, state.landings(*names), len(names))
    return [*rows, status]


def level_range(launch: Scene[Any], d_norm: Kernel, by_one: Callable[..., float | None]) -> Any:
    """The range, where the ground is level all along by the d_norm that a kernel gives."""
    if (fields := alone(launch)) and (distance := by_one(*fields)) is not None:
        return np.float64(distance)

    def kernel(
        v0: FloatArray, alpha0: FloatArray, v_lim: FloatArray, *others: FloatArray
    ) -> tuple[list[FloatArray], Codes]:
        g, height, n = others
        x, codes = np.empty_like(v0), np.full(v0.shape, Status.CONVERGED, np.int8)
        level = (height == 0) & (alpha0 >= 0)
        at, rest = np.flatnonzero(level), np.flatnonzero(~level)
        (ratio,), codes[at] = d_norm(v0[at] / v_lim[at], alpha0[at], n[at])
        x[at] = ratio * 2 * np.sin(alpha0[at]) * np.cos(alpha0[at]) * v0[at] ** 2 / g[at]
        if rest.size:
            parts = (part[rest] for part in (v0, alpha0, v_lim, *others))
            (x[rest],), codes[rest] = exact(*parts)
        return [x], codes

    exact = scene.landings("x")
    return run(launch, kernel, 1, BARE, alone=by_one)[0][0]


def apex(launch: Scene[Any]) -> list[Any]:
    """x, y and t of the highest point."""
    if (fields := alone(launch)) and (top := one.apex(*fields)):
        return [np.float64(part) for part in top]
    if launch.is_bare:
        return run(launch, scene.apexes, 3, BARE, alone=one.apex)[0]
    return run(launch, state.apexes, 3)[0]


def states(launch: Scene[Any], place: str, value: Any, rising: bool) -> tuple[list[Any], Any]:
    """`state.ROWS` where the place has a value, and the status."""
    by_one = partial(_state_alone, place, rising)
    if (single := alone(launch)) and type(value) in one.PLAIN:
        domain.checked(place, value, state.PLACES[place])
        found = by_one(*single, 0.0, 0.0, 0.0, float(value))
        if found is not None:
            return [np.float64(part) for part in found], CONVERGED
    shape, (values, _) = domain.broadcast(
        **{place: (value, state.PLACES[place]), "launch": (launch.v0, domain.LAUNCH_SPEED)}
    )
    fields = [np.broadcast_to(getattr(launch, name), shape) for name in FIELDS]
    return _places(place, rising, [*fields, values], by_one)


def path(launch: Scene[Any], place: str, last: Any, points: int) -> list[Any]:
    """The same at even places from the launch to the last."""
    values = np.multiply.outer(last, np.linspace(0.0, 1.0, points))
    fields = [np.asarray(getattr(launch, name))[..., np.newaxis] for name in FIELDS]
    own = [np.broadcast_to(part, values.shape) for part in fields]
    return _places(place, False, [*own, values], partial(_state_alone, place, False))[0]


def _places(
    place: str, rising: bool, arrays: list[FloatArray], by_one: Callable[..., Any]
) -> tuple[list[Any], Any]:
    kernel, shape = state.states(place, rising), arrays[0].shape
    return apply(kernel, shape, arrays, 7, exponent=5, alone=by_one, what="place")


def _state_alone(
    place: str,
    rising: bool,
    v0: float,
    alpha0: float,
    v_lim: float,
    g: float,
    height: float,
    n: float,
    slope: float,
    wind: float,
    crosswind: float,
    value: float,
) -> tuple[float, ...] | None:
    """`state.ROWS` of one launch; None where the arrays are to answer."""
    if (
        n != 2.0
        or wind
        or crosswind
        or isnan(g + height + slope)
        or not v0 > 0.0
        or not 0.0 < v0 / v_lim <= scalar.V_NORM_MAX
    ):
        return None
    if place == "y" and not rising:
        names = "t", "x", "speed", "alpha", "arc_length"
        fell = scene.landing_of_one(names, v0, alpha0, v_lim, g, height - value, n)
        if fell is None:
            return None
        t, x, speed, alpha, s = (float(part) for part in fell)
        return t, x, value, 0.0, speed, alpha, s
    time = v0 / g
    length = v0 * time
    if place == "alpha":
        if not -1.5 <= value < alpha0 <= 1.5:
            return None
        at = march_alone.at_slope(v0 / v_lim, alpha0, value)
    else:
        unit = time if place == "t" else length
        own = (value - height if place == "y" else value) / unit
        if not own > 1e-100 or (place == "y" and alpha0 <= 0.0):
            return None
        at = march_alone.follow(v0 / v_lim, alpha0, place, own)
    if at is None:
        return None
    t, x, s = at.t * time, at.x * length, at.s * length
    alpha = value if place == "alpha" else atan2(at.v_y, at.v_x)
    y = value if place == "y" else height + at.y * length
    return t, x, y, 0.0, v0 * hypot(at.v_x, at.v_y), alpha, s
