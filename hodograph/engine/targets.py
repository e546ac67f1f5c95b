"""What is asked about targets in SI units, as kernels of the driver: see `reach`.

Still air and a target at rest go by the slope (`aim`), all else by the time (`timing`).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hodograph.engine import aim, extremes, farthest, timing
from hodograph.engine.derivatives import derivatives
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.flight import fly
from hodograph.engine.pursuit import Chase, Triple, difference, in_units
from hodograph.engine.status import Status

UPRIGHT = 1e-17  # distance over height, below which a launch is straight up or down
FASTEST = 10.0  # speeds that are looked for where one is given, in its units and the wind's
FASTEST_OF_ALL = 1e8  # where none is, in units of that without drag, and of v_lim
ROWS = ("alpha0", "azimuth", "t", "speed", "alpha", "shortfall")

Rows = tuple[list[FloatArray], Codes]


def shots(side: float) -> Callable[..., Rows]:
    """The kernel that gives `ROWS` of launches that hit: -1 by the low arc, 1 by the high one."""

    def kernel(
        v0: FloatArray, x: FloatArray, y: FloatArray, v_lim: FloatArray,
        n: FloatArray, g: FloatArray, *moving: FloatArray,
    ) -> Rows:  # fmt: skip
        rows, codes = np.full((len(ROWS), v0.size), np.nan), np.zeros(v0.shape, np.int8)
        still = ~np.any([part != 0 for part in moving], axis=0)
        here = (x == 0) & (y == 0) & (side < 0)  # met before it has begun
        rows[:, here] = 0.0
        rows[3, here] = v0[here]
        for which, shoot in ((still & ~here, _in_still_air), (~still & ~here, _in_wind)):
            at = np.flatnonzero(which)
            if at.size:
                given = (part[at] for part in (v0, x, y, v_lim, n, g, *moving))
                rows[:, at], codes[at] = shoot(side, *given)
        return list(rows), codes

    return kernel


def _in_still_air(
    side: float, v0: FloatArray, x: FloatArray, y: FloatArray, v_lim: FloatArray,
    n: FloatArray, g: FloatArray, *_: FloatArray,
) -> tuple[FloatArray, Codes]:  # fmt: skip
    time = v0 / g
    length = v0 * time
    X, Y = np.abs(x) / length, y / length
    X = np.maximum(X, UPRIGHT * np.maximum(np.abs(Y), 1.0 if side > 0 else 0.0))
    found = aim.meet(aim.Target(v0 / v_lim, n, X, Y, np.full_like(X, side)))
    azimuth = np.where(x < 0, np.pi, 0.0)
    rows = [
        np.arctan(found.T), azimuth, found.t * time, found.speed * v0, np.arctan(found.p),
        found.shortfall * length,
    ]  # fmt: skip
    return np.stack(rows), found.status


def _chase(
    c: FloatArray, v_lim: FloatArray, n: FloatArray, g: FloatArray, place: Triple,
    velocity: Triple, wind: Triple, most: FloatArray,
) -> Chase:  # fmt: skip
    """Places and velocities over the ground, in units of the speed c and in the air."""
    W = in_units(wind, c)
    V = difference(in_units(velocity, c), W)
    return Chase(c / v_lim, n, in_units(place, c * (c / g)), V, W, most)


def _over_ground(own: Chase, air: Triple) -> Triple:
    """Elevation, azimuth and size of a velocity over the ground, from that through the air."""
    x, y, z = (u + W for u, W in zip(air, own.W, strict=True))
    level = np.hypot(x, z)
    return np.arctan2(y, level), np.arctan2(z, x), np.hypot(y, level)


def _in_wind(
    side: float, v0: FloatArray, x: FloatArray, y: FloatArray, v_lim: FloatArray,
    n: FloatArray, g: FloatArray, wind: FloatArray, crosswind: FloatArray,
    v_x: FloatArray, v_y: FloatArray, v_z: FloatArray,
) -> tuple[FloatArray, Codes]:  # fmt: skip
    zero = np.zeros_like(v0)
    blows = wind, zero, crosswind
    most = FASTEST * (1 + np.hypot(wind, crosswind) / v0)
    own = _chase(v0, v_lim, n, g, (x, y, zero), (v_x, v_y, v_z), blows, most)
    t, throw, codes = timing.arcs(own, np.full_like(v0, side))
    alpha0, azimuth, _ = _over_ground(own, throw.u)
    alpha, _, speed = _over_ground(own, throw.end)
    short = zero.copy()
    out = np.flatnonzero(codes == Status.UNREACHABLE)
    if out.size:
        s, _, found = timing.reach(own.at(out), (0.0, 1.0, 0.0), zero[out])
        nowhere = np.where(found == Status.UNREACHABLE, np.inf, np.nan)
        short[out] = np.where(found == Status.CONVERGED, np.maximum(-s, 0.0), nowhere)
    time = v0 / g
    return np.stack([alpha0, azimuth, t * time, speed * v0, alpha, short * time * v0]), codes


def least_speeds(
    x: FloatArray, y: FloatArray, v_lim: FloatArray, n: FloatArray, g: FloatArray, wind: FloatArray
) -> Rows:
    """The kernel that gives the least speed that hits each target, and its angle."""
    zero = np.zeros_like(x)
    here = (x == 0) & (y == 0)
    c = np.sqrt(g * np.where(here, 1.0, np.hypot(x, y)))
    most = FASTEST_OF_ALL * (1 + v_lim.clip(max=100 * c) / c)
    own = _chase(c, v_lim, n, g, (x, y, zero), (zero, zero, zero), (wind, zero, zero), most)
    edge = timing.least(own)
    alpha0, _, _ = _over_ground(own, edge.throw.u)
    codes = np.where(here, np.int8(Status.CONVERGED), edge.status)
    return [np.where(here, 0.0, edge.speed * c), np.where(here, 0.0, alpha0)], codes


def envelopes(
    v0: FloatArray, x: FloatArray, v_lim: FloatArray, n: FloatArray, g: FloatArray, wind: FloatArray
) -> Rows:
    """The kernel that gives the greatest height that is reached at x, and its angle."""
    time = v0 / g
    length = v0 * time
    X, zero = np.abs(x) / length, np.zeros_like(v0)
    y, alpha0, codes = zero.copy(), zero.copy(), np.zeros(v0.shape, np.int8)
    at = np.flatnonzero(wind == 0)
    if at.size:
        target = aim.Target((v0 / v_lim)[at], n[at], np.maximum(X, UPRIGHT)[at], zero[at], zero[at])
        top = aim.highest(target)
        y[at], alpha0[at] = aim.height(target, top), np.arctan(top.T)
        codes[at] = np.where(top.done, Status.CONVERGED, Status.NOT_CONVERGED)
        codes[at[np.isinf(y[at])]] = Status.UNREACHABLE
    at = np.flatnonzero(wind != 0)
    if at.size:
        rest, blows = (zero, zero, zero), (wind, zero, zero)
        most = FASTEST * (1 + np.abs(wind) / v0)
        own = _chase(v0, v_lim, n, g, (x, zero, zero), rest, blows, most).at(at)
        vacuum = 0.5 - 0.5 * X[at] ** 2
        y[at], edge, codes[at] = timing.reach(own, (0.0, 1.0, 0.0), vacuum)
        alpha0[at], _, _ = _over_ground(own, edge.throw.u)
    return [y * length, alpha0], codes


def best_angles(level: Callable[..., Rows]) -> Callable[..., Rows]:
    """The kernel that gives the angle of greatest range; `level` does that on level ground."""

    def kernel(
        v0: FloatArray, v_lim: FloatArray, g: FloatArray, height: FloatArray, n: FloatArray,
        slope: FloatArray, wind: FloatArray,
    ) -> Rows:  # fmt: skip
        angle, codes = np.zeros_like(v0), np.zeros(v0.shape, np.int8)
        plain = (slope == 0) & (wind == 0)
        at = np.flatnonzero(plain)
        if at.size:
            given = (part[at] for part in (v0, v_lim, g, height, n))
            (angle[at],), codes[at] = _best_in_still_air(level, *given)
        at = np.flatnonzero(~plain)
        if at.size:
            scene = v0, v_lim, g, height, n, slope, wind
            angle[at], codes[at] = farthest.best(*(part[at] for part in scene))
        return [angle], codes

    return kernel


def _best_in_still_air(
    level_ground: Callable[..., Rows],
    v0: FloatArray, v_lim: FloatArray, g: FloatArray, height: FloatArray, n: FloatArray,
) -> Rows:  # fmt: skip
    from scipy.optimize import elementwise  # slow to import

    own = extremes.scale(v0, np.full_like(v0, RIGHT_ANGLE), v_lim, g, height, n)
    upright = fly(own.v, own.alpha0, own.height, n, ())  # which reaches highest
    codes, angle = upright.status.copy(), np.zeros_like(v0)
    level = np.flatnonzero(height == 0)
    (angle[level],), codes[level] = level_ground(own.v[level], n[level])
    at = np.flatnonzero((height != 0) & (codes == Status.CONVERGED))
    if at.size:
        found = elementwise.find_root(
            _upward,
            (np.zeros(at.size), np.full(at.size, RIGHT_ANGLE)),
            args=(own.v[at], own.height[at], n[at]),
            tolerances={"xrtol": 1e-15, "xatol": 0.0, "fatol": 0.0},
            maxiter=400,
        )
        angle[at] = found.x * own.rest[at]
        codes[at[~found.success]] = Status.NOT_CONVERGED
    return [angle], codes


def _upward(alpha0: FloatArray, v: FloatArray, height: FloatArray, n: FloatArray) -> FloatArray:
    """Positive below the angle of greatest range, and where the height is not reached."""
    flight = fly(v, alpha0, height, n, ("x",))
    found = derivatives(flight, of_angle=True)
    whole = np.tan(alpha0) + found.Q
    slant = np.divide(found.alpha0, whole, out=np.ones_like(whole), where=whole > 0)
    return np.where((flight.status == Status.UNREACHABLE) | (found.Q == 0), 1.0, slant)
