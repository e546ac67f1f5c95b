"""Sweeps over named inputs: labelled, lazy, and written chunk by chunk (extra `sweep`).

xarray has the labels, Dask the work, Zarr and netCDF the files.  Nothing is computed until a chunk
is asked for, and `write` finishes what an interruption left.
"""

from __future__ import annotations

import errno
import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from hodograph import _files, level
from hodograph.engine import axes, chunks, domain
from hodograph.launch import Launch
from hodograph.tiers import dial

if TYPE_CHECKING:
    import xarray

Axis: TypeAlias = "ArrayLike | tuple[str | Sequence[str], ArrayLike] | xarray.DataArray"

MEMORY = 64e6  # bytes of arrays while one chunk is computed
BEGUN = ".part"  # what the name of an unfinished table ends with

# What an output is, and its unit.
D_NORM = {"d_norm": ("range over the range without drag", "1")}
LANDINGS = {
    "x": ("distance of the landing", "m"),
    "y": ("height of the ground at the landing", "m"),
    "z": ("drift to the side", "m"),
    "t": ("time of the landing", "s"),
    "speed": ("speed at the landing", "m/s"),
    "alpha": ("slope angle at the landing", "rad"),
    "arc_length": ("length of path through the air", "m"),
    "error": ("estimate of the relative error of x and t", "1"),
    "status": ("0 converged, 1 unreachable, 2 not converged, 3 a NaN among the inputs", "1"),
}


def d_norm(
    *,
    v_norm: Axis,
    alpha0: Axis,
    n: Axis = 2.0,
    rtol: float | None = None,
    method: str | None = None,
    memory: float = MEMORY,
) -> xarray.Dataset:
    """`hodograph.d_norm` over named inputs, as a lazy Dataset.

    Parameters
    ----------
    v_norm, alpha0, n : array_like, tuple or xarray.DataArray
        As for `hodograph.d_norm`.  A 1-D array is a dimension of its own, by the name of the
        input; ``("case", values)``, or a DataArray, names its dimensions, which inputs may share;
        a number is none.
    rtol, method : optional
        As for `hodograph.d_norm`.
    memory : float, optional
        Bytes of arrays that the computation of one chunk may take, 25 MB of the library's own
        beside them; the chunks are as large as that allows.

    Returns
    -------
    xarray.Dataset
        `d_norm`, not yet computed, with the inputs as coordinates; units, long names, versions and
        the call in its attributes.

    Raises
    ------
    ValueError
        An element lies outside its range; an array of two dimensions or more without names;
        inputs that share a dimension and differ along it; a dimension or coordinate by the name
        of an output.
    TypeError
        An argument is not made of real numbers.
    ImportError
        The extra `sweep` is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> table = d_norm(v_norm=np.linspace(0, 2, 5), alpha0=np.deg2rad([30, 45]), n=[1, 2])
    >>> dict(table.sizes)
    {'v_norm': 5, 'alpha0': 2, 'n': 2}
    >>> round(float(table.d_norm.sel(v_norm=1.0, n=2)[1]), 6)
    0.589012
    """
    dial.choice(rtol, method)
    call = {"rtol": rtol, "method": method}
    function = partial(_level, rtol=rtol, method=method)
    inputs = {"v_norm": v_norm, "alpha0": alpha0, "n": n}
    return _lazy("d_norm", function, inputs, D_NORM, call, memory)


def landings(
    *,
    v0: Axis,
    alpha0: Axis,
    v_lim: Axis | None = None,
    k: Axis | None = None,
    n: Axis = 2.0,
    g: Axis = 9.81,
    height: Axis = 0.0,
    slope: Axis = 0.0,
    wind: Axis = 0.0,
    crosswind: Axis = 0.0,
    memory: float = MEMORY,
) -> xarray.Dataset:
    """`Launch.landing` over named inputs in SI units, as a lazy Dataset.

    Parameters
    ----------
    v0, alpha0, v_lim, n, g, height, slope, wind, crosswind : array_like, tuple or xarray.DataArray
        As for `hodograph.Launch`; how they become dimensions, `d_norm` says.
    k : array_like, tuple or xarray.DataArray, optional
        In place of `v_lim`, as for `Launch.from_drag`.
    memory : float, optional
        As for `d_norm`.

    Returns
    -------
    xarray.Dataset
        Every field of `hodograph.Landing` but `success`, not yet computed.

    Examples
    --------
    >>> import numpy as np
    >>> height = ("throw", [0.0, 1.5, 2.0])
    >>> table = landings(v0=("throw", [12.0, 13.0, 14.0]), alpha0=0.7, v_lim=40.0, height=height)
    >>> table.x.compute().round(2).values
    array([13.57, 17.27, 20.04])
    """
    if (v_lim is None) == (k is None):
        raise TypeError("give v_lim or k, and not both")
    drag = "v_lim" if k is None else "k"
    inputs = {"v0": v0, "alpha0": alpha0, drag: v_lim if k is None else k}
    inputs |= {"n": n, "g": g, "height": height}
    inputs |= {"slope": slope, "wind": wind, "crosswind": crosswind}
    return _lazy("landings", partial(_land, tuple(inputs)), inputs, LANDINGS, {}, memory)


def _level(*inputs: Any, rtol: float | None, method: str | None) -> Any:
    v_norm, alpha0, n = inputs
    return np.asarray(level.d_norm(v_norm, alpha0, n=n, rtol=rtol, method=method))


def _land(names: tuple[str, ...], *inputs: Any) -> tuple[Any, ...]:
    fields = dict(zip(names, inputs, strict=True))
    make = Launch.from_drag if "k" in fields else Launch
    landing = make(**fields).landing()
    return tuple(np.asarray(getattr(landing, name)) for name in LANDINGS)


def _lazy(
    name: str,
    function: Callable[..., Any],
    inputs: Mapping[str, Any],
    outputs: Mapping[str, tuple[str, str]],
    call: Mapping[str, Any],
    memory: float,
) -> xarray.Dataset:
    """The outputs of a function of arrays, by dimension and chunk."""
    xarray, dask = _packages()
    given = [axes.labelled(xarray, name, value) for name, value in inputs.items()]
    try:
        given = list(xarray.align(*given, join="exact"))
    except ValueError as error:
        raise ValueError(f"inputs differ along a dimension that they share: {error}") from None
    axes.require_free(dict(zip(inputs, given, strict=True)), outputs)
    sizes = {dim: size for array in given for dim, size in array.sizes.items()}
    room = domain.option("memory", memory, domain.POSITIVE)
    lengths = axes.chunks(sizes, int(room // (8 * (2 * len(inputs) + 2 * len(outputs)))))
    with warnings.catch_warnings():  # of many small chunks, which are as many as they must be
        warnings.simplefilter("ignore", dask.array.PerformanceWarning)
        found = xarray.apply_ufunc(
            function,
            *(array.chunk({dim: lengths[dim] for dim in array.dims}) for array in given),
            dask="parallelized",
            output_core_dims=[()] * len(outputs),
            output_dtypes=[np.int8 if output == "status" else np.float64 for output in outputs],
        )
    rows = found if isinstance(found, tuple) else (found,)
    table = xarray.Dataset(
        {
            output: row.assign_attrs(long_name=words, units=unit)
            for (output, (words, unit)), row in zip(outputs.items(), rows, strict=True)
        }
    )
    options = "".join(f", {key}={value!r}" for key, value in call.items() if value is not None)
    return table.assign_coords(dict(zip(inputs, given, strict=True))).assign_attrs(
        title="Flight of a projectile under drag",
        source=f"hodograph {version('hodograph')}, numpy {version('numpy')}",
        call=f"hodograph.sweep.{name}({', '.join(inputs)}{options})",
    )


def _packages() -> tuple[Any, Any]:
    try:
        import dask.array
        import xarray
    except ImportError:
        words = 'hodograph.sweep needs xarray and dask: pip install "hodograph[sweep]"'
        raise ImportError(f'{words}, or in a checkout pip install ".[sweep]"') from None
    return xarray, dask


# --- to a file ----------------------------------------------------------------------------


def write(
    table: xarray.Dataset,
    path: str | os.PathLike[str],
    *,
    scheduler: str = "processes",
    resume: bool = False,
    force: bool = False,
) -> Path:
    """Compute a sweep and write it, chunk by chunk.

    The chunks go to a Zarr store beside `path`, named ``path.part``, each of them whole or not at
    all, and it takes the name `path` when all are there.  If the process ends before that, however
    it ends, another call with `resume` computes the chunks that are missing; the table is the
    same as one that was written at once.

    Parameters
    ----------
    table : xarray.Dataset
        What `d_norm` or `landings` gave.
    path : path-like
        Ends with ``.zarr`` or ``.nc`` (netCDF-4).
    scheduler : str, optional
        "processes", one for each core of this machine; "threads"; or the address of a Dask
        scheduler, the workers of which see the same files.
    resume : bool, optional
        Finish a table that was begun with the same inputs.
    force : bool, optional
        Replace an existing table, or one that was begun.

    Returns
    -------
    pathlib.Path
        The table.

    Raises
    ------
    FileExistsError
        The table is there, or one that was begun, or what is no table.
    ValueError
        `path` ends with neither; the table that was begun is another one; the table is empty.
    OSError
        The disk is full, the folder cannot be written to, or another process is writing the
        table: what was finished stays.

    Examples
    --------
    >>> import tempfile
    >>> import xarray
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     table = d_norm(v_norm=[0.5, 1.0], alpha0=[0.5, 1.0, 1.5])
    ...     path = write(table, folder + "/table.zarr", scheduler="threads")
    ...     xarray.open_zarr(path).d_norm.values.round(3)
    array([[0.874, 0.832, 0.844],
           [0.652, 0.572, 0.587]])
    """
    target = Path(path)
    if target.suffix not in (".zarr", ".nc"):
        raise ValueError(f"path must end with .zarr or .nc; got {os.fspath(path)!r}")
    if scheduler not in ("processes", "threads") and ":" not in scheduler:
        raise ValueError(
            "scheduler must be 'processes', 'threads', or the address of a Dask scheduler, "
            f"tcp://host:8786 say; got {scheduler!r}"
        )
    if 0 in table.sizes.values():
        raise ValueError("the table is empty: one of its dimensions has no elements")
    table = table.assign_coords({name: at.compute() for name, at in table.coords.items()})
    part = target.with_name(target.name + BEGUN)
    _files.require_writable(target.parent)
    with _files.alone(part):
        for path in (target, part):
            _require_table(path)
        if resume and target.exists() and not force:
            _require_same(target, table)
            _files.discard(part)
            return target
        _files.refuse_existing(target, force=force)
        if part.exists() and not (resume or force):
            raise FileExistsError(
                f"{part} is a table that was begun: resume to finish it, force to begin anew"
            )
        begun = resume and part.exists()
        if begun:
            _require_same(part, table)
        with chunks.workers(scheduler) as (pool, width):
            if not begun:
                _begin(table, part)
            chunks.fill(table, part, pool, width)
        _finish(part, target)
    return target


def _require_table(path: Path) -> None:
    """Refuse to replace, or go on with, what has the name of a table and is none."""
    is_table = path.is_file() if path.suffix == ".nc" else bool(list(path.glob(".zgroup")))
    if path.exists() and not is_table:
        raise FileExistsError(errno.EEXIST, "is there, and is no table", str(path))


def _begin(table: xarray.Dataset, part: Path) -> None:
    """A store with the coordinates, and room for the rest."""
    fresh = part.with_name(f".{part.name}")
    for old in (fresh, part):
        _files.discard(old)
    table.to_zarr(fresh, compute=False, consolidated=True, zarr_format=2)
    fresh.rename(part)


def _require_same(path: Path, table: xarray.Dataset) -> None:
    """Refuse to go on with a table of other inputs, options or versions."""
    with _opened(path) as stored:
        same = (
            stored.attrs == table.attrs
            and dict(stored.sizes) == dict(table.sizes)
            and set(stored.data_vars) == set(table.data_vars)
            and stored.coords.to_dataset().equals(table.coords.to_dataset())
            and (
                path.suffix == ".nc"
                or all(
                    stored[name].data.chunks == row.data.chunks
                    for name, row in table.data_vars.items()
                )
            )
        )
    if not same:
        raise ValueError(f"{path} has other inputs, options or versions")


def _opened(path: Path) -> xarray.Dataset:
    xarray, _ = _packages()
    if path.suffix == ".nc":
        return xarray.open_dataset(path, engine="netcdf4", chunks={})
    return xarray.open_zarr(path)


def _finish(part: Path, target: Path) -> None:
    """Give the table its name: the store itself, or the netCDF file made of it."""
    for left in part.rglob("*.partial"):  # by a worker that was killed
        left.unlink()
    whole = part
    if target.suffix == ".nc":
        whole = target.with_name(f".{target.name}{BEGUN}")
        with _opened(part) as stored:
            table = stored.drop_encoding()
            encoding = {
                name: {"chunksizes": row.data.chunksize, "zlib": True}
                for name, row in table.data_vars.items()
            }
            try:
                table.to_netcdf(whole, engine="netcdf4", encoding=encoding)
            except BaseException as error:
                whole.unlink(missing_ok=True)
                if isinstance(error, RuntimeError):  # of HDF5, whatever the reason
                    words = f"the netCDF file could not be written ({error}); the chunks stay"
                    raise OSError(errno.EIO, words, str(target)) from None
                raise
    _files.discard(target)
    os.replace(whole, target)
    _files.discard(part)
