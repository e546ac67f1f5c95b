"""The surrogate built, every cheap tier measured, and the candidates compared.

``hodograph surrogate`` writes the two files that the package carries: surrogate.npz, the spline
coefficients of `surrogate`, and bounds.json, the error bounds that `dial` goes by.
``hodograph surrogate --compare`` measures the chosen interpolation beside others.
"""

from __future__ import annotations

import hashlib
import io
import json
import statistics
from collections.abc import Callable
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from hodograph import clock, dial, surrogate
from hodograph.distance import d_norm
from hodograph.domain import RIGHT_ANGLE, FloatArray
from hodograph.files import check_targets, write_whole
from hodograph.landing import landing_angle, on_level_ground

Function = Callable[[FloatArray, FloatArray], FloatArray]
Progress = Callable[[str], None]

COMMAND = "hodograph surrogate --out hodograph --force"
FILES = (surrogate.FILE, dial.FILE)
COMPARISON, SETTINGS = "surrogate.csv", "dial.csv"  # in data/
COMPARE = "hodograph surrogate --compare --out data --force"
DECIMALS = 12  # of the coefficients kept
MARGIN = 1.25  # a bound is this times the largest error found, and the engine's own 1e-13
SHAPE = (48, 32)  # cells of the table of bounds, in sqrt(v_norm) and alpha0
INSIDE, ALONG, FAR = 32, 64, 25_000  # points: per side of a cell, per edge of it, per far end
SEED = 2008
ROUNDS = 15  # in which ways are timed, one after another
MANY = 100_000  # launches timed at once
RTOL = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13)
REACHES = (1.5, 10.0, 20.0)  # of v_norm, in what the dial is timed on


# --- the surrogate -------------------------------------------------------------------------


def build() -> bytes:
    """The bytes of surrogate.npz: S and T fitted to the exact engine.

    Each is a least-squares tensor spline over four Gauss points a cell and axis.

    Returns
    -------
    bytes
        The content of the file, the same at each call.
    """
    nodes = [
        inverse_axis(axis, _gauss(cells)) for axis, cells in zip(AXES, surrogate.CELLS, strict=True)
    ]
    S, T = (
        np.round(spline(values, surrogate.CELLS, surrogate.ORDER), DECIMALS)
        for values in ratios(*np.meshgrid(*nodes, indexing="ij"))
    )
    stream = io.BytesIO()
    np.savez_compressed(stream, S=S, T=T, about=np.array(about()))
    return stream.getvalue()


def about() -> str:
    """What the file says of itself."""
    return (
        "quintic B-spline coefficients of S and T, see hodograph/surrogate.py\n"
        f"fitted to hodograph {version('hodograph')}, rounded to {DECIMALS} decimals\n"
        f"remade by: {COMMAND}"
    )


def ratios(v: FloatArray, a0: FloatArray) -> tuple[FloatArray, FloatArray]:
    """S and T by the exact engine, for v_norm > 0 and alpha0 > 0."""
    scale = surrogate.scale(v, np.sin(a0))
    steeper = on_level_ground(  # the tangents themselves: near -90 degrees the angle says less
        v,
        a0,
        2.0,
        (),
        lambda v, a0: np.ones_like(v),
        lambda v, a0, flight: flight.tangent * np.cos(a0) / np.sin(a0),
    )
    return -np.log(d_norm(v, a0)) / scale, np.log(steeper) / scale


def _speed_axis(part: FloatArray) -> FloatArray:
    v = surrogate.V_MAX * part
    return surrogate.coordinates(v, v, v)[0]


def _angle(part: FloatArray) -> FloatArray:
    """An angle for each part of 1, crowded towards the vertical."""
    return np.asarray(RIGHT_ANGLE - RIGHT_ANGLE * (1 - part) ** 4)


def _angle_axis(part: FloatArray) -> FloatArray:
    a0 = _angle(part)
    return surrogate.coordinates(a0, np.sin(a0), np.cos(a0))[1]


AXES = (
    (_speed_axis, lambda part: surrogate.V_MAX * part),
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


def _gauss(cells: int) -> FloatArray:
    """Four Gauss points in each of the cells that divide [0, 1]."""
    nodes = (np.polynomial.legendre.leggauss(4)[0] + 1) / 2
    return np.asarray((np.arange(cells)[:, np.newaxis] + nodes) / cells).ravel()


def spline(values: FloatArray, cells: tuple[int, int], order: int) -> FloatArray:
    """B-spline coefficients, on uniform knots, of values at the tensor of `_gauss` points."""
    from scipy.interpolate import BSpline

    for axis, n in enumerate(cells):
        knots = np.arange(-order, n + order + 1) / n
        matrix = BSpline.design_matrix(_gauss(n), knots, order).toarray()
        values = np.moveaxis(np.tensordot(np.linalg.pinv(matrix), values, (1, axis)), 0, axis)
    return np.ascontiguousarray(values)


# --- the bounds ----------------------------------------------------------------------------


def bounds(content: bytes, *, progress: Progress = lambda words: None) -> str:
    """The text of bounds.json: the error of each cheap tier, cell by cell.

    Every cell holds jittered points in its inside, points along its edges, and its corners; more
    lie towards rest, level launch, vertical launch and the fastest launch.  A bound is `MARGIN`
    times the largest error found in the cell, plus the 1e-13 of the engine.

    Parameters
    ----------
    content : bytes
        The surrogate, as in its file.
    progress : callable, optional
        Called with a line of words now and then.

    Returns
    -------
    str
        The content of the file.
    """
    tables = surrogate.parse(content)
    exact = {"d_norm": d_norm, "landing_angle": landing_angle}
    cheap: dict[str, dict[str, Function]] = {
        "d_norm": {
            "law": dial.LAW,
            "surrogate": lambda v, a0: surrogate.flat_d_norm(v, a0, tables),
        },
        "landing_angle": {
            "surrogate": lambda v, a0: surrogate.flat_landing_angle(v, a0, tables),
        },
    }
    found: dict[str, Any] = {
        "about": "bounds on the relative error, remade by: " + COMMAND,
        "engine": f"hodograph {version('hodograph')}",
        "surrogate_sha256": hashlib.sha256(content).hexdigest(),
        "margin": MARGIN,
        "engine_error": dial.PROMISE,
        "cells": "rows: uniform in sqrt(v_norm), 0 to v_max; columns: in alpha0, 0 to pi/2",
    }
    for quantity, ways in cheap.items():
        found[quantity] = {}
        for name, way in ways.items():
            v_max = dial.V_MAX[name]
            v, a0 = points(v_max)
            worst = largest_errors(way, exact[quantity], v, a0, v_max)
            table = [[_upward(MARGIN * e + dial.PROMISE) for e in row] for row in worst.tolist()]
            most = max(map(max, table))
            found[quantity][name] = {
                "v_max": v_max,
                "points": v.size,
                "largest": most,
                "bounds": table,
            }
            progress(
                f"{quantity}, {name}: at most {most:.2e} on {v.size} points, v_norm <= {v_max:g}"
            )
    return _json(found)


def points(v_max: float) -> tuple[FloatArray, FloatArray]:
    """Launches with v_norm <= v_max to measure on, none of them used in fitting."""
    rng = np.random.default_rng(SEED)
    rows, columns = SHAPE
    i, j = (k.reshape(-1, 1) for k in np.divmod(np.arange(rows * columns), columns))
    last = np.nextafter(1.0, 0.0)
    grid = np.divmod(np.arange(INSIDE**2), INSIDE)
    places = []  # in each cell, from 0 to 1
    places.append([(part + rng.random((i.size, INSIDE**2))) / INSIDE for part in grid])
    for end in (0.0, last):
        free, fixed = rng.random((i.size, ALONG)), np.full((i.size, ALONG), end)
        free[:, :2] = 0.0, last
        places += [[free, fixed], [fixed, free]]
    v = [(v_max * ((i + f) / rows) ** 2).ravel() for f, _ in places]
    a0 = [((j + g) / columns * RIGHT_ANGLE).ravel() for _, g in places]
    far = v_max * rng.random((4, FAR)), RIGHT_ANGLE * rng.random((4, FAR))
    small = 10 ** rng.uniform(-12, 0, (4, FAR))
    far[0][0] *= small[0]
    far[0][1] *= 1 - small[1]
    far[1][2] *= small[2]
    far[1][3] *= 1 - small[3]
    v_all, a_all = np.concatenate([*v, far[0].ravel()]), np.concatenate([*a0, far[1].ravel()])
    return np.minimum(v_all, v_max), np.minimum(a_all, RIGHT_ANGLE)


def largest_errors(
    way: Function, exact: Function, v: FloatArray, a0: FloatArray, v_max: float
) -> FloatArray:
    """The largest relative error in each cell."""
    worst = np.zeros(SHAPE)
    for first in range(0, v.size, 1 << 16):
        v_, a_ = v[first : first + (1 << 16)], a0[first : first + (1 << 16)]
        truth = exact(v_, a_)
        error = np.abs(way(v_, a_) - truth) / np.where(truth == 0, 1.0, np.abs(truth))
        np.maximum.at(worst, dial.cell(v_, a_, v_max, SHAPE), error)
    return worst


def _upward(value: float) -> float:
    """Three digits, never less than the value."""
    return float(f"{1.005 * value:.2e}")


def _json(found: dict[str, Any]) -> str:
    """JSON with each row of a table on a line."""
    rows: list[str] = []

    def fold(part: Any) -> Any:
        if isinstance(part, dict):
            return {key: fold(value) for key, value in part.items()}
        if isinstance(part, list) and part and isinstance(part[0], float):
            rows.append(json.dumps(part))
            return f"row {len(rows) - 1}"
        return [fold(value) for value in part] if isinstance(part, list) else part

    text = json.dumps(fold(found), indent=1)
    for number, row in enumerate(rows):
        text = text.replace(f'"row {number}"', row, 1)
    return text + "\n"


def write(
    folder: Path, *, force: bool = False, progress: Progress = lambda words: None
) -> list[Path]:
    """Build the surrogate, measure the tiers, and write both files.

    Parameters
    ----------
    folder : path
        Where to write; `FileExistsError` if a file is there, unless `force`.
    force : bool, optional
        Replace existing files.
    progress : callable, optional
        Called with a line of words now and then.

    Returns
    -------
    list of pathlib.Path
        The files written.
    """
    targets = [folder / name for name in FILES]
    check_targets(*targets, force=force)
    content = build()
    progress(f"surrogate built, {len(content) / 1e3:.0f} kB; measuring the tiers")
    text = bounds(content, progress=progress)
    return [
        write_whole(targets[0], content, force=force),
        write_whole(targets[1], text, force=force),
    ]


# --- the candidates ------------------------------------------------------------------------


class Candidate(NamedTuple):
    """A way to d_norm, measured."""

    quantity: str
    variables: str
    interpolator: str
    coefficients: int
    error: float  # largest, relative
    microseconds: float  # a launch, median


_SPEEDS: dict[str, Callable[[FloatArray], FloatArray]] = {
    "v": lambda v: v,
    "X": lambda v: np.asarray(np.log(1 + v * v)),
}
_ANGLES: dict[str, Callable[[FloatArray], FloatArray]] = {
    "alpha0": lambda a0: a0,
    "Y by cos^(1/2)": lambda a0: _opened(a0, np.sqrt(np.cos(a0))),
    "Y": lambda a0: _opened(a0, np.sqrt(np.sqrt(np.cos(a0)))),
}
_THERE: dict[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    "d_norm": lambda d, v, a0: d,
    "ln d_norm": lambda d, v, a0: np.asarray(np.log(d)),
    "S": lambda d, v, a0: -np.log(d) / surrogate.scale(v, np.sin(a0)),
}
_BACK: dict[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    "d_norm": lambda f, v, a0: f,
    "ln d_norm": lambda f, v, a0: np.asarray(np.exp(f)),
    "S": lambda f, v, a0: np.asarray(np.exp(-f * surrogate.scale(v, np.sin(a0)))),
}
_CANDIDATES = (
    ("d_norm", "v", "alpha0", "quintic, map_coordinates", surrogate.CELLS),
    ("d_norm", "X", "alpha0", "quintic, map_coordinates", surrogate.CELLS),
    ("ln d_norm", "X", "alpha0", "quintic, map_coordinates", surrogate.CELLS),
    ("S", "X", "alpha0", "quintic, map_coordinates", surrogate.CELLS),
    ("S", "X", "Y by cos^(1/2)", "quintic, map_coordinates", surrogate.CELLS),
    ("ln d_norm", "X", "Y", "quintic, map_coordinates", surrogate.CELLS),
    ("S", "X", "Y", "cubic, map_coordinates", surrogate.CELLS),
    ("S", "X", "Y", "cubic, map_coordinates", (120, 360)),
    ("S", "X", "Y", "quintic, NdBSpline", surrogate.CELLS),
    ("S", "X", "Y", "Chebyshev series, chebval2d", (24, 64)),
    ("S", "X", "Y", "quintic, map_coordinates", surrogate.CELLS),
)


def compare(*, progress: Progress = lambda words: None) -> list[Candidate]:
    """Error, size and cost of ways to interpolate d_norm; the chosen one and the engine last.

    Parameters
    ----------
    progress : callable, optional
        Called with a line of words now and then.

    Returns
    -------
    list of Candidate
        One row for each: the largest error, and the median time in one run, on some 10^5 launches.
    """
    v, a0 = (part[::16].copy() for part in points(surrogate.V_MAX))
    truth = np.asarray(d_norm(v, a0))
    tables = surrogate.parse(build())
    ways: list[tuple[str, str, str, int, Function]] = []
    for quantity, speed, angle, interpolator, cells in _CANDIDATES:
        progress(f"fitting {quantity} over {speed}, {angle}: {interpolator}")
        way, count = _candidate(quantity, speed, angle, interpolator, cells)
        ways.append((quantity, f"{speed}, {angle}", interpolator, count, way))
    library = _by_blocks(lambda v, a0: surrogate.flat_d_norm(v, a0, tables))
    ways.append(("d_norm", "v, alpha0", "as in the library", tables.S.size, library))
    ways.append(("d_norm", "v, alpha0", "none: the exact engine", 0, d_norm))

    progress("measuring")
    costs = _costs([way[4] for way in ways], v, a0)
    return [
        Candidate(*way[:4], float(np.max(np.abs(way[4](v, a0) / truth - 1))), float(cost))
        for way, cost in zip(ways, costs, strict=True)
    ]


def comparison(rows: list[Candidate]) -> str:
    """The candidates as CSV."""
    lines = [
        f"# ways to interpolate d_norm, v_norm <= {surrogate.V_MAX:g}; hodograph "
        f"{version('hodograph')}; times are this machine's",
        f"# remade by: {COMPARE}",
        "quantity,variables,interpolator,coefficients,largest_error,us_per_launch",
    ]
    lines += [
        f'{row.quantity},"{row.variables}","{row.interpolator}",{row.coefficients},'
        f"{row.error:.1e},{row.microseconds:.3g}"
        for row in rows
    ]
    return "\n".join(lines) + "\n"


def settings(*, progress: Progress = lambda words: None) -> str:
    """What each setting of the dial reaches and costs, as CSV.

    Parameters
    ----------
    progress : callable, optional
        Called with a line of words now and then.

    Returns
    -------
    str
        For each rtol, the largest v_norm below which the law serves at every angle, the same for
        the surrogate, and the median microseconds a launch for three sets of random launches;
        last, the exact engine, from the same run.
    """
    rng = np.random.default_rng(SEED)
    ways: list[Function] = [partial(d_norm, rtol=rtol) for rtol in RTOL]
    columns = []
    for v_max in REACHES:
        progress(f"timing {MANY} launches, v_norm <= {v_max:g}")
        v, a0 = v_max * rng.random(MANY), RIGHT_ANGLE * rng.random(MANY)
        columns.append(_costs([*ways, d_norm], v, a0))
    lines = [
        f"# d_norm(v_norm, alpha0, rtol=...); hodograph {version('hodograph')}; {MANY} random "
        "launches at once, times are this machine's",
        f"# remade by: {COMPARE}",
        "rtol,law_up_to_v_norm,surrogate_up_to_v_norm,"
        + ",".join(f"us_v_norm_to_{v_max:g}" for v_max in REACHES),
    ]
    for rtol, *costs in zip((*RTOL, None), *columns, strict=True):
        reach = [_reach(name, rtol) for name in dial.V_MAX]
        words = "exact" if rtol is None else f"{rtol:.0e}"
        lines.append(",".join([words, *(f"{x:.3g}" for x in (*reach, *costs))]))
    return "\n".join(lines) + "\n"


def _reach(name: str, rtol: float | None) -> float:
    """The v_norm up to which a tier serves at every angle."""
    if rtol is None:
        return 0.0
    serves = (dial.bounds()[name] <= rtol).all(axis=1)
    rows = int(np.argmin(np.append(serves, False)))
    return float(dial.V_MAX[name] * (rows / serves.size) ** 2)


def _costs(ways: list[Function], v: FloatArray, a0: FloatArray) -> list[float]:
    """Microseconds a launch, medians."""
    spent = clock.in_turn([partial(way, v, a0) for way in ways], ROUNDS)
    return [1e6 * statistics.median(own.values()) / v.size for own in spent]


def _opened(a0: FloatArray, steep: FloatArray) -> FloatArray:
    return np.asarray(np.log(1 + surrogate.STRETCH * np.sin(a0)) + surrogate.STEEP * (1 - steep))


def _candidate(
    quantity: str, speed: str, angle: str, interpolator: str, cells: tuple[int, int]
) -> tuple[Function, int]:
    """A function of flat launches, and the number of its coefficients."""
    from numpy.polynomial import chebyshev
    from scipy.interpolate import NdBSpline
    from scipy.ndimage import map_coordinates

    top_x = _SPEEDS[speed](np.array(surrogate.V_MAX))
    top_y = _ANGLES[angle](np.array(RIGHT_ANGLE))

    def place(v: FloatArray, a0: FloatArray) -> tuple[FloatArray, FloatArray]:
        return np.minimum(_SPEEDS[speed](v) / top_x, 1.0), np.minimum(
            _ANGLES[angle](a0) / top_y, 1.0
        )

    nodes = [_gauss(n) for n in cells]
    v_nodes = inverse_axis((lambda part: place(AXES[0][1](part), part)[0], AXES[0][1]), nodes[0])
    a_nodes = inverse_axis((lambda part: place(part, _angle(part))[1], _angle), nodes[1])
    v, a0 = np.meshgrid(v_nodes, a_nodes, indexing="ij")
    values = _THERE[quantity](np.asarray(d_norm(v, a0)), v, a0)

    if interpolator.startswith("Chebyshev"):
        for axis, (n, at) in enumerate(zip(cells, nodes, strict=True)):
            matrix = np.linalg.pinv(chebyshev.chebvander(2 * at - 1, n))
            values = np.moveaxis(np.tensordot(matrix, values, (1, axis)), 0, axis)
        table = values

        def interpolate(x: FloatArray, y: FloatArray) -> FloatArray:
            return np.asarray(chebyshev.chebval2d(2 * x - 1, 2 * y - 1, table))

    else:
        order = 3 if interpolator.startswith("cubic") else 5
        table = spline(values, cells, order)
        if interpolator.endswith("NdBSpline"):
            knots = tuple(np.arange(-order, n + order + 1) / n for n in cells)
            fitted = NdBSpline(knots, table, order)

            def interpolate(x: FloatArray, y: FloatArray) -> FloatArray:
                return np.asarray(fitted(np.stack([x, y], axis=-1)))

        else:

            def interpolate(x: FloatArray, y: FloatArray) -> FloatArray:
                at = np.stack([x * cells[0], y * cells[1]]) + (order - 1) // 2
                return np.asarray(
                    map_coordinates(table, at, order=order, prefilter=False, mode="nearest")
                )

    return _by_blocks(lambda v, a0: _BACK[quantity](interpolate(*place(v, a0)), v, a0)), table.size


def _by_blocks(kernel: Function) -> Function:
    def way(v: FloatArray, a0: FloatArray) -> FloatArray:
        result = np.empty_like(v)
        for first in range(0, v.size, surrogate.BLOCK):
            block = slice(first, first + surrogate.BLOCK)
            result[block] = kernel(v[block], a0[block])
        return result

    return way
