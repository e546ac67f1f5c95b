"""Section 6.8 of the exercise: quadratic drag, and how to test where no solution is known."""

import logging
from typing import NamedTuple

import numpy as np

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.exercise.convergence import Convergence, convergence, slope
from hodograph.exercise.setup import Setup, steps
from hodograph.launch import Launch, Trajectory
from hodograph.steppers import FIXED, Flights

log = logging.getLogger("hodograph")


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
    dt: float  # s
    t: FloatArray
    residual: FloatArray  # in time, at dt
    steps: FloatArray  # s
    largest: FloatArray  # for each of `steps`
    order: float


class Fall(NamedTuple):
    """Falls from rest: the speed at the ground, relative to terminal speed, less 1."""

    height: float  # m
    dt: tuple[float, ...]  # s
    exact: float
    by_method: dict[str, tuple[float, ...]]  # for each dt


class WeakDrag(NamedTuple):
    """Distance as lambda goes to 0."""

    drag: FloatArray  # kg/m
    by_rk4: FloatArray  # m
    exact: FloatArray  # m
    loss: FloatArray  # 1 - x/x(0) by RK4, over lambda, m/kg
    loss_limit: float  # m/kg


class Quadratic(NamedTuple):
    """All of 6.8."""

    flights: dict[str, Flights]  # at theta and dt, by all four methods
    path: Trajectory  # the same, exact
    linear: Trajectory  # with eta, exact
    exact: float
    v_lim: float
    largest_steps: dict[str, float]  # s, that are stable at the launch
    loops: list[Convergence]
    orders: list[Order]
    balances: list[Balance]
    fall: Fall
    weak: WeakDrag


def quadratic(setup: Setup) -> Quadratic:
    """Fly with quadratic drag, and test every method where no solution in time is known."""
    scene = setup.launch(drag=setup.lambda_, n=2)
    fan = setup.fan(setup.lambda_, 2)
    exact = fan.range()
    loops = []
    for method in FIXED:
        log.info(f"6.8 delta until {setup.limit:g} m: {method}")
        loops.append(convergence(setup, method, fan, {"exact": exact}))
    log.info("6.8 order, energy, terminal speed, weak drag")
    sizes = _steps(setup)
    return Quadratic(
        flights={method: steps(scene, method, setup.dt, history=True) for method in FIXED},
        path=scene.trajectory(),
        linear=setup.launch(drag=setup.eta).trajectory(),
        exact=float(scene.range()),
        v_lim=float(scene.v_lim),
        largest_steps={name: method.reach / setup.rates[1] for name, method in FIXED.items()},
        loops=loops,
        orders=[_order(method, fan, exact, sizes) for method in FIXED],
        balances=[_balance(setup, method, scene, sizes[:5]) for method in FIXED],
        fall=_fall(setup, float(scene.v_lim)),
        weak=_weak_drag(setup),
    )


def _digits(number: float, digits: int) -> float:
    return float(f"{number:.{digits - 1}e}")


def _steps(setup: Setup) -> FloatArray:
    """Six steps, each half the one before: 0.02 s and less for the exercise's own drag.

    They follow the rate at which the drag acts at the launch, and the time of flight.
    """
    first = _digits(min(0.28 / setup.rates[1], setup.vacuum_time / 20), 2)
    return np.array([first / 2.0**halvings for halvings in range(6)])


def _order(method: str, fan: Launch, exact: FloatArray, sizes: FloatArray) -> Order:
    rows = []
    for dt in sizes:
        flights = steps(fan, method, dt)
        both = flights.impact_naive.x, flights.impact.x
        rows.append([np.mean(np.abs(x - exact)) for x in both])
    naive, interpolated = np.array(rows).T
    return Order(method, sizes, naive, interpolated)


def _balance(setup: Setup, method: str, scene: Launch, sizes: FloatArray) -> Balance:
    flights = [steps(scene, method, dt, history=True) for dt in sizes]
    residuals = [_residual(setup, flight) for flight in flights]
    largest = np.array([np.max(np.abs(residual)) for residual in residuals])
    at, t, residual = float(sizes[1]), flights[1].t, residuals[1]
    return Balance(method, at, t, residual, sizes, largest, slope(sizes, largest))


def _residual(setup: Setup, flight: Flights) -> FloatArray:
    """Energy plus work against drag, less the energy at the launch, at every node."""
    p, q = flight.p, flight.q
    v = np.hypot(p, q)
    k = setup.lambda_ / setup.mass
    power = setup.lambda_ * v**3
    # Its derivative in time, as v dv/dt = -k v^3 - g q.
    change = 3 * setup.lambda_ * v * (-k * v**3 - setup.g * q)
    # The trapezoidal rule with its correction by the slopes at the ends: error dt^4.
    dt = flight.t[1] - flight.t[0]
    pieces = dt / 2 * (power[1:] + power[:-1]) - dt * dt / 12 * np.diff(change)
    work = np.concatenate([[0.0], np.cumsum(pieces)])
    energy = setup.mass * (v * v / 2 + setup.g * flight.y)
    return np.asarray(energy + work - energy[0])


def _fall(setup: Setup, v_lim: float) -> Fall:
    """From rest down ten lengths m/lambda, after which the speed is v_lim to 1e-9."""
    height = 10 * setup.mass / setup.lambda_
    fall = Launch.from_drag(0.0, 0.0, setup.lambda_ / setup.mass, g=setup.g, height=height)
    sizes = tuple(_digits(part * v_lim / setup.g, 1) for part in (0.1, 0.01))

    def off(method: str, dt: float) -> float:
        impact = steps(fall, method, dt).impact
        return float(np.hypot(impact.p, impact.q) / v_lim - 1)

    return Fall(
        height,
        sizes,
        exact=float(fall.landing().speed / v_lim - 1),
        by_method={method: tuple(off(method, dt) for dt in sizes) for method in FIXED},
    )


def _weak_drag(setup: Setup) -> WeakDrag:
    drag = np.array([setup.lambda_ / 10.0**i for i in range(8)])
    scene = setup.launch(drag=drag, n=2)
    flown = steps(scene, "rk4", setup.dt).impact.x
    loss = (1 - flown / setup.vacuum_range) / drag
    # c1 v_norm² / lambda
    limit = float(laws.first_order(setup.theta) * setup.v0**2 / (setup.mass * setup.g))
    return WeakDrag(drag, flown, scene.range(), loss, limit)
