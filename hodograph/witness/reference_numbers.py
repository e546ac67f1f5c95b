"""Numbers of the reference: a private mpmath context, how arguments are read, how results leave.

All work is done in this context behind a lock: ``mpmath.mp`` is left alone and threads may call
at will.  An argument is kept as a function that reads it at the precision of the moment, since
a calculation may find that it needs more digits than it began with.
"""

import numbers
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import fields
from typing import Any, TypeVar

import mpmath

ctx = mpmath.MPContext()
_lock = threading.RLock()
Exact = Callable[[], mpmath.mpf]  # a number at the precision of the moment
GUARD = 10  # digits kept beyond those asked for

_Result = TypeVar("_Result")


@contextmanager
def working(dps: int) -> Iterator[None]:
    """Hold the context, at the digits asked for and a few more."""
    if isinstance(dps, bool) or not isinstance(dps, int) or dps < 1:
        raise ValueError(f"dps must be a whole number of digits >= 1, got {dps!r}")
    with _lock, ctx.workdps(dps + GUARD):
        yield


def number(name: str, value: Any) -> Exact:
    """Check that `value` is a finite number, and say how to read it."""
    if isinstance(value, bool) or not (
        isinstance(value, str | numbers.Real) or hasattr(value, "_mpf_")
    ):
        raise TypeError(f"{name} must be a real number or a string, got {type(value).__name__}")

    def exact() -> mpmath.mpf:
        if hasattr(value, "_mpf_"):  # first, as an mpf is also a numbers.Real
            return ctx.make_mpf(value._mpf_)
        if isinstance(value, numbers.Rational):
            return ctx.mpf(int(value.numerator)) / int(value.denominator)
        return ctx.mpf(value if isinstance(value, str) else float(value))

    try:
        finite = ctx.isfinite(exact())
    except ValueError:
        finite = False
    if not finite:
        raise ValueError(f"{name} must be a finite number, got {value!r}")
    return exact


def speed(value: Any, *, rest: bool = False) -> Exact:
    """Read v_norm, which may be 0 where `rest` allows it."""
    v = number("v_norm", value)
    if v() < 0 or (v() == 0 and not rest):
        raise ValueError(f"v_norm must be {'>=' if rest else '>'} 0, got {value}")
    return v


def angle(name: str, value: Any) -> Exact:
    """Read an angle from straight down to straight up."""
    a = number(name, value)
    if abs(a()) > 2 or ctx.cos(a()) <= 0:
        hint = " (if these are degrees: mpmath.radians)"
        raise ValueError(f"{name} must be in [-pi/2, pi/2], got {value}{hint}")
    return a


def level_launch(v_norm: Any, alpha0: Any) -> tuple[Exact, Exact]:
    """Read a launch from level ground: at rest or not, level or upward."""
    v, a0 = speed(v_norm, rest=True), angle("alpha0", alpha0)
    if a0() < 0:
        raise ValueError(f"alpha0 must be in [0, pi/2] on level ground, got {alpha0}")
    return v, a0


def power(value: Any) -> Exact:
    """Read n."""
    n = number("n", value)
    if not 1 <= n() <= 10:
        raise ValueError(f"n must be in [1, 10], got {value}")
    return n


def s_of(alpha: mpmath.mpf) -> mpmath.mpf:
    """s = asinh(tan α)."""
    return ctx.asinh(ctx.tan(alpha))


def zero() -> mpmath.mpf:
    """Nothing, as a number of the context."""
    return ctx.mpf(0)


def digits(ratio: mpmath.mpf) -> int:
    """How many digits lie between two numbers of this ratio."""
    return int(ctx.ceil(ctx.log10(ratio)))


def lost(large: mpmath.mpf, small: mpmath.mpf) -> int:
    """Digits that cancel when a difference of numbers of size `large` is as small as `small`."""
    if large == 0:
        return 0
    return max(0, digits(abs(large / small))) if small != 0 else ctx.dps


def rounded(value: mpmath.mpf, dps: int) -> mpmath.mpf:
    """The caller's number, of `dps` digits."""
    with ctx.workdps(dps):
        return mpmath.make_mpf((+value)._mpf_)


def all_rounded(result: _Result, dps: int) -> _Result:
    """A dataclass with every field rounded."""
    record: Any = result  # a dataclass, which a type variable cannot say
    return type(result)(*(rounded(getattr(record, f.name), dps) for f in fields(record)))
