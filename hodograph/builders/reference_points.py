"""Reference points: answers computed to 30 digits, kept in ``data/reference*.csv``.

The inputs are laid out by rule, not drawn: log-spaced in v_norm, dense near 0 and 90 degrees,
from below the horizon, to landings below and above the launch, to targets just under the
apex, and for drag exponents from 1 to 10.  Each is written with all its digits, so that it reads
back as the same double.

Each of the first functions yields rows of the inputs that its `Table` names: v_norm, alpha0 in
radians, the launch height in units of v_lim^2 / g, and others.
"""

import logging
import os
from collections.abc import Callable, Iterable, Iterator
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import mpmath
import numpy as np

from hodograph import reference
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.report import folder, tables

log = logging.getLogger("hodograph")

DIGITS = 30
INPUTS = ("v_norm", "alpha0", "height")
OUTPUTS = ("x", "t", "alpha", "speed", "arc_length", "apex_x", "apex_y", "apex_t")
COMMAND = "hodograph reference --out data --force"
POWERS = (1.0, 1.0000001, 1.2, 1.5, 2.5, 3.0, 4.7, 7.0, 8.8, 10.0)
PATH_POWERS = (1.0, 1.5, 2.0, 3.0, 5.5, 10.0)


class Inputs(NamedTuple):
    """A launch."""

    v_norm: float
    alpha0: float
    height: float


def inputs() -> Iterator[Inputs]:
    """The launches, in the order of the file."""
    near_zero = [1e-8, 1e-6, 1e-4, 1e-2]
    degrees = [0.1, 1, 2, 5, 10, 20, 30, 40, 45, 50, 60, 70, 80, 85, 88, 89, 89.9, 89.99]
    near_right = [1e-4, 1e-6, 1e-9, 1e-12, 0.0]
    angles = [
        *near_zero,
        *(float(np.deg2rad(d)) for d in degrees),
        *(float(np.pi / 2 - less) for less in near_right),
    ]
    speeds = [float(v) for v in 10.0 ** np.arange(-8, 9)] + [0.3, 0.7, 1.5, 3.0, 20.0]
    for v, a in product(speeds, angles):
        yield Inputs(v, a, 0.0)

    slopes = [-89.99, -80.0, -45.0, -5.0, -1e-3, 0.0, 1e-3, 5.0, 45.0, 80.0, 89.99, 90.0]
    for v, d, fall in product([1e-3, 0.1, 1.0, 4.0, 50.0, 1e4, 1e8], slopes, [1e-3, 0.5, 30.0]):
        yield Inputs(v, float(np.deg2rad(d)), fall * min(v * v, 1.0))

    for v, d, below in product([0.01, 1.0, 30.0], [1.0, 45.0, 89.0], [0.5, 1e-3, 1e-6, 1e-8]):
        a = float(np.deg2rad(d))
        apex = reference.position(v, a, 0.0).y
        yield Inputs(v, a, -float(apex) * (1 - below))


def powers() -> Iterator[tuple[float, ...]]:
    """Flights under drag of other powers: level ground, then from heights, downward and deep."""
    level = product([1e-8, 0.3, 3.0, 170.0, 1e8, 1e15], [1e-6, 0.8, 1.5, RIGHT_ANGLE], [0.0])
    others = [
        (1e-8, -0.5, 1e-3), (1e-3, RIGHT_ANGLE, 1e6), (0.01, -RIGHT_ANGLE, 1e15), (0.5, 0.0, 1.0),
        (3.0, -1e-3, 0.5), (5.0, 1.4, 1e4), (20.0, 1.0, 1e12), (50.0, -0.8, 30.0),
        (117.5, RIGHT_ANGLE, 3.0), (170.6, -1.5634, 40.5), (1e4, 0.0, 1e-3), (1e6, -0.03, 1.5),
        (1e15, 0.0, 5.0), (1e15, -RIGHT_ANGLE, 1e3),
    ]  # fmt: skip
    for n, launch in product(POWERS, [*level, *others]):
        yield (n, *launch)


def fast() -> Iterator[tuple[float, ...]]:
    """Fast level and downward launches from a height."""
    speeds = [10.0, 30.0, 100.0, 1e3, 4e4, 1e6, 1e8, 1e12, 1e15]
    slopes = [0.0, -1e-9, -6e-3, -0.03, -0.3, -RIGHT_ANGLE]
    yield from product(speeds, slopes, [1e-12, 1e-4, 0.05, 0.4, 1.6, 1e4])
    yield (197.5231124258319, -0.026599613257534446, 0.4118057052418254)
    yield (5644.39991849538, -0.03150044740382925, 1.578214529167767)
    yield (39968.155570445866, -0.006234685538124483, 0.049451010890182695)
    yield (1.1e12, 0.0, 5.17)


def apex() -> Iterator[tuple[float, ...]]:
    """Targets under the apex, from a hundredth of its height to one double below it."""
    launches = [(1e-3, 0.8), (1.0, 0.1), (2.5692, 0.14446), (50.0, 1.3), (1e6, 0.5)]
    for n, (v, a) in product([1.0, 1.5, 2.0, 3.0, 10.0], launches):
        top = reference.position(v, a, 0.0, n=n).y
        last = float(top)
        if last >= top:
            last = float(np.nextafter(last, 0.0))
        for doubles in (0, 1, 2, 10, 100):
            yield (n, v, a, doubles * float(np.spacing(last)) - last)
        for below in (1e-10, 1e-6, 1e-2):
            yield (n, v, a, -last * (1 - below))


def interior() -> Iterator[tuple[float, ...]]:
    """Points inside paths, by their slopes; launches straight up among them."""
    steep = [RIGHT_ANGLE - less for less in (1e-12, 1e-6, 1e-3)]
    down = [-(RIGHT_ANGLE - less) for less in (1e-3, 1e-9)]
    for n, v, alpha in product(PATH_POWERS, [0.5, 117.5, 1e6], [*steep, 0.0, *down]):
        yield (n, v, RIGHT_ANGLE, alpha)
    launches = [(1e-3, 0.5), (3.0, 1.2), (50.0, -0.3)]
    for n, (v, a), part in product(PATH_POWERS, launches, [1e-9, 0.01, 0.3, 0.6, 0.99]):
        yield (n, v, a, a - part * (a + RIGHT_ANGLE))


def along() -> Iterator[tuple[float, ...]]:
    """Points at odd eighths of the arc length of a flight."""
    launches = [(117.5, RIGHT_ANGLE, 3.0), (3.0, 1.2, 0.0), (1e4, 0.5, 1.0), (50.0, -0.3, 2.0)]
    for n, launch, part in product(PATH_POWERS, launches, [0.125, 0.375, 0.625, 0.875]):
        yield (n, *launch, part)


def sensitive() -> Iterator[tuple[float, ...]]:
    """Launches whose range is differentiated: vertical, steep, level, downward, ordinary."""
    yield from product([float(v) for v in 10.0 ** np.arange(-2, 9)], [RIGHT_ANGLE], [0.0, 1.0])
    yield from product([0.1, 1.0, 10.0, 1e3, 1e5], [-1.57, -1.5, -0.5, 0.0], [1e-3, 1.0, 30.0])
    yield from product([1e-3, 0.5, 1.5, 20.0], [0.02, 0.5, 0.8, 1.3], [0.0, 0.1])
    yield from product([1e2, 1e4, 1e7], [1.2, 1.5, 1.5707], [0.0])


class Table(NamedTuple):
    """One file: what it holds, its columns, its inputs, and what computes the rest."""

    file: str
    about: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    rows: Callable[[], Iterable[tuple[float, ...]]]
    solve: Callable[..., Any]


def _power_flight(n: float, v: float, alpha0: float, height: float) -> reference.Flight:
    return reference.flight(v, alpha0, height, n=n, dps=DIGITS)


def _point(n: float, v: float, alpha0: float, alpha: float) -> reference.Position:
    return reference.position(v, alpha0, alpha, n=n, dps=DIGITS)


def _part(n: float, v: float, alpha0: float, height: float, part: float) -> reference.Position:
    whole = reference.flight(v, alpha0, height, n=n, dps=DIGITS + 10).arc_length
    with mpmath.workdps(DIGITS + 10):
        s = whole * part
    return reference.position(v, alpha0, s=s, n=n, dps=DIGITS)


def _flight(v: float, alpha0: float, height: float) -> reference.Flight:
    return reference.flight(v, alpha0, height, dps=DIGITS)


def _slopes(v: float, alpha0: float, height: float) -> dict[str, Any]:
    found = reference.sensitivity(v, alpha0, height, dps=DIGITS)
    slopes = ("alpha0", "v0", "v_lim", "height")
    return {"range": found.range, **{f"d_{name}": getattr(found, name) for name in slopes}}


POWER_INPUTS = ("n", *INPUTS)
TABLES = (
    Table("reference.csv", "flights under quadratic drag",
          INPUTS, OUTPUTS, lambda: inputs(), _flight),
    Table("reference_power.csv", "flights under drag of the n-th power of the speed",
          POWER_INPUTS, OUTPUTS, powers, _power_flight),
    Table("reference_fast.csv",
          "fast level and downward launches from a height under quadratic drag",
          INPUTS, OUTPUTS, fast, _flight),
    Table("reference_apex.csv", "flights to targets under the apex",
          POWER_INPUTS, OUTPUTS, apex, _power_flight),
    Table("reference_points.csv", "points of paths where the slope is alpha, from the launch",
          ("n", "v_norm", "alpha0", "alpha"), ("x", "y", "t", "speed", "arc_length"),
          interior, _point),
    Table("reference_paths.csv", "points at a part of the arc length of a flight, from the launch",
          (*POWER_INPUTS, "part"), ("x", "y", "t", "alpha", "speed", "arc_length"),
          along, _part),
    Table("reference_sensitivity.csv",
          "the range under quadratic drag and its derivatives in alpha0, v0, v_lim and height",
          INPUTS, ("range", "d_alpha0", "d_v0", "d_v_lim", "d_height"), sensitive, _slopes),
)  # fmt: skip


def text(table: Table) -> str:
    """The CSV file of one of `TABLES`, every row computed."""
    about = (
        f"{table.about} to {DIGITS} digits, by hodograph.reference",
        "units: lengths v_lim^2/g, times v_lim/g, speeds v_lim, angles in radians",
    )
    heads = (*table.inputs, *table.outputs)
    return tables.csv_text(about, heads, _rows(table), command=COMMAND, by="")


def _rows(table: Table) -> Iterator[list[str]]:
    rows = list(table.rows())
    for number, row in enumerate(rows, start=1):
        found = table.solve(*row)
        values = found if isinstance(found, dict) else vars(found)
        digits = [mpmath.nstr(values[name], DIGITS) for name in table.outputs]
        yield [*map(repr, row), *digits]
        if number % 50 == 0 or number == len(rows):
            log.info(f"{table.file}: point {number} of {len(rows)}")


def write(out: str | os.PathLike[str], *, force: bool = False) -> list[Path]:
    """Compute every table with `reference` and write it into the folder `out`; a few minutes.

    `FileExistsError` before the computation if a file is there, unless `force`.
    """
    folder.check(out, [table.file for table in TABLES], force=force)
    return [
        path
        for table in TABLES
        for path in folder.write(out, {table.file: text(table)}, force=force)
    ]


def load(path: str | os.PathLike[str]) -> dict[str, FloatArray]:
    """The columns of a file that `write` made: inputs exactly, outputs rounded to double."""
    rows = tables.csv_rows(Path(path).read_text())
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
