"""Ways to interpolate d_norm compared, and the settings of the dial.

``hodograph surrogate --compare`` measures the interpolation that `surrogate` uses beside others,
and what each tolerance asked of `dial` costs.
"""

import logging
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from hodograph.builders.certificate import SEED, Function, by_blocks, points
from hodograph.builders.surrogate import AXES, build, gauss, inverse_axis, spline
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.level import d_norm
from hodograph.report import clock, tables
from hodograph.tiers import dial, interpolant

log = logging.getLogger("hodograph")
COMPARISON, SETTINGS = "surrogate.csv", "dial.csv"  # in data/
COMMAND = "hodograph surrogate --compare --out data --force"
ROUNDS = 15  # in which ways are timed, one after another
MANY = 100_000  # launches timed at once
RTOL = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13)
DOMAINS = (1.5, 10.0, 20.0)  # of v_norm, from 0: where the dial is timed


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
# What is interpolated, from d_norm; and d_norm from that.
_THERE: dict[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    "d_norm": lambda d, v, a0: d,
    "ln d_norm": lambda d, v, a0: np.asarray(np.log(d)),
    "S": lambda d, v, a0: -np.log(d) / interpolant.scale(v, np.sin(a0)),
}
_BACK: dict[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    "d_norm": lambda f, v, a0: f,
    "ln d_norm": lambda f, v, a0: np.asarray(np.exp(f)),
    "S": lambda f, v, a0: np.asarray(np.exp(-f * interpolant.scale(v, np.sin(a0)))),
}
_CANDIDATES = (
    ("d_norm", "v", "alpha0", "quintic, map_coordinates", interpolant.CELLS),
    ("d_norm", "X", "alpha0", "quintic, map_coordinates", interpolant.CELLS),
    ("ln d_norm", "X", "alpha0", "quintic, map_coordinates", interpolant.CELLS),
    ("S", "X", "alpha0", "quintic, map_coordinates", interpolant.CELLS),
    ("S", "X", "Y by cos^(1/2)", "quintic, map_coordinates", interpolant.CELLS),
    ("ln d_norm", "X", "Y", "quintic, map_coordinates", interpolant.CELLS),
    ("S", "X", "Y", "cubic, map_coordinates", interpolant.CELLS),
    ("S", "X", "Y", "cubic, map_coordinates", (120, 360)),
    ("S", "X", "Y", "quintic, NdBSpline", interpolant.CELLS),
    ("S", "X", "Y", "Chebyshev series, chebval2d", (24, 64)),
    ("S", "X", "Y", "quintic, map_coordinates", interpolant.CELLS),
)


def compare() -> list[Candidate]:
    """Error, size and cost of ways to interpolate d_norm; the chosen one and the engine last.

    The largest error, and the median time in one run, on some 10^5 launches.
    """
    near = points().up_to(interpolant.V_MAX)
    v, a0 = near.v[::32].copy(), near.a0[::32].copy()
    truth = np.asarray(d_norm(v, a0))
    chosen = interpolant.parse(build())
    ways: list[tuple[str, str, str, int, Function]] = []
    for quantity, speed, angle, interpolator, cells in _CANDIDATES:
        log.info(f"fitting {quantity} over {speed}, {angle}: {interpolator}")
        way, count = _candidate(quantity, speed, angle, interpolator, cells)
        ways.append((quantity, f"{speed}, {angle}", interpolator, count, way))
    library = by_blocks(lambda v, a0: interpolant.flat_d_norm(v, a0, chosen))
    ways.append(("d_norm", "v, alpha0", "as in the library", chosen.S.size, library))
    ways.append(("d_norm", "v, alpha0", "none: the exact engine", 0, d_norm))

    log.info("measuring")
    costs = _costs([way[4] for way in ways], v, a0)
    return [
        Candidate(*way[:4], float(np.max(np.abs(way[4](v, a0) / truth - 1))), float(cost))
        for way, cost in zip(ways, costs, strict=True)
    ]


def comparison(rows: list[Candidate]) -> str:
    """The candidates as CSV."""
    about = (
        f"ways to interpolate d_norm, v_norm <= {interpolant.V_MAX:g}; times are this machine's",
    )
    heads = (*Candidate._fields[:4], "largest_error", "us_per_launch")
    cells = [(*row[:4], f"{row.error:.1e}", f"{row.microseconds:.3g}") for row in rows]
    return tables.csv_text(about, heads, cells, command=COMMAND)


def settings() -> str:
    """What each setting of the dial reaches and costs, as CSV.

    For each rtol and each cheap tier, the v_norm up to which it is good enough at every angle; then
    the median microseconds a launch for three sets of random launches.  Last, the exact engine.
    """
    rng = np.random.default_rng(SEED)
    ways: list[Function] = [partial[FloatArray](d_norm, rtol=rtol) for rtol in RTOL]
    columns = []
    for v_max in DOMAINS:
        log.info(f"timing {MANY} launches, v_norm <= {v_max:g}")
        v, a0 = v_max * rng.random(MANY), RIGHT_ANGLE * rng.random(MANY)
        columns.append(_costs([*ways, d_norm], v, a0))
    rows = []
    for rtol, *costs in zip((*RTOL, None), *columns, strict=True):
        ends = [0.0] * len(dial.V_MAX) if rtol is None else _ends(rtol)
        words = "exact" if rtol is None else f"{rtol:.0e}"
        rows.append([words, *(f"{x:.3g}" for x in (*ends, *costs))])
    about = (
        f"d_norm(v_norm, alpha0, rtol=...); {MANY} random launches at once, times are this "
        "machine's",
    )
    heads = (
        "rtol",
        *(f"{name}_up_to_v_norm" for name in dial.V_MAX),
        *(f"us_v_norm_to_{v_max:g}" for v_max in DOMAINS),
    )
    return tables.csv_text(about, heads, rows, command=COMMAND)


def _ends(rtol: float) -> list[float]:
    """The v_norm up to which each cheap tier is good enough at every angle."""
    rows = [int(np.argmin(np.append(own.all(axis=1), False))) for own in dial.serves(rtol)[:-1]]
    return [n / (dial.ROWS - n) if n < dial.ROWS else dial.LAW_ALL_V_MAX for n in rows]


def _costs(ways: list[Function], v: FloatArray, a0: FloatArray) -> list[float]:
    """Microseconds a launch, medians."""
    spent = clock.medians([partial(way, v, a0) for way in ways], ROUNDS)
    return [1e6 * seconds / v.size for seconds in spent]


def _opened(a0: FloatArray, steep: FloatArray) -> FloatArray:
    """Y of `interpolant.coordinates` for another root of the cosine, not yet divided."""
    return np.asarray(
        np.log(1 + interpolant.STRETCH * np.sin(a0)) + interpolant.STEEP * (1 - steep)
    )


def _candidate(
    quantity: str, speed: str, angle: str, interpolator: str, cells: tuple[int, int]
) -> tuple[Function, int]:
    """A function of flat launches, and the number of its coefficients."""
    from numpy.polynomial import chebyshev
    from scipy.interpolate import NdBSpline
    from scipy.ndimage import map_coordinates

    top_x = _SPEEDS[speed](np.array(interpolant.V_MAX))
    top_y = _ANGLES[angle](np.array(RIGHT_ANGLE))

    def place(v: FloatArray, a0: FloatArray) -> tuple[FloatArray, FloatArray]:
        return np.minimum(_SPEEDS[speed](v) / top_x, 1.0), np.minimum(
            _ANGLES[angle](a0) / top_y, 1.0
        )

    nodes = [gauss(n) for n in cells]
    v_nodes = inverse_axis((lambda part: place(AXES[0][1](part), part)[0], AXES[0][1]), nodes[0])
    a_nodes = inverse_axis((lambda part: place(part, AXES[1][1](part))[1], AXES[1][1]), nodes[1])
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

    return by_blocks(lambda v, a0: _BACK[quantity](interpolate(*place(v, a0)), v, a0)), table.size
