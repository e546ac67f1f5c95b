"""The paper's laws as printed, and the fits of given data by its forms (eq. 22, Table 1)."""

from math import isinf
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from hodograph.engine import domain, labels
from hodograph.engine.domain import FloatArray, Scalar
from hodograph.engine.functions import ARRAYS, Functions, horner
from hodograph.laws.formula import evaluate

V_MAX, V_LIM = 1.5, 42.7  # section 3.3: v_norm of the fits goes to 1.5; its baseball's v_lim, m/s
# Table 1, and the law of section 3.3 for v_lim = 42.7 m/s, as printed.
TABLE_1_K = (0.24207, 1.56854, -1.16548, 0.26454)
TABLE_1_M = (0.675688, 0.046397, 0.031539)
ALPHA_MAX_H, ALPHA_MAX_K, ALPHA_MAX_M = np.pi / 4, 0.0085864, 0.1366571


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
@labels.kept("Pearson VII", "1")
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
    return evaluate(
        _pearson,
        x=(x, domain.FINITE),
        K=(K, domain.FINITE),
        M=(M, domain.POSITIVE_OR_INF),
        h=(h, domain.FINITE),
    )


def _pearson(x: Any, K: Any, M: Any, h: Any = 1.0, f: Functions = ARRAYS) -> Any:
    if f is not ARRAYS:
        square = K * x * (K * x)
        return h * f.exp(-square if isinf(M) else -M * f.log1p(square / M))
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
@labels.kept("range over the range without drag", "1")
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
    return evaluate(
        lambda v, a0, f: _pearson(v, horner(TABLE_1_K, a0), horner(TABLE_1_M, a0), f=f),
        v_norm=(v_norm, domain.NON_NEGATIVE),
        alpha0=(alpha0, domain.LEVEL_ANGLE),
    )


@overload
def alpha_max_vial(v0: Scalar) -> np.float64: ...
@overload
def alpha_max_vial(v0: ArrayLike) -> FloatArray: ...
@labels.kept("launch angle of greatest range", "rad")
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
    return evaluate(
        lambda v, f: _pearson(v, ALPHA_MAX_K, ALPHA_MAX_M, ALPHA_MAX_H, f),
        v0=(v0, domain.NON_NEGATIVE),
    )


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
    labels.one_index(x=x, y=y)
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
