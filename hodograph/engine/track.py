"""One launch at many times, and how its place there answers to the launch.

In units of the launch, v0^2 / g and v0 / g, with kappa = k v0^n / g = v_norm^n, the path from the
launch is in delta (eq. 15, for any n as in `power`)

    C = cos(alpha0) / cos(alpha),  S = C sin(alpha),  U = 1 + n kappa K,  K = integral of C^n,
    x = cos(alpha0) times the integral of C r^2,  y = that of S C r^2,  t = that of C r,
    r = U^(-1/n),

regular where kappa is 0, and below it, where "drag" drives and U is kept from 0.  Each integral is
differentiated under its sign, in alpha0 by dC = -cos(alpha0) sinh(delta), dS = cos(alpha0)
cosh(delta); the derivative at a fixed time is that at a fixed delta less velocity times that of t.

The path is one table: panels of Gauss-Legendre nodes, short where the speed of the path backward is
near infinite, on each of which the integrals are polynomials.  The points are read off it.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from hodograph.engine.domain import FloatArray
from hodograph.engine.position import gauss_legendre
from hodograph.engine.power import integration_matrix

NODES = 16  # of a panel
LONGEST, GROWTH = 1.0, 6.0  # of a panel: in delta, in n delta
LEAST_U = 1e-3  # where the path goes on along its tangent, before the launch or for kappa < 0
PANELS = 120  # on either side, at most
STEEPEST = 1e-8  # least cos(alpha0): its digits are what the derivative in alpha0 loses
NEWTON, HASTY = 4, 2  # steps to a time; what is left of it goes along the tangent
_PLACE, _ALL = 4, 13  # integrals: t, K, x and y, and all


class Motion(NamedTuple):
    """A launch at many times, in m and s from the launch.

    `dx` and `dy` are derivatives at fixed time, a row each for v0, alpha0, k, n and g.
    """

    x: FloatArray
    y: FloatArray
    vx: FloatArray
    vy: FloatArray
    dx: FloatArray
    dy: FloatArray


class _Launch(NamedTuple):
    """What the table is made of: 1 +/- sin(alpha0) are to full accuracy."""

    cos: float
    sin: float
    plus: float
    minus: float
    kappa: float
    n: float

    @property
    def eta(self) -> float:
        """How far in slope behind the launch the speed is infinite, or further."""
        return math.log1p(1 / max(abs(self.kappa), 1e-300)) / self.n

    def bracket(self, K: FloatArray) -> FloatArray:
        """U."""
        return np.maximum(1 + self.n * self.kappa * K, LEAST_U)


class _Table(NamedTuple):
    """The path in panels; delta, `t` and `begun` are 0 at the launch."""

    delta: FloatArray  # at the ends of the panels
    t: FloatArray  # likewise
    t_nodes: FloatArray  # at the nodes and ends
    place: FloatArray  # where these are: number of the panel and part of it
    begun: FloatArray  # (integral, panel): at the beginning of the panel
    series: FloatArray  # (integral, panel, degree): from there, in Chebyshev polynomials


class Chart(NamedTuple):
    """A launch in SI units, and its path as a table in units of the launch."""

    v0: float
    g: float
    launch: _Launch
    table: _Table


def chart(
    first: float, last: float, *, v0: float, alpha0: float, k: float, n: float, g: float
) -> Chart:
    """The path from `first` to `last`, times (s) after the launch; alpha0 beyond pi/2 goes left."""
    cos0, sin0 = math.cos(alpha0), math.sin(alpha0)
    cos0 = math.copysign(max(abs(cos0), STEEPEST), cos0)
    far, near = 1 + abs(sin0), cos0 * cos0 / (1 + abs(sin0))
    plus, minus = (far, near) if sin0 >= 0 else (near, far)
    launch = _Launch(cos0, sin0, plus, minus, k * v0**n / g, n)
    unit = g / v0
    return Chart(v0, g, launch, _table(launch, min(first * unit, 0.0), max(last * unit, 0.0)))


class Place(NamedTuple):
    """Position and velocity, as in `Motion`."""

    x: FloatArray
    y: FloatArray
    vx: FloatArray
    vy: FloatArray


def place(chart: Chart, t: FloatArray) -> Place:
    """Where the launch is at times `t` (s) after it; beyond the chart, on its tangent."""
    unit = chart.v0**2 / chart.g
    x, y, vx, vy = _place(chart, t * (chart.g / chart.v0), _PLACE)[0]
    return Place(unit * x, unit * y, chart.v0 * vx, chart.v0 * vy)


def _place(chart: Chart, at: FloatArray, count: int) -> tuple[Place, FloatArray]:
    """The place in units of the launch, and the first `count` of the integrals."""
    launch, table = chart.launch, chart.table
    delta, rows = _read(table, np.clip(at, table.t[0], table.t[-1]), count)
    t, K, x, y = rows[:_PLACE]
    r = launch.bracket(K) ** (-1 / launch.n)
    vx, vy = launch.cos * r, _cosines(launch, delta)[1] * r
    late = at - t  # rounding, but beyond the table
    return Place(launch.cos * x + vx * late, y + vy * late, vx, vy), rows


def motion(chart: Chart, t: FloatArray) -> Motion:
    """The same, with derivatives."""
    v0, g, launch, _ = chart
    cos0, kappa, n = launch.cos, launch.kappa, launch.n
    at = t * (g / v0)
    (X, Y, vx, vy), rows = _place(chart, at, _ALL)
    x, changes = rows[2], rows[_PLACE:]
    t_a, x_a, y_a, t_k, x_k, y_k, t_n, x_n, y_n = changes
    X_k, Y_k = cos0 * x_k - vx * t_k, y_k - vy * t_k
    by_v0, by_k, by_n = n * kappa / v0, v0**n / g, kappa * math.log(v0)  # derivatives of kappa
    dx = [
        (2 * X - at * vx) / v0 + by_v0 * X_k,
        cos0 * x_a - launch.sin * x - vx * t_a,
        by_k * X_k,
        cos0 * x_n - vx * t_n + by_n * X_k,
        (at * vx - X - kappa * X_k) / g,
    ]
    dy = [
        (2 * Y - at * vy) / v0 + by_v0 * Y_k,
        y_a - vy * t_a,
        by_k * Y_k,
        y_n - vy * t_n + by_n * Y_k,
        (at * vy - Y - kappa * Y_k) / g,
    ]
    length = v0 * v0 / g
    return Motion(
        length * X, length * Y, v0 * vx, v0 * vy, length * np.stack(dx), length * np.stack(dy)
    )


def _cosines(launch: _Launch, delta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """C and S."""
    up = np.exp(delta)
    down = launch.plus / up
    up = launch.minus * up
    return 0.5 * (down + up), 0.5 * (down - up)


def _table(launch: _Launch, first: float, last: float) -> _Table:
    """The path from a time before the launch to one after it."""
    here = launch.sin / abs(launch.cos)  # the tangent, which without drag is linear in time
    ahead = math.asinh(here) - math.asinh(here - last / abs(launch.cos))
    behind = math.asinh(here - first / abs(launch.cos)) - math.asinh(here)
    while True:
        up, down = _ahead(launch, ahead or LONGEST), _behind(launch, behind)
        table = _integrals(launch, np.concatenate([down[:0:-1], up]), len(down) - 1)
        short = (
            table.t[-1] < last and len(up) <= PANELS,
            table.t[0] > first and -down[-1] >= behind and len(down) <= PANELS,
        )
        if not any(short):
            return table
        ahead, behind = (
            1.5 * reach + LONGEST if more else reach
            for reach, more in zip((ahead, behind), short, strict=True)
        )


def _ahead(launch: _Launch, reach: float) -> FloatArray:
    """The ends of panels from the launch to `reach`, none longer than it is from infinite speed."""
    longest = min(LONGEST, GROWTH / launch.n)
    ends = [0.0]
    while ends[-1] < reach and len(ends) <= PANELS:
        ends.append(ends[-1] + min(longest, ends[-1] + launch.eta))
    return np.array(ends)


def _behind(launch: _Launch, reach: float) -> FloatArray:
    """The same backward, each panel no longer than half of its way to infinite speed."""
    longest, n = min(LONGEST, GROWTH / launch.n), launch.n
    kappa = max(launch.kappa, 1e-300)
    nodes, weights = (column[:, 0] for column in gauss_legendre(NODES))
    ends, U, C = [0.0], 1.0, 1.0
    while -ends[-1] < reach and len(ends) <= PANELS and U > LEAST_U:
        step = min(longest, math.log1p(U / (kappa * C**n)) / (2 * n))
        at = np.append(ends[-1] - step * nodes, ends[-1] - step)
        Cs = _cosines(launch, at)[0]
        U -= n * kappa * step * float(weights @ Cs[:-1] ** n)
        C = float(Cs[-1])
        ends.append(float(at[-1]))
    return np.array(ends)


@cache
def _to_series() -> FloatArray:
    """From values at the nodes of [0, 1] to the Chebyshev series of their integral from 0."""
    nodes = gauss_legendre(NODES)[0][:, 0]
    columns = np.linalg.inv(chebyshev.chebvander(2 * nodes - 1, NODES - 1)).T
    series = [chebyshev.chebint(column, lbnd=-1, scl=0.5) for column in columns]
    matrix: FloatArray = np.array(series)
    matrix.flags.writeable = False  # every caller gets the same
    return matrix


@cache
def _to_slopes() -> FloatArray:
    """From a Chebyshev series on [0, 1] to that of its derivative."""
    matrix = np.asarray(chebyshev.chebder(np.eye(NODES + 1), scl=2).T, dtype=np.float64)
    matrix.flags.writeable = False
    return matrix


def _integrals(launch: _Launch, ends: FloatArray, begin: int) -> _Table:
    """The table of the panels between these ends; the launch is the one numbered `begin`."""
    kappa, n = launch.kappa, launch.n
    nodes, matrix = gauss_legendre(NODES)[0][:, 0], integration_matrix(NODES).T
    width = np.diff(ends)[:, np.newaxis]
    delta = ends[:-1, np.newaxis] + width * nodes

    def from_launch(values: FloatArray) -> FloatArray:
        part = (values * width) @ matrix
        begun = np.append(0.0, np.cumsum(part[:, -1]))
        return np.asarray(part[:, :-1] + (begun[:-1] - begun[begin])[:, np.newaxis])

    C, S = _cosines(launch, delta)
    dC, dS = -launch.cos * np.sinh(delta), launch.cos * np.cosh(delta)
    Cn = C**n
    K, K_a, K_n = (from_launch(each) for each in (Cn, n * Cn / C * dC, Cn * np.log(C)))
    U = launch.bracket(K)
    r = U ** (-1 / n)
    by_a, by_k = -kappa * K_a / U, -K / U  # derivatives of ln(r)
    by_n = np.log(U) / n**2 - kappa * (K + n * K_n) / (n * U)
    t, x = C * r, C * r * r
    y = S * x
    rows = [t, Cn, x, y]
    rows += [dC * r + t * by_a, (dC * r + 2 * t * by_a) * r]
    rows += [(dC * S + C * dS) * r * r + 2 * y * by_a]
    rows += [t * by_k, 2 * x * by_k, 2 * y * by_k, t * by_n, 2 * x * by_n, 2 * y * by_n]
    terms = np.stack(rows) * width
    series = terms @ _to_series()
    begun = np.cumsum(series.sum(axis=2), axis=1)
    begun = np.concatenate([np.zeros((len(rows), 1)), begun], axis=1)
    begun = begun - begun[:, begin : begin + 1]
    t_nodes = begun[0, :-1, np.newaxis] + terms[0] @ matrix  # the last is the end
    place = np.arange(len(width))[:, np.newaxis] + np.append(nodes, 1.0)
    t_nodes = np.append(begun[0, 0], t_nodes)
    return _Table(ends, begun[0], t_nodes, np.append(0.0, place), begun[:, :-1], series)


def _read(table: _Table, at: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Delta, and the first `count` of the integrals, at times that the table holds."""
    place = np.interp(at, table.t_nodes, table.place)
    panel = np.minimum(place.astype(np.intp), len(table.delta) - 2)
    part = place - panel
    degrees = np.arange(NODES + 1)
    begun, series = table.begun[:count, panel], table.series[:count, panel]
    slopes = series[0] @ _to_slopes()
    for _ in range(NEWTON if count > _PLACE else HASTY):
        basis = np.cos(np.arccos(2 * part - 1)[:, np.newaxis] * degrees)
        miss = at - begun[0] - np.einsum("pd,pd->p", series[0], basis)
        rate = np.einsum("pd,pd->p", slopes, basis[:, :-1])
        step = np.divide(miss, rate, out=np.zeros_like(miss), where=rate > 0)
        part = np.clip(part + step, 0.0, 1.0)
    basis = np.cos(np.arccos(2 * part - 1)[:, np.newaxis] * degrees)
    rows = begun + np.einsum("fpd,pd->fp", series, basis)
    return table.delta[panel] + part * np.diff(table.delta)[panel], rows
