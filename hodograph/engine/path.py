"""Points along a path, evenly spaced in arc length, each at the cost of one short arc."""

from __future__ import annotations

import numpy as np

from hodograph.engine import extremes, power, velocity
from hodograph.engine import flight as flying
from hodograph.engine.domain import FloatArray
from hodograph.engine.flight import Flight
from hodograph.engine.velocity import Start, bracket_gap, expm1_ratio

COLUMN = (slice(None), np.newaxis)
ROWS = 16  # of the first table of lengths of path, in each of two spacings
ROUNDS = 30  # at most: 2 to 5 do but for extremes
STEEPEST = 10.0  # rates that differ by more would keep what is read at one end of the interval
EVEN = 1e-11  # how far a point may lie from its even place, in lengths of path


def points(flight: Flight, alpha0: FloatArray, count: int) -> FloatArray:
    """t, x, y, speed, alpha and arc length in units of the launch, each (launches, count)."""
    v, angle, cos0, sin0 = (part[COLUMN] for part in (flight.v, alpha0, flight.cos0, flight.sin0))
    n, curve, end = flight.n[COLUMN], flight.curve[COLUMN], flight.delta[COLUMN]
    slope0 = np.arcsinh(sin0 / cos0)
    begin = velocity.start(v * v, sin0, cos0)

    s = (curve + flight.tail[COLUMN]) * np.linspace(0.0, 1.0, count)
    curved = np.minimum(s, curve)
    final = s - curved  # at terminal speed, straight down
    spaced = _spaced if power.is_square(n) else _spaced_by_table
    delta = np.maximum.accumulate(np.minimum(spaced(curved, begin, slope0, end, n), end), axis=1)
    delta = np.where(final > 0, end, delta)
    delta[:, 0], delta[:, -1] = 0.0, end[:, 0]
    slope = slope0 - delta
    curved, slowing = _path(begin, delta, n)
    quickness = cos0 * np.cosh(slope) / slowing  # speed / v0
    quickness[:, 0] = 1.0

    x, y, t = _along(flight, quickness, slope, delta)
    reach = flight.reach * flight.cos0
    deep = flight.beyond[COLUMN]
    part = np.divide(np.expm1(-final * v * v), np.expm1(-deep), out=final * 0, where=deep > 0)
    x = np.minimum(x + part * cos0 * np.reshape(flight.drift, (-1, 1)), reach[COLUMN])
    y += flight.height[COLUMN] - final
    t += final * v
    alpha = np.arctan(np.sinh(slope) * np.exp(np.minimum(final * v * v, extremes.STEEPEST)))
    alpha[:, :1] = angle
    x[:, -1], y[:, -1], t[:, -1] = reach, 0.0, flight.t
    quickness[:, -1], alpha[:, -1] = flight.speed, -np.arctan(flight.tangent)
    alpha[:, -1] = np.minimum(alpha[:, -1], alpha[:, -2])
    s = curved + final
    s[:, -1] = flight.curve + flight.tail
    return np.stack([t, x, y, quickness, alpha, s])


def _along(
    flight: Flight, quickness: FloatArray, slope: FloatArray, delta: FloatArray
) -> list[FloatArray]:
    """x, y and t at each point, which launches the arc to the next: from the launch, at speed 1.

    An arc over the apex is cut there.
    """
    cosine, sine = 1 / np.cosh(slope), np.tanh(slope)
    cosine[:, 0], sine[:, 0] = flight.cos0, flight.sin0
    begun, steps = quickness[:, :-1], np.diff(delta)
    n = np.broadcast_to(flight.n[COLUMN], steps.shape)
    v, sin, cos, slopes, step, n = (
        part.ravel()
        for part in (
            begun * flight.v[COLUMN],
            sine[:, :-1],
            cosine[:, :-1],
            slope[:, :-1],
            steps,
            n,
        )
    )
    rise = np.where(slopes > 0, np.minimum(step, slopes), step)
    begin = velocity.start(v * v, sin, cos)
    names = ("x", "y", "t")
    legs, e = flying.arc(begin, slopes, rise, n, names)
    over = np.flatnonzero(rise < step)
    if over.size:
        slow = cos[over] * (1 + e[over]) ** (-1 / n[over])  # v_x at the apex over the speed
        level = np.zeros(over.size)
        top = Start((v[over] * slow) ** 2, level, level + 1, level + 1)
        down, _ = flying.arc(top, level, step[over] - rise[over], n[over], names)
        legs["x"][over] += down["x"] * slow**2 / cos[over]
        legs["y"][over] += down["y"] * slow**2
        legs["t"][over] += down["t"] * slow
    units = {"x": cosine[:, :-1] * begun**2, "y": begun**2, "t": begun}
    return [
        np.cumsum(np.pad(legs[name].reshape(begun.shape) * unit, ((0, 0), (1, 0))), axis=1)
        for name, unit in units.items()
    ]


def _each(n: FloatArray, of: FloatArray) -> FloatArray:
    """The exponent of each launch for each of its slopes, flat."""
    return np.broadcast_to(n, of.shape).ravel()


def _path(begin: Start, delta: FloatArray, n: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Length of path, and U^(1/n), at each slope of each launch."""
    whole = Start(*(np.broadcast_to(part, delta.shape).ravel() for part in begin))
    sums, e = flying.arc(whole, None, delta.ravel(), _each(n, delta), ("s",))
    return sums["s"].reshape(delta.shape), (1 + e.reshape(delta.shape)) ** (1 / n)


def _spaced(
    curved: FloatArray, begin: Start, slope0: FloatArray, end: FloatArray, n: FloatArray
) -> FloatArray:
    """Slope come down where the path has a given length, near enough to space points.

    Eq. 19 gives the growth of the bracket, u = 1 + v^2 gap; F(p) = F(p0) - gap / cos^2(alpha0) is
    solved for p by Newton.  Near the launch that difference has no digits, but gap = 2 delta is
    near; two steps on the gap itself end it, but for the apex, where it is flat.
    """
    gap = 2 * curved * expm1_ratio(2 * begin.v2 * curved)
    cos2 = begin.plus * begin.minus
    target = slope0 + begin.sin / cos2 - gap / cos2
    size = np.abs(target)
    p = size / (1 + np.sqrt(1 + size))
    for _ in range(3):
        root = np.sqrt(1 + p * p)
        p = p - (p * root + np.arcsinh(p) - size) / (2 * root)
    delta = np.where(gap < 1e-6, gap / 2, slope0 - np.sign(target) * np.arcsinh(np.abs(p)))
    for _ in range(2):
        now, C = bracket_gap(begin, delta)
        delta = np.maximum(delta - np.where(C > 0.03, (now - gap) / (2 * C * C), 0.0), 0.0)
    return np.asarray(delta)


def _spaced_by_table(
    curved: FloatArray, begin: Start, slope0: FloatArray, end: FloatArray, n: FloatArray
) -> FloatArray:
    """The same for any n, where the length has no closed form: read off a table of it.

    What is read off joins the table, launch by launch until the lengths there are those asked for.
    """
    eta = power.slowing(np.sqrt(begin.v2), n)
    part = np.linspace(0.0, 1.0, ROWS)
    table_at = np.concatenate(
        [eta * np.expm1(np.log1p(end / eta) * part), end * part[1:-1]], axis=1
    )
    result = np.empty_like(curved)
    todo, tables = np.arange(len(result)), np.empty((3, len(result), 0))
    for _ in range(ROUNDS):
        own = Start(*(part[todo] for part in begin))
        length, slowing = _path(own, table_at, n[todo])
        rate = (slowing / power.cosines(own, table_at)[0]) ** 2  # d(delta) / ds
        tables = np.concatenate([tables, [table_at, length, rate]], axis=2)
        tables = np.take_along_axis(tables, np.argsort(tables[:1], axis=2), axis=2)
        read = np.stack([_read(*row) for row in zip(curved[todo], *tables, strict=True)])
        result[todo] = read
        near = np.abs(_path(own, read, n[todo])[0] - curved[todo]) <= EVEN * curved[todo, -1:]
        far = ~near.all(axis=1)
        if not far.any():
            break
        todo, tables, table_at = todo[far], tables[:, far], read[far]
    return result


def _read(at: FloatArray, delta: FloatArray, length: FloatArray, rate: FloatArray) -> FloatArray:
    """Delta at the lengths `at`, by the rational quadratic that is monotone and meets each rate."""
    length = np.maximum.accumulate(length)
    i = np.clip(np.searchsorted(length, at, "right"), 1, length.size - 1)
    wide, high = length[i] - length[i - 1], delta[i] - delta[i - 1]
    part = np.divide(at - length[i - 1], wide, out=np.ones_like(at), where=wide > 0)
    part = np.clip(part, 0.0, 1.0)
    bend = part * (1 - part)
    steep = np.divide(high, wide, out=np.zeros_like(at), where=wide > 0)
    first, last = rate[i - 1], rate[i]
    top = steep * part**2 + first * bend
    bottom = steep * (1 - 2 * bend) + (first + last) * bend
    up = np.divide(top, bottom, out=part, where=bottom > 0)
    even = np.maximum(first, last) <= STEEPEST * np.minimum(first, last)
    up = np.where(even | (part == 0) | (part == 1), up, 0.5)
    return np.asarray(delta[i - 1] + high * up)
