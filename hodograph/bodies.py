"""Drag from what a body is."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain
from hodograph.engine.domain import FloatArray, Scalar


@overload
def terminal_speed(k: Scalar, *, g: Scalar = 9.81) -> np.float64: ...
@overload
def terminal_speed(k: ArrayLike, *, g: ArrayLike = 9.81) -> FloatArray: ...
def terminal_speed(k: ArrayLike, *, g: ArrayLike = 9.81) -> Any:
    """Terminal speed of fall under quadratic drag (eq. 12).

    Parameters
    ----------
    k : array_like
        Drag coefficient over mass, lambda/m, in 1/m; ``k >= 0``, and 0 is vacuum.
    g : array_like, optional
        Gravity in m/s^2, positive.

    Returns
    -------
    float or ndarray
        v_lim = sqrt(g / k) in m/s; ``inf`` in vacuum.

    Examples
    --------
    >>> round(float(terminal_speed(0.005376)), 1)  # a baseball, section 3.3 of the paper
    42.7
    """
    shape, (k_, g_) = domain.broadcast(k=(k, domain.NON_NEGATIVE), g=(g, domain.GRAVITY))
    with np.errstate(divide="ignore"):
        return domain.restore(np.sqrt(g_) / np.sqrt(np.abs(k_)), shape)  # abs: of -0.0
