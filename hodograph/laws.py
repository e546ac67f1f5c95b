"""The paper's laws and better ones, and the fits of given data (eq. 22, Table 1).

The coefficients of `d_norm_law`, `d_norm_law_all` and `alpha_max_law` are fitted to exact values
in `fit`, by the command ``hodograph fit``, which gives back the digits written here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from hodograph import domain
from hodograph.domain import FloatArray, Scalar

# Table 1, and the law of section 3.3 for v_lim = 42.7 m/s, as printed.
TABLE_1_K = (0.24207, 1.56854, -1.16548, 0.26454)
TABLE_1_M = (0.675688, 0.046397, 0.031539)
ALPHA_MAX_H, ALPHA_MAX_K, ALPHA_MAX_M = np.pi / 4, 0.0085864, 0.1366571

# The library's own: M of d_norm_law, a polynomial in alpha0 and what v_norm multiplies ...
LAW_M = (0.65326, 0.00779, 0.09792, -0.1493, 0.16266, -0.05561)
LAW_V = (0.01186, 0.01082)
# ... the four numbers of d_norm_law_all, and the five of alpha_max_law.
LAW_ALL = (7.781, 4.179, 0.135, 0.436)
LAW_ANGLE = (0.20835, 0.78897, 0.09592, 0.11477, 0.7575)

BLOCK = 4096  # elements worked on at once: what fits the cache
FLAT = 1e-4  # below this sine, c1 / sin(alpha0) is its limit 4/3, to 1e-8
HUGE = 1e75  # the square of its square is a double


class PearsonFit(NamedTuple):
    """K, M of eq. 22 and the residuals, fitted minus given, of the data's shape."""

    K: float
    M: float
    residuals: FloatArray


class PolynomialFit(NamedTuple):
    """Coefficients a_0, a_1, ... and the residuals, fitted minus given."""

    coefficients: FloatArray
    residuals: FloatArray


@overload
def pearson_vii(x: Scalar, K: Scalar, M: Scalar, h: Scalar = 1.0) -> np.float64: ...
@overload
def pearson_vii(x: ArrayLike, K: ArrayLike, M: ArrayLike, h: ArrayLike = 1.0) -> FloatArray: ...
def pearson_vii(x: ArrayLike, K: ArrayLike, M: ArrayLike, h: ArrayLike = 1.0) -> Any:
    """Pearson VII function h (1 + K^2 x^2 / M)^(-M) (eq. 22).

    Parameters
    ----------
    x : array_like
        Argument, finite: v_norm, or v0 with K in s/m.
    K : array_like
        Inverse width, finite.
    M : array_like
        Shape, positive: 1 is a Lorentzian, and infinity, which is allowed, the Gaussian of
        annex A.
    h : array_like, optional
        Height at x = 0.

    Returns
    -------
    float or ndarray
        The value, of the broadcast shape.

    Examples
    --------
    >>> float(pearson_vii(1.0, 1.0, 1.0))
    0.5
    >>> round(float(pearson_vii(1.0, 1.0, float("inf"))), 6)  # exp(-1)
    0.367879
    """
    shape, (x_, K_, M_, h_) = domain.broadcast(
        x=(x, domain.FINITE),
        K=(K, domain.FINITE),
        M=(M, domain.POSITIVE_OR_INF),
        h=(h, domain.FINITE),
    )
    return domain.restore(_pearson(x_, K_, M_, h_), shape)


def _pearson(x: Any, K: Any, M: Any, h: Any = 1.0) -> Any:
    with np.errstate(over="ignore"):
        square = np.square(K * x)
    gaussian = np.isinf(M)
    finite = np.where(gaussian, 1.0, M)
    exponent = np.where(gaussian, square, finite * np.log1p(square / finite))
    return h * np.exp(-exponent)


@overload
def table_1(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def table_1(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
def table_1(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """d_norm by the paper's law: eq. 22 with K and M from Table 1, as printed.

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, finite and >= 0; the paper fits up to 1.5.
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        The law's d_norm, of the broadcast shape.  Against the exact value, for v_norm <= 1.5,
        the relative error reaches 0.5 % between 10 and 80 degrees and 9 % at 1 degree: see the
        verdict on the paper.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(table_1(1.0, np.pi / 4)), 4)
    0.588
    """
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    K, M = Polynomial(TABLE_1_K)(a0), Polynomial(TABLE_1_M)(a0)
    return domain.restore(_pearson(v, K, M), shape)


@overload
def alpha_max_vial(v0: Scalar) -> np.float64: ...
@overload
def alpha_max_vial(v0: ArrayLike) -> FloatArray: ...
def alpha_max_vial(v0: ArrayLike) -> Any:
    """Angle of greatest range by the paper's law, for v_lim = 42.7 m/s (section 3.3).

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, finite and >= 0; the paper's figure 6 shows the range of the fit.

    Returns
    -------
    float or ndarray
        The angle in radians.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(np.rad2deg(alpha_max_vial(42.7))), 2)
    40.98
    """
    shape, (v,) = domain.broadcast(v0=(v0, domain.NON_NEGATIVE))
    return domain.restore(_pearson(v, ALPHA_MAX_K, ALPHA_MAX_M, ALPHA_MAX_H), shape)


@overload
def first_order(alpha0: Scalar) -> np.float64: ...
@overload
def first_order(alpha0: ArrayLike) -> FloatArray: ...
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
    shape, (a0,) = domain.broadcast(alpha0=(alpha0, domain.LEVEL_ANGLE))
    sine = np.sin(a0)
    return domain.restore(np.asarray(sine * _steepness(sine)), shape)


def _steepness(sine: FloatArray) -> FloatArray:
    """c1 / sin(alpha0), from 4/3 at 0 to 3/4 at 90 degrees."""
    S = np.maximum(sine, FLAT)
    gap = 1 - S
    square = gap * (1 + S)  # cos(alpha0)^2
    inverse = 1 / S
    ratio = square * inverse * inverse * 0.125
    artanh = 0.5 * np.log1p(2 * S / np.maximum(gap, 1e-17))
    return np.asarray(0.75 + ratio + artanh * inverse * square * (0.5 - ratio))


@overload
def d_norm_law(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_law(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
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
    v_norm : array_like
        Launch speed over terminal speed, finite and >= 0; meant for v_norm <= 1.5.
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        The law's d_norm, of the broadcast shape.  The relative error is at most 7.7e-5 for
        v_norm <= 1.5 at every angle.  Beyond, it grows: 0.14 % at 2 and
        1.3 % at 3.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(d_norm_law(1.0, np.pi / 4)), 4)  # exactly 0.58901
    0.589
    """
    return _by_blocks(v_norm, alpha0, _law)


def _law(v: FloatArray, a0: FloatArray) -> FloatArray:
    S = np.sin(a0)
    double = S * np.sqrt(1 - S * S)  # sin(2 alpha0) / 2
    M = _horner(LAW_M, a0)
    M += v * (LAW_V[0] + 2 * LAW_V[1] * double)
    y = _steepness(S)
    y *= S
    y *= v * v
    y /= M
    np.log1p(y, out=y)
    y *= M
    return np.exp(np.negative(y, out=y), out=y)


def _horner(coefficients: tuple[float, ...], x: FloatArray) -> FloatArray:
    """The polynomial, in place: `numpy.polynomial` takes twice as long."""
    value = np.full_like(x, coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        value *= x
        value += coefficient
    return value


@overload
def d_norm_law_all(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm_law_all(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
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
        Launch speed over terminal speed, finite and >= 0.
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
    return _by_blocks(v_norm, alpha0, _law_all)


def _law_all(v: FloatArray, a0: FloatArray) -> FloatArray:
    size, power, rate, growth = LAW_ALL
    S = np.sin(a0)
    T = _steepness(S)
    root = v * np.sqrt(S)
    S = np.maximum(S, 1e-300)
    G = size * T**-power
    square = np.minimum(root, HUGE) ** 2
    bracket = np.log1p((2 - T) * square * (1 + growth * square) / (rate * G))
    h = 1 - G / S * np.expm1(-rate * S * bracket)
    slow, beyond = _split(root)
    x = 4 * slow * slow
    moving = x > 0
    x, root = np.where(moving, x, 1.0), np.where(moving, root, 1.0)
    law = (np.log1p(x * h) + beyond) / x * (slow / root) ** 2
    return np.asarray(np.where(moving, law, 1.0) + 0 * (v + a0))  # NaN where either is


@overload
def alpha_max_law(v_norm: Scalar) -> np.float64: ...
@overload
def alpha_max_law(v_norm: ArrayLike) -> FloatArray: ...
def alpha_max_law(v_norm: ArrayLike) -> Any:
    """Launch angle of greatest range on level ground, by five fitted numbers.

    ::

        alpha_max = (pi/4) [1 + 0.20835 ln(1 + 0.78897 v^2) + 0.09592 ln(1 + 0.11477 v^2)]^-0.7575

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, finite and >= 0.

    Returns
    -------
    float or ndarray
        The angle in radians, of the shape of `v_norm`: pi/4 at rest, and falling from there.  The
        relative error is at most 9.7e-5 for v_norm <= 10, 0.3 % to 1e3,
        0.5 % to 1e6 and 0.9 % to 1e10.

    Examples
    --------
    >>> import numpy as np
    >>> np.rad2deg(alpha_max_law([0.0, 1.0, 10.0])).round(2)  # exactly 45, 40.978, 25.154
    array([45.  , 40.98, 25.16])
    """
    shape, (v,) = domain.broadcast(v_norm=(v_norm, domain.NON_NEGATIVE))
    near, near_rate, far, far_rate, power = LAW_ANGLE
    slow, beyond = _split(v)
    square = slow * slow
    bracket = 1 + near * (np.log1p(near_rate * square) + beyond)
    bracket += far * (np.log1p(far_rate * square) + beyond)
    return domain.restore(np.asarray(np.pi / 4 * bracket**-power), shape)


def _split(v: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A speed whose square is a double, and what is missing then from ln(v^2)."""
    slow = np.minimum(v, HUGE * HUGE)
    return slow, 2 * np.log(np.maximum(v, HUGE * HUGE) / (HUGE * HUGE))


def _by_blocks(
    v_norm: ArrayLike, alpha0: ArrayLike, law: Callable[[FloatArray, FloatArray], FloatArray]
) -> Any:
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    if v.size <= BLOCK:
        with np.errstate(over="ignore"):
            return domain.restore(np.asarray(law(v, a0)), shape)
    speeds, angles = v.reshape(-1), a0.reshape(-1)
    result = np.empty(v.size)
    with np.errstate(over="ignore"):
        for first in range(0, v.size, BLOCK):
            block = slice(first, first + BLOCK)
            result[block] = law(speeds[block], angles[block])
    return domain.restore(result, shape)


def fit_pearson(
    x: ArrayLike, y: ArrayLike, *, h: float = 1.0, relative: bool = False
) -> PearsonFit:
    """Least-squares K and M of eq. 22 for given data, h held fixed.

    Parameters
    ----------
    x, y : array_like
        Data of one shape, at least 2 points: v_norm and d_norm at one angle, or v0 and
        alpha_max.
    h : float, optional
        Height at x = 0, positive.
    relative : bool, optional
        Weigh each residual by 1/y; y must then be positive.

    Returns
    -------
    PearsonFit
        K >= 0, M > 0, and the residuals fitted - given.

    Raises
    ------
    RuntimeError
        The optimiser did not converge.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.linspace(0, 1.5, 20)
    >>> fit = fit_pearson(x, pearson_vii(x, 0.9, 0.7))
    >>> round(fit.K, 9), round(fit.M, 9)
    (0.9, 0.7)
    """
    x_, y_ = _data(x, y, 2)
    h = domain.option("h", h, domain.POSITIVE)
    if not x_.any():
        raise ValueError("x must not be 0 everywhere: the law is h there whatever K and M")
    if relative:
        domain.check("y", y_, domain.POSITIVE)
    weight = 1 / y_ if relative else np.ones_like(y_)
    size = float(np.max(np.abs(x_))) or 1.0

    from scipy.optimize import least_squares  # slow to import, and only fits need it

    def residuals(logs: FloatArray) -> FloatArray:
        K, M = np.exp(logs)
        return np.asarray((_pearson(x_ / size, K, M, h) - y_) * weight)

    found = least_squares(residuals, (0.0, 0.0), xtol=1e-15, ftol=1e-15, gtol=1e-15, x_scale="jac")
    if not found.success:
        raise RuntimeError(f"the Pearson VII fit did not converge: {found.message}")
    K, M = np.exp(found.x)
    return PearsonFit(float(K / size), float(M), np.asarray(_pearson(x_ / size, K, M, h) - y_))


def fit_polynomial(x: ArrayLike, y: ArrayLike, degree: int) -> PolynomialFit:
    """Least-squares polynomial of given degree, in powers of x: K and M against alpha0.

    Parameters
    ----------
    x, y : array_like
        Data of one shape, more points than `degree`.
    degree : int
        Degree, >= 0: the paper takes 3 for K and 2 for M.

    Returns
    -------
    PolynomialFit
        Coefficients from a_0 up, and the residuals fitted - given.

    Examples
    --------
    >>> fit_polynomial([0, 1, 2, 3], [1, 2, 5, 10], 2).coefficients.round(12)
    array([1., 0., 1.])
    """
    degree = domain.count("degree", degree, 0)
    x_, y_ = _data(x, y, degree + 1)
    if (places := np.unique(x_).size) <= degree:
        raise ValueError(f"x must hold more than {degree} different values; got {places}")
    fitted = Polynomial.fit(x_, y_, degree)
    return PolynomialFit(np.asarray(fitted.convert().coef, np.float64), fitted(x_) - y_)


def _data(x: ArrayLike, y: ArrayLike, least: int) -> tuple[FloatArray, FloatArray]:
    domain.one_index(x=x, y=y)
    x_, y_ = domain.as_float("x", x), domain.as_float("y", y)
    for name, array in (("x", x_), ("y", y_)):
        domain.check(name, array, domain.FINITE)
        if np.isnan(array).any():
            raise ValueError(f"{name} must not hold NaN")
    if x_.shape != y_.shape or x_.ndim != 1 or x_.size < least:
        raise ValueError(
            f"x and y must be 1-D, of one length, at least {least}; got {x_.shape} and {y_.shape}"
        )
    return x_, y_
