"""A whole flight: up to the apex, and down from there, or from the launch, to the landing.

Results are in units of the launch, lengths v_e^2 / g, times v_e / g and speeds v_e, so that
vacuum is a scene like any other; v_e is v_norm, or `velocity.FASTEST` where that is less.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hodograph.descent import Descent, descend
from hodograph.domain import FloatArray
from hodograph.position import arc
from hodograph.velocity import FASTEST, Start, bracket_gap, log1p_ratio, run_in, start

CONVERGED, UNREACHABLE, NOT_CONVERGED, INVALID = 0, 1, 2, 3  # invalid: a NaN among the inputs

BLOCK = 16384  # launches worked on at once
EPSILON = float(np.finfo(np.float64).eps)
TERMINAL = 45.0  # depth of fall, past the loss of launch speed, where all but y and t is final
SHALLOWEST = 1e-100  # below it a level flight is a matter of v^2 alpha0 alone, and scales


@dataclass(frozen=True, eq=False)
class Flight:
    """What the landing is made of; each property computes one quantity from it."""

    v2: FloatArray
    sin0: FloatArray
    cos0: FloatArray
    height: FloatArray
    slope: FloatArray  # of the launch, 0 if downward
    gap_up: FloatArray  # eq. 13: u = 1 + v2 gap_up at the apex
    up: dict[str, FloatArray]  # integrals up to the apex
    across2: FloatArray  # (v_x / v_e)^2 where the fall begins
    top: Start  # the start of the fall
    down: Descent
    beyond: FloatArray  # depth of fall at terminal speed, in v_lim^2 / g
    status: NDArray[np.int8]
    slope_unit: FloatArray | float = 1.0  # what multiplies each kind of result
    length_unit: FloatArray | float = 1.0
    time_unit: FloatArray | float = 1.0
    speed_unit: FloatArray | float = 1.0
    run: FloatArray | float = 0.0  # straight run-in: its length, time and loss of speed
    run_time: FloatArray | float = 0.0
    run_loss: FloatArray | float = 1.0

    @property
    def reach(self) -> FloatArray:
        """x / cos(alpha0)."""
        fall = self.across2 / self.cos0 * self.down.sums["x"]
        return np.asarray(self.length_unit * (self.up["x"] + self.run + fall))

    @property
    def t(self) -> FloatArray:
        """Time."""
        fall = np.sqrt(self.across2) * self.down.sums["t"] + self.tail * np.sqrt(self.v2)
        return np.asarray(self.time_unit * (self.up["t"] + fall + self.run_time))

    @property
    def tangent(self) -> FloatArray:
        """-tan(alpha_s)."""
        return np.asarray(self.slope_unit * np.sqrt(self.down.P))

    @property
    def delta(self) -> FloatArray:
        """Slope come down in all, asinh(tan alpha0) + asinh(tangent)."""
        return np.asarray(self.slope_unit * (self.slope + self.down.delta))

    @property
    def speed(self) -> FloatArray:
        """Speed."""
        u = 1 + self.top.v2 * bracket_gap(self.top, self.down.delta)[0]
        speed = np.sqrt(self.across2 * (1 + self.down.P) / u) / self.run_loss
        return np.asarray(self.speed_unit * speed)

    @property
    def curve(self) -> FloatArray:
        """Length of path between the run-in and the tail (eq. 19)."""
        gap = bracket_gap(self.top, self.down.delta)[0]
        fallen = np.where(self.sin0 > 0, self.across2, 1.0) * gap * log1p_ratio(self.top.v2 * gap)
        rise = self.gap_up * log1p_ratio(self.v2 * self.gap_up)
        return np.asarray(self.length_unit * 0.5 * (rise + fallen))

    @property
    def tail(self) -> FloatArray:
        """Length of path at terminal speed, at the end of a deep fall."""
        return np.divide(self.beyond, self.v2, out=np.zeros_like(self.v2), where=self.beyond > 0)

    @property
    def error(self) -> FloatArray:
        """Estimate of the relative error of x and t: rounding, its growth, and the last step.

        An error e in height is one of e / tan(alpha_s) in x and e / (v sin(alpha_s)) in t, which
        is much near the apex.
        """
        level = EPSILON * (np.abs(self.up["y"]) + np.abs(self.height))
        fallen = self.tangent * self.reach * self.cos0
        sine = self.tangent / np.sqrt(1 + self.down.P)
        in_x = np.divide(
            level, fallen, out=np.zeros_like(level), where=(fallen > 0) & (self.beyond == 0)
        )
        across = self.speed * sine * self.t
        in_t = np.zeros_like(level)
        with np.errstate(invalid="ignore"):
            np.divide(level, across, out=in_t, where=across > 0)
        in_t[np.isnan(in_t)] = np.inf  # both are
        rounding = EPSILON * (8 + 2 * (self.slope + self.down.delta))
        return np.asarray(rounding + 2 * np.maximum(in_x, in_t) + self.down.error)


def fly(v: FloatArray, alpha0: FloatArray, height: FloatArray, wanted: tuple[str, ...]) -> Flight:
    """Landings of one block of launches; `wanted` holds "x" or "t" or both.

    Arrays are 1-D and finite, `height` in units of v_e^2 / g.
    """
    shallow = (height == 0) & (alpha0 > 0) & (alpha0 < SHALLOWEST)
    if not (shallow | (v > FASTEST)).any():
        return _fly(v, alpha0, height, wanted)
    shrink = np.where(shallow, alpha0 / SHALLOWEST, 1.0)
    alpha = np.where(shallow, SHALLOWEST, alpha0)
    steep_v = v * np.sqrt(shrink)  # the same v^2 alpha0
    fast, run = run_in(steep_v)
    length = run / FASTEST**2
    rise = np.sin(alpha) * length
    lands = (height >= 0) & (rise + height < 0)  # within the run-in itself
    part = np.where(lands, height / np.where(lands, -rise, 1.0), 1.0)
    flight = _fly(fast, alpha, np.where(lands, 0.0, height + rise), wanted)
    # results are in units of v: what was computed had slowed from v sqrt(shrink)
    slowed = np.minimum(FASTEST / np.maximum(steep_v, 1.0), 1.0) * np.maximum(v / FASTEST, 1.0)
    return replace(
        flight,
        run=part * length,
        run_time=np.expm1(part * run) / np.maximum(steep_v, 1.0) / FASTEST,
        run_loss=np.exp((part - 1) * run),
        slope_unit=shrink,
        length_unit=shrink * slowed**2,
        time_unit=shrink * slowed,
        speed_unit=slowed,
    )


def _fly(v: FloatArray, alpha0: FloatArray, height: FloatArray, wanted: tuple[str, ...]) -> Flight:
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    v2 = v * v
    begin = start(v2, sin0, cos0)
    wanted = ("y", *wanted)

    # up to the apex
    slope = np.arcsinh(np.maximum(sin0, 0.0) / cos0)
    up = arc(begin, None, slope, wanted)
    gap_up = bracket_gap(begin, slope)[0]
    fall = up["y"] + height

    # and down from there, or from a launch that is already downward
    across2 = cos0 * cos0 / (1 + v2 * gap_up)
    level = np.zeros_like(v)
    top, P_start = Start(v2 * across2, level, level + 1, level + 1), level
    downward = sin0 < 0
    if downward.any():
        top = Start(*(np.where(downward, a, b) for a, b in zip(begin, top, strict=True)))
        P_start = np.where(downward, (sin0 / cos0) ** 2, 0.0)
    fallen = np.maximum(fall, 0.0)
    with np.errstate(over="ignore"):  # where it is too deep to count
        drop, beyond, depth = fallen / across2, level, v2 * fallen
    w = v2 * across2
    if (depth > TERMINAL).any():
        deepest = TERMINAL + np.log(np.maximum(w, 1.0)) / 2
        beyond = np.maximum(depth - deepest, 0.0)
        drop = np.where(beyond > 0, deepest / np.where(beyond > 0, w, 1.0), drop)
    down = descend(top, P_start, drop, wanted)
    status = np.where(fall < 0, UNREACHABLE, np.where(down.converged, CONVERGED, NOT_CONVERGED))
    return Flight(
        v2, sin0, cos0, height, slope, gap_up, up, across2, top, down, beyond,
        status.astype(np.int8),
    )  # fmt: skip


def climb(v: FloatArray, alpha0: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x, y, t of the apex above the launch; zero for a downward launch, which is its own apex."""
    fast, run = run_in(v)
    angle = np.maximum(alpha0, 0.0)
    sin0, cos0 = np.sin(angle), np.cos(angle)
    slope = np.arcsinh(sin0 / cos0)
    up = arc(start(fast * fast, sin0, cos0), None, slope, ("x", "y", "t"))
    length = np.where(angle > 0, run / FASTEST**2, 0.0)
    return cos0 * (up["x"] + length), up["y"] + sin0 * length, up["t"]


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
