"""A track fitted: residuals with their derivatives, least squares, and what is known after it.

With times each point leaves two residuals, across and up.  Without, it leaves its distance from the
curve, in units of the noise: with X, Y the point of the curve that is nearest so, and v_x, v_y the
velocity there,

    r = ((X - x) v_y - (Y - y) v_x) / sqrt(v_x^2 sigma_y^2 + v_y^2 sigma_x^2),

whose derivative is that of X and Y at fixed time, since the nearest point is a minimum.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from hodograph.engine import track
from hodograph.engine.domain import FloatArray
from hodograph.engine.film import NAMES, SLOWEST, Film, spread

K, N = NAMES.index("k"), NAMES.index("n")
SAMPLES = 100  # of the curve, among which the nearest points are first looked for
SETTLING = 3  # steps to the nearest points, from those of the launch before
TOL = 1e-10
MOST = 100  # evaluations
ROUNDS = 8  # of a robust fit, each with the scale that the one before it left
SOFT = 1.5  # a robust loss begins at so many standard deviations
STILL = 1e-3  # change of that scale


class Fit(NamedTuple):
    """The parameters by NAMES, which of them are free, and the residuals in units of the noise."""

    values: FloatArray
    free: NDArray[np.intp]
    residuals: FloatArray
    jacobian: FloatArray  # (residual, NAMES and g)
    misses: FloatArray  # (2, point): of the points from the path, in m
    success: bool


class Residuals:
    """The residuals of a film as a function of all the parameters, with their derivatives.

    Without times it keeps where on the curve the points were last.
    """

    def __init__(self, film: Film) -> None:
        """Begin without any place on the curve."""
        self.film = film
        self.at: FloatArray | None = None

    def __call__(self, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residuals, their derivatives by NAMES and g, and the misses."""
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # on the way, at worst
            return self._at(values)

    def _at(self, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        v0, alpha0, k, n, x0, y0, t0 = map(float, values)
        film = self.film
        if v0 < 0:  # a step of the iteration beyond rest
            v0, alpha0 = -v0, alpha0 + np.pi
        turned = -1.0 if values[0] < 0 else 1.0
        span = self._span(v0, alpha0) if film.t is None else float(np.ptp(film.t))
        launch = {"v0": max(v0, SLOWEST * film.g * span), "alpha0": alpha0, "k": k, "n": n}
        x, y = film.x - x0, film.y - y0
        if film.t is None:
            here = self._nearest(launch, span, x, y)
        else:
            at = film.t - t0
            chart = track.chart(float(at.min()), float(at.max()), **launch, g=film.g)
            here = track.motion(chart, at)
        misses = np.stack([x - here.x, y - here.y])
        one, none = np.ones_like(x), np.zeros_like(x)
        dx = np.stack([turned * here.dx[0], *here.dx[1:4], one, none, -here.vx, here.dx[4]])
        dy = np.stack([turned * here.dy[0], *here.dy[1:4], none, one, -here.vy, here.dy[4]])
        if film.t is not None:
            rows = np.concatenate([-misses[0] / film.sigma_x, -misses[1] / film.sigma_y])
            slopes = np.concatenate([dx / film.sigma_x, dy / film.sigma_y], axis=1)
            return rows, slopes.T, misses
        norm = np.hypot(here.vx * film.sigma_y, here.vy * film.sigma_x)
        rows = (here.vx * misses[1] - here.vy * misses[0]) / norm
        slopes = (dx * here.vy - dy * here.vx) / norm
        return rows, slopes.T, misses

    def _span(self, v0: float, alpha0: float) -> float:
        """A time in which the curve goes past its last point."""
        film = self.film
        across = max(abs(np.cos(alpha0)) * v0, 1e-3 * v0)
        return float(np.ptp(film.x) / across + np.sqrt(2 * np.ptp(film.y) / film.g))

    def _nearest(
        self, launch: dict[str, float], span: float, x: FloatArray, y: FloatArray
    ) -> track.Motion:
        """The points of the curve nearest to those of the film, in units of their noise."""
        film = self.film
        if self.at is None:
            chart = track.chart(-0.2 * span, 2 * span, **launch, g=film.g)
            samples = np.linspace(-0.2 * span, 2 * span, SAMPLES)
            curve = track.place(chart, samples)
            far = [
                (each.reshape(-1, 1) - mine) ** 2 * weight**2
                for each, mine, weight in (
                    (x, curve.x, film.sigma_y[:, np.newaxis]),
                    (y, curve.y, film.sigma_x[:, np.newaxis]),
                )
            ]
            self.at = samples[np.argmin(far[0] + far[1], axis=1)]
        low, high = float(self.at.min()), float(self.at.max())
        room = 0.1 * (high - low)
        chart = track.chart(low - room, high + room, **launch, g=film.g)
        for _ in range(SETTLING):
            here = track.place(chart, self.at)
            across, up = here.vx * film.sigma_y, here.vy * film.sigma_x
            step = across * (x - here.x) * film.sigma_y + up * (y - here.y) * film.sigma_x
            step = step / np.maximum(across**2 + up**2, 1e-300)
            self.at = self.at + np.clip(step, -room, room)
        return track.motion(chart, self.at)


def solve(
    film: Film,
    start: FloatArray,
    free: NDArray[np.intp],
    bounds: tuple[FloatArray, FloatArray],
    loss: str = "linear",
    scale: float = 1.0,
) -> Fit:
    """The least squares of the free parameters, from a start and within bounds by NAMES."""
    residuals, values = Residuals(film), start.copy()
    known: list[tuple[bytes, tuple[FloatArray, FloatArray, FloatArray]]] = []
    # k and n go together: what a film knows is the drag at its own speed, k v^n, or k v^(n - 2)
    log = math.log(max(start[0], 1e-9)) if {K, N} <= set(free.tolist()) else 0.0
    log *= float(np.isinf([bounds[0][K], bounds[1][K]]).all())

    def at(part: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        key = part.tobytes()
        if not known or known[0][0] != key:
            values[free] = part
            values[K] *= math.exp((2 - values[N]) * log)
            known[:] = [(key, residuals(values))]
        return known[0][1]

    def jacobian(part: FloatArray) -> FloatArray:
        slopes = at(part)[1].copy()
        slopes[:, N] -= values[K] * log * slopes[:, K]
        slopes[:, K] *= math.exp((2 - values[N]) * log)
        return slopes[:, free]

    low, high = (each[free] for each in bounds)
    values[K] *= math.exp((values[N] - 2) * log)
    part, success, options = values[free], True, {}
    if loss != "linear" or np.isfinite([low, high]).any():
        part = np.clip(part, *_inside(low, high, part))
        options = {"bounds": (low, high), "loss": loss, "f_scale": scale}
    if free.size:
        found = least_squares(
            lambda part: at(part)[0],
            part,
            jac=jacobian,
            method="trf" if options else "lm",
            x_scale="jac",
            xtol=TOL,
            ftol=TOL,
            gtol=TOL,
            max_nfev=MOST,
            **options,
        )
        part, success = found.x, bool(found.success)
    rows, slopes, misses = at(part)
    return Fit(values, free, rows, slopes, misses, success)


def _inside(low: FloatArray, high: FloatArray, at: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Bounds of a start, a little within those of the fit."""
    room = 1e-3 * np.where(np.isfinite(low) & np.isfinite(high), high - low, 1e-3 + np.abs(at))
    return low + room, high - room


def robust(
    film: Film,
    start: FloatArray,
    free: NDArray[np.intp],
    bounds: tuple[FloatArray, FloatArray],
    loss: str,
    scale: float | None,
) -> tuple[Fit, float]:
    """A fit that gives outliers less weight, and the scale, which unless given is found with it."""
    size = scale or _scale(Residuals(film)(start)[0], free)
    found = solve(film, start, free, bounds, loss, SOFT * size)
    size = scale or _scale(found.residuals, free)
    for _ in range(0 if scale else ROUNDS):
        found = solve(film, found.values, free, bounds, loss, SOFT * size)
        before, size = size, _scale(found.residuals, free)
        if abs(size / before - 1) < STILL:
            break
    return found, size


def _scale(residuals: FloatArray, free: NDArray[np.intp]) -> float:
    """The noise of most residuals, for as many as are independent."""
    spare = max(residuals.size - free.size, 1)
    return max(spread(residuals) * math.sqrt(residuals.size / spare), 1e-300)
