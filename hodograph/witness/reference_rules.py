"""Gauss-Legendre quadrature of any order on [0, 2], for the panels of the reference."""

import functools
from dataclasses import dataclass

import mpmath

from hodograph.witness.reference_numbers import ctx

HALF_STRETCH = 2  # half the panels in the drag layer, in the logarithm of the distance


@dataclass(frozen=True)
class Rule:
    """Nodes and weights, and expm1 at the nodes of a panel evenly cut in the logarithm."""

    nodes: list[mpmath.mpf]
    weights: list[mpmath.mpf]
    stretch: list[mpmath.mpf]


@functools.lru_cache(maxsize=64)
def gauss_legendre(n: int, digits: int) -> Rule:
    """Find the nodes by Newton on the three-term recurrence."""
    nodes, weights = [], []
    with ctx.workdps(digits + 10):
        for i in range(n):
            z = -ctx.cos(ctx.pi * (4 * i + 3) / (4 * n + 2))
            step = ctx.mpf(1)
            while abs(step) > ctx.mpf(10) ** (-digits // 2 - 2):
                p, slope = _legendre(n, z)
                step = p / slope
                z -= step
            slope = _legendre(n, z)[1]
            nodes.append(1 + z)
            weights.append(2 / ((1 - z * z) * slope**2))
        stretch = [ctx.expm1(HALF_STRETCH * z) for z in nodes]
    return Rule(nodes, weights, stretch)


@functools.lru_cache(maxsize=64)
def integration_matrix(n: int, digits: int) -> list[list[mpmath.mpf]]:
    """Row i integrates the polynomial through the nodes from 0 to node i.

    Expanded in Legendre polynomials, (2k + 1) P_k has the integral P_k+1 − P_k−1 (P_−1 = −1).
    """
    rule = gauss_legendre(n, digits)
    with ctx.workdps(digits + 10):
        table = [_legendres(n, z - 1) for z in rule.nodes]
        values = [row[1:-1] for row in table]
        integrals = [[c - a for a, c in zip(row, row[2:], strict=False)] for row in table]
        return [
            [w / 2 * ctx.fdot(row, at) for w, at in zip(rule.weights, values, strict=True)]
            for row in integrals
        ]


def _legendres(n: int, z: mpmath.mpf) -> list[mpmath.mpf]:
    """P_−1 (taken for −1), P_0, ... P_n."""
    p = [ctx.mpf(-1), ctx.mpf(1), z]
    for k in range(2, n + 1):
        p.append(((2 * k - 1) * z * p[-1] - (k - 1) * p[-2]) / k)
    return p


def _legendre(n: int, z: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
    """P_n and its derivative."""
    *_, q, p = _legendres(n, z)
    return p, n * (q - z * p) / (1 - z * z)
