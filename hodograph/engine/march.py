"""To where x, y, t and the length of path add up to a given number: marched to, then met exactly.

A few steps of Runge and Kutta (see `stride`) come near, the arc to there is integrated exactly,
and the step that is left is so short that Runge and Kutta's error is below rounding: most places
are met after one arc.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from hodograph.engine import flight as flying
from hodograph.engine import power, stride
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.flight import EPSILON
from hodograph.engine.goal import Found, Goal, Point
from hodograph.engine.status import Status
from hodograph.engine.velocity import start

MAX_ARCS = 40
STEEP = 15.0  # asinh(tan(alpha)) from which no rule on hand integrates across the apex and far on


def origin(alpha0: FloatArray) -> Point:
    """The launch."""
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    nil = [np.zeros_like(alpha0) for _ in range(5)]
    return Point(np.ones_like(alpha0), np.arcsinh(sin0 / cos0), sin0, cos0, *nil)


def advance(
    here: Point, v: FloatArray, cos0: FloatArray, delta: FloatArray, n: FloatArray, lag: bool
) -> Point:
    """The point where the slope has come down by `delta` more, by quadrature."""
    over = (here.slope > STEEP) & (delta > here.slope)
    if over.any():  # the apex is a sharp turn
        part, i = (
            advance(here, v, cos0, np.where(over, here.slope, delta), n, lag),
            over.nonzero()[0],
        )
        part.put(i, advance(part.at(i), v[i], cos0[i], (delta - here.slope)[i], n[i], lag))
        return part
    speed = v * here.quick
    begin = start(speed * speed, here.sin, here.cos)
    names = ("x", "y", "t", "s", "lag") if lag else ("x", "y", "t", "s")
    leg, e = flying.arc(begin, here.slope, delta, n, names)
    slope = here.slope - delta
    cosine, sine = 1 / np.cosh(slope), np.tanh(slope)
    slower = 1 / np.sqrt(1 + e) if power.is_square(n) else (1 + e) ** (-1 / n)
    length = here.quick * here.quick
    late = here.lag
    if lag:
        late = late + _late(here, v, cos0, leg["t"], leg["lag"])
    return Point(
        here.quick * (here.cos / cosine) * slower,
        slope,
        sine,
        cosine,
        here.x + here.cos * length * leg["x"],
        here.y + length * leg["y"],
        here.t + here.quick * leg["t"],
        here.s + length * leg["s"],
        late,
    )


def _late(
    here: Point, v: FloatArray, cos0: FloatArray, t: FloatArray, lag: FloatArray
) -> FloatArray:
    """What a time t from here, as long as a launch from here lags, adds to the lag."""
    across = here.quick * here.cos / cos0
    late = here.quick * ((1 - across) * t + across * lag)
    return np.where(v == 0, 0.0, late)  # vacuum holds nothing back


def _fall(here: Point, v: FloatArray, goal: Goal, rest: FloatArray) -> list[Any]:
    """What a fall at terminal speed, where v_x decays as exp(-v t), adds to a `Point`.

    x, y, t, s, then v_x, v_y, and whether the goal is never reached.
    """
    across = here.quick * here.cos
    pull, steady = goal.x * across, (goal.s - goal.y) / v + goal.t
    t = np.zeros_like(v)
    for _ in range(stride.MAX_STEPS):
        drawn = pull * np.exp(-v * t)
        left = rest - (pull * -np.expm1(-v * t) / v + steady * t)
        h, lost = stride.step(left, drawn + steady, -v * drawn, goal.way)
        t = t + h
        if (np.abs(h) <= EPSILON * t).all():
            break
    slow = steady == 0  # no more than to the asymptote
    if slow.any():
        part = np.divide(rest * v, pull, out=np.full_like(v, np.inf), where=pull != 0)
        lost, inside = np.where(slow, part >= 1, lost), slow & (part < 1)
        t = np.where(inside, -np.log1p(-np.where(inside, part, 0.0)) / v, t)
    decay = np.exp(-v * t)
    return [across * -np.expm1(-v * t) / v, -t / v, t, t / v, across * decay, -1 / v, lost]


def _nowhere(v: FloatArray) -> Found:
    x, y, t, s, lag, v_x, v_y = (np.full_like(v, np.nan) for _ in range(7))
    codes = np.full(v.shape, Status.NOT_CONVERGED, np.int8)
    return Found(x, y, t, s, lag, v_x, v_y, codes)


def _approach(
    own: Point,
    aim: Goal,
    rest: FloatArray,
    launch: tuple[FloatArray, FloatArray, FloatArray],
    fall: BoolArray,
    brief: float,
) -> tuple[stride.March, list[FloatArray], BoolArray]:
    """The march from these points, what it found by the rows of `Found`, and which are lost."""
    v, n, cos0 = launch
    quick, q2 = own.quick, own.quick**2
    near = aim._replace(t=aim.t / quick, value=rest / q2)
    slack = 4 * EPSILON * aim.size(own) / q2
    found = stride.march(own.sin, own.cos, v * quick, near, n, slack, brief)
    x, y, t, s = q2 * found.x, q2 * found.y, quick * found.t, q2 * found.s
    v_x, v_y, lost = quick * own.cos / found.E, quick * found.P / found.E, found.lost
    if fall.any():
        i = np.flatnonzero(fall)
        x[i], y[i], t[i], s[i], v_x[i], v_y[i], lost[i] = _fall(own.at(i), v[i], aim.at(i), rest[i])
    late = np.where(fall, t - x / cos0, _late(own, v, cos0, found.t, found.lag))
    return found, [own.x + x, own.y + y, own.t + t, own.s + s, own.lag + late, v_x, v_y], lost


def _settled(here: Point, goal: Goal, final: Found) -> BoolArray:
    """Which launches are at their goals already, or have them behind: this is put in `final`."""
    rest, rate = goal.value - goal.so_far(here), goal.rate(here)
    already = (rest == 0) & ((goal.way > 0) | (rate <= 0))
    none = 8 * EPSILON * np.where(goal.t != 0, np.abs(goal.x), 0.0)  # left of their difference
    below = (rest < 0) | ((rest > 0) & (rate < -none))
    behind = np.where(goal.way > 0, below, (rest > 0) & (rate <= 0))
    if already.any():
        nil = np.zeros(np.count_nonzero(already))
        at_start = nil, nil, nil, nil, nil, here.cos[already], here.sin[already]
        final.put(np.flatnonzero(already), at_start, nil > 0)
    final.status[behind] = Status.UNREACHABLE
    return np.asarray(already | behind)


def _begun(
    own: Point,
    now: FloatArray,
    following: FloatArray,
    alpha0: FloatArray,
    v: FloatArray,
    n: FloatArray,
) -> tuple[Point, FloatArray]:
    """Where the next arc begins, and by how much the slope comes down along it.

    Far back, it begins at the launch, since a path forgets where it came from.
    """
    step = following - now
    if (step >= 0).all():
        return own, step
    back = step < -0.1 * power.slowing(v * own.quick, n)
    if back.any():
        own = Point(*(np.where(back, b, a) for a, b in zip(own, origin(alpha0), strict=True)))
    return own, np.where(back, following, step)


def follow(
    v: FloatArray,
    alpha0: FloatArray,
    n: FloatArray,
    goal: Goal,
    lag: bool = False,
    after: FloatArray | None = None,
) -> Found:
    """Where the launches first pass their goals, on past any ground.

    `after` is by how much the slope has come down at least.
    """
    here, cos0, final = origin(alpha0), np.cos(alpha0), _nowhere(v)
    over = _settled(here, goal, final)
    todo = np.flatnonzero(~over)
    low, high = np.zeros_like(v), np.full_like(v, np.inf)  # slope come down
    gone, sunk = np.zeros_like(v), np.zeros(v.shape, bool)
    if after is not None:
        todo = np.flatnonzero(~over | (after > 0))
        here, gone, low = advance(here, v, cos0, after, n, lag), after.copy(), after.copy()
    for number in range(MAX_ARCS if todo.size else 0):
        own, aim, v_, n_, c0 = here.at(todo), goal.at(todo), v[todo], n[todo], cos0[todo]
        rest = aim.value - aim.so_far(own)
        before = aim.is_ahead(own, rest) | (number == 0)
        fall = sunk[todo] & before
        brief = stride.SHORT if number else stride.FIRST
        found, rows, lost = _approach(own, aim, rest, (v_, n_, c0), fall, brief)
        met = found.short | fall
        if met.any():
            final.put(todo[met], [row[met] for row in rows], lost[met])
            if met.all():
                break
        # between what is known to lie before the place, and behind it
        far = ~met
        todo, own, before = todo[far], own.at(far), before[far]
        now, v_, n_ = gone[todo], v_[far], n_[far]
        low[todo] = np.where(before, now, low[todo])
        high[todo] = np.where(before, high[todo], now)
        following = now + stride.slope_come_down(own.sin, own.cos, found.P[far], found.gone[far])
        least, most = low[todo], high[todo]
        safe = (following >= least) & (following <= most)
        following = np.where(safe, following, 0.5 * (least + np.where(most < np.inf, most, least)))
        own, step = _begun(own, now, following, alpha0[todo], v_, n_)
        part = advance(own, v_, cos0[todo], step, n_, lag)
        here.put(todo, part)
        gone[todo], sunk[todo] = following, found.deep[far]
    return final


def at_slope(
    v: FloatArray, alpha0: FloatArray, delta: FloatArray, n: FloatArray, lag: bool = False
) -> Found:
    """Where the slope has come down by `delta`."""
    here = advance(origin(alpha0), v, np.cos(alpha0), delta, n, lag)
    codes = np.full(v.shape, Status.CONVERGED, np.int8)
    speed = here.quick
    return Found(
        here.x, here.y, here.t, here.s, here.lag, speed * here.cos, speed * here.sin, codes
    )
