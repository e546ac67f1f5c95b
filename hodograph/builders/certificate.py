"""The certificate: every cheap tier of the dial measured, cell by cell.

``hodograph surrogate`` writes the two files that the package carries: surrogate.npz, the spline
coefficients of `surrogate`, and bounds.json, the error bounds that `dial` goes by.
"""

import hashlib
import json
import logging
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph import laws
from hodograph.builders.surrogate import AXES, COMMAND, build, inverse_axis
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.level import d_norm, landing_angle
from hodograph.report import folder
from hodograph.report.versions import STAMP
from hodograph.tiers import dial, interpolant

Function = Callable[[FloatArray, FloatArray], FloatArray]

log = logging.getLogger("hodograph")
FILES = (interpolant.FILE, dial.FILE)
MARGIN = 1.25  # a bound is this times the largest error found, and the engine's own 1e-13
INSIDE, ALONG = 32, 64  # points: per side of a cell of the bounds, per edge of it
SPLINE = 11  # per side of a cell of the spline
FAR = 50_000  # towards each end of the domain
SEED = 2008


class Points(NamedTuple):
    """Launches to measure on, and the cell of `dial` that each belongs to."""

    v: FloatArray
    a0: FloatArray
    row: NDArray[np.intp]
    column: NDArray[np.intp]

    def up_to(self, v_max: float) -> "Points":
        """The launches within a tier that ends at `v_max`."""
        inside = self.v <= v_max
        last = dial.cell(np.array(v_max * (1 - 1e-9)), np.array(0.0))[0]
        row = np.minimum(self.row[inside], last)
        return Points(self.v[inside], self.a0[inside], row, self.column[inside])


def bounds(content: bytes) -> str:
    """The text of bounds.json for the surrogate `content`: the error of each cheap tier, by cell.

    A bound is `MARGIN` times the largest error found in the cell, see `points`, plus the 1e-13 of
    the engine.  For the landing angle, where there is no dial, one bound is kept for all cells.
    """
    tables = interpolant.parse(content)
    ways: dict[str, Function] = {
        "law": laws.d_norm_law,
        "law_all": laws.d_norm_law_all,
        "surrogate": partial(interpolant.flat_d_norm, tables=tables),
    }
    everywhere = points()
    log.info(f"the exact engine on {everywhere.v.size} points")
    truth = d_norm(everywhere.v, everywhere.a0)
    tiers: dict[str, Any] = {}
    for name, way in ways.items():
        v_max = dial.V_MAX[name]
        near = everywhere.up_to(v_max)
        worst = largest_errors(way, near, truth[everywhere.v <= v_max])
        rows = int(near.row.max()) + 1
        table = [[_bound(error) for error in row] for row in worst[:rows].tolist()]
        tiers[name] = _summary(v_max, near, max(map(max, table))) | {"bounds": table}
        log.info(f"d_norm, {name}: {_words(tiers[name])}")

    near = everywhere.up_to(interpolant.V_MAX)
    way = partial(interpolant.flat_landing_angle, tables=tables)
    worst = largest_errors(way, near, landing_angle(near.v, near.a0))
    landing = _summary(interpolant.V_MAX, near, _bound(float(worst.max())))
    log.info(f"landing_angle, surrogate: {_words(landing)}")
    return _json(
        {
            "about": "bounds on the relative error, remade by: " + COMMAND,
            "engine": STAMP,
            "surrogate_sha256": hashlib.sha256(content).hexdigest(),
            "margin": MARGIN,
            "engine_error": dial.PROMISE,
            "points_per_spline_cell": int(per_spline_cell(near.v, near.a0).min()),
            "cells": f"rows: uniform in v_norm / (1 + v_norm), {dial.ROWS} from 0 to 1; "
            "columns: in alpha0, 0 to pi/2",
            "d_norm": tiers,
            "landing_angle": {"surrogate": landing},
        }
    )


def points() -> Points:
    """Launches to measure on, none of them used in fitting, up to v_norm = 1e20.

    Every cell of the dial, and of the surrogate's spline, holds jittered points in its inside;
    those of the dial also hold points along their edges, and their corners.  More crowd, on
    logarithmic scales, towards rest, the ends of the tiers, level and vertical launch.
    """
    rng = np.random.default_rng(SEED)
    cells = dial.ROWS * dial.COLUMNS
    row, column = np.divmod(np.arange(cells).reshape(-1, 1), dial.COLUMNS)
    places = [_jittered(rng, cells, INSIDE)]  # in each cell, from 0 to 1
    for end in (0.0, 1.0):
        free, fixed = rng.random((cells, ALONG)), np.full((cells, ALONG), end)
        free[:, :2] = 0.0, 1.0
        places += [(free, fixed), (fixed, free)]
    found = []
    for down, across in places:
        left = np.maximum(dial.ROWS - row - down, dial.ROWS / dial.LAW_ALL_V_MAX)
        a0 = (column + across) * (RIGHT_ANGLE / dial.COLUMNS)
        found.append(((row + down) / left, a0, row, column))

    i, j = np.divmod(np.arange(np.prod(interpolant.CELLS)).reshape(-1, 1), interpolant.CELLS[1])
    down, across = _jittered(rng, i.size, SPLINE)
    own = (
        inverse_axis(AXES[0], (i + down) / interpolant.CELLS[0]),
        inverse_axis(AXES[1], (j + across) / interpolant.CELLS[1]),
    )
    for v, a0 in (own, *_towards_the_ends(rng)):
        v, a0 = np.minimum(v, dial.LAW_ALL_V_MAX), np.minimum(a0, RIGHT_ANGLE)
        found.append((v, a0, *dial.cell(v, a0)))
    flat = [[part.ravel() for part in np.broadcast_arrays(*parts)] for parts in found]
    v, a0, row, column = (np.concatenate(parts) for parts in zip(*flat, strict=True))
    return Points(v, a0, row, column)


def _jittered(rng: np.random.Generator, cells: int, side: int) -> tuple[FloatArray, FloatArray]:
    """Random places in each cell, from 0 to 1: one in each square of a grid."""
    down, across = np.divmod(np.arange(side**2), side)
    size = (cells, side**2)
    return (down + rng.random(size)) / side, (across + rng.random(size)) / side


def _towards_the_ends(rng: np.random.Generator) -> list[tuple[FloatArray, FloatArray]]:
    def part() -> FloatArray:
        return rng.random(FAR)

    def small(decades: float) -> FloatArray:
        return np.asarray(10 ** rng.uniform(-decades, 0, FAR))

    v_max = interpolant.V_MAX
    return [
        (v_max * small(12), RIGHT_ANGLE * part()),
        (dial.V_MAX["law"] * (1 - small(12)), RIGHT_ANGLE * part()),
        (v_max * (1 - small(12)), RIGHT_ANGLE * part()),
        (v_max * part(), RIGHT_ANGLE * small(12)),
        (v_max * part(), RIGHT_ANGLE * (1 - small(12))),
        (dial.LAW_ALL_V_MAX * small(20), RIGHT_ANGLE * part()),
        (dial.LAW_ALL_V_MAX * small(20), RIGHT_ANGLE * small(300)),
        (dial.LAW_ALL_V_MAX * small(20), RIGHT_ANGLE * (1 - small(12))),
    ]


def per_spline_cell(v: FloatArray, a0: FloatArray) -> NDArray[np.intp]:
    """How many launches lie in each cell of the surrogate's spline."""
    at = interpolant.coordinates(v, np.sin(a0), np.cos(a0))
    edges = [np.linspace(0, 1, n + 1) for n in interpolant.CELLS]
    return np.asarray(np.histogram2d(*at, bins=edges)[0], np.intp)


def largest_errors(way: Function, on: Points, truth: FloatArray) -> FloatArray:
    """The largest relative error in each cell of the dial."""
    error = np.abs(by_blocks(way)(on.v, on.a0) - truth) / np.where(truth == 0, 1.0, np.abs(truth))
    worst = np.zeros((dial.ROWS, dial.COLUMNS))
    np.maximum.at(worst, (on.row, on.column), error)
    return worst


def by_blocks(kernel: Function) -> Function:
    """The same over many flat launches, as many at a time as fit the cache."""

    def way(v: FloatArray, a0: FloatArray) -> FloatArray:
        result = np.empty_like(v)
        for first in range(0, v.size, interpolant.BLOCK):
            block = slice(first, first + interpolant.BLOCK)
            result[block] = kernel(v[block], a0[block])
        return result

    return way


def _summary(v_max: float, on: Points, largest: float) -> dict[str, Any]:
    return {"v_max": v_max, "points": on.v.size, "largest": largest}


def _words(tier: dict[str, Any]) -> str:
    return "at most {largest:.2e} on {points} points, v_norm <= {v_max:g}".format(**tier)


def _bound(error: float) -> float:
    return float(f"{1.005 * (MARGIN * error + dial.PROMISE):.2e}")  # three digits, never less


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


def write(out: str | os.PathLike[str], *, force: bool = False) -> list[Path]:
    """Build the surrogate, measure the tiers, and write both files into the folder `out`.

    `FileExistsError` before the computation if a file is there, unless `force`.
    """
    folder.check(out, FILES, force=force)
    content = build()
    log.info(f"surrogate built, {len(content) / 1e3:.0f} kB; measuring the tiers")
    text = bounds(content)
    return folder.write(out, {interpolant.FILE: content, dial.FILE: text}, force=force)
