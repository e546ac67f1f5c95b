"""Section 6.8 of the exercise: quadratic drag, and how to test where no solution is known."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.exercise.scene import (
    DEGREES,
    DT,
    ETA,
    LAMBDA,
    MASSE,
    V0,
    Convergence,
    G,
    convergence,
    launch,
    slope,
    steps,
)
from hodograph.launch import Launch, Trajectory
from hodograph.steppers import FIXED, Flights

ORDER_STEPS = np.array([0.02 / 2**i for i in range(6)])  # s
BALANCE_STEPS = ORDER_STEPS[:5]
BALANCE_DT = 0.01  # s
FALL, FALL_STEPS = 100.0, (0.1, 0.01)  # m, s
LAMBDAS = np.array([10.0**-i for i in range(1, 9)])  # kg/m


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
    scene = launch(np.pi / 4, LAMBDAS, 2)
    flown = steps(scene, "rk4", DT).impact.x
    loss = (1 - flown / (V0**2 / G)) / LAMBDAS
    return WeakDrag(LAMBDAS, flown, scene.range(), loss, _loss_limit())


def _loss_limit() -> float:
    """The part of the distance lost to drag per lambda, as lambda goes to 0, at 45 degrees."""
    return float(laws.first_order(np.pi / 4) * V0**2 / (MASSE * G))  # c1 v_norm^2 / lambda
