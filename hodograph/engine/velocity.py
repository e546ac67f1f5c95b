"""The speed and the arc length along the path, in closed form (eq. 8-13, 19).

The slope is carried as s = asinh(tan alpha), and an arc is described from its own beginning:
delta = s0 - s >= 0 is how far the slope has come down.  With w = (v cos alpha0)^2,

    u = 1 + w (F(p0) - F(p)),    F(p) = asinh p + p sqrt(1 + p^2),    p = tan alpha,

is the bracket of eq. 13.  The difference of the two F is never formed: it is

    F(p0) - F(p) = delta + sinh(delta) cosh(2 s0 - delta),

a sum of terms of one sign, to which cos(alpha0) is brought as the factors 1 +/- sin(alpha0), so
that nothing cancels near the launch and nothing overflows near the vertical.
"""

from __future__ import annotations

from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hodograph.engine import domain
from hodograph.engine.domain import BoolArray, FloatArray, Scalar

LN_LARGEST = 710.0  # its exponential is beyond the doubles


class Start(NamedTuple):
    """Where an arc begins: v_norm^2, sin(alpha0) and 1 +/- sin(alpha0), each to full accuracy."""

    v2: FloatArray
    sin: FloatArray
    plus: FloatArray
    minus: FloatArray

    def at(self, index: NDArray[np.intp] | slice) -> Start:
        """The elements at `index`."""
        return Start(*(part[index] for part in self))


class Ahead(NamedTuple):
    """The landing as seen from the beginning of an arc, for integrands that look ahead to it.

    They hold L = scale cos(alpha0) (tan(alpha) - tan(alpha_s)) + level, alpha_s being the slope
    after `delta`.
    """

    delta: FloatArray
    scale: FloatArray
    level: FloatArray

    def at(self, index: NDArray[np.intp] | slice) -> Ahead:
        """The elements at `index`."""
        return Ahead(*(part[index] for part in self))

    def lever(self, begin: Start, delta: FloatArray) -> FloatArray:
        """L where the arc has come down by `delta`; the difference is not formed as one."""
        middle = 0.5 * (delta + self.delta)
        C = 0.5 * (begin.plus * np.exp(-middle) + begin.minus * np.exp(middle))
        return self.scale * 2 * C * np.sinh(0.5 * (self.delta - delta)) + self.level


def start(v2: FloatArray, sin0: FloatArray, cos0: FloatArray) -> Start:
    """The `Start` of launches at any angle."""
    far = 1 + np.abs(sin0)
    near = cos0 * cos0 / far
    up = sin0 >= 0
    return Start(v2, sin0, np.where(up, far, near), np.where(up, near, far))


def slope_drop(cos0: FloatArray, alpha0: FloatArray, alpha: FloatArray) -> FloatArray:
    """delta = asinh(tan alpha0) - asinh(tan alpha), without subtracting the two."""
    sine_gap = 2 * np.cos((alpha0 + alpha) / 2) * np.sin((alpha0 - alpha) / 2)
    return np.arcsinh(sine_gap / (cos0 * np.cos(alpha)))


def bracket_gap(begin: Start, delta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(q, C): u = 1 + v^2 q is the bracket of eq. 13, and C = cos(alpha0) / cos(alpha)."""
    growth = np.expm1(delta)
    decay = 1 / (1 + growth)
    down, up = begin.plus * decay, begin.minus * (1 + growth)
    gap = begin.plus * begin.minus * delta + 0.25 * growth * (1 + decay) * (
        begin.plus * down + begin.minus * up
    )
    return gap, 0.5 * (down + up)


def log1p_ratio(z: FloatArray) -> FloatArray:
    """ln(1 + z) / z, which is 1 at z = 0."""
    zero = z == 0
    return np.where(zero, 1.0, np.log1p(z) / np.where(zero, 1.0, z))


def expm1_ratio(z: FloatArray) -> FloatArray:
    """(e^z - 1) / z, which is 1 at z = 0, and inf where it is beyond the doubles.

    `scipy.special.exprel`, without the import of SciPy, which takes longer than a flight.
    """
    z = np.minimum(z, LN_LARGEST)
    with np.errstate(over="ignore"):
        return np.divide(np.expm1(z), z, out=np.ones_like(z), where=z != 0)


@overload
def terminal_speed(k: Scalar, *, g: Scalar = 9.81) -> np.float64: ...
@overload
def terminal_speed(k: ArrayLike, *, g: ArrayLike = 9.81) -> FloatArray: ...
def terminal_speed(k: ArrayLike, *, g: ArrayLike = 9.81) -> Any:
    """Terminal speed of fall under quadratic drag (eq. 12).

    Parameters
    ----------
    k : array_like
        Drag coefficient over mass, lambda/m, in 1/m; ``k >= 0``, and 0 is vacuum.
    g : array_like, optional
        Gravity in m/s^2, positive.

    Returns
    -------
    float or ndarray
        v_lim = sqrt(g / k) in m/s; ``inf`` in vacuum.

    Examples
    --------
    >>> round(float(terminal_speed(0.005376)), 1)  # a baseball, section 3.3 of the paper
    42.7
    """
    shape, (k_, g_) = domain.broadcast(k=(k, domain.NON_NEGATIVE), g=(g, domain.GRAVITY))
    with np.errstate(divide="ignore"):
        return domain.restore(np.sqrt(g_) / np.sqrt(np.abs(k_)), shape)  # abs: of -0.0


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
