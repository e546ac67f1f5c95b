"""The dial: which way to d_norm is the cheapest that is known to meet a tolerance.

There are three ways, or tiers: a short law, the surrogate, the exact engine.  For each of the
first two the file bounds.json holds a bound on the relative error, cell by cell of its domain:
measured by ``hodograph surrogate`` (see `certify`), never typed in.  Cells are uniform in
sqrt(v_norm) and in alpha0.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph import domain, laws, surrogate
from hodograph.domain import BoolArray, FloatArray, Rule

METHODS = ("law", "surrogate", "exact")  # the cheapest first
PROMISE = 1e-13  # the tightest relative error that the exact engine is held to
BLOCK = 8192
FILE = "bounds.json"

LAW, LAW_V_MAX = laws.d_norm_law, 6.0

V_MAX = {"law": LAW_V_MAX, "surrogate": surrogate.V_MAX}


class Tier(NamedTuple):
    """A way to d_norm for v_norm <= v_max, and where it is good enough (None: everywhere)."""

    evaluate: Callable[[FloatArray, FloatArray], FloatArray]
    v_max: float
    reach: float
    good: BoolArray | None


def _law(v: FloatArray, a0: FloatArray) -> FloatArray:
    return np.asarray(LAW(v, a0))


def cell(
    v: FloatArray, a0: FloatArray, v_max: float, shape: tuple[int, ...]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Indices of the cells that hold the launches; those outside are put in the last."""
    rows, columns = shape
    i = (np.sqrt(np.fmin(v, v_max)) * (rows / v_max**0.5)).astype(np.intp)
    j = (np.fmin(a0, domain.RIGHT_ANGLE) * (columns / domain.RIGHT_ANGLE)).astype(np.intp)
    return np.minimum(i, rows - 1), np.minimum(j, columns - 1)


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


def tiers(wanted: float | str) -> list[Tier]:
    """The tiers that may serve, cheapest first; the exact engine, which always may, is left out."""
    evaluate = {"law": _law, "surrogate": surrogate.flat_d_norm}
    if wanted == "exact":
        return []
    if isinstance(wanted, str):
        return [Tier(evaluate[wanted], V_MAX[wanted], V_MAX[wanted], None)]
    found = []
    for name, table in bounds().items():
        v_max, good = V_MAX[name], table <= wanted
        if good.all():
            found.append(Tier(evaluate[name], v_max, v_max, None))
        elif good.any():
            last = int(np.flatnonzero(good.any(axis=1))[-1])
            reach = min(v_max * ((last + 1) / len(table)) ** 2 * (1 + 1e-12), v_max)
            found.append(Tier(evaluate[name], v_max, reach, good))
    return found


def _serves(tier: Tier, v: FloatArray, a0: FloatArray) -> BoolArray:
    near = v <= tier.reach  # not where v is NaN
    if tier.good is None or not near.any():
        return near
    return near & tier.good[cell(v, a0, tier.v_max, tier.good.shape)]


def cheap(
    speeds: FloatArray, angles: FloatArray, wanted: float | str
) -> tuple[FloatArray, NDArray[np.intp]]:
    """d_norm of flat launches where a cheap tier serves, and the indices of the others."""
    result = np.empty(speeds.size)
    candidates = tiers(wanted)
    left = []
    for first in range(0, speeds.size, BLOCK):
        v, a0 = (np.ascontiguousarray(part[first : first + BLOCK]) for part in (speeds, angles))
        out = result[first : first + BLOCK]
        at: NDArray[np.intp] | None = None  # None: all of the block
        for tier in candidates:
            serves = _serves(tier, v, a0)
            if not serves.any():
                continue
            whole = serves.all()
            values = tier.evaluate(*((v, a0) if whole else (v[serves], a0[serves])))
            if at is None and whole:
                out[:] = values
            else:
                here = np.arange(v.size) if at is None else at
                out[here[serves]] = values
                at, v, a0 = here[~serves], v[~serves], a0[~serves]
                if at.size:
                    continue
            at = np.empty(0, np.intp)
            break
        left.append(first + (np.arange(v.size) if at is None else at))
    return result, np.concatenate(left) if left else np.empty(0, np.intp)


@cache
def bounds() -> dict[str, FloatArray]:
    """Certified bounds of the cheap tiers of d_norm, cell by cell."""
    import json
    from importlib.resources import files

    tables = json.loads(files("hodograph").joinpath(FILE).read_text("utf-8"))["d_norm"]
    return {name: np.array(tables[name]["bounds"]) for name in METHODS[:-1]}
