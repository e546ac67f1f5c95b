"""Drag out of a track: what a film of a flight says of its launch, and how surely."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from hodograph import bodies
from hodograph.engine import domain, estimate, film, fit, power, problem
from hodograph.engine.domain import BoolArray, FloatArray, Rule
from hodograph.engine.film import NAMES
from hodograph.engine.problem import Problem, as_seen
from hodograph.engine.record import Record, rounded
from hodograph.launch import Launch

Loss: TypeAlias = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]

LEVEL = Rule("in (0, 1)", lambda a: (a > 0) & (a < 1))


class Interval(NamedTuple):
    """The ends of an interval, in the units of the parameter."""

    low: float
    high: float


@dataclass(frozen=True, eq=False, repr=False)
class Calibration(Record):
    """What a track says of its launch; lengths in m, times in s, angles in radians.

    Attributes
    ----------
    k : float
        Drag constant lambda/m, in 1/m; in m^(1-n) s^(n-2) for any n.
    v_lim : float
        Terminal speed (g/k)^(1/n), m/s; ``inf`` where `k` is 0.
    v_lim_low : float
        A lower bound of it, m/s: with `k` larger by twice its uncertainty.
    v0, alpha0, x0, y0, t0 : float
        The launch: speed, elevation in the direction of flight, place and time (None without
        times).
    n : float
        The drag exponent, given or fitted.
    heading : int
        1 where the flight goes towards larger x, -1 towards smaller.
    cd : float or None
        Drag coefficient, where mass and size are given.
    uncertainty : dict
        Standard uncertainties by the names of what was fitted, and of `v_lim` (``inf`` where `k`
        is less than twice its own), `cd` and `g_track`: the truth is within them in 68.3 % of
        films, within twice them in 95 %.
    fitted : tuple of str
        The names of what was fitted, in the order of `covariance`.
    covariance : ndarray
        Covariance of these, its diagonal the squares of their uncertainties.
    residuals : ndarray
        By how much each point misses the path, in x and in y, of shape (points given, 2); NaN
        for points left out for a NaN.
    rms : float
        Root mean square of these distances, m.
    sigma : float
        Noise of one coordinate, m, as the residuals show it; its factor where `sigma` was given.
    chi2_reduced : float
        chi^2 over the degrees of freedom; NaN where `sigma` was not given.
    aic : float
        Akaike's criterion, but for a constant of the track: of several fits, the least is best.
    points, dof : int
        Points that counted; degrees of freedom.
    g : float
        Gravity as it was given.
    g_track : float
        Gravity as the track has it, all else fitted too, to first order; NaN without times.  If
        it differs by more than its uncertainty, so does the scale of lengths, as it does, or of
        times.
    success : bool
        Whether the iteration converged.
    """

    k: float
    v_lim: float
    v_lim_low: float
    v0: float
    alpha0: float
    x0: float
    y0: float
    t0: float | None
    n: float
    heading: int
    cd: float | None
    uncertainty: dict[str, float]
    fitted: tuple[str, ...]
    covariance: FloatArray
    residuals: FloatArray
    rms: float
    sigma: float
    chi2_reduced: float
    aic: float
    points: int
    dof: int
    g: float
    g_track: float
    success: bool

    def __repr__(self) -> str:
        """One line: what was found, with its uncertainty."""
        parts = []
        for name in ("k", "v_lim", "v0", "alpha0", "x0", "y0", "t0", "n", "cd"):
            value, u = getattr(self, name), self.uncertainty.get(name, 0.0)
            if value is not None:
                sure = not (0 < u < math.inf)
                parts.append(f"{name}=" + (f"{value:.6g}" if sure else "±".join(rounded(value, u))))
        return f"Calibration({', '.join(parts)}, rms={self.rms:.3g}, points={self.points})"

    @property
    def launch(self) -> Launch[np.float64]:
        """The launch, at its height over y = 0: its path is the film's, with x from `x0`."""
        return Launch(self.v0, self.alpha0, self.v_lim, n=self.n, g=self.g, height=self.y0)

    def profile(self, name: str = "k", *, level: float = estimate.ONE_SIGMA) -> Interval:
        """The interval of one parameter by the profile of chi^2, which need not be symmetric.

        Parameters
        ----------
        name : str, optional
            One of `fitted`, or ``"v_lim"`` where n was given.
        level : float, optional
            How often the interval is to hold the truth, in (0, 1).

        Returns
        -------
        Interval
            Its ends, in the unit of the parameter: where chi^2, least in all others, has grown by
            what the level allows, or a bound.  The upper end of `v_lim` is ``inf`` where `k` may
            be 0.

        Raises
        ------
        ValueError
            The parameter was not fitted, the level is out of range, or the loss is not linear.

        Examples
        --------
        >>> import numpy as np
        >>> t = np.linspace(0.0, 1.5, 16)
        >>> wave = 0.01 * np.cos(9 * t)  # in place of noise
        >>> film = calibrate(5 * t, 9 * t - 4.905 * t**2 + wave, t)
        >>> low, high = film.profile("k", level=0.95)
        >>> low, high < 0.01
        (0.0, True)
        """
        level = domain.option("level", level, LEVEL)
        problem: Problem = self.__dict__["_problem"]
        if problem.loss != "linear":
            raise ValueError(f"profile needs loss='linear'; this fit had {problem.loss!r}")
        if name == "v_lim" and "k" in self.fitted and "n" not in self.fitted:
            low, high = self.profile("k", level=level)
            return Interval(_terminal(high, self.g, self.n), _terminal(low, self.g, self.n))
        if name not in self.fitted:
            raise ValueError(f"name must be one of {', '.join(self.fitted)}; got {name!r}")
        width = problem.noise * estimate.widening(level, self.dof, known=problem.known)
        half, at = self.uncertainty[name] / 2, NAMES.index(name)
        low, high = estimate.interval(problem.film, problem.found, at, width, half, problem.bounds)
        return Interval(-high, -low) if name == "x0" and self.heading < 0 else Interval(low, high)


def _terminal(k: float, g: float, n: float) -> float:
    return math.inf if k <= 0 else float((g / k) ** (1 / n))


def calibrate(
    x: ArrayLike,
    y: ArrayLike,
    t: ArrayLike | None = None,
    *,
    n: float | None = 2.0,
    g: float = 9.81,
    sigma: Any = None,
    absolute_sigma: bool = True,
    fixed: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    loss: Loss = "linear",
    mass: float | None = None,
    diameter: float | None = None,
    area: float | None = None,
    rho: float = 1.225,
) -> Calibration:
    """Drag and launch of a flight, fitted to points of it by least squares.

    Parameters
    ----------
    x, y : array_like
        Positions in m, y upwards, of one length and in any order; a point with a NaN is left out.
    t : array_like, optional
        Times in s.  Without them the curve y(x) is fitted, and the first row is its beginning.
    n : float or None, optional
        The drag grows as the n-th power of the speed, n in [1, 10]; None to fit it, too.
    g : float, optional
        Gravity in m/s^2.
    sigma : float, array_like or pair of these, optional
        Noise of the positions in m, or (noise of x, noise of y), each one number or one a point.
        By default it is found from the residuals.  Without times, all of it is in y, but for a
        pair: then the curve is fitted in both directions.
    absolute_sigma : bool, optional
        False where `sigma` gives but ratios, and the size of the noise is to be found.
    fixed : mapping, optional
        Values to be held, by the names v0, alpha0, k, v_lim (for n given), x0, y0, t0.  The launch
        is the place of the first time or, without times, of the first x; to place it elsewhere
        hold x0 or y0, or t0 (with times).
    bounds : mapping, optional
        (least, greatest) by the names of `fixed` but v_lim, or n; ``k`` is at least 0 by default.
    loss : {"linear", "soft_l1", "huber", "cauchy", "arctan"}, optional
        What outliers weigh, as in `scipy.optimize.least_squares`, from 1.5 sigma on.
    mass, diameter, area, rho : float, optional
        kg, m, m^2 and kg/m^3, for `cd` (see `hodograph.bodies.drag_constant`).

    Returns
    -------
    Calibration
        The parameters, with their uncertainties.

    Raises
    ------
    ValueError
        Something is out of its range, there are too few points for what is fitted or they do not
        determine it, y grows downwards, or the track falls at less than half or more than twice
        `g`.
    TypeError
        Something is not made of real numbers, or of the wrong shape.

    Warns
    -----
    UserWarning
        The track falls with another g than given, or another law of drag; it gains speed as if it
        were run backwards; or no convergence.

    Notes
    -----
    The fit is of k = g/v_lim^n, which is regular where there is no drag.  A film that cannot tell
    drag from none gives ``k`` near 0 with its uncertainty, and a lower bound of `v_lim`.  Where the
    least squares would have k < 0, `k` is 0, and the uncertainties are those of a free `k`: such an
    interval holds the truth more often than it says.  To average many films, allow negative values
    by ``bounds={"k": (-inf, inf)}``: cutting them off would bias the mean.

    Examples
    --------
    A ball of 0.43 kg and 22 cm, its positions known to 1 cm:

    >>> import numpy as np
    >>> from hodograph import Launch
    >>> path = Launch.from_drag(14.4, 0.76, 0.012).trajectory(40)
    >>> noise = 0.01 * np.sin(np.arange(80) ** 2.0).reshape(2, 40)
    >>> film = calibrate(path.x + noise[0], path.y + noise[1], path.t, mass=0.43, diameter=0.22)
    >>> print(f"k = {film.k:.4f} ± {film.uncertainty['k']:.4f} 1/m")
    k = 0.0119 ± 0.0002 1/m
    >>> print(f"cd = {film.cd:.3f} ± {film.uncertainty['cd']:.3f}")
    cd = 0.222 ± 0.002
    """
    g = domain.option("g", g, domain.GRAVITY)
    n = n if n is None else domain.option("n", n, power.EXPONENT)
    if loss not in estimate.LOSSES:
        raise ValueError(f"loss must be one of {', '.join(estimate.LOSSES)}; got {loss!r}")
    points, kept = film.points(x, y, t, sigma, g)
    timed = t is not None
    held = film.held({} if fixed is None else fixed, n, g, timed=timed)
    limits = film.limits({} if bounds is None else bounds, held, n, timed=timed)
    per_k = None
    if mass is not None or diameter is not None or area is not None:
        if n != 2:
            raise ValueError("cd belongs to n = 2: leave mass, diameter and area out")
        per_k = 1 / _drag_of_unit_cd(mass, diameter, area, rho)
    known = sigma is not None and absolute_sigma
    asked = problem.Asked(held, limits, n, loss, known, "k" not in (bounds or {}))
    tries = [(problem.fitted(points, way, asked), way) for way in film.headings(points)]
    misfits = [float(np.sum(each.found.residuals**2)) for each, _ in tries]
    clearly = misfits[-1] < misfits[0] - tries[0][0].noise ** 2
    found, heading = tries[-1 if clearly else 0]
    result = _result(found, heading, kept, per_k)
    _warn(result)
    return result


# --- what comes in --------------------------------------------------------------------------


def _drag_of_unit_cd(mass: Any, diameter: Any, area: Any, rho: Any) -> float:
    if mass is None:
        raise TypeError("cd needs mass (kg) beside diameter (m) or area (m^2)")
    body = {"mass": mass, "diameter": diameter, "area": area, "rho": rho}
    for name, value in body.items():
        if value is not None:
            domain.option(name, value, domain.POSITIVE if name == "rho" else domain.FINITE)
    return float(bodies.drag_constant(cd=1.0, **body))


# --- what comes out -------------------------------------------------------------------------


def _result(problem: Problem, heading: int, kept: BoolArray, per_k: float | None) -> Calibration:
    points, found, spare = problem.film, problem.found, problem.dof
    values, turns, way = as_seen(dict(zip(NAMES, found.values.tolist(), strict=True)), heading)
    fitted = tuple(NAMES[i] for i in found.free)
    width = estimate.widening(estimate.ONE_SIGMA, max(spare, 1), known=problem.known)
    turn = width * np.array([turns[name] for name in fitted])
    covariance = _covariance(problem) * np.outer(turn, turn)
    u = dict(zip(fitted, np.sqrt(np.diag(covariance)).tolist(), strict=True))
    k, n, g = values["k"], values["n"], points.g
    v_lim = v_lim_low = _terminal(k, g, n)
    if "k" in u:
        u["v_lim"], v_lim_low = _terminal_and_its_bound(k, g, n, fitted, covariance)
        if per_k is not None:
            u["cd"] = u["k"] * per_k
    g_track = math.nan
    if points.t is not None and spare > 0 and problem.loss == "linear":
        g_track, u["g_track"] = estimate.gravity(found, g, problem.noise * width)
    misses = np.full((kept.size, 2), np.nan)
    misses[kept] = found.misses.T * [heading, 1.0]
    result = Calibration(
        **{name: values[name] for name in ("k", "v0", "alpha0", "x0", "y0", "n")},
        t0=None if points.t is None else values["t0"],
        v_lim=v_lim,
        v_lim_low=v_lim_low,
        heading=way,
        cd=None if per_k is None else k * per_k,
        uncertainty=u,
        fitted=fitted,
        covariance=covariance,
        residuals=misses,
        rms=math.sqrt(float(np.mean(np.sum(found.misses**2, axis=0)))),
        sigma=problem.sigma,
        chi2_reduced=problem.chi2 / spare if problem.known and spare else math.nan,
        aic=problem.aic,
        points=len(points.x),
        dof=spare,
        g=g,
        g_track=g_track,
        success=found.success,
    )
    result.__dict__["_problem"] = problem
    return result


def _covariance(problem: Problem) -> FloatArray:
    """Of what is free, or a refusal."""
    found, noise = problem.found, problem.noise
    if problem.loss != "linear":
        noise = estimate.robust_noise(found, problem.loss, fit.SOFT * problem.scale)
    covariance, lost = estimate.covariance(found, noise)
    if lost is not None:
        name = NAMES[found.free[lost]]
        hint = "give it, as n=2" if name == "n" else f"hold it, fixed={{{name!r}: ...}}"
        raise ValueError(f"the track does not determine {name}: {hint}")
    return covariance


def _terminal_and_its_bound(
    k: float, g: float, n: float, fitted: tuple[str, ...], covariance: FloatArray
) -> tuple[float, float]:
    """The uncertainty of v_lim, ``inf`` where drag is not told from none, and its lower bound.

    Both are those of k but where n is fitted, too, with which k goes together.
    """
    u_k = math.sqrt(covariance[fitted.index("k"), fitted.index("k")])
    low = _terminal(k + 2 * u_k, g, n)
    if k <= 0:
        return math.inf, low
    row = {"k": -1 / (n * k), "n": -math.log(g / k) / n**2}
    part = np.array([row.get(name, 0.0) for name in fitted])
    relative = math.sqrt(part @ covariance @ part)
    v_lim = _terminal(k, g, n)
    if "n" in fitted:
        low = v_lim * math.exp(-2 * relative)
    return (v_lim * relative if n * relative < 0.5 else math.inf), low


def _warn(result: Calibration) -> None:
    """Say that the iteration failed, or what no such flight would have."""
    found: Problem = result.__dict__["_problem"]
    for doubt in problem.doubts(found, result.g_track, result.uncertainty.get("g_track", math.inf)):
        warnings.warn(doubt, stacklevel=3)
