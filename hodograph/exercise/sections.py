"""The teaching exercise carried out: its sections 6.3 to 6.7, and all of it together.

Everything is computed by the steps of `steppers`, and held against the exact answer of
`Launch`; nothing is drawn and nothing judged.
"""

import logging
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

from hodograph.engine.domain import FloatArray
from hodograph.exercise.convergence import Convergence, convergence
from hodograph.exercise.quadratic import Quadratic, quadratic
from hodograph.exercise.setup import Setup, steps
from hodograph.launch import Launch, Trajectory
from hodograph.level import optimal_angle
from hodograph.steppers import FIXED, Flights

THREE = ("euler", "euler_cromer", "rk2")  # the methods asked for; rk4 is in the annex
SCIPY = "dopri5"  # of scipy.integrate.ode

log = logging.getLogger("hodograph")

# --- figure 1, 6.3 and 6.4 ------------------------------------------------------------------


class Figure1(NamedTuple):
    """The exercise's figure 1, exact."""

    paths: list[tuple[float, Trajectory]]  # by degrees
    best: float  # degrees


def figure_1(setup: Setup) -> Figure1:
    """Three launches under weak quadratic drag, and the best angle there.

    >>> round(figure_1(Setup()).best, 2)
    42.61
    """
    scene = setup.launch(np.deg2rad(setup.figure_degrees), setup.figure_lambda, 2)
    paths = [
        (degrees, setup.launch(np.deg2rad(degrees), setup.figure_lambda, 2).trajectory())
        for degrees in setup.figure_degrees
    ]
    return Figure1(paths, _best(scene))


def _best(scene: Launch) -> float:
    return float(np.rad2deg(optimal_angle(np.max(scene.v_norm), n=np.max(scene.n))))


class Path(NamedTuple):
    """A launch by one method, with a drag eta or without."""

    method: str
    eta: float
    flight: Flights
    exact: float  # distance in m
    off: float  # largest distance of a node from the exact position at its time, m


def paths(setup: Setup, method: str) -> tuple[Path, Path]:
    """The trajectory of 6.3 (6.4 for SciPy) with drag, and without.

    >>> with_drag, without = paths(Setup(), "rk2")
    >>> print(f"{with_drag.flight.impact.x:.3f} {without.flight.impact.x:.3f}")
    467.761 499.490
    """
    found = []
    for eta in (setup.eta, 0.0):
        scene = setup.launch(drag=eta)
        flight = steps(scene, method, setup.dt, history=True)
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


# --- 6.5, and 6.8 with its drag -------------------------------------------------------------


class Impacts(NamedTuple):
    """Distance against launch angle by one method."""

    method: str
    degrees: FloatArray
    naive: FloatArray  # the last stored point with y >= 0: tab_rk2_impact
    interpolated: FloatArray
    exact: FloatArray
    best: float  # degrees, the best of `naive`
    best_fitted: float  # degrees, the top of the curve through `interpolated`
    best_exact: float  # degrees


def impacts(setup: Setup, method: str, drag: float, n: int = 1) -> Impacts:
    """Fly the 91 angles of 6.5 by one method, and find the best angle in three ways."""
    scene = setup.fan(drag, n)
    flights = steps(scene, method, setup.dt)
    naive, inside = flights.impact_naive.x, flights.impact.x
    at = int(np.clip(np.argmax(inside), 3, len(inside) - 4))
    near = slice(at - 3, at + 4)
    crest = Polynomial.fit(setup.angles[near], inside[near], 4)  # to about 1e-4 degrees
    turns = crest.deriv().roots()
    tops = turns[np.isreal(turns)].real
    fitted = tops[np.argmin(np.abs(tops - setup.angles[at]))]
    best = float(setup.angles[np.argmax(naive)])
    return Impacts(
        method, setup.angles, naive, inside, scene.range(), best, float(fitted), _best(scene)
    )


# --- 6.6 ------------------------------------------------------------------------------------


class Reference(NamedTuple):
    """What counts as exact in 6.6, and how far SciPy's is from the exact answer."""

    scipy: FloatArray  # xmax_converge: the last stored point with y >= 0
    exact: FloatArray
    speed: FloatArray  # horizontal, at the exact landing, m/s
    mean_off: float  # m
    mean_off_interpolated: float  # m, of the same run with its impact interpolated


def xmax_converge(setup: Setup) -> Reference:
    """The distances at 91 angles by ``scipy.integrate.ode`` at its step of 6.6, and exact."""
    scene = setup.fan(setup.eta)
    landing = scene.landing()
    flights = steps(scene, SCIPY, setup.reference_dt)
    naive, inside = (
        float(np.mean(np.abs(impact.x - landing.x)))
        for impact in (flights.impact_naive, flights.impact)
    )
    speed = landing.speed * np.cos(landing.alpha)
    return Reference(flights.impact_naive.x, landing.x, speed, naive, inside)


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


def energy(setup: Setup, flight: Flights) -> tuple[FloatArray, FloatArray]:
    """Kinetic and potential energy at the stored points, J."""
    return setup.mass * (flight.p**2 + flight.q**2) / 2, setup.mass * setup.g * flight.y


def energies(setup: Setup) -> list[Energy]:
    """Energies in time without drag, by every method, at the angle and the step of 6.7.

    With a constant force Euler's y is too high by g t dt/2 and Euler-Cromer's too low by as much:
    the total energy changes by ± m g² dt/2 a second.  What each of them keeps is the total
    plus (Euler) or minus (Euler-Cromer) m g dt q/2.
    """
    found = []
    scene = setup.launch(np.deg2rad(setup.energy_degrees))
    for method in FIXED:
        flight = steps(scene, method, setup.energy_dt, history=True)
        above = slice(0, flight.steps)
        kinetic, potential = (part[above] for part in energy(setup, flight))
        t, total = flight.t[above], kinetic + potential
        sign = {"euler": 1, "euler_cromer": -1}.get(method, 0)
        kept = total + sign * setup.mass * setup.g * setup.energy_dt * flight.q[above] / 2
        gain, power = float(total[-1] - total[0]), float(np.polyfit(t, total - total[0], 1)[0])
        shadow = float(np.max(np.abs(kept - kept[0])))
        found.append(Energy(method, t, kinetic, potential, total, gain, power, shadow))
    return found


# --- all of it ------------------------------------------------------------------------------


class Findings(NamedTuple):
    """What the exercise finds, section by section."""

    setup: Setup
    figure_1: Figure1
    paths: dict[str, tuple[Path, Path]]  # 6.3; 6.4 is the one of SCIPY
    impacts: Impacts  # 6.5
    reference: Reference  # 6.6
    loops: list[Convergence]
    energies: list[Energy]  # 6.7
    quadratic: Quadratic  # 6.8
    quadratic_impacts: list[Impacts]  # 6.8


def work(setup: Setup) -> Findings:
    """Carry out the whole exercise, in about half a minute."""
    log.info("6.3 and 6.4 trajectories")
    trajectories = {method: paths(setup, method) for method in (*THREE, SCIPY)}
    log.info("6.5 impact against angle")
    against_angle = impacts(setup, "rk2", setup.eta)
    log.info(f"6.6 SciPy at {setup.reference_dt} s")
    reference = xmax_converge(setup)
    known = {"scipy": reference.scipy, "exact": reference.exact}
    loops = []
    for method in FIXED:
        log.info(f"6.6 delta until {setup.limit:g} m: {method}")
        loops.append(convergence(setup, method, setup.fan(setup.eta), known))
    log.info("6.7 energies")
    drifts = energies(setup)
    square = quadratic(setup)
    log.info("6.8 impact against angle")
    fans = [impacts(setup, method, setup.lambda_, 2) for method in THREE]
    return Findings(
        setup, figure_1(setup), trajectories, against_angle, reference, loops, drifts, square, fans
    )
