"""Formulas by others for d_norm, and the limits that any law must keep.

They are here to be compared with the laws of `laws`; `builders.formula_comparison` measures them.
"""

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, labels
from hodograph.engine.domain import FloatArray, Scalar
from hodograph.laws.own import first_order

GENTLE = 1e-3  # v^2 sin(2 alpha0) below which `d_norm_low` takes its series
FIERCE = 1e300  # and above which its logarithm, since e^X nears the largest double


@overload
def d_norm_chudinov(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_chudinov(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
@labels.kept("range over the range without drag", "1")
def d_norm_chudinov(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """d_norm by Chudinov's range L = V_a T: no fitted number.

    With T = 2 sqrt(2 H / g), H = v0^2 S^2 / (g (2 + v^2 S)) the height of the apex, and V_a the
    exact speed there::

        d_norm = [(1 + v^2 (S + C^2 artanh S)) (1 + v^2 S / 2)]^(-1/2),    v = v_norm,

    S and C being the sine and the cosine of alpha0.

    Parameters
    ----------
    v_norm, alpha0 : array_like
        As for `table_1`.

    Returns
    -------
    float or ndarray
        The formula's d_norm; within 5.5 % for v_norm <= 1.5.

    References
    ----------
    P. Chudinov, "Approximate analytical description of the projectile motion with a quadratic
    drag force", Athens Journal of Sciences 1(2), 97-106 (2014), table 1.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(d_norm_chudinov(1.0, np.pi / 4)), 4)  # exactly 0.5890
    0.5865
    """
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    S = np.sin(a0)
    artanh = np.arctanh(np.minimum(S, 1 - 2**-53))
    with np.errstate(over="ignore"):
        across = np.sqrt(1 + v * (S + (1 - S) * (1 + S) * artanh) * v)
        return domain.restore(1 / across / np.sqrt(1 + v * (S / 2) * v), shape)


@overload
def d_norm_low(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_low(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
@labels.kept("range over the range without drag", "1")
def d_norm_low(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """d_norm of a low launch, for which the speed is its horizontal part: Lambert's W.

    With z = v^2 sin(2 alpha0), the range x satisfies (e^X - 1) / X = 1 + z, X = 2 x / (v_lim^2/g)::

        d_norm = X / (2 z),    X = -b - W_-1(-b e^-b),    b = 1 / (1 + z).

    Parameters
    ----------
    v_norm, alpha0 : array_like
        As for `table_1`.

    Returns
    -------
    float or ndarray
        The formula's d_norm, exact as alpha0 tends to 0 for any v_norm^2 alpha0.

    References
    ----------
    G. W. Parker, "Projectile motion with air resistance quadratic in the speed", Am. J. Phys.
    45(7), 606-610 (1977), for the approximation; in Lambert's W, e.g. S. M. Stewart, Eur. J.
    Phys. 35, 055025 (2014).

    Examples
    --------
    >>> round(float(d_norm_low(10.0, 0.01)), 4)  # exactly 0.47596
    0.476
    """
    from scipy.special import lambertw  # slow to import, and only this needs it

    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    part = 2 * np.sin(a0) * np.cos(a0) * v
    with np.errstate(over="ignore"):
        z = part * v
    near = z < GENTLE  # SciPy's W_-1 stops at its branch point, z = 0
    part, speed = np.where(near, 0.5, part), np.where(near, 1.0, v)
    b = 1 / (1 + np.where(near, 1.0, np.minimum(z, FIERCE)))
    least = X = -b - lambertw(-b * np.exp(-b), -1).real
    beyond = np.where(z > FIERCE, np.log(part) + np.log(speed) - np.log(FIERCE), 0.0)
    for _ in range(4):  # X - ln X = ln z, where z is that large
        X = least + beyond + np.log(X / least)
    far = X / (2 * part) / speed
    small = np.minimum(z, GENTLE)
    return domain.restore(np.where(near, 1 - small * (2 / 3 - small * (5 / 9)), far), shape)


@overload
def d_norm_upright(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_upright(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
@labels.kept("range over the range without drag", "1")
def d_norm_upright(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """d_norm of a vertical launch, taken for every angle: (asinh v + atan v) / (2 v sqrt(1+v^2)).

    Parameters
    ----------
    v_norm, alpha0 : array_like
        As for `table_1`; alpha0 gives the shape only.

    Returns
    -------
    float or ndarray
        The limit of d_norm at 90 degrees.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(d_norm_upright(1.0, np.pi / 2)), 6)
    0.589293
    """
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    moving = np.where(v > 1e-8, v, 1.0)
    value = (np.arcsinh(moving) + np.arctan(moving)) / (2 * moving) / np.hypot(1, moving)
    return domain.restore(np.where(v > 1e-8, value, 1.0) + 0 * (v + a0), shape)


@overload
def d_norm_first_order(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_first_order(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
@labels.kept("range over the range without drag", "1")
def d_norm_first_order(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """d_norm to first order in v_norm^2, 1 - c1 v_norm^2; negative for strong drag.

    Parameters
    ----------
    v_norm, alpha0 : array_like
        As for `table_1`.

    Returns
    -------
    float or ndarray
        The expansion.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(d_norm_first_order(0.1, np.pi / 4)), 5)  # exactly 0.99224
    0.99216
    """
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    with np.errstate(over="ignore"):
        return domain.restore(np.asarray(1 - first_order(a0) * v * v), shape)
