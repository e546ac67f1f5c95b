"""d_norm and the landing angle by interpolation, for v_norm <= 10 and n = 2.

What is interpolated is a ratio that varies slowly, over coordinates in which it is smooth::

    S = -ln(d_norm) / Z,    T = ln(tan(-alpha_s) / tan(alpha0)) / Z,    Z = ln(1 + v^2 sin(alpha0)),
    X = ln(1 + v^2),        Y = ln(1 + 200 sin(alpha0)) + 4 (1 - cos(alpha0)^(1/4)),

with v = v_norm.  Both quantities are analytic in v^2 and their nearest singularity lies near
v^2 = -1 / sin(alpha0), which a logarithm moves away.  The same holds seen along alpha0: for fast
launches everything happens where sin(alpha0) ~ 1 / (2 v^2), so that the first term of Y opens up
the small angles; the second opens up the steep ones, where the terms cos^2 ln cos become
t^8 ln t in t = cos^(1/4).  Z carries the limits: d_norm = 1 and alpha_s = -alpha0 are exact at
v = 0 and at alpha0 = 0.

S and T are quintic splines on a uniform grid over X and Y, evaluated by
`scipy.ndimage.map_coordinates`.  Their coefficients are in the file surrogate.npz, made by
``hodograph surrogate`` (see `certify`) and loaded on first use.
"""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph import domain
from hodograph.domain import FloatArray, Rule, Scalar

V_MAX = 10.0
ORDER = 5
CELLS = (40, 120)  # of the grid over X and Y
STRETCH, STEEP = 200.0, 4.0
FILE = "surrogate.npz"
BLOCK = 8192  # launches worked on at once: what fits the cache

SPEED = Rule(f"in [0, {V_MAX:g}] for the surrogate", lambda a: (a >= 0) & (a <= V_MAX))


class Tables(NamedTuple):
    """Spline coefficients of S and T, and what the file says of itself."""

    S: FloatArray
    T: FloatArray
    about: str


@overload
def d_norm(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def d_norm(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
def d_norm(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """Normalised distance by interpolation, to 1e-9 relative.

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, in [0, 10].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        d_norm, of the broadcast shape; exactly 1 at v_norm = 0 and at alpha0 = 0.

    Raises
    ------
    ValueError
        An element lies outside its range: the surrogate does not extrapolate.

    Examples
    --------
    >>> import numpy as np
    >>> d_norm([0.0, 0.5, 1.5], np.pi / 4).round(8)
    array([1.        , 0.84122206, 0.40853701])
    """
    return _checked(v_norm, alpha0, flat_d_norm)


@overload
def landing_angle(v_norm: Scalar, alpha0: Scalar) -> np.float64: ...
@overload
def landing_angle(v_norm: ArrayLike, alpha0: ArrayLike) -> FloatArray: ...
def landing_angle(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """Slope angle at the landing on level ground by interpolation, to 1e-9 relative.

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, in [0, 10].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        alpha_s in radians, of the broadcast shape; exactly -alpha0 at v_norm = 0.

    Raises
    ------
    ValueError
        An element lies outside its range: the surrogate does not extrapolate.

    Examples
    --------
    >>> import numpy as np
    >>> np.rad2deg(landing_angle([0.0, 1.0, 10.0], np.pi / 4)).round(6)
    array([-45.      , -57.273022, -83.234071])
    """
    return _checked(v_norm, alpha0, flat_landing_angle)


def _checked(
    v_norm: ArrayLike, alpha0: ArrayLike, kernel: Callable[[FloatArray, FloatArray], FloatArray]
) -> Any:
    shape, arrays = domain.broadcast(v_norm=(v_norm, SPEED), alpha0=(alpha0, domain.LEVEL_ANGLE))
    speeds, angles = (array.reshape(-1) for array in arrays)
    result = np.empty(speeds.size)
    for first in range(0, speeds.size, BLOCK):
        block = slice(first, first + BLOCK)
        v, a0 = np.ascontiguousarray(speeds[block]), np.ascontiguousarray(angles[block])
        result[block] = kernel(v, a0)
    return domain.restore(result, shape)


def flat_d_norm(v: FloatArray, a0: FloatArray, tables: Tables | None = None) -> FloatArray:
    """d_norm of one block of launches inside the domain, nothing checked."""
    sin0 = np.sin(a0)
    ratio = _interpolate((tables or load()).S, v, sin0, np.cos(a0))
    ratio *= scale(v, sin0)
    return np.asarray(np.minimum(np.exp(-ratio), 1.0))


def flat_landing_angle(v: FloatArray, a0: FloatArray, tables: Tables | None = None) -> FloatArray:
    """alpha_s of one block of launches inside the domain, nothing checked."""
    sin0, cos0 = np.sin(a0), np.cos(a0)
    ratio = _interpolate((tables or load()).T, v, sin0, cos0)
    steeper = sin0 * np.expm1(ratio * scale(v, sin0))
    turn = np.arctan(steeper * cos0 / (1 + steeper * sin0))  # -alpha_s - alpha0
    return np.asarray(-np.minimum(a0 + turn, domain.RIGHT_ANGLE))


def scale(v: FloatArray, sin0: FloatArray) -> FloatArray:
    """Z, by which the logarithms are divided."""
    return np.asarray(np.log(1 + v * v * sin0))


def coordinates(v: FloatArray, sin0: FloatArray, cos0: FloatArray) -> tuple[FloatArray, FloatArray]:
    """X and Y, each from 0 to 1 over the domain."""
    X = np.log(1 + v * v)
    Y = np.log(1 + STRETCH * sin0) + STEEP * (1 - np.sqrt(np.sqrt(cos0)))
    return X / np.log(1 + V_MAX**2), Y / (np.log(1 + STRETCH) + STEEP)


def _interpolate(
    table: FloatArray, v: FloatArray, sin0: FloatArray, cos0: FloatArray
) -> FloatArray:
    from scipy.ndimage import map_coordinates

    margin = (ORDER - 1) // 2  # coefficients before the one of the first knot
    at = np.empty((2, v.size))
    for row, fraction, cells in zip(at, coordinates(v, sin0, cos0), CELLS, strict=True):
        np.multiply(fraction, cells, out=row)
        np.fmin(row, cells, out=row)  # NaN too is given a place; its scale is NaN
        row += margin
    values: FloatArray = map_coordinates(table, at, order=ORDER, prefilter=False, mode="nearest")
    return values


@cache
def load() -> Tables:
    """The tables that come with the package."""
    from importlib.resources import files

    return parse(files("hodograph").joinpath(FILE).read_bytes())


def parse(content: bytes) -> Tables:
    """Tables out of the bytes of a file."""
    with np.load(io.BytesIO(content)) as data:
        tables = Tables(data["S"], data["T"], str(data["about"]))
    for table in (tables.S, tables.T):
        table.flags.writeable = False
    return tables
