"""x, y and t along an arc, by quadrature of the closed-form speed (eq. 15).

The only singularity near the path lies behind the launch, where the backward trajectory has
infinite speed: at delta = -eta, with eta ~ 1/(2 v^2) for a fast launch, which is also the
thickness of the layer in which drag takes the speed away.  The map

    delta = eta expm1(tau)

sends it to infinity, so that a Gauss-Legendre rule in tau is flat there for every v_norm.
The next singularities are complex; the number of nodes follows from how near they come
(the Bernstein ellipse), launch by launch.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.engine.velocity import Ahead, Start

# Sizes of the Gauss rules; a launch gets the smallest that its Bernstein ellipse allows.
NODE_COUNTS = np.array(
    [6] + [(4 + k) << octave for octave in range(1, 8) for k in range(4)] + [1024]
)
CLASSES = np.searchsorted(NODE_COUNTS, np.arange(NODE_COUNTS[-1] + 1))  # for so many nodes wanted
# ln(1/eps)/2 nodes per unit of 1/ln(rho), and a few for the constant in front.
NODES_PER_DIGIT, NODES_SPARE = 18.5, 4.0
BLOCK = 16384  # nodes times launches held at once: what fits the cache


class Nodes(NamedTuple):
    """An arc at its nodes, arrays of (node, launch); alpha0 is where the arc begins."""

    delta: FloatArray
    C: FloatArray  # cos(alpha0) / cos(alpha)
    S: FloatArray  # C sin(alpha)
    e: FloatArray  # u - 1
    u: FloatArray  # the bracket of eq. 13
    dx: FloatArray  # C / u d(delta)
    begin: Start
    scale: FloatArray  # of `Ahead`
    lever: FloatArray  # L of `Ahead`


# What can be integrated over an arc.  The last ones make derivatives of the range: see
# `sensitivity`.
Integrand: TypeAlias = Callable[[Nodes], FloatArray]
INTEGRANDS: dict[str, Integrand] = {
    "y": lambda at: at.dx * at.S,  # y in v0^2 / g                    eq. 15
    "t": lambda at: at.dx * np.sqrt(at.u),  # t in v0 / g
    "x": lambda at: at.dx,  # x / cos(alpha0) in v0^2 / g
    "drive": lambda at: at.dx / at.u,
    "drive_t": lambda at: at.dx / np.sqrt(at.u),
    "parts": lambda at: at.dx / at.C * (at.scale - at.S * at.lever / at.C**2),
    "lag": lambda at: at.dx * at.e / (1 + np.sqrt(at.u)),  # t - x / cos(alpha0) in v0 / g
    "push": lambda at: at.dx / at.u * at.lever,
    "push_turned": lambda at: at.dx / at.u * at.lever * at.delta,
    "drag": lambda at: at.dx / at.u * at.lever * at.e,
    "tilt": lambda at: (
        at.dx
        / at.C
        * (
            (at.scale - at.S * at.lever / at.C**2) * (1 - at.begin.sin * at.delta)
            + at.begin.sin * at.lever / at.C
        )
    ),
}


@cache
def gauss_legendre(n: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights on [0, 1], as columns, each to full relative accuracy.

    By Newton in the angle theta, x = cos(theta), where the weight 2 / (dP/dtheta)^2 is well
    conditioned: NumPy's `leggauss` loses digits towards the ends (1e-12 at n = 64), where the
    drag layer lies.
    """
    theta = np.pi * (4 * np.arange((n + 1) // 2) + 3) / (4 * n + 2)
    theta += 1 / (8 * n * n * np.tan(theta))  # Tricomi
    slope = np.ones_like(theta)
    for _ in range(4):
        gap = 2 * np.sin(theta / 2) ** 2  # 1 - x
        legendre, step = np.ones_like(theta), np.zeros_like(theta)
        for k in range(n):  # P_{k+1} - P_k, the recurrence that keeps its digits near x = 1
            step = (k * step - (2 * k + 1) * gap * legendre) / (k + 1)
            legendre = legendre + step
        slope = n * (step - gap * legendre) / np.sin(theta)
        theta = theta - legendre / slope
    nodes, weights = np.sin(theta / 2) ** 2, 1 / slope**2
    mirror = slice(n // 2 - 1, None, -1)
    nodes = np.concatenate([nodes, 1 - nodes[mirror]])
    weights = np.concatenate([weights, weights[mirror]])
    for row in (nodes, weights):
        row.flags.writeable = False  # every caller gets the same
    return nodes[:, np.newaxis], weights[:, np.newaxis]


def layer(v2: FloatArray) -> FloatArray:
    """eta: at delta = -eta the path, continued backwards, has infinite speed (exact at 90 deg)."""
    return 0.5 * np.log1p(1 / np.maximum(v2, 1e-300))


def ellipse(length: FloatArray, distance: FloatArray, angle: FloatArray | float) -> FloatArray:
    """ln(rho) of the Bernstein ellipse of tau in [0, length] through ln(distance) + i angle."""
    half = 2 / length
    ahead, aside = np.log(distance) * half, np.square(angle * half)
    axes = np.sqrt(np.square(ahead) + aside) + np.sqrt(np.square(ahead - 2) + aside)
    return np.asarray(np.arccosh(np.maximum(axes / 2, 1.0)))


def node_class(
    begin: Start,
    slope: FloatArray | None,
    delta: FloatArray,
    eta: FloatArray,
    length: FloatArray,
    rate: float = 2.0,
) -> NDArray[np.intp]:
    """Index into NODE_COUNTS for arcs that span `delta`, which is `length` in tau.

    The nearest complex zeros of u stand beside the launch, 2.1 to pi away, and beside the fall,
    at least pi/2 away, where it turns vertical; an arc with `slope` None ends at its apex, far
    from these.  Apart from the zeros, exp(rate delta) and exp(tau) are to be resolved: the
    Chebyshev coefficients of exp(2 c) over [0, c] fall as exp(-k^2 / (2 c)).
    """
    length = np.maximum(length, 1e-6)
    ln_rho = ellipse(length, 2.1 / eta, RIGHT_ANGLE)
    if slope is not None:
        # u = w (a - F(p)): the fall turns where F is -a, with 1.1 the least of the zeros
        cos2 = begin.plus * begin.minus
        a = 1 / np.maximum(begin.v2 * cos2, 1e-300) + slope + begin.sin / cos2
        steepness = np.arcsinh(a / (1 + np.sqrt(1 + np.maximum(a, 0.0))))
        turn = slope + np.maximum(1.1, steepness) + eta  # measured from delta = -eta
        distance, angle = np.sqrt(turn * turn + RIGHT_ANGLE**2), np.arctan2(RIGHT_ANGLE, turn)
        ln_rho = np.minimum(ln_rho, ellipse(length, distance / eta, angle))
    wanted = NODES_SPARE + np.maximum(
        NODES_PER_DIGIT / np.maximum(ln_rho, 1e-3),
        np.sqrt(NODES_PER_DIGIT * np.maximum(rate / 2 * delta, length / 2)),
    )
    return np.asarray(CLASSES[np.ceil(np.minimum(wanted, NODE_COUNTS[-1])).astype(np.intp)])


def widen(row: FloatArray) -> FloatArray:
    """A row of two launches at least: NumPy sums a single column in another order than many.

    A launch must give the same bits alone and among others.
    """
    return row if row.size > 1 else np.concatenate([row, row])


def node_sum(terms: FloatArray, size: int) -> FloatArray:
    """Sum over the nodes of each of `size` launches, undoing `widen`."""
    return np.asarray(np.add.reduce(terms, axis=0)[:size])


def quadrature(
    n: int, begin: Start, eta: FloatArray, length: FloatArray, ahead: Ahead | None,
    wanted: tuple[str, ...], work: FloatArray | None = None,
) -> list[FloatArray]:  # fmt: skip
    """The wanted integrals over arcs of `length` in tau, by n nodes; arrays are (node, launch).

    They are made in the rows of `work`, since fresh memory at each step would double the time.
    """
    nodes, weights = gauss_legendre(n)
    row = widen(length)
    work = np.empty((7, n * row.size)) if work is None else work[:, : n * row.size]
    dx, delta, C, S, e, u, bend = work.reshape(7, n, row.size)
    plus, minus = 0.5 * begin.plus, 0.5 * begin.minus
    stretch = np.expm1(np.multiply(row, nodes, out=dx), out=dx)
    np.multiply(eta, stretch, out=delta)
    growth = np.expm1(delta, out=u)
    grown = np.add(growth, 1, out=C)
    down = np.divide(plus, grown, out=e)
    C *= minus
    C += down
    np.add(down, minus, out=bend)
    bend *= growth  # sin(alpha0) - S
    np.subtract(begin.sin, bend, out=S)
    # e = v^2 [cos^2(alpha0) delta + bend + growth (down - minus) S]
    e -= minus
    e *= growth
    e *= S
    e += bend
    e += np.multiply(4 * plus * minus, delta, out=bend)
    e *= begin.v2
    np.add(e, 1, out=u)
    dx += 1
    dx *= weights
    dx *= C
    dx /= u
    lever = S if ahead is None else ahead.lever(begin, delta)
    here = Nodes(delta, C, S, e, u, dx, begin, S if ahead is None else ahead.scale, lever)
    scale = eta * length
    return [scale * node_sum(INTEGRANDS[name](here), scale.size) for name in wanted]


def arc(
    begin: Start,
    slope: FloatArray | None,
    delta: FloatArray,
    wanted: tuple[str, ...],
    ahead: Ahead | None = None,
) -> dict[str, FloatArray]:
    """Integrals over the arcs that come down by `delta` in slope.

    `slope` is asinh(tan alpha0), or None for arcs that end at their apex; `wanted` names
    INTEGRANDS, and `ahead` is the landing, if they look ahead to it.  All
    arrays are 1-D, of one length and finite.
    """
    if not wanted:
        return {}
    eta = layer(begin.v2)
    length = np.log1p(delta / eta)
    rate = 4.0 if "drag" in wanted else 2.0  # of C L (u - 1)
    kinds = node_class(begin, slope, delta, eta, length, rate)
    results = {name: np.empty_like(delta) for name in wanted}
    work = np.empty((7, BLOCK))
    for kind in np.flatnonzero(np.bincount(kinds)):
        n = int(NODE_COUNTS[kind])
        members = np.flatnonzero(kinds == kind)
        width = BLOCK // n
        for first in range(0, len(members), width):
            at = members[first : first + width]
            target = ahead and ahead.at(at)
            values = quadrature(n, begin.at(at), eta[at], length[at], target, wanted, work)
            for name, value in zip(wanted, values, strict=True):
                results[name][at] = value
    return results
