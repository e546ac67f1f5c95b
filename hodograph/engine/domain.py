"""Which inputs are legal, and how they broadcast: the one place that refuses.

Every public function of the engine passes its arguments through `broadcast`, which turns them
into flat ``float64`` arrays, and gives its result the broadcast shape with `restore`.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hodograph.engine import labels

FloatArray: TypeAlias = NDArray[np.float64]
BoolArray: TypeAlias = NDArray[np.bool_]

# What holds float64 for one launch and arrays for many.
if TYPE_CHECKING:  # every type checker brings it; Python's own has no default before 3.13
    from typing_extensions import TypeVar

    T = TypeVar("T", bound=np.float64 | FloatArray, default=Any)
else:
    from typing import TypeVar

    T = TypeVar("T")

Scalar: TypeAlias = float | np.floating[Any] | np.integer[Any]  # one number, whose result is one

RIGHT_ANGLE = np.pi / 2
ROUNDING = float(np.spacing(np.float32(RIGHT_ANGLE)))  # of the right angle in single precision

# The legal domain of a scene in SI units, and of its two ratios.  It leaves room for every
# flight; beyond it squares and products would leave the doubles.
LEAST, MOST = 1e-30, 1e30
V_NORM_MAX = 1e20  # v0 / v_lim
DEPTH_MAX = 1e20  # abs(height) * g / v_lim**2


class Rule(NamedTuple):
    """A legal range: its words for the error message, and its test (NaN never reaches it)."""

    words: str
    holds: Callable[[FloatArray], BoolArray]
    angle: bool = False  # a right angle rounded up to single precision is then a right angle


NON_NEGATIVE = Rule("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a))
POSITIVE = Rule("finite and > 0", lambda a: (a > 0) & np.isfinite(a))
POSITIVE_OR_INF = Rule("> 0 (inf is allowed)", lambda a: a > 0)
FINITE = Rule("finite", np.isfinite)

LAUNCH_SPEED = Rule("0 or in [1e-30, 1e30] m/s", lambda a: (a == 0) | ((a >= LEAST) & (a <= MOST)))
MOVING = Rule("in [1e-30, 1e30] m/s", lambda a: (a >= LEAST) & (a <= MOST))
TERMINAL_SPEED = Rule("at least 1e-30 m/s (inf is vacuum)", lambda a: a >= LEAST)
GRAVITY = Rule("in [1e-30, 1e30] m/s^2", lambda a: (a >= LEAST) & (a <= MOST))
WIND = Rule(
    "0, or of a size in [1e-30, 1e30] m/s",
    lambda a: (a == 0) | ((np.abs(a) >= LEAST) & (np.abs(a) <= MOST)),
)
HEIGHT = Rule("in [-1e30, 1e30] m", lambda a: np.abs(a) <= MOST)
V_NORM = Rule("in [0, 1e20]", lambda a: (a >= 0) & (a <= V_NORM_MAX))
SPEED_RATIO = Rule("at most 1e20", lambda a: a <= V_NORM_MAX)
DEPTH = Rule("at most 1e20", lambda a: a <= DEPTH_MAX)

LEVEL_ANGLE = Rule("in [0, pi/2] radians", lambda a: (a >= 0) & (a <= RIGHT_ANGLE), angle=True)
SLOPE_ANGLE = Rule("in [-pi/2, pi/2] radians", lambda a: np.abs(a) <= RIGHT_ANGLE, angle=True)
GROUND = Rule("in (-pi/2, pi/2) radians", lambda a: np.abs(a) < RIGHT_ANGLE, angle=True)
OPEN_ANGLE = Rule(
    "in (-pi/2, pi/2] radians", lambda a: (a > -RIGHT_ANGLE) & (a <= RIGHT_ANGLE), angle=True
)


def as_float(name: str, value: ArrayLike) -> FloatArray:
    """The argument as ``float64``, or a `TypeError` that says what is wrong with it."""
    if type(value) not in labels.PLAIN:
        for part in labels.parts(value):
            labels.require_bare(name, part)
    try:
        array = np.asarray(value)
    except ValueError:
        raise TypeError(f"{name} must be real numbers in a regular array") from None
    if array.dtype.kind == "O" and isinstance(value, int | list | tuple):
        array = _with_large_integers(array)
    flag = isinstance(value, list | tuple) and any(map(_is_flag, labels.parts(value)))
    if array.dtype.kind not in "iuf" or flag:
        kind = np.dtype(bool) if flag else array.dtype
        hint = f" (is it .{name}() of that?)" if callable(getattr(value, name, None)) else ""
        got = f"{type(value).__name__} of dtype {kind}"
        raise TypeError(f"{name} must be real numbers; got {got}{hint}")
    with np.errstate(over="ignore"):
        return array.astype(np.float64)


def _is_flag(part: Any) -> bool:
    """Whether it is True, False or an array of them, which beside a number would become 1 or 0."""
    return isinstance(part, bool | np.bool_) or (
        isinstance(part, np.ndarray) and part.dtype.kind == "b"
    )


def _with_large_integers(array: NDArray[Any]) -> NDArray[Any]:
    """Integers beyond 64 bits, which NumPy holds as objects, as floats; others as they are."""
    real = int | float | np.integer | np.floating
    if any(isinstance(each, bool) or not isinstance(each, real) for each in array.flat):
        return array
    return np.reshape([_nearest_float(each) for each in array.flat], array.shape)


def _nearest_float(number: Any) -> float:
    try:
        return float(number)
    except OverflowError:  # of an integer
        return float(np.inf) if number > 0 else -float(np.inf)


def check(name: str, array: FloatArray, rule: Rule) -> None:
    """Raise a one-line `ValueError` if an element breaks the rule; NaN passes."""
    bad = ~(np.isnan(array) | rule.holds(array))
    if bad.any():
        first = float(array[bad].flat[0])
        count = int(np.count_nonzero(bad))
        what = f"got {first!r}" if array.ndim == 0 else f"{count} of {array.size} are not, "
        what += "" if array.ndim == 0 else f"the first is {first!r}"
        if rule.angle and RIGHT_ANGLE < abs(first) < np.inf:
            what += " (if these are degrees: np.deg2rad)"
        raise ValueError(f"{name} must be {rule.words}; {what}")


def checked(name: str, value: ArrayLike, rule: Rule) -> FloatArray:
    """The argument as ``float64``, within its rule."""
    array = as_float(name, value)
    if rule.angle and (above := np.abs(array) > RIGHT_ANGLE).any():
        above &= np.abs(array) <= RIGHT_ANGLE + ROUNDING
        array = np.where(above, np.copysign(RIGHT_ANGLE, array), array)
    check(name, array, rule)
    return array


def check_scene(v0: FloatArray, v_lim: FloatArray, g: FloatArray, height: FloatArray) -> None:
    """The ratios of a scene, whose parts are legal one by one."""
    with np.errstate(under="ignore"):
        check("v0 / v_lim", v0 / v_lim, SPEED_RATIO)
        check("abs(height) * g / v_lim**2", np.abs(height) * g / v_lim / v_lim, DEPTH)


def check_wind(v_lim: FloatArray, **winds: FloatArray) -> None:
    """The ratio of a wind to the terminal speed."""
    with np.errstate(under="ignore"):
        for name, wind in winds.items():
            check(f"abs({name}) / v_lim", np.abs(wind) / v_lim, SPEED_RATIO)


def broadcast(**arguments: tuple[ArrayLike, Rule]) -> tuple[tuple[int, ...], list[FloatArray]]:
    """Check the named arguments and broadcast them to a common shape.

    Returns
    -------
    shape : tuple of int
        The broadcast shape, for `restore`.
    arrays : list of ndarray
        The arguments as ``float64`` arrays of that shape.
    """
    labels.one_index(**{name: value for name, (value, _) in arguments.items()})
    arrays = [checked(name, value, rule) for name, (value, rule) in arguments.items()]
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
    if (shape := as_float(name, value).shape) != ():
        raise TypeError(f"{name} must be one number; got shape {shape}")
    number = float(checked(name, value, rule))
    if np.isnan(number):
        raise ValueError(f"{name} must be {rule.words}; got nan")
    return number


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
