"""The path as a function of its slope angle: speed, length and position (eq. 13, 15, 19).

All is in units of the terminal speed, v_lim, v_lim^2 / g and v_lim / g, and drag is quadratic.
"""

from typing import Any, Generic, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain
from hodograph.engine.domain import BoolArray, FloatArray, Scalar, T
from hodograph.engine.position import arc
from hodograph.engine.record import plain, shown
from hodograph.engine.velocity import bracket_gap, slope_drop, start


class Position(NamedTuple, Generic[T]):
    """Position and time along a trajectory, in units of v_lim^2 / g and v_lim / g."""

    x: T
    y: T
    t: T

    def __repr__(self) -> str:
        """One line: numbers as they are, arrays by their shape."""
        return shown(self)

    def to_dict(self) -> dict[str, Any]:
        """The fields as plain numbers and nested lists, ready for ``json.dumps``."""
        return plain(self)


def _at_slope(
    v_norm: ArrayLike, alpha0: ArrayLike, alpha: ArrayLike
) -> tuple[tuple[int, ...], FloatArray, FloatArray, FloatArray, BoolArray]:
    """Shape, v_norm, q and C at the slope alpha of a launch, and whether it is the last, -pi/2."""
    shape, (v, a0, a) = domain.broadcast(
        v_norm=(v_norm, domain.V_NORM),
        alpha0=(alpha0, domain.SLOPE_ANGLE),
        alpha=(alpha, domain.SLOPE_ANGLE),
    )
    domain.check("alpha0 - alpha", a0 - a, domain.NON_NEGATIVE)
    sin0, cos0 = np.sin(a0), np.cos(a0)
    gap, cosines = bracket_gap(start(v, sin0, cos0), slope_drop(cos0, a0, a))
    return shape, v, gap, cosines, (v > 0) & (a == -domain.RIGHT_ANGLE) & (a0 > a)


@overload
def speed(v_norm: Scalar, alpha0: Scalar, alpha: Scalar) -> np.float64: ...
@overload
def speed(v_norm: ArrayLike, alpha0: ArrayLike, alpha: ArrayLike) -> FloatArray: ...
def speed(v_norm: ArrayLike, alpha0: ArrayLike, alpha: ArrayLike) -> Any:
    """Speed at the slope `alpha`, in units of v_lim (eq. 13).

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, v0 / v_lim, in [0, 1e20].
    alpha0 : array_like
        Launch angle in radians, in [-pi/2, pi/2].
    alpha : array_like
        Slope angle in radians, from -pi/2 up to `alpha0`.

    Returns
    -------
    float or ndarray
        v / v_lim, of the broadcast shape: 1 at -pi/2 (eq. 11), unless v_norm is 0.  NaN where an
        input is NaN.

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(speed(1.5, np.pi / 4, 0.0)), 6)  # at the apex
    0.560378
    >>> float(speed(1.5, np.pi / 4, -np.pi / 2))  # eq. 11
    1.0
    """
    shape, v, gap, cosines, last = _at_slope(v_norm, alpha0, alpha)
    with np.errstate(divide="ignore", over="ignore"):
        fast = np.minimum(cosines / np.hypot(1 / v, np.sqrt(gap)), v)
    least = np.minimum(v, 1.0)
    slow = least * cosines / np.sqrt(1 + least**2 * gap)
    return domain.restore(np.where(last, 1.0, np.where(v > 1, fast, slow)), shape)


@overload
def arc_length(v_norm: Scalar, alpha0: Scalar, alpha: Scalar) -> np.float64: ...
@overload
def arc_length(v_norm: ArrayLike, alpha0: ArrayLike, alpha: ArrayLike) -> FloatArray: ...
def arc_length(v_norm: ArrayLike, alpha0: ArrayLike, alpha: ArrayLike) -> Any:
    """Length of path from the launch to the slope `alpha`, in units of v_lim^2 / g (eq. 19).

    Parameters
    ----------
    v_norm, alpha0, alpha : array_like
        As for `speed`.

    Returns
    -------
    float or ndarray
        s g / v_lim^2, of the broadcast shape: ``inf`` at -pi/2, which is reached only after an
        infinite time.  NaN where an input is NaN.

    Examples
    --------
    >>> import numpy as np
    >>> round(float(arc_length(1.5, np.pi / 4, 0.0)), 6)
    0.638035
    """
    shape, v, gap, _, last = _at_slope(v_norm, alpha0, alpha)
    with np.errstate(over="ignore", divide="ignore"):
        root = v * np.sqrt(gap)  # u = 1 + root^2
        far = np.log(v) + 0.5 * np.log(gap)
        length = np.where(root < 1e9, 0.5 * np.log1p(root**2), far)
    return domain.restore(np.where(last, np.inf, length), shape)


@overload
def position(v_norm: Scalar, alpha0: Scalar, alpha: Scalar) -> Position[np.float64]: ...
@overload
def position(v_norm: ArrayLike, alpha0: ArrayLike, alpha: ArrayLike) -> Position[FloatArray]: ...
def position(v_norm: ArrayLike, alpha0: ArrayLike, alpha: ArrayLike) -> Position[Any]:
    """Position and time at the slope `alpha`, from the launch point (eq. 15).

    Parameters
    ----------
    v_norm, alpha0, alpha : array_like
        As for `speed`, but that -pi/2 is not among the slopes: it is reached only after an
        infinite time.

    Returns
    -------
    Position
        x and y in units of v_lim^2 / g, t in units of v_lim / g, of the broadcast shape; NaN
        where an input is NaN.

    Examples
    --------
    >>> import numpy as np
    >>> apex = position(1.5, np.pi / 4, 0.0)
    >>> [round(float(value), 6) for value in apex]
    [0.53412, 0.32143, 0.719111]
    """
    shape, (v, a0, a) = domain.broadcast(
        v_norm=(v_norm, domain.V_NORM),
        alpha0=(alpha0, domain.SLOPE_ANGLE),
        alpha=(alpha, domain.OPEN_ANGLE),
    )
    domain.check("alpha0 - alpha", a0 - a, domain.NON_NEGATIVE)
    results = np.full((3, v.size), np.nan)
    known = np.flatnonzero(~np.isnan(v + a0 + a))
    v, a0, a = v.ravel()[known], a0.ravel()[known], a.ravel()[known]
    sin0, cos0 = np.sin(a0), np.cos(a0)
    slope = np.arcsinh(sin0 / cos0)
    delta = slope_drop(cos0, a0, a)
    part = arc(start(v**2, sin0, cos0), slope, delta, ("x", "y", "t"))
    results[0, known] = cos0 * v**2 * part["x"]
    results[1, known] = v**2 * part["y"]
    results[2, known] = v * part["t"]
    return Position(*(domain.restore(row, shape) for row in results))
