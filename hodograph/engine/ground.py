"""From where on a flight falls to sloping ground, where a wind may turn a fall into a climb again.

Over ground of slope beta the height changes at the rate v_y - m v_x, m = tan(beta).  In the terms
of `stride`, with the wind W over the launch speed and along the cosine of the heading,

    E (v_y - m v_x) = P - m along c - m W E,

which falls all the way, so that there is one top, unless m W < 0 and E grows faster than P falls:
where the ground sinks away under a body that is blown downhill.  Then the tops and the bottoms are
found first, which takes no quadrature of the path.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hodograph.engine import flight as flying
from hodograph.engine import march, power, stride
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.goal import Goal
from hodograph.engine.velocity import start

SAMPLES = 48  # of the rate, in each of two spacings
BISECTIONS = 60


def is_blown(v: FloatArray, n: FloatArray, goal: Goal) -> BoolArray:
    """Whether a fall might turn into a climb again; no speed exceeds the first and the terminal."""
    return goal.t * np.maximum(v**n, v) > 1


def last_top(
    v: FloatArray, alpha0: FloatArray, n: FloatArray, goal: Goal
) -> tuple[FloatArray, BoolArray]:
    """The slope come down at the top from which the flight falls to the ground, if it does."""
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    slope0 = np.arcsinh(sin0 / cos0)
    begin = start(v * v, sin0, cos0)

    def rate(delta: FloatArray) -> FloatArray:
        """E times the rate, at a row of slopes for each launch."""
        each = [np.repeat(part, delta.shape[1]) for part in begin]
        many = np.repeat(n, delta.shape[1])
        _, e = flying.arc(type(begin)(*each), None, delta.ravel(), many, ())
        E = (1 + e.reshape(delta.shape)) ** (1 / n[:, np.newaxis])
        P = cos0[:, np.newaxis] * np.sinh(slope0[:, np.newaxis] - delta)
        level = (goal.x * cos0)[:, np.newaxis]
        return P + level + goal.t[:, np.newaxis] * E

    _, e = flying.arc(begin, None, np.maximum(slope0, 0.0), n, ())
    across = v * cos0 * (1 + e) ** (-1 / n)
    end = slope0 + np.maximum(np.maximum(-np.log(across), -slope0), 0.0) + stride.FINAL
    eta = power.slowing(v, n)
    part = np.linspace(0.0, 1.0, SAMPLES)
    grid = np.concatenate(
        [eta[:, None] * np.expm1(np.log1p(end / eta)[:, None] * part), end[:, None] * part], axis=1
    )
    turns, real, rose, rises = _turns(rate, np.sort(grid, axis=1))

    above, top = goal.value <= 0, np.zeros_like(v)
    found, done = above & ~rises, np.zeros(v.shape, bool)
    for k in range(turns.shape[1]):
        here = march.at_slope(v, alpha0, turns[:, k], n)
        above = goal.x * here.x + goal.y * here.y + goal.t * here.t >= goal.value
        summit, bottom = real[:, k] & rose[:, k] & ~done, real[:, k] & ~rose[:, k] & ~done
        done |= bottom & found & ~above
        top, found = np.where(summit, turns[:, k], top), np.where(summit, above, found)
        found &= ~bottom | done
    return top, found


def _turns(
    rate: Callable[[FloatArray], FloatArray], grid: FloatArray
) -> tuple[FloatArray, BoolArray, BoolArray, BoolArray]:
    """Where a rate changes sign between the slopes of a grid, in a row for each launch.

    Then which of a row are real, the others filling it up; which are tops, the rate being positive
    before them; and whether it is so at first.
    """
    rises = rate(grid) > 0
    turn = rises[:, 1:] != rises[:, :-1]
    most = int(turn.sum(axis=1).max(initial=0))
    order = np.argsort(~turn, axis=1, kind="stable")[:, :most]
    low = np.take_along_axis(grid, order, axis=1)
    high = np.take_along_axis(grid, order + 1, axis=1)
    rose = np.take_along_axis(rises, order, axis=1)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        same = (rate(middle) > 0) == rose
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low, np.take_along_axis(turn, order, axis=1), rose, rises[:, 0]
