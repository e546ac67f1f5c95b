"""Which inputs are legal, and how they broadcast: the one place that refuses.

Every public function of the engine passes its arguments through `broadcast`, which turns them
into flat ``float64`` arrays, and gives its result the broadcast shape with `restore`.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
BoolArray: TypeAlias = NDArray[np.bool_]

RIGHT_ANGLE = np.pi / 2


class Rule(NamedTuple):
    """A legal range: its words for the error message, and its test (NaN never reaches it)."""

    words: str
    holds: Callable[[FloatArray], BoolArray]


NON_NEGATIVE = Rule("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a))
POSITIVE = Rule("finite and > 0", lambda a: (a > 0) & np.isfinite(a))
POSITIVE_OR_INF = Rule("> 0 (inf is allowed)", lambda a: a > 0)
FINITE = Rule("finite", np.isfinite)
OPEN_ANGLE = Rule("in (-pi/2, pi/2] radians", lambda a: (a > -RIGHT_ANGLE) & (a <= RIGHT_ANGLE))
LEVEL_ANGLE = Rule("in [0, pi/2] radians", lambda a: (a >= 0) & (a <= RIGHT_ANGLE))
SLOPE_ANGLE = Rule("in [-pi/2, pi/2] radians", lambda a: np.abs(a) <= RIGHT_ANGLE)


def as_float(name: str, value: ArrayLike) -> FloatArray:
    """The argument as ``float64``, or a `TypeError` that says what is wrong with it."""
    for part in _parts(value):
        if hasattr(part, "units") or hasattr(part, "unit"):
            raise TypeError(
                f"{name} carries units; pass its plain magnitude in SI units or radians"
            )
        if isinstance(part, np.ma.MaskedArray):
            raise TypeError(
                f"{name} is a masked array; fill the masked elements (NaN is passed on)"
            )
    try:
        array = np.asarray(value)
    except ValueError:
        raise TypeError(f"{name} must be real numbers in a regular array") from None
    if array.dtype.kind not in "iuf":
        raise TypeError(
            f"{name} must be real numbers; got {type(value).__name__} of dtype {array.dtype}"
        )
    with np.errstate(over="ignore"):
        return array.astype(np.float64)


def _parts(value: Any) -> Iterator[Any]:
    """The value and, in lists and tuples, the parts that NumPy would strip of units or a mask."""
    yield value
    if isinstance(value, list | tuple):
        for part in value:
            if not isinstance(part, float | int):
                yield from _parts(part)


def check(name: str, array: FloatArray, rule: Rule) -> None:
    """Raise a one-line `ValueError` if an element breaks the rule; NaN passes."""
    bad = ~(np.isnan(array) | rule.holds(array))
    if bad.any():
        first = float(array[bad].flat[0])
        count = int(np.count_nonzero(bad))
        what = f"got {first!r}" if array.ndim == 0 else f"{count} of {array.size} are not, "
        what += "" if array.ndim == 0 else f"the first is {first!r}"
        raise ValueError(f"{name} must be {rule.words}; {what}")


def broadcast(**arguments: tuple[ArrayLike, Rule]) -> tuple[tuple[int, ...], list[FloatArray]]:
    """Check the named arguments and broadcast them to a common shape.

    Returns
    -------
    shape : tuple of int
        The broadcast shape, for `restore`.
    arrays : list of ndarray
        The arguments as ``float64`` arrays of that shape.
    """
    arrays = []
    for name, (value, rule) in arguments.items():
        array = as_float(name, value)
        check(name, array, rule)
        arrays.append(array)
    try:
        together = np.broadcast_arrays(*arrays)
    except ValueError:
        shapes = ", ".join(f"{n} {a.shape}" for n, a in zip(arguments, arrays, strict=True))
        raise ValueError(f"arguments do not broadcast together: {shapes}") from None
    return together[0].shape, list(together)


def restore(flat: NDArray[Any], shape: tuple[int, ...]) -> Any:
    """A flat result in its broadcast shape; a NumPy scalar where the inputs were scalars."""
    return flat.reshape(shape)[()]


def option(name: str, value: float, rule: Rule) -> float:
    """One number, NaN not allowed."""
    number = as_float(name, value)
    if number.ndim:
        raise TypeError(f"{name} must be one number; got shape {number.shape}")
    if np.isnan(number):
        raise ValueError(f"{name} must be {rule.words}; got nan")
    check(name, number, rule)
    return float(number)


def count(name: str, value: int, low: int) -> int:
    """An integer option of at least `low`."""
    try:
        if isinstance(value, bool | np.ndarray):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer; got {type(value).__name__}") from None
    if number < low:
        raise ValueError(f"{name} must be >= {low}; got {number}")
    return number
