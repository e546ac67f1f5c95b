"""A uniform wind: the flight is that of still air, seen from an air that moves.

The launch has the velocity (v0 cos(alpha0) - W, v0 sin(alpha0), -W_z) through the air, and there
it stays in one vertical plane.  Over the ground it adds (W t, 0, W_z t).  With a = v0 cos(alpha0)
- W, and what drag takes from a path along the air in the time t, lag = t - x_air / v_x,air,

    x = a x_air / v_x,air + W t = v0 cos(alpha0) t - a lag,    z = W_z lag,

of which that serves which has the smaller terms.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hodograph.engine.domain import FloatArray


class Frame(NamedTuple):
    """Launches as the air sees them, and as the ground does."""

    speed: FloatArray  # through the air, in m/s
    alpha0: FloatArray  # elevation there
    along: FloatArray  # the velocity through the air along x over the horizontal one
    ahead: FloatArray  # the velocity through the air along x
    v_x: FloatArray  # over the ground
    wind: FloatArray
    crosswind: FloatArray


def is_still(air: Frame) -> bool:
    """Whether there is no wind at all."""
    return not (air.wind.any() or air.crosswind.any())


def frame(v0: FloatArray, alpha0: FloatArray, wind: FloatArray, crosswind: FloatArray) -> Frame:
    """The launches seen from the air; those in no wind as they are, but that rest does not rise."""
    v_x, v_y = v0 * np.cos(alpha0), v0 * np.sin(alpha0)
    ahead = v_x - wind
    level = np.hypot(ahead, crosswind)
    still = (wind == 0) & (crosswind == 0)
    forward = still | (level == 0)
    return Frame(
        np.where(still, v0, np.hypot(level, v_y)),
        np.where(still, np.where(v0 == 0, np.minimum(alpha0, 0.0), alpha0), np.arctan2(v_y, level)),
        np.where(forward, 1.0, ahead / np.where(forward, 1.0, level)),
        ahead,
        v_x,
        wind,
        crosswind,
    )
