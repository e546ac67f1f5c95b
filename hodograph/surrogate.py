"""d_norm and the landing angle by interpolation, for v_norm <= 10 and n = 2.

The coordinates and the tables are in `tiers.interpolant`.
"""

from collections.abc import Callable
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain
from hodograph.engine.domain import FloatArray, Rule, Scalar
from hodograph.engine.functions import PLAIN
from hodograph.laws.formula import evaluate
from hodograph.tiers import interpolant
from hodograph.tiers.interpolant import V_MAX

SPEED = Rule(f"in [0, {V_MAX:g}] for the surrogate", lambda a: (a >= 0) & (a <= V_MAX))


@overload
def d_norm(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
def d_norm(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """Normalised distance by interpolation, to 1e-9 relative.

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, in [0, 10].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        d_norm, of the broadcast shape; exactly 1 at v_norm = 0 and at alpha0 = 0.

    Raises
    ------
    ValueError
        An element lies outside its range: the surrogate does not extrapolate.

    Examples
    --------
    >>> import numpy as np
    >>> d_norm([0.0, 0.5, 1.5], np.pi / 4).round(8)
    array([1.        , 0.84122206, 0.40853701])
    """
    return _checked(v_norm, alpha0, interpolant.flat_d_norm, interpolant.d_norm_alone)


@overload
def landing_angle(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def landing_angle(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
def landing_angle(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """Slope angle at the landing on level ground by interpolation, to 1e-9 relative.

    Parameters
    ----------
    v_norm, alpha0 : array_like
        As for `d_norm`, and refused as there.

    Returns
    -------
    float or ndarray
        alpha_s in radians, of the broadcast shape; exactly -alpha0 at v_norm = 0.

    Examples
    --------
    >>> import numpy as np
    >>> np.rad2deg(landing_angle([0.0, 1.0, 10.0], np.pi / 4)).round(6)
    array([-45.      , -57.273022, -83.234071])
    """
    kernel, alone = interpolant.flat_landing_angle, interpolant.landing_angle_alone
    return _checked(v_norm, alpha0, kernel, alone)


def _checked(
    v_norm: Any,
    alpha0: Any,
    kernel: Callable[[FloatArray, FloatArray], FloatArray],
    alone: Callable[[float, float], float],
) -> Any:
    return evaluate(
        lambda v, a0, f: alone(v, a0) if f is PLAIN else kernel(v, a0),
        v_norm=(v_norm, SPEED),
        alpha0=(alpha0, domain.LEVEL_ANGLE),
    )
