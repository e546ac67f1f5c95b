"""Node after node until the ground, and the impact between the last two."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hodograph.witness.stepping_fixed import Law, Y
from hodograph.witness.stepping_inputs import Array

LANDED, ALOFT, UNSTABLE, INVALID = range(4)


@dataclass(frozen=True, eq=False)
class Walk:
    """The end of each flight: the nodes before and after the ground, and all of them."""

    status: npt.NDArray[np.intp]
    steps: npt.NDArray[np.intp]
    before: Array
    after: Array
    states: list[Array] | None


def follow(nodes: Iterator[Array], start: Array, fastest: Array, most: int, history: bool) -> Walk:
    """Follow the nodes until every flight is below the ground, or lost, or time is up."""
    before, after = start.copy(), start.copy()
    status = np.full(fastest.shape, ALOFT)
    steps = np.zeros(fastest.shape, dtype=np.intp)
    states = [start]
    state = start
    limit = fastest * fastest
    flying = np.hypot(start[0], start[1]) <= fastest
    status[~flying] = UNSTABLE
    count = 0
    while flying.any() and count < most:
        previous = state
        try:
            state = next(nodes)
        except StopIteration:
            status[flying] = UNSTABLE
            break
        count += 1
        if history:
            states.append(state)
        sound = state[0] * state[0] + state[1] * state[1] <= limit
        ended = flying & ~(sound & (state[Y] >= 0))
        if ended.any():  # the ground comes first: the step to it was from a sound speed
            landed = ended & ~(state[Y] >= 0) & np.isfinite(state).all(axis=0)
            status[ended], steps[ended] = np.where(landed, LANDED, UNSTABLE)[ended], count
            before[:, landed], after[:, landed] = previous[:, landed], state[:, landed]
            flying &= ~ended
    steps[flying] = count
    return Walk(status, steps, before, after, states if history else None)


def on_line(walk: Walk, law: Law, dt: float) -> Array:
    """t, x, y, p, q where the straight line between the last nodes meets the ground."""
    before, after = walk.before, walk.after
    part = before[Y] / (before[Y] - after[Y])
    p, q, x, _ = before + part * (after - before)
    return np.stack([(walk.steps - 1 + part) * dt, x, 0 * x, p, q])


def on_hermite(walk: Walk, law: Law, dt: float) -> Array:
    """The same for the polynomials of degree 5 that have both nodes' position and two rates."""
    ends = []
    for state in (walk.before, walk.after):
        ends.append((state[2:], dt * state[:2], dt * (dt * law(state[:2]))))
    (r0, v0, a0), (r1, v1, a1) = ends
    d0 = r1 - (r0 + v0 + a0 / 2)
    d1 = v1 - (v0 + a0)
    d2 = a1 - a0
    powers = np.stack(
        [
            r0,
            v0,
            a0 / 2,
            10 * d0 - 4 * d1 + d2 / 2,
            -15 * d0 + 7 * d1 - d2,
            6 * d0 - 3 * d1 + d2 / 2,
        ]
    )
    low, high = np.zeros(r0.shape[1]), np.ones(r0.shape[1])
    for _ in range(60):  # y(low) >= 0 > y(high) throughout
        middle = (low + high) / 2
        above = np.polynomial.polynomial.polyval(middle, powers[:, 1], tensor=False) >= 0
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    x = np.polynomial.polynomial.polyval(low, powers[:, 0], tensor=False)
    slopes = powers[1:] * np.arange(1, 6)[:, np.newaxis, np.newaxis] / dt
    p, q = np.polynomial.polynomial.polyval(low, slopes, tensor=False)
    return np.stack([(walk.steps - 1 + low) * dt, x, 0 * x, p, q])
