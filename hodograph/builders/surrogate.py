"""The surrogate built: S and T as splines, fitted to the exact engine."""

import io
from collections.abc import Callable

import numpy as np

from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.engine.driver import apply
from hodograph.level import d_norm, on_level_ground
from hodograph.report.versions import STAMP
from hodograph.tiers import interpolant

COMMAND = "hodograph surrogate --out hodograph/tiers --force"
DECIMALS = 12  # of the coefficients kept


def build() -> bytes:
    """The bytes of surrogate.npz: S and T fitted to the exact engine.

    Each is a least-squares tensor spline over four Gauss points a cell and axis.  The bytes are the
    same at each call.
    """
    nodes = [
        inverse_axis(axis, gauss(cells))
        for axis, cells in zip(AXES, interpolant.CELLS, strict=True)
    ]
    S, T = (
        np.round(spline(values, interpolant.CELLS, interpolant.ORDER), DECIMALS)
        for values in ratios(*np.meshgrid(*nodes, indexing="ij"))
    )
    stream = io.BytesIO()
    np.savez_compressed(stream, S=S, T=T, about=np.array(about()))
    return stream.getvalue()


def about() -> str:
    """What the file says of itself."""
    return (
        "quintic B-spline coefficients of S and T, see hodograph/tiers/interpolant.py\n"
        f"fitted to {STAMP}, rounded to {DECIMALS} decimals\n"
        f"remade by: {COMMAND}"
    )


def ratios(v: FloatArray, a0: FloatArray) -> tuple[FloatArray, FloatArray]:
    """S and T by the exact engine, for v_norm > 0 and alpha0 > 0."""
    scale = interpolant.scale(v, np.sin(a0))
    # tangents, of which an angle near -90 degrees has lost digits
    arrays = [v, a0, np.full_like(v, 2.0)]
    (steeper,), _ = apply(on_level_ground("steeper"), v.shape, arrays, 1, exponent=2)
    return -np.log(d_norm(v, a0)) / scale, np.log(steeper) / scale


def _speed_axis(part: FloatArray) -> FloatArray:
    v = interpolant.V_MAX * part
    return np.asarray(interpolant.coordinates(v, v, v)[0])


def _angle(part: FloatArray) -> FloatArray:
    """The angle at each part of the axis, from 0 to 1: crowded towards the vertical."""
    return np.asarray(RIGHT_ANGLE - RIGHT_ANGLE * (1 - part) ** 4)


def _angle_axis(part: FloatArray) -> FloatArray:
    a0 = _angle(part)
    return np.asarray(interpolant.coordinates(a0, np.sin(a0), np.cos(a0))[1])


AXES = (
    (_speed_axis, lambda part: interpolant.V_MAX * part),
    (_angle_axis, _angle),
)


def inverse_axis(
    axis: tuple[Callable[[FloatArray], FloatArray], Callable[[FloatArray], FloatArray]],
    at: FloatArray,
) -> FloatArray:
    """Where an increasing coordinate takes given values in [0, 1], by bisection."""
    coordinate, quantity = axis
    low, high = np.zeros_like(at), np.ones_like(at)
    for _ in range(60):
        middle = (low + high) / 2
        above = coordinate(middle) > at
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return quantity(low)


def gauss(cells: int) -> FloatArray:
    """Four Gauss points in each of the cells that divide [0, 1]."""
    nodes = (np.polynomial.legendre.leggauss(4)[0] + 1) / 2
    return np.asarray((np.arange(cells)[:, np.newaxis] + nodes) / cells).ravel()


def spline(values: FloatArray, cells: tuple[int, int], order: int) -> FloatArray:
    """B-spline coefficients, on uniform knots, of values at the tensor of `gauss` points."""
    from scipy.interpolate import BSpline

    for axis, n in enumerate(cells):
        knots = np.arange(-order, n + order + 1) / n
        matrix = BSpline.design_matrix(gauss(n), knots, order).toarray()
        values = np.moveaxis(np.tensordot(np.linalg.pinv(matrix), values, (1, axis)), 0, axis)
    return np.ascontiguousarray(values)
