"""What may come into `hodograph.steppers`: numbers, and launches broadcast together."""

import math
from collections.abc import Callable
from inspect import getattr_static
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


def launches(*values: Any) -> tuple[tuple[int, ...], Array]:
    """The launches checked and broadcast: their shape, and an array (5, launches)."""
    rules: dict[str, tuple[str, Callable[[Array], Mask]]] = {
        "v0": ("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a)),
        "alpha0": ("in [-pi/2, pi/2] radians", lambda a: np.abs(a) <= math.pi / 2),
        "v_lim": ("> 0 (inf is vacuum)", lambda a: a > 0),
        "g": ("finite and > 0", lambda a: (a > 0) & np.isfinite(a)),
        "height": ("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a)),
    }
    labels = [each.index for each in values if _package(each) == "pandas"]
    if not all(labels[0].equals(index) for index in labels[1:]):
        raise ValueError("launches of pandas Series with different indices: align them first")
    arrays = []
    for (name, (words, legal)), value in zip(rules.items(), values, strict=True):
        array = _as_float(name, value)
        bad = ~(legal(array) | np.isnan(array))
        if bad.any():
            raise ValueError(f"{name} must be {words}; got {float(array[bad].flat[0])!r}")
        arrays.append(array)
    try:
        together = np.broadcast_arrays(*arrays)
    except ValueError:
        shapes = ", ".join(f"{k} {a.shape}" for k, a in zip(rules, arrays, strict=True))
        raise ValueError(f"arguments do not broadcast together: {shapes}") from None
    return together[0].shape, np.stack([array.ravel() for array in together])


def number(name: str, value: float, words: str, legal: Callable[[float], bool]) -> float:
    """Check one number; `words` say what is legal."""
    array = _as_float(name, value)
    if array.ndim:
        raise TypeError(f"{name} must be one number; got shape {array.shape}")
    if not legal(float(array)):
        raise ValueError(f"{name} must be {words}; got {float(array)!r}")
    return float(array)


def _as_float(name: str, value: npt.ArrayLike) -> Array:
    package = _package(value)
    if package in ("xarray", "dask"):
        way = {"xarray": "xarray.apply_ufunc", "dask": "dask.array.map_blocks"}[package]
        raise TypeError(f"{name} is a {package} {type(value).__name__}; use {way}")
    if any(getattr_static(value, word, None) is not None for word in ("units", "unit")):
        raise TypeError(f"{name} carries units; pass its plain magnitude in SI units or radians")
    try:
        array: Any = np.ma.asarray(value)
    except ValueError:
        raise TypeError(f"{name} must be real numbers in a regular array") from None
    flags = isinstance(value, list | tuple) and any(isinstance(v, bool | np.bool_) for v in value)
    if array.dtype.kind not in "iuf" or np.ma.is_masked(array) or flags:
        raise TypeError(f"{name} must be real numbers; got {type(value).__name__}")
    return np.asarray(array, dtype=np.float64)


def _package(value: object) -> str:
    return type(value).__module__.partition(".")[0]
