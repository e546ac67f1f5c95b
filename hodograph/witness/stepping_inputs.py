"""What may come into `hodograph.steppers`: numbers, and launches broadcast together."""

import math
from collections.abc import Callable, Iterator
from inspect import getattr_static
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

_RIGHT = math.pi / 2
_ROUNDING = float(np.spacing(np.float32(_RIGHT)))  # of the right angle in single precision


def launches(*values: Any) -> tuple[tuple[int, ...], Array]:
    """The launches checked and broadcast: their shape, and an array (5, launches)."""
    rules: dict[str, tuple[str, Callable[[Array], Mask]]] = {
        "v0": ("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a)),
        "alpha0": ("in [-pi/2, pi/2] radians", lambda a: np.abs(a) <= _RIGHT),
        "v_lim": ("> 0 (inf is vacuum)", lambda a: a > 0),
        "g": ("finite and > 0", lambda a: (a > 0) & np.isfinite(a)),
        "height": ("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a)),
    }
    labels = [each.index for each in values if _package(each) == "pandas" and _labelled(each)]
    if not all(labels[0].equals(index) for index in labels[1:]):
        raise ValueError("launches of pandas Series with different indices: align them first")
    arrays = []
    for (name, (words, legal)), value in zip(rules.items(), values, strict=True):
        array = _as_float(name, value)
        if name == "alpha0":  # a right angle in single precision is above pi/2
            near = np.abs(np.abs(array) - _RIGHT) <= _ROUNDING
            array = np.where(near, np.clip(array, -_RIGHT, _RIGHT), array)
        bad = ~(legal(array) | np.isnan(array))
        if bad.any():
            first = float(array[bad].flat[0])
            degrees = name == "alpha0" and abs(first) < math.inf
            hint = " (if these are degrees: np.deg2rad)" if degrees else ""
            raise ValueError(f"{name} must be {words}; got {first!r}{hint}")
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
    parts = list(_parts(value))
    for part in parts:
        _refuse_labels(name, part)
    try:
        array: Any = np.ma.asarray(value)
    except ValueError:
        raise TypeError(f"{name} must be real numbers in a regular array") from None
    flags = any(np.asarray(part).dtype.kind == "b" for part in parts[1:])
    if array.dtype.kind == "O" and all(type(each) in (int, float) for each in array.flat):
        array = np.reshape([_float(each) for each in array.flat], array.shape)  # beyond 64 bits
    if array.dtype.kind not in "iuf" or np.ma.is_masked(array) or flags:
        raise TypeError(f"{name} must be real numbers; got {type(value).__name__}")
    return np.asarray(array, dtype=np.float64)


def _parts(value: Any) -> Iterator[Any]:
    """The value, and what is in it where it is a list."""
    yield value
    if isinstance(value, list | tuple):
        for part in value:
            yield from _parts(part)


def _refuse_labels(name: str, value: Any) -> None:
    package = _package(value)
    if package in ("xarray", "dask"):
        way = {"xarray": "xarray.apply_ufunc", "dask": "dask.array.map_blocks"}[package]
        raise TypeError(f"{name} is a {package} {type(value).__name__}; use {way}")
    if package == "pandas" and hasattr(value, "columns"):
        raise TypeError(f"{name} is a pandas {type(value).__name__}; pass its columns")
    if any(getattr_static(value, word, None) is not None for word in ("units", "unit")):
        raise TypeError(f"{name} carries units; pass its plain magnitude in SI units or radians")


def _labelled(value: Any) -> bool:
    """Whether it is a Series, whose index labels the elements."""
    return hasattr(getattr(value, "index", None), "equals")


def _float(number: float) -> float:
    try:
        return float(number)
    except OverflowError:  # of an integer
        return math.inf if number > 0 else -math.inf


def _package(value: object) -> str:
    return type(value).__module__.partition(".")[0]
