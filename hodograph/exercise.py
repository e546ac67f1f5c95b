"""The teaching exercise carried out: its sections 6.3 to 6.8, with its own constants.

Everything is computed here by the steps of `steppers`, and held against the exact answer of
`Launch`; nothing is drawn and nothing judged.  Names in French are the exercise's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hodograph import steppers
from hodograph.domain import FloatArray
from hodograph.launch import Launch, Trajectory
from hodograph.optimum import optimal_angle
from hodograph.steppers import FIXED, Flights

MASSE, G, V0 = 1.0, 9.81, 70.0  # kg, m/s^2, m/s
DT = 0.001  # s
ETA = 0.01  # kg/s
THREE = ("euler", "euler_cromer", "rk2")  # the methods asked for; rk4 is in the annex
SCIPY = "dopri5"  # of scipy.integrate.ode
DEGREES = np.arange(91.0)  # 6.5, 6.6
REFERENCE_DT = 0.0001  # 6.6: the step of SciPy that counts as exact
DELTA_1, RATIO, TOLERANCE = 1.0, 1.1, 0.1  # 6.6: DT and a of (18); metres
MOST = 80  # 6.6: the greatest n tried
ENERGY_DT, ENERGY_ANGLE = 0.075, np.pi / 3  # 6.7
LAMBDA = 0.1  # kg/m, 6.8
FIGURE_LAMBDA, FIGURE_DEGREES = 0.001, (30.0, 45.0, 60.0)  # kg/m; figure 1 names no angles
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

IMPACTS = ("naive", "interpolated")
REFERENCES = ("scipy", "exact")


class Reference(NamedTuple):
    """What counts as exact in 6.6, and how far SciPy's is from the exact answer."""

    scipy: FloatArray  # xmax_converge: the last stored point with y >= 0
    exact: FloatArray
    mean_off: float  # m
    mean_off_interpolated: float  # m, of the same run with its impact interpolated
    evaluations: int


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
    return Reference(flights.impact_naive.x, exact, naive, inside, flights.evaluations)


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


# --- 6.8 ------------------------------------------------------------------------------------

ORDER_STEPS = 0.02 / 2.0 ** np.arange(6)  # s
BALANCE_STEPS = 0.02 / 2.0 ** np.arange(5)  # s
BALANCE_DT = 0.01  # s
FALL, FALL_STEPS = 100.0, (0.1, 0.01)  # m, s
LAMBDAS = 10.0 ** -np.arange(1, 9)  # kg/m


class Order(NamedTuple):
    """Mean error over the angles, in m, by step."""

    method: str
    dt: FloatArray
    naive: FloatArray
    interpolated: FloatArray

    @property
    def slopes(self) -> tuple[float, float]:
        """Of the naive impact, and of the interpolated."""
        return slope(self.dt, self.naive), slope(self.dt, self.interpolated)


class Balance(NamedTuple):
    """Energy plus the work done against drag, less the energy at the launch, in J."""

    method: str
    t: FloatArray
    residual: FloatArray  # in time, at BALANCE_DT
    largest: FloatArray  # for each of BALANCE_STEPS
    order: float


class Fall(NamedTuple):
    """A fall from rest: the speed at the ground, relative to terminal speed, less 1."""

    method: str
    off: tuple[float, ...]  # for each of FALL_STEPS


class WeakDrag(NamedTuple):
    """Distance at 45 degrees as lambda goes to 0."""

    drag: FloatArray  # kg/m
    by_rk4: FloatArray  # m
    exact: FloatArray  # m
    loss: FloatArray  # 1 - x/x(0) by RK4, over lambda, m/kg
    loss_limit: float  # m/kg


class Quadratic(NamedTuple):
    """6.8 in whole."""

    rk2: Flights  # at 45 degrees, DT
    path: Trajectory  # the same, exact
    linear: Trajectory  # with ETA, exact
    exact: float
    v_lim: float
    largest_steps: dict[str, float]  # s, stable at the launch
    loops: list[Convergence]
    orders: list[Order]
    balances: list[Balance]
    falls: list[Fall]
    fall_exact: float
    weak: WeakDrag


def quadratic(progress: Callable[[str], None] = lambda message: None) -> Quadratic:
    """Fly with quadratic drag, and test every method where no solution in time is known.

    Parameters
    ----------
    progress : callable, optional
        Called with a short message as each part begins.

    Returns
    -------
    Quadratic
        The test procedure's findings.
    """
    scene = launch(np.pi / 4, LAMBDA, 2)
    v_lim = float(scene.v_lim)
    fan = launch(np.deg2rad(DEGREES), LAMBDA, 2)
    exact = {"exact": fan.range()}
    loops = []
    for method in FIXED:
        progress(f"6.8 delta until 0.1 m: {method}")
        loops.append(convergence(method, fan, exact))
    progress("6.8 order, energy, terminal speed, weak drag")
    fall = launch(0.0, LAMBDA, 2, v0=0.0, height=FALL)
    return Quadratic(
        rk2=steps(scene, "rk2", DT, history=True),
        path=scene.trajectory(),
        linear=launch(np.pi / 4, ETA).trajectory(),
        exact=float(scene.range()),
        v_lim=v_lim,
        largest_steps={
            name: method.reach * v_lim**2 / (2 * G * V0) for name, method in FIXED.items()
        },
        loops=loops,
        orders=[_order(method, fan, exact["exact"]) for method in FIXED],
        balances=[_balance(method, scene) for method in FIXED],
        falls=[Fall(method, tuple(_fallen(method, fall, v_lim))) for method in FIXED],
        fall_exact=float(fall.landing().speed / v_lim - 1),
        weak=_weak_drag(),
    )


def _order(method: str, fan: Launch, exact: FloatArray) -> Order:
    rows = []
    for dt in ORDER_STEPS:
        flights = steps(fan, method, dt)
        both = flights.impact_naive.x, flights.impact.x
        rows.append([np.mean(np.abs(x - exact)) for x in both])
    naive, interpolated = np.array(rows).T
    return Order(method, ORDER_STEPS, naive, interpolated)


def _balance(method: str, scene: Launch) -> Balance:
    largest = [
        float(np.max(np.abs(_residual(scene, steps(scene, method, dt, history=True)))))
        for dt in BALANCE_STEPS
    ]
    flight = steps(scene, method, BALANCE_DT, history=True)
    residual = _residual(scene, flight)
    sizes = np.array(largest)
    return Balance(method, flight.t, residual, sizes, slope(BALANCE_STEPS, sizes))


def _residual(scene: Launch, flight: Flights) -> FloatArray:
    """Energy plus work against drag, less the energy at the launch, at every node."""
    p, q = flight.p, flight.q
    v = np.hypot(p, q)
    k = LAMBDA / MASSE
    power = LAMBDA * v**3
    change = 3 * LAMBDA * v * (-k * v**3 - G * q)  # of the power, as v dv/dt = -k v^3 - g q
    # The trapezoidal rule with its correction by the slopes at the ends: error dt^4.
    dt = flight.t[1] - flight.t[0]
    pieces = dt / 2 * (power[1:] + power[:-1]) - dt * dt / 12 * np.diff(change)
    work = np.concatenate([[0.0], np.cumsum(pieces)])
    energy = MASSE * (v * v / 2 + G * flight.y)
    return np.asarray(energy + work - energy[0])


def _fallen(method: str, fall: Launch, v_lim: float) -> Iterator[float]:
    for dt in FALL_STEPS:
        impact = steps(fall, method, dt).impact
        yield float(np.hypot(impact.p, impact.q) / v_lim - 1)


def _weak_drag() -> WeakDrag:
    flown = [steps(launch(np.pi / 4, drag, 2), "rk4", DT).impact.x for drag in LAMBDAS]
    exact = [launch(np.pi / 4, drag, 2).range() for drag in LAMBDAS]
    vacuum = V0**2 / G
    loss = (1 - np.array(flown) / vacuum) / LAMBDAS
    return WeakDrag(LAMBDAS, np.array(flown), np.array(exact), loss, _loss_limit())


def _loss_limit() -> float:
    """The part of the distance lost to drag per lambda, as lambda goes to 0, at 45 degrees."""
    sin = cos = np.sqrt(0.5)
    c1 = 3 / 4 * sin + cos**2 / (8 * sin)
    c1 += np.arctanh(sin) * cos**2 * (1 / 2 - cos**2 / (8 * sin**2))
    return float(c1 * V0**2 / (MASSE * G))  # c1 v_norm^2 / lambda


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
