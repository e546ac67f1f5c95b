"""Where the fit of a track begins: linear least squares, which need no start of their own.

Under quadratic drag the horizontal speed dies out along the path (eq. 19), v_x = v_x0 exp(-k s)
with s the length of path.  So, once s is known well enough along the track, and for a given k, the
track is linear in all the rest: with times,

    x = x0 + v_x0 a,   y = y0 + v_y0 a - g b,   a = int e^(-k s) dt,   b = int e^(-k s) int e^(k s),

and without, from d2y/dx2 = -g / v_x^2,

    y = y0 + tan(alpha0) (x - x0) - (g / v_x0^2) c,   c = int int e^(2 k s) dx dx.

k is then the best of a scan, s taken from a cubic first and from that fit after it.  Leaving g free
says what the track itself holds of it.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np

from hodograph.engine import track
from hodograph.engine.domain import FloatArray
from hodograph.engine.film import NAMES, SLOWEST, Film, spread

SCAN = np.array([0.0, 0.02, 0.05, 0.1, 0.2, 0.35, 0.6, 1.0, 1.6, 2.5, 4.0])  # k times the path
FINE = 200  # points on which s is summed
ROUNDS = 2
SWEEPS = 6  # of the weights that make outliers light
ROUGH = 1e-5  # of the track: how closely it is seen here
OUTLYING = 2.0  # standard deviations


class Guess(NamedTuple):
    """A launch at the first point of a track (in time, or in x), and what g is there."""

    x: float
    y: float
    vx: float
    vy: float
    k: float
    g: float  # by the track alone
    weights: FloatArray  # of the points
    cost: float  # weighted sum of squares with that g


def least_squares(rows: FloatArray, values: FloatArray, weights: FloatArray) -> FloatArray:
    """Coefficients of the rows (parameter, point) of a weighted linear fit."""
    return np.asarray(np.linalg.lstsq((rows * weights).T, (values * weights).T, rcond=None)[0])


def _light(residuals: FloatArray) -> FloatArray:
    """Weights of residuals (not of their squares) by which outliers pull no more than others."""
    size = np.abs(residuals) / max(OUTLYING * spread(residuals), 1e-300)
    return np.asarray(1 / np.sqrt(np.maximum(size, 1.0)))


def _sums(values: FloatArray, at: FloatArray) -> FloatArray:
    """The integral from the first point to each, by trapezia."""
    return np.append(0.0, np.cumsum(np.diff(at) * (values[1:] + values[:-1]) / 2))


def _cubic(at: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A cubic through each row of values: points along it, its slopes there, and the weights."""
    fine = np.linspace(at.min(), at.max(), FINE)
    span = fine[-1] - fine[0]
    degrees = np.arange(min(4, len(np.unique(at))))
    powers = ((at - fine[0]) / span) ** degrees[:, np.newaxis]
    weights = np.ones_like(at)
    for _ in range(SWEEPS):
        p = least_squares(powers, values, weights)
        weights = _light(np.sqrt(np.sum((values - p.T @ powers) ** 2, axis=0)))
    slopes = (p[1:] * degrees[1:, np.newaxis] / span).T
    return fine, slopes @ ((fine - fine[0]) / span) ** degrees[:-1, np.newaxis], weights


def timed(t: FloatArray, x: FloatArray, y: FloatArray, g: float) -> Guess:
    """The launch at the first of the times."""
    fine, (vx, vy), weights = _cubic(t, np.stack([x, y]))
    for _ in range(ROUNDS):
        s = _sums(np.hypot(vx, vy), fine)
        best, freely = _scan(t, x, y, g, fine, s, weights)
        k, own = best[1], best[2]
        decay = np.exp(-k * s)
        vx, vy = own[1] * decay, decay * (own[3] - g * _sums(1 / decay, fine))
    return Guess(own[0], own[2], own[1], own[3], k, freely[2][4], weights, freely[0])


_Found: TypeAlias = tuple[float, float, FloatArray]  # sum of squares, k, and x0, v_x0, y0, v_y0, g


def _scan(
    t: FloatArray,
    x: FloatArray,
    y: FloatArray,
    g: float,
    fine: FloatArray,
    s: FloatArray,
    weights: FloatArray,
) -> tuple[_Found, _Found]:
    """The best k with g held, and with g free."""
    best = freely = (np.inf, 0.0, np.zeros(5))
    for k in SCAN / max(s[-1], 1e-300):
        decay = np.exp(-k * s)
        a = np.interp(t, fine, _sums(decay, fine))
        b = np.interp(t, fine, _sums(decay * _sums(1 / decay, fine), fine))
        rows = np.stack([np.ones_like(a), a, -b])
        both = least_squares(rows[:2], np.stack([x, y + g * b]), weights).T
        loose = least_squares(rows, y, weights)
        across = float(np.sum((weights * (x - both[0] @ rows[:2])) ** 2))
        for found, last in ((best, [*both[1], g]), (freely, loose)):
            cost = across + float(np.sum((weights * (y - last @ rows)) ** 2))
            if cost < found[0]:
                new = (cost, float(k), np.array([*both[0], *last]))
                best, freely = (new, freely) if found is best else (best, new)
    return best, freely


def curve(x: FloatArray, y: FloatArray, g: float) -> Guess:
    """The launch at the least x of a track without times, which says nothing of g but its sign."""
    fine, (slope,), weights = _cubic(x, y[np.newaxis])
    straight = np.stack([np.ones_like(x), x - fine[0]])
    for _ in range(ROUNDS):
        s = _sums(np.hypot(1.0, slope), fine)
        best = (np.inf, 0.0, np.zeros(3))
        for k in SCAN / s[-1]:
            bend = _sums(np.exp(2 * k * s), fine)
            c = np.interp(x, fine, _sums(bend, fine))
            rows = np.stack([*straight, -c])
            found = least_squares(rows, y, weights)
            cost = float(np.sum((weights * (y - found @ rows)) ** 2))
            if cost < best[0]:
                best, slopes = (cost, float(k), found), found[1] - found[2] * bend
        slope = slopes
    _, k, (y0, tangent, per_vx2) = best
    vx = np.sqrt(g / max(per_vx2, 1e-6 * g))
    line = least_squares(straight, y, weights)
    misfit = float(np.sum((weights * (y - line @ straight)) ** 2))
    bent = misfit > 2 * best[0] + len(x) * (ROUGH * np.ptp(x)) ** 2
    sign = -1.0 if bent and per_vx2 < 0 else 1.0
    return Guess(float(fine[0]), y0, vx, vx * tangent, k, sign * g, weights, best[0])


def begin(film: Film, held: dict[str, float], n: float) -> tuple[FloatArray, Guess]:
    """All parameters to begin with, those held at their values; what the track says of g.

    The launch is moved along the path to the held time or place, to the nearest if there are two.
    """
    t_first = 0.0 if film.t is None else float(film.t.min())
    if film.t is None:
        first = curve(film.x, film.y, film.g)
        span = float(np.ptp(film.x)) / first.vx
    else:
        first = timed(film.t, film.x, film.y, film.g)
        span = float(np.ptp(film.t))
    v0 = max(float(np.hypot(first.vx, first.vy)), SLOWEST * film.g * span)
    alpha0 = float(np.arctan2(first.vy, first.vx))
    launch = {"v0": v0, "alpha0": alpha0, "k": first.k, "n": 2.0}
    at = np.linspace(-span, 0.2 * span, FINE)
    if "t0" in held and film.t is not None:
        at = np.array([held["t0"] - t_first])
    path = track.motion(track.chart(float(at.min()), float(at.max()), **launch, g=film.g), at)
    off = np.zeros_like(at)
    for name, place in (("x0", path.x + first.x), ("y0", path.y + first.y)):
        if name in held:
            off = off + np.abs(place - held[name])
    here = int(np.argmin(off + 1e-3 * np.abs(at) * v0))
    vx, vy = float(path.vx[here]), float(path.vy[here])
    v0 = max(float(np.hypot(vx, vy)), SLOWEST * film.g * span)
    found = {
        "v0": v0,
        "alpha0": float(np.arctan2(vy, vx)),
        "k": first.k * v0 ** (2 - n),
        "n": n,
        "x0": first.x + float(path.x[here]),
        "y0": first.y + float(path.y[here]),
        "t0": t_first + float(at[here]),
    }
    return np.array([held.get(name, found[name]) for name in NAMES]), first
