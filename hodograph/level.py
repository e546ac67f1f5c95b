"""Level ground: the normalised distance, the landing angle, the best angle (eq. 20, 21)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, extremes, labels, linear, one, optimum, power, roots
from hodograph.engine.derivatives import derivatives
from hodograph.engine.domain import FloatArray, Rule, Scalar
from hodograph.engine.driver import Codes, Kernel, apply
from hodograph.engine.flight import Flight, fly
from hodograph.engine.status import Status
from hodograph.engine.velocity import expm1_ratio
from hodograph.laws.own import alpha_max_alone, alpha_max_flat
from hodograph.tiers import dial

SLOPE = -2.0  # derivative of `_stationarity` at its root, to begin with (-1.9 to -3.4 for n = 2)
BRACKET = (0.001, 1.2)  # holds the angle of greatest range for n >= 2 and every speed


@overload
def d_ref(v0: Scalar, alpha0: Scalar, *, g: Scalar = 9.81) -> np.float64: ...
@overload
def d_ref(v0: ArrayLike, alpha0: ArrayLike, *, g: ArrayLike = 9.81) -> FloatArray: ...
@labels.kept("range without drag", "m")
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
    n: ArrayLike = 2.0,
    rtol: float | None = None,
    method: str | None = None,
) -> np.float64: ...
@overload
def d_norm(
    v_norm: ArrayLike,
    alpha0: ArrayLike,
    *,
    n: ArrayLike = 2.0,
    rtol: float | None = None,
    method: str | None = None,
) -> FloatArray: ...
@labels.kept("range over the range without drag", "1")
def d_norm(
    v_norm: ArrayLike,
    alpha0: ArrayLike,
    *,
    n: ArrayLike = 2.0,
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
    n : array_like, optional
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
    if (alone := dial.alone(v_norm, alpha0, n, wanted)) is not None:
        return np.float64(alone)
    shape, arrays = domain.broadcast(
        v_norm=(v_norm, domain.V_NORM), alpha0=(alpha0, domain.LEVEL_ANGLE), n=(n, power.EXPONENT)
    )
    if isinstance(wanted, str) and wanted != "exact":
        domain.check("n", arrays[2], Rule(f"2 for method={wanted!r}", lambda a: a == 2))
        dial.require_domain(wanted, arrays[0])
    by_one = partial(dial.alone, wanted=wanted)
    return apply(cheapest(wanted), shape, arrays, 1, exponent=2, alone=by_one)[0][0]


def cheapest(wanted: float | str) -> Kernel:
    """The kernel that gives d_norm by a tier, or by the cheapest that meets a tolerance."""
    exact = on_level_ground("d_norm")
    if wanted == "exact":
        return exact

    def kernel(
        v: FloatArray, alpha0: FloatArray, n: FloatArray
    ) -> tuple[Sequence[FloatArray], Codes]:
        if not power.is_square(n):
            return exact(v, alpha0, n)
        codes = np.full(v.shape, Status.CONVERGED, np.int8)
        row, left = dial.cheap(v, alpha0, wanted)
        if left.size:
            (row[left],), codes[left] = exact(v[left], alpha0[left], n[left])
        return [row], codes

    return kernel


@overload
def landing_angle(v_norm: Scalar, alpha0: Scalar, *, n: ArrayLike = 2.0) -> np.float64: ...
@overload
def landing_angle(v_norm: ArrayLike, alpha0: ArrayLike, *, n: ArrayLike = 2.0) -> FloatArray: ...
@labels.kept("slope angle at the landing", "rad")
def landing_angle(v_norm: ArrayLike, alpha0: ArrayLike, *, n: ArrayLike = 2.0) -> Any:
    """Slope angle of the path where it comes back to the launch height (eq. 20).

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, v0 / v_lim, in [0, 1e20].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].
    n : array_like, optional
        Drag grows as the n-th power of the speed, n in [1, 10]; then v_lim = (m g / lambda)^(1/n).

    Returns
    -------
    float or ndarray
        alpha_s in radians, in [-pi/2, 0], of the broadcast shape: -alpha0 at v_norm = 0, steeper
        with drag.  NaN where an input is NaN, or where the iteration failed (with one
        `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    >>> import numpy as np
    >>> np.rad2deg(landing_angle([0.0, 1.0, 10.0], np.pi / 4)).round(6)
    array([-45.      , -57.273022, -83.234071])
    """
    if (alone := one.landing_angle(v_norm, alpha0, n)) is not None:
        return np.float64(alone)
    shape, arrays = domain.broadcast(
        v_norm=(v_norm, domain.V_NORM), alpha0=(alpha0, domain.LEVEL_ANGLE), n=(n, power.EXPONENT)
    )
    kernel = on_level_ground("alpha")
    return apply(kernel, shape, arrays, 1, exponent=2, alone=one.landing_angle)[0][0]


def on_level_ground(*names: str) -> Kernel:
    """The kernel that gives quantities of level flights of v_norm, alpha0, n: see `LEVEL`."""
    needs = tuple(dict.fromkeys(part for name in names for part in LEVEL[name][0]))

    def kernel(v: FloatArray, alpha0: FloatArray, n: FloatArray) -> tuple[list[FloatArray], Codes]:
        still = extremes.vacuum(v, alpha0, n)
        flying = slice(None) if not still.any() else np.flatnonzero(~still)
        v_, a_, n_ = v[flying], alpha0[flying], n[flying]
        level = np.zeros_like(v_)
        flight: Flight | linear.Flight
        flight = linear.fly(v_, a_, level, needs) if n[0] == 1 else fly(v_, a_, level, n_, needs)
        if isinstance(flying, slice):
            return [LEVEL[name][1](a_, flight) for name in names], flight.status
        rows, codes = [], np.full(v.shape, Status.CONVERGED, np.int8)
        codes[flying] = flight.status
        for name in names:
            row = LEVEL[name][2](alpha0)
            row[flying] = LEVEL[name][1](a_, flight)
            rows.append(row)
        return rows, codes

    return kernel


# A quantity of level flights: the integrals it needs, how it is made, and its limit in vacuum.
LEVEL: dict[
    str,
    tuple[
        tuple[str, ...],
        Callable[[FloatArray, Any], FloatArray],
        Callable[[FloatArray], FloatArray],
    ],
] = {
    "d_norm": (
        ("x",),
        lambda alpha0, flight: np.minimum(flight.reach / (2 * flight.sin0), 1.0),  # eq. 21
        np.ones_like,
    ),
    "alpha": ((), lambda alpha0, flight: -np.arctan(flight.tangent), np.negative),
    "steeper": (  # tan(-alpha_s) / tan(alpha0)
        (),
        lambda alpha0, flight: flight.tangent * flight.cos0 / flight.sin0,
        np.ones_like,
    ),
}


@overload
def optimal_angle(v_norm: Scalar, *, n: ArrayLike = 2.0) -> np.float64: ...
@overload
def optimal_angle(v_norm: ArrayLike, *, n: ArrayLike = 2.0) -> FloatArray: ...
@labels.kept("launch angle of greatest range", "rad")
def optimal_angle(v_norm: ArrayLike, *, n: ArrayLike = 2.0) -> Any:
    """Launch angle of greatest range on level ground (section 3.3).

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, v0 / v_lim, in [0, 1e20].
    n : array_like, optional
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
    if (alone := _best_alone(v_norm, n)) is not None:
        return np.float64(alone)
    shape, arrays = domain.broadcast(v_norm=(v_norm, domain.V_NORM), n=(n, power.EXPONENT))
    kernel = best_on_level_ground
    return apply(kernel, shape, arrays, 1, exponent=1, alone=_best_alone, what="angle")[0][0]


def _best_alone(v_norm: Any, n: Any) -> float | None:
    """The same of one launch in plain floats; None where the kernel is to answer."""
    return one.best_angle(v_norm, 1.0, 1.0, 0.0, n, alpha_max_alone)


def best_on_level_ground(v: FloatArray, n: FloatArray) -> tuple[list[FloatArray], Codes]:
    """The kernel that gives the angle of greatest range of v_norm and n."""
    angle, codes = np.full_like(v, np.pi / 4), np.full(v.shape, Status.CONVERGED, np.int8)
    at = np.flatnonzero(v > 0)
    if at.size:
        v_, n_ = v[at], n[at]
        guess, bracket = alpha_max_flat(v_), _bracket(v_, n_)
        angle[at], found = roots.near(_stationarity, guess, SLOPE, bracket, (v_, n_))
        codes[at[~found]] = Status.NOT_CONVERGED
    return [angle], codes


def _stationarity(alpha0: FloatArray, v: FloatArray, n: FloatArray) -> FloatArray:
    """d ln(R) / d(alpha0) but for a factor; positive below the angle of greatest range."""
    found = derivatives(fly(v, alpha0, np.zeros_like(v), n, ("x",)), of_angle=True)
    return np.asarray(found.alpha0 / ((np.tan(alpha0) + found.Q) * found.reach * np.cos(alpha0)))


def _bracket(v: FloatArray, n: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Angles on either side of the one of greatest range.

    For n < 2 it falls as the length L over which drag alone takes the speed down to v_lim grows:
    alpha0 (1 + L) is at least 0.6 and at most 2 (1 + ln(1 + L)), twice which is allowed for.
    """
    log = np.log(np.maximum(v, 1.0))
    length = 1 + log * expm1_ratio((2 - n) * log)
    low = np.where(n >= 2, BRACKET[0], 0.3 / length)
    high = np.where(n >= 2, BRACKET[1], np.minimum(4 * (1 + np.log(length)) / length, BRACKET[1]))
    return low, high


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
            return optimum.weak_balance(v, n)
        at_45 = _stationarity(np.array([np.pi / 4]), np.array([v]), np.array([n]))
        return float(at_45[0])

    return float(brentq(balance, 2.0, 8.0, xtol=1e-14, rtol=1e-15))
