"""A track as it is handed in: the points that count, what is held, what is bounded."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, labels
from hodograph.engine.domain import BoolArray, FloatArray

NAMES = ("v0", "alpha0", "k", "n", "x0", "y0", "t0")  # of the parameters, in this order
RULES = {
    "v0": domain.LAUNCH_SPEED,
    "alpha0": domain.SLOPE_ANGLE,
    "k": domain.NON_NEGATIVE,
    "v_lim": domain.TERMINAL_SPEED,
    "x0": domain.HEIGHT,
    "y0": domain.HEIGHT,
    "t0": domain.FINITE,
}
SLOWEST = 1e-9  # speed of a launch from rest, in g times the time of the track
ORDERED = 0.9  # rank correlation of x with the rows, from which these tell where the flight goes


class Film(NamedTuple):
    """The points of a track that count, their noise, and gravity; without times `t` is None."""

    t: FloatArray | None
    x: FloatArray
    y: FloatArray
    sigma_x: FloatArray
    sigma_y: FloatArray
    g: float

    @property
    def equations(self) -> int:
        """Residuals that the points leave."""
        return len(self.x) * (1 if self.t is None else 2)


def points(
    x: ArrayLike, y: ArrayLike, t: ArrayLike | None, sigma: Any, g: float
) -> tuple[Film, BoolArray]:
    """The points that count, and which these are."""
    given = {"x": x, "y": y} | ({} if t is None else {"t": t})
    labels.one_index(**given)
    columns = {name: domain.checked(name, value, domain.HEIGHT) for name, value in given.items()}
    shape = columns["x"].shape
    if len(shape) != 1 or any(column.shape != shape for column in columns.values()):
        shapes = ", ".join(f"{name} {column.shape}" for name, column in columns.items())
        raise ValueError(f"x, y and t must be of one length, one number a point; got {shapes}")
    pair = sigma if isinstance(sigma, tuple | list) and len(sigma) == 2 else (sigma, sigma)
    if sigma is None:
        pair = (1.0, 1.0)
    if t is None and pair is not sigma:
        pair = (0.0, pair[1])
    noise = []
    for name, each in zip(("sigma of x", "sigma of y"), pair, strict=True):
        row = domain.checked(name, each, domain.NON_NEGATIVE)
        if row.shape not in ((), shape):
            both = " (of x and of y: a tuple of two)" if row.shape[:1] == (2,) else ""
            raise ValueError(
                f"{name} must be one number, or one a point; got shape {row.shape}{both}"
            )
        noise.append(np.broadcast_to(row, shape))
    kept = np.isfinite(sum([*columns.values(), *noise]))
    bad = (noise[1] == 0) | ((noise[0] == 0) & (t is not None))
    if (bad & kept).any():
        raise ValueError("sigma must be > 0 (without times, that of x may be 0)")
    times = columns["t"][kept] if "t" in columns else None
    given_at = (columns["x"][kept], columns["y"][kept], noise[0][kept], noise[1][kept])
    if kept.sum() < 3:
        raise ValueError(f"a track needs at least 3 points; got {int(kept.sum())} without NaN")
    if times is not None and np.ptp(times) == 0:
        raise ValueError("t must not be the same for all points")
    if np.ptp(given_at[0]) == 0 and np.ptp(given_at[1]) == 0:
        raise ValueError("x and y must not be the same for all points")
    if times is None and np.ptp(given_at[0]) == 0:
        raise ValueError("without times, x must not be the same for all points: give t")
    return Film(times, *given_at, g), kept


def held(
    fixed: Mapping[str, Any], n: float | None, g: float, *, timed: bool = True
) -> dict[str, float]:
    """The parameters that are held, by NAMES."""
    values = {}
    for name, value in _by_name("fixed", fixed, timed=timed).items():
        if name not in RULES:
            hint = " (n is an argument: n=...)" if name == "n" else ""
            raise ValueError(f"fixed has no {name!r}; it may hold {', '.join(RULES)}{hint}")
        values[name] = domain.option(f"fixed[{name!r}]", value, RULES[name])
    if "v_lim" in values:
        if n is None or "k" in values:
            raise ValueError("fixed['v_lim'] needs a given n, and no fixed['k'] beside it")
        values["k"] = g / values.pop("v_lim") ** n
    return values


def _by_name(what: str, given: Mapping[str, Any], *, timed: bool) -> Mapping[str, Any]:
    """What is given by names of parameters, t0 not without times."""
    if not isinstance(given, Mapping):
        raise TypeError(f"{what} must be a dict by names of parameters; got {given!r}")
    if "t0" in given and not timed:
        raise ValueError(f"{what} has 't0', which a track without times has not: give t")
    return given


def limits(
    bounds: Mapping[str, Any],
    held: Mapping[str, float],
    n: float | None,
    *,
    timed: bool = True,
) -> tuple[FloatArray, FloatArray]:
    """Bounds by NAMES; what of them are infinite, the fit does without."""
    low, high = np.full(len(NAMES), -np.inf), np.full(len(NAMES), np.inf)
    if n is None:
        low[NAMES.index("n")], high[NAMES.index("n")] = 1.0, 10.0
    for name, pair in _by_name("bounds", bounds, timed=timed).items():
        if name not in NAMES or name in held or (name == "n" and n is not None):
            hint = {"n": " (n=None fits it)", "v_lim": " (bound k, which is g/v_lim^n)"}
            raise ValueError(
                f"bounds has {name!r}, which is not fitted{hint.get(name, '')}; known are "
                f"{', '.join(NAMES)}"
            )
        ends = domain.as_float(f"bounds[{name!r}]", pair)
        if ends.shape != (2,) or not ends[0] < ends[1]:
            raise ValueError(f"bounds[{name!r}] must be (least, greatest); got {pair!r}")
        _check_reach(name, ends)
        at = NAMES.index(name)
        low[at], high[at] = ends if name != "n" else np.clip(ends, 1.0, 10.0)
    return low, high


def _check_reach(name: str, ends: FloatArray) -> None:
    """Refuse bounds that no flight is within."""
    given = f"bounds[{name!r}] must be"
    if name == "n" and not (ends[0] < 10 and ends[1] > 1):
        raise ValueError(f"{given} within [1, 10]; got {tuple(ends.tolist())}")
    if name in ("v0", "k") and ends[1] <= 0:
        raise ValueError(f"{given} (least, greatest), the latter > 0; got {tuple(ends.tolist())}")
    if name == "alpha0" and (np.isfinite(ends) & (np.abs(ends) > np.pi)).any():
        raise ValueError(
            f"{given} in [-pi, pi] radians; got {tuple(ends.tolist())} (if these are degrees: "
            "np.deg2rad)"
        )


def headings(track: Film) -> tuple[int, ...]:
    """The ways along x in which the flight may go: by time, or by the order of the rows."""
    if track.t is not None:
        return (-1,) if np.sum((track.t - track.t.mean()) * track.x) < 0 else (1,)
    rank = np.argsort(np.argsort(track.x))
    order = float(np.corrcoef(rank, np.arange(rank.size))[0, 1])
    way = -1 if order < 0 else 1
    return (way,) if abs(order) > ORDERED else (way, -way)


def spread(residuals: FloatArray) -> float:
    """Standard deviation of most of them: 1.4826 medians of their size."""
    return 1.4826 * float(np.median(np.abs(residuals)))
