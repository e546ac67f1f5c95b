"""Drag from what a body is."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain
from hodograph.engine.domain import LEAST, MOST, FloatArray, Rule, Scalar

MASS = Rule("in [1e-30, 1e30] kg", lambda a: (a >= LEAST) & (a <= MOST))
AMOUNT = Rule("0 or in [1e-30, 1e30]", lambda a: (a == 0) | ((a >= LEAST) & (a <= MOST)))


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


@overload
def drag_constant(
    mass: Scalar,
    cd: Scalar,
    *,
    diameter: Scalar | None = None,
    area: Scalar | None = None,
    rho: Scalar = 1.225,
) -> np.float64: ...
@overload
def drag_constant(
    mass: ArrayLike,
    cd: ArrayLike,
    *,
    diameter: ArrayLike | None = None,
    area: ArrayLike | None = None,
    rho: ArrayLike = 1.225,
) -> FloatArray: ...
def drag_constant(
    mass: ArrayLike,
    cd: ArrayLike,
    *,
    diameter: ArrayLike | None = None,
    area: ArrayLike | None = None,
    rho: ArrayLike = 1.225,
) -> Any:
    """Drag coefficient over mass, k = lambda/m = rho cd area / (2 mass), of quadratic drag.

    Parameters
    ----------
    mass : array_like
        In kg, in [1e-30, 1e30].
    cd : array_like
        The drag coefficient, without dimension; 0 is vacuum.
    diameter, area : array_like
        Exactly one of the two: the diameter in m of a round cross-section, or the area in m^2
        that `cd` refers to.
    rho : array_like, optional
        Density of the air in kg/m^3 (see `air_density`); 1.225 is that at sea level in the
        standard atmosphere.

    Returns
    -------
    float or ndarray
        k in 1/m, of the broadcast shape, as `hodograph.Launch.from_drag` and `terminal_speed`
        take it.

    Raises
    ------
    ValueError
        An element is neither 0 (`mass` must not be) nor in [1e-30, 1e30], or the shapes do not
        broadcast.
    TypeError
        An argument is not made of real numbers, or not exactly one of `diameter` and `area` is
        given.

    Examples
    --------
    >>> float(drag_constant(0.145, 0.35, diameter=0.074).round(6))  # kg, m: a baseball
    0.006359
    """
    if (diameter is None) == (area is None):
        given = "neither" if area is None else "both"
        raise TypeError(f"give exactly one of diameter (m) and area (m^2); got {given}")
    size = {"diameter": (diameter, AMOUNT)} if area is None else {"area": (area, AMOUNT)}
    shape, (mass_, cd_, size_, rho_) = domain.broadcast(
        mass=(mass, MASS), cd=(cd, AMOUNT), **size, rho=(rho, AMOUNT)
    )
    section = np.pi / 4 * size_**2 if area is None else size_
    return domain.restore(rho_ * cd_ * section / (2 * mass_), shape)
