"""The teaching exercise carried out: its sections 6.3 to 6.8, with its own constants.

Everything is computed here by the steps of `steppers`, and held against the exact answer of
`Launch`; nothing is drawn and nothing judged.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from hodograph.engine.domain import FloatArray
from hodograph.exercise.quadratic import Quadratic, quadratic
from hodograph.exercise.scene import (
    DEGREES,
    DT,
    ETA,
    MASSE,
    TOLERANCE,
    Convergence,
    G,
    convergence,
    launch,
    steps,
)
from hodograph.launch import Launch, Trajectory
from hodograph.level import optimal_angle
from hodograph.steppers import FIXED, Flights

THREE = ("euler", "euler_cromer", "rk2")  # the methods asked for; rk4 is in the annex
SCIPY = "dopri5"  # of scipy.integrate.ode
REFERENCE_DT = 0.0001  # 6.6: the step of SciPy that counts as exact
ENERGY_DT, ENERGY_ANGLE = 0.075, np.pi / 3  # 6.7
FIGURE_LAMBDA, FIGURE_DEGREES = 0.001, (30.0, 45.0, 60.0)  # kg/m; figure 1 names no angles

# --- figure 1, 6.3 and 6.4 ------------------------------------------------------------------


def figure_1() -> list[tuple[float, Trajectory]]:
    """(degrees, trajectory) for the three launches of the exercise's figure 1, exact."""
    return [
        (degrees, launch(np.deg2rad(degrees), FIGURE_LAMBDA, 2).trajectory())
        for degrees in FIGURE_DEGREES
    ]


class Path(NamedTuple):
    """A launch at 45 degrees by one method, with a drag eta or without."""

    method: str
    eta: float
    flight: Flights
    exact: float  # distance in m
    off: float  # largest distance of a node from the exact position at its time, m


def paths(method: str) -> tuple[Path, Path]:
    """The trajectory of 6.3 (6.4 for SciPy) with ETA, and without drag.

    Parameters
    ----------
    method : str
        One of `steppers.METHODS`.

    Returns
    -------
    tuple of Path
        With drag, and without.

    Examples
    --------
    >>> with_drag, without = paths("rk2")
    >>> print(f"{with_drag.flight.impact.x:.3f} {without.flight.impact.x:.3f}")
    467.761 499.490
    """
    found = []
    for eta in (ETA, 0.0):
        scene = launch(np.pi / 4, eta)
        flight = steps(scene, method, DT, history=True)
        x, y = _linear_motion(scene, flight.t)
        off = float(np.max(np.hypot(flight.x - x, flight.y - y)))
        found.append(Path(method, eta, flight, float(scene.range()), off))
    return found[0], found[1]


def _linear_motion(scene: Launch, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Position in time for linear drag or none, the solution of (4)."""
    p, q = scene.v0 * np.cos(scene.alpha0), scene.v0 * np.sin(scene.alpha0)
    if np.isinf(scene.v_lim):
        return p * t, q * t - scene.g * t * t / 2
    tau = scene.v_lim / scene.g
    run = -tau * np.expm1(-t / tau)
    return p * run, (q + scene.v_lim) * run - scene.v_lim * t


# --- 6.5 ------------------------------------------------------------------------------------


class Impacts(NamedTuple):
    """Distance against launch angle."""

    degrees: FloatArray
    tab_rk2_impact: FloatArray  # the last stored point with y >= 0
    interpolated: FloatArray
    exact: FloatArray
    best: float  # degrees, the best of `tab_rk2_impact`
    best_exact: float  # degrees


def impacts() -> Impacts:
    """Fly the 91 angles of 6.5 by RK2 and find the best.

    Returns
    -------
    Impacts
        Both impacts, the exact distances, and the best angles.
    """
    scene = launch(np.deg2rad(DEGREES), ETA)
    flights = steps(scene, "rk2", DT)
    naive = flights.impact_naive.x
    best = np.rad2deg(optimal_angle(scene.v_norm[0], n=1))
    best_on_grid = float(DEGREES[np.argmax(naive)])
    return Impacts(DEGREES, naive, flights.impact.x, scene.range(), best_on_grid, float(best))


# --- 6.6 ------------------------------------------------------------------------------------


class Reference(NamedTuple):
    """What counts as exact in 6.6, and how far SciPy's is from the exact answer."""

    scipy: FloatArray  # xmax_converge: the last stored point with y >= 0
    exact: FloatArray
    mean_off: float  # m
    mean_off_interpolated: float  # m, of the same run with its impact interpolated


def xmax_converge() -> Reference:
    """The distances at 91 angles by ``scipy.integrate.ode`` at a step of 0.0001 s, and exact.

    Returns
    -------
    Reference
        Both, and the mean difference.
    """
    scene = launch(np.deg2rad(DEGREES), ETA)
    exact = scene.range()
    flights = steps(scene, SCIPY, REFERENCE_DT)
    naive, inside = (
        float(np.mean(np.abs(impact.x - exact)))
        for impact in (flights.impact_naive, flights.impact)
    )
    return Reference(flights.impact_naive.x, exact, naive, inside)


# --- 6.7 ------------------------------------------------------------------------------------


class Energy(NamedTuple):
    """Energies in time by one method, in J."""

    method: str
    t: FloatArray
    kinetic: FloatArray
    potential: FloatArray
    total: FloatArray
    gain: float  # at the last node above the ground
    power: float  # W, the slope of the total in time
    shadow: float  # J, the most that total +- m g dt q / 2 changes; see `energies`


def energies() -> list[Energy]:
    """Energies in time without drag, at 60 degrees and a step of 0.075 s.

    With a constant force Euler's y is too high by g t dt/2 and Euler-Cromer's too low by as much:
    the total energy changes by ± m g² dt/2 a second.  What each of them keeps is the total
    plus (Euler) or minus (Euler-Cromer) m g dt q/2.

    Returns
    -------
    list of Energy
        For Euler, Euler-Cromer, RK2 and RK4.
    """
    found = []
    scene = launch(ENERGY_ANGLE, 0.0)
    for method in FIXED:
        flight = steps(scene, method, ENERGY_DT, history=True)
        t, y, p, q = (row[: flight.steps] for row in (flight.t, flight.y, flight.p, flight.q))
        kinetic, potential = MASSE * (p * p + q * q) / 2, MASSE * G * y
        total = kinetic + potential
        kept = total + _sign(method) * MASSE * G * ENERGY_DT * q / 2
        found.append(
            Energy(
                method,
                t,
                kinetic,
                potential,
                total,
                gain=float(total[-1] - total[0]),
                power=float(np.polyfit(t, total - total[0], 1)[0]),
                shadow=float(np.max(np.abs(kept - kept[0]))),
            )
        )
    return found


def _sign(method: str) -> int:
    return {"euler": 1, "euler_cromer": -1}.get(method, 0)


# --- all of it ------------------------------------------------------------------------------


class Findings(NamedTuple):
    """What the exercise finds, section by section."""

    figure_1: list[tuple[float, Trajectory]]
    paths: dict[str, tuple[Path, Path]]  # 6.3; 6.4 is the one of SCIPY
    impacts: Impacts  # 6.5
    reference: Reference  # 6.6
    loops: list[Convergence]
    energies: list[Energy]  # 6.7
    quadratic: Quadratic  # 6.8


def work(progress: Callable[[str], None] = lambda message: None) -> Findings:
    """Carry out the whole exercise, in about half a minute.

    Parameters
    ----------
    progress : callable, optional
        Called with a short message as each part begins.

    Returns
    -------
    Findings
        The results of 6.3 to 6.8.
    """
    progress("6.3 and 6.4 trajectories")
    trajectories = {method: paths(method) for method in (*THREE, SCIPY)}
    progress("6.5 impact against angle")
    against_angle = impacts()
    progress(f"6.6 SciPy at {REFERENCE_DT} s")
    reference = xmax_converge()
    scene = launch(np.deg2rad(DEGREES), ETA)
    loops = []
    for method in FIXED:
        progress(f"6.6 delta until {TOLERANCE} m: {method}")
        loops.append(
            convergence(method, scene, {"scipy": reference.scipy, "exact": reference.exact})
        )
    progress("6.7 energies")
    energy = energies()
    return Findings(
        figure_1(), trajectories, against_angle, reference, loops, energy, quadratic(progress)
    )
