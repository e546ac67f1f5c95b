"""A whole flight: up to the apex, and down from there, or from the launch, to the landing.

Results are in units of the launch, lengths v0^2 / g, times v0 / g and speeds v0, so that vacuum
is a scene like any other.  Drag is quadratic, or of any other exponent: nobody else asks which.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import fall as descent
from hodograph.engine import position
from hodograph.engine import power as powerlaw
from hodograph.engine.domain import FloatArray
from hodograph.engine.fall import Descent
from hodograph.engine.velocity import Ahead, Start, bracket_gap, log1p_ratio, start

CONVERGED, UNREACHABLE, NOT_CONVERGED, INVALID = 0, 1, 2, 3  # invalid: a NaN among the inputs

BLOCK = 16384  # launches worked on at once
EPSILON = float(np.finfo(np.float64).eps)
TERMINAL = 45.0  # depth of fall, past the loss of launch speed, where all but y and t is final
REST = 1e-17  # slower than this part of what the fall brings, v0 is but a factor of x
TINY = descent.TINY
STEEPEST = 300.0  # of growth of tan(alpha) at terminal speed, as a logarithm: the angle is final


@dataclass(frozen=True, eq=False)
class Flight:
    """What the landing is made of; each property computes one quantity from it."""

    v: FloatArray
    n: FloatArray
    sin0: FloatArray
    cos0: FloatArray
    height: FloatArray
    slope: FloatArray  # of the launch, 0 if downward
    up: dict[str, FloatArray]  # integrals up to the apex
    U_top: FloatArray  # eq. 8 and 13, at the apex
    across2: FloatArray  # (v_x / v0)^2 where the fall begins
    top: Start  # the start of the fall
    down: Descent
    beyond: FloatArray  # depth of fall at terminal speed, in v_lim^2 / g
    status: NDArray[np.int8]

    @property
    def reach(self) -> FloatArray:
        """x / cos(alpha0)."""
        fall = self.across2 / self.cos0 * self.down.sums["x"]
        return np.asarray(self.up["x"] + fall + self._drift)

    @property
    def _drift(self) -> FloatArray | float:
        """What the fall at terminal speed adds to `reach`: v_x decays there as exp(-t)."""
        if not (self.beyond > 0).any():
            return 0.0
        across = self.speed / np.hypot(1.0, np.sqrt(self.down.P))
        return np.asarray(across / self.cos0 * -np.expm1(-self.beyond) / np.maximum(self.v, TINY))

    @property
    def t(self) -> FloatArray:
        """Time."""
        return np.asarray(self.up["t"] + np.sqrt(self.across2) * self.down.sums["t"] + self.linger)

    @property
    def linger(self) -> FloatArray:
        """Time of the fall at terminal speed."""
        zero = np.zeros_like(self.v)
        return np.divide(self.beyond, self.v, out=zero, where=self.beyond > 0)

    @property
    def tail(self) -> FloatArray:
        """Length of path at terminal speed, at the end of a deep fall."""
        return np.divide(self.linger, self.v, out=np.zeros_like(self.v), where=self.beyond > 0)

    @property
    def tangent(self) -> FloatArray:
        """-tan(alpha_s)."""
        return np.asarray(np.sqrt(self.down.P) * np.exp(np.minimum(self.beyond, STEEPEST)))

    @property
    def delta(self) -> FloatArray:
        """Slope come down in all, but for the fall at terminal speed."""
        return np.asarray(self.slope + self.down.delta)

    @property
    def speed(self) -> FloatArray:
        """Speed."""
        return np.asarray(np.sqrt(self.across2 * (1 + self.down.P)) * self.down.U ** (-1 / self.n))

    @property
    def curve(self) -> FloatArray:
        """Length of path but for the tail (eq. 19)."""
        fall = np.where(self.sin0 > 0, self.across2, self.cos0**2)
        return np.asarray(self.up["s"] + fall * self.down.sums["s"])

    @property
    def error(self) -> FloatArray:
        """Estimate of the relative error of x and t: rounding, its growth, and the last step.

        An error e in height is one of e / tan(alpha_s) in x and e / (v sin(alpha_s)) in t.  Close
        to the apex both are level to within that error, and no steeper slope can be counted on
        than the one after a fall by e.
        """
        rounding = EPSILON * (16 + self.n * (2 + 2 * self.delta + np.log1p(self.v)))
        e = 0.25 * rounding * (self.up["y"] + np.abs(self.height))
        P = self.down.P + 2 * e / self.across2
        across = np.sqrt(self.across2) * self.down.U ** (-1 / self.n)
        in_x = _ratio(e, np.sqrt(P) * self.reach * self.cos0)
        in_t = _ratio(e, across * np.sqrt(P) * self.t)
        in_x = np.where(self.beyond > 0, 0.0, in_x)
        return np.asarray(rounding + 2 * np.maximum(in_x, in_t) + 4 * self.down.error)


def least_speed(v_lim: FloatArray, g: FloatArray, height: FloatArray) -> FloatArray:
    """The speed below which a flight is that of rest, and x in proportion to v0."""
    return np.asarray(REST * np.minimum(np.sqrt(g * np.abs(height)), v_lim))


def scaled(
    v0: FloatArray, v_lim: FloatArray, g: FloatArray, height: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Launch speed to compute with, v_norm and height by it, and v0 over it.

    It is not v0 for a launch almost at rest, where all depends on v0 by a factor.
    """
    speed = np.maximum(v0, least_speed(v_lim, g, height))
    return speed, speed / v_lim, height / speed * g / speed, v0 / speed


def _ratio(part: FloatArray, whole: FloatArray) -> FloatArray:
    """part / whole; 0 where both are, and infinite where the whole alone is."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(part == 0, 0.0, part / whole)


def arc(
    begin: Start,
    slope: FloatArray | None,
    delta: FloatArray,
    n: float,
    wanted: tuple[str, ...],
    ahead: Ahead | None = None,
) -> tuple[dict[str, FloatArray], FloatArray]:
    """Integrals over arcs that come down by `delta`, and U - 1 at their ends.

    `slope` is asinh(tan alpha0), or None for arcs that end at their apex; `ahead` is the
    landing, for integrands that look ahead to it.
    """
    if n != 2:
        return powerlaw.arc(begin, delta, np.full_like(delta, n), wanted, ahead)
    sums = position.arc(begin, slope, delta, tuple(name for name in wanted if name != "s"), ahead)
    gap, _ = bracket_gap(begin, delta)
    if "s" in wanted:
        sums["s"] = 0.5 * gap * log1p_ratio(begin.v2 * gap)  # eq. 19
    return sums | {"K2": delta}, begin.v2 * gap


def _descend(
    begin: Start, P_start: FloatArray, drop: FloatArray, n: float, wanted: tuple[str, ...]
) -> Descent:
    if n != 2:
        return powerlaw.descend(begin, P_start, drop, np.full_like(drop, n), wanted)
    down = descent.descend(begin, P_start, drop, tuple(name for name in wanted if name != "s"))
    if "s" in wanted:
        gap, _ = bracket_gap(begin, down.delta)
        down.sums["s"] = 0.5 * gap * log1p_ratio(begin.v2 * gap) / (begin.plus * begin.minus)
    return down


def fly(
    v: FloatArray, alpha0: FloatArray, height: FloatArray, n: float, wanted: tuple[str, ...]
) -> Flight:
    """Landings of one block of launches; `wanted` holds "x", "t", "s" or some of them.

    Arrays are 1-D and finite, `height` in units of v0^2 / g.
    """
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    begin = start(v * v, sin0, cos0)
    wanted = ("y", *wanted)

    # up to the apex
    slope = np.arcsinh(np.maximum(sin0, 0.0) / cos0)
    up, e_top = arc(begin, None, slope, n, wanted)
    U_top = 1 + e_top
    fall = up["y"] + height

    # and down from there, or from a launch that is already downward
    across2 = cos0 * cos0 * U_top ** (-2 / n)
    level = np.zeros_like(v)
    top, P_start = Start(v * v * across2, level, level + 1, level + 1), level
    downward = sin0 < 0
    if downward.any():
        top = Start(*(np.where(downward, a, b) for a, b in zip(begin, top, strict=True)))
        P_start = np.where(downward, (sin0 / cos0) ** 2, 0.0)
    drop = np.maximum(fall, 0.0) / across2
    down, beyond = _fall(top, P_start, drop, n, wanted)
    status = np.where(fall < 0, UNREACHABLE, np.where(down.converged, CONVERGED, NOT_CONVERGED))
    return Flight(
        v, level + n, sin0, cos0, height, slope, up, U_top, across2, top, down, beyond,
        status.astype(np.int8),
    )  # fmt: skip


def _fall(
    top: Start, P_start: FloatArray, drop: FloatArray, n: float, wanted: tuple[str, ...]
) -> tuple[Descent, FloatArray]:
    """The fall, and its depth at terminal speed in v_lim^2 / g, which is left out of it."""
    w2 = top.v2 * top.plus * top.minus
    depth = w2 * drop
    beyond = np.zeros_like(drop)
    if n == 2:
        deepest = TERMINAL + np.log(np.maximum(top.v2, 1.0)) / 2
        too_deep = depth > deepest
        if too_deep.any():
            beyond = np.where(too_deep, depth - deepest, 0.0)
            drop = np.where(too_deep, deepest / np.where(too_deep, w2, 1.0), drop)
        return _descend(top, P_start, drop, n, wanted), beyond
    deep = np.flatnonzero(depth > powerlaw.FINAL / 2)
    if not deep.size:
        return _descend(top, P_start, drop, n, wanted), beyond
    final = powerlaw.fall_to_final(top.at(deep), P_start[deep], np.full(deep.size, n), wanted)
    below = drop[deep] + final.sums["y"]
    past = below > 0
    deep = deep[past]
    drop = drop.copy()
    beyond[deep] = w2[deep] * below[past]
    drop[deep] = 0.0
    down = _descend(top, P_start, drop, n, wanted)
    for name, sum_ in down.sums.items():
        sum_[deep] = final.sums[name][past]
    for whole, part in ((down.P, final.P), (down.delta, final.delta), (down.U, final.U)):
        whole[deep] = part[past]
    return down, beyond


def climb(v: FloatArray, alpha0: FloatArray, n: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x, y, t of the apex above the launch; zero for a downward launch, which is its own apex."""
    angle = np.maximum(alpha0, 0.0)
    sin0, cos0 = np.sin(angle), np.cos(angle)
    up, _ = arc(start(v * v, sin0, cos0), None, np.arcsinh(sin0 / cos0), n, ("x", "y", "t"))
    return cos0 * up["x"], up["y"], up["t"]


def blocks(size: int) -> Iterator[slice]:
    """Slices of BLOCK launches: what is worked on at once, whatever the size of the input."""
    for first in range(0, size, BLOCK):
        yield slice(first, first + BLOCK)


def warn_not_converged(failed: int, size: int) -> None:
    """One `RuntimeWarning` for a call some launches of which did not converge."""
    if failed:
        warnings.warn(
            f"landing not converged for {failed} of {size} launches (NaN returned)",
            RuntimeWarning,
            stacklevel=3,
        )
