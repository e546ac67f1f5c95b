"""To where x, y, t and the length of path add up to a given number: marched to, then met exactly.

In units of a launch of speed 1, with c = cos(alpha0), P = c tan(alpha), C = c / cos(alpha) and
E = U^(1/n) (eq. 8), the path in time is

    P' = -E,    E' = v^n C^(n - 1) E^(2 - n),    C = sqrt(c^2 + P^2),
    x' = c / E,    y' = P / E,    s' = C / E,

in which nothing is stiff, and vacuum is a straight line.  A few steps of Runge and Kutta come
near, the arc to there is integrated exactly, and the step that is left is so short that Runge and
Kutta's error is below rounding: most places are met after one arc.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import flight as flying
from hodograph.engine import power
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.fall import TINY
from hodograph.engine.flight import EPSILON
from hodograph.engine.status import Status
from hodograph.engine.velocity import start

GROWTH = 0.7  # of E^(n / 2) in one step, at most
SHORT = 2e-3  # steps after which Runge and Kutta's fifth powers are below rounding
FIRST = SHORT / 8  # and their fourth, where no way lies behind
ROUGH = 1e-3  # what may be left of the way before the arc is integrated
SHORT_STEPS, MAX_STEPS, MAX_ARCS = 12, 1000, 40
STEEP = 15.0  # asinh(tan(alpha)) from which no rule on hand integrates across the apex and far on
# Slope past the first at which speed can be terminal, where it is: see `power.FINAL`.
FINAL = power.FINAL + 1


class Goal(NamedTuple):
    """Where x, y, t, s times these factors come to `value`, in units of the launch.

    `way` is the sign with which their sum passes it.
    """

    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
    value: FloatArray
    way: FloatArray

    def at(self, index: NDArray[Any]) -> Goal:
        """The elements at `index`."""
        return Goal(*(part[index] for part in self))

    def so_far(self, here: Point) -> FloatArray:
        """The sum at a point."""
        return self.x * here.x + self.y * here.y + self.t * here.t + self.s * here.s

    def size(self, here: Point | Found) -> FloatArray:
        """How large its terms are, in all."""
        x, y, t, s = self.x * here.x, self.y * here.y, self.t * here.t, self.s * here.s
        return np.abs(self.value) + np.abs(x) + np.abs(y) + np.abs(t) + np.abs(s)

    def is_ahead(self, here: Point, rest: FloatArray) -> BoolArray:
        """Whether the place lies ahead of a point; the sum grows, and may then turn and fall."""
        grows = self.rate(here) > 0
        return np.where(self.way > 0, grows & (rest >= 0), grows | (rest <= 0))

    def rate(self, here: Point) -> FloatArray:
        """How the sum grows at a point."""
        return here.quick * (self.x * here.cos + self.y * here.sin + self.s) + self.t


class Point(NamedTuple):
    """A point of the path, in units of the launch; lag is t - x / cos(alpha0), 0 unless wanted."""

    quick: FloatArray  # speed over the launch's
    slope: FloatArray
    sin: FloatArray
    cos: FloatArray
    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
    lag: FloatArray

    def at(self, index: NDArray[Any]) -> Point:
        """The elements at `index`."""
        return Point(*(part[index] for part in self))

    def put(self, index: NDArray[Any], part: Point) -> None:
        """Replace the elements at `index`."""
        for whole, piece in zip(self, part, strict=True):
            whole[index] = piece


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
    if lag:  # of x / cos(alpha0), which has fallen behind t by `behind` of its rate
        across = here.quick * here.cos / cos0
        late = late + here.quick * ((1 - across) * leg["t"] + across * leg["lag"])
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


class March(NamedTuple):
    """Where a march came to, in units of its own beginning."""

    P: FloatArray
    gone: FloatArray  # by how much P has come down
    E: FloatArray
    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
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


def _march(
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
    P, E, gone = sin.copy(), np.ones(size), np.zeros(size)
    x, y, t, s = (np.zeros(size) for _ in range(4))
    short, deep, lost = np.ones(size, bool), np.zeros(size, bool), np.zeros(size, bool)
    vn, c2, lengths = v**n, cos * cos, bool(goal.s.any())
    late_v = 1 / np.maximum(v, 1e-150)
    memory = np.maximum(np.maximum(cos, np.abs(sin)), late_v)
    late = np.exp(FINAL * np.maximum(1.0, 2 / n))
    todo = np.arange(sin.size)
    for number in range(MAX_STEPS):
        at: slice | NDArray[np.intp] = slice(None) if todo.size == sin.size else todo
        P_, E_, c2_, c_, vn_, n_ = P[at], E[at], c2[at], cos[at], vn[at], n[at]
        gx, gy, gt, gs, value, way = (part[at] for part in goal)
        C1, i1, e1 = _slopes(c2_, P_, E_, vn_, n_)
        # what rests of the sum, its rate, and the rate of that
        rest = value - (gx * x[at] + gy * y[at] + gt * t[at] + gs * s[at])
        drawn = (gx * c_ + gy * P_ + gs * C1) * i1
        decay = e1 * i1
        h, turned = _step(rest, drawn + gt, -decay * drawn - gy - gs * P_ / C1, way)
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

        half = 0.5 * h
        P2, E2 = P_ - half * E_, E_ + half * e1
        C2, i2, e2 = _slopes(c2_, P2, E2, vn_, n_)
        P3, E3 = P_ - half * E2, E_ + half * e2
        C3, i3, e3 = _slopes(c2_, P3, E3, vn_, n_)
        P4, E4 = P_ - h * E3, E_ + h * e3
        C4, i4, e4 = _slopes(c2_, P4, E4, vn_, n_)
        part = h / 6
        x[at] += c_ * part * (i1 + 2 * (i2 + i3) + i4)
        y[at] += part * (P_ * i1 + 2 * (P2 * i2 + P3 * i3) + P4 * i4)
        s[at] += part * (C1 * i1 + 2 * (C2 * i2 + C3 * i3) + C4 * i4)
        t[at] += h
        gone[at] += part * (E_ + 2 * (E2 + E3) + E4)
        P[at] = sin[at] - gone[at]
        E[at] = E_ + part * (e1 + 2 * (e2 + e3) + e4)
        todo = todo[~done]
        if not todo.size:
            break
    return March(P, gone, E, x, y, t, s, short, deep, lost)


def _slope_come_down(
    sin: FloatArray, cos: FloatArray, P: FloatArray, gone: FloatArray
) -> FloatArray:
    """asinh(tan) before less asinh(tan) after, P being sin - gone: no difference is formed."""
    c2, C, product = cos * cos, np.hypot(cos, P), sin * P
    apart = c2 * (c2 + sin * sin + P * P) / np.where(product > 0, C + product, 1.0)
    mean = c2 + np.where(product > 0, apart, C - product)
    return np.asarray(np.arcsinh(gone * (mean / (c2 * (1 + C)))))


def _step(
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


class Found(NamedTuple):
    """A point in units of the launch, and the velocity there."""

    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
    lag: FloatArray
    v_x: FloatArray
    v_y: FloatArray
    status: Codes

    def put(self, index: NDArray[Any], rows: Sequence[FloatArray], lost: BoolArray) -> None:
        """Fill in the elements at `index`."""
        for whole, row in zip(self[:-1], rows, strict=True):
            whole[index] = row
        self.status[index] = np.where(lost, Status.UNREACHABLE, Status.CONVERGED)


def _fall(here: Point, v: FloatArray, goal: Goal, rest: FloatArray) -> list[Any]:
    """What a fall at terminal speed, where v_x decays as exp(-v t), adds to a `Point`.

    x, y, t, s, then v_x, v_y, and whether the goal is never reached.
    """
    across = here.quick * here.cos
    pull, steady = goal.x * across, (goal.s - goal.y) / v + goal.t
    t = np.zeros_like(v)
    for _ in range(MAX_STEPS):
        drawn = pull * np.exp(-v * t)
        left = rest - (pull * -np.expm1(-v * t) / v + steady * t)
        h, lost = _step(left, drawn + steady, -v * drawn, goal.way)
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
    here, cos0 = origin(alpha0), np.cos(alpha0)
    final = _nowhere(v)
    rest, rate = goal.value - goal.so_far(here), goal.rate(here)
    here_already = (rest == 0) & ((goal.way > 0) | (rate <= 0))
    none = 8 * EPSILON * np.where(goal.t != 0, np.abs(goal.x), 0.0)  # left of their difference
    below = (rest < 0) | ((rest > 0) & (rate < -none))
    behind = np.where(goal.way > 0, below, (rest > 0) & (rate <= 0))
    if here_already.any():
        nil = np.zeros(np.count_nonzero(here_already))
        at_start = nil, nil, nil, nil, nil, here.cos[here_already], here.sin[here_already]
        final.put(np.flatnonzero(here_already), at_start, nil > 0)
    final.status[behind] = Status.UNREACHABLE
    todo = np.flatnonzero(~(here_already | behind))
    low, high = np.zeros_like(v), np.full_like(v, np.inf)  # slope come down
    gone, sunk = np.zeros_like(v), np.zeros(v.shape, bool)
    if after is not None:
        todo = np.flatnonzero(~(here_already | behind) | (after > 0))
        here, gone, low = advance(here, v, cos0, after, n, lag), after.copy(), after.copy()
    for number in range(MAX_ARCS if todo.size else 0):
        own, aim, v_, n_, c0 = here.at(todo), goal.at(todo), v[todo], n[todo], cos0[todo]
        rest = aim.value - aim.so_far(own)
        before = aim.is_ahead(own, rest) | (number == 0)
        quick, q2 = own.quick, own.quick**2
        near = aim._replace(t=aim.t / quick, value=rest / q2)
        slack = 4 * EPSILON * aim.size(own) / q2
        brief = SHORT if number else FIRST
        found = _march(own.sin, own.cos, v_ * quick, near, n_, slack, brief)
        x, y, t, s = q2 * found.x, q2 * found.y, quick * found.t, q2 * found.s
        v_x, v_y, lost = quick * own.cos / found.E, quick * found.P / found.E, found.lost
        fall = sunk[todo] & before
        if fall.any():
            i = np.flatnonzero(fall)
            x[i], y[i], t[i], s[i], v_x[i], v_y[i], lost[i] = _fall(
                own.at(i), v_[i], aim.at(i), rest[i]
            )
        met = found.short | fall
        if met.any():
            late = own.lag + (t - x / c0)
            rows = own.x + x, own.y + y, own.t + t, own.s + s, late, v_x, v_y
            final.put(todo[met], [row[met] for row in rows], lost[met])
            if met.all():
                break
        # between what is known to lie before the place, and behind it
        far = ~met
        todo, own, before = todo[far], own.at(far), before[far]
        now, v_, n_ = gone[todo], v_[far], n_[far]
        low[todo] = np.where(before, now, low[todo])
        high[todo] = np.where(before, high[todo], now)
        following = now + _slope_come_down(own.sin, own.cos, found.P[far], found.gone[far])
        least, most = low[todo], high[todo]
        safe = (following >= least) & (following <= most)
        following = np.where(safe, following, 0.5 * (least + np.where(most < np.inf, most, least)))
        step = following - now
        if number:  # far back: from the launch, since a path forgets where it came from
            back = step < -0.1 * power.slowing(v_ * own.quick, n_)
            if back.any():
                launch = origin(alpha0[todo])
                own = Point(*(np.where(back, b, a) for a, b in zip(own, launch, strict=True)))
                step = np.where(back, following, step)
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
