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

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.response import is_short, path
from hodograph.engine.velocity import expm1_ratio

STEPS, FEW_STEPS = 40, 16  # of Newton; as many where one looks only
# The last step, in units of the speed, whose square remains; where one looks only.
LAST_STEP, LAST_LOOK = 1e-11, 1e-3
CLOSE, CLOSER = 0.1, 1e-8  # steps of the slope that series take; the last one
BESIDE = 0.5  # logarithm of the times from one of which the other is begun
VERTICAL = 1e-17  # distance over height, below which a launch is straight up or down

Triple: TypeAlias = tuple[FloatArray, FloatArray, FloatArray]  # along x, y (up) and z


def difference(a: Triple, b: Triple) -> Triple:
    """One vector less another."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def in_units(a: Triple, unit: FloatArray) -> Triple:
    """A vector over a length or a speed."""
    return a[0] / unit, a[1] / unit, a[2] / unit


class Chase(NamedTuple):
    """Where the target is, how it moves through the air, and the wind; x, y up, z."""

    kappa: FloatArray
    n: FloatArray
    r: Triple
    V: Triple
    W: Triple
    most: FloatArray  # speeds through the air above which no launch is looked for

    def at(self, index: NDArray[np.intp]) -> Chase:
        """The elements at `index`."""
        r, V, W = ((x[index], y[index], z[index]) for x, y, z in (self.r, self.V, self.W))
        return Chase(self.kappa[index], self.n[index], r, V, W, self.most[index])


class Throw(NamedTuple):
    """Launches that are at the target at a given time."""

    rows: FloatArray
    done: BoolArray

    @property
    def u(self) -> Triple:
        """The velocity through the air."""
        return self.rows[0], self.rows[1], self.rows[2]

    @property
    def end(self) -> Triple:
        """The same where the target is met."""
        return self.rows[3], self.rows[4], self.rows[5]

    def answer(self, dR: tuple[Any, Any, Any]) -> Triple:
        """How u changes when the place does, the time held."""
        # the inverse of d(place)/d(u): in the plane of flight row by row, and beside it
        a, b, c, d, beside, cos, sin = self.rows[6:13]
        ahead, aside = cos * dR[0] + sin * dR[2], cos * dR[2] - sin * dR[0]
        forth, up, across = a * ahead + b * dR[1], c * ahead + d * dR[1], beside * aside
        return cos * forth - sin * across, up, sin * forth + cos * across

    def at(self, index: NDArray[np.intp]) -> Throw:
        """The elements at `index`."""
        return Throw(self.rows[:, index], self.done[index])

    def put(self, index: NDArray[np.intp], part: Throw) -> None:
        """Replace the elements at `index`."""
        self.rows[:, index], self.done[index] = part


class Near(NamedTuple):
    """Launches at other times or to other places, from which to begin."""

    t: FloatArray
    throw: Throw
    u: Triple | None = None  # if it is known better


@np.errstate(all="ignore")  # what becomes infinite or NaN has not converged
def throw(
    own: Chase, t: FloatArray, near: Near | None = None,
    steps: int = STEPS, last: float = LAST_STEP, again: bool = False,
) -> Throw:  # fmt: skip
    """The launches that are at the target at the time t; where `again`, to the last digit."""
    x, Y, z = (r + V * t for r, V in zip(own.r, own.V, strict=True))
    X = np.hypot(x, z)
    cos, sin = np.where(X > 0, x / X, 1.0), np.where(X > 0, z / X, 0.0)
    X = np.maximum(X, VERTICAL * (np.abs(Y) + t * t))
    ahead, up = X / t, Y / t + t / 2
    slow = np.minimum(own.kappa**own.n * np.hypot(ahead, up) ** (own.n - 1) * t, 2.0)
    ahead, up = ahead * expm1_ratio(slow), up * expm1_ratio(0.5 * slow)
    D = t / ahead * expm1_ratio(slow)
    if (own.n == 1).all():  # which is elementary
        kt = own.kappa * t
        part = -np.expm1(-kt) / np.maximum(kt, 1e-100)
        part = np.where(kt < 1e-4, 1 - kt / 2, part)
        sunk = np.where(kt < 1e-4, 0.5, (1 - part) / np.maximum(kt, 1e-4))
        ahead, up = X / (t * part), (Y / t + t * sunk) / part
        D = t / ahead * expm1_ratio(kt)
    if near is not None:
        u, change = near.u or near.throw.u, [0.0 * t] * 3
        if near.u is None:
            off = difference(own.V, near.throw.end)
            change = [du * (t - near.t) for du in near.throw.answer(off)]
        u_x, u_y, u_z = (a + b for a, b in zip(u, change, strict=True))
        forth, D_ = cos * u_x + sin * u_z, near.throw.rows[13] * (t / near.t)
        good = (
            near.throw.done
            & (np.abs(np.log(t / near.t)) < BESIDE)
            & (forth > 0.1 * ahead)
            & np.isfinite(u_y)
            & (D_ > 0)
        )
        ahead, up = np.where(good, forth, ahead), np.where(good, u_y, up)
        D = np.where(good, D_, D)
    todo, done = np.arange(t.size), np.zeros(t.size, bool)
    ready, result = np.zeros(t.size, bool), np.full((7, t.size), np.nan)
    for _ in range(steps):
        if not todo.size:
            break
        given = own.kappa[todo], own.n[todo], X[todo], Y[todo], t[todo]
        new, result[:, todo], small = _correct(*given, ahead[todo], up[todo], D[todo], last)
        ahead[todo], up[todo], D[todo] = new
        done[todo[small]] = True
        small, ready[todo] = small & (ready[todo] | (not again)), small
        todo = todo[~small & (np.hypot(*new[:2]) < own.most[todo])]
    a, b, c, d, beside, e_x, e_y = result
    rows = [ahead * cos, up, ahead * sin, e_x * cos, e_y, e_x * sin, a, b, c, d, beside, cos, sin]
    return Throw(np.stack([*rows, D]), done)


def _correct(
    kappa: FloatArray, n: FloatArray, X: FloatArray, Y: FloatArray, t: FloatArray,
    ahead: FloatArray, up: FloatArray, D: FloatArray, last: float,
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
    small = near & (np.hypot(da, db) <= last * u) & is_short(P, n, dp, max(CLOSER, last))
    across = u * w * np.exp(0.5 * P.bend * dp)
    rows = np.stack([*inverse, ahead / X, across, across * (p + dp)])
    return (new[0], new[1], D_new), rows, small


@np.errstate(all="ignore")
def needed(
    own: Chase, t: FloatArray, near: Near | None = None, **looks: Any
) -> tuple[FloatArray, FloatArray, Throw]:
    """The launch speed over the ground, its derivative in t, and the launch.

    Infinite and falling where there is none, which is at times too short.
    """
    found = throw(own, t, near, **looks)
    over = [u + W for u, W in zip(found.u, own.W, strict=True)]
    speed = np.sqrt(sum(v * v for v in over))
    change = found.answer(difference(own.V, found.end))
    rate = sum(v * dv for v, dv in zip(over, change, strict=True)) / speed
    return np.where(found.done, speed, np.inf), np.where(found.done, rate, -np.inf), found
