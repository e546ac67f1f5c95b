"""A path at one of its slopes, and how the place there answers to the launch.

With T = tan(alpha0) and p the slope where the path stands, in units of the launch, a change of T
moves the path at a fixed x by

    M = dy/dT = cos(alpha0) [L0 - 2 (sin(alpha0) + v^n) times the integral of C L / U^(1 + 2/n)],

over d(delta), with L = cos(alpha0) (tan(alpha) - p) and L0 its value at the launch.  By parts,

    L0 - 2 v^n (...) = integral of U^(-2/n) [C^(2 - n) - (n - 1) sin(alpha) L C^(1 - n)].
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.flight import arc
from hodograph.engine.velocity import Ahead, start


class Path(NamedTuple):
    """A path at the slope p = T - D: where it is, and how it answers."""

    x: FloatArray
    y: FloatArray
    t: FloatArray
    p: FloatArray
    m: FloatArray  # v_x^2, which is -dx/dp
    bend: FloatArray  # d(ln m)/dp
    M: FloatArray  # dy/dT at fixed x
    turn: FloatArray  # dx/dT at fixed p
    faster: tuple[
        FloatArray, FloatArray, FloatArray
    ]  # d(v^2 x, v^2 y, v t)/d(ln v) / (v^2, v^2, v)
    turn_t: FloatArray  # dt/dT at fixed p


def slope_drop(T: FloatArray, D: FloatArray) -> FloatArray:
    """delta = asinh(T) - asinh(T - D), without subtracting the two."""
    p = T - D
    one, other = T * np.hypot(1.0, p), p * np.hypot(1.0, T)
    alike = T * p > 0
    whole = np.where(alike, one + other, 1.0)
    return np.asarray(np.arcsinh(np.where(alike, D * ((T + p) / whole), one - other)))


def path(v: FloatArray, n: FloatArray, T: FloatArray, D: FloatArray, timed: bool = False) -> Path:
    """The paths of launches of slope T where their slope is T - D; the last of it if `timed`.

    What is not finite gets the slope NaN, from which no step is near anything.
    """
    sane = np.isfinite(T) & np.isfinite(D) & np.isfinite(slope_drop(T, D)) & np.isfinite(v**n)
    if not sane.all():
        v, T, D = np.where(sane, v, 1.0), np.where(sane, T, 0.0), np.where(sane, D, 1.0)
    c = 1 / np.hypot(1.0, T)
    sin, p, delta, vn = T * c, np.where(sane, T - D, np.nan), slope_drop(T, D), v**n
    ahead = Ahead(delta, np.ones_like(T), np.zeros_like(T))
    names = ("x", "y", "t", "push", "parts", "drive", *(("drive_t",) if timed else ()))
    sums, e = arc(start(v * v, sin, c), np.arcsinh(T), delta, n, names, ahead)
    U, push = 1 + e, sums["push"]
    fast = c ** (n - 1) * v * v > 1  # which loses the fewer digits
    gain = np.where(fast, sums["parts"] - 2 * sin * push, c * D - 2 * (sin + vn) * push)
    across = c * U ** (-1 / n)
    bend = 2 * vn * (c / U) * (c * np.hypot(1.0, p)) ** (n - 1)
    turn = c * c * (1 - 2 * (sin + vn) * sums["drive"])
    x = c * sums["drive"]
    late = sums.get("drive_t", x)
    faster = 2 * x, 2 * (push + p * x), late
    return Path(
        c * sums["x"], sums["y"], sums["t"], p, across * across, bend, c * gain, turn,
        faster, c - c * (sin + vn) * late,
    )  # fmt: skip


def is_short(P: Path, n: FloatArray, dp: FloatArray, part: float) -> BoolArray:
    """Whether a step of the slope changes it, or the speed across, by no more than a part."""
    size, after = np.hypot(1.0, P.p), np.hypot(1.0, P.p + dp)
    bend = P.bend * np.maximum(after / size, 1.0) ** (n - 1)
    return np.asarray((np.abs(dp) <= part * size) | (np.abs(dp) * bend <= part))
