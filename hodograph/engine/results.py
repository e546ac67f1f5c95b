"""What a launch answers with: records of a landing, of a place on the path, and of its points."""

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
