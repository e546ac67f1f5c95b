"""How the range answers to a change of the launch, and the best angle for any landing height.

With the landing held at its height, and q = -tan(alpha_s), a change of the launch moves it by::

    dR = dx + (dy + dh) / q    (dx, dy: of the point of slope alpha_s, h: launch height),

and eq. 15 is differentiated under the integral.  In units of v0^2 / g and v0 / g, with
p = tan(alpha), v = v_norm, (s, c) = (sin, cos)(alpha0), u the bracket of eq. 13, and integrals
over the path from p0 down to -q::

    dR/dalpha0 = [(p0 + q) - 2 c (s + v^2) I] / q,    I = integral of (p + q) / u^2 dp,
               = [(s + v^2) J - (p0 + q) s c] / (q c v^2),
    v0 dR/dv0 = 2 c^2 I / q,    dR/dh = 1 / q,
    v_lim dR/dv_lim = 2 v^2 c^4 / q times the integral of (p + q) (F(p0) - F(p)) / u^2 dp,

with J as in `optimum`: the first form of dR/dalpha0 serves slow launches, the second fast ones.
Range is a length, so that v0 dR/dv0 + v_lim dR/dv_lim + 2 h dR/dh = 2 R, which gives the last one
where drag is strong.
"""

from __future__ import annotations

from typing import Any, Generic, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import elementwise

from hodograph import domain
from hodograph.domain import RIGHT_ANGLE, FloatArray, Scalar, T
from hodograph.flight import (
    CONVERGED,
    NOT_CONVERGED,
    SHALLOWEST,
    UNREACHABLE,
    Flight,
    blocks,
    fly,
    warn_not_converged,
)
from hodograph.optimum import optimal_angle
from hodograph.position import arc, gauss_legendre, node_sum, widen
from hodograph.velocity import Start, bracket_gap, least_speed, start

DEEPEST = 1e250  # height in v^2 / g: deeper falls have long been at terminal speed
WEAK = 1.0  # u - 1 at the landing, below which the derivative in v_lim has an integral of its own
NODES = 96  # for that
STEEP = 0.2  # cos(alpha0) below which the range is nearly proportional to it
FAST = 10.0  # v_norm up to which the closed forms serve there as well
STEP = 0.01  # of ln cos(alpha0) in the differences taken there, of sixth order
NEAR = 0.5  # the least distance in ln cos(alpha0) to a launch that just reaches the height
STENCIL = {k: w / 60 for k, w in zip((-3, -2, -1, 1, 2, 3), (-1, 9, -45, 45, -9, 1), strict=True)}


class Sensitivity(NamedTuple, Generic[T]):
    """The range in metres, and its derivatives: see `range_sensitivity`."""

    range: T
    alpha0: T  # m per radian
    v0: T  # m per m/s, at fixed v_lim
    v_lim: T  # m per m/s, at fixed v0; 0 in vacuum
    height: T  # m per m that the launch is raised


class _Path(NamedTuple):
    """What the derivatives are made of, in units of the launch."""

    flight: Flight
    q: FloatArray
    p0: FloatArray
    sin0: FloatArray
    cos0: FloatArray
    rise: dict[str, FloatArray]
    fall: dict[str, FloatArray]
    across: FloatArray  # cos(alpha) where the fall begins is 1, or cos0 if that is the launch
    u_top: FloatArray


def _land(v: FloatArray, alpha0: FloatArray, height: FloatArray) -> Flight:
    """`fly`; a depth beyond the doubles is as good as any at terminal speed."""
    with np.errstate(over="ignore"):
        return fly(v, alpha0, height, ("x",))


def _fly(v: FloatArray, alpha0: FloatArray, height: FloatArray) -> _Path:
    flight = _land(v, alpha0, height)
    q = np.sqrt(flight.down.P)
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    downward = sin0 < 0
    wanted = ("dx", "dy", "cos", "sin")
    rise = arc(start(v * v, sin0, cos0), None, flight.slope, wanted)
    slope = np.where(downward, np.arcsinh(np.minimum(sin0, 0.0) / cos0), 0.0)
    fall = arc(flight.top, slope, flight.down.delta, wanted)
    u_top = np.where(downward, 1.0, 1 + v * v * flight.gap_up)
    across = np.where(downward, cos0, 1.0)
    return _Path(flight, q, sin0 / cos0, sin0, cos0, rise, fall, across, u_top)


def _impulse(path: _Path) -> FloatArray:
    """I, the integral of (p + q) / u^2 dp."""
    rise, fall, cos0, across, u2 = path.rise, path.fall, path.cos0, path.across, path.u_top**2
    one = rise["dx"] / cos0 + fall["dx"] / (across * u2)
    tangent = rise["dy"] / cos0**2 + fall["dy"] / (across**2 * u2)
    return np.asarray(tangent + path.q * one)


def _tilt(v: FloatArray, path: _Path) -> FloatArray:
    """q dR/dalpha0, by the form that keeps its digits."""
    rise, fall, cos0, sin0, q = path.rise, path.fall, path.cos0, path.sin0, path.q
    v2 = v * v
    whole = path.p0 + q
    slow = whole - 2 * cos0 * (sin0 + v2) * _impulse(path)
    cosine = rise["cos"] * cos0**2 + fall["cos"] * path.across**2 / path.u_top
    sine = rise["sin"] * cos0 + fall["sin"] * path.across / path.u_top
    square = np.maximum(v2, 1.0)
    fast = ((sin0 / square + 1) * (cosine - q * sine) - whole * sin0 * cos0 / square) / cos0
    return np.asarray(np.where(v2 * cos0**3 <= 1, slow, fast))


def _slant(v: FloatArray, alpha0: FloatArray, height: FloatArray, path: _Path) -> FloatArray:
    """dR/dalpha0.  Both forms of `_tilt` cancel for steep fast launches.

    There R = cos(alpha0) r, where r changes with cos(alpha0)^2 only: its slope in
    ln(cos(alpha0)) is small, and differences give it to enough digits.  Not so close to the
    launch whose highest point is the landing, where r turns as a square root: there (q cos)^2,
    which goes as the fall, changes over the differences, and the closed forms stay.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        slant = _tilt(v, path) / path.q
    at = np.flatnonzero((path.cos0 < STEEP) & (path.sin0 > 0) & (v > FAST))
    if at.size:
        cos0 = path.cos0[at]
        slope, change = np.zeros(at.size), np.zeros(at.size)
        for k, weight in STENCIL.items():
            cos = cos0 * np.exp(STEP * k)
            flight = _land(v[at], RIGHT_ANGLE - np.arcsin(cos), height[at])
            slope += weight / STEP * flight.reach
            change += weight / STEP * flight.down.P * cos**2
        smooth = np.abs(change) * NEAR < (path.q[at] * cos0) ** 2
        smooth &= np.isfinite(slope)
        at, slope = at[smooth], slope[smooth]
        slant[at] = -path.sin0[at] * (path.flight.reach[at] + slope)
    return slant


def _moments(
    begin: Start, delta: FloatArray, q: FloatArray, cos: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrals of (p + q) gap / u^2 dp and of (p + q) / u^2 dp over an arc of weak drag.

    u = 1 + v2 gap is counted from the beginning of the arc, where the cosine is `cos`.
    """
    nodes, weights = gauss_legendre(NODES)
    at = widen(delta) * nodes
    gap, C = bracket_gap(begin, at)
    growth = np.expm1(at)
    S = begin.sin - 0.5 * growth * (begin.plus / (1 + growth) + begin.minus)  # C sin(alpha)
    terms = weights * (S / cos + q) * C / cos / (1 + begin.v2 * gap) ** 2
    return node_sum(terms * gap, delta.size) * delta, node_sum(terms, delta.size) * delta


def _drag_part(v: FloatArray, path: _Path, balance: FloatArray) -> FloatArray:
    """v_lim dR/dv_lim: by its own integral where drag is weak, else what homogeneity leaves."""
    flight = path.flight
    gap_fall = bracket_gap(flight.top, flight.down.delta)[0]
    weak = path.u_top * (1 + flight.top.v2 * gap_fall) - 1 < WEAK
    result = balance
    if weak.any():
        at = np.flatnonzero(weak)
        q, cos0 = path.q[at], path.cos0[at]
        begin = start(v[at] ** 2, path.sin0[at], cos0)
        climbing = np.where(path.sin0[at] < 0, 0.0, flight.slope[at])
        up, _ = _moments(begin, climbing, q, cos0)
        fall, level = _moments(flight.top.at(at), flight.down.delta[at], q, path.across[at])
        ratio = (cos0 / path.across[at]) ** 2
        down = (ratio * fall + flight.gap_up[at] * level) / path.u_top[at] ** 2
        result[at] = 2 * (v[at] * cos0) ** 2 / q * (up + down)
    return result


def _scaled(
    v0: FloatArray, v_lim: FloatArray, g: FloatArray, height: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Launch speed to compute with, v_norm and height by it, and v0 over it.

    It is not v0 for a launch almost at rest, where all depends on v0 by a factor.
    """
    speed = np.maximum(v0, least_speed(v_lim, g, height))
    with np.errstate(over="ignore"):
        depth = np.clip(height / speed * g / speed, -DEEPEST, DEEPEST)
    return speed, speed / v_lim, depth, v0 / speed


def _split(height: FloatArray, alpha0: FloatArray, v: FloatArray) -> tuple[FloatArray, ...]:
    """Launches that `fly` takes, and the factor that a level launch below 1e-100 rad is raised by.

    What such a launch does depends on v^2 alpha0 alone.
    """
    shallow = (height == 0) & (alpha0 > 0) & (alpha0 < SHALLOWEST)
    shrink = np.where(shallow, alpha0 / SHALLOWEST, 1.0)
    return v * np.sqrt(shrink), np.where(shallow, SHALLOWEST, alpha0), shrink


@overload
def range_sensitivity(
    v0: Scalar, alpha0: Scalar, v_lim: Scalar, *, g: Scalar = 9.81, height: Scalar = 0.0
) -> Sensitivity[np.float64]: ...
@overload
def range_sensitivity(
    v0: ArrayLike,
    alpha0: ArrayLike,
    v_lim: ArrayLike,
    *,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
) -> Sensitivity[FloatArray]: ...
def range_sensitivity(
    v0: ArrayLike,
    alpha0: ArrayLike,
    v_lim: ArrayLike,
    *,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
) -> Sensitivity[Any]:
    """The range and its derivatives in alpha0, v0, v_lim and height.

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, in [1e-30, 1e30].
    alpha0 : array_like
        Launch angle in radians, in [-pi/2, pi/2].
    v_lim : array_like
        Terminal speed of fall in m/s, at least 1e-30; ``inf`` is vacuum.  v0 / v_lim is at most
        1e20.
    g : array_like, optional
        Gravity in m/s^2, positive.
    height : array_like, optional
        Height of the launch above the landing plane in m; negative for a target above it.

    Returns
    -------
    Sensitivity
        `range` in m, and its derivatives: `alpha0` in m per radian, `v0` at fixed v_lim and
        `v_lim` at fixed v0 (0 in vacuum) in m per m/s, and `height` in m per metre that the
        launch is raised; all of the broadcast shape.  NaN where an input is NaN, where the
        landing height is never reached, where a level launch goes nowhere, and where the
        iteration failed (with one `RuntimeWarning`).  The relative error is about 1e-13, where
        dR/dalpha0 passes through 0 in units of the range.  It is larger in two places.

        dR/dalpha0 of steep fast launches: up to 4e-12 near 78 degrees, and up to 2e-8 above that
        where the landing is within 1% of the highest point.

        A downward launch that lands so soon that its slope hardly changes: with f = g height
        / v0^2, dR/dalpha0 is off by about 2e-16 / f, and dR/dv0 and dR/dv_lim, which vanish
        with f, by up to 1e-15 of range / v0 and range / v_lim.  At 40 m/s and -0.5 rad, with
        v_lim 42.7 m/s, dR/dv0 has a relative error of 2e-11 from 1 mm, 1e-9 from 1 um and 2e-5
        from 1 nm.

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    A baseball at 45 degrees: a degree more costs 0.4 m, a metre per second more brings 3.3 m.

    >>> import numpy as np
    >>> found = range_sensitivity(40.0, np.pi / 4, 42.7)
    >>> print(f"{found.alpha0 * np.pi / 180:.2f} m per degree, {found.v0:.2f} m per m/s")
    -0.36 m per degree, 3.26 m per m/s
    """
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        alpha0=(alpha0, domain.SLOPE_ANGLE),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        g=(g, domain.GRAVITY),
        height=(height, domain.HEIGHT),
    )
    speeds, angles, limits, gravities, heights = (np.ravel(array) for array in arrays)
    domain.check_scene(arrays[0], *arrays[2:])
    results = np.full((5, speeds.size), np.nan)
    known = np.flatnonzero(~np.isnan(sum(np.ravel(array) for array in arrays)))
    failed = 0
    for block in blocks(known.size):
        at = known[block]
        speed, v, h, rest = _scaled(speeds[at], limits[at], gravities[at], heights[at])
        rows, lost = _sensitivity(v, angles[at], h)
        failed += lost
        with np.errstate(over="ignore", invalid="ignore"):  # a result beyond the doubles is inf
            per_speed = speed / gravities[at]
            length = speed * per_speed * rest
            in_limit = np.where(v == 0, 0.0, v * per_speed * rest)
            results[:, at] = (
                rows[0] * length,
                rows[1] * length,
                rows[2] * per_speed,
                rows[3] * in_limit,
                rows[4] * rest,
            )
    warn_not_converged(failed, speeds.size)
    return Sensitivity(*(domain.restore(row, shape) for row in results))


def _sensitivity(
    v: FloatArray, alpha0: FloatArray, height: FloatArray
) -> tuple[list[FloatArray], int]:
    """R, dR/dalpha0, v0 dR/dv0, v_lim dR/dv_lim, dR/dh in units of v0^2 / g; how many failed."""
    v, a0, shrink = _split(height, alpha0, v)
    path = _fly(v, a0, height)
    flight, q = path.flight, path.q
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = flight.reach * path.cos0
        raised = np.exp(-flight.beyond) / q
        tilted = _slant(v, a0, height, path)
        faster = 2 * path.cos0**2 * _impulse(path) / q
        # v0 dR/dv0 + v_lim dR/dv_lim + 2 h dR/dh = 2 R
        freer = _drag_part(v, path, 2 * distance - faster - 2 * height * raised)
        rows = [distance * shrink, tilted, faster * shrink, freer * shrink, raised / shrink]
    landed = (flight.status == CONVERGED) & (q > 0)
    lost = (flight.status != CONVERGED) & (flight.status != UNREACHABLE)
    return [np.where(landed, row, np.nan) for row in rows], int(np.count_nonzero(lost))


def _upward(alpha0: FloatArray, v: FloatArray, height: FloatArray) -> FloatArray:
    """Positive below the angle of greatest range, and where the height is not reached."""
    path = _fly(v, alpha0, height)
    missed = path.flight.status == UNREACHABLE
    with np.errstate(divide="ignore", invalid="ignore"):
        slant = _slant(v, alpha0, height, path) * (path.q / (path.p0 + path.q))
    return np.asarray(np.where(missed, 1.0, np.where(path.q > 0, slant, 1.0)))


@overload
def best_angle(
    v0: Scalar, v_lim: Scalar, *, g: Scalar = 9.81, height: Scalar = 0.0
) -> np.float64: ...
@overload
def best_angle(
    v0: ArrayLike, v_lim: ArrayLike, *, g: ArrayLike = 9.81, height: ArrayLike = 0.0
) -> FloatArray: ...
def best_angle(
    v0: ArrayLike, v_lim: ArrayLike, *, g: ArrayLike = 9.81, height: ArrayLike = 0.0
) -> Any:
    """Launch angle of greatest range for any landing height, from the root of dR/dalpha0.

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, in [1e-30, 1e30].
    v_lim : array_like
        Terminal speed of fall in m/s, at least 1e-30; ``inf`` is vacuum.  v0 / v_lim is at most
        1e20.
    g : array_like, optional
        Gravity in m/s^2, positive.
    height : array_like, optional
        Height of the launch above the landing plane in m; negative for a target above it.

    Returns
    -------
    float or ndarray
        The angle in radians, of the broadcast shape, to about 1e-13 relative.  NaN where an input
        is NaN, where the landing height is reached at no angle, and where the iteration failed
        (with a `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    A shot of 14 m/s without drag, put from 2 m: tan(alpha) = v0 / sqrt(v0^2 + 2 g h)

    >>> import numpy as np
    >>> round(float(np.rad2deg(best_angle(14.0, np.inf, height=2.0))), 4)
    42.3896
    """
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        g=(g, domain.GRAVITY),
        height=(height, domain.HEIGHT),
    )
    domain.check_scene(*arrays)
    _, v, depth, rest = _scaled(*(np.ravel(array) for array in arrays))
    angle = np.full(v.size, np.nan)
    level = depth == 0
    angle[level] = optimal_angle(v[level])
    others = np.flatnonzero(~level & ~np.isnan(v + depth))
    failed = 0
    for block in blocks(others.size):
        at = others[block]
        top = np.full(at.size, RIGHT_ANGLE)
        status = _land(v[at], top, depth[at]).status
        failed += int(np.count_nonzero(status == NOT_CONVERGED))
        reached = status == CONVERGED
        at = at[reached]
        if at.size:
            found = elementwise.find_root(
                _upward,
                (np.zeros(at.size), top[reached]),
                args=(v[at], depth[at]),
                tolerances={"xrtol": 1e-15, "xatol": 0.0, "fatol": 0.0},
                maxiter=400,
            )
            angle[at] = np.where(found.success, found.x * rest[at], np.nan)
            failed += int(np.count_nonzero(~found.success))
    warn_not_converged(failed, v.size)
    return domain.restore(angle, shape)
