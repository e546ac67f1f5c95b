"""Runge and Kutta's steps along a path, to where x, y, t and its length add up to a number.

In units of a launch of speed 1, with c = cos(alpha0), P = c tan(alpha), C = c / cos(alpha) and
E = U^(1/n) (eq. 8), the path in time is

    P' = -E,    E' = v^n C^(n - 1) E^(2 - n),    C = sqrt(c^2 + P^2),
    x' = c / E,    y' = P / E,    s' = C / E,

in which nothing is stiff, and vacuum is a straight line.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import power
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.fall import TINY
from hodograph.engine.flight import EPSILON
from hodograph.engine.goal import Goal

GROWTH = 0.7  # of E^(n / 2) in one step, at most
SHORT = 2e-3  # steps after which Runge and Kutta's fifth powers are below rounding
FIRST = SHORT / 8  # and their fourth, where no way lies behind
ROUGH = 1e-3  # what may be left of the way before the arc is integrated
SHORT_STEPS, MAX_STEPS = 12, 1000
# Slope past the first at which speed can be terminal, where it is: see `power.FINAL`.
FINAL = power.FINAL + 1


class March(NamedTuple):
    """Where a march came to, in units of its own beginning."""

    P: FloatArray
    gone: FloatArray  # by how much P has come down
    E: FloatArray
    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
    lag: FloatArray  # t - x / cos(alpha0), of that launch
    short: BoolArray  # its steps were short enough to be exact
    deep: BoolArray  # speed is terminal, straight down
    lost: BoolArray  # the sum turned round before it was there


def _slopes(
    c2: FloatArray, P: FloatArray, E: FloatArray, vn: FloatArray, n: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """C, 1 / E and E'."""
    C = np.sqrt(c2 + P * P)
    if power.is_square(n):
        return C, 1 / E, vn * C
    return C, 1 / E, vn * C ** (n - 1) * E ** (2 - n)


def march(
    sin: FloatArray,
    cos: FloatArray,
    v: FloatArray,
    goal: Goal,
    n: FloatArray,
    slack: FloatArray,
    brief: float,
) -> March:
    """Runge and Kutta from a launch of speed 1 to the goal: to the last digit by `brief` steps."""
    size = sin.shape
    G, gone, x, y, t, s, lag = (np.zeros(size) for _ in range(7))  # G is E - 1
    short, deep, lost = np.ones(size, bool), np.zeros(size, bool), np.zeros(size, bool)
    vn, c2, lengths = v**n, cos * cos, bool(goal.s.any())
    late_v = 1 / np.maximum(v, 1e-150)
    memory = np.maximum(np.maximum(cos, np.abs(sin)), late_v)
    late = np.exp(FINAL * np.maximum(1.0, 2 / n))
    todo = np.arange(sin.size)
    for number in range(MAX_STEPS):
        at: slice | NDArray[np.intp] = slice(None) if todo.size == sin.size else todo
        P_, G_, c2_, c_, vn_, n_ = sin[at] - gone[at], G[at], c2[at], cos[at], vn[at], n[at]
        E_ = 1 + G_
        gx, gy, gt, gs, value, way = (part[at] for part in goal)
        C1, i1, e1 = _slopes(c2_, P_, E_, vn_, n_)
        # what rests of the sum, its rate, and the rate of that
        rest = value - (gx * x[at] + gy * y[at] + gt * t[at] + gs * s[at])
        drawn = (gx * c_ + gy * P_ + gs * C1) * i1
        decay = e1 * i1
        h, turned = step(rest, drawn + gt, -decay * drawn - gy - gs * P_ / C1, way)
        lost[at] = turned & (np.abs(rest) > slack[at])
        most = np.minimum(GROWTH / np.maximum(decay, TINY), late_v[at]) / np.maximum(n_ / 2, 1)
        if lengths:  # which grow by the speed, and that turns sharply over a steep apex
            most = np.minimum(most, 0.9 * C1 * i1)
        h = np.maximum(np.minimum(h, most), -most)
        local = np.abs(h) * np.maximum(decay, E_ / np.maximum(C1, TINY))
        short[at] &= local <= brief
        ended = (np.abs(rest) <= slack[at]) & (way * (drawn + gt) >= 0)  # not at its first passing
        ended |= np.abs(h) <= 4 * EPSILON * np.abs(t[at])
        done = np.where(short[at] & (number < SHORT_STEPS), ended, local <= min(brief, ROUGH))
        memory[at] = np.where(P_ >= 0, np.maximum(memory[at], E_ * late_v[at]), memory[at])
        deep[at] = memory[at] * late[at] < -P_
        done |= deep[at]
        h = np.where(done, 0.0, h)

        come, grown, over, *others = _stride(P_, G_, (C1, i1, e1), c2_, vn_, n_, h)
        added = h, come, grown, c_ * over, *others
        for whole, part in zip((t, gone, G, x, y, s, lag), added, strict=True):
            whole[at] += part
        todo = todo[~done]
        if not todo.size:
            break
    return March(sin - gone, gone, 1 + G, x, y, t, s, lag, short, deep, lost)


def _stride(
    P: FloatArray,
    G: FloatArray,
    first: tuple[FloatArray, FloatArray, FloatArray],
    c2: FloatArray,
    vn: FloatArray,
    n: FloatArray,
    h: FloatArray,
) -> tuple[FloatArray, ...]:
    """What a step of Runge and Kutta adds to -P, to E, and to 1, P, C and E - 1 over E in time."""
    E, half, part = 1 + G, 0.5 * h, h / 6
    C1, i1, e1 = first
    P2, G2, E2 = P - half * E, G + half * e1, E + half * e1
    C2, i2, e2 = _slopes(c2, P2, E2, vn, n)
    P3, G3, E3 = P - half * E2, G + half * e2, E + half * e2
    C3, i3, e3 = _slopes(c2, P3, E3, vn, n)
    P4, G4, E4 = P - h * E3, G + h * e3, E + h * e3
    C4, i4, e4 = _slopes(c2, P4, E4, vn, n)
    return (
        part * (E + 2 * (E2 + E3) + E4),
        part * (e1 + 2 * (e2 + e3) + e4),
        part * (i1 + 2 * (i2 + i3) + i4),
        part * (P * i1 + 2 * (P2 * i2 + P3 * i3) + P4 * i4),
        part * (C1 * i1 + 2 * (C2 * i2 + C3 * i3) + C4 * i4),
        part * (G * i1 + 2 * (G2 * i2 + G3 * i3) + G4 * i4),
    )


def slope_come_down(
    sin: FloatArray, cos: FloatArray, P: FloatArray, gone: FloatArray
) -> FloatArray:
    """asinh(tan) before less asinh(tan) after, P being sin - gone: no difference is formed."""
    c2, C, product = cos * cos, np.hypot(cos, P), sin * P
    apart = c2 * (c2 + sin * sin + P * P) / np.where(product > 0, C + product, 1.0)
    mean = c2 + np.where(product > 0, apart, C - product)
    return np.asarray(np.arcsinh(gone * (mean / (c2 * (1 + C)))))


def step(
    rest: FloatArray, rate: FloatArray, bend: FloatArray, way: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Time until a parabola has passed what rests, and whether it turns before: to there then."""
    square = rate * rate + 2 * bend * rest
    turned = square < 0
    root = way * np.sqrt(np.maximum(square, 0.0))
    along = (rate * root >= 0) & ~turned
    with np.errstate(divide="ignore", invalid="ignore"):
        h = np.where(along, 2 * rest / (rate + root), (root - rate) / bend)
    return np.where(np.isfinite(h), h, 0.0), turned
