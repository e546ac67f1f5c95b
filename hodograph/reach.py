"""What reaches a place: the angle of greatest range for any landing height."""

from __future__ import annotations

from functools import partial
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, extremes, one, power
from hodograph.engine.derivatives import derivatives
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray, Scalar
from hodograph.engine.driver import Codes, apply
from hodograph.engine.flight import fly
from hodograph.engine.status import Status
from hodograph.laws.own import alpha_max_alone
from hodograph.level import best_on_level_ground


@overload
def best_angle(
    v0: Scalar, v_lim: Scalar, *, g: Scalar = 9.81, height: Scalar = 0.0, n: Scalar = 2.0
) -> np.float64: ...
@overload
def best_angle(
    v0: ArrayLike,
    v_lim: ArrayLike,
    *,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
    n: ArrayLike = 2.0,
) -> FloatArray: ...
def best_angle(
    v0: ArrayLike,
    v_lim: ArrayLike,
    *,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
    n: ArrayLike = 2.0,
) -> Any:
    """Launch angle of greatest range for any landing height, from the root of dR/dalpha0.

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, in [1e-30, 1e30].
    v_lim : array_like
        Terminal speed of fall in m/s, at least 1e-30; ``inf`` is vacuum.  v0 / v_lim is at most
        1e20.
    g : array_like, optional
        Gravity in m/s^2, positive.
    height : array_like, optional
        Height of the launch above the landing plane in m; negative for a target above it.
    n : array_like, optional
        Drag grows as the n-th power of the speed, n in [1, 10].

    Returns
    -------
    float or ndarray
        The angle in radians, of the broadcast shape, to about 1e-13 relative.  NaN where an input
        is NaN, where the landing height is reached at no angle, and where the iteration failed
        (with a `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    A shot of 14 m/s without drag, put from 2 m: tan(alpha) = v0 / sqrt(v0^2 + 2 g h)

    >>> import numpy as np
    >>> round(float(np.rad2deg(best_angle(14.0, np.inf, height=2.0))), 4)
    42.3896
    """
    by_one = partial(one.best_angle, guess=alpha_max_alone)
    moving = one.is_within(domain.LEAST, v0, domain.MOST)
    if moving and (alone := by_one(v0, v_lim, g, height, n)) is not None:
        return np.float64(alone)
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        g=(g, domain.GRAVITY),
        height=(height, domain.HEIGHT),
        n=(n, power.EXPONENT),
    )
    domain.check_scene(*arrays[:4])
    return apply(_best, shape, arrays, 1, exponent=4, alone=by_one, what="angle")[0][0]


def _best(
    v0: FloatArray, v_lim: FloatArray, g: FloatArray, height: FloatArray, n: FloatArray
) -> tuple[list[FloatArray], Codes]:
    from scipy.optimize import elementwise  # slow to import

    own = extremes.scale(v0, np.full_like(v0, RIGHT_ANGLE), v_lim, g, height, n)
    upright = fly(own.v, own.alpha0, own.height, n, ())  # which reaches highest
    codes, angle = upright.status.copy(), np.zeros_like(v0)
    level = np.flatnonzero(height == 0)
    (angle[level],), codes[level] = best_on_level_ground(own.v[level], n[level])
    at = np.flatnonzero((height != 0) & (codes == Status.CONVERGED))
    if at.size:
        found = elementwise.find_root(
            _upward,
            (np.zeros(at.size), np.full(at.size, RIGHT_ANGLE)),
            args=(own.v[at], own.height[at], n[at]),
            tolerances={"xrtol": 1e-15, "xatol": 0.0, "fatol": 0.0},
            maxiter=400,
        )
        angle[at] = found.x * own.rest[at]
        codes[at[~found.success]] = Status.NOT_CONVERGED
    return [angle], codes


def _upward(alpha0: FloatArray, v: FloatArray, height: FloatArray, n: FloatArray) -> FloatArray:
    """Positive below the angle of greatest range, and where the height is not reached."""
    flight = fly(v, alpha0, height, n, ("x",))
    found = derivatives(flight, of_angle=True)
    whole = np.tan(alpha0) + found.Q
    slant = np.divide(found.alpha0, whole, out=np.ones_like(whole), where=whole > 0)
    return np.where((flight.status == Status.UNREACHABLE) | (found.Q == 0), 1.0, slant)
