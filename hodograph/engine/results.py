"""What launches answer with: a landing, a place on the path, its points; what hits a target."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import FloatArray, T
from hodograph.engine.record import Record


@dataclass(frozen=True, eq=False, repr=False)
class Landing(Record, Generic[T]):
    """Where, when and how a launch lands; fields have the launch's shape.

    Attributes
    ----------
    x, y, z, t, speed, alpha, arc_length
        Place (m; y is that of the ground there, z to the side, which only a crosswind gives),
        time (s), speed (m/s) and slope angle (rad) over the ground, and length of path (m)
        through the air; NaN where `success` is false.
    status
        0 converged, 1 unreachable (the ground is never reached), 2 not converged,
        3 a NaN among the inputs.
    success
        ``status == 0``.
    error
        Estimate of the relative error of `x` and `t`, no less than the true one; in a crosswind,
        of the horizontal distance in place of `x`.  `alpha` is no
        worse except just under the apex, where it is nearly level and rounding is a large part
        of it.
    """

    x: T
    y: T
    z: T
    t: T
    speed: T
    alpha: T
    arc_length: T
    status: np.int8 | NDArray[np.int8]
    success: np.bool_ | NDArray[np.bool_]
    error: T


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory(Record):
    """Points of a path, from the launch to the landing; the last axis runs along it.

    Attributes
    ----------
    t, x, y, z, speed, alpha, s
        Time (s), position (m; y above the level of the ground at x = 0, z to the side), speed
        (m/s) and slope angle (rad) over the ground, and length of path (m) through the air.
    """

    t: FloatArray
    x: FloatArray
    y: FloatArray
    z: FloatArray
    speed: FloatArray
    alpha: FloatArray
    s: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class State(Record, Generic[T]):
    """A flight at one place of its path, seen from the ground; fields have the common shape.

    Attributes
    ----------
    t, x, y, z, speed, alpha, s
        As in `Trajectory`; NaN where `success` is false.
    status
        0 converged, 1 unreachable (the path never comes there), 2 not converged, 3 a NaN among
        the inputs.
    success
        ``status == 0``.
    """

    t: T
    x: T
    y: T
    z: T
    speed: T
    alpha: T
    s: T
    status: np.int8 | NDArray[np.int8]
    success: np.bool_ | NDArray[np.bool_]


@dataclass(frozen=True, eq=False, repr=False)
class Shot(Record, Generic[T]):
    """A launch that hits a target; fields have the broadcast shape, NaN where there is none.

    Attributes
    ----------
    alpha0, azimuth
        Launch angle above the horizontal, in [-pi/2, pi/2], and direction over the ground, from x
        towards z, in (-pi, pi] (rad).
    t, speed, alpha
        Time of the hit (s), and the speed (m/s) and slope angle (rad) over the ground there.
    shortfall
        Height in m that the target would have to come down to be within reach: 0 where it is, inf
        where no lower target is either.  Only a NaN among the inputs and a failed iteration make
        it NaN.
    status
        0 converged, 1 unreachable, 2 not converged, 3 a NaN among the inputs.
    success
        ``status == 0``.
    """

    alpha0: T
    azimuth: T
    t: T
    speed: T
    alpha: T
    shortfall: T
    status: np.int8 | NDArray[np.int8]
    success: np.bool_ | NDArray[np.bool_]


@dataclass(frozen=True, eq=False, repr=False)
class LeastSpeed(Record, Generic[T]):
    """The slowest launch that hits a target: `v0` (m/s), `alpha0` (rad), `status`, `success`."""

    v0: T
    alpha0: T
    status: np.int8 | NDArray[np.int8]
    success: np.bool_ | NDArray[np.bool_]


@dataclass(frozen=True, eq=False, repr=False)
class Envelope(Record, Generic[T]):
    """The highest reached at a distance: `y` (m), by `alpha0` (rad), `status`, `success`."""

    y: T
    alpha0: T
    status: np.int8 | NDArray[np.int8]
    success: np.bool_ | NDArray[np.bool_]
