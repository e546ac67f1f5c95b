"""The angle of greatest range of one launch, in plain floats.

For quadratic drag it is the root of dR/dalpha0 as `derivatives` has it, with n = 2, where K2 is
delta: the formulas and the symbols are told there.  For linear drag one equation gives it.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import asin, asinh, cbrt, cosh, expm1, inf, log, log1p, sqrt, tan, tanh

import numpy as np

from hodograph.engine import linear, scalar
from hodograph.engine.derivatives import EARLY
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.engine.flight import EPSILON, fly
from hodograph.engine.position import gauss_legendre
from hodograph.engine.scalar import Flight
from hodograph.engine.velocity import expm1_ratio, log1p_ratio

LAST_STEP = 2e-15  # of the product of the last two steps, relative: the error that is left
MAX_STEPS = 60


def _along(
    v2: float, sin0: float, cos0: float, slope: float, delta: float
) -> Iterator[tuple[float, float, float, float, float]]:
    """Weight, delta, C, C sin(alpha), U at the nodes of an arc, as in `scalar.arc`."""
    eta = scalar.layer(v2)
    length = log1p(delta / eta)
    cos2 = cos0 * cos0
    plus, minus = scalar.halves(sin0, cos0)
    scale = eta * length
    for node, weight in scalar.node_class(v2 * cos2, sin0 / cos2, slope, delta, eta, length):
        stretch = expm1(length * node)
        at = eta * stretch
        growth = expm1(at)
        grown = 1.0 + growth
        down = plus / grown
        bend = growth * (down + minus)
        S = sin0 - bend
        u = 1.0 + v2 * (cos2 * at + bend + growth * (down - minus) * S)
        yield scale * weight * (stretch + 1.0), at, down + minus * grown, S, u


def slant(v: float, flight: Flight) -> float:
    """dR/dalpha0 times q / (q + tan(alpha0)), positive below the angle of greatest range."""
    s, c, q = flight.sin0, flight.cos0, flight.tangent
    v2, slope0, end = v * v, asinh(s / c), flight.delta
    near = min(EARLY, end)
    B = 0.0
    for weight, at, C, S, u in _along(v2, s, c, slope0, near):
        cosine, sine, T = c / C, S / C, 1.0 - s * at
        B += weight / u * (cosine * cosine * T + s * sine + q * cosine * (s - sine * T))
    slope = slope0 - near
    sine, cosine = tanh(slope), 1.0 / cosh(slope)
    C, U = c / cosine, 1.0 + v2 * scalar.bracket_gap(s, c, near)
    B += (sine + q * cosine) * (1.0 - s * near) / U
    high = flight.slope > EARLY  # the apex comes later
    legs = [(v2 * C * C / U, sine, cosine, slope, (slope0 if high else end) - near, C / U, near)]
    if high:
        legs.append((flight.top_v2, 0.0, 1.0, 0.0, flight.fall_delta, flight.across2 / c, slope0))
    for own_v2, sin0, cos0, first, delta, unit, K in legs:
        late = 0.0
        for weight, at, C, S, u in _along(own_v2, sin0, cos0, first, delta):
            late += weight * C / (u * u) * (S + cos0 * q) * (1.0 - s * (K + at))
        B -= 2.0 * v2 * unit * unit * late
    return (c * B - q * s * flight.reach) / (s / c + q)


def best(v: float, height: float, n: float, guess: float) -> float | None:
    """The angle of greatest range of one launch, near `guess`; None where it is for the arrays.

    `height` is in v0^2 / g, and n is 1 or 2.
    """
    try:
        return _linear(v, height) if n == 1 else _square(v, height, guess)
    except (OverflowError, ZeroDivisionError, ValueError):
        return None


def _square(v: float, height: float, guess: float) -> float | None:
    """The root of `slant` by the secant, kept between two bounds."""
    low, high, angle = 0.0, RIGHT_ANGLE, guess
    before = moved = 0.0  # `slant` at the angle before, and the step from there
    for _ in range(MAX_STEPS):
        flight = scalar.fly(v, angle, height, ("x",))
        if flight is None:
            return None
        here = slant(v, flight) if flight.P > 0 else inf  # the height is not reached
        low, high = (angle, high) if here > 0 else (low, angle)
        if moved and here < inf > before:
            rate = (here - before) / moved
        else:  # to some percent, on level ground
            rate = -sqrt(2) * cbrt(1 / tan(angle)) * flight.reach
        step = -here / rate
        if not low < angle + step < high:
            step = 0.5 * (low + high) - angle
            if abs(step) <= 4 * EPSILON * angle:
                return angle + step if high < RIGHT_ANGLE else None
        elif moved and abs(step * moved) <= LAST_STEP * angle * angle:
            return angle + step
        angle, before, moved = angle + step, here, step
    return None


def _linear(v: float, height: float) -> float | None:
    """From the time of flight t.

    dR/dalpha0 = 0 where sin(alpha0) = v / (e^z - 1), and there

        t^2 G(z) - e^-z = height,    z = v t,

    with G as in `linear`.  The left side rises with t: as a convex function for v < 1, for which
    Newton converges from anywhere, and as a concave one for v > 1, for which it does from below.
    """
    if v <= 1:
        time = sqrt(2 * (1 + height))
    else:
        low = 2 * log(v)
        time = (low - log(low)) / v if height >= 0 and low > 1 else 0.0
    for _ in range(MAX_STEPS):
        decay, E, G = linear.ratios_alone(v * time)
        step = (height + decay - time * time * G) / (time * E + v * decay)
        time += step
        if abs(step) <= 1e-8 * time:  # what remains is its square
            z = v * time
            return asin(z / expm1(z) / time if z else 1 / time)
    return None


def weak_balance(v: float, n: float) -> float:
    """What must vanish for 45 degrees to be the best angle, divided by eps = v^n.

    There p0 = 1 and, with phi_a = (1 - U^-a) / eps, M the integral of p phi_(2/n) and K that of
    (p + q) phi_(1 + 2/n), the fall to the ground is q^2 = 1 - 2 eps M and the condition

        sqrt(2) ((1 + q)^2 / 2 - eps K) = M + K,

    in which nothing cancels while eps is small.
    """
    eps = v**n
    flight = fly(np.array([v]), np.array([np.pi / 4]), np.zeros(1), np.array([n]), ())
    q = float(flight.tangent[0])
    nodes, weights = gauss_legendre(40)
    p = 1 - (1 + q) * nodes
    inner = p + (1 - p) * nodes.T
    gap = (1 - p) * ((1 + inner**2) ** ((n - 1) / 2) @ weights)
    growth = n * 2 ** (-n / 2) * gap  # (U - 1) / eps
    log = np.log1p(eps * growth)

    def integral(integrand: FloatArray, a: float) -> float:
        phi = a * growth * log1p_ratio(eps * growth) * expm1_ratio(-a * log)
        return float((1 + q) * np.sum(weights * integrand * phi))

    M, K = integral(p, 2 / n), integral(p + q, 1 + 2 / n)
    return float(np.sqrt(2) * ((1 + q) ** 2 / 2 - eps * K) - M - K)
