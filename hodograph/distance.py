"""The normalised distance: range over the range without drag (eq. 21)."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph import dial, domain
from hodograph.domain import FloatArray, Scalar
from hodograph.flight import Flight
from hodograph.landing import on_level_ground
from hodograph.powerlaw import EXPONENT, PowerFlight
from hodograph.velocity import run_in


@overload
def d_ref(v0: Scalar, alpha0: Scalar, *, g: Scalar = 9.81) -> np.float64: ...
@overload
def d_ref(v0: ArrayLike, alpha0: ArrayLike, *, g: ArrayLike = 9.81) -> FloatArray: ...
def d_ref(v0: ArrayLike, alpha0: ArrayLike, *, g: ArrayLike = 9.81) -> Any:
    """Range without drag on level ground, v0^2 sin(2 alpha0) / g (eq. 21).

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, 0 or in [1e-30, 1e30].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].
    g : array_like, optional
        Gravity in m/s^2, positive.

    Returns
    -------
    float or ndarray
        Range in metres, of the broadcast shape.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(d_ref(70.0, np.pi / 4)), 4)
    499.4903
    """
    shape, (v, a0, g_) = domain.broadcast(
        v0=(v0, domain.LAUNCH_SPEED), alpha0=(alpha0, domain.LEVEL_ANGLE), g=(g, domain.GRAVITY)
    )
    with np.errstate(over="ignore"):
        return domain.restore(2 * np.sin(a0) * np.cos(a0) * v / g_ * v, shape)


@overload
def d_norm(
    v_norm: Scalar,
    alpha0: Scalar,
    *,
    n: float = 2.0,
    rtol: float | None = None,
    method: str | None = None,
) -> np.float64: ...
@overload
def d_norm(
    v_norm: ArrayLike,
    alpha0: ArrayLike,
    *,
    n: float = 2.0,
    rtol: float | None = None,
    method: str | None = None,
) -> FloatArray: ...
def d_norm(
    v_norm: ArrayLike,
    alpha0: ArrayLike,
    *,
    n: float = 2.0,
    rtol: float | None = None,
    method: str | None = None,
) -> Any:
    """Normalised distance d / d_ref on level ground: all that drag does to the range (eq. 21).

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, v0 / v_lim, in [0, 1e20].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].
    n : float, optional
        Drag grows as the n-th power of the speed, n in [1, 10]; then v_lim = (m g / lambda)^(1/n).
    rtol : float, optional
        Relative error that will do, at least 1e-13: each launch is then answered in the cheapest
        way whose certified error there is no larger.
    method : str, optional
        One way for all launches, in place of `rtol`: "law" (`laws.d_norm_law`, v_norm <= 6),
        "law_all" (`laws.d_norm_law_all`, any v_norm), "surrogate" (v_norm <= 10) or "exact",
        which is the default.  The first three are for n = 2.

    Returns
    -------
    float or ndarray
        d_norm in [0, 1], of the broadcast shape: exactly 1 at v_norm = 0 and at alpha0 = 0.  By
        default the largest relative error found against `hodograph.reference` is 8e-15.  It falls
        as ln(v_norm) / v_norm^2.  NaN where an input is NaN, or where the iteration failed (with
        one `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range, or that of `method`; the shapes do not broadcast;
        `rtol` is tighter than double precision can promise (`hodograph.reference` has more
        digits).
    TypeError
        An argument is not made of real numbers; both `rtol` and `method` are given.

    Examples
    --------
    >>> import numpy as np
    >>> d_norm([0.0, 0.5, 1.5], np.pi / 4).round(8)
    array([1.        , 0.84122206, 0.40853701])
    >>> d_norm([0.0, 0.5, 1.5], np.pi / 4, rtol=1e-3).round(3)
    array([1.   , 0.841, 0.409])
    """
    wanted = dial.choice(rtol, method)
    if wanted == "exact":
        return _exact(v_norm, alpha0, n)
    if domain.option("n", n, EXPONENT) != 2:
        if isinstance(wanted, str):
            raise ValueError(f"method {wanted!r} is for n = 2; got n = {n!r}")
        return _exact(v_norm, alpha0, n)
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.V_NORM), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    if isinstance(wanted, str):
        dial.require_domain(wanted, v)
    v, a0 = v.reshape(-1), a0.reshape(-1)
    result, left = dial.cheap(v, a0, wanted)
    if left.size:
        result[left] = _exact(v[left], a0[left], 2.0)
    return domain.restore(result, shape)


def _exact(v_norm: ArrayLike, alpha0: ArrayLike, n: float) -> Any:
    return on_level_ground(v_norm, alpha0, n, ("x",), lambda v, a0: np.ones_like(v), _ratio)


def _ratio(v: FloatArray, alpha0: FloatArray, flight: Flight | PowerFlight) -> FloatArray:
    slowed = 1.0 if isinstance(flight, PowerFlight) else run_in(v)[0] / v
    ratio = flight.reach / (2 * np.sin(alpha0)) * slowed**2  # eq. 21
    return np.asarray(np.minimum(ratio, 1.0))  # which rounding may pass
