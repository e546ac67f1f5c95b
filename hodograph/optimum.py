"""The launch angle of greatest range on level ground (section 3.3): where dR/dalpha0 = 0."""

from __future__ import annotations

import warnings
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph import domain, powerlaw
from hodograph.derivatives import derivatives
from hodograph.domain import FloatArray, Scalar
from hodograph.flight import blocks, fly
from hodograph.position import gauss_legendre
from hodograph.velocity import expm1_ratio, log1p_ratio

BRACKET = (0.001, 1.2)  # holds the angle for n >= 2 and every double


def _stationarity(alpha0: FloatArray, v: FloatArray, n: FloatArray) -> FloatArray:
    """Positive below the angle of greatest range, negative above it."""
    power = float(n.flat[0])  # one for all elements
    flight = fly(v, alpha0, np.zeros_like(v), power, ("x",))
    found = derivatives(flight, alpha0, power)
    return np.asarray(found.alpha0 / (np.tan(alpha0) + found.Q))


def _bracket(v: FloatArray, n: float) -> tuple[FloatArray | float, FloatArray | float]:
    """Angles on either side of the one of greatest range.

    For n < 2 it falls as the length L over which drag alone takes the speed down to v_lim grows:
    alpha0 (1 + L) is at least 0.6 and at most 2 (1 + ln(1 + L)), twice which is allowed for.
    """
    if n >= 2:
        return BRACKET
    log = np.log(np.maximum(v, 1.0))
    length = 1 + log * expm1_ratio((2 - n) * log)
    return 0.3 / length, np.minimum(4 * (1 + np.log(length)) / length, BRACKET[1])


@overload
def optimal_angle(v_norm: Scalar, *, n: float = 2.0) -> np.float64: ...
@overload
def optimal_angle(v_norm: ArrayLike, *, n: float = 2.0) -> FloatArray: ...
def optimal_angle(v_norm: ArrayLike, *, n: float = 2.0) -> Any:
    """Launch angle of greatest range on level ground (section 3.3).

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, v0 / v_lim, in [0, 1e20].
    n : float, optional
        Drag grows as the n-th power of the speed, n in [1, 10].

    Returns
    -------
    float or ndarray
        The angle in radians, of the shape of `v_norm`, to about 1e-13 relative: pi/4 at
        v_norm = 0, and for n = 2 falling from there.  NaN where v_norm is NaN, or where the
        iteration failed (with one `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range.
    TypeError
        The argument is not made of real numbers.

    Examples
    --------
    >>> import numpy as np
    >>> np.rad2deg(optimal_angle([0.0, 1.0, 10.0])).round(6)
    array([45.      , 40.977509, 25.154299])
    """
    from scipy.optimize import elementwise  # slow to import, and only the optimum needs it

    shape, (v,) = domain.broadcast(v_norm=(v_norm, domain.V_NORM))
    v = v.ravel()
    n = domain.option("n", n, powerlaw.EXPONENT)
    angle = np.where(np.isnan(v), np.nan, np.pi / 4)
    moving = np.flatnonzero(v > 0)
    failed = 0
    for block in blocks(moving.size):
        at = moving[block]
        found = elementwise.find_root(
            _stationarity,
            _bracket(v[at], n),
            args=(v[at], np.full(at.size, n)),
            tolerances={"xrtol": 1e-15},
        )
        angle[at] = np.where(found.success, found.x, np.nan)
        failed += int(np.count_nonzero(~found.success))
    if failed:
        warnings.warn(
            f"angle not converged for {failed} of {v.size} launches (NaN returned)",
            RuntimeWarning,
            stacklevel=2,
        )
    return domain.restore(angle, shape)


def _weak_balance(v: float, n: float) -> float:
    """The first form of the condition at 45 degrees, divided by eps = v^n.

    There p0 = 1 and, with phi_a = (1 - U^-a) / eps, M the integral of p phi_(2/n) and K that of
    (p + q) phi_(1 + 2/n), the fall to the ground is q^2 = 1 - 2 eps M and the condition

        sqrt(2) ((1 + q)^2 / 2 - eps K) = M + K,

    in which nothing cancels while eps is small.
    """
    eps = v**n
    flight = fly(np.array([v]), np.array([np.pi / 4]), np.zeros(1), n, ())
    q = float(flight.tangent[0])
    nodes, weights = gauss_legendre(40)
    p = 1 - (1 + q) * nodes
    inner = p + (1 - p) * nodes.T
    gap = (1 - p) * ((1 + inner**2) ** ((n - 1) / 2) @ weights)
    growth = n * 2 ** (-n / 2) * gap  # (U - 1) / eps
    log = np.log1p(eps * growth)

    def integral(integrand: FloatArray, a: float) -> float:
        phi = a * growth * log1p_ratio(eps * growth) * expm1_ratio(-a * log)
        return float((1 + q) * np.sum(weights * integrand * phi))

    M, K = integral(p, 2 / n), integral(p + q, 1 + 2 / n)
    return float(np.sqrt(2) * ((1 + q) ** 2 / 2 - eps * K) - M - K)


def balanced_exponent(v_norm: float) -> float:
    """Drag exponent for which the best angle is exactly 45 degrees, as without drag.

    Below it drag lowers the best angle, above it drag raises it (section 3.3 and its reference
    [14]).

    Parameters
    ----------
    v_norm : float
        Launch speed over terminal speed, in [0, 10]; 0 is the limit of weak drag, the root of

        (n + 2) (G - A) - 2 A = 2^((n + 1)/2),
        G = integral of (1 + p^2)^((n - 1)/2) and A = integral of p G(p), both from 0 to 1,

        which is what the condition of this module becomes to first order in v_norm^n.

    Returns
    -------
    float
        The exponent n, to about 1e-13.

    Examples
    --------
    >>> round(balanced_exponent(0.0), 6)
    3.414799
    """
    from scipy.optimize import brentq

    within = domain.Rule("in [0, 10]", lambda a: (a >= 0) & (a <= 10))
    v = domain.option("v_norm", v_norm, within)

    def balance(n: float) -> float:
        if v <= 1:
            return _weak_balance(v, n)
        at_45 = _stationarity(np.array([np.pi / 4]), np.array([v]), np.array([n]))
        return float(at_45[0])

    return float(brentq(balance, 2.0, 8.0, xtol=1e-14, rtol=1e-15))
