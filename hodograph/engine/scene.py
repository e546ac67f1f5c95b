"""Scenes in SI units, as kernels of the driver: landings, apexes and paths."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from math import atan
from typing import Any

import numpy as np

from hodograph.engine import extremes, linear, one
from hodograph.engine.domain import FloatArray
from hodograph.engine.driver import Codes, Kernel
from hodograph.engine.extremes import Scaled
from hodograph.engine.flight import Flight, climb, fly
from hodograph.engine.path import points
from hodograph.engine.status import Status

# A quantity of the landing: the integrals that it needs, and how it is made of the flight.
QUANTITIES: dict[str, tuple[tuple[str, ...], Callable[[Scaled, Any], FloatArray]]] = {
    "x": (
        ("x",),
        lambda own, flight: flight.reach * flight.cos0 * own.length * own.rest * own.shrink,
    ),
    "t": (("t",), lambda own, flight: flight.t * own.time * own.shrink),
    "speed": (
        (),
        lambda own, flight: np.where(own.shrink > 0, flight.speed * own.speed, 0.0),
    ),
    "alpha": (
        (),
        lambda own, flight: (
            own.tilt * np.where(flight.delta == 0, own.alpha0, -np.arctan(flight.tangent))
        ),
    ),
    "arc_length": (
        ("s",),
        lambda own, flight: (flight.curve + flight.tail) * own.length * own.shrink,
    ),
    "error": (("x", "t"), lambda own, flight: flight.error),
}


def landings(*names: str) -> Kernel:
    """The kernel that gives these quantities of v0, alpha0, v_lim, g, height, n."""
    needs = tuple(dict.fromkeys(part for name in names for part in QUANTITIES[name][0]))
    return partial(_land, tuple(QUANTITIES[name][1] for name in names), needs)


def _land(
    quantities: tuple[Callable[[Scaled, Any], FloatArray], ...],
    needs: tuple[str, ...],
    v0: FloatArray,
    alpha0: FloatArray,
    v_lim: FloatArray,
    g: FloatArray,
    height: FloatArray,
    n: FloatArray,
) -> tuple[Sequence[FloatArray], Codes]:
    own = extremes.scale(v0, alpha0, v_lim, g, height, n)
    flight: Flight | linear.Flight
    if n[0] == 1:
        flight = linear.fly(own.v, own.alpha0, own.height, needs)
    else:
        flight = fly(own.v, own.alpha0, own.height, n, needs)
    return [quantity(own, flight) for quantity in quantities], flight.status


def apexes(
    v0: FloatArray,
    alpha0: FloatArray,
    v_lim: FloatArray,
    g: FloatArray,
    height: FloatArray,
    n: FloatArray,
) -> tuple[Sequence[FloatArray], Codes]:
    """The kernel that gives x, y and t of the highest point."""
    v, angle, shrink = extremes.steepen(v0 / v_lim, alpha0, n, True)
    x, y, t = linear.climb(v, angle) if n[0] == 1 else climb(v, angle, n)
    time = v0 / g
    length = v0 * time
    codes = np.full(v0.shape, Status.CONVERGED, np.int8)
    return [x * length * shrink, y * length * shrink**2 + height, t * time * shrink], codes


def paths(count: int) -> Kernel:
    """The kernel that gives t, x, y, speed, alpha and arc length at so many points."""
    return partial(_walk, count)


def _walk(
    count: int,
    v0: FloatArray,
    alpha0: FloatArray,
    v_lim: FloatArray,
    g: FloatArray,
    height: FloatArray,
    n: FloatArray,
) -> tuple[Sequence[FloatArray], Codes]:
    own = extremes.scale(v0, alpha0, v_lim, g, height, n)
    flight = fly(own.v, own.alpha0, own.height, n, ("t", "x", "s"))
    t, x, y, speed, alpha, s = points(flight, own.alpha0, count)
    time, length, rest, shrink, tilt, pace = (
        part[:, np.newaxis]
        for part in (
            own.time, own.length, own.rest, own.shrink, own.tilt,
            np.where(own.shrink > 0, own.speed, 0.0),
        )
    )  # fmt: skip
    rows = [
        t * time * shrink,
        x * length * rest * shrink,
        y * length * shrink**2,
        speed * pace,
        alpha * tilt,
        s * length * shrink,
    ]
    for row, first in zip(rows[2:5], (height, v0, alpha0), strict=True):
        row[:, 0] = first
    return rows, flight.status


# The same of one launch in plain floats: of its flight, and the units of speed, time and length.
ONE: dict[str, Callable[[Any, float, float, float], float]] = {
    "x": lambda flight, speed, time, length: flight.reach * flight.cos0 * length,
    "t": lambda flight, speed, time, length: flight.t * time,
    "speed": lambda flight, speed, time, length: flight.speed * speed,
    "alpha": lambda flight, speed, time, length: -atan(flight.tangent),
    "arc_length": lambda flight, speed, time, length: flight.curve * length,
    "error": lambda flight, speed, time, length: flight.error,
}


def landing_of_one(
    names: tuple[str, ...],
    v0: float,
    alpha0: float,
    v_lim: float,
    g: float,
    height: float,
    n: float,
) -> list[np.float64] | None:
    """Quantities of the landing of one launch; None where the arrays are to answer."""
    needs = tuple(dict.fromkeys(part for name in names for part in QUANTITIES[name][0]))
    found = one.landing(v0, alpha0, v_lim, g, height, n, needs)
    return None if found is None else [np.float64(ONE[name](*found)) for name in names]
