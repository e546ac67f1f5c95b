"""From panel to panel along a hodograph, until a slope or a value is reached.

A height is always taken from the top of the path, so that nothing cancels on the way.
"""

import mpmath

from hodograph.witness.reference_numbers import ctx
from hodograph.witness.reference_panels import Hodograph, Point


class NeverError(Exception):
    """A distance that the path does not reach; holds the one that it tends to."""


def to_slope(h: Hodograph, at: Point, s: mpmath.mpf) -> Point:
    """Go on to the slope `s`, which lies below."""
    while at.s > s:
        width = h.longest(at)
        if width >= at.s - s:
            return h.step(at, at.s - s)._replace(s=s)
        at = h.step(at, width)
    return at


def top(h: Hodograph) -> Point:
    """Where the path is highest over the ground: the launch if it climbs no more than that."""
    return to_slope(h, h.start(), h.level)


def until(
    h: Hodograph, at: Point, name: str, target: mpmath.mpf, stop: mpmath.mpf | None = None
) -> tuple[Point, bool]:
    """Go on until a quantity has grown to `target` or to the slope `stop`, and tell which.

    From the top on, a height is counted downward.
    """
    sign = -1 if name == "y" and at.s <= h.level else 1
    while True:
        if stop is None and abs(h.excess(at)) + ctx.exp(2 * at.s) < h.tiny:
            return _tail(h, at, name, target), True
        width = h.longest(at)
        last = stop is not None and width >= at.s - stop
        if last:
            width = at.s - stop
        end = h.step(at, width)
        if sign * h.value(end, name) >= target:
            return _seek(h, at, end, name, target), True
        if last:
            return end._replace(s=stop), False
        at = end


def _tail(h: Hodograph, at: Point, name: str, target: mpmath.mpf) -> Point:
    """Terminal velocity to all digits: dδ = dt = −dy, dx = 2 exp(s) dδ."""
    last = 2 * ctx.exp(at.s)
    if name == "x":
        if target - at.x >= last:
            raise NeverError(at.x + last)
        rest = -ctx.log1p((at.x - target) / last)
    else:
        rest = more = target - abs(h.value(at, name))
        while name == "y" and h.tilt and abs(more) > h.tiny * rest:  # dx counts on a slope
            fallen = rest - h.tilt * last * ctx.expm1(-rest)
            more = (target - abs(h.value(at, name)) - fallen) / (1 + h.tilt * last * ctx.exp(-rest))
            rest += more
    s, along = at.s - rest, -last * ctx.expm1(-rest)
    return at._replace(
        delta=at.delta + rest,
        s=s,
        gain=ctx.exp(-h.n * s) / 2**h.n - h.w0,
        x=at.x + along,
        y=at.y - rest,
        t=at.t + rest,
        s_arc=at.s_arc + rest,
        x2=at.x2 + along,  # W is all gain
        y2=at.y2 - rest,
    )


def _seek(h: Hodograph, at: Point, end: Point, name: str, target: mpmath.mpf) -> Point:
    """Newton in one panel, which bisects when a step leaves the bracket."""
    sign = -1 if name == "y" and at.s <= h.level else 1
    low, high = ctx.mpf(0), end.delta - at.delta
    width = high
    here, there = abs(h.value(at, name)), abs(h.value(end, name))
    part = (target - here) / (there - here)
    if name == "y" and at.s == h.level:
        part = ctx.sqrt(part)
    elif name == "y" and end.s <= h.level < at.s:
        part = 1 - ctx.sqrt(1 - part)
    d = part * width
    while True:
        now = h.step(at, d)
        off = sign * h.value(now, name) - target
        low, high = (low, d) if off > 0 else (d, high)
        rate = sign * h.rate(now, name)
        step = off / rate if rate > 0 else width
        # converged in δ, or in the quantity
        if abs(step) <= 8 * h.tiny * d or abs(off) <= h.tiny / 1000000 * target:
            return now
        # The next is off by the square of this step, over the distance to where the rate is 0.
        if 1000 * step**2 <= h.tiny * min(d, width - d) ** 2:
            return h.step(at, d - step)
        new = d - step
        d = new if low < new < high else (low + high) / 2
