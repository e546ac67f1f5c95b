"""What a fit says of its parameters: covariance, the width of an interval, what was not fitted.

The noise is known, or is found from what the residuals leave over; then Student's t widens an
interval, so that it holds the truth as often.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ndtri, stdtrit

from hodograph.engine import fit
from hodograph.engine.domain import FloatArray
from hodograph.engine.film import NAMES, Film
from hodograph.engine.fit import Fit

ONE_SIGMA = math.erf(math.sqrt(0.5))  # 68.27 %
DEPENDENT = 1e-7  # relative singular value at which parameters cannot be told apart
GRAVITY = len(NAMES)  # the column of g in a jacobian
WIDEST = 60  # uncertainties that an interval is looked for

# rho' and rho'' of each loss at z = (residual / scale)^2
_LOSSES: dict[str, Callable[[FloatArray], tuple[FloatArray, FloatArray]]] = {
    "soft_l1": lambda z: ((1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5),
    "huber": lambda z: (
        np.maximum(z, 1.0) ** -0.5,
        np.where(z > 1, -0.5 * np.maximum(z, 1.0) ** -1.5, 0.0),
    ),
    "cauchy": lambda z: (1 / (1 + z), -((1 + z) ** -2.0)),
    "arctan": lambda z: (1 / (1 + z * z), -2 * z / (1 + z * z) ** 2),
}
LOSSES = ("linear", *_LOSSES)


def widening(level: float, dof: int, *, known: bool) -> float:
    """Half the width of an interval of this level, in standard deviations."""
    part = (1 + level) / 2
    return float(ndtri(part) if known else stdtrit(dof, part))


def covariance(found: Fit, noise: float) -> tuple[FloatArray, int | None]:
    """The covariance of the free parameters, and the number of one that is not determined."""
    J = found.jacobian[:, found.free]
    size = np.sqrt(np.sum(J * J, axis=0))
    none = np.zeros((found.free.size,) * 2)
    if not found.free.size:
        return none, None
    if (size == 0).any():
        return none, int(np.argmin(size))
    _, singular, V = np.linalg.svd(J / size, full_matrices=False)
    if len(singular) < found.free.size or singular[-1] < DEPENDENT * singular[0]:
        return none, int(np.argmax(np.abs(V[-1])))
    root = V.T / singular * noise
    return root @ root.T / np.outer(size, size), None


def robust_noise(found: Fit, loss: str, scale: float) -> float:
    """What stands for the noise in the covariance of an M-estimate (Huber 1973).

    With psi = r rho'(z), its derivative psi' = rho' + 2 z rho'', and p parameters of N residuals:
    sqrt(sum psi^2 / (N - p)) / mean psi', times 1 + (p / N) var psi' / (mean psi')^2.
    """
    z = (found.residuals / scale) ** 2
    first, second = _LOSSES[loss](z)
    slope, pull = first + 2 * z * second, found.residuals * first
    spare = max(z.size - found.free.size, 1)
    mean = max(float(np.mean(slope)), 1e-3)
    wider = 1 + found.free.size / z.size * float(np.var(slope)) / mean**2
    return wider * math.sqrt(float(np.sum(pull**2)) / spare) / mean


def gravity(found: Fit, g: float, noise: float) -> tuple[float, float]:
    """g if it were free as well, to first order, and its standard deviation."""
    J = found.jacobian[:, [*found.free, GRAVITY]]
    size = np.sqrt(np.sum(J * J, axis=0))
    step, _, rank, _ = np.linalg.lstsq(J / size, -found.residuals, rcond=DEPENDENT)
    if rank < J.shape[1]:
        return g, math.inf
    inverse = np.linalg.inv((J / size).T @ (J / size))
    return g + float(step[-1] / size[-1]), noise * math.sqrt(inverse[-1, -1]) / float(size[-1])


def interval(
    film: Film,
    found: Fit,
    name: int,
    width: float,
    half: float,
    bounds: tuple[FloatArray, FloatArray],
) -> tuple[float, float]:
    """The values of a parameter at which chi^2, least in all others, has grown by width squared.

    `half` is where it has about half of that width; a bound ends the interval.
    """
    least = float(np.sum(found.residuals**2))
    others: NDArray[np.intp] = found.free[found.free != name]
    best = float(found.values[name])
    start = found.values.copy()

    def growth(value: float) -> float:
        start[name] = value
        there = fit.solve(film, start, others, bounds)
        start[others] = there.values[others]
        return math.sqrt(max(float(np.sum(there.residuals**2)) - least, 0.0)) - width

    ends = []
    for side, bound in ((-1, float(bounds[0][name])), (1, float(bounds[1][name]))):
        start[:] = found.values
        inner, step = best, half
        for _ in range(WIDEST):
            outer = best + side * step
            outer = max(outer, bound) if side < 0 else min(outer, bound)
            if growth(outer) >= 0:
                ends.append(float(brentq(growth, inner, outer, xtol=1e-4 * half, rtol=1e-8)))
                break
            if outer == bound:
                ends.append(bound)
                break
            inner, step = outer, 1.4 * step + half
        else:
            ends.append(side * math.inf)
    return ends[0], ends[1]
