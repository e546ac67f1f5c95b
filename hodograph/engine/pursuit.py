"""The velocity that brings a projectile to a place at a given time, and what follows from it.

In a uniform wind, or to a target that moves, the place that is to be met depends on the time t of
flight: in the frame of the moving air it is

    R(t) = r + (V - W) t,

V the velocity of the target, W that of the wind.  For each t one velocity u through the air leads
there; it is found by Newton in its components, in which the place is linear without drag.  Then

    needed(t) = sqrt((u + W)^2)

is the launch speed over the ground.  It falls to a minimum, the least speed that meets the target
at all, and rises again; the low and the high arc are where it is the launch speed.  In units of a
speed c, g = 1, lengths c^2 / g and times c / g; kappa = c / v_lim.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.response import is_short, path
from hodograph.engine.status import Status
from hodograph.engine.velocity import expm1_ratio

STEPS, FEW_STEPS, LAST_STEP = (
    60,
    16,
    1e-11,
)  # of Newton; as many where one looks only; the last, in units of the speed: its square remains
CLOSE, CLOSER = 0.1, 1e-8  # steps of the slope that series take; the last one
VERTICAL = 1e-17  # distance over height, below which a launch is straight up or down
LATEST = 60  # factors of 2 by which times are looked for
FAST = 10.0  # speeds, in units of c and of v_lim, that are looked at first
SCAN = 16  # times at which the speed is looked at
TOUCH = 1e-14  # of the launch speed: so near, the least speed is enough
NEAR = 1e-11  # of it, what may be left at the last look
LAST_TIME = 1e-14  # the last step of Newton in time
ROOT = {"xrtol": 4e-16, "xatol": 0.0, "fatol": 0.0, "frtol": 0.0}


class Chase(NamedTuple):
    """Where the target is, how it moves through the air, and the wind; x, y up, z."""

    kappa: FloatArray
    n: FloatArray
    r: tuple[FloatArray, FloatArray, FloatArray]
    V: tuple[FloatArray, FloatArray, FloatArray]
    W: tuple[FloatArray, FloatArray, FloatArray]
    most: FloatArray  # speeds through the air above which no launch is looked for

    def flat(self) -> list[FloatArray]:
        """All arrays in a row, for the root finders."""
        return [self.kappa, self.n, *self.r, *self.V, *self.W, self.most]


def chase(kappa: FloatArray, n: FloatArray, *rest: FloatArray) -> Chase:
    """What `Chase.flat` gives, together again."""
    x, y, z, vx, vy, vz, wx, wy, wz, most = rest
    return Chase(kappa, n, (x, y, z), (vx, vy, vz), (wx, wy, wz), most)


class Throw(NamedTuple):
    """Launches that are at the target at a given time."""

    u: tuple[FloatArray, FloatArray, FloatArray]  # velocity through the air
    end: tuple[FloatArray, FloatArray, FloatArray]  # the same where the target is met
    inverse: tuple[
        FloatArray, ...
    ]  # of d(place)/d(u): in the plane of flight row by row, beside it
    heading: tuple[FloatArray, FloatArray]
    done: BoolArray

    def answer(self, dR: tuple[Any, Any, Any]) -> tuple[FloatArray, FloatArray, FloatArray]:
        """How u changes when the place does, the time held."""
        a, b, c, d, beside = self.inverse
        cos, sin = self.heading
        ahead, aside = cos * dR[0] + sin * dR[2], cos * dR[2] - sin * dR[0]
        forth, up, across = a * ahead + b * dR[1], c * ahead + d * dR[1], beside * aside
        return cos * forth - sin * across, up, sin * forth + cos * across


@np.errstate(all="ignore")  # what becomes infinite or NaN has not converged
def throw(own: Chase, t: FloatArray, steps: int = STEPS) -> Throw:
    """The launches that are at the target at the time t."""
    x, Y, z = (r + V * t for r, V in zip(own.r, own.V, strict=True))
    X = np.hypot(x, z)
    cos, sin = np.where(X > 0, x / X, 1.0), np.where(X > 0, z / X, 0.0)
    X = np.maximum(X, VERTICAL * (np.abs(Y) + t * t))
    ahead, up = X / t, Y / t + t / 2
    slow = np.minimum(own.kappa**own.n * np.hypot(ahead, up) ** (own.n - 1) * t, 2.0)
    ahead, up = ahead * expm1_ratio(slow), up * expm1_ratio(0.5 * slow)
    D = t / ahead * expm1_ratio(slow)
    todo, done = np.arange(t.size), np.zeros(t.size, bool)
    result = np.full((7, t.size), np.nan)
    for _ in range(steps):
        if not todo.size:
            break
        given = own.kappa[todo], own.n[todo], X[todo], Y[todo], t[todo]
        new, result[:, todo], small = _correct(*given, ahead[todo], up[todo], D[todo])
        ahead[todo], up[todo], D[todo] = new
        done[todo[small]] = True
        todo = todo[~small & (np.hypot(*new[:2]) < own.most[todo])]
    a, b, c, d, beside, e_x, e_y = result
    return Throw(
        (ahead * cos, up, ahead * sin), (e_x * cos, e_y, e_x * sin),
        (a, b, c, d, beside), (cos, sin), done,
    )  # fmt: skip


def _correct(
    kappa: FloatArray, n: FloatArray, X: FloatArray, Y: FloatArray, t: FloatArray,
    ahead: FloatArray, up: FloatArray, D: FloatArray,
) -> tuple[tuple[FloatArray, FloatArray, FloatArray], FloatArray, BoolArray]:  # fmt: skip
    """One step of Newton: velocity and D after it, what `Throw` holds, whether it is the last."""
    u, T = np.hypot(ahead, up), up / ahead
    cos, sin = ahead / u, up / u
    P = path(kappa * u, n, T, D, timed=True)
    p, w = P.p, np.sqrt(P.m)
    # to the time t: d(ln w)/dt is constant in vacuum and at terminal speed
    late = t / u - P.t
    dp = -late / w * expm1_ratio(np.clip(0.5 * P.bend / w * late, -30.0, 30.0))
    near = is_short(P, n, dp, CLOSE)
    x = P.x + w * late - 0.25 * P.bend * late**2
    y = P.y + p * w * late - 0.5 * late**2 * (1 + 0.5 * P.bend * p)

    # how the place at that time answers to the speed, as a logarithm, and to the angle
    square = cos * cos
    t_speed, t_angle = P.faster[2], P.turn_t / square
    x_speed, x_angle = P.faster[0] - w * t_speed, P.turn / square - w * t_angle
    y_speed = P.faster[1] - p * w * t_speed
    y_angle = (P.M + p * P.turn) / square - p * w * t_angle
    x_ahead, x_up = u * (x_speed * cos - x_angle * sin), u * (x_speed * sin + x_angle * cos)
    y_ahead, y_up = u * (y_speed * cos - y_angle * sin), u * (y_speed * sin + y_angle * cos)
    det = x_ahead * y_up - x_up * y_ahead
    inverse = y_up / det, -x_up / det, -y_ahead / det, x_ahead / det
    off_x, off_y = X - u * u * x, Y - u * u * y
    da, db = inverse[0] * off_x + inverse[1] * off_y, inverse[2] * off_x + inverse[3] * off_y
    part = np.minimum(1.0, 3 * u / np.hypot(da, db))
    da, db = np.where(near, part * da, 0.0), np.where(near, part * db, 0.0)
    new = np.maximum(ahead + da, 0.1 * ahead), up + db
    turned = (t_speed * (cos * da + sin * db) + t_angle * (cos * db - sin * da)) / (w * u)
    D_new = D - dp - turned + (new[1] / new[0] - T)
    D_new = np.where(D_new > 0.1 * D, D_new, 0.1 * D)
    small = near & (np.hypot(da, db) <= LAST_STEP * u) & is_short(P, n, dp, CLOSER)
    across = u * w * np.exp(0.5 * P.bend * dp)
    rows = np.stack([*inverse, ahead / X, across, across * (p + dp)])
    return (new[0], new[1], D_new), rows, small


@np.errstate(all="ignore")
def needed(own: Chase, t: FloatArray, steps: int = STEPS) -> tuple[FloatArray, FloatArray, Throw]:
    """The launch speed over the ground, its derivative in t, and the launch.

    Infinite and falling where there is none, which is at times too short.
    """
    found = throw(own, t, steps)
    over = [u + W for u, W in zip(found.u, own.W, strict=True)]
    speed = np.sqrt(sum(v * v for v in over))
    change = found.answer(
        tuple(V - end for V, end in zip(own.V, found.end, strict=True))  # type: ignore[arg-type]
    )
    rate = sum(v * dv for v, dv in zip(over, change, strict=True)) / speed
    return np.where(found.done, speed, np.inf), np.where(found.done, rate, -np.inf), found


def _scan(own: Chase) -> tuple[FloatArray, FloatArray]:
    """Times, one row after another, among which the arcs are, and the speeds needed."""
    x, y, z = own.r
    far = np.sqrt(x * x + y * y + z * z)
    closing = np.sqrt(sum(V * V for V in own.V))
    fall = np.sqrt(2 * far) + 1e-100
    late = fall + own.kappa * far + np.minimum(far / np.maximum(closing, 1e-100), 100 * fall)
    late = late + 2 + own.kappa
    ratio = (20 * late / fall) ** (1 / (SCAN - 1))
    t = 0.2 * fall * ratio ** np.arange(SCAN)[:, np.newaxis]
    row = [np.broadcast_to(part, t.shape).ravel() for part in own.flat()]
    return t, needed(chase(*row), t.ravel(), FEW_STEPS)[0].reshape(t.shape)


@np.errstate(all="ignore")
def _crossing(own: Chase, low: FloatArray, high: FloatArray, falls: BoolArray) -> FloatArray:
    """The time between two at which the speed needed is 1, by Newton held between them."""
    t, low, high = np.sqrt(low) * np.sqrt(high), low.copy(), high.copy()
    todo = np.arange(t.size)
    for _ in range(STEPS):
        part, now = chase(*(row[todo] for row in own.flat())), t[todo]
        speed, rate, _ = needed(part, now)
        early = (speed > 1) == falls[todo]
        low[todo] = np.where(early, now, low[todo])
        high[todo] = np.where(early, high[todo], now)
        following = now - (speed - 1) / rate
        inside = (following > low[todo]) & (following < high[todo])
        close = np.abs(following - now) <= LAST_TIME * now
        middle = np.sqrt(low[todo]) * np.sqrt(high[todo])
        t[todo] = np.where(inside | close, following, middle)
        todo = todo[~close]
        if not todo.size:
            break
    return t


def _at_edge(own: Chase, t: FloatArray, speed: FloatArray) -> FloatArray:
    """The time at which the least speed is needed: that of the scan, refined."""
    k = np.argmin(speed, axis=0)
    each = np.arange(k.size)
    before = np.where(k > 0, t[k - 1, each], t[0] * 1e-3)
    after = np.where(k < SCAN - 1, t[np.minimum(k + 1, SCAN - 1), each], t[-1] * 1e3)
    middle = t[k, each]

    def rate(at: FloatArray, mid: FloatArray, *flat: FloatArray) -> FloatArray:
        rise = needed(chase(*flat), at)[1]
        return np.where(np.isfinite(rise), rise, np.where(at > mid, 1e3, -1e3))

    from scipy.optimize import elementwise  # slow to import

    args = (middle, *own.flat())
    found = elementwise.find_root(rate, (before, after), args=args, tolerances=ROOT)
    return np.asarray(np.where(found.success, found.x, middle))


class Edge(NamedTuple):
    """The launch of the least speed that meets a target; unreachable by any that is looked for."""

    t: FloatArray
    speed: FloatArray
    throw: Throw
    status: Codes


def least(own: Chase) -> Edge:
    """The least speed that meets each target."""
    near = own._replace(most=np.minimum(own.most, FAST * (1 + 1 / np.maximum(own.kappa, 0.1))))
    times, speeds = _scan(near)
    far = np.flatnonzero(np.isinf(speeds).all(axis=0) & (own.most > near.most))
    if far.size:
        times[:, far], speeds[:, far] = _scan(chase(*(row[far] for row in own.flat())))
    t = _at_edge(own, times, speeds)
    speed, _, found = needed(own, t)
    failed = np.where(np.isinf(speeds).all(axis=0), Status.UNREACHABLE, Status.NOT_CONVERGED)
    return Edge(t, speed, found, np.where(found.done, 0, failed).astype(np.int8))


def arcs(own: Chase, side: FloatArray) -> tuple[FloatArray, Throw, Codes]:
    """The first or the last time at which speed 1 meets the target, its launch and the status."""
    times, speed = _scan(own)
    t, codes = np.full(side.shape, np.nan), np.full(side.shape, Status.UNREACHABLE, np.int8)
    reached = np.asarray((speed < 1).any(axis=0))
    doubt = np.flatnonzero(~reached)
    if doubt.size:  # between the times of the scan?
        part = chase(*(row[doubt] for row in own.flat()))
        t[doubt] = best = _at_edge(part, times[:, doubt], speed[:, doubt])
        gap = needed(part, best)[0] - 1
        codes[doubt[np.abs(gap) <= TOUCH]] = Status.CONVERGED
        inside = doubt[gap < -TOUCH]
        k = np.argmin(speed[:, inside], axis=0)
        times[k, inside], speed[k, inside] = t[inside], 0.0
        reached[inside] = True
    at = np.flatnonzero(reached)
    if at.size:
        part, low = chase(*(row[at] for row in own.flat())), side[at] < 0
        below = speed[:, at] < 1
        first, last = np.argmax(below, axis=0), SCAN - 1 - np.argmax(below[::-1], axis=0)
        k = np.where(low, first, last)
        inner, each = times[k, at], np.where(low, -1, 1)
        following = np.clip(k + each, 0, SCAN - 1)
        outer = np.where(following == k, inner * 2.0**each, times[following, at])
        for _ in range(LATEST):
            on = needed(part, outer)[0] < 1
            if not on.any():
                break
            outer = np.where(on, outer * 2.0**each, outer)
        t[at] = _crossing(part, np.minimum(inner, outer), np.maximum(inner, outer), low)
        codes[at] = np.where(on, Status.UNREACHABLE, Status.CONVERGED)
    speed_, _, found_ = needed(own, t)
    close = np.abs(speed_ - 1) <= NEAR
    codes[(codes == Status.CONVERGED) & ~close] = Status.NOT_CONVERGED
    return t, found_, codes


@np.errstate(all="ignore")
def reach(own: Chase, along: tuple[Any, Any, Any], s: FloatArray) -> tuple[FloatArray, Edge, Codes]:
    """How far along a ray from r speed 1 can reach, by Newton from s, beyond; r is within reach."""
    codes = np.full(s.shape, Status.NOT_CONVERGED, np.int8)
    s = s.copy()
    todo = np.arange(s.size)
    for _ in range(STEPS):
        part = chase(*(row[todo] for row in own.flat()))
        dx, dy, dz = (np.broadcast_to(a, own.n.shape)[todo] for a in along)
        x, y, z = part.r
        at = s[todo]
        edge = least(part._replace(r=(x + at * dx, y + at * dy, z + at * dz)))
        over = [u + W for u, W in zip(edge.throw.u, part.W, strict=True)]
        change = edge.throw.answer((dx, dy, dz))
        rise = np.sum([v * du for v, du in zip(over, change, strict=True)], axis=0) / edge.speed
        step = (1 - edge.speed) / rise
        gone = (rise <= 0) & (edge.speed > 1 + TOUCH)
        codes[todo[gone]] = Status.UNREACHABLE
        s[todo] += np.where(gone, 0.0, step)
        still = np.abs(step) <= LAST_STEP * (np.abs(s[todo]) + 1e-3)
        codes[todo[still & ~gone]] = Status.CONVERGED
        todo = todo[~(still | gone) & np.isfinite(step)]
        if not todo.size:
            break
    x, y, z = (a + s * d for a, d in zip(own.r, along, strict=True))
    return s, least(own._replace(r=(x, y, z))), codes
