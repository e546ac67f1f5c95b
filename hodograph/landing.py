"""The landing: the slope at which a given drop is reached, by Newton (eq. 20).

The fall is solved in P = tan^2(alpha).  With Y the height fallen in units of v_lim^2 / g, a the
start of the fall and w the square of the horizontal speed there,

    H(P) = expm1(2 w Y) / w,    dH/dP = exp(2 w Y) / u > 0,
    d ln(dH/dP) / dP = (w / u) (1 - sqrt(1 + 1 / P)) < 0.

H is what a vertical fall would make a straight line of: it increases and is concave, and
H <= P - P_a.  Newton in H therefore converges from every start, from below after at most one
step, and P_a + H(target) is a start from below.  After one full quadrature each later step
integrates only over the interval between two iterates.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import exprel

from hodograph import domain, velocity
from hodograph.domain import FloatArray
from hodograph.position import FASTEST, arc, run_in
from hodograph.velocity import log1p_ratio

CONVERGED, UNREACHABLE, NOT_CONVERGED = 0, 1, 2

LAUNCHES_AT_ONCE = 16384
MAX_STEPS = 30
LAST_STEP = 1e-5  # of P: the iteration is of third order, so what remains is its cube
TERMINAL = 45.0  # depth of fall, past the loss of launch speed, where all but y and t is final
EPSILON = float(np.finfo(np.float64).eps)
SHALLOWEST = 1e-145  # below it a level flight is vacuum's for every v <= FASTEST, and scales


class Flight(NamedTuple):
    """Landings in units of the launch: lengths v_e^2 / g, times v_e / g, speeds v_e.

    v_e is v_norm, or `position.FASTEST` where that is less.  `reach` is x / cos(alpha0) and
    `tangent` is -tan(alpha_s).  What was not asked for is empty.
    """

    reach: FloatArray
    t: FloatArray
    speed: FloatArray
    tangent: FloatArray
    arc_length: FloatArray
    status: NDArray[np.int8]
    steps: NDArray[np.int8]
    error: FloatArray


class _Fall(NamedTuple):
    """Falls in units of v_x^2 / g and v_x / g, v_x the horizontal speed where they begin."""

    P: FloatArray
    delta: FloatArray
    reach: FloatArray
    t: FloatArray
    last: FloatArray
    steps: NDArray[np.int8]


def _thickness(P: FloatArray) -> FloatArray:
    """F(p) - p^2 at P = p^2: it grows as 2 p, then as a logarithm."""
    p = np.sqrt(P)
    return p / (np.sqrt(1 + P) + p) + np.arcsinh(p)


def _slope_gain(P0: FloatArray, P1: FloatArray, gain: FloatArray) -> FloatArray:
    """asinh(sqrt P1) - asinh(sqrt P0) from gain = P1 - P0, without subtracting the two."""
    span = np.sqrt(P1) * np.sqrt(1 + P0) + np.sqrt(P0) * np.sqrt(1 + P1)
    return np.arcsinh(gain / np.where(span > 0, span, 1.0))


def _descend(
    v2: FloatArray, sin0: FloatArray, cos0: FloatArray, drop: FloatArray, *, x: bool, t: bool
) -> _Fall:
    """Fall by `drop`, in units of v_x^2 / g, from slopes that are level or downward."""
    w = v2 * cos0 * cos0
    P_start = (sin0 / cos0) ** 2
    least = 2 * drop * exprel(2 * w * drop)  # H at the target: P - P_start is at least that
    gain = least
    for _ in range(2):  # first guess: the thickness of u held at a mean value
        p = np.sqrt(P_start + gain)
        mean = (_thickness(P_start + gain) - _thickness(P_start)) * (2 / 3 + p) / (1 + p)
        gain = np.maximum((1 + w * mean) * least, least)
    P = P_start + gain
    delta = _slope_gain(P_start, P, gain)
    u = 1 + v2 * velocity.bracket_gap(sin0, cos0, delta)[0]
    part = arc(v2, sin0, cos0, np.arcsinh(sin0 / cos0), delta, x=x, t=t)
    fallen, reach, time = -part.y / cos0**2, part.x, part.t
    if x:
        reach /= cos0
    if t:
        time /= cos0

    last, steps = np.zeros_like(P), np.zeros(P.shape, np.int8)
    live = np.flatnonzero(drop > 0)
    while live.size and (number := int(steps[live[0]]) + 1) <= MAX_STEPS:
        P_, u_, w_, gain_ = P[live], u[live], w[live], gain[live]
        miss = drop[live] - fallen[live]
        newton = 2 * u_ * miss * exprel(2 * w_ * miss)
        bend = newton * w_ * (1 - np.sqrt(1 + 1 / P_)) / u_  # Halley's, where it is small
        step = newton / np.where(np.abs(bend) < 1, 1 + bend / 2, 1.0)
        gain_next = np.maximum(gain_ + step, least[live])
        step = gain_next - gain_
        P_next = P_ + step
        delta_next = _slope_gain(P_start[live], P_next, gain_next)
        u_next = 1 + v2[live] * velocity.bracket_gap(sin0[live], cos0[live], delta_next)[0]
        # the step is itself an arc, launched from the upper of its two ends
        down = step >= 0
        high, u_high = np.where(down, P_, P_next), np.where(down, u_, u_next)
        cosine, scale = 1 / np.sqrt(1 + high), (1 + high) / u_high
        part = arc(
            w_ * scale, -np.sqrt(high) * cosine, cosine, -np.arcsinh(np.sqrt(high)),
            _slope_gain(high, np.where(down, P_next, P_), np.abs(step)), x=x, t=t,
        )
        scale = np.where(down, scale, -scale)
        fallen[live] -= part.y * scale
        if x:
            reach[live] += part.x * scale * cosine
        if t:
            time[live] += part.t * np.sign(scale) * np.sqrt(np.abs(scale))
        P[live], u[live], gain[live] = P_next, u_next, gain_next
        last[live], steps[live] = np.abs(step) / gain_next, number
        live = live[last[live] > LAST_STEP]
    return _Fall(P, _slope_gain(P_start, P, gain), reach, time, last, steps)


def _fly(v: FloatArray, alpha0: FloatArray, height: FloatArray, *, x: bool, t: bool) -> Flight:
    """`fly` for one block of finite inputs."""
    fast, run = run_in(v)
    shrink = np.where((height == 0) & (alpha0 > 0) & (alpha0 < SHALLOWEST), alpha0 / SHALLOWEST, 1)
    alpha = np.where(shrink < 1, SHALLOWEST, alpha0)
    sin0, cos0 = np.sin(alpha), np.cos(alpha)
    downward = alpha <= 0
    v2 = fast * fast
    lim2 = np.where(run > 0, 1 / FASTEST**2, 0.0)  # v_lim^2 in units of v_e^2

    # up to the apex
    slope = np.arcsinh(np.where(downward, 0.0, sin0) / cos0)
    up = arc(v2, sin0, cos0, slope, slope, x=x, t=t)
    gap_up = velocity.bracket_gap(sin0, cos0, slope)[0]
    run = np.where(sin0 * run * lim2 + height < 0, height / np.where(run > 0, -sin0 * lim2, 1), run)
    rise = up.y + sin0 * run * lim2
    fall = rise + height
    status = np.where(fall < 0, UNREACHABLE, CONVERGED).astype(np.int8)

    # and down from there, or from the launch itself
    across2 = cos0 * cos0 / (1 + v2 * gap_up)
    w = v2 * across2
    drop = np.maximum(fall, 0.0) / across2
    deepest = TERMINAL + np.log(np.maximum(w, 1.0)) / 2
    beyond = np.maximum(w * drop - deepest, 0.0)  # a fall at terminal speed, in v_lim^2 / g
    drop = np.where(beyond > 0, deepest / np.where(beyond > 0, w, 1.0), drop)
    sin_top, cos_top = np.where(downward, sin0, 0.0), np.where(downward, cos0, 1.0)
    v2_top = np.where(downward, v2, w)
    down = _descend(v2_top, sin_top, cos_top, drop, x=x, t=t)
    gap_down = velocity.bracket_gap(sin_top, cos_top, down.delta)[0]
    u = 1 + v2_top * gap_down
    status[down.last > LAST_STEP] = NOT_CONVERGED

    fallen = np.where(downward, 1.0, across2) * gap_down
    tail = np.divide(beyond, v2, out=np.zeros_like(v2), where=beyond > 0)
    path = 0.5 * (gap_up * log1p_ratio(v2 * gap_up) + fallen * log1p_ratio(v2_top * gap_down))
    reach, time = up.x, up.t
    if x:
        reach = shrink * (reach + run * lim2 + across2 / cos0 * down.reach)
    if t:
        time = shrink * (time + np.sqrt(across2) * down.t + tail * fast)
    worth = (np.abs(rise) + np.abs(height)) / np.where(fall > 0, fall, 1.0)  # condition of the drop
    error = EPSILON * (8 + 2 * slope + 2 * down.delta + worth) + down.last**3
    return Flight(
        reach, time, np.sqrt(across2 * (1 + down.P) / u), shrink * np.sqrt(down.P),
        shrink * (path + run * lim2 + tail), status, down.steps, error,
    )


def fly(
    v: FloatArray, alpha0: FloatArray, height: FloatArray, *, x: bool = True, t: bool = True
) -> Flight:
    """Landings of launches with finite inputs in 1-D arrays, `height` in units of v_e^2 / g."""
    parts = [
        _fly(v[at], alpha0[at], height[at], x=x, t=t)
        for at in (
            slice(first, first + LAUNCHES_AT_ONCE)
            for first in range(0, max(v.size, 1), LAUNCHES_AT_ONCE)
        )
    ]
    return Flight(*(np.concatenate(column) for column in zip(*parts, strict=True)))
