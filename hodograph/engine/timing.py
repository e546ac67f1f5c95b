"""When a target is met: the first and the last time, and that of the least speed.

The launch speed that is needed at the time t (see `pursuit`) is looked at in a row of times.  Where
it is 1, and where it is least, is then found by Newton and the secant, each launch begun from that
of a time before.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.pursuit import (
    FEW_STEPS,
    LAST_LOOK,
    LAST_STEP,
    STEPS,
    Chase,
    Near,
    Throw,
    needed,
    throw,
)
from hodograph.engine.status import Status

SCAN = 16  # times at which the speed is looked at
LATEST = 60  # factors of 2 by which times are looked for
FAST = 10.0  # speeds, in units of c and of v_lim, that are looked at first
TOUCH = 1e-14  # of the launch speed: so near, the least speed is enough
NEAR = 1e-11  # of it, what may be left at the last look
LAST_TIME = 1e-8  # the last step of Newton in time: its square remains
LAST_EDGE = 1e-16  # the product of the last two of the secant
LEVEL = 1e-8  # rate of the least speed, in its units, that is taken for 0
REACHES = 20  # steps along a ray


class Scan(NamedTuple):
    """Times among which the arcs are, one row after another, and what is needed there."""

    t: FloatArray
    speed: FloatArray
    rate: FloatArray
    throw: Throw

    def at(self, index: NDArray[np.intp]) -> Scan:
        """The targets at `index`."""
        number, size = self.t.shape
        flat = (np.arange(number)[:, np.newaxis] * size + index).ravel()
        t, speed, rate = (part[:, index] for part in self[:3])
        return Scan(t, speed, rate, self.throw.at(flat))

    def near(self, k: NDArray[np.intp]) -> Near:
        """The launches in the row k of each."""
        each = np.arange(k.size)
        return Near(self.t[k, each], self.throw.at(k * k.size + each))


def _scan(own: Chase) -> Scan:
    x, y, z = own.r
    far = np.sqrt(x * x + y * y + z * z)
    closing = np.sqrt(sum(V * V for V in own.V))
    fall = np.sqrt(2 * far) + 1e-100
    late = fall + own.kappa * far + np.minimum(far / np.maximum(closing, 1e-100), 100 * fall)
    late = late + 2 + own.kappa
    soon = 0.2 * np.minimum(fall, np.maximum(far, 1e-100) / np.maximum(closing, 1e-100))
    ratio = (4 * late / soon) ** (1 / (SCAN - 1))
    t = soon * ratio ** np.arange(SCAN)[:, np.newaxis]
    each = np.tile(np.arange(far.size), SCAN)
    speed, rate, found = needed(own.at(each), t.ravel(), steps=FEW_STEPS, last=LAST_LOOK)
    return Scan(t, speed.reshape(t.shape), rate.reshape(t.shape), found)


@np.errstate(all="ignore")
def _crossing(
    own: Chase, near: Near, low: FloatArray, high: FloatArray, falls: BoolArray
) -> tuple[FloatArray, Throw]:
    """The time between two at which the speed needed is 1, by Newton held between them.

    In logarithms, in which the speed falls as a line at first, and rises as one in the end.
    """
    t, low, high = near.t.copy(), low.copy(), high.copy()
    before, found = near.t.copy(), Throw(near.throw.rows.copy(), near.throw.done.copy())
    todo = np.arange(t.size)
    for _ in range(STEPS):
        part, now = own.at(todo), t[todo]
        speed, rate, there = needed(part, now, Near(before[todo], found.at(todo)))
        early = (speed > 1) == falls[todo]
        low[todo] = np.where(early, now, low[todo])
        high[todo] = np.where(early, high[todo], now)
        step = np.exp(-np.log(speed) * speed / (rate * now))
        following = now * step
        close = np.abs(step - 1) <= LAST_TIME
        inside = close | ((following > low[todo]) & (following < high[todo]))
        middle = np.sqrt(low[todo]) * np.sqrt(high[todo])
        t[todo] = np.where(inside, following, middle)
        good = there.done
        before[todo[good]] = now[good]
        found.put(todo[good], there.at(np.flatnonzero(good)))
        todo = todo[~close & (high[todo] - low[todo] > 4e-16 * now)]
        if not todo.size:
            break
    return t, throw(own, t, Near(before, found), again=True)


class Edge(NamedTuple):
    """The launch of the least speed that meets a target; unreachable by any that is looked for."""

    t: FloatArray
    speed: FloatArray
    throw: Throw
    status: Codes
    bend: FloatArray  # second derivative of the speed needed

    def at(self, index: NDArray[np.intp]) -> Edge:
        """The elements at `index`."""
        t, speed, found, status, bend = self
        return Edge(t[index], speed[index], found.at(index), status[index], bend[index])

    def put(self, index: NDArray[np.intp], part: Edge) -> None:
        """Replace the elements at `index`."""
        self.t[index], self.speed[index] = part.t, part.speed
        self.status[index], self.bend[index] = part.status, part.bend
        self.throw.put(index, part.throw)


@np.errstate(all="ignore")
def _settle(
    own: Chase, near: Near, t: FloatArray, bend: FloatArray, low: FloatArray, high: FloatArray
) -> Edge:
    """The time between two at which the speed needed is least, by the secant of its rate."""
    t, bend, low, high, middle = t.copy(), bend.copy(), low.copy(), high.copy(), near.t
    before, found = near.t.copy(), Throw(near.throw.rows.copy(), near.throw.done.copy())
    speeds, last, moved = np.full_like(t, np.inf), np.full_like(t, np.nan), t * 1.0
    codes = np.full(t.shape, Status.NOT_CONVERGED, np.int8)
    todo = np.arange(t.size)
    for _ in range(STEPS):
        part, now, start = own.at(todo), t[todo], before[todo]
        more = near.u and (near.u[0][todo], near.u[1][todo], near.u[2][todo])
        speed, rate, there = needed(part, now, Near(start, found.at(todo), more), again=True)
        near, good = near._replace(u=None), there.done
        late = np.where(good, rate > 0, now > middle[todo])
        low[todo] = np.where(late, low[todo], now)
        high[todo] = np.where(late, now, high[todo])
        secant = (rate - last[todo]) / moved[todo]
        bend[todo] = np.where((secant > 0) & np.isfinite(secant), secant, bend[todo])
        following = now - rate / bend[todo]
        inside = (following >= low[todo]) & (following <= high[todo])
        step = np.abs(following - now)
        still = inside & good & (step * np.minimum(np.abs(moved[todo]), now) < LAST_EDGE * now**2)
        narrow = high[todo] - low[todo] <= 4e-16 * now
        t[todo] = np.where(inside, following, np.sqrt(low[todo]) * np.sqrt(high[todo]))
        moved[todo], last[todo], speeds[todo] = t[todo] - now, rate, speed
        before[todo[good]] = now[good]
        found.put(todo[good], there.at(np.flatnonzero(good)))
        codes[todo[still | (narrow & good)]] = Status.CONVERGED
        todo = todo[~(still | narrow)]
        if not todo.size:
            break
    speed, rate, found = needed(own, t, Near(before, found), again=True)
    blows = np.sqrt(sum(W * W for W in own.W))  # which may take most of the speed away
    codes[~(np.abs(rate) * t <= LEVEL * (speed + blows))] = Status.NOT_CONVERGED
    return Edge(t, speed, found, codes, bend)


@np.errstate(all="ignore")
def _at_edge(own: Chase, scan: Scan) -> Edge:
    """The least speed about the least of the scan; unreachable where there is none."""
    k = np.argmin(scan.speed, axis=0)
    each = np.arange(k.size)
    before, after = np.maximum(k - 1, 0), np.minimum(k + 1, SCAN - 1)
    middle, rate = scan.t[k, each], scan.rate[k, each]
    beside = np.where(rate > 0, before, after)
    bend = (scan.rate[beside, each] - rate) / (scan.t[beside, each] - middle)
    bend = np.where((bend > 0) & np.isfinite(bend), bend, np.nan)
    low = np.where(k > 0, scan.t[before, each], scan.t[0] * 1e-3)
    high = np.where(k < SCAN - 1, scan.t[after, each], scan.t[-1] * 1e3)
    some = np.flatnonzero(np.isfinite(scan.speed[k, each]))
    result = Edge(
        middle.copy(),
        np.full(k.size, np.inf),
        scan.near(k).throw,
        np.full(k.size, Status.UNREACHABLE, np.int8),
        bend,
    )
    if some.size:
        near = scan.at(some).near(k[some])
        first = middle - rate / bend
        first = np.where((first > low) & (first < high), first, middle)
        settled = _settle(own.at(some), near, first[some], bend[some], low[some], high[some])
        result.put(some, settled)
    return result


def least(own: Chase) -> Edge:
    """The least speed that meets each target."""
    near = own._replace(most=np.minimum(own.most, FAST * (1 + 1 / np.maximum(own.kappa, 0.1))))
    scan = _scan(near)
    far = np.flatnonzero(np.isinf(scan.speed).all(axis=0) & (own.most > near.most))
    if far.size:
        wide, (number, size) = _scan(own.at(far)), scan.t.shape
        for whole, piece in zip(scan[:3], wide[:3], strict=True):
            whole[:, far] = piece
        scan.throw.put((np.arange(number)[:, np.newaxis] * size + far).ravel(), wide.throw)
    return _at_edge(own, scan)


@np.errstate(all="ignore")
def arcs(own: Chase, side: FloatArray) -> tuple[FloatArray, Throw, Codes]:
    """The first or the last time at which speed 1 meets the target, its launch and the status."""
    scan = _scan(own)
    t, codes = np.full(side.shape, np.nan), np.full(side.shape, Status.UNREACHABLE, np.int8)
    result = Throw(np.full((14, t.size), np.nan), np.zeros(t.size, bool))
    reached = np.asarray((scan.speed < 1).any(axis=0))
    doubt = np.flatnonzero(~reached)
    if doubt.size:  # between the times of the scan?
        edge = _at_edge(own.at(doubt), scan.at(doubt))
        t[doubt], gap = edge.t, edge.speed - 1
        result.put(doubt, edge.throw)
        codes[doubt[np.abs(gap) <= TOUCH]] = Status.CONVERGED
        of = np.flatnonzero(gap < -TOUCH)
        inside = doubt[of]
        k = np.argmin(scan.speed[:, inside], axis=0)
        scan.t[k, inside], scan.speed[k, inside] = t[inside], 0.0
        scan.throw.put(k * t.size + inside, edge.throw.at(of))
        reached[inside] = True
    at = np.flatnonzero(reached)
    if at.size:
        t[at], found, codes[at] = _arc(own.at(at), scan.at(at), side[at] < 0)
        result.put(at, found)
    over = [u + W for u, W in zip(result.u, own.W, strict=True)]
    close = np.abs(np.sqrt(sum(v * v for v in over)) - 1) <= NEAR
    codes[(codes == Status.CONVERGED) & ~(close & result.done)] = Status.NOT_CONVERGED
    return t, result, codes


def _arc(own: Chase, scan: Scan, low: BoolArray) -> tuple[FloatArray, Throw, Codes]:
    """The same where some time of the scan needs a speed below 1."""
    below = scan.speed < 1
    first, last = np.argmax(below, axis=0), SCAN - 1 - np.argmax(below[::-1], axis=0)
    k, size = np.where(low, first, last), np.arange(low.size)
    inner, each = scan.t[k, size], np.where(low, -1, 1)
    following = np.clip(k + each, 0, SCAN - 1)
    outer = np.where(following == k, inner * 2.0**each, scan.t[following, size])
    on = following == k
    for _ in range(LATEST):
        at = np.flatnonzero(on)
        if not at.size:
            break
        on[at] = needed(own.at(at), outer[at])[0] < 1
        outer[on] *= 2.0 ** each[on]
    t, found = _crossing(own, scan.near(k), np.minimum(inner, outer), np.maximum(inner, outer), low)
    return t, found, np.where(on, Status.UNREACHABLE, Status.CONVERGED).astype(np.int8)


@np.errstate(all="ignore")
def reach(own: Chase, along: tuple[Any, Any, Any], s: FloatArray) -> tuple[FloatArray, Edge, Codes]:
    """How far along a ray from r speed 1 can reach, by Newton from s, beyond; r is within reach."""
    codes = np.full(s.shape, Status.NOT_CONVERGED, np.int8)
    s, final = s.copy(), least(_moved(own, along, s))
    todo = np.flatnonzero(final.status == Status.CONVERGED)
    codes[final.status == Status.UNREACHABLE] = Status.UNREACHABLE
    for _ in range(REACHES):
        if not todo.size:
            break
        part = own.at(todo)
        now = final.at(todo)
        over = [u + W for u, W in zip(now.throw.u, part.W, strict=True)]
        change = now.throw.answer(along)
        rise = np.sum([v * du for v, du in zip(over, change, strict=True)], axis=0) / now.speed
        step = (1 - now.speed) / rise
        gone = (rise <= 0) & (now.speed > 1 + TOUCH)
        codes[todo[gone]] = Status.UNREACHABLE
        still = ~gone & (np.abs(step) <= LAST_STEP * (np.abs(s[todo]) + 1e-3))
        codes[todo[still]] = Status.CONVERGED
        go = ~gone & np.isfinite(step)
        at, todo = np.flatnonzero(go), todo[go]
        if not at.size:
            break
        s[todo] += step[at]
        own_ = _moved(part.at(at), along, s[todo])
        u = tuple(a[at] + step[at] * b[at] for a, b in zip(now.throw.u, change, strict=True))
        t = now.t[at]
        edge = _settle(own_, Near(t, now.throw.at(at), u), t, now.bend[at], t / 2, 2 * t)
        lost = np.flatnonzero(edge.status != Status.CONVERGED)
        if lost.size:
            edge.put(lost, least(own_.at(lost)))
        final.put(todo, edge)
        todo = todo[(edge.status == Status.CONVERGED) & ~still[at]]
    return s, final, codes


def _moved(own: Chase, along: tuple[Any, Any, Any], s: FloatArray) -> Chase:
    x, y, z = (a + s * d for a, d in zip(own.r, along, strict=True))
    return own._replace(r=(x, y, z))
