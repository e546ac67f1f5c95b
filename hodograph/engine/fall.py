"""The fall to a given depth, by Newton: the heart of the landing (eq. 20).

The fall is solved in P = tan^2(alpha).  With Y the height fallen in units of v_x^2 / g, v_x the
horizontal speed where the fall begins, and w = v_x^2 / v_lim^2,

    H(P) = expm1(2 w Y) / w,    dH/dP = exp(2 w Y) / u > 0,
    d ln(dH/dP) / dP = (w / u) (1 - sqrt(1 + 1 / P)) < 0.

H is what a vertical fall would make a straight line of: it increases, it is concave, and
H <= P - P_start.  Newton in H therefore converges from every start, from below after at most one
step, and P_start + H(target) is a start from below.  The first steps carry Halley's correction,
bounded, which makes them fewer; were they to lead nowhere, plain Newton goes on.  After one full
quadrature each later step integrates only over the interval between two iterates, if it is short.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import FloatArray
from hodograph.engine.position import arc, gauss_legendre, node_sum, widen
from hodograph.engine.velocity import Start, bracket_gap, expm1_ratio

MAX_STEPS = 60
HALLEY_STEPS = 5
# The last step, relative to the fall: what remains after it is its cube with Halley's correction,
# its square without.
LAST_STEP, LAST_NEWTON_STEP = 1e-5, 3e-8
TINY = float(np.finfo(np.float64).tiny)
# A step that changes the fall by no more than this factor is integrated in P by so many nodes,
# exact to rounding: first the one from the guess, then those after it.
FIRST_STEP, LATER_STEP = (2.0, 12), (1.02, 4)


class Descent(NamedTuple):
    """Falls in units of v_x^2 / g and v_x / g."""

    P: FloatArray
    delta: FloatArray  # slope come down since the fall began
    sums: dict[str, FloatArray]  # y < 0, and x, t, s if wanted
    U: FloatArray  # the bracket of eq. 13 at the end, 1 where the fall began
    error: FloatArray  # relative, of P
    converged: NDArray[np.bool_]
    steps: NDArray[np.int8]


def descend(
    begin: Start, P_start: FloatArray, drop: FloatArray, wanted: tuple[str, ...]
) -> Descent:
    """Fall by `drop` from slopes that are level or downward, tan^2 of which is `P_start`."""
    cos2 = begin.plus * begin.minus
    w = begin.v2 * cos2
    least = 2 * drop * expm1_ratio(2 * w * drop)  # H at the target: P - P_start is at least that
    gain = _first_guess(P_start, w, drop, least)
    P = P_start + gain
    delta = slope_gain(P_start, P, gain)
    u = 1 + begin.v2 * bracket_gap(begin, delta)[0]
    sums = _from_start(begin, cos2, P_start, delta, wanted)

    error, steps = np.zeros_like(P), np.zeros(P.shape, np.int8)
    todo = np.flatnonzero(drop > 0)
    for number in range(1, MAX_STEPS + 1):
        if not todo.size:
            break
        at = slice(None) if todo.size == P.size else todo
        P_, u_, w_, gain_ = P[at], u[at], w[at], gain[at]
        miss = drop[at] + sums["y"][at]
        newton = 2 * u_ * miss * expm1_ratio(2 * w_ * miss)
        if number <= HALLEY_STEPS:
            bend = newton * w_ * (1 - np.sqrt(1 + 1 / np.maximum(P_, 1e-300))) / (2 * u_)
            newton = newton / (1 + np.maximum(np.minimum(bend, 0.5), -0.5))
        gain_next = np.maximum(gain_ + newton, least[at])
        step = gain_next - gain_
        relative = np.abs(step) / gain_next
        longest, nodes = FIRST_STEP if number == 1 else LATER_STEP
        far = ~((gain_next <= longest * gain_) & (gain_ <= longest * gain_next))

        pieces, u_next = _step(nodes, P_, u_, w_, step, wanted)
        for name, piece in pieces.items():
            sums[name][at] += piece
        P[at], u[at], gain[at] = P_start[at] + gain_next, u_next, gain_next
        order = 3 if number <= HALLEY_STEPS else 2
        error[at], steps[at] = np.minimum(relative, 1.0) ** order, number
        if far.any():  # afresh from the start
            long = todo[far]
            whole, start_ = begin.at(long), P_start[long]
            delta = slope_gain(start_, P[long], gain[long])
            u[long] = 1 + whole.v2 * bracket_gap(whole, delta)[0]
            for name, sum_ in _from_start(whole, cos2[long], start_, delta, wanted).items():
                sums[name][long] = sum_
        todo = todo[~(relative <= (LAST_STEP if order == 3 else LAST_NEWTON_STEP))]
    converged = np.ones(P.shape, bool)
    converged[todo] = False
    return Descent(P, slope_gain(P_start, P, gain), sums, u, error, converged, steps)


def _first_guess(
    P_start: FloatArray, w: FloatArray, drop: FloatArray, least: FloatArray
) -> FloatArray:
    """P - P_start to some percent: F(p) - p^2 held at a mean value, twice improved."""
    start = _thickness(np.sqrt(P_start), np.sqrt(1 + P_start))
    gain = least
    for _ in range(2):
        P = P_start + gain
        p = np.sqrt(P)
        mean = (_thickness(p, np.sqrt(1 + P)) - start) * (2 / 3 + p) / (1 + p)
        gain = np.maximum((1 + w * mean) * least, least)
    sloping = P_start > 0
    if sloping.any():  # there F rises by less than its first slope, which bounds P from above
        thin = np.sqrt(1 + 1 / np.where(sloping, np.maximum(P_start, TINY), 1.0))
        with np.errstate(over="ignore"):
            most = 2 * drop * expm1_ratio(2 * w * thin * drop)
        gain = np.where(sloping, np.minimum(gain, most), gain)
    return gain


def _thickness(p: FloatArray, secant: FloatArray) -> FloatArray:
    """F(p) - p^2: it grows as 2 p, then as a logarithm."""
    return np.asarray(p / (secant + p) + np.arcsinh(p))


def slope_gain(P0: FloatArray, P1: FloatArray, gain: FloatArray) -> FloatArray:
    """asinh(sqrt P1) - asinh(sqrt P0) from gain = P1 - P0, without subtracting the two."""
    span = np.sqrt(P1) * np.sqrt(1 + P0) + np.sqrt(P0) * np.sqrt(1 + P1)
    return np.asarray(np.arcsinh(gain / np.maximum(span, TINY)))


def _from_start(
    begin: Start, cos2: FloatArray, P_start: FloatArray, delta: FloatArray, wanted: tuple[str, ...]
) -> dict[str, FloatArray]:
    """The integrals from the start of the fall, in units of v_x^2 / g."""
    sums = arc(begin, -np.arcsinh(np.sqrt(P_start)), delta, wanted)
    return {name: sum_ / (cos2 if name == "y" else np.sqrt(cos2)) for name, sum_ in sums.items()}


@np.errstate(all="ignore")  # P beyond the doubles, or below: then a long step, taken afresh
def _step(
    n: int, P0: FloatArray, u0: FloatArray, w: FloatArray, step: FloatArray, wanted: tuple[str, ...]
) -> tuple[dict[str, FloatArray], FloatArray]:
    """What a short step in P adds to the integrals, and u at its end."""
    nodes, weights = gauss_legendre(n, end=True)
    dP = widen(step) * nodes
    P = P0 + dP
    p0, secant0, p, secant = np.sqrt(P0), np.sqrt(1 + P0), np.sqrt(P), np.sqrt(1 + P)
    dF = dP * (1 + P + P0) / (p * secant + p0 * secant0)  # F(p) - F(p0), nothing subtracted
    dF += np.arcsinh(dP / (p * secant0 + p0 * secant))
    u = u0 + w * dF
    dy = weights / u  # times step / 2: dy = dP / 2u, dx = dy / p, dt = dx sqrt(u)
    integrands = {
        "y": lambda: -dy,
        "x": lambda: dy / p,
        "t": lambda: dy / p * np.sqrt(u),
    }
    half = step / 2
    return {name: half * node_sum(integrands[name](), step.size) for name in wanted}, u[
        -1, : step.size
    ]
