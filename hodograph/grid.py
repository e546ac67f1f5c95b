"""d_norm tabulated over (v_norm, alpha0), and the files that hold the table (figure 3)."""

import io
import os
import tempfile
import zipfile
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from hodograph._files import write_whole
from hodograph.engine import domain
from hodograph.engine.domain import FloatArray
from hodograph.engine.record import Record
from hodograph.level import d_norm

DECIMALS = 13  # in the files: 5e-14 off, and the same bytes on every machine
TOLERANCE = 1e-12
COMMAND = "hodograph grid --out data --force"


@dataclass(frozen=True, eq=False, repr=False)
class Grid(Record):
    """d_norm[i, j] at v_norm[i] and alpha0[j] (radians)."""

    v_norm: FloatArray
    alpha0: FloatArray
    d_norm: FloatArray


def tabulate(v_norm: ArrayLike | None = None, alpha0: ArrayLike | None = None) -> Grid:
    """Tabulate d_norm over the product of two axes.

    Parameters
    ----------
    v_norm : array_like, optional
        1-D axis of v0 / v_lim, finite and >= 0; by default 0 to 1.5 by 0.01.
    alpha0 : array_like, optional
        1-D axis of launch angles in radians, in [0, pi/2]; by default 0 to 90 degrees by 1.

    Returns
    -------
    Grid
        The axes and the table, of shape (len(v_norm), len(alpha0)).

    Examples
    --------
    >>> grid = tabulate()
    >>> grid.d_norm.shape
    (151, 91)
    >>> round(float(grid.d_norm[100, 45]), 10)  # v_norm = 1, 45 degrees
    0.5890118002
    """
    v = domain.checked("v_norm", np.arange(151) / 100 if v_norm is None else v_norm, domain.V_NORM)
    a = domain.checked(
        "alpha0", np.deg2rad(np.arange(91)) if alpha0 is None else alpha0, domain.LEVEL_ANGLE
    )
    for name, axis in (("v_norm", v), ("alpha0", a)):
        if axis.ndim != 1:
            raise ValueError(f"{name} must be a 1-D axis; got {axis.ndim} dimensions")
    return Grid(v, a, np.asarray(d_norm(v[:, np.newaxis], a)))


def save_npz(grid: Grid, path: str | os.PathLike[str], *, force: bool = False) -> Path:
    """Write the grid as ``.npz``: arrays v_norm, alpha0 (radians), d_norm and a text `about`.

    Parameters
    ----------
    grid : Grid
        The table.
    path : path-like
        The file; `FileExistsError` if it is there, unless `force`.
    force : bool, optional
        Replace an existing file.

    Returns
    -------
    pathlib.Path
        The file written, whole.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     load(save_npz(tabulate(), folder + "/grid.npz")).d_norm.shape
    (151, 91)
    """
    stream = io.BytesIO()
    np.savez_compressed(
        stream,
        v_norm=grid.v_norm,
        alpha0=grid.alpha0,
        d_norm=np.round(grid.d_norm, DECIMALS),
        about=np.array(about()),
    )
    return write_whole(path, stream.getvalue(), force=force)


def save_csv(grid: Grid, path: str | os.PathLike[str], *, force: bool = False) -> Path:
    """Write the grid as CSV: a commented header, then one row per (v_norm, alpha0).

    Arguments, result and errors are those of `save_npz`.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = save_csv(tabulate([0.0, 1.0], [0.0, 0.5]), folder + "/grid.csv")
    ...     print(path.read_text().splitlines()[-1])
    1,28.6478897565412,0.6515958179050
    """
    lines = [f"# {line}" for line in about().splitlines()]
    lines.append("v_norm,alpha0_deg,d_norm")
    degrees = np.rad2deg(grid.alpha0)
    for v, row in zip(grid.v_norm, grid.d_norm, strict=True):
        lines += [f"{v:.15g},{a:.15g},{d:.{DECIMALS}f}" for a, d in zip(degrees, row, strict=True)]
    return write_whole(path, "\n".join(lines) + "\n", force=force)


def save_netcdf(grid: Grid, path: str | os.PathLike[str], *, force: bool = False) -> Path:
    """Write the grid as netCDF-4, with units and long names; needs the extra `sweep`.

    Parameters
    ----------
    grid, path, force
        As for `save_npz`.

    Returns
    -------
    pathlib.Path
        The file written, whole.
    """
    from hodograph import sweep

    table = sweep.d_norm(v_norm=grid.v_norm, alpha0=grid.alpha0)
    table["d_norm"] = table.d_norm.copy(data=np.round(grid.d_norm, DECIMALS))
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder, "grid.nc")
        table.assign_attrs(about=about()).to_netcdf(made, engine="netcdf4")
        return write_whole(path, made.read_bytes(), force=force)


def load(path: str | os.PathLike[str]) -> Grid:
    """Read a grid that `save_npz` wrote.

    Parameters
    ----------
    path : path-like
        The ``.npz`` file.

    Returns
    -------
    Grid
        The axes and the table.

    Raises
    ------
    ValueError
        The file is another one.
    """
    try:
        with Path(path).open("rb") as file, np.load(file) as data:
            grid = Grid(data["v_norm"], data["alpha0"], data["d_norm"])
    except (KeyError, TypeError, ValueError, EOFError, zipfile.BadZipFile):
        grid = None
    if grid is None or grid.d_norm.shape != grid.v_norm.shape + grid.alpha0.shape:
        raise ValueError(f"path must be a file that save_npz wrote; got {os.fspath(path)!r}")
    return grid


def about() -> str:
    """What the files say of themselves."""
    return (
        f"d_norm = d / d_ref (Vial 2008, eq. 21), hodograph {version('hodograph')}\n"
        f"relative tolerance {TOLERANCE:g}, rounded to {DECIMALS} decimals\n"
        "units: v_norm = v0 / v_lim and d_norm have none; alpha0 in degrees in the CSV, "
        "in radians in the npz\n"
        f"remade by: {COMMAND}"
    )
