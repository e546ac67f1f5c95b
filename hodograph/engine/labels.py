"""Labelled and lazy input: taken with its labels where that can be, refused where not.

Nothing is imported for it: an object tells by its type which package made it, and is there only if
that package is.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator
from inspect import getattr_static
from typing import Any, TypeVar, cast

import numpy as np

F = TypeVar("F", bound=Callable[..., Any])

PLAIN = {float, int, np.float64, np.ndarray}  # types with nothing to lose
_PLAIN = PLAIN | {list, tuple, str, type(None), bool}
KEPT = {("xarray", "DataArray"), ("dask", "Array"), ("pandas", "Series")}


def maker(part: Any) -> str:
    """Which of the packages that label their arrays made the type; empty if none."""
    return _origin(part)[0]


def _kind(part: Any) -> str:
    """The same, if labels of this type can be kept."""
    package, name = _origin(part)
    return package if (package, name) in KEPT else ""


def _origin(part: Any) -> tuple[str, str]:
    """The package and the name of the type, or of the ancestor that is of such a package."""
    for ancestor in type(part).__mro__:
        package = ancestor.__module__.partition(".")[0]
        if package in ("xarray", "dask", "pandas"):
            return package, ancestor.__name__
    return "", ""


def kept(words: str, unit: str) -> Callable[[F], F]:
    """Let a function of arrays take DataArrays, dask arrays and Series, and give the like back.

    `words` and `unit` say what it gives.
    """

    def decorate(function: F) -> F:
        @functools.wraps(function)
        def adapted(*args: Any, **options: Any) -> Any:
            for value in args:
                if type(value) not in _PLAIN:
                    break
            else:
                if not options:
                    return function(*args)
                for value in options.values():
                    if type(value) not in _PLAIN:
                        break
                else:
                    return function(*args, **options)
            given = inspect.signature(function).bind(*args, **options).arguments
            labelled = {name: kind for name, value in given.items() if (kind := _kind(value))}
            if not labelled:
                return function(*args, **options)
            for name in [name for name in given if name not in labelled]:
                for part in parts(given[name]):
                    require_bare(name, part)
            first, package = next(iter(labelled.items()))
            for name, kind in labelled.items():
                if kind != package:
                    raise TypeError(f"{first} is of {package} and {name} of {kind}: convert one")
            arrays = {name: given.pop(name) for name in list(given) if _is_array(given[name])}
            call = functools.partial(_with_names, adapted, tuple(arrays), given)
            found = _ADAPTERS[package](call, arrays)
            if package != "dask":
                found.name = function.__name__
            if package == "xarray":
                found.attrs.update(long_name=words, units=unit)
            return found

        return cast("F", adapted)

    return decorate


def _is_array(value: Any) -> bool:
    """Whether it has elements of its own; numbers and options have none."""
    return bool(_kind(value)) or isinstance(value, list | tuple) or np.ndim(value) > 0


def _with_names(
    function: Callable[..., Any], names: tuple[str, ...], given: dict[str, Any], *arrays: Any
) -> Any:
    return np.asarray(function(**dict(zip(names, arrays, strict=True)), **given))


def _by_dimension(call: Callable[..., Any], arrays: dict[str, Any]) -> Any:
    """DataArrays, broadcast by dimension; lazy ones stay lazy."""
    import xarray

    for name, value in arrays.items():
        if not _kind(value):
            raise TypeError(
                f"{name} is an array without dimensions beside an xarray DataArray: name them, "
                f"xarray.DataArray({name}, dims=...)"
            )
    try:
        return xarray.apply_ufunc(
            call,
            *arrays.values(),
            join="exact",
            keep_attrs="drop_conflicts",
            dask="parallelized",
            output_dtypes=[np.float64],
        )
    except xarray.AlignmentError as error:
        words = " ".join(str(error).split())
        raise ValueError(f"coordinates differ (xarray.align makes them equal): {words}") from None


def _by_block(call: Callable[..., Any], arrays: dict[str, Any]) -> Any:
    """Dask arrays, block by block, when they are computed."""
    import dask.array

    try:
        lazy = dask.array.broadcast_arrays(*map(dask.array.asanyarray, arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {np.shape(value)}" for name, value in arrays.items())
        raise ValueError(f"shapes do not broadcast: {shapes}") from None
    none = np.empty((0,) * lazy[0].ndim)
    return dask.array.map_blocks(call, *lazy, dtype=np.float64, meta=none)


def _by_index(call: Callable[..., Any], arrays: dict[str, Any]) -> Any:
    """Series, aligned by their index as pandas aligns them: NaN where one has no such label."""
    import pandas

    series = {name: value for name, value in arrays.items() if _kind(value)}
    index = next(iter(series.values())).index
    if not all(one.index.equals(index) for one in series.values()):
        if len(arrays) > len(series) or not all(one.index.is_unique for one in series.values()):
            raise ValueError(
                "pandas Series with different indices cannot be aligned here: an index repeats a "
                "label, or an array without one stands beside them"
            )
        index = functools.reduce(lambda a, b: a.union(b.index), series.values(), index)
        series = {name: one.reindex(index) for name, one in series.items()}
    values = [
        _values(pandas, series[name]) if name in series else np.asarray(value)
        for name, value in arrays.items()
    ]
    for name, value in zip(arrays, values, strict=True):
        if value.shape not in ((), (1,), (len(index),)):
            raise ValueError(
                f"{name} has shape {value.shape} beside a pandas Series of {len(index)} elements"
            )
    return pandas.Series(call(*values), index=index)


def _values(pandas: Any, series: Any) -> Any:
    """Its numbers; what is missing is NaN."""
    types = pandas.api.types
    if types.is_integer_dtype(series) or types.is_float_dtype(series):
        return series.to_numpy(np.float64, na_value=np.nan)
    return series.to_numpy()


_ADAPTERS = {"xarray": _by_dimension, "dask": _by_block, "pandas": _by_index}


# --- where labels cannot be kept ------------------------------------------------------------


def parts(value: Any) -> Iterator[Any]:
    """The value and, in lists and tuples, the parts that NumPy would strip of what they carry."""
    yield value
    if isinstance(value, list | tuple):
        for part in value:
            if type(part) is not float and type(part) is not int:
                yield from parts(part)


def require_bare(name: str, part: Any) -> None:
    """Refuse what NumPy would silently strip: labels, units, a mask."""
    package, kind = maker(part), type(part).__name__
    if package in ("xarray", "dask"):
        raise TypeError(
            f"{name} is {'an xarray' if package == 'xarray' else 'a dask'} {kind}, whose labels or "
            "chunks would be lost: hodograph.sweep.landings and hodograph.d_norm keep them; or "
            f"pass its values with .{'to_numpy' if package == 'xarray' else 'compute'}()"
        )
    if package == "pandas" and hasattr(part, "columns"):
        raise TypeError(
            f"{name} is a pandas {kind}, whose labels would be lost: pass its columns, "
            "or its values with .to_numpy()"
        )
    if _has_units(part):
        raise TypeError(f"{name} carries units; pass its plain magnitude in SI units or radians")
    if isinstance(part, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array; fill the masked elements (NaN is passed on)")


def _has_units(part: Any) -> bool:
    """Whether it is a quantity; a label called "units", found by ``__getattr__``, makes none."""
    if isinstance(part, np.generic) or type(part) in (np.ndarray, list, tuple):
        return False
    dtype = getattr_static(part, "dtype", None) and getattr(part, "dtype", None)
    return hasattr(dtype, "units") or any(
        getattr_static(part, word, None) is not None for word in ("units", "unit")
    )


def one_index(**values: Any) -> None:
    """Refuse pandas Series that label their elements differently: they pair by position here."""
    labelled = [
        (name, part.index)
        for name, value in values.items()
        if type(value) not in PLAIN
        for part in parts(value)
        if maker(part) == "pandas" and hasattr(part, "index")
    ]
    for other, index in labelled[1:]:
        if not labelled[0][1].equals(index):
            raise ValueError(
                f"{labelled[0][0]} and {other} are pandas Series with different indices: align "
                "them (Series.align), or pass their values with .to_numpy()"
            )
