"""What reaches a place: the angle of greatest range for any landing height."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import elementwise

from hodograph.engine import domain
from hodograph.engine.derivatives import derivatives
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray, Scalar
from hodograph.engine.flight import (
    CONVERGED,
    NOT_CONVERGED,
    UNREACHABLE,
    blocks,
    fly,
    scaled,
    warn_not_converged,
)
from hodograph.level import optimal_angle


def _upward(alpha0: FloatArray, v: FloatArray, height: FloatArray) -> FloatArray:
    """Positive below the angle of greatest range, and where the height is not reached."""
    flight = fly(v, alpha0, height, 2.0, ("x",))
    found = derivatives(flight, alpha0, 2.0)
    whole = np.tan(alpha0) + found.Q
    slant = np.divide(found.alpha0, whole, out=np.ones_like(whole), where=whole > 0)
    return np.where((flight.status == UNREACHABLE) | (found.Q == 0), 1.0, slant)


@overload
def best_angle(
    v0: Scalar, v_lim: Scalar, *, g: Scalar = 9.81, height: Scalar = 0.0
) -> np.float64: ...
@overload
def best_angle(
    v0: ArrayLike, v_lim: ArrayLike, *, g: ArrayLike = 9.81, height: ArrayLike = 0.0
) -> FloatArray: ...
def best_angle(
    v0: ArrayLike, v_lim: ArrayLike, *, g: ArrayLike = 9.81, height: ArrayLike = 0.0
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
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        g=(g, domain.GRAVITY),
        height=(height, domain.HEIGHT),
    )
    domain.check_scene(*arrays)
    _, v, depth, rest = scaled(*(np.ravel(array) for array in arrays))
    angle = np.full(v.size, np.nan)
    level = depth == 0
    angle[level] = optimal_angle(v[level])
    others = np.flatnonzero(~level & ~np.isnan(v + depth))
    failed = 0
    for block in blocks(others.size):
        at = others[block]
        top = np.full(at.size, RIGHT_ANGLE)
        status = fly(v[at], top, depth[at], 2.0, ()).status
        failed += int(np.count_nonzero(status == NOT_CONVERGED))
        reached = status == CONVERGED
        at = at[reached]
        if at.size:
            found = elementwise.find_root(
                _upward,
                (np.zeros(at.size), top[reached]),
                args=(v[at], depth[at]),
                tolerances={"xrtol": 1e-15, "xatol": 0.0, "fatol": 0.0},
                maxiter=400,
            )
            angle[at] = np.where(found.success, found.x * rest[at], np.nan)
            failed += int(np.count_nonzero(~found.success))
    warn_not_converged(failed, v.size)
    return domain.restore(angle, shape)
