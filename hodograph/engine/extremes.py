"""The extremes, all of them: launches almost at rest or almost level, falls without end.

Scenes inside the legal domain (see `domain`) leave the doubles nowhere but here.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import fall, power
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.fall import Descent
from hodograph.engine.velocity import Start, bracket_gap, log1p_ratio

# Below this fraction of the speed gained in the fall, v0 does nothing but scale x.
REST = 1e-17
# At smaller angles onto level ground the flight depends on v_norm^n alpha0 alone: it is scaled.
SHALLOWEST = 1e-50
# v_norm^n alpha0 below which it flies as in vacuum.
WEAKEST = 1e-18
# Depth, in v_lim^2 / g past the loss of the launch speed, below which only y and t still change.
TERMINAL = 45.0
STEEPEST = 300.0  # cap on ln(tan(alpha) growth) at terminal speed: by then the angle is -pi/2


def vacuum(v: FloatArray, alpha0: FloatArray, n: FloatArray) -> BoolArray:
    """Whether a launch onto its own level flies as in vacuum, to double precision."""
    return np.asarray(v**n * alpha0 < WEAKEST)


def steepen(
    v: FloatArray, alpha0: FloatArray, n: FloatArray, level: BoolArray | bool
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """v_norm and angle to compute with, and by what the true angle is smaller."""
    shallow = (alpha0 > 0) & (alpha0 < SHALLOWEST) & level
    if not shallow.any():
        return v, alpha0, np.ones_like(v)
    shrink = np.where(shallow, alpha0 / SHALLOWEST, 1.0)
    return v * shrink ** (1 / n), np.where(shallow, SHALLOWEST, alpha0), shrink


class Scaled(NamedTuple):
    """Launches in units of their own: the speed computed with, and its square over g."""

    v: FloatArray
    alpha0: FloatArray
    height: FloatArray
    speed: FloatArray  # in m/s
    g: FloatArray
    rest: FloatArray  # v0 over that speed
    shrink: FloatArray  # alpha0 over the angle computed with; 0 for a launch at rest on the ground

    @property
    def time(self) -> FloatArray:
        """The unit of time in s."""
        return np.asarray(self.speed / self.g)

    @property
    def length(self) -> FloatArray:
        """The unit of length in m."""
        return np.asarray(self.speed * (self.speed / self.g))

    @property
    def tilt(self) -> FloatArray:
        """What small angles are multiplied with."""
        return np.where(self.shrink > 0, self.shrink, 1.0)


def scale(
    v0: FloatArray,
    alpha0: FloatArray,
    v_lim: FloatArray,
    g: FloatArray,
    height: FloatArray,
    n: FloatArray,
) -> Scaled:
    """Launches in units of their own, at speeds and angles that can be computed with."""
    least = REST * np.minimum(np.sqrt(g * np.abs(height)), v_lim)
    speed = np.maximum(v0, least)
    still = speed == 0  # at rest on the ground: any speed will do, and the results are nil
    if still.any():
        speed = np.where(still, np.minimum(v_lim, 1.0), speed)
    v, angle, shrink = steepen(speed / v_lim, alpha0, n, height == 0)
    if still.any():
        v, shrink = np.where(still, 0.0, v), np.where(still, 0.0, shrink)
    return Scaled(v, angle, height / speed * g / speed, speed, g, v0 / speed, shrink)


def descend(
    begin: Start, P_start: FloatArray, drop: FloatArray, n: FloatArray, wanted: tuple[str, ...]
) -> tuple[Descent, FloatArray]:
    """The fall, and its depth at terminal speed in v_lim^2 / g, which is left out of it."""
    if power.is_square(n):
        return _descend_square(begin, P_start, drop, wanted)
    w2 = begin.v2 * begin.plus * begin.minus
    beyond = np.zeros_like(drop)
    deep = np.flatnonzero(w2 * drop > power.FINAL / 2)
    if not deep.size:
        return power.descend(begin, P_start, drop, n, wanted), beyond
    final = power.fall_to_final(begin.at(deep), P_start[deep], n[deep], wanted)
    below = drop[deep] + final.sums["y"]
    past = below > 0
    deep = deep[past]
    drop = drop.copy()
    beyond[deep] = w2[deep] * below[past]
    drop[deep] = 0.0
    down = power.descend(begin, P_start, drop, n, wanted)
    return _with(down, deep, final, past), beyond


def _with(down: Descent, deep: NDArray[np.intp], final: Descent, past: BoolArray) -> Descent:
    """The falls, some of which are replaced."""
    for name, sum_ in down.sums.items():
        sum_[deep] = final.sums[name][past]
    for whole, part in ((down.P, final.P), (down.delta, final.delta), (down.U, final.U)):
        whole[deep] = part[past]
    return down


def _descend_square(
    begin: Start, P_start: FloatArray, drop: FloatArray, wanted: tuple[str, ...]
) -> tuple[Descent, FloatArray]:
    w = begin.v2 * begin.plus * begin.minus
    depth, beyond = w * drop, np.zeros_like(drop)
    if (depth > TERMINAL).any():
        deepest = TERMINAL + np.log(np.maximum(begin.v2, 1.0)) / 2
        beyond = np.maximum(depth - deepest, 0.0)
        deep = beyond > 0
        drop = np.where(deep, deepest / np.where(deep, w, 1.0), drop)
    down = fall.descend(begin, P_start, drop, tuple(name for name in wanted if name != "s"))
    if "s" in wanted:
        gap, _ = bracket_gap(begin, down.delta)
        down.sums["s"] = 0.5 * gap * log1p_ratio(begin.v2 * gap) / (begin.plus * begin.minus)
    return down, beyond
