"""Drag out of a track: what a film of a flight says of its launch, and how surely."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, power
from hodograph.engine.domain import FloatArray
from hodograph.engine.record import Record, plain
from hodograph.launch import Launch

Loss: TypeAlias = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]


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
        Drag constant lambda/m, 1/m; for another exponent m^(1-n) s^(n-2).
    v_lim : float
        Terminal speed (g/k)^(1/n), m/s: ``inf`` where `k` is 0.
    v_lim_low : float
        What `v_lim` is at least, m/s: its value at `k` and twice its uncertainty.
    v0, alpha0, x0, y0, t0 : float
        The launch: speed, elevation in the direction of flight, place and time; `t0` is None
        without times.
    n : float
        The drag exponent, given or fitted.
    heading : int
        1 where the flight goes towards larger x, else -1.
    cd : float or None
        Drag coefficient, where mass and size are given.
    uncertainty : dict
        Half the width of the interval that holds the truth in 68.3 % of films, by the names of
        what was fitted, and of `v_lim` (``inf`` where `k` is not twice its own) and `cd`.
    fitted : tuple of str
        The names of what was fitted, in the order of `covariance`.
    covariance : ndarray
        The covariance of these; the roots of its diagonal are their uncertainties.
    residuals : ndarray
        How far each point lies from the path in x and y, of shape (points given, 2); NaN where a
        point was left out for a NaN.
    rms : float
        Root mean square of these distances.
    sigma : float
        Noise of one coordinate: found if it was not given, or else `chi2_reduced` ** 0.5 in its
        units.
    chi2_reduced : float
        chi^2 over the degrees of freedom; NaN where `sigma` was not given.
    aic : float
        Akaike's criterion, up to a constant of the track: the least is the best of several fits.
    points, dof : int
        Points that counted, and degrees of freedom.
    g : float
        The gravity that was taken.
    g_track : float
        The gravity that the track would have with all else fitted: away from `g` by more than its
        own uncertainty, in `uncertainty` by this name, it shows a wrong scale of lengths or times.
        NaN without times.
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
