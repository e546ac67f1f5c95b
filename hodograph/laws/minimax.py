"""The best approximation: coefficients that make the largest error of a formula least."""

from collections.abc import Callable

import numpy as np
from scipy.optimize import linprog

from hodograph.engine.domain import FloatArray

ErrorOf = Callable[[FloatArray], FloatArray]


def minimax(error: ErrorOf, start: FloatArray, *, steps: int = 80) -> tuple[FloatArray, float]:
    """Coefficients that make the largest absolute error least, near `start`, and that error.

    `error` takes coefficients to errors, at more points than there are coefficients; none of
    `start` is 0; `steps` linear programs are solved at most.

    Examples
    --------
    >>> x = np.linspace(0, 1, 101)
    >>> line, worst = minimax(lambda c: c[0] + c[1] * x - x * x, np.array([1.0, 1.0]))
    >>> print(line.round(9), round(worst, 9))  # Chebyshev: x - 1/8
    [-0.125  1.   ] 0.125
    """
    at = np.array(start, np.float64)
    size = np.abs(at) + 1e-3
    here = error(at)
    worst, limit = float(np.max(np.abs(here))), 0.3
    for _ in range(steps if worst > 0 else 0):
        slopes = np.empty((here.size, at.size))
        for j, h in enumerate(1e-6 * size):
            shift = np.zeros_like(at)
            shift[j] = h
            slopes[:, j] = (error(at + shift) - error(at - shift)) / (2 * h) * size[j]
        # least t with |here + slopes x| <= t, in units of `worst` so that HiGHS sees order one
        rows, column = slopes / worst, np.ones((here.size, 1))
        found = linprog(
            np.r_[np.zeros(at.size), 1.0],
            A_ub=np.block([[rows, -column], [-rows, -column]]),
            b_ub=np.r_[-here, here] / worst,
            bounds=[(-limit, limit)] * at.size + [(0, None)],
        )
        if not found.success:
            break
        trial = at + found.x[:-1] * size
        there = error(trial)
        new = float(np.max(np.abs(there)))
        if new < worst:
            gain = 1 - new / worst
            at, here, worst = trial, there, new
            if gain < 1e-9:
                break
            limit = min(2 * limit, 1.0)
        else:
            limit /= 4
            if limit < 1e-9:
                break
    return at, worst
