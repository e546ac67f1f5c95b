"""One place of one launch in plain floats: what `march` does, under quadratic drag in still air.

The symbols are those of `stride`, and what is said there is not said again.  Every arc begins at
the launch.  Places at the edge, or out of reach, are left to the arrays.
"""

from __future__ import annotations

from math import asinh, cos, cosh, hypot, log1p, sin, sqrt, tanh
from typing import NamedTuple

from hodograph.engine.flight import EPSILON
from hodograph.engine.scalar import arc, bracket_gap
from hodograph.engine.stride import FIRST, GROWTH, ROUGH, SHORT

MAX_STEPS, MAX_ARCS, SHORT_STEPS = 40, 4, 8
DEEPEST = 1e6  # tan(alpha), in terms of the launch


class Point(NamedTuple):
    """A point in units of the launch, and the velocity there."""

    x: float
    y: float
    t: float
    s: float
    v_x: float
    v_y: float


def follow(v: float, alpha0: float, place: str, value: float) -> Point | None:
    """Where x, t or s, or y on the way up, first has a value, in units of the launch."""
    try:
        return _follow(v, alpha0, place, value)
    except (OverflowError, ZeroDivisionError, ValueError):
        return None


def at_slope(v: float, alpha0: float, alpha: float) -> Point | None:
    """Where the slope angle is `alpha`."""
    try:
        sin0, cos0 = sin(alpha0), cos(alpha0)
        gap = 2.0 * cos(0.5 * (alpha0 + alpha)) * sin(0.5 * (alpha0 - alpha))
        delta = asinh(gap / (cos0 * cos(alpha)))
        return _exact(v, sin0, cos0, asinh(sin0 / cos0), delta)[0]
    except (OverflowError, ZeroDivisionError, ValueError):
        return None


def _exact(
    v: float, sin0: float, cos0: float, slope0: float, delta: float
) -> tuple[Point, float, float, float]:
    """The point, its speed, sin(alpha) and cos(alpha)."""
    v2 = v * v
    x, y, t = arc(v2, sin0, cos0, slope0, delta, True)
    gap = bracket_gap(sin0, cos0, delta)
    e = v2 * gap
    sine, cosine = tanh(slope0 - delta), 1.0 / cosh(slope0 - delta)
    quick = cos0 / (cosine * sqrt(1.0 + e))
    s = 0.5 * gap * (log1p(e) / e if e else 1.0)
    return Point(cos0 * x, y, t, s, quick * cosine, quick * sine), quick, sine, cosine


def _follow(v: float, alpha0: float, place: str, value: float) -> Point | None:
    sin0, cos0 = sin(alpha0), cos(alpha0)
    slope0, come, index = asinh(sin0 / cos0), 0.0, "xyts".index(place)
    at, quick, sine, cosine = Point(0.0, 0.0, 0.0, 0.0, cos0, sin0), 1.0, sin0, cos0
    for number in range(MAX_ARCS):
        length, speed = quick * quick, v * quick
        unit = quick if place == "t" else length
        rest, slack = (value - at[index]) / unit, 4 * EPSILON * abs(value) / unit
        brief = SHORT if number else FIRST
        found = _march(sine, cosine, speed * speed, index, rest, slack, brief)
        if found is None:
            return None
        short, gone, E, x, y, t, s = found
        P = sine - gone
        if short:
            return Point(
                at.x + length * x, at.y + length * y, at.t + quick * t, at.s + length * s,
                quick * cosine / E, quick * P / E,
            )  # fmt: skip
        c2, C, product = cosine * cosine, hypot(cosine, P), sine * P
        if product > 0:
            mean = 1.0 + (c2 + sine * sine + P * P) / (C + product)
        else:
            mean = 1.0 + (C - product) / c2
        come += asinh(gone * mean / (1.0 + C))
        if come < 0.0:
            return None
        at, quick, sine, cosine = _exact(v, sin0, cos0, slope0, come)
    return None


def _march(
    sin: float, cos: float, v2: float, index: int, rest: float, slack: float, brief: float
) -> tuple[bool, float, float, float, float, float, float] | None:
    """Whether all steps were short, how far P has come down, then E, x, y, t, s."""
    P, E, c2 = sin, 1.0, cos * cos
    x = y = t = s = gone = 0.0
    most, short = 1.0 / max(sqrt(v2), 1e-150), True
    for number in range(MAX_STEPS):
        C1 = sqrt(c2 + P * P)
        i1, e1 = 1.0 / E, v2 * C1
        decay = e1 * i1
        if index == 2:
            rate, bend, left = 1.0, 0.0, rest - t
        elif index == 0:
            rate, left = cos * i1, rest - x
            bend = -decay * rate
        elif index == 1:
            rate, left = P * i1, rest - y
            bend = -decay * rate - 1.0
        else:
            rate, left = C1 * i1, rest - s
            bend = -decay * rate - P / C1
        square = rate * rate + 2.0 * bend * left
        turns = square < 0.0
        if P < -DEEPEST:
            return None
        h = -rate / bend if turns else 2.0 * left / (rate + sqrt(square))
        longest = min(most, GROWTH / decay) if decay else most
        if index == 3:
            longest = min(longest, 0.9 * C1 * i1)
        h = max(min(h, longest), -longest)
        local = abs(h) * max(decay, E / C1)
        short = short and local <= brief
        if short and number < SHORT_STEPS:
            if abs(left) <= slack or abs(h) <= 4 * EPSILON * abs(t):
                if turns:
                    return None
                break
        elif local <= min(brief, ROUGH):
            break
        half = 0.5 * h
        P2, E2 = P - half * E, E + half * e1
        C2 = sqrt(c2 + P2 * P2)
        i2, e2 = 1.0 / E2, v2 * C2
        P3, E3 = P - half * E2, E + half * e2
        C3 = sqrt(c2 + P3 * P3)
        i3, e3 = 1.0 / E3, v2 * C3
        P4, E4 = P - h * E3, E + h * e3
        C4 = sqrt(c2 + P4 * P4)
        i4, e4 = 1.0 / E4, v2 * C4
        part = h / 6.0
        x += cos * part * (i1 + 2.0 * (i2 + i3) + i4)
        y += part * (P * i1 + 2.0 * (P2 * i2 + P3 * i3) + P4 * i4)
        s += part * (C1 * i1 + 2.0 * (C2 * i2 + C3 * i3) + C4 * i4)
        t += h
        gone += part * (E + 2.0 * (E2 + E3) + E4)
        E += part * (e1 + 2.0 * (e2 + e3) + e4)
        P = sin - gone
    else:
        return None
    return short, gone, E, x, y, t, s
