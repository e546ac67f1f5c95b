"""Points along a path, evenly spaced in arc length, each at the cost of one short arc."""

from __future__ import annotations

import numpy as np

from hodograph import powerlaw, velocity
from hodograph.domain import FloatArray
from hodograph.flight import Flight
from hodograph.position import arc
from hodograph.powerlaw import PowerFlight
from hodograph.velocity import FASTEST, Start, bracket_gap, expm1_ratio, log1p_ratio, run_in

COLUMN = (slice(None), np.newaxis)
ROWS = 16  # of the first table of lengths of path, in each of two spacings
ROUNDS = 30  # at most: 2 to 5 do but for extremes
STEEPEST = 10.0  # rate, in chords: more would keep what is read at one end of its interval
EVEN = 1e-9  # how far a point may lie from its even place, in lengths of path


def points(
    v: FloatArray,
    alpha0: FloatArray,
    height: FloatArray,
    flight: Flight | PowerFlight,
    n: float,
    count: int,
) -> FloatArray:
    """t, x, y, speed, alpha and arc length in units of the launch, each (launches, count)."""
    fast = (run_in(v)[0] if n == 2 else v)[COLUMN]
    angle = alpha0[COLUMN]
    run = np.broadcast_to(flight.run, flight.curve.shape)[COLUMN]
    curve, end = flight.curve[COLUMN], flight.delta[COLUMN]
    sin0, cos0 = np.sin(angle), np.cos(angle)
    slope0 = np.arcsinh(sin0 / cos0)
    begin = velocity.start(fast * fast, sin0, cos0)

    s = (run + curve + flight.tail[COLUMN]) * np.linspace(0.0, 1.0, count)
    straight = np.minimum(s, run)
    curved = np.minimum(s - straight, curve)
    final = s - straight - curved
    spaced = _spaced if n == 2 else _spaced_by_table
    delta = np.maximum.accumulate(np.minimum(spaced(curved, begin, slope0, end, n), end), axis=1)
    delta[:, 0], delta[:, -1] = 0.0, end[:, 0]
    slope = slope0 - delta
    if n == 2:
        gap, _ = bracket_gap(begin, delta)
        slowing = np.sqrt(1 + begin.v2 * gap)
        curved = 0.5 * gap * log1p_ratio(begin.v2 * gap)
    else:
        curved, slowing = _path_by_power(begin, slope0, delta, n)
    s = straight + curved + final
    quickness = cos0 * np.cosh(slope) / slowing  # speed / v_e
    quickness[:, 0] = 1.0

    # each point launches the arc to the next
    cosine, sine = 1 / np.cosh(slope), np.tanh(slope)
    cosine[:, :1], sine[:, :1] = cos0, sin0
    v2, sin, cos, slopes = (
        part[:, :-1].ravel() for part in ((quickness * fast) ** 2, sine, cosine, slope)
    )
    legs = _legs(velocity.start(v2, sin, cos), slopes, np.diff(delta).ravel(), n)
    begun = quickness[:, :-1]
    units = {"x": cosine[:, :-1] * begun**2, "y": begun**2, "t": begun}
    x, y, t = (
        np.cumsum(np.pad(legs[name].reshape(begun.shape) * unit, ((0, 0), (1, 0))), axis=1)
        for name, unit in units.items()
    )
    reach = flight.reach * flight.cos0
    x = np.minimum(x + cos0 * straight, reach[COLUMN])
    y += sin0 * straight - final + height[COLUMN]
    t += final * fast
    alpha = np.arctan(np.sinh(slope))
    alpha[:, :1] = angle
    if n == 2:  # faster, within the run-in
        quickness *= np.exp((run - straight) * FASTEST**2)
        quickness[:, :1] = np.maximum(v / FASTEST, 1.0)[COLUMN]
    x[:, -1], y[:, -1], t[:, -1] = reach, 0.0, flight.t
    quickness[:, -1], alpha[:, -1] = flight.speed, -np.arctan(flight.tangent)
    alpha[:, -1] = np.minimum(alpha[:, -1], alpha[:, -2])
    return np.stack([t, x, y, quickness, alpha, s])


def _legs(begin: Start, slope: FloatArray, delta: FloatArray, n: float) -> dict[str, FloatArray]:
    if n == 2:
        return arc(begin, slope, delta, ("x", "y", "t"))
    return powerlaw.arc(begin, slope, delta, n, ("x", "y", "t"))[0]


def _spaced(
    curved: FloatArray, begin: Start, slope0: FloatArray, end: FloatArray, n: float
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
    curved: FloatArray, begin: Start, slope0: FloatArray, end: FloatArray, n: float
) -> FloatArray:
    """The same for any n, where the length has no closed form: read off a table of it.

    What is read off joins the table, until the lengths there are those asked for.
    """
    eta = powerlaw.slowing(np.sqrt(begin.v2), n)
    part = np.linspace(0.0, 1.0, ROWS)
    delta = np.concatenate([eta * np.expm1(np.log1p(end / eta) * part), end * part[1:-1]], axis=1)
    table = np.empty((3, len(delta), 0))
    for _ in range(ROUNDS):
        length, slowing = _path_by_power(begin, slope0, delta, n)
        if table.size and not (np.abs(length - curved) > EVEN * curved[:, -1:]).any():
            break
        rate = (slowing / powerlaw.cosines(begin, delta)[0]) ** 2  # d(delta) / ds
        table = np.concatenate([table, [delta, length, rate]], axis=2)
        table = np.take_along_axis(table, np.argsort(table[:1], axis=2), axis=2)
        delta = np.stack([_read(*row) for row in zip(curved, *table, strict=True)])
    return delta


def _read(at: FloatArray, delta: FloatArray, length: FloatArray, rate: FloatArray) -> FloatArray:
    """Delta at the lengths `at`, by the rational quadratic that is monotone and meets each rate."""
    length = np.maximum.accumulate(length)
    i = np.clip(np.searchsorted(length, at, "right"), 1, length.size - 1)
    wide, high = length[i] - length[i - 1], delta[i] - delta[i - 1]
    part = np.divide(at - length[i - 1], wide, out=np.ones_like(at), where=wide > 0)
    part = np.clip(part, 0.0, 1.0)
    bend = part * (1 - part)
    steep = np.divide(high, wide, out=np.zeros_like(at), where=wide > 0)
    first, last = (np.minimum(rate[k], STEEPEST * steep) for k in (i - 1, i))
    top = steep * part**2 + first * bend
    bottom = steep * (1 - 2 * bend) + (first + last) * bend
    up = np.divide(top, bottom, out=part, where=bottom > 0)
    return np.asarray(delta[i - 1] + high * up)


def _path_by_power(
    begin: Start, slope0: FloatArray, delta: FloatArray, n: float
) -> tuple[FloatArray, FloatArray]:
    """Length of path, and U^(1/n), at each slope of each launch."""
    whole = Start(*(np.broadcast_to(part, delta.shape).ravel() for part in begin))
    slopes = np.broadcast_to(slope0, delta.shape).ravel()
    sums, U = powerlaw.arc(whole, slopes, delta.ravel(), n, ("s",))
    return sums["s"].reshape(delta.shape), U.reshape(delta.shape) ** (1 / n)
