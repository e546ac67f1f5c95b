"""Flights under drag lambda v^n for any n >= 1: the path that n = 2 need not take (eq. 8).

With w = v_norm cos(alpha0) and G(p) the integral of (1 + p^2)^((n - 1) / 2),

    U = 1 + n w^n (G(p0) - G(p)),    v_x = w U^(-1/n)                          eq. 8

and (15) integrates powers of U.  As in `velocity`, an arc is described from its own beginning:

    w^n (G(p0) - G(p)) = v^n g,    g = integral of C^n over delta,    C = cos(alpha0) / cos(alpha).

For whole n, g is a sum of exponentials of one sign, closed and free of cancellation.  For other n
it would be hypergeometric, but as a difference of two values that nearly agree at the launch; it
is summed instead from node to node of the quadrature, each leg by a Gauss-Legendre rule of its
own, which keeps every digit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import comb
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from hodograph.descent import TINY, slope_gain
from hodograph.domain import RIGHT_ANGLE, FloatArray, Rule, check, option
from hodograph.flight import CONVERGED, EPSILON, NOT_CONVERGED, UNREACHABLE
from hodograph.position import ellipse, gauss_legendre, node_sum, widen
from hodograph.velocity import Start, expm1_ratio, start

LARGEST = 1e120  # of v_norm^n
SHALLOWEST = 1e-140  # below it a level flight is a matter of v^n alpha0 alone, and scales
EXPONENT = Rule("in [1, 10]", lambda a: (a >= 1) & (a <= 10))

PANEL = 32  # nodes of one panel in tau
LEG = 10  # nodes between two nodes, for the inner integral when n is not whole
BLOCK = 4096  # nodes times launches held at once
MAX_STEPS = 80
LAST_STEP = 1e-8  # relative: the iteration is of second order
FINAL = 40.0  # slope, past the first at which speed can be terminal, where all but y and t is final

# of dx = C U^(-2/n) d(delta), and S = sin(alpha) C, C and U
Integrand: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray, FloatArray, float], FloatArray]
INTEGRANDS: dict[str, Integrand] = {
    "x": lambda dx, S, C, U, n: dx,
    "y": lambda dx, S, C, U, n: dx * S,
    "t": lambda dx, S, C, U, n: dx * U ** (1 / n),
    "s": lambda dx, S, C, U, n: dx * C,  # length of path: dx / cos(alpha)
    "dx": lambda dx, S, C, U, n: dx / U,
    "dy": lambda dx, S, C, U, n: dx / U * S,
    # for the optimum, the derivative of (p + q) (1 + p^2)^(-(n - 1)/2) in p, its two parts
    "even": lambda dx, S, C, U, n: dx * C ** (1 - n) * (1 - (n - 1) * (S / C) ** 2),
    "odd": lambda dx, S, C, U, n: dx * C ** (-1 - n) * (n - 1) * S,
}


def slowing(v: FloatArray, n: float) -> FloatArray:
    """eta, the distance in slope to the singularity behind the launch (exact at 90 degrees)."""
    return np.asarray(np.log1p(np.maximum(v, 1e-300 ** (1 / n)) ** -n) / n)


def panels(
    begin: Start,
    slope: FloatArray,
    delta: FloatArray,
    eta: FloatArray,
    length: FloatArray,
    n: float,
) -> NDArray[np.intp]:
    """How many panels of PANEL nodes each arc needs; see `position.node_class`.

    The zeros of U stand 2 pi / n beside the launch and pi / n beside the fall, the branch points
    of C^n pi / 2 beside the apex.
    """
    length = np.maximum(length, 1e-6)
    beside = min(2.0, 4.0 / n)
    ln_rho = ellipse(length, beside / eta, RIGHT_ANGLE)
    cos2 = begin.plus * begin.minus
    a = 1 / np.maximum(begin.v2 * cos2, 1e-300) + slope + begin.sin / cos2
    steepness = np.arcsinh(a / (1 + np.sqrt(1 + np.maximum(a, 0.0))))
    aside = min(np.pi / n, RIGHT_ANGLE)
    for real in (slope + np.maximum(1.1, steepness) + eta, np.maximum(slope, 0.0) + eta):
        distance, angle = np.hypot(real, aside) / eta, np.arctan2(aside, real)
        ln_rho = np.minimum(ln_rho, ellipse(length, distance, angle))
    nodes = 8 + np.maximum(40 / np.maximum(ln_rho, 1e-3), np.sqrt(40 * max(n, 2.0) / 2 * delta))
    return np.asarray(np.ceil(nodes / PANEL).astype(np.intp))


def gap(begin: Start, v: FloatArray, delta: FloatArray, n: float) -> FloatArray:
    """v^n g for whole n: the integral of (v C)^n, C = (plus e^-delta + minus e^delta) / 2.

    Term by term, each scaled so that it overflows only where the sum does.
    """
    whole = round(n)
    down, up = v * begin.plus / 2, v * begin.minus / 2
    steep = up * np.exp(delta)
    total = np.zeros(np.broadcast_shapes(delta.shape, begin.plus.shape))
    for k in range(whole + 1):
        rate = whole - 2 * k
        term = delta
        if rate:
            larger = down if rate > 0 else steep
            term = larger ** abs(rate) * -np.expm1(-abs(rate) * delta) / abs(rate)
        total += comb(whole, k) * (down * up) ** min(k, whole - k) * term
    return total


def cosines(begin: Start, delta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """C = cos(alpha0) / cos(alpha), and S = sin(alpha) C."""
    growth = np.expm1(delta)
    down, up = begin.plus / (1 + growth), begin.minus * (1 + growth)
    return 0.5 * (down + up), begin.sin - 0.5 * growth * (down + begin.minus)


def summed_gap(begin: Start, v: FloatArray, at: FloatArray, n: float) -> FloatArray:
    """v^n g for any n at the sorted nodes `at`, of shape (node, launch), leg by leg."""
    nodes, weights = (column[:, :, np.newaxis] for column in gauss_legendre(LEG))
    ends = np.concatenate([np.zeros((1, at.shape[1])), at])
    legs = np.diff(ends, axis=0)
    inner = ends[:-1] + legs * nodes  # (leg node, node, launch)
    C = cosines(begin, inner)[0]
    return np.cumsum(legs * np.sum(weights * (v * C) ** n, axis=0), axis=0)


def arc(
    begin: Start, slope: FloatArray, delta: FloatArray, n: float, wanted: tuple[str, ...]
) -> tuple[dict[str, FloatArray], FloatArray]:
    """Integrals over arcs, as `position.arc`, and U at their ends; begin.v2 is v_norm^2."""
    v = np.sqrt(begin.v2)
    eta = slowing(v, n)
    length = np.log1p(delta / eta)
    counts = panels(begin, slope, delta, eta, length, n)
    results = {name: np.empty_like(delta) for name in wanted}
    U_end = np.empty_like(delta)
    nodes, weights = gauss_legendre(PANEL)
    for count in map(int, np.flatnonzero(np.bincount(counts))):
        start_of = np.arange(count)[:, np.newaxis, np.newaxis]
        unit = ((start_of + nodes) / count).reshape(-1, 1)
        unit = np.concatenate([unit, np.ones((1, 1))])  # and the end, of no weight
        weight = np.concatenate([np.tile(weights / count, (count, 1)), np.zeros((1, 1))])
        members = np.flatnonzero(counts == count)
        width = max(BLOCK // unit.size, 1)
        for first in range(0, members.size, width):
            at = members[first : first + width]
            part = begin.at(at)
            stretch = np.expm1(widen(length[at]) * unit)
            where = eta[at] * stretch
            C, S = cosines(part, where)
            g = (gap if n == round(n) else summed_gap)(part, v[at], where, n)
            U = 1 + n * g
            dx = weight * (stretch + 1) * C * U ** (-2 / n)
            scale = eta[at] * length[at]
            for name in wanted:
                value = node_sum(INTEGRANDS[name](dx, S, C, U, n), at.size)
                results[name][at] = scale * value
            U_end[at] = U[-1, : at.size]
    return results, U_end


@dataclass(frozen=True, eq=False)
class PowerFlight:
    """A landing in units of the launch, as `flight.Flight`, under drag of exponent n."""

    n: float
    v: FloatArray
    alpha0: FloatArray
    cos0: FloatArray
    slope: FloatArray
    up: dict[str, FloatArray]
    U_top: FloatArray
    P: FloatArray
    down: dict[str, FloatArray]
    U: FloatArray  # from the top
    delta_down: FloatArray
    beyond: FloatArray  # depth of fall at terminal speed, in v_e^2 / g
    height: FloatArray
    last: FloatArray
    status: NDArray[np.int8]

    shrink: FloatArray | float = 1.0  # what all but speeds are multiplied with

    run = 0.0  # no run-in: v_norm^n is bounded by LARGEST

    @property
    def across2(self) -> FloatArray:
        """(v_x / v0)^2 where the fall begins."""
        return np.asarray(self.cos0**2 * self.U_top ** (-2 / self.n))

    @property
    def reach(self) -> FloatArray:
        """x / cos(alpha0)."""
        fall = self.across2 / self.cos0 * self.down["x"]
        return np.asarray(self.shrink * (self.up["x"] + fall))

    @property
    def t(self) -> FloatArray:
        """Time."""
        fall = np.sqrt(self.across2) * self.down["t"] + self.beyond * self.v
        return np.asarray(self.shrink * (self.up["t"] + fall))

    @property
    def tangent(self) -> FloatArray:
        """-tan(alpha_s)."""
        return np.asarray(self.shrink * np.sqrt(self.P))

    @property
    def delta(self) -> FloatArray:
        """Slope come down in all."""
        return np.asarray(self.shrink * (self.slope + self.delta_down))

    @property
    def speed(self) -> FloatArray:
        """Speed."""
        return np.asarray(np.sqrt(self.across2 * (1 + self.P)) * self.U ** (-1 / self.n))

    @property
    def curve(self) -> FloatArray:
        """Length of path but for the tail."""
        return np.asarray(self.shrink * (self.up["s"] + self.across2 * self.down["s"]))

    @property
    def tail(self) -> FloatArray:
        """Length of path at terminal speed, at the end of a deep fall."""
        return self.beyond

    @property
    def error(self) -> FloatArray:
        """Estimate of the relative error of reach and t."""
        level = EPSILON * (np.abs(self.up["y"]) + np.abs(self.height))
        fallen = self.tangent * self.reach * self.cos0
        in_x = np.divide(
            level, fallen, out=np.zeros_like(level), where=(fallen > 0) & (self.beyond == 0)
        )
        across = self.speed * self.tangent / np.sqrt(1 + self.P) * self.t
        in_t = np.divide(level, across, out=np.zeros_like(level), where=across > 0)
        rounding = EPSILON * (8 + 4 * self.n * (1 + self.delta))
        return np.asarray(rounding + 4 * np.maximum(in_x, in_t) + self.last)


def _bend(w2: FloatArray, P: FloatArray, U: FloatArray, n: float) -> FloatArray:
    """k with which expm1(2 k Y) is straight in P, Y the height fallen: w^2 in a vertical fall."""
    log = np.log(np.maximum(w2, TINY)) * (n / 2) + np.log1p(P) * ((n - 1) / 2)
    return np.asarray(np.exp(log + np.log(U) * (2 / n - 1)) / np.sqrt(P))


def _descend(
    begin: Start, P_start: FloatArray, drop: FloatArray, n: float
) -> tuple[FloatArray, FloatArray]:
    """P - P_start where the fall has reached `drop`, and what the last step leaves of it.

    Newton as in `descent`, with the bend of the curve taken where it stands; the height fallen
    grows by less than P / 2, which bounds P from below, and a bracket holds the iteration
    together elsewhere.
    """
    cos2 = begin.plus * begin.minus
    w2 = begin.v2 * cos2
    at_start = _bend(w2, np.maximum(P_start, TINY), np.ones_like(w2), n)
    bend = np.where(P_start > 0, np.minimum(at_start, w2), w2)
    gain = 2 * drop * expm1_ratio(np.minimum(2 * bend * drop, 200.0))
    low, high = drop.copy(), np.full_like(drop, np.inf)  # the bound, with room for rounding
    last = np.zeros_like(drop)
    todo = np.flatnonzero(drop > 0)
    for _ in range(MAX_STEPS):
        if not todo.size:
            break
        part, start_, now = begin.at(todo), P_start[todo], gain[todo]
        delta = slope_gain(start_, start_ + now, now)
        sums, U = arc(part, -np.arcsinh(np.sqrt(start_)), delta, n, ("y",))
        miss = drop[todo] + sums["y"] / cos2[todo]
        low[todo] = np.where(miss > 0, now, low[todo])
        high[todo] = np.where(miss < 0, now, high[todo])
        k = _bend(w2[todo], start_ + now, U, n)
        following = now + 2 * U ** (2 / n) * miss * expm1_ratio(np.clip(2 * k * miss, -50.0, 50.0))
        least, most = low[todo], high[todo]
        middle = np.where(np.isinf(most), 16 * now, np.sqrt(least) * np.sqrt(most))
        inside = (following >= least) & (following <= most)
        following = np.where(inside | (miss == 0), following, middle)
        step = np.abs(following - now) / following
        gain[todo], last[todo] = following, step**2
        todo = todo[~(step <= LAST_STEP)]
    return gain, last


def _final(begin: Start, P_start: FloatArray, n: float) -> tuple[FloatArray, FloatArray]:
    """The slope past which a fall is vertical and at terminal speed, and how deep it is there.

    The bracket U outgrows what it began with where tan(alpha) exceeds 1 / v_x, and that of the
    start.
    """
    cos2 = begin.plus * begin.minus
    slope = np.arcsinh(np.sqrt(P_start))
    final = np.maximum(np.maximum(slope, -0.5 * np.log(begin.v2 * cos2)), 0.0) + FINAL
    sums, _ = arc(begin, -slope, final - slope, n, ("y",))
    return final, -sums["y"] / cos2


def fly(
    v: FloatArray, alpha0: FloatArray, height: FloatArray, n: float, wanted: tuple[str, ...]
) -> PowerFlight:
    """Landings of one block of launches, as `flight.fly`, for drag of exponent n."""
    shallow = (height == 0) & (alpha0 > 0) & (alpha0 < SHALLOWEST)
    if shallow.any():  # a matter of v^n alpha0 alone
        shrink = np.where(shallow, alpha0 / SHALLOWEST, 1.0)
        angle = np.where(shallow, SHALLOWEST, alpha0)
        return replace(fly(v * shrink ** (1 / n), angle, height, n, wanted), shrink=shrink)
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    begin = start(v * v, sin0, cos0)
    wanted = ("y", *wanted)
    slope = np.arcsinh(np.maximum(sin0, 0.0) / cos0)
    up, U_top = arc(begin, slope, slope, n, wanted)
    fall = up["y"] + height
    status = np.where(fall < 0, UNREACHABLE, CONVERGED).astype(np.int8)

    slow = U_top ** (-2 / n)
    level = np.zeros_like(v)
    top, P_start = Start(v * v * cos0**2 * slow, level, level + 1, level + 1), level
    downward = sin0 < 0
    if downward.any():
        top = Start(*(np.where(downward, a, b) for a, b in zip(begin, top, strict=True)))
        P_start = np.where(downward, (sin0 / cos0) ** 2, 0.0)
    cos2 = top.plus * top.minus
    w2 = top.v2 * cos2
    drop = np.maximum(fall, 0.0) / (cos0**2 * slow)
    deep = np.flatnonzero(w2 * drop > FINAL / 2)
    slopes, deepest = _final(top.at(deep), P_start[deep], n)
    below = np.zeros_like(v)
    below[deep] = np.maximum(drop[deep] - deepest, 0.0)
    gain, last = _descend(top, P_start, np.where(below > 0, 0.0, drop), n)
    status[(status == CONVERGED) & ~(last <= LAST_STEP**2)] = NOT_CONVERGED
    gain[deep] = np.where(below[deep] > 0, np.sinh(slopes) ** 2 - P_start[deep], gain[deep])
    P = P_start + gain
    delta = slope_gain(P_start, P, gain)
    down, U = arc(top, -np.arcsinh(np.sqrt(P_start)), delta, n, wanted)
    down = {k: s / (np.sqrt(cos2) if k in ("x", "t") else cos2) for k, s in down.items()}
    beyond = below * cos0**2 * slow
    return PowerFlight(
        n, v, alpha0, cos0, slope, up, U_top, P, down, U, delta, beyond, height, last, status
    )


def climb(v: FloatArray, alpha0: FloatArray, n: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x, y, t of the apex above the launch, as `flight.climb`."""
    angle = np.maximum(alpha0, 0.0)
    sin0, cos0 = np.sin(angle), np.cos(angle)
    slope = np.arcsinh(sin0 / cos0)
    up, _ = arc(start(v * v, sin0, cos0), slope, slope, n, ("x", "y", "t"))
    return cos0 * up["x"], up["y"], up["t"]


def exponent(n: float, v_norm: FloatArray) -> float:
    """The exponent, checked, and with it the speeds it allows."""
    n = option("n", n, EXPONENT)
    if n != 2:
        with np.errstate(over="ignore"):
            check("v_norm**n", v_norm**n, Rule(f"at most {LARGEST:g}", lambda a: a <= LARGEST))
    return n
