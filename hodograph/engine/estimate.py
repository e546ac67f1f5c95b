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
    "linear": lambda z: (1 + 0 * z, 0 * z),
    "soft_l1": lambda z: ((1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5),
    "huber": lambda z: (
        np.maximum(z, 1.0) ** -0.5,
        np.where(z > 1, -0.5 * np.maximum(z, 1.0) ** -1.5, 0.0),
    ),
    "cauchy": lambda z: (1 / (1 + z), -((1 + z) ** -2.0)),
    "arctan": lambda z: (1 / (1 + z * z), -2 * z / (1 + z * z) ** 2),
}
LOSSES = tuple(_LOSSES)


def widening(level: float, dof: int, *, known: bool) -> float:
    """Half the width of an interval of this level, in standard deviations."""
    part = (1 + level) / 2
    return float(ndtri(part) if known else stdtrit(dof, part))


def covariance(
    found: Fit, noise: float, loss: str = "linear", scale: float = 1.0
) -> tuple[FloatArray, int | None]:
    """The covariance of the free parameters, and the number of one that is not determined.

    For a robust loss it is that of an M-estimate: A^-1 B A^-1, with A = J' psi' J, B = J' psi^2 J.
    """
    J = found.jacobian[:, found.free]
    size = np.sqrt(np.sum(J * J, axis=0))
    if not found.free.size:
        return np.zeros((0, 0)), None
    if (size == 0).any():
        return np.zeros((found.free.size,) * 2), int(np.argmin(size))
    _, singular, V = np.linalg.svd(J / size, full_matrices=False)
    if len(singular) < found.free.size or singular[-1] < DEPENDENT * singular[0]:
        return np.zeros((found.free.size,) * 2), int(np.argmax(np.abs(V[-1])))
    if loss == "linear":
        root = V.T / singular * noise
        return root @ root.T / np.outer(size, size), None
    first, second = _LOSSES[loss]((found.residuals / scale) ** 2)
    J = J / size
    bread = np.linalg.inv(
        J.T @ (J * (first + 2 * (found.residuals / scale) ** 2 * second)[:, None])
    )
    filling = J.T @ (J * ((found.residuals * first) ** 2)[:, None])
    spare = len(J) / max(len(J) - found.free.size, 1)
    return spare * bread @ filling @ bread / np.outer(size, size), None


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
    """The values of a parameter at which chi^2, least in all others, has grown by `width`^2.

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
