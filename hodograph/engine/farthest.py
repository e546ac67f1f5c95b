"""The angle of greatest range on any ground and in any wind, among all launches forward.

While alpha0 changes, a point at a fixed time moves by dR, and with the velocity v over the ground
the landing on ground of slope beta moves along x by

    dx = (dR_x v_y - dR_y v_x) / (v_y - v_x tan(beta)),

which is 0 at the greatest range.  Since v = v_air + W, and v_air takes out what the time changes,

    dR_x v_y - dR_y v_x = (p dx - dy) v_x,air - W dR_y,

dx and dy at a fixed slope p of the path.  The landings of a row of angles tell between which two
the greatest range is, and the secant of this finds it there.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hodograph.engine import state
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.response import path
from hodograph.engine.status import Status

ANGLES, FINER = 41, 12  # that are looked at first; the middle one is level
MANY = 400  # launches looked at together
STEPS = 80
ENOUGH = 3e-16  # the product of the last two steps
# Slope past the first at which speed is terminal, in its units, from which all is final: to more
# digits than the difference of dy and p dx there loses, which matters in a wind alone.
STEEP, STEEPEST = 3e4, 1e15


@np.errstate(all="ignore")
def ranges(
    alpha0: FloatArray, *scene: FloatArray, rates: bool = True
) -> tuple[FloatArray, FloatArray, Codes]:
    """x of the landings, -inf where there is none, how it grows with the angle, and the status."""
    v0, v_lim, g, height, n, slope, wind = scene
    zero = np.zeros_like(v0)
    own, air, _, found = state.meet_ground(
        v0, alpha0, v_lim, g, height, n, slope, wind, zero
    )  # fmt: skip
    x = np.where(found.t == 0, 0.0, state.over_ground(own, air, found, height)[1])
    landed = found.status == Status.CONVERGED
    x = np.where(landed, x, -np.inf)
    if not rates:
        return x, x, found.status

    T = np.tan(air.alpha0)
    steep = np.where((wind == 0) | (n == 1), STEEPEST, STEEP ** np.maximum(1.0, 2 / n))
    most = T + steep * np.maximum(np.hypot(1.0, T) / own.v, 1.0)
    at = path(own.v, n, T, np.minimum(T - found.v_y / found.v_x, most), timed=True)
    p, w, W = at.p, np.sqrt(at.m), air.along * wind / own.speed
    # how the velocity through the air turns and grows: along it and up, in its own size
    ahead, up = np.cos(air.alpha0), np.sin(air.alpha0)
    change = v0 / own.speed
    forth, raised = -air.along * change * np.sin(alpha0), change * np.cos(alpha0)
    turns = (ahead * raised - up * forth) * (1 + T * T)  # of T
    grows = ahead * forth + up * raised
    push = 0.5 * at.faster[1] - p * at.faster[0] / 2
    across = -w * (at.M * turns + 2 * push * grows)
    rise = (at.M + p * at.turn - p * w * at.turn_t) * turns
    rise = rise + (at.faster[1] - p * w * at.faster[2]) * grows
    linear = raised * -np.expm1(-own.v * found.t) / own.v
    rise = np.where(n == 1, linear, rise)
    falls = p * w - np.tan(slope) * air.along * (w + W)
    rate = air.along * (across - np.where(W == 0, 0.0, W * rise)) / falls * own.length
    rate = np.where(found.t == 0, np.inf, rate)  # into the ground: higher is farther
    rate = np.where(landed, rate, np.nan)
    return x, rate, found.status


def best(*scene: FloatArray) -> tuple[FloatArray, Codes]:
    """The angles of greatest range, in [-pi/2, pi/2]; unreachable where there is none."""
    angle, codes = np.empty_like(scene[0]), np.empty(scene[0].shape, np.int8)
    for first in range(0, angle.size, MANY):
        part = slice(first, first + MANY)
        angle[part], codes[part] = _best(ANGLES, *(row[part] for row in scene))
    nowhere = np.flatnonzero(codes == Status.UNREACHABLE)
    for first in range(0, nowhere.size, MANY // FINER):  # or within so few angles?
        at = nowhere[first : first + MANY // FINER]
        angle[at], codes[at] = _best(FINER * ANGLES, *(row[at] for row in scene))
    return angle, codes


class Summit(NamedTuple):
    """The greatest range known so far: the angle `top`, which lies between `low` and `high`."""

    low: FloatArray
    high: FloatArray
    top: FloatArray
    most: FloatArray  # the range there, -inf where there is none
    angle: FloatArray  # that of the parabola through the ranges about it
    bend: FloatArray  # its second derivative
    status: Codes  # unreachable where there is none, or no greatest


@np.errstate(all="ignore")
def _look(number: int, *scene: FloatArray) -> Summit:
    """The greatest range in a row of angles."""
    size, height, slope = scene[0].size, scene[3], scene[5]
    row = np.linspace(-RIGHT_ANGLE, RIGHT_ANGLE, number)
    many = [np.tile(part, number) for part in scene]
    found = ranges(np.repeat(row, size), *many, rates=False)
    x, _, status = (part.reshape(number, size) for part in found)
    # the last of equals: launches into the ground end where they began
    k, each = number - 1 - np.argmax(x[::-1], axis=0), np.arange(size)
    before, after = np.maximum(k - 1, 0), np.minimum(k + 1, number - 1)
    low, high, top, most = row[before], row[after], row[k], x[k, each]
    codes = np.where(np.isneginf(most), status.min(axis=0), Status.NOT_CONVERGED).astype(np.int8)
    lost = (status == Status.UNREACHABLE).any(axis=0)
    forever = (height >= 0) & (slope < 0) & lost  # downhill: there is no greatest
    codes[forever], most = Status.UNREACHABLE, np.where(forever, -np.inf, most)
    space = row[1] - row[0]
    bend = (x[before, each] - 2 * most + x[after, each]) / space**2
    step = (x[before, each] - x[after, each]) / (2 * space * bend)
    angle = np.where((np.abs(step) < space) & (k > before) & (k < after), top + step, top)
    angle = np.where(angle == top, 0.5 * (low + high), angle)
    return Summit(low, high, top, most, angle, bend, codes)


@np.errstate(all="ignore")
def _best(number: int, *scene: FloatArray) -> tuple[FloatArray, Codes]:
    """The angles of greatest range, by the secant from the greatest in a row of angles."""
    low, high, top, most, angle, bend, codes = _look(number, *scene)
    slant = np.where((bend < 0) & np.isfinite(bend), bend, np.nan)
    last, moved = np.full_like(top, np.nan), np.ones_like(top)
    todo = np.flatnonzero(~np.isneginf(most))
    for _ in range(STEPS):
        if not todo.size:
            break
        now = angle[todo]
        there, rate, _ = ranges(now, *(part[todo] for part in scene))
        rises = np.where(np.isnan(rate), now < top[todo], rate > 0)
        low[todo] = np.where(rises, now, low[todo])
        high[todo] = np.where(rises, high[todo], now)
        better = there >= most[todo]
        top[todo] = np.where(better, now, top[todo])
        most[todo] = np.where(better, there, most[todo])
        secant = (rate - last[todo]) / moved[todo]
        first = np.where(np.isnan(last[todo]), slant[todo], np.nan)
        secant = np.where((secant < 0) & np.isfinite(secant), secant, first)
        following = now - rate / secant
        inside = (following >= low[todo]) & (following <= high[todo])
        still = inside & (np.abs(following - now) * np.abs(moved[todo]) < ENOUGH)
        narrow = high[todo] - low[todo] <= 4e-16
        following = np.where(inside, following, 0.5 * (low[todo] + high[todo]))
        following = np.where(narrow, top[todo], following)
        angle[todo], last[todo], moved[todo] = following, rate, following - now
        done = still | narrow
        codes[todo[done]] = Status.CONVERGED
        todo = todo[~done]
    landed = np.isfinite(ranges(angle, *scene, rates=False)[0])
    return np.where(landed, angle, top), codes
