"""The launch slope that meets a place in still air, and the one whose path is the highest there.

With T = tan(alpha0), the height of the path at the target's distance has one maximum in T, on the
envelope: below it the target is met by the low arc, above it by the high one.  T is found by Newton
with the curvature of a secant, on the height at the target's distance, or where the path is steep
on the distance at its height.  The slope p is brought there meanwhile, by steps that are exact in
vacuum and at terminal speed.  A bracket holds the iteration together.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import extremes, power
from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.flight import EPSILON
from hodograph.engine.response import Path, is_short, path
from hodograph.engine.status import Status
from hodograph.engine.velocity import expm1_ratio

QUICK_STEPS, MAX_STEPS = 12, 300
FAR = 1e3  # slopes past the one at which speed is terminal, in its units, at which a path hangs
STEEPEST = 1e30  # of any launch that is tried
CLOSE, CLOSER = 0.1, 3e-5  # steps of the slope, in its own size: that series take; the last one
# The last step of T, in its own size: what remains after it is its 2.7th power, its 1.6th on the
# envelope.
LAST_STEP, LAST_STEP_ON_TOP = 3e-7, 3e-10
NEAR = 1e-9  # of the same, and of the distance: what may be missed at the last look
TOUCH = 16 * EPSILON  # of the heights that a path goes through: so near, the envelope is reached


class Target(NamedTuple):
    """What is aimed at, and by which arc: -1 the low one, 1 the high one, 0 as high as may be."""

    v: FloatArray
    n: FloatArray
    X: FloatArray
    Y: FloatArray
    side: FloatArray

    def at(self, index: NDArray[np.intp] | BoolArray) -> Target:
        """The elements at `index`."""
        return Target(*(part[index] for part in self))


class View(NamedTuple):
    """How far a path passes from the target, told at its distance, or at its height if `steep`."""

    steep: BoolArray
    near: BoolArray  # the slope is so near to that there that the rest holds
    sure: BoolArray  # and so near that signs do
    hangs: BoolArray  # the path never comes so far
    run: BoolArray  # not known yet whether it does
    past: BoolArray  # the point lies past the target
    dp: FloatArray  # the step of the slope there
    miss: FloatArray  # how far above, or beyond, the path passes
    rate: FloatArray  # d(miss)/dT
    dpdT: FloatArray  # of the slope there


def view(aim: Target, P: Path, T: FloatArray, flat: BoolArray) -> View:
    """The path as seen from the target, from one point of it; at its distance where `flat`."""
    top = aim.side == 0
    rx, ry = aim.X - P.x, np.where(top, 0.0, aim.Y - P.y)
    p, m, turn = P.p, P.m, P.turn / P.m
    across = -rx / m
    part = 1 + 0.5 * P.bend * across  # exact in vacuum and where speed is terminal
    beyond = part < 0.02
    # m was larger before, so the slope less changed; what lies below is not met while climbing
    sloping = (p < -1) & ((p + across < -0.5) | (aim.Y <= 0))
    across = across / np.where(beyond, 1.0, part)
    # p^2 grows by 2 dy / m, and ln(m) by as much at each height where speed is terminal
    down = np.minimum(p, -1.0)
    P2 = p * p - 2 * ry / m * expm1_ratio(np.clip(P.bend * ry / (m * down), -50.0, 50.0))
    steep = sloping & (P2 >= 1) & ~top & ~flat
    hangs = beyond & (part <= 0) & (p <= -FAR * steepening(aim.v, T)) & ~steep
    beyond &= ~steep
    end = final(aim, T)
    over = steep & (p <= -0.999 * end) & (ry < 0)  # straight down from here
    P2, ry = np.where(over, p * p, np.clip(P2, 1.0, end * end)), np.where(over, 0.0, ry)
    dp = np.where(steep, -np.sqrt(P2) - p, np.where(beyond, 0.0, across))
    run = beyond & ~hangs
    near = is_short(P, aim.n, dp, CLOSE) & ~run
    by = np.where(near, np.where(steep, ry, rx), 0.0)
    beside = P.x - aim.X + by / down * (1 + by / (2 * m * down * down))
    above = P.y - aim.Y + p * by - by * by / (2 * m)
    slower = -(P.M + turn * by / down) / (down + np.where(near, dp, 0.0))
    rise = P.M + by * (turn - by * T / (1 + T * T) / m)
    rise = np.where(top, rise / np.hypot(1.0, (p + dp) / np.maximum(T, 1.0)), rise)
    return View(
        steep, near, near & (np.abs(dp) <= CLOSE * np.hypot(1.0, p)), hangs, run,
        np.where(steep, ry > 0, rx < 0), dp,
        np.where(steep, beside, above),
        np.where(steep, slower, rise),
        np.where(over, 1.0, np.where(steep, (P.M / down + P.turn) / m, turn)),
    )  # fmt: skip


def steepening(v: FloatArray, T: FloatArray) -> FloatArray:
    """The first slope at which speed can be terminal."""
    return np.maximum(np.hypot(1.0, T) / np.maximum(v, 1e-100), 1.0)


def final(aim: Target, T: FloatArray) -> FloatArray:
    """The slope past which the path is straight down and at terminal speed."""
    return steepening(aim.v, T) * np.exp(power.FINAL * np.maximum(1.0, 2 / aim.n))


def advance(
    aim: Target, P: Path, see: View, T: FloatArray, last: FloatArray
) -> tuple[FloatArray, BoolArray, FloatArray]:
    """The step of T by a parabola, or where steep of alpha0; whether it has no root; `last`."""
    square = 1 + T * T
    q = np.where(see.steep, np.arctan(T), T)
    g, s = see.miss, np.where(see.steep, see.rate * square, see.rate)
    q0, s0, kind = last
    K = (s0 - s) / (q - q0)
    model = np.maximum((aim.X - P.M) / T, aim.X**2)
    model = np.where(see.steep, 4 * np.maximum(P.x, aim.X), model)
    K = np.where((K > 0) & (kind == see.steep + 2 * see.hangs), K, model)
    disc = s * s + 2 * K * g
    root = np.sqrt(np.maximum(disc, 0.0))
    low = np.where(s > 0, -2 * g / (s + root), (s - root) / K)
    high = np.where(s < 0, 2 * g / (root - s), (s + root) / K)
    missed = (aim.side == 0) | (disc < 0)
    step = np.where(missed, s / K, np.where(aim.side < 0, low, high))
    t = np.tan(np.clip(step, -1.5, 1.5))
    step = np.where(see.steep, np.where(T * t < 1, t * square / (1 - T * t), np.inf), step)
    return step, missed, np.stack([q, s, see.steep + 2 * see.hangs])


class Search(NamedTuple):
    """Where the iteration stands: T and D, and T between `low` and `high`."""

    T: FloatArray
    D: FloatArray
    low: FloatArray
    high: FloatArray
    done: BoolArray


@np.errstate(all="ignore")  # what becomes infinite or NaN is not taken
def seek(aim: Target, begin: Search, limit: int) -> Search:
    """Iterate until the step is small; those that seem out of reach are left as they are."""
    T, D, low, high = (part.copy() for part in begin[:4])
    done = begin.done.copy()
    last = np.full((3, T.size), np.nan)
    least, most = np.zeros_like(T), np.full_like(T, np.inf)  # of D, at the same T
    steep, flat = np.zeros((2, T.size), bool)  # there told by the height, and not to be
    todo = np.flatnonzero(~done)
    for _ in range(limit):
        if not todo.size:
            break
        own, T_, D_ = aim.at(todo), T[todo], D[todo]
        P = path(own.v, own.n, T_, D_)
        see = view(own, P, T_, flat[todo])
        top = own.side == 0
        # below the highest point of the envelope, and of the low arc below the target, T is to rise
        rising, above = see.rate > 0, (see.miss >= 0) & ~see.hangs & ~top
        raised = np.where(own.side < 0, ~above & rising, above | rising)
        a = np.where(see.sure & raised, np.maximum(T_, low[todo]), low[todo])
        b = np.where(see.sure & ~raised, np.minimum(T_, high[todo]), high[todo])

        step, missed, now = advance(own, P, see, T_, last[:, todo])
        used = see.near & (~see.hangs | top)
        size = np.maximum(np.abs(T_), np.minimum(D_, 1.0))
        small = used & (np.abs(step) <= np.where(top, LAST_STEP_ON_TOP, LAST_STEP) * size)
        small &= is_short(P, own.n, see.dp, CLOSER)
        inside = used & (small | ((T_ + step > a) & (T_ + step < b)))
        middle = np.sinh(0.5 * (np.arcsinh(a) + np.arcsinh(b)))
        T_new = np.where(see.near, np.where(inside, T_ + step, middle), T_)
        T[todo], low[todo], high[todo] = T_new, a, b
        turned = see.near | (steep[todo] != see.steep)
        least[todo] = np.where(turned, 0.0, least[todo])
        most[todo] = np.where(turned, np.inf, most[todo])
        least[todo] = np.where(see.near | see.past, least[todo], D_)
        most[todo] = np.where(~see.near & see.past, D_, most[todo])
        flat[todo] = ~see.near & (flat[todo] | (steep[todo] & ~see.steep))
        steep[todo] = see.steep & ~see.near
        D[todo] = follow(own, see, T_, T_new, D_, inside, least[todo], most[todo])
        last[:, todo] = np.where(used, now, last[:, todo])
        narrow = see.near & (b - a <= 16 * EPSILON * np.maximum(np.abs(a), np.abs(b)))
        lost = (
            narrow
            if limit > QUICK_STEPS
            else narrow | (missed & ~top & used & (np.abs(step) < 0.3 * size))
        )
        done[todo[small | (narrow & (limit > QUICK_STEPS))]] = True
        todo = todo[~(small | lost)]
    return Search(T, D, low, high, done)


def follow(
    aim: Target,
    see: View,
    T: FloatArray,
    T_new: FloatArray,
    D: FloatArray,
    inside: BoolArray,
    least: FloatArray,
    most: FloatArray,
) -> FloatArray:
    """D for the new T: by its derivative, or after a long step as in vacuum."""
    step = T_new - T
    square = (1 + T_new**2) / (1 + T**2)
    D_new = D - see.dp + step * (1 - see.dpdT)
    far = np.abs(step * see.dpdT) > 0.5 * np.maximum(D, 1.0)
    coarse = see.near & (~inside | far | (np.abs(square - 1) > 0.5))
    D_new = np.where(coarse, D * np.where(see.steep, np.sqrt(square), square), D_new)
    D_new = np.where(see.run, T + 2 * FAR * steepening(aim.v, T), D_new)
    within = (D_new > least) & (D_new < most)
    between = np.where(most < np.inf, np.sqrt(np.maximum(least, 1e-4 * D)) * np.sqrt(most), 2 * D)
    return np.where(within | (see.near & (D_new > 0)), D_new, between)


def vacuum(aim: Target) -> tuple[FloatArray, FloatArray, BoolArray]:
    """T of both arcs without drag, between which both are with it; and whether there are any."""
    disc = 1 - 2 * aim.Y - aim.X**2
    root = np.sqrt(np.maximum(disc, 0.0))
    return (2 * aim.Y + aim.X**2) / (aim.X * (1 + root)), (1 + root) / aim.X, disc >= 0


def first_guess(aim: Target) -> tuple[FloatArray, FloatArray]:
    """T and D of the parabola that falls as much as a flat path of the same length.

    That falls by x^2 f / 2 cos^2(alpha0), f = (exp(2 e) - 1 - 2 e) / 2 e^2, where e is the length
    over which drag takes the speed down to its e-th part.
    """
    v, n, X, Y, side = aim
    length = np.hypot(X, Y)
    for _ in range(2):
        e = np.minimum(v**n * length, 0.5 + np.log1p(v))
        f = np.where(e < 1e-3, 1 + 2 * e / 3, (np.expm1(2 * e) - 2 * e) / (2 * e * e + 1e-300))
        disc = 1 - f * (2 * Y + X * X * f)
        root = np.sqrt(np.maximum(disc, 0.0))
        low = (2 * Y + X * X * f) / (X * (1 + root))
        high = (1 + np.where(side == 0, 0.0, root)) / (X * f)
        T = np.where((side < 0) & (disc > 0), low, high)
        length = np.where(side < 0, length, np.maximum(length, 0.6 * X * np.hypot(1.0, T)))
    return T, X * expm1_ratio(2 * e) * (1 + T * T)


class Meeting(NamedTuple):
    """Launches of slope T that meet their targets, at the slope p; in units of the launch."""

    T: FloatArray
    p: FloatArray
    t: FloatArray
    speed: FloatArray
    shortfall: FloatArray  # what the envelope is lower than a target out of reach
    status: Codes


@np.errstate(all="ignore")
def meet(aim: Target) -> Meeting:
    """The launches that meet their targets; X > 0."""
    low, high, some = vacuum(aim)
    T, D = first_guess(aim)
    T = np.where(some, np.minimum(np.maximum(T, low), high), T)
    aside = ~some | (aim.side == 0)
    found = seek(aim, Search(T, D, low, high, aside), QUICK_STEPS)
    short, status = np.zeros_like(T), np.full(T.shape, Status.CONVERGED, np.int8)
    rest = np.flatnonzero(aside | ~found.done)
    if rest.size:
        own = aim.at(rest)
        top = highest(own)
        gap = own.Y - height(own, top)
        heights = np.abs(own.Y) + own.X * top.T
        out, touching = gap > TOUCH * heights, np.abs(gap) <= TOUCH * heights
        ends = (low[rest], top.T), (top.T, high[rest])
        low_, high_ = (np.where(own.side < 0, *pair) for pair in zip(*ends, strict=True))
        inside = (found.T[rest] > low_) & (found.T[rest] < high_)
        T_ = np.where(inside, found.T[rest], np.sinh((np.arcsinh(low_) + np.arcsinh(high_)) / 2))
        D_ = np.where(inside, found.D[rest], top.D)
        over = out | touching
        T_, D_ = np.where(over, top.T, T_), np.where(over, top.D, D_)
        last = seek(own, Search(T_, D_, low_, high_, over & top.done), MAX_STEPS)
        found.T[rest], found.D[rest] = last.T, last.D
        status[rest] = np.where(last.done, Status.CONVERGED, Status.NOT_CONVERGED)
        status[rest[out & top.done]] = Status.UNREACHABLE
        short[rest] = np.maximum(gap, 0.0)
    return arrive(aim, found, short, status)


def highest(aim: Target) -> Search:
    """The launches whose paths are the highest at X."""
    zero = np.zeros_like(aim.X)
    top = aim._replace(side=zero)
    T, D = first_guess(top)
    begin = Search(T, D, zero, zero + STEEPEST, zero > 0)
    return seek(top, begin, MAX_STEPS)


@np.errstate(all="ignore")
def height(aim: Target, at: Search) -> FloatArray:
    """The height of a path at X, -inf where it does not come so far."""
    P = path(aim.v, aim.n, at.T, at.D)
    see = view(aim._replace(side=0 * at.T, Y=0 * at.T), P, at.T, at.T > 0)
    return np.where(see.hangs | see.run, -np.inf, see.miss)


def arrive(aim: Target, found: Search, short: FloatArray, status: Codes) -> Meeting:
    """What it is like where the target is met; a last look at how near that is."""
    P = path(aim.v, aim.n, found.T, found.D)
    see = view(aim, P, found.T, np.isnan(found.T))
    passed = np.where(see.steep, (aim.Y - P.y) / np.minimum(P.p, -1.0), aim.X - P.x)
    over = see.steep & (P.p <= -0.999 * final(aim, found.T)) & (P.y > aim.Y)
    below = np.where(over, P.y - aim.Y, 0.0)  # straight down, at terminal speed
    t = P.t + np.where(over, aim.v * below, passed / np.sqrt(P.m))
    p = P.p + np.where(over, 0.0, see.dp)
    across = np.sqrt(P.m) * np.exp(0.5 * P.bend * (p - P.p))
    speed = across * np.hypot(1.0, p)
    p = p * np.exp(np.minimum(aim.v**2 * below, extremes.STEEPEST))
    scale = np.abs(found.T) * aim.X + np.abs(aim.Y) + aim.X
    close = (np.abs(see.miss) <= NEAR * scale) & see.near & ~see.hangs
    status[(status == Status.CONVERGED) & ~close] = Status.NOT_CONVERGED
    return Meeting(found.T, p, t, speed, short, status)
