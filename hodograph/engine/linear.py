"""Linear drag, n = 1: the path is elementary in time, and one equation gives the landing.

In units of the launch, with z = v t (v is v_norm) and q = v sin(alpha0),

    x = cos(alpha0) t E(z),    y = sin(alpha0) t E(z) - t^2 G(z),
    E = (1 - exp(-z)) / z,     G = (z - 1 + exp(-z)) / z^2,

E and G being 1 and 1/2 in vacuum.  The apex is at z = log1p(q).  The fall from there, or from a
launch with downward speed s, lasts until

    s t E(z) + t^2 G(z) = drop,

all terms of one sign, so that nothing cancels for weak drag, where Lambert's W, which solves this
too, is at its branch point.  The equation is solved by Halley's iteration.  Only the length of
path is an integral: with U = exp(z) and C, delta as in `power`, that of (C / U)^2 over delta.
"""

from __future__ import annotations

import math
from math import asinh, atan2, cos, exp, expm1, hypot, log1p, pi, sin, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import scalar
from hodograph.engine.domain import FloatArray
from hodograph.engine.extremes import STEEPEST
from hodograph.engine.fall import slope_gain
from hodograph.engine.flight import EPSILON
from hodograph.engine.position import (
    BLOCK,
    NODE_COUNTS,
    NODES_PER_DIGIT,
    NODES_SPARE,
    ellipse,
    gauss_legendre,
)
from hodograph.engine.scalar import Sums
from hodograph.engine.status import Status
from hodograph.engine.velocity import expm1_ratio, start

# G as a power series in -z for z < 1, highest power first
SERIES = tuple(1 / math.factorial(k + 2) for k in range(17, -1, -1))
ROUNDING = 8 * EPSILON
FINAL = 40.0  # z, past the loss of the launch speed, after which the speed is terminal
LAST_STEP = 1e-5  # relative; the order of convergence is 3, so the error left is about its cube
MAX_STEPS = 40
RATE = 1.5  # of C^2, half of what `position.node_class` calls so
FAST = 2.0  # downward launches above so many v_lim have a guess of their own
GUESSES = 6


class Flight(NamedTuple):
    """A landing, with the names of `flight.Flight`, in arrays or in plain floats."""

    v: Any
    sin0: Any
    cos0: Any
    height: Any
    slope: Any
    reach: Any  # x / cos(alpha0)
    t: Any
    tangent: Any
    speed: Any
    P: Any
    delta: Any
    curve: Any  # NaN unless wanted
    tail: Any
    beyond: Any
    error: Any
    status: Any


def _ratios(z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """exp(-z), E and G."""
    loss = -np.expm1(-z)
    near, series = np.maximum(-z, -1.0), np.full_like(z, SERIES[0])
    for c in SERIES[1:]:
        series *= near
        series += c
    small = z < 1
    safe = np.where(small, 1.0, z)
    late = (1 - loss / safe) / safe
    E = np.divide(loss, z, out=np.ones_like(z), where=z > 0)
    return np.exp(-z), E, np.where(small, series, late)


def _rise(v: FloatArray, sin0: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x / cos(alpha0), y and t of the apex; sin0 >= 0."""
    q = v * sin0
    z = np.log1p(q)
    safe = np.where(q > 0, q, 1.0)
    t = np.where(q > 0, sin0 * (z / safe), sin0)
    series = np.full_like(z, SERIES[0])
    for c in SERIES[1:]:
        series *= np.minimum(z, 1.0)
        series += c
    y = np.where(z < 1, t * t * series, sin0 * sin0 * ((1 - z / safe) / safe))
    return sin0 / (1 + q), y, t


def climb(v: FloatArray, alpha0: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x, y, t of the apex above the launch; zero for a downward launch."""
    angle = np.maximum(alpha0, 0.0)
    x, y, t = _rise(v, np.sin(angle))
    return np.cos(angle) * x, y, t


def _first_guess(v: FloatArray, s: FloatArray, drop: FloatArray) -> FloatArray:
    """Time of the fall, to a few percent where it is from an apex."""
    vacuum = 2 * drop / np.maximum(s + np.sqrt(s * s + 2 * drop), 1e-300)
    z, depth, q = v * vacuum, v * (v * drop), v * s
    # z - (1 - q) (1 - exp(-z)) = depth
    ends = depth, depth + 1 - q
    z = np.maximum(np.minimum(z * (1 + z / 6), np.maximum(*ends)), np.minimum(*ends))
    fast = np.flatnonzero(q > FAST)
    if fast.size:  # Newton in exp(-z), from below
        q_, d_ = q[fast], depth[fast]
        with np.errstate(divide="ignore"):
            highest = np.where(d_ < q_, -np.log1p(-np.minimum(d_ / q_, 1.0)), np.inf)
        highest = np.minimum(highest, np.minimum(d_, np.maximum(d_ - q_ + 2, np.log(q_))))
        falls = np.exp(-np.minimum(highest, 700.0))
        for _ in range(GUESSES):
            over = (q_ - 1) * (1 - falls) - np.log(falls) - d_
            falls = np.clip(falls * (1 + over / (1 + (q_ - 1) * falls)), 1e-304, 1.0)
        z[fast] = np.maximum(np.maximum(-np.log(falls), d_ / q_), np.maximum(d_ - q_ + 1, 0.0))
    return np.where(v > 0, np.maximum(z / np.where(v > 0, v, 1.0), vacuum), vacuum)


def _descend(
    v: FloatArray, s: FloatArray, drop: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Time of the fall, downward speed at its end, and whether it converged."""
    time = _first_guess(v, s, drop)
    bends, moving = 0.5 * (1 - v * s), drop > 0
    for _ in range(MAX_STEPS):
        decay, E, G = _ratios(v * time)
        miss = drop - time * (s * E + time * G)
        speed = np.where(moving, s * decay + time * E, 1.0)
        newton = np.where(moving, miss / speed, 0.0)
        step = newton / (1 + np.clip(bends * newton * decay / speed, -0.5, 0.5))
        time = np.maximum(time + step, 0.5 * time)
        done = (np.abs(step) <= LAST_STEP * time) | (np.abs(miss) <= 4 * EPSILON * drop)
        if done.all():
            break
    decay, E, _ = _ratios(v * time)
    return time, s * decay + time * E, done


def fly(v: FloatArray, alpha0: FloatArray, height: FloatArray, wanted: tuple[str, ...]) -> Flight:
    """Landings of one block of launches, as `flight.fly`; the length of path if wanted: "s"."""
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    up, down = np.maximum(sin0, 0.0), np.maximum(-sin0, 0.0)
    _, top, rising = _rise(v, up)
    fall = top + height
    drop = np.maximum(fall, 0.0)
    falling, sinking, converged = _descend(v, down, drop)
    t = rising + falling
    decay, E, _ = _ratios(v * t)
    reach = t * E

    # past `final` the path is straight down, at terminal speed
    final = FINAL + np.log(np.maximum(v, 1.0))
    beyond = np.maximum(v * falling - final, 0.0)
    safe = np.maximum(v, 1e-150)
    shown = v * rising + np.minimum(v * falling, final)
    across = cos0 * np.exp(-shown)
    p = sinking / across
    slope = np.arcsinh(up / cos0)
    curved = np.where(beyond > 0, final / safe, falling)
    p0, gain = down / cos0, curved * expm1_ratio(shown) / cos0
    delta = np.where(sin0 < 0, slope_gain(p0 * p0, p * p, gain * (p0 + p)), slope + np.arcsinh(p))
    curve = np.full_like(v, np.nan)
    if "s" in wanted:
        rises, passing = sin0 > 0, cos0 / (1 + v * up)
        top_v, level = np.where(rises, v * passing, v), np.minimum(sin0, 0.0)
        curve = _length(v, up, cos0, slope) + np.where(rises, passing * passing, 1.0) * _length(
            top_v, level, np.where(rises, 1.0, cos0), delta - slope
        )

    e = ROUNDING * (top + np.abs(height))
    # close to the apex the path steepens as it falls by e, until its speed is terminal
    steep = np.maximum(sinking, np.minimum(np.sqrt(sinking * sinking + 2 * e), 1 / safe))
    worst = np.maximum(_part(e * decay, steep * reach), _part(e, steep * t))
    status = np.where(
        fall < 0, Status.UNREACHABLE, np.where(converged, Status.CONVERGED, Status.NOT_CONVERGED)
    )
    return Flight(
        v, sin0, cos0, height, slope, reach, t, p * np.exp(np.minimum(beyond, STEEPEST)),
        np.hypot(cos0 * decay, sinking), p * p, delta, curve, beyond / safe / safe, beyond,
        ROUNDING + 2 * worst, status.astype(np.int8),
    )  # fmt: skip


def _length(v: FloatArray, sin0: FloatArray, cos0: FloatArray, delta: FloatArray) -> FloatArray:
    """Length of path: (C / U)^2 over delta, by the map and the rules of `position`."""
    begin = start(v * v, sin0, cos0)
    eta = np.log1p(1 / np.maximum(v, 1e-300))
    length = np.log1p(delta / eta)
    # U = v cos(alpha0) (M - tan(alpha)); its real zero, eta away, comes again 2 pi beside, and
    # another one turns with the fall
    tan0, long = sin0 / cos0, np.maximum(length, 1e-6)
    turn = np.arcsinh(tan0) + np.arcsinh(tan0 + 1 / np.maximum(v * cos0, 1e-300)) + eta
    ln_rho = ellipse(long, np.hypot(turn, np.pi) / eta, np.arctan2(np.pi, turn))
    ln_rho = np.minimum(ln_rho, ellipse(long, 2 * np.pi / eta, np.pi / 2))
    resolved = np.sqrt(NODES_PER_DIGIT * np.maximum(RATE * delta, length / 2))
    count = NODES_SPARE + np.maximum(NODES_PER_DIGIT / np.maximum(ln_rho, 1e-3), resolved)
    kinds = np.minimum(np.searchsorted(NODE_COUNTS, count), NODE_COUNTS.size - 1)
    total = np.empty_like(v)
    for kind in np.flatnonzero(np.bincount(kinds)):
        nodes, weights = gauss_legendre(int(NODE_COUNTS[kind]))
        members = np.flatnonzero(kinds == kind)
        width = max(BLOCK // nodes.size, 1)
        for first in range(0, members.size, width):
            at = members[first : first + width]
            own, stretch = begin.at(at), np.expm1(length[at] * nodes)
            growth = np.expm1(eta[at] * stretch)
            down = own.plus / (1 + growth)
            slow = (down + own.minus * (1 + growth)) / (2 + v[at] * growth * (down + own.minus))
            terms = weights * (stretch + 1) * slow * slow
            total[at] = eta[at] * length[at] * np.add.reduce(terms, axis=0)
    return total


def _part(part: FloatArray, whole: FloatArray) -> FloatArray:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(part == 0, 0.0, part / whole)


# The same for one launch, in plain floats.


def ratios_alone(z: float) -> tuple[float, float, float]:
    """exp(-z), E and G of one launch."""
    loss = -expm1(-z)
    if z >= 1.0:
        return exp(-z), loss / z, (1.0 - loss / z) / z
    return exp(-z), loss / z if z else 1.0, _series(z)


def _series(z: float) -> float:
    """G for z < 1."""
    G = 0.0
    for c in SERIES if abs(z) > 0.125 else SERIES[-10:]:
        G = c - z * G
    return G


def _rise_alone(v: float, sin0: float) -> Sums:
    q = v * sin0
    if not q:
        return sin0, 0.5 * sin0 * sin0, sin0
    z = log1p(q)
    t = sin0 * (z / q)
    y = t * t * _series(-z) if z < 1.0 else sin0 * sin0 * ((1.0 - z / q) / q)
    return sin0 / (1.0 + q), y, t


def climb_alone(v: float, alpha0: float) -> Sums:
    """`climb` of one launch."""
    if alpha0 <= 0:
        return 0.0, 0.0, 0.0
    x, y, t = _rise_alone(v, sin(alpha0))
    return cos(alpha0) * x, y, t


def _first_guess_alone(v: float, s: float, drop: float) -> float:
    vacuum = 2 * drop / (s + sqrt(s * s + 2 * drop))
    z, depth, q = v * vacuum, v * (v * drop), v * s
    if q > FAST:  # seldom, and long
        return float(_first_guess(*(np.array([each]) for each in (v, s, drop)))[0])
    z *= 1.0 + z / 6
    ends = depth, depth + 1.0 - q
    z = max(min(z, max(ends)), min(ends))
    return max(z / v, vacuum) if v else vacuum


def _descend_alone(v: float, s: float, drop: float) -> tuple[float, float, bool]:
    time = _first_guess_alone(v, s, drop)
    bends, done = 0.5 * (1.0 - v * s), False
    for _ in range(MAX_STEPS):
        decay, E, G = ratios_alone(v * time)
        miss = drop - time * (s * E + time * G)
        speed = s * decay + time * E
        newton = miss / speed
        step = newton / (1.0 + max(min(bends * newton * decay / speed, 0.5), -0.5))
        time = max(time + step, 0.5 * time)
        if abs(step) <= LAST_STEP * time or abs(miss) <= 4 * EPSILON * drop:
            done = True
            break
    loss = -expm1(-v * time)
    return time, s * exp(-v * time) + (loss / v if v else time), done


def fly_alone(v: float, alpha0: float, height: float, wanted: tuple[str, ...]) -> Flight | None:
    """`fly` of one launch, or None where it is for the arrays."""
    try:
        return _fly_alone(v, alpha0, height, "s" in wanted)
    except (OverflowError, ZeroDivisionError, ValueError):
        return None


def _fly_alone(v: float, alpha0: float, height: float, lengthy: bool) -> Flight | None:
    sin0, cos0 = sin(alpha0), cos(alpha0)
    up, down = max(sin0, 0.0), max(-sin0, 0.0)
    _, top, rising = _rise_alone(v, up)
    drop = top + height
    if not 0 < drop < math.inf:
        return None
    falling, sinking, converged = _descend_alone(v, down, drop)
    t = rising + falling
    z = v * t
    reach, decay = -expm1(-z) / v if v else t, exp(-z)
    if not converged or v * falling > FINAL:
        return None
    p = sinking / (cos0 * decay)
    slope = asinh(up / cos0)
    if sin0 < 0:
        p0 = down / cos0
        gain = (p + p0) * t * (expm1(z) / z if z else 1.0) / cos0
        delta = asinh(gain / (p * sqrt(1.0 + p0 * p0) + p0 * sqrt(1.0 + p * p)))
    else:
        delta = slope + asinh(p)
    curve = math.nan
    if lengthy and sin0 > 0:
        passing = cos0 / (1.0 + v * sin0)
        curve = _length_alone(v, sin0, cos0, slope)
        curve += passing * passing * _length_alone(v * passing, 0.0, 1.0, delta - slope)
    elif lengthy:
        curve = _length_alone(v, sin0, cos0, delta)
    e = ROUNDING * (top + abs(height))
    steep = max(sinking, min(sqrt(sinking * sinking + 2 * e), 1.0 / max(v, 1e-150)))
    return Flight(
        v, sin0, cos0, height, slope, reach, t, p, hypot(cos0 * decay, sinking), p * p, delta,
        curve, 0.0, 0.0,
        ROUNDING + 2 * max(e * decay / (steep * reach), e / (steep * t)), Status.CONVERGED,
    )  # fmt: skip


def _length_alone(v: float, sin0: float, cos0: float, delta: float) -> float:
    """Length of path: (C / U)^2 over delta, by the nodes of quadratic drag."""
    eta = log1p(1.0 / max(v, 1e-300))
    length = log1p(delta / eta)
    tan0, long = sin0 / cos0, max(length, 1e-6)
    turn = asinh(tan0) + asinh(tan0 + 1.0 / max(v * cos0, 1e-300)) + eta
    ln_rho = scalar.ellipse(long, hypot(turn, pi) / eta, atan2(pi, turn))
    ln_rho = min(ln_rho, scalar.ellipse(long, 2 * pi / eta, pi / 2))
    nodes = scalar.rule_for(ln_rho, RATE * delta, length)
    plus, minus = scalar.halves(sin0, cos0)
    total = 0.0
    for node, weight in nodes:
        stretch = expm1(length * node)
        growth = expm1(eta * stretch)
        down = plus / (1.0 + growth)
        slow = (down + minus * (1.0 + growth)) / (1.0 + v * growth * (down + minus))
        total += weight * (stretch + 1.0) * slow * slow
    return eta * length * total
