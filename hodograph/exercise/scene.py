"""The exercise's constants, its launch, and the loop of its section 6.6.

Names in French are the exercise's.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hodograph import steppers
from hodograph.engine.domain import FloatArray
from hodograph.launch import Launch
from hodograph.steppers import Flights

MASSE, G, V0 = 1.0, 9.81, 70.0  # kg, m/s^2, m/s
DT = 0.001  # s
ETA = 0.01  # kg/s
LAMBDA = 0.1  # kg/m, 6.8
DEGREES = np.arange(91.0)  # 6.5, 6.6
DELTA_1, RATIO, TOLERANCE = 1.0, 1.1, 0.1  # 6.6: DT and a of (18); metres
MOST = 80  # 6.6: the greatest n tried
IMPACTS = ("naive", "interpolated")
REFERENCES = ("scipy", "exact")
ROUNDING = 1e-9  # metres: errors below are not of the method alone


def launch(
    theta: ArrayLike, drag: ArrayLike, n: int = 1, *, v0: float = V0, height: float = 0.0
) -> Launch:
    """The exercise's launch, for a force ``drag * v**n`` against the motion.

    Parameters
    ----------
    theta : array_like
        Launch angle in radians.
    drag : array_like
        eta in kg/s for n = 1, lambda in kg/m for n = 2; 0 is vacuum.
    n : int, optional
        Exponent of the drag.
    v0, height : float, optional
        Launch speed in m/s, height in m.

    Returns
    -------
    Launch
        Exact answers.

    Examples
    --------
    >>> round(float(launch(np.pi / 4, ETA).range()), 3)
    467.761
    """
    return Launch.from_drag(v0, theta, np.divide(drag, MASSE), n=n, g=G, height=height)


def steps(scene: Launch, method: str, dt: float, *, history: bool = False) -> Flights:
    """The same launch in steps of dt.

    Parameters
    ----------
    scene : Launch
        From `launch`.
    method : str
        One of `steppers.METHODS`.
    dt : float
        The step in s.
    history : bool, optional
        Keep every node.

    Returns
    -------
    steppers.Flights
        The flights.

    Examples
    --------
    >>> round(float(steps(launch(np.pi / 4, ETA), "euler", DT).impact_naive.x), 3)
    467.762
    """
    return steppers.integrate(
        scene.v0,
        scene.alpha0,
        scene.v_lim,
        dt=dt,
        method=method,
        n=scene.n,
        g=scene.g,
        height=scene.height,
        history=history,
    )


# --- 6.6 ------------------------------------------------------------------------------------


class Reached(NamedTuple):
    """Where the loop of 6.6 ends."""

    n: int
    delta: float  # s
    error: float  # m
    evaluations: int  # of the acceleration, at this delta, for all angles together


class Convergence(NamedTuple):
    """Mean errors of one method as delta falls."""

    method: str
    limit: float  # m
    n: FloatArray
    delta: FloatArray
    errors: dict[tuple[str, str], FloatArray]  # by impact and reference, m; NaN: exploded
    evaluations: FloatArray

    def reached(self, impact: str, reference: str) -> Reached | None:
        """Where the error is first below the limit; None if it never is, up to the last n.

        Parameters
        ----------
        impact : {"naive", "interpolated"}
            Which impact.
        reference : {"scipy", "exact"}
            What counts as exact.

        Returns
        -------
        Reached or None
            The n and delta of the loop's end.
        """
        error = self.errors[impact, reference]
        below = np.flatnonzero(error < self.limit)
        if below.size == 0:
            return None
        at = below[0]
        return Reached(
            int(self.n[at]), float(self.delta[at]), float(error[at]), int(self.evaluations[at])
        )

    def order(self, impact: str) -> float:
        """The slope of log error on log delta, as far as the error is above rounding.

        Parameters
        ----------
        impact : {"naive", "interpolated"}
            Which impact; against the exact answer.

        Returns
        -------
        float
            The slope.
        """
        return slope(self.delta, self.errors[impact, "exact"])


def slope(step: FloatArray, error: FloatArray) -> float:
    """Slope of log error on log step by least squares, where the error is above rounding.

    Parameters
    ----------
    step, error : ndarray
        Steps, and errors in metres (joules); NaN and errors below 1e-9 are left out.

    Returns
    -------
    float
        The slope; NaN for fewer than three points.

    Examples
    --------
    >>> step = np.array([0.1, 0.05, 0.025])
    >>> round(slope(step, 3 * step**2), 6)
    2.0
    """
    good = error > ROUNDING
    if np.count_nonzero(good) < 3:
        return float("nan")
    return float(np.polyfit(np.log(step[good]), np.log(error[good]), 1)[0])


def convergence(method: str, scene: Launch, references: dict[str, FloatArray]) -> Convergence:
    """The loop of 6.6: smaller and smaller delta until the mean error is below 0.1 m.

    It ends when three deltas in a row are below with both impacts and against every reference,
    so that an error that is small by luck would be seen; or at n = 80.

    Parameters
    ----------
    method : str
        One of `steppers.FIXED`.
    scene : Launch
        The launches, from `launch`.
    references : dict
        What counts as exact: distances in m.

    Returns
    -------
    Convergence
        The errors at every delta.
    """
    rows: list[list[float]] = []
    costs, deltas = [], []
    keys = [(impact, reference) for impact in IMPACTS for reference in references]
    while len(rows) < MOST and not (len(rows) >= 3 and np.max(rows[-3:]) < TOLERANCE):
        delta = DELTA_1 / RATIO ** (len(rows) + 1)  # (18)
        flights = steps(scene, method, delta)
        found = {"naive": flights.impact_naive.x, "interpolated": flights.impact.x}
        rows.append(
            [float(np.mean(np.abs(found[impact] - references[name]))) for impact, name in keys]
        )
        deltas.append(delta)
        costs.append(flights.evaluations)
    errors = dict(zip(keys, np.array(rows).T, strict=True))
    n = np.arange(1.0, len(rows) + 1)
    return Convergence(method, TOLERANCE, n, np.array(deltas), errors, np.array(costs, dtype=float))
