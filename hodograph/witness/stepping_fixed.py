"""Fixed steps: explicit one-step methods as data, and the law of motion that they advance.

Drag and weight depend on the velocity alone.  A step therefore has stages of velocity only, and
the position is carried by those same velocities: see `Method`.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from hodograph.witness.stepping_inputs import Array

Law = Callable[[Array], Array]  # acceleration (2, m) of velocities (2, m)
X, Y = 2, 3  # rows of a state: p, q, x, y


@dataclass(frozen=True)
class Method:
    """An explicit one-step method, as data.

    Attributes
    ----------
    order
        Its order: the error at a given time falls as ``dt ** order``.
    stages
        The rows of Butcher's tableau below its diagonal: the velocity of stage j is that of the
        node, plus dt times these multiples of the accelerations at the stages before it.
    weights
        The new velocity is the old, plus dt times these multiples of the stages' accelerations.
    carry
        The new position is the old, plus dt times these multiples of the stages' velocities and,
        last, of the new velocity.  A Runge-Kutta method has its `weights` here and then 0.
    reach
        Drag that decays a disturbance at the rate r is followed stably while r dt <= reach.
    """

    order: int
    stages: tuple[tuple[float, ...], ...]
    weights: tuple[float, ...]
    carry: tuple[float, ...]
    reach: float


FIXED = {
    # Euler; (6) of the exercise.
    "euler": Method(1, ((),), (1.0,), (1.0, 0.0), 2.0),
    # Euler-Cromer; (7): the position moves with the new velocity.
    "euler_cromer": Method(1, ((),), (1.0,), (0.0, 1.0), 2.0),
    # The midpoint method; (9) and (17).
    "rk2": Method(2, ((), (1 / 2,)), (0.0, 1.0), (0.0, 1.0, 0.0), 2.0),
    # The classical method of order 4; (20) and (21).
    "rk4": Method(
        4,
        ((), (1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0)),
        (1 / 6, 1 / 3, 1 / 3, 1 / 6),
        (1 / 6, 1 / 3, 1 / 3, 1 / 6, 0.0),
        2.7852935634052822,
    ),
}


class Counted:
    """A law that counts its evaluations."""

    def __init__(self, law: Law) -> None:
        self.law, self.calls = law, 0

    def __call__(self, velocity: Array) -> Array:
        """The acceleration."""
        self.calls += 1
        return self.law(velocity)


def power_law(v_lim: Array, g: Array, n: float) -> Law:
    """f1 and f2 of the exercise, (5), for drag in vⁿ (eq. 8)."""
    rate = g / v_lim

    def law(velocity: Array) -> Array:
        if n == 1:
            force = velocity * -rate
        else:
            ratio = np.hypot(velocity[0], velocity[1]) / v_lim
            force = velocity * (-rate * (ratio if n == 2 else ratio ** (n - 1)))
        force[1] -= g
        return force

    return law


def fastest_stable(rate: float, v_lim: Array, g: Array, n: float) -> Array:
    """The speed at which drag decays disturbances along the path at `rate`."""
    ratio = rate / n * (v_lim / g)
    if n == 1:
        return np.where(ratio >= 1, np.inf, -1.0)
    return np.asarray(v_lim * ratio ** (1 / (n - 1)))


def by_steps(method: Method, law: Law, dt: float, state: Array) -> Iterator[Array]:
    """The nodes after `state`, without end."""
    while True:
        velocity, position = state[:2], state[2:]
        speeds: list[Array] = []
        pushes: list[Array] = []
        for row in method.stages:
            speeds.append(_moved(velocity, dt, row, pushes))
            pushes.append(law(speeds[-1]))
        speeds.append(_moved(velocity, dt, method.weights, pushes))
        state = np.concatenate([speeds[-1], _moved(position, dt, method.carry, speeds)])
        yield state


def _moved(start: Array, dt: float, weights: tuple[float, ...], rates: list[Array]) -> Array:
    for weight, rate in zip(weights, rates, strict=True):
        if weight:
            start = start + (weight * dt) * rate
    return start
