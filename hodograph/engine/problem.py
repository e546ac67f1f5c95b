"""From a film to its fit: what is free, where it begins, and what no law of motion allows."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine import guess
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.engine.film import NAMES, Film
from hodograph.engine.fit import SOFT, Fit, robust, solve

CLEAR = 30.0  # F of g held against g free, beyond which g is not what it was said to be
FAR = 2.0  # ratio of the two at which that is refused
NEAR = 1.03  # ratio of the two, from which on it is said
LENGTHS = {100.0: "cm", 1000.0: "mm", 1 / 0.3048: "feet", 1 / 0.0254: "inches", 0.001: "km"}
RUNAWAY = 100.0  # times the speed that the fit began with, where there is nothing to hold it
V0, ALPHA0, K, X0 = (NAMES.index(name) for name in ("v0", "alpha0", "k", "x0"))


class Problem(NamedTuple):
    """A film in the direction of flight, and its fit; `noise` is in units of that of the film."""

    film: Film
    found: Fit
    bounds: tuple[FloatArray, FloatArray]
    noise: float
    known: bool
    loss: str
    scale: float  # noise of most residuals, for a robust loss
    driven: float = 0.0  # k < 0, where that fits clearly better than the k = 0 that is found

    @property
    def chi2(self) -> float:
        """Sum of the squares of the residuals."""
        return float(np.sum(self.found.residuals**2))

    @property
    def dof(self) -> int:
        """Degrees of freedom."""
        return self.film.equations - self.found.free.size

    @property
    def sigma(self) -> float:
        """The noise as the residuals show it."""
        if self.loss != "linear":
            return self.scale
        return math.sqrt(self.chi2 / self.dof) if self.dof else math.nan

    @property
    def aic(self) -> float:
        """Akaike's criterion; the noise, where it is found, is a parameter more."""
        count, free = self.film.equations, self.found.free.size
        if self.loss != "linear":
            return math.nan
        if self.known:
            return self.chi2 + 2 * free
        return count * math.log(max(self.chi2, 1e-300) / count) + 2 * (free + 1)


class Asked(NamedTuple):
    """How the fit is to be: `drag` is that k is at least 0."""

    held: dict[str, float]
    limits: tuple[FloatArray, FloatArray]
    n: float | None
    loss: str
    known: bool
    drag: bool


def fitted(film: Film, heading: int, asked: Asked) -> Problem:
    """The fit, seen in the direction of flight."""
    known = asked.known
    film = film._replace(x=heading * film.x)
    low, high = (each.copy() for each in asked.limits)
    if heading < 0:
        low[X0], high[X0] = -high[X0], -low[X0]
    held = _held(film, heading, asked, low, high)
    free = np.array([i for i, name in enumerate(NAMES) if name not in held], dtype=np.intp)
    if film.equations - free.size < (0 if known else 1):
        names = ", ".join(NAMES[i] for i in free)
        raise ValueError(f"{len(film.x)} points are too few to fit {names}: hold some (fixed=...)")
    start, seen = guess.begin(film, held, 2.0 if asked.n is None else asked.n)
    start, scale = np.clip(start, low, high), 1.0
    if asked.loss == "linear":
        found = solve(film, start, free, (low, high))
    else:
        found, scale = robust(film, start, free, (low, high), asked.loss, 1.0 if known else None)
    _check_scale(seen, film, found)
    if V0 in free and found.values[V0] > RUNAWAY * start[V0]:
        raise ValueError("the track does not determine v0 and k: hold one, as fixed={'v0': ...}")
    if asked.drag:
        low[K] = 0.0
    problem = Problem(film, found, (low, high), 1.0, known, asked.loss, scale)
    if K in free and found.values[K] < 0:
        problem = _at_zero(problem, K)
        if asked.loss == "linear" and _clearly(problem, found):
            problem = problem._replace(driven=float(found.values[K]))
        if low[K] < 0:  # by first order, since less than no drag is no law of motion
            found = problem.found
            step = np.linalg.lstsq(found.jacobian[:, free], -found.residuals, rcond=None)[0]
            found.values[free] = np.clip(found.values[free] + step, low[free], high[free])
    if V0 in free and ALPHA0 not in free and problem.found.values[V0] < 0:
        problem = _at_zero(problem, V0)
    spare = max(problem.dof, 1)
    return problem if known else problem._replace(noise=math.sqrt(problem.chi2 / spare))


def _held(
    film: Film, heading: int, asked: Asked, low: FloatArray, high: FloatArray
) -> dict[str, float]:
    """What is held, and the place of the launch on its path: by default, at the first point."""
    held = dict(asked.held)
    if "x0" in held:
        held["x0"] *= heading
    gauge, first = ("x0", film.x) if film.t is None else ("t0", film.t)
    at = NAMES.index(gauge)
    if not {"x0", "y0", gauge} & set(held) and np.isinf([low[at], high[at]]).all():
        held[gauge] = float(first.min())
    if asked.n is not None:
        held["n"] = asked.n
    if film.t is None:
        held["t0"] = 0.0
    return held


def _at_zero(problem: Problem, at: int) -> Problem:
    """The fit with one parameter at 0, which counts as free in what is known of the others."""
    film, found, bounds, _, _, loss, scale, _ = problem
    start = found.values.copy()
    start[at] = 0.0
    others: NDArray[np.intp] = found.free[found.free != at]
    again = solve(film, start, others, bounds, loss, SOFT * scale)
    return problem._replace(found=again._replace(free=found.free))


def _clearly(problem: Problem, freely: Fit) -> bool:
    """Whether a fit with one parameter more is better by more than noise, or rounding, makes it."""
    film = problem.film
    least = float(np.sum(freely.residuals**2))
    size = float(np.hypot(np.ptp(film.x), np.ptp(film.y)))
    rounding = (guess.ROUGH * size / float(film.sigma_y.min())) ** 2
    noise = max(1.0 if problem.known else least / max(problem.dof, 1), rounding)
    return problem.chi2 - least > CLEAR * noise


def as_seen(
    values: dict[str, float], heading: int
) -> tuple[dict[str, float], dict[str, float], int]:
    """The parameters with v0 >= 0, alpha0 within a right angle, and x0 as it was given.

    With them their signs against those of the fit, and the heading.
    """
    turns = dict.fromkeys(NAMES, 1.0)
    v0, alpha0 = values["v0"], values["alpha0"]
    if v0 < 0:
        v0, alpha0, turns["v0"] = -v0, alpha0 + math.pi, -1.0
    alpha0 = math.remainder(alpha0, 2 * math.pi)
    way = heading
    if abs(alpha0) > RIGHT_ANGLE:
        alpha0 = math.remainder(math.pi - alpha0, 2 * math.pi)
        turns["alpha0"], way = -1.0, -heading
    turns["x0"] = float(heading)
    return values | {"v0": v0, "alpha0": alpha0, "x0": heading * values["x0"]}, turns, way


def _check_scale(seen: guess.Guess, film: Film, found: Fit) -> None:
    """Refuse what falls upwards, or at an altogether other rate, and fits so much better."""
    ratio = seen.g / film.g
    cost = float(np.sum((seen.weights * found.misses) ** 2))
    size = float(np.hypot(np.ptp(film.x), np.ptp(film.y)))
    noise = max(seen.cost, film.equations * (guess.ROUGH * size) ** 2)
    excess = (cost - seen.cost) / noise * max(film.equations - 6, 1)
    if excess < CLEAR or 1 / FAR <= ratio <= FAR:
        return
    if ratio < 0:
        raise ValueError(
            "the track bends upwards: is y measured downwards, as in a picture? (y=-y)"
        )
    hints = [unit for size, unit in LENGTHS.items() if 0.9 < ratio / size < 1.1]
    if film.t is not None and np.allclose(film.t, np.round(film.t)):
        hints = ["are t numbers of frames? divide them by the frame rate"]
    hint = hints[0] if hints else "pixels, or a wrong frame rate?"
    hint = f"are x and y in {hint}?" if hint in LENGTHS.values() else hint
    raise ValueError(
        f"the track falls at {seen.g:.3g} m/s^2, and g is {film.g:.3g}: x and y must be in m and "
        f"t in s ({hint})"
    )


def doubts(found: Problem, g_track: float, width: float) -> list[str]:
    """What is to be said of a fit: no convergence, a drag below 0, or a g of the track's own."""
    said, g = [], found.film.g
    if not found.found.success:
        said.append("the fit has not converged")
    if found.driven < 0:
        rows = "rows in reverse order" if found.film.t is None else "times in reverse"
        said.append(
            f"the track gains speed, as by k = {found.driven:.2g}, and k = 0 fits it badly: are "
            f"its {rows}, or x and y each other's?"
        )
    off = g_track / g
    if abs(g_track - g) > math.sqrt(CLEAR) * width and not 1 / NEAR < off < NEAR:
        why = "with what is held"
        if off > 0:
            why = f"as if lengths were {off:.3g} of the true ones, or times {off**-0.5:.3g}"
        said.append(
            f"the track falls with g = {g_track:.3g} ± {width:.1g} m/s^2, not {g:.4g}, {why}; or "
            "drag follows another law"
        )
    return said
