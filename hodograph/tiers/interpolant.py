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
``hodograph surrogate`` (see `builders.surrogate`) and loaded on first use.
"""

import io
import math
from functools import cache
from math import atan, cos, exp, expm1, sin
from typing import Any, NamedTuple

import numpy as np

from hodograph.engine import domain
from hodograph.engine.domain import FloatArray
from hodograph.engine.functions import ARRAYS, PLAIN, Functions

V_MAX = 10.0
ORDER = 5
CELLS = (40, 120)  # of the grid over X and Y
STRETCH, STEEP = 200.0, 4.0
X_END, Y_END = math.log(1 + V_MAX**2), math.log(1 + STRETCH) + STEEP
FILE = "surrogate.npz"
BLOCK = 8192  # launches worked on at once: what fits the cache


class Tables(NamedTuple):
    """Spline coefficients of S and T, and what the file says of itself."""

    S: FloatArray
    T: FloatArray
    about: str


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


def d_norm_alone(v: float, a0: float) -> float:
    """`flat_d_norm` of one launch in plain floats."""
    sin0 = sin(a0)
    ratio = _interpolate_alone("S", v, sin0, cos(a0)) * scale(v, sin0, PLAIN)
    return min(exp(-ratio), 1.0)


def landing_angle_alone(v: float, a0: float) -> float:
    """`flat_landing_angle` of one launch in plain floats."""
    sin0, cos0 = sin(a0), cos(a0)
    ratio = _interpolate_alone("T", v, sin0, cos0) * scale(v, sin0, PLAIN)
    steeper = sin0 * expm1(ratio)
    return -min(a0 + atan(steeper * cos0 / (1 + steeper * sin0)), domain.RIGHT_ANGLE)


def scale(v: Any, sin0: Any, f: Functions = ARRAYS) -> Any:
    """Z, by which the logarithms are divided."""
    return f.log(1 + v * v * sin0)


def coordinates(v: Any, sin0: Any, cos0: Any, f: Functions = ARRAYS) -> tuple[Any, Any]:
    """X and Y, each from 0 to 1 over the domain."""
    X = f.log(1 + v * v)
    Y = f.log(1 + STRETCH * sin0) + STEEP * (1 - f.sqrt(f.sqrt(cos0)))
    return X / X_END, Y / Y_END


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


def _interpolate_alone(name: str, v: float, sin0: float, cos0: float) -> float:
    X, Y = coordinates(v, sin0, cos0, PLAIN)
    x, y = X * CELLS[0], Y * CELLS[1]
    row, column = min(int(x), CELLS[0] - 1), min(int(y), CELLS[1] - 1)
    w0, w1, w2, w3, w4, w5 = _weights(y - column)
    value = 0.0
    for weight, line in zip(_weights(x - row), _rows(name)[row : row + 6], strict=True):
        c0, c1, c2, c3, c4, c5 = line[column : column + 6]
        value += weight * (w0 * c0 + w1 * c1 + w2 * c2 + w3 * c3 + w4 * c4 + w5 * c5)
    return value


def _weights(t: float) -> tuple[float, float, float, float, float, float]:
    """The six quintic B-splines of a uniform grid, at t of a cell, from 0 to 1."""
    u = 1.0 - t
    t2, u2 = t * t, u * u
    t4, u4 = t2 * t2, u2 * u2
    return (
        u * u4 / 120,
        (26 - t * (50 - 20 * t * (1 + t)) - 20 * t4 + 5 * t * t4) / 120,
        (66 - 60 * t2 + 30 * t4 - 10 * t * t4) / 120,
        (66 - 60 * u2 + 30 * u4 - 10 * u * u4) / 120,
        (26 - u * (50 - 20 * u * (1 + u)) - 20 * u4 + 5 * u * u4) / 120,
        t * t4 / 120,
    )


@cache
def _rows(name: str) -> tuple[tuple[float, ...], ...]:
    """A table as plain floats."""
    return tuple(map(tuple, getattr(load(), name).tolist()))


@cache
def load() -> Tables:
    """The tables that come with the package."""
    from importlib.resources import files

    return parse(files("hodograph.tiers").joinpath(FILE).read_bytes())


def parse(content: bytes) -> Tables:
    """Tables out of the bytes of a file."""
    with np.load(io.BytesIO(content)) as data:
        tables = Tables(data["S"], data["T"], str(data["about"]))
    for table in (tables.S, tables.T):
        table.flags.writeable = False
    return tables
