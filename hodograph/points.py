"""Reference points: flights computed to 30 digits, kept in ``data/reference.csv``.

The inputs are laid out by rule, not drawn: log-spaced in v_norm, dense near 0 and 90 degrees,
from below the horizon, to landings below and above the launch, and to targets just under the
apex.  Each is written so that it reads back as the very double that was computed with.
"""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Callable, Iterator
from itertools import product
from pathlib import Path
from typing import NamedTuple

import mpmath
import numpy as np

from hodograph import reference
from hodograph.domain import FloatArray
from hodograph.files import check_targets, write_whole

DIGITS = 30
INPUTS = ("v_norm", "alpha0", "height")
OUTPUTS = ("x", "t", "alpha", "speed", "arc_length", "apex_x", "apex_y", "apex_t")
COMMAND = "hodograph reference --out data --force"


class Inputs(NamedTuple):
    """A launch: v0 / v_lim, radians, and the launch height in units of v_lim^2 / g."""

    v_norm: float
    alpha0: float
    height: float


def inputs() -> Iterator[Inputs]:
    """The launches, in the order of the file.

    Yields
    ------
    Inputs
        v_norm, alpha0 (radians) and height.

    Examples
    --------
    >>> len(list(inputs())) >= 600
    True
    """
    near_zero = [1e-8, 1e-6, 1e-4, 1e-2]
    degrees = [0.1, 1, 2, 5, 10, 20, 30, 40, 45, 50, 60, 70, 80, 85, 88, 89, 89.9, 89.99]
    near_right = [1e-4, 1e-6, 1e-9, 1e-12, 0.0]
    angles = [
        *near_zero,
        *(float(np.deg2rad(d)) for d in degrees),
        *(float(np.pi / 2 - gap) for gap in near_right),
    ]
    speeds = [float(v) for v in 10.0 ** np.arange(-8, 9)] + [0.3, 0.7, 1.5, 3.0, 20.0]
    for v, a in product(speeds, angles):
        yield Inputs(v, a, 0.0)

    slopes = [-89.99, -80.0, -45.0, -5.0, -1e-3, 0.0, 1e-3, 5.0, 45.0, 80.0, 89.99, 90.0]
    for v, d, fall in product([1e-3, 0.1, 1.0, 4.0, 50.0, 1e4, 1e8], slopes, [1e-3, 0.5, 30.0]):
        yield Inputs(v, float(np.deg2rad(d)), fall * min(v * v, 1.0))

    for v, d, gap in product([0.01, 1.0, 30.0], [1.0, 45.0, 89.0], [0.5, 1e-3, 1e-6, 1e-8]):
        a = float(np.deg2rad(d))
        apex = reference.position(v, a, 0.0).y
        yield Inputs(v, a, -float(apex) * (1 - gap))


def write(
    path: str | os.PathLike[str],
    *,
    force: bool = False,
    progress: Callable[[str], None] = lambda message: None,
) -> Path:
    """Compute every point with `reference.flight` and write the file, whole; a minute or so.

    Parameters
    ----------
    path : path-like
        The CSV file; `FileExistsError` if it is there, unless `force`.
    force : bool, optional
        Replace an existing file.
    progress : callable, optional
        Called with a short message now and then.

    Returns
    -------
    pathlib.Path
        The file written.
    """
    check_targets(Path(path), force=force)
    stream = io.StringIO()
    stream.write(
        f"# flights under quadratic drag to {DIGITS} digits, by hodograph.reference\n"
        "# units: lengths v_lim^2/g, times v_lim/g, speeds v_lim, angles in radians\n"
        f"# remade by: {COMMAND}\n"
    )
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow([*INPUTS, *OUTPUTS])
    launches = list(inputs())
    for number, launch in enumerate(launches, start=1):
        flight = reference.flight(*launch, dps=DIGITS)
        rows.writerow(
            [*map(repr, launch), *(mpmath.nstr(getattr(flight, name), DIGITS) for name in OUTPUTS)]
        )
        if number % 50 == 0 or number == len(launches):
            progress(f"point {number} of {len(launches)}")
    return write_whole(path, stream.getvalue(), force=force)


def load(path: str | os.PathLike[str]) -> dict[str, FloatArray]:
    """Read the file: inputs exactly, outputs rounded to double.

    Parameters
    ----------
    path : path-like
        A file that `write` made.

    Returns
    -------
    dict of str to ndarray
        One array a column.
    """
    lines = Path(path).read_text().splitlines()
    table = csv.DictReader(line for line in lines if not line.startswith("#"))
    columns: dict[str, list[float]] = {name: [] for name in (*INPUTS, *OUTPUTS)}
    for row in table:
        for name, values in columns.items():
            values.append(float(row[name]))
    return {name: np.array(values) for name, values in columns.items()}
