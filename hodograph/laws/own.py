"""Laws of this library, nearer than the paper's: d_norm, and the angle of greatest range.

Their coefficients are fitted to exact values in `builders.law_fits`, by the command
``hodograph fit``, which gives back the digits written here.
"""

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, labels
from hodograph.engine.domain import FloatArray, Scalar
from hodograph.engine.functions import ARRAYS, PLAIN, Functions, horner
from hodograph.laws.formula import evaluate

# The library's own: M of d_norm_law, a polynomial in alpha0 and what v_norm multiplies ...
LAW_M = (0.65326, 0.00779, 0.09792, -0.1493, 0.16266, -0.05561)
LAW_V = (0.01186, 0.01082)
# ... the four numbers of d_norm_law_all, and the five of alpha_max_law.
LAW_ALL = (7.781, 4.179, 0.135, 0.436)
LAW_ANGLE = (0.20835, 0.78897, 0.09592, 0.11477, 0.7575)

LEAST = 1e-300  # what is put for 0 under a fraction
FLAT = 1e-4  # below this sine, c1 / sin(alpha0) is its limit 4/3, to 1e-8


@overload
def first_order(alpha0: Scalar) -> np.float64: ...
@overload
def first_order(alpha0: ArrayLike) -> FloatArray: ...
@labels.kept("c1 of d_norm = 1 - c1 v_norm^2", "1")
def first_order(alpha0: ArrayLike) -> Any:
    """c1 of d_norm = 1 - c1 v_norm^2 + ...: what weak drag takes from the range.

    In closed form, with S = sin(alpha0) and C = cos(alpha0)::

        c1 = 3 S / 4 + C^2 / (8 S) + artanh(S) C^2 (1/2 - C^2 / (8 S^2)),

    from 4 alpha0 / 3 near the horizontal to 3/4 at the vertical, and largest, 0.8365, at 60
    degrees.

    Parameters
    ----------
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        c1, to about 1e-8 relative.

    Examples
    --------
    >>> import numpy as np
    >>> first_order([0.0, np.pi / 4, np.pi / 2]).round(6)
    array([0.      , 0.783976, 0.75    ])
    """
    return evaluate(_first_order, alpha0=(alpha0, domain.LEVEL_ANGLE))


def _first_order(a0: Any, f: Functions) -> Any:
    sine = f.sin(a0)
    return sine * _steepness(sine, f)


def _steepness(sine: Any, f: Functions) -> Any:
    """c1 / sin(alpha0), from 4/3 at 0 to 3/4 at 90 degrees."""
    S = f.maximum(sine, FLAT)
    gap = 1 - S
    square = gap * (1 + S)  # cos(alpha0)^2
    inverse = 1 / S
    ratio = square * inverse * inverse * 0.125
    artanh = 0.5 * f.log1p(2 * S / f.maximum(gap, 1e-17))
    return 0.75 + ratio + artanh * inverse * square * (0.5 - ratio)


@overload
def d_norm_law(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_law(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
@labels.kept("range over the range without drag", "1")
def d_norm_law(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """d_norm up to v_norm = 1.5 by eq. 22 with the exact c1 and a better M.

    ::

        d_norm = (1 + c1 v^2 / M)^(-M),    v = v_norm, a = alpha0 in radians,
        M = 0.65326 + 0.00779 a + 0.09792 a^2 - 0.1493 a^3 + 0.16266 a^4 - 0.05561 a^5
            + v (0.01186 + 0.01082 sin 2a)

    with c1(a) from `first_order`.  Eight fitted numbers; exact to first order in v^2, and at 0
    degrees.

    Parameters
    ----------
    v_norm, alpha0 : array_like
        As for `d_norm_law_all`; meant for v_norm <= 1.5.

    Returns
    -------
    float or ndarray
        The law's d_norm, of the broadcast shape, within 7.7e-5 relative for v_norm <= 1.5 at every
        angle.  Beyond, the error grows: 0.14 % at 2 and 1.3 % at 3.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(d_norm_law(1.0, np.pi / 4)), 4)  # exactly 0.58901
    0.589
    """
    arguments = {"v_norm": (v_norm, domain.V_NORM), "alpha0": (alpha0, domain.LEVEL_ANGLE)}
    return evaluate(flat_law, **arguments)


def flat_law(v: Any, a0: Any, f: Functions = ARRAYS) -> Any:
    """`d_norm_law` of flat arrays or of plain floats, nothing checked."""
    S = f.sin(a0)
    double = S * f.sqrt(1 - S * S)  # sin(2 alpha0) / 2
    M = horner(LAW_M, a0)
    M += v * (LAW_V[0] + 2 * LAW_V[1] * double)
    y = _steepness(S, f)
    y *= S
    y *= v * v
    y /= M
    return f.exp(-M * f.log1p(y))


@overload
def d_norm_law_all(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_law_all(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
@labels.kept("range over the range without drag", "1")
def d_norm_law_all(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """d_norm for every v_norm, from rest to the strongest drag, by four fitted numbers.

    ::

        d_norm = ln(1 + 4 v^2 S h) / (4 v^2 S),    v = v_norm, S = sin(alpha0),
        h = 1 + (G/S) (1 - [1 + (2 - T) v^2 S (1 + 0.436 v^2 S) / (0.135 G)]^(-0.135 S)),
        G = 7.781 / T^4.179,    T = c1 / S,

    with c1(alpha0) from `first_order`.  It is exact to first order in v^2, and for strong drag
    the range tends to (v_lim^2 / g) cos(alpha0) (ln v_norm + constant), as it must.

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, in [0, 1e20].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        The law's d_norm, of the broadcast shape.  The relative error is at most 0.85 % for every
        v_norm and every angle.

    Examples
    --------
    >>> import numpy as np
    >>> d_norm_law_all([0.0, 1.0, 1000.0], np.pi / 4)  # exactly 1, 0.58901, 5.945e-6
    array([1.00000000e+00, 5.89700714e-01, 5.96790180e-06])
    """
    arguments = {"v_norm": (v_norm, domain.V_NORM), "alpha0": (alpha0, domain.LEVEL_ANGLE)}
    return evaluate(flat_law_all, **arguments)


def flat_law_all(v: Any, a0: Any, f: Functions = ARRAYS) -> Any:
    """`d_norm_law_all` of flat arrays or of plain floats, nothing checked."""
    size, power, rate, growth = LAW_ALL
    S = f.sin(a0)
    T = _steepness(S, f)
    root = v * f.sqrt(S)
    S = f.maximum(S, LEAST)
    G = size * T**-power
    square = root * root
    bracket = f.log1p((2 - T) * square * (1 + growth * square) / (rate * G))
    h = 1 - G / S * f.expm1(-rate * S * bracket)
    x = f.maximum(4 * square, LEAST)  # at rest the law is h, which is 1
    return f.log1p(x * h) / x


@overload
def alpha_max_law(v_norm: Scalar) -> np.float64: ...
@overload
def alpha_max_law(v_norm: ArrayLike) -> FloatArray: ...
@labels.kept("launch angle of greatest range", "rad")
def alpha_max_law(v_norm: ArrayLike) -> Any:
    """Launch angle of greatest range on level ground, by five fitted numbers.

    ::

        alpha_max = (pi/4) [1 + 0.20835 ln(1 + 0.78897 v^2) + 0.09592 ln(1 + 0.11477 v^2)]^-0.7575

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, in [0, 1e20].

    Returns
    -------
    float or ndarray
        The angle in radians, of the shape of `v_norm`: pi/4 at rest, and falling from there;
        within 9.7e-5 relative for v_norm <= 10, 0.3 % to 1e3, 0.5 % to 1e6 and 0.9 % to 1e10.

    Examples
    --------
    >>> import numpy as np
    >>> np.rad2deg(alpha_max_law([0.0, 1.0, 10.0])).round(2)  # exactly 45, 40.978, 25.154
    array([45.  , 40.98, 25.16])
    """
    return evaluate(_alpha_max, v_norm=(v_norm, domain.V_NORM))


def _alpha_max(v: Any, f: Functions) -> Any:
    near, near_rate, far, far_rate, power = LAW_ANGLE
    square = v * v
    bracket = 1 + near * f.log1p(near_rate * square) + far * f.log1p(far_rate * square)
    return np.pi / 4 * bracket**-power


def alpha_max_flat(v: FloatArray) -> FloatArray:
    """`alpha_max_law` of a flat array, nothing checked."""
    return np.asarray(_alpha_max(v, ARRAYS))


def alpha_max_alone(v: float) -> float:
    """`alpha_max_law` of a plain float, nothing checked."""
    return float(_alpha_max(v, PLAIN))
