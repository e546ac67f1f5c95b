"""The dial: which way to d_norm is the cheapest that is known to meet a tolerance.

There are four ways, or tiers: two laws, the surrogate, the exact engine.  For each of the first
three the file bounds.json holds a bound on the relative error, cell by cell of its domain:
measured by ``hodograph surrogate``, never typed in.  Cells are uniform in
v_norm / (1 + v_norm), which has an end where v_norm has none, and in alpha0.
"""

from collections.abc import Callable
from functools import cache, lru_cache, partial
from math import cos, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import domain, one, scene
from hodograph.engine.domain import BoolArray, FloatArray, Rule
from hodograph.engine.functions import PLAIN
from hodograph.laws.own import flat_law, flat_law_all
from hodograph.tiers import interpolant

METHODS = ("law", "law_all", "surrogate", "exact")  # the cheapest first
LAW_ALL_V_MAX = domain.V_NORM_MAX  # as far as `laws.d_norm_law_all` is certified
V_MAX = {"law": 6.0, "law_all": LAW_ALL_V_MAX, "surrogate": interpolant.V_MAX}
ROWS, COLUMNS = 77, 32  # of cells: the ends of the law, 6/7, and of the surrogate, 10/11, are edges

# The tightest relative error that the exact engine is held to.  It rests on the 594 level flights
# to 30 digits in data/reference.csv: the range is off by at most 8e-15.
PROMISE = 1e-13
LEAST = 0.05  # of all cells: a tier good in fewer costs more than it saves, and is passed over
BLOCK = 8192
FILE = "bounds.json"

_EVALUATE: dict[str, Callable[[FloatArray, FloatArray], FloatArray]] = {
    "law": flat_law,
    "law_all": flat_law_all,
    "surrogate": interpolant.flat_d_norm,
}
_ALONE: dict[str, Callable[[float, float], float]] = {
    "law": partial(flat_law, f=PLAIN),
    "law_all": partial(flat_law_all, f=PLAIN),
    "surrogate": interpolant.d_norm_alone,
}


def cell(v: FloatArray, a0: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Row and column of the cell that holds each launch; NaN is given a place too."""
    row = np.fmin(ROWS - ROWS / (1 + v), ROWS - 1).astype(np.intp)
    column = np.fmin(a0 * (COLUMNS / domain.RIGHT_ANGLE), COLUMNS - 1).astype(np.intp)
    return row, column


def choice(rtol: float | None, method: str | None) -> float | str:
    """What was asked for: a tolerance, or the name of a tier ("exact" by default)."""
    if method is not None:
        if rtol is not None:
            raise TypeError("rtol and method exclude each other: give one of them")
        if not isinstance(method, str):
            raise TypeError(f"method must be a string; got {type(method).__name__}")
        if method not in METHODS:
            known = ", ".join(map(repr, METHODS))
            raise ValueError(f"method must be one of {known}; got {method!r}")
        return method
    if rtol is None:
        return "exact"
    if type(rtol) is float and PROMISE <= rtol < np.inf:
        return rtol
    rtol = domain.option("rtol", rtol, domain.POSITIVE)
    if rtol < PROMISE:
        raise ValueError(
            f"rtol must be at least {PROMISE:g}, which is what double precision can promise; "
            f"got {rtol!r} (for more digits: hodograph.reference)"
        )
    return rtol


def require_domain(method: str, v: FloatArray) -> None:
    """Raise `ValueError` if a launch lies outside the domain of a named tier."""
    v_max = V_MAX[method]
    rule = Rule(f"in [0, {v_max:g}] for method={method!r}", lambda a: (a >= 0) & (a <= v_max))
    domain.check("v_norm", v, rule)


def alone(v_norm: Any, alpha0: Any, n: Any, wanted: float | str) -> float | None:
    """d_norm of one launch as it was asked for; None where the arrays are to answer."""
    if wanted == "exact" or type(n) not in one.PLAIN or n != 2:
        return None if wanted in _ALONE else one.d_norm(v_norm, alpha0, n)
    if not one.is_level(v_norm, alpha0):
        return None
    v, a0 = float(v_norm), float(alpha0)
    if isinstance(wanted, str):
        return _ALONE[wanted](v, a0) if v <= V_MAX[wanted] else None
    row = min(int(ROWS - ROWS / (1 + v)), ROWS - 1)
    column = min(int(a0 * (COLUMNS / domain.RIGHT_ANGLE)), COLUMNS - 1)
    name = METHODS[_cheapest(wanted)[row * COLUMNS + column]]
    return one.d_norm(v, a0, 2.0) if name == "exact" else _ALONE[name](v, a0)


def range_alone(*fields: float, wanted: float | str) -> float | None:
    """The range in metres of one launch, its fields those of `scene`; None as in `alone`."""
    v0, alpha0, v_lim, g, height, n = fields
    if height == 0 and alpha0 >= 0:
        ratio = alone(v0 / v_lim, alpha0, n, wanted)
        return None if ratio is None else ratio * 2 * sin(alpha0) * cos(alpha0) * v0**2 / g
    found = scene.landing_of_one(("x",), *fields)
    return None if found is None else found[0]


def cheap(
    speeds: FloatArray, angles: FloatArray, wanted: float | str
) -> tuple[FloatArray, NDArray[np.intp]]:
    """d_norm of flat launches where a cheap tier serves, and the indices of the others."""
    result = np.empty(speeds.size)
    left = [np.empty(0, np.intp)]
    for first in range(0, speeds.size, BLOCK):
        v, a0 = (np.ascontiguousarray(part[first : first + BLOCK]) for part in (speeds, angles))
        out = result[first : first + BLOCK]
        if isinstance(wanted, str):
            out[:] = _EVALUATE[wanted](v, a0)
            continue
        serving = picked(v, a0, wanted)
        for number, name in enumerate(METHODS):
            here = np.flatnonzero(serving == number)
            if name == "exact":
                left.append(first + here)
            elif here.size == v.size:
                out[:] = _EVALUATE[name](v, a0)
            elif here.size:
                out[here] = _EVALUATE[name](v[here], a0[here])
    return result, np.concatenate(left)


def picked(v: FloatArray, a0: FloatArray, rtol: float) -> NDArray[np.int8]:
    """For each launch the number in `METHODS` of the cheapest tier that is good enough there."""
    row, column = cell(v, a0)
    numbers: NDArray[np.int8] = _cheapest(rtol)[row * COLUMNS + column]
    numbers[v > LAW_ALL_V_MAX] = len(METHODS) - 1
    return numbers


@lru_cache(maxsize=16)
def _cheapest(rtol: float) -> NDArray[np.int8]:
    """The same for each cell, row after row."""
    return np.asarray(serves(rtol).argmax(axis=0), np.int8).ravel()


def serves(rtol: float) -> BoolArray:
    """Whether a tier may answer, by its number in `METHODS`, row and column of the cell."""
    result = np.zeros((len(METHODS), ROWS, COLUMNS), bool)
    result[-1] = True
    for own, table in zip(result[:-1], bounds().values(), strict=True):
        good = table <= rtol
        if np.count_nonzero(good) >= LEAST * own.size:
            own[: len(table)] = good
    return result


@cache
def bounds() -> dict[str, FloatArray]:
    """Certified bounds of the cheap tiers of d_norm, cell by cell, up to the end of each."""
    import json
    from importlib.resources import files

    tables = json.loads(files("hodograph.tiers").joinpath(FILE).read_text("utf-8"))["d_norm"]
    found = {name: np.array(tables[name]["bounds"]) for name in METHODS[:-1]}
    for table in found.values():
        table.flags.writeable = False
    return found
