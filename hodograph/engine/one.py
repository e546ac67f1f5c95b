"""One launch a call, in plain floats: the answers of `scene` for a tenth of their cost.

Every function returns None where the launch is not an ordinary one, and the arrays are to answer.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan, inf, pi, sin, sqrt
from typing import Any

import numpy as np

from hodograph.engine import domain, linear, optimum, scalar
from hodograph.engine.status import Status

RIGHT_ANGLE = pi / 2
LEAST_ANGLE, LEAST_SPEED, LEAST_DRAG = 1e-50, 1e-12, 1e-18  # below which it is for the arrays

FLY: dict[float, Callable[[float, float, float, tuple[str, ...]], Any]] = {
    1.0: linear.fly_alone,
    2.0: scalar.fly,
}
CLIMB: dict[float, Callable[[float, float], Any]] = {1.0: linear.climb_alone, 2.0: scalar.climb}
PLAIN = {float, int, np.float64}
HUGE = 1e300


def is_within(low: float, value: Any, high: float) -> bool:
    """Whether it is a plain number between the two."""
    return type(value) in PLAIN and bool(low <= value <= high)


def is_level(v_norm: Any, alpha0: Any) -> bool:
    """Whether these are plain numbers that make a legal launch over level ground."""
    return is_within(0.0, v_norm, domain.V_NORM_MAX) and is_within(0.0, alpha0, RIGHT_ANGLE)


def are_plain(values: tuple[Any, ...]) -> bool:
    """Whether these are plain numbers."""
    return all(type(value) in PLAIN for value in values)


def is_legal(v0: Any, alpha0: Any, v_lim: Any, g: Any, height: Any, n: Any) -> bool:
    """Whether these are plain numbers that make a legal scene, as `domain` has it."""
    for value in (v0, alpha0, v_lim, g, height, n):
        if type(value) not in PLAIN:
            return False
    if not (v0 <= domain.MOST and (v_lim == inf or v_lim <= HUGE) and abs(height) <= domain.MOST):
        return False  # among them integers beyond the doubles
    return bool(
        (v0 == 0 or v0 >= domain.LEAST)
        and -RIGHT_ANGLE <= alpha0 <= RIGHT_ANGLE
        and v_lim >= domain.LEAST
        and domain.LEAST <= g <= domain.MOST
        and 1 <= n <= 10
        and v0 <= domain.V_NORM_MAX * v_lim
        and abs(height) * g / v_lim / v_lim <= domain.DEPTH_MAX
    )


def level(v_norm: Any, alpha0: Any, n: Any) -> Any | None:
    """The flight of a launch onto its own level, its arguments legal; None for the arrays."""
    if type(v_norm) not in PLAIN or type(alpha0) not in PLAIN or type(n) not in PLAIN:
        return None
    if n not in FLY:
        return None
    if not (0.0 < v_norm <= scalar.V_NORM_MAX and LEAST_ANGLE < alpha0 <= RIGHT_ANGLE):
        return None
    v, angle, n = float(v_norm), float(alpha0), float(n)
    if v**n * angle < LEAST_DRAG:
        return None
    flight = FLY[n](v, angle, 0.0, ("x",))
    return flight if flight is not None and flight.status == Status.CONVERGED else None


def d_norm(v_norm: Any, alpha0: Any, n: Any) -> float | None:
    """Range over the range without drag (eq. 21)."""
    flight = level(v_norm, alpha0, n)
    return None if flight is None else min(flight.reach / (2.0 * sin(alpha0)), 1.0)


def landing_angle(v_norm: Any, alpha0: Any, n: Any) -> float | None:
    """Slope angle at the landing."""
    flight = level(v_norm, alpha0, n)
    return None if flight is None else -atan(flight.tangent)


def landing(
    v0: float,
    alpha0: float,
    v_lim: float,
    g: float,
    height: float,
    n: float,
    wanted: tuple[str, ...] = (),
) -> tuple[Any, float, float, float] | None:
    """The flight, and the units of speed, time and length; None for the arrays."""
    if n not in FLY or not v0 > LEAST_SPEED * sqrt(g * abs(height)):
        return None
    if height == 0.0 and alpha0 < LEAST_ANGLE:
        return None
    time = v0 / g
    length = v0 * time
    if not length > 0.0:
        return None
    flight = FLY[n](v0 / v_lim, alpha0, height / length, wanted)
    if flight is None or flight.status != Status.CONVERGED:
        return None
    return flight, v0, time, length


def apex(
    v0: float, alpha0: float, v_lim: float, g: float, height: float, n: float
) -> tuple[float, float, float] | None:
    """x, y and t of the highest point."""
    if n not in CLIMB or not v0 > 0.0 or not (alpha0 <= 0.0 or alpha0 > LEAST_ANGLE):
        return None
    found = CLIMB[n](v0 / v_lim, alpha0)
    if found is None:
        return None
    time = v0 / g
    length = v0 * time
    return found[0] * length, found[1] * length + height, found[2] * time


def best_angle(
    v0: Any, v_lim: Any, g: Any, height: Any, n: Any, guess: Callable[[float], float]
) -> float | None:
    """The angle of greatest range; `guess` gives that on level ground, of v_norm, to a percent."""
    if not is_legal(v0, 0.0, v_lim, g, height, n) or n not in FLY:
        return None
    v = float(v0) / float(v_lim)
    if height == 0:
        return optimum.best(v, 0.0, n, guess(v)) if v > 0 else 0.5 * RIGHT_ANGLE
    if not v0 > LEAST_SPEED * sqrt(g * abs(height)):
        return None
    return optimum.best(v, height / (v0 / g * v0), n, guess(v))
