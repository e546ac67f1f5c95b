"""One launch under quadratic drag in plain floats: what the arrays do, for a tenth of their cost.

An array of one costs some hundred calls of NumPy, more than all the arithmetic of a flight.  Here
the same rules run over the same nodes in loops of plain Python: `layer`, `ellipse`, `node_class`,
`arc`, `descend`, `climb` and `fly` are those of `position`, `fall` and `flight`, the symbols are
theirs, and what is said there is not said again.  Newton alone differs: its guess is rougher, and
what short steps add is integrated by few nodes, which here costs less than an arc.  The extremes
are left to the arrays.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from functools import cache
from math import asinh, cos, expm1, log, log1p, sin, sqrt
from typing import NamedTuple, TypeAlias

from hodograph.engine import position
from hodograph.engine.domain import RIGHT_ANGLE
from hodograph.engine.extremes import TERMINAL
from hodograph.engine.flight import EPSILON
from hodograph.engine.position import NODES_PER_DIGIT, NODES_SPARE
from hodograph.engine.status import Status

Rule: TypeAlias = tuple[tuple[float, float], ...]  # nodes and weights on [0, 1]
Sums: TypeAlias = tuple[float, float, float]  # x, y and t

V_NORM_MAX = 1e6
COUNTS: tuple[int, ...] = tuple(position.NODE_COUNTS.tolist())
# A step of Newton that changes the fall by no more than the first number, as a factor, is
# integrated in P by so many nodes; one below LAST_STEP by Taylor.
STEPS = ((1.003, 2), (1.03, 4), (1.15, 6), (2.0, 12))
LAST_STEP, MAX_STEPS = 4e-6, 8


class Flight(NamedTuple):
    """What the landing is made of: each property computes one quantity, as in `flight.Flight`."""

    v: float
    sin0: float
    cos0: float
    height: float
    slope: float
    up: Sums
    across2: float
    top_v2: float  # v_norm^2 where the fall begins
    P: float
    fall_delta: float
    fall_u: float
    fall: Sums
    fall_error: float
    status: int

    @property
    def reach(self) -> float:
        """x / cos(alpha0)."""
        return self.up[0] + self.across2 / self.cos0 * self.fall[0]

    @property
    def t(self) -> float:
        """Time."""
        return self.up[2] + sqrt(self.across2) * self.fall[2]

    @property
    def tail(self) -> float:
        """Length of path at terminal speed, which only the arrays know."""
        return 0.0

    @property
    def tangent(self) -> float:
        """-tan(alpha_s)."""
        return sqrt(self.P)

    @property
    def delta(self) -> float:
        """Slope come down in all."""
        return self.slope + self.fall_delta

    @property
    def speed(self) -> float:
        """Speed."""
        return sqrt(self.across2 * (1.0 + self.P) / self.fall_u)

    @property
    def curve(self) -> float:
        """Length of path (eq. 19)."""
        v2, sin0, cos0 = self.v * self.v, self.sin0, self.cos0
        if sin0 <= 0:
            return _length(v2, bracket_gap(sin0, cos0, self.fall_delta))
        fall = _length(self.top_v2, bracket_gap(0.0, 1.0, self.fall_delta))
        return _length(v2, bracket_gap(sin0, cos0, self.slope)) + self.across2 * fall

    @property
    def error(self) -> float:
        """Estimate of the relative error of x and t."""
        rounding = EPSILON * (16 + 2 * (2 + 2 * self.delta + log1p(self.v)))
        e = 0.25 * rounding * (self.up[1] + abs(self.height))
        p = sqrt(self.P + 2 * e / self.across2)
        in_x = e / (p * self.reach * self.cos0)
        in_t = e / (p * sqrt(self.across2 / self.fall_u) * self.t) if self.t else 0.0
        return rounding + 2 * max(in_x, in_t) + 4 * self.fall_error


def _length(v2: float, gap: float) -> float:
    e = v2 * gap
    return 0.5 * gap * (log1p(e) / e if e else 1.0)


def halves(sin0: float, cos0: float) -> tuple[float, float]:
    """(1 +/- sin(alpha0)) / 2, each to full accuracy."""
    far = 0.5 + 0.5 * abs(sin0)
    near = 0.25 * cos0 * cos0 / far
    return (far, near) if sin0 >= 0 else (near, far)


def bracket_gap(sin0: float, cos0: float, delta: float) -> float:
    """(u - 1) / v^2 after `delta`."""
    plus, minus = halves(sin0, cos0)
    growth = expm1(delta)
    grown = 1.0 + growth
    bracket = plus * plus / grown + minus * minus * grown
    return cos0 * cos0 * delta + growth * (1.0 + 1.0 / grown) * bracket


def layer(v2: float) -> float:
    """eta, the distance in slope to the singularity behind the launch."""
    return 0.5 * log1p(1.0 / v2) if v2 > 1e-300 else 0.5 * log(1e300)


def ellipse(length: float, distance: float, angle: float) -> float:
    """ln(rho) of the largest ellipse round tau in [0, length] clear of ln(distance) + i angle."""
    ahead, aside = log(distance) * (2 / length) - 1, angle * (2 / length)
    axes = math.hypot(ahead + 1, aside) + math.hypot(ahead - 1, aside)
    return math.acosh(max(axes / 2, 1.0))


def node_class(
    w: float, tilt: float, slope: float | None, delta: float, eta: float, length: float
) -> Rule:
    """The rule for an arc; w is (v_norm cos(alpha0))^2, and tilt is sin / cos^2 of alpha0."""
    length = max(length, 1e-6)
    ln_rho = ellipse(length, 2.1 / eta, RIGHT_ANGLE)
    if slope is not None:
        a = 1 / max(w, 1e-300) + slope + tilt
        steepness = asinh(a / (1 + sqrt(1 + max(a, 0.0))))
        turn = slope + max(1.1, steepness) + eta
        distance, angle = math.hypot(turn, RIGHT_ANGLE) / eta, math.atan2(RIGHT_ANGLE, turn)
        ln_rho = min(ln_rho, ellipse(length, distance, angle))
    return rule_for(ln_rho, delta, length)


def rule_for(ln_rho: float, delta: float, length: float) -> Rule:
    """The smallest rule that an ellipse allows."""
    wanted = NODES_SPARE + max(
        NODES_PER_DIGIT / max(ln_rho, 1e-3), sqrt(NODES_PER_DIGIT * max(delta, length / 2))
    )
    return rule(COUNTS[min(bisect_left(COUNTS, wanted), len(COUNTS) - 1)])


@cache
def rule(count: int) -> Rule:
    """The Gauss-Legendre rule of so many nodes."""
    nodes, weights = position.gauss_legendre(count)
    return tuple(zip(nodes[:, 0].tolist(), weights[:, 0].tolist(), strict=True))


def arc(v2: float, sin0: float, cos0: float, slope: float | None, delta: float,
        timed: bool) -> Sums:  # fmt: skip
    """x / cos(alpha0), y, t over the arc that comes down by `delta`, as `position.arc`."""
    eta = layer(v2)
    length = log1p(delta / eta)
    cos2 = cos0 * cos0
    nodes = node_class(v2 * cos2, sin0 / cos2, slope, delta, eta, length)
    plus, minus = halves(sin0, cos0)
    x = y = t = 0.0
    for node, weight in nodes:
        stretch = expm1(length * node)
        at = eta * stretch
        growth = expm1(at)
        grown = 1.0 + growth
        down = plus / grown
        C = down + minus * grown
        bend = growth * (down + minus)
        S = sin0 - bend
        u = 1.0 + v2 * (cos2 * at + bend + growth * (down - minus) * S)
        dx = weight * (stretch + 1.0) * C / u
        x += dx
        y += dx * S
        if timed:
            t += dx * sqrt(u)
    scale = eta * length
    return scale * x, scale * y, scale * t


def _plunge(w: float, delta: float, timed: bool) -> Sums:
    """The same over a fall from an apex, where sin = 0 leaves half of the terms."""
    eta = layer(w)
    length = log1p(delta / eta)
    x = y = t = 0.0
    for node, weight in node_class(w, 0.0, 0.0, delta, eta, length):
        stretch = expm1(length * node)
        at = eta * stretch
        growth = expm1(at)
        grown = 1.0 + growth
        half = 0.5 / grown
        C = half + 0.5 * grown
        S = growth * (half + 0.5)
        u = 1.0 + w * (at + S * C)
        dx = weight * (stretch + 1.0) * C / u
        x += dx
        y += dx * S
        if timed:
            t += dx * sqrt(u)
    scale = eta * length
    return scale * x, -scale * y, scale * t


def _thickness(p: float, secant: float) -> float:
    """F(p) - p^2."""
    return p / (secant + p) + asinh(p)


def expm1_ratio(z: float) -> float:
    """(e^z - 1) / z, which is 1 at z = 0."""
    return expm1(z) / z if z else 1.0


def _first_guess(P_start: float, w: float, drop: float, least: float) -> float:
    """P - P_start to some percent."""
    start = _thickness(sqrt(P_start), sqrt(1.0 + P_start)) if P_start else 0.0
    gain = least
    for _ in range(2):
        P = P_start + gain
        p = sqrt(P)
        mean = (_thickness(p, sqrt(1.0 + P)) - start) * (2 / 3 + p) / (1.0 + p)
        gain = max((1.0 + w * mean) * least, least)
    if P_start:
        steepest = 2 * w * sqrt(1.0 + 1.0 / P_start) * drop
        if steepest < 700:
            gain = min(gain, 2 * drop * expm1_ratio(steepest))
    return gain


def _slope_gain(P0: float, P1: float, gain: float) -> float:
    """asinh(sqrt P1) - asinh(sqrt P0), without subtracting the two."""
    if P0:
        gain /= sqrt(P1) * sqrt(1.0 + P0) + sqrt(P0) * sqrt(1.0 + P1)
        return asinh(gain)
    return asinh(sqrt(P1))


def descend(
    v2: float, sin0: float, cos0: float, drop: float, timed: bool
) -> tuple[float, float, float, Sums, float] | None:
    """P, delta, u, the sums and the error of a fall by `drop`; None if it does not converge.

    With h = expm1(2 w miss) / 2 w, so that dP/dh = 2 u / (1 + 2 w h), and u' = du/dP,

        step = 2 u h / (1 - c + c^2 - d),   c = (u' - w) h,
        d = 2/3 h^2 ((u' - w) (u' - 2 w) + u u''),

    which is Halley's with one term more.
    """
    cos2 = cos0 * cos0
    w = v2 * cos2
    P_start = (sin0 / cos0) ** 2
    least = 2 * drop * expm1_ratio(2 * w * drop)
    gain = _first_guess(P_start, w, drop, least)
    P = P_start + gain
    delta = _slope_gain(P_start, P, gain)
    x, y, t = _from_start(v2, sin0, cos0, delta, timed)
    for _ in range(MAX_STEPS):
        p, secant = sqrt(P), sqrt(1.0 + P)
        u = 1.0 + v2 * bracket_gap(sin0, cos0, delta)
        miss = drop + y
        h = miss * expm1_ratio(2 * w * miss)
        turn = w * secant / p  # u'
        first = turn - w
        c = first * h
        d = 2 / 3 * h * h * (first * (first - w) - 0.5 * u * w / (P * p * secant))
        bend = max(min(c - c * c + d, 0.5), -0.5)
        step = max(2 * u * h / (1.0 - bend), least - gain)
        now, gain = gain, gain + step
        part = abs(step) / gain
        if part <= LAST_STEP:
            dy = (
                0.5 * step / u * (1.0 - 0.5 * step * turn / u)
            )  # where the bound stops it, not `miss`
            x += dy / p * (1.0 - 0.5 * dy * u / P)
            t += dy / p * sqrt(u) * (1.0 + 0.5 * dy * (turn - u / P))
            u += step * (turn - 0.25 * w / (P * p * secant) * step)
            P = P_start + gain
            return P, _slope_gain(P_start, P, gain), u, (x, -drop, t), part**3
        P_next = P_start + gain
        delta = _slope_gain(P_start, P_next, gain)
        for longest, count in STEPS:
            if gain <= longest * now and now <= longest * gain:
                dx, dy, dt = _step(rule(count), P, u, w, step, timed)
                x, y, t = x + dx, y - dy, t + dt
                break
        else:
            x, y, t = _from_start(v2, sin0, cos0, delta, timed)
        P = P_next
    return None


def _from_start(v2: float, sin0: float, cos0: float, delta: float, timed: bool) -> Sums:
    """The integrals from the start of the fall, in units of v_x^2 / g."""
    if sin0 == 0:
        return _plunge(v2, delta, timed)
    x, y, t = arc(v2, sin0, cos0, asinh(sin0 / cos0), delta, timed)
    return x / cos0, y / (cos0 * cos0), t / cos0


def _step(nodes: Rule, P0: float, u0: float, w: float, step: float, timed: bool) -> Sums:
    """What a short step in P adds to x, -y and t."""
    p0, secant0 = sqrt(P0), sqrt(1.0 + P0)
    x = y = t = 0.0
    for node, weight in nodes:
        dP = step * node
        P = P0 + dP
        p, secant = sqrt(P), sqrt(1.0 + P)
        dF = dP * (1.0 + P + P0) / (p * secant + p0 * secant0)
        u = u0 + w * (dF + asinh(dP / (p * secant0 + p0 * secant)))
        dy = weight / u
        dx = dy / p
        x += dx
        y += dy
        if timed:
            t += dx * sqrt(u)
    half = 0.5 * step
    return half * x, half * y, half * t


def climb(v: float, alpha0: float) -> Sums | None:
    """x, y, t of the apex above the launch, or None where it is for the arrays."""
    if not v <= V_NORM_MAX:
        return None
    if alpha0 <= 0:
        return 0.0, 0.0, 0.0
    sin0, cos0 = sin(alpha0), cos(alpha0)
    x, y, t = arc(v * v, sin0, cos0, None, asinh(sin0 / cos0), True)
    return cos0 * x, y, t


def fly(v: float, alpha0: float, height: float, wanted: tuple[str, ...]) -> Flight | None:
    """The landing of one launch, or None where it is for the arrays; `height` in v0^2 / g.

    x is always there, and the length of path; t if `wanted` holds "t".
    """
    try:
        return _fly(v, alpha0, height, "t" in wanted)
    except (OverflowError, ZeroDivisionError, ValueError):
        return None


def _fly(v: float, alpha0: float, height: float, timed: bool) -> Flight | None:
    if not v <= V_NORM_MAX:
        return None
    sin0, cos0 = sin(alpha0), cos(alpha0)
    v2 = v * v
    slope, up = 0.0, (0.0, 0.0, 0.0)
    across2 = cos0 * cos0
    if sin0 > 0:
        slope = asinh(sin0 / cos0)
        up = arc(v2, sin0, cos0, None, slope, timed)
        across2 /= 1.0 + v2 * bracket_gap(sin0, cos0, slope)
    fall = up[1] + height
    drop = fall / across2
    if sin0 < 0:
        top_v2, tilt, level = v2, sin0, cos0
    else:
        top_v2, tilt, level = v2 * across2, 0.0, 1.0
    if fall < 0:
        lost = math.nan
        return Flight(
            v, sin0, cos0, height, slope, up, across2, top_v2,
            lost, lost, lost, (lost, lost, lost), lost, Status.UNREACHABLE,
        )  # fmt: skip
    if not v2 * fall <= TERMINAL + 0.5 * log(max(top_v2, 1.0)):
        return None
    down = descend(top_v2, tilt, level, drop, timed)
    if down is None:
        return None
    return Flight(
        v, sin0, cos0, height, slope, up, across2, top_v2, *down, Status.CONVERGED
    )  # fmt: skip
