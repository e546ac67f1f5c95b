"""The fall to a given depth, by Newton: the heart of the landing (eq. 20).

The fall is solved in P = tan^2(alpha).  With Y the height fallen in units of v_x^2 / g, v_x the
horizontal speed where the fall begins, and w = v_x^2 / v_lim^2,

    H(P) = expm1(2 w Y) / w,    dH/dP = exp(2 w Y) / u > 0,
    d ln(dH/dP) / dP = (w / u) (1 - sqrt(1 + 1 / P)) < 0.

The more nearly vertical the fall, the more nearly H is linear in P.  It increases, is concave, and
H <= P - P_start.  Newton in H therefore converges from every start, from below after at most one
step, and P_start + H(target) is a start from below.  With h = expm1(2 w miss) / 2 w, so that
dP/dh = 2 u / (1 + 2 w h), and u' = du/dP, a step of fourth order is

    2 u h / (1 - c + c^2 - d),   c = (u' - w) h,   d = 2/3 h^2 ((u' - w) (u' - 2 w) + u u''),

where the correction is bounded, at last so tightly that these are all but Newton's own.  The
guess, by few nodes, is mostly so near that after one full quadrature a single step ends it, which
a Taylor series integrates.  After a longer one the fall is integrated afresh.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import FloatArray
from hodograph.engine.position import arc, gauss_legendre
from hodograph.engine.velocity import Start, bracket_gap, expm1_ratio

MAX_STEPS, BOLD_STEPS = 60, 5
BOLD, TIMID = 0.5, 0.01  # limits of the correction to a Newton step, in early and late steps
GUESS_NODES, GUESS_LONGEST = 6, 6.0  # nodes of the guess, and the slope that they do for
LAST_STEP = 2e-4  # relative; convergence is of order 4: the error left is about its 4th power
TINY = float(np.finfo(np.float64).tiny)


class Descent(NamedTuple):
    """Falls in units of v_x^2 / g and v_x / g."""

    P: FloatArray
    delta: FloatArray  # slope come down since the fall began
    sums: dict[str, FloatArray]  # y < 0, and x, t, s if wanted
    U: FloatArray  # the bracket of eq. 13 at the end, 1 where the fall began
    error: FloatArray  # relative, of P
    converged: NDArray[np.bool_]
    steps: NDArray[np.int8]


@np.errstate(all="ignore")  # P may overflow or underflow: the fall is then integrated afresh
def descend(
    begin: Start, P_start: FloatArray, drop: FloatArray, wanted: tuple[str, ...]
) -> Descent:
    """Fall by `drop` from slopes that are level or downward, tan^2 of which is `P_start`."""
    w = begin.v2 * begin.plus * begin.minus
    least = 2 * drop * expm1_ratio(2 * w * drop)  # H at the target: P - P_start is at least that
    gain = _first_guess(P_start, w, drop, least)
    u, sums = _from_start(begin, P_start, gain, wanted)

    error, steps = np.zeros_like(w), np.zeros(w.shape, np.int8)
    todo = np.flatnonzero(drop > 0)
    for number in range(1, MAX_STEPS + 1):
        if not todo.size:
            break
        at = slice(None) if todo.size == w.size else todo
        P, now, miss = P_start[at] + gain[at], gain[at], drop[at] + sums["y"][at]
        newton = _newton(P, u[at], w[at], miss, BOLD if number <= BOLD_STEPS else TIMID)
        following = now + newton
        if (low := following < least[at]).any():  # by the rounding of y, or a step too long
            following = np.maximum(following, least[at])
            miss = np.where(low, miss * ((following - now) / newton), miss)
        step = following - now
        part = np.abs(step) / following
        error[at], steps[at], gain[at] = np.minimum(part, 1.0) ** 4, number, following
        pieces, u[at] = _taylor(P, u[at], w[at], miss, step, wanted)
        for name in wanted:
            sums[name][at] += pieces[name]
        todo = todo[~(part <= LAST_STEP)]
        if todo.size:
            u[todo], afresh = _from_start(begin.at(todo), P_start[todo], gain[todo], wanted)
            for name in wanted:
                sums[name][todo] = afresh[name]
    converged = np.ones(w.shape, bool)
    converged[todo] = False
    P = P_start + gain
    return Descent(P, slope_gain(P_start, P, gain), sums, u, error, converged, steps)


def _newton(
    P: FloatArray, u: FloatArray, w: FloatArray, miss: FloatArray, bound: float
) -> FloatArray:
    """The step in P to where the fall is deeper by `miss`."""
    p, secant = np.sqrt(P), np.sqrt(1 + P)
    h = miss * expm1_ratio(2 * w * miss)
    c = w * (secant / p - 1) * h
    bend = c - c * c + 2 / 3 * (c * (c - w * h) - 0.5 * u * w * (h / P) * (h / (p * secant)))
    return np.asarray(2 * u * h / (1 - np.clip(bend, -bound, bound)))


def _taylor(
    P: FloatArray, u: FloatArray, w: FloatArray, miss: FloatArray, step: FloatArray,
    wanted: tuple[str, ...],
) -> tuple[dict[str, FloatArray], FloatArray]:  # fmt: skip
    """What the last step adds to the integrals, in powers of `miss`, and u at its end."""
    p, secant = np.sqrt(P), np.sqrt(1 + P)
    turn, bow = w * (secant / p), w / (p * secant)  # u' and -2 P u''
    z, a = u / P * miss, turn * miss
    pieces = {"y": -miss}
    if "x" in wanted:
        pieces["x"] = miss / p * (1 - z * (0.5 - 0.5 * z + a / 3))
    if "t" in wanted:
        a -= z
        bend = (a * (a - 2 * z) - z * bow * miss) / 6
        pieces["t"] = miss / p * np.sqrt(u) * (1 + 0.5 * a + bend)
    r = step / P
    u = u + step * (turn - bow * r * (0.25 - (r * 3 + step / (1 + P)) / 24))
    return pieces, u


def _first_guess(
    P_start: FloatArray, w: FloatArray, drop: FloatArray, least: FloatArray
) -> FloatArray:
    """P - P_start: F(p) - p^2 held at a mean value, then a step of Newton by few nodes."""
    start = _thickness(np.sqrt(P_start), np.sqrt(1 + P_start))
    P = P_start + least
    p = np.sqrt(P)
    mean = (_thickness(p, np.sqrt(1 + P)) - start) * (2 / 3 + p) / (1 + p)
    gain = np.maximum((1 + w * mean) * least, least)
    sloping = P_start > 0
    if sloping.any():  # there F rises by less than its first slope, which bounds P from above
        thin = np.sqrt(1 + 1 / np.where(sloping, np.maximum(P_start, TINY), 1.0))
        gain = np.where(
            sloping, np.minimum(gain, 2 * drop * expm1_ratio(2 * w * thin * drop)), gain
        )
    s, fallen = np.arcsinh(np.sqrt(gain)), np.zeros_like(gain)
    for node, weight in zip(*gauss_legendre(GUESS_NODES), strict=True):
        growth = np.expm1(2 * node * s)
        growth *= 0.25 * (1 + 1 / (1 + growth))  # tan / cos of the slope
        fallen += weight * growth / (1 + w * (node * s + growth))
    u = 1 + w * (s + np.sqrt(gain) * np.sqrt(1 + gain))
    better = gain + _newton(gain, u, w, drop - s * fallen, BOLD)
    return np.asarray(np.where((s < GUESS_LONGEST) & ~sloping, np.fmax(better, least), gain))


def _thickness(p: FloatArray, secant: FloatArray) -> FloatArray:
    """F(p) - p^2, what F is beside p^2: 2 p while p is small, ln(p) when it is large."""
    return np.asarray(p / (secant + p) + np.arcsinh(p))


def slope_gain(P0: FloatArray, P1: FloatArray, gain: FloatArray) -> FloatArray:
    """asinh(sqrt P1) - asinh(sqrt P0) from gain = P1 - P0, without subtracting the two."""
    span = np.sqrt(P1) * np.sqrt(1 + P0) + np.sqrt(P0) * np.sqrt(1 + P1)
    return np.asarray(np.arcsinh(gain / np.maximum(span, TINY)))


def _from_start(
    begin: Start, P_start: FloatArray, gain: FloatArray, wanted: tuple[str, ...]
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """u, and the integrals from the start of the fall, in units of v_x^2 / g."""
    cos2 = begin.plus * begin.minus
    delta = slope_gain(P_start, P_start + gain, gain)
    sums = arc(begin, -np.arcsinh(np.sqrt(P_start)), delta, wanted)
    unit = {"y": cos2}
    gap, _ = bracket_gap(begin, delta)
    return 1 + begin.v2 * gap, {k: s / unit.get(k, np.sqrt(cos2)) for k, s in sums.items()}
