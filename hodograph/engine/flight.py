"""A whole flight: up to the apex, and down from there, or from the launch, to the landing.

Results are in units of the launch, lengths v0^2 / g, times v0 / g and speeds v0, so that vacuum
is a scene like any other.  In one call drag is quadratic for all launches or for none: `arc` and
`extremes.descend` choose the way, and nobody else asks.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hodograph.engine import extremes, position, power
from hodograph.engine.domain import FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.fall import TINY, Descent
from hodograph.engine.status import Status
from hodograph.engine.velocity import Ahead, Start, bracket_gap, log1p_ratio, start

EPSILON = float(np.finfo(np.float64).eps)


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
    across2: FloatArray  # (v_x / v0)^2 where the fall begins
    top: Start  # the start of the fall
    down: Descent
    beyond: FloatArray  # depth of fall at terminal speed, in v_lim^2 / g
    status: Codes

    @property
    def reach(self) -> FloatArray:
        """x / cos(alpha0) of the landing."""
        fall = self.across2 / self.cos0 * self.down.sums["x"]
        return np.asarray(self.up["x"] + fall + self.drift)

    @property
    def drift(self) -> FloatArray | float:
        """What the fall at terminal speed, where v_x decays as exp(-t), adds to `reach`."""
        if not (self.beyond > 0).any():
            return 0.0
        across = self.speed / np.sqrt(1 + self.down.P)
        return np.asarray(across / self.cos0 * -np.expm1(-self.beyond) / np.maximum(self.v, TINY))

    @property
    def t(self) -> FloatArray:
        """Time."""
        return np.asarray(self.up["t"] + np.sqrt(self.across2) * self.down.sums["t"] + self.linger)

    @property
    def linger(self) -> FloatArray:
        """Time of the fall at terminal speed."""
        return _where_deep(self.beyond, self.v)

    @property
    def tail(self) -> FloatArray:
        """Length of path at terminal speed, at the end of a deep fall."""
        return _where_deep(self.linger, self.v)

    @property
    def tangent(self) -> FloatArray:
        """-tan(alpha_s)."""
        growth = np.exp(np.minimum(self.beyond, extremes.STEEPEST))
        return np.asarray(np.sqrt(self.down.P) * growth)

    @property
    def delta(self) -> FloatArray:
        """By how much asinh(tan(alpha)) has decreased, but for the fall at terminal speed."""
        return np.asarray(self.slope + self.down.delta)

    @property
    def speed(self) -> FloatArray:
        """Speed."""
        return np.asarray(np.sqrt(self.across2 * (1 + self.down.P)) * self.down.U ** (-1 / self.n))

    @property
    def curve(self) -> FloatArray:
        """Length of path but for the tail (eq. 19)."""
        return np.asarray(self.up["s"] + self.across2 * self.down.sums["s"])

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


def _where_deep(part: FloatArray, v: FloatArray) -> FloatArray:
    """part / v, 0 where there is no part."""
    return np.divide(part, v, out=np.zeros_like(v), where=part > 0)


def _ratio(part: FloatArray, whole: FloatArray) -> FloatArray:
    """part / whole; 0 where both are, and infinite where the whole alone is."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.where(part == 0, 0.0, part / whole)


def arc(
    begin: Start,
    slope: FloatArray | None,
    delta: FloatArray,
    n: FloatArray,
    wanted: tuple[str, ...],
    ahead: Ahead | None = None,
) -> tuple[dict[str, FloatArray], FloatArray]:
    """Integrals over arcs that come down by `delta`, and U - 1 at their ends.

    `slope` is asinh(tan alpha0), or None for arcs that end at their apex; `ahead` is the
    landing, for integrands that look ahead to it.
    """
    if not power.is_square(n):
        return power.arc(begin, delta, n, wanted, ahead)
    sums = position.arc(begin, slope, delta, tuple(name for name in wanted if name != "s"), ahead)
    gap, _ = bracket_gap(begin, delta)
    if "s" in wanted:
        sums["s"] = 0.5 * gap * log1p_ratio(begin.v2 * gap)  # eq. 19
    return sums | {"K2": delta}, begin.v2 * gap


def fly(
    v: FloatArray, alpha0: FloatArray, height: FloatArray, n: FloatArray, wanted: tuple[str, ...]
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
    fall = up["y"] + height

    # and down from there, or from a launch that is already downward
    across2 = cos0 * cos0 * (1 + e_top) ** (-2 / n)
    level = np.zeros_like(v)
    top, P_start = Start(v * v * across2, level, level + 1, level + 1), level
    downward = sin0 < 0
    if downward.any():
        top = Start(*(np.where(downward, a, b) for a, b in zip(begin, top, strict=True)))
        P_start = np.where(downward, (sin0 / cos0) ** 2, 0.0)
    drop = np.maximum(fall, 0.0) / across2
    down, beyond = extremes.descend(top, P_start, drop, n, wanted)
    status = np.where(down.converged, np.int8(Status.CONVERGED), np.int8(Status.NOT_CONVERGED))
    status[fall < 0] = Status.UNREACHABLE
    return Flight(v, n, sin0, cos0, height, slope, up, across2, top, down, beyond, status)


def climb(
    v: FloatArray, alpha0: FloatArray, n: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x, y, t of the apex above the launch; zero for a downward launch, which is its own apex."""
    angle = np.maximum(alpha0, 0.0)
    sin0, cos0 = np.sin(angle), np.cos(angle)
    up, _ = arc(start(v * v, sin0, cos0), None, np.arcsinh(sin0 / cos0), n, ("x", "y", "t"))
    return cos0 * up["x"], up["y"], up["t"]
