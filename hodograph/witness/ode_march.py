"""A launch in scaled units, and its integration up to where a quantity changes sign.

Speeds are in V = min(v_lim, v0 + √(2 g height)), the fastest that a flight in still air keeps,
times in V/g and lengths in V²/g.  The state is (x, y, v_x, v_y, s), or (x, y, v, alpha, s) for
eq. 16; in a wind it goes on with (z, v_z, s through the air).  Drag acts along the velocity
through the air, v − W, and all else is told from the ground.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import optimize

Array = npt.NDArray[np.float64]
Integrator = Callable[..., Any]  # a solver class of SciPy, with its tolerances
MAX_STEPS = 200_000
_MAX_POLISH = 4
_NEAR, _STEADY = 1e-3, 1e-7  # accelerations at which a fall is nearly and wholly terminal, in g
_LOOKS = 16  # places in a step where a height that may rise again is looked at


@dataclass(frozen=True)
class Problem:
    """A launch in scaled units."""

    start: Array
    size: Array  # natural size of each component of the state
    drag: float
    n: float
    alpha0: float
    slope: float
    wind: float
    crosswind: float
    hodograph: bool
    speed: float
    g: float
    law: Callable[[float], float] | None = None  # drag over weight, from the speed in m/s

    def braking(self, v: float) -> float:
        """Drag over weight at a scaled speed."""
        if self.law is None:
            return float(self.drag * v**self.n)
        value = float(self.law(v * self.speed))
        if not value >= 0 and not math.isnan(v):  # the integrator would reject steps for ever
            raise ValueError(
                f"drag must be >= 0 at every speed, got {value} at {v * self.speed:.6g} m/s"
            )
        return value

    @property
    def windy(self) -> bool:
        """Whether the air moves."""
        return self.wind != 0 or self.crosswind != 0

    @property
    def blown_off(self) -> bool:
        """Whether wind may lift the path off a slope again: height e has e'' = −1 − k W tan β."""
        return self.drag * self.wind * self.slope < 0

    def rates(self, _t: float, state: Array) -> Array:
        """The derivative of the state with respect to time."""
        _, _, a, b, *_ = state
        if self.hodograph:  # eq. 16
            v, sin, cos = a, np.sin(b), np.cos(b)
            return np.array([v * cos, v * sin, -sin - self.braking(v), -cos / v, v])
        if not self.windy:
            v = np.hypot(a, b)
            k = self.braking(v) / v if v > 0 else 0.0
            return np.array([a, b, -k * a, -1 - k * b, v])
        c = state[6]
        through_x, through_z = a - self.wind, c - self.crosswind
        v = math.hypot(through_x, b, through_z)
        k = self.braking(v) / v if v > 0 else 0.0
        over = math.hypot(a, b, c)
        return np.array([a, b, -k * through_x, -1 - k * b, over, c, -k * through_z, v])

    def adrift(self, t: float, state: Array, weights: Array) -> bool:
        """Whether the climb over the ground keeps its sign for good, and so the height its trend.

        Near the terminal velocity the velocity can still change by no more than the acceleration
        times the time that the fall takes to settle: too little to turn the climb.
        """
        rates = self.rates(t, state)
        left, climb = float(np.hypot(*rates[2:4])), self.above()[0] @ rates
        settled = left < _STEADY or 2 * left * self.drag ** (-1 / self.n) < abs(climb)
        return bool(left < _NEAR and settled and (climb >= 0 or weights[2:4].any()))

    def above(self) -> tuple[Array, float]:
        """The height over the ground, square to it: weights of the state, and what is taken off."""
        weights = np.zeros_like(self.start)
        weights[:2] = -math.sin(self.slope), math.cos(self.slope)
        return weights, 0.0

    def climb(self, slope: float) -> tuple[Array, float]:
        """The same for a quantity that has the sign of the climb over ground of this slope."""
        weights = np.zeros_like(self.start)
        if self.hodograph:
            weights[3] = 1.0
            return weights, slope
        weights[2:4] = -math.sin(slope), math.cos(slope)
        return weights, 0.0

    def motion(self, states: Array) -> Array:
        """x, y, z, v_x, v_y, v_z, s, s through the air in SI units, from states in columns."""
        x, y, vx, vy, s = states[:5]
        if self.hodograph:
            vx, vy = vx * np.cos(vy), vx * np.sin(vy)
        z, vz, air = states[5:] if self.windy else (0 * x, 0 * x, s)
        length = self.speed**2 / self.g
        lengths = np.array([x, y, z]) * length, np.array([s, air]) * length
        return np.vstack([lengths[0], np.array([vx, vy, vz]) * self.speed, lengths[1]])


def problem(
    v0: float,
    alpha0: float,
    v_lim: float,
    g: float,
    height: float,
    n: float,
    *,
    slope: float = 0.0,
    wind: float = 0.0,
    crosswind: float = 0.0,
    hodograph: bool = False,
    law: Callable[[float], float] | None = None,
) -> Problem:
    """Choose the units and the natural sizes of the state."""
    speed = min(v_lim, v0 + math.sqrt(2 * g * max(height, 0.0))) or 1.0
    length = speed**2 / g
    if not (0 < length < math.inf and 0 < speed / g < math.inf):
        raise ValueError(f"v0, v_lim and g are out of scale, got {v0}, {v_lim} and {g}")
    u, y, w, c = v0 / speed, height / length, wind / speed, crosswind / speed
    sin, cos = math.sin(alpha0), math.cos(alpha0)
    # Sideways and upward speeds; the second is also the size of the time.
    a = max(min(1.0, u * cos) + abs(w), 1e-100)
    lift = abs(w * math.sin(slope))
    b = max(min(1.0, u * abs(sin) + math.sqrt(2 * max(y, 0.0)) + lift), 1e-100)
    size = [a * b, b * b, a, b / max(a, b) if hodograph else b, (a + b) * b]
    start = [0.0, y, *((u, alpha0) if hodograph else (u * cos, u * sin)), 0.0]
    if wind or crosswind:
        across = max(abs(c), 1e-100)
        size += [across * b, across, (a + b + across) * b]
        start += [0.0, 0.0, 0.0]
    return Problem(
        start=np.array(start),
        size=np.array(size),
        drag=(speed / v_lim) ** n,
        n=n,
        alpha0=alpha0,
        slope=slope,
        wind=w,
        crosswind=c,
        hodograph=hodograph,
        law=law,
        speed=speed,
        g=g,
    )


@dataclass(frozen=True)
class Leg:
    """Nodes and interpolants up to a crossing; `reached` tells whether it was found."""

    times: list[float]
    states: list[Array]
    pieces: list[Any]
    nfev: int
    reached: bool
    adrift: bool = False  # falling steadily, and never nearer to the crossing


def march(
    p: Problem, integrator: Integrator, t: float, state: Array, quantity: tuple[Array, float]
) -> Leg:
    """Step until the quantity is negative, then polish its zero."""
    weights, offset = quantity

    def value(state: Array) -> Any:
        return weights @ state - offset

    times, states = [t], [state]
    pieces: list[Any] = []
    if value(state) < 0 or (value(state) == 0 and weights @ p.rates(t, state) <= 0):
        return Leg(times, states, pieces, 0, True)
    solver = integrator(p.rates, t, state, math.inf)
    end = math.nan
    while math.isnan(end):
        solver.step()
        lost = solver.status == "failed" or not np.all(np.isfinite(solver.y))
        stalled = p.hodograph and solver.y[2] <= 0  # eq. 16 has left its domain
        if lost or stalled or len(pieces) == MAX_STEPS:
            return Leg(times, states, pieces, solver.nfev, False)
        times.append(float(solver.t))
        states.append(solver.y.copy())
        pieces.append(solver.dense_output())
        if value(solver.y) <= 0:
            end = times[-1]
        elif p.blown_off:
            end = _dip(lambda u: value(pieces[-1](u)), times[-2], times[-1])
            if math.isnan(end) and p.adrift(times[-1], solver.y, weights):
                return Leg(times, states, pieces, solver.nfev, False, adrift=True)

    def interpolant(u: float) -> float:
        return float(value(pieces[-1](u)))

    t0, t = times[-2], end
    if interpolant(t0) > 0 > interpolant(t):
        t = optimize.brentq(interpolant, t0, t)
    state, nfev = _advance(p, integrator, t0, states[-2], t)
    for _ in range(_MAX_POLISH):
        correction = value(state) / (weights @ p.rates(t, state))
        if not abs(correction) > 4 * math.ulp(t):
            break
        t = max(float(t - correction), t0)
        state, calls = _advance(p, integrator, t0, states[-2], t)
        nfev += calls
    times[-1], states[-1] = t, state
    return Leg(times, states, pieces, solver.nfev + nfev, bool(np.all(np.isfinite(state))))


def _dip(value: Callable[[Any], Any], t0: float, t: float) -> float:
    """A time within a step at which the quantity is negative; NaN where there is none."""
    looks = np.linspace(t0, t, _LOOKS)
    least = int(np.argmin(value(looks)))
    around = looks[max(least - 1, 0)], looks[min(least + 1, _LOOKS - 1)]
    found = optimize.minimize_scalar(value, bounds=around, method="bounded")
    for u in (looks[least], found.x):
        if value(u) < 0:
            return float(u)
    return math.nan


def _advance(
    p: Problem, integrator: Integrator, t0: float, state: Array, t: float
) -> tuple[Array, int]:
    """Integrate from a node to the time `t`; NaN where that fails."""
    if t <= t0:
        return state, 0
    solver = integrator(p.rates, t0, state, t, first_step=t - t0)
    while solver.status == "running":
        solver.step()
    end = solver.y if solver.status == "finished" else np.full_like(state, np.nan)
    return end, solver.nfev


def to_ground(p: Problem, integrator: Integrator) -> tuple[list[Leg], bool]:
    """The legs from the launch to the ground, met from above; and whether that is out of reach.

    The height over the ground grows as long as the path climbs more than the ground does, and
    from that top on it falls, so that no step can cross the ground twice unseen.  Only a wind
    may turn a fall into a climb again.
    """
    legs: list[Leg] = []
    t, state = 0.0, p.start
    (over, _), climb = p.above(), p.climb(p.slope)
    while True:
        legs.append(march(p, integrator, t, state, climb))
        if not legs[-1].reached:
            return legs, legs[-1].adrift
        t, state = legs[-1].times[-1], legs[-1].states[-1]
        if over @ state >= 0:
            legs.append(march(p, integrator, t, state, p.above()))
            return legs, legs[-1].adrift
        if not p.blown_off:
            return legs, True
        legs.append(march(p, integrator, t, state, (-climb[0], -climb[1])))
        if not legs[-1].reached or not legs[-1].pieces:
            return legs, True
        t, state = legs[-1].times[-1], legs[-1].states[-1]
