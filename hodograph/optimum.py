"""The launch angle of greatest range on level ground (section 3.3).

With p = tan(alpha), the range is stationary where

    p0 + q = 2 cos(alpha0) (sin(alpha0) + v^2) I,    I = integral of (p + q) / u^2 dp,

over the path from p0 down to the landing at -q: the derivative of eq. 15 in alpha0, taken under
the integral and with the landing held on the ground.  For fast launches I cancels against the
left side; integrated by parts, with d(1/u) = 2 w sqrt(1 + p^2) dp / u^2, the same condition is

    (p0 + q) sin(alpha0) cos(alpha0) = (sin(alpha0) + v^2) J,
    J = integral of (cos(alpha) - q sin(alpha)) dalpha / u,

which in turn cancels for slow ones.  The first is used up to v_norm = 1, the second from there.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import elementwise

from hodograph import domain
from hodograph.domain import FloatArray
from hodograph.flight import blocks, fly
from hodograph.position import arc
from hodograph.velocity import Start, bracket_gap, run_in, start

BRACKET = (0.001, 0.8)  # holds the angle for every double: 45 degrees falls as ln(v_norm) grows


def _stationarity(alpha0: FloatArray, v: FloatArray) -> FloatArray:
    """Positive below the angle of greatest range, negative above it."""
    q = fly(v, alpha0, np.zeros_like(v), ()).tangent
    v, run = run_in(v)
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    p0 = sin0 / cos0
    slope = np.arcsinh(p0)
    begin = start(v * v, sin0, cos0)
    u_top = 1 + v * v * bracket_gap(begin, slope)[0]
    w = (v * cos0) ** 2 / u_top
    down = np.arcsinh(q)
    level = np.zeros_like(v)
    wanted = ("dx", "dy", "cos", "sin")
    rise = arc(begin, None, slope, wanted)
    fall = arc(Start(w, level, level + 1, level + 1), level, down, wanted)
    # over the path: dp / u^2, p dp / u^2, cos(alpha) dalpha / u, sin(alpha) dalpha / u
    one = rise["dx"] / cos0 + fall["dx"] / u_top**2
    tangent = rise["dy"] / cos0**2 + fall["dy"] / u_top**2
    cosine = rise["cos"] * cos0**2 + fall["cos"] / u_top
    sine = rise["sin"] * cos0 + fall["sin"] / u_top
    slow = (p0 + q) - 2 * cos0 * (sin0 + v * v) * (tangent + q * one)
    square = np.maximum(v * v, 1.0)
    J = square * (cosine - q * sine) + run * cos0 * (cos0 - q * sin0)
    fast = (sin0 / square + 1) * J - (p0 + q) * sin0 * cos0
    return np.asarray(np.where(v <= 1, slow, fast))


def optimal_angle(v_norm: ArrayLike) -> Any:
    """Launch angle of greatest range on level ground (section 3.3).

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, v0 / v_lim, finite and >= 0.

    Returns
    -------
    float or ndarray
        The angle in radians, of the shape of `v_norm`: pi/4 at v_norm = 0 and falling from there,
        to about 1e-14 relative.  NaN where v_norm is NaN.

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
    shape, (v,) = domain.broadcast(v_norm=(v_norm, domain.NON_NEGATIVE))
    v = v.ravel()
    angle = np.where(np.isnan(v), np.nan, np.pi / 4)
    moving = np.flatnonzero(v > 0)
    for block in blocks(moving.size):
        at = moving[block]
        found = elementwise.find_root(
            _stationarity, BRACKET, args=(v[at],), tolerances={"xrtol": 1e-15}
        )
        angle[at] = found.x
    return domain.restore(angle, shape)
