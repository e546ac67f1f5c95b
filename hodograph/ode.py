"""The equations of motion integrated in time by SciPy: one independent path to the truth.

Any power law R = λvⁿ, that is a deceleration of g (v/v_lim)ⁿ, or any law R(v) that the caller
gives. Everything outside is SI.
Inside, speeds are in V = min(v_lim, v0 + √(2 g height)), the fastest that a flight keeps,
times in V/g and lengths in V²/g.

Landing is found without an event on y from the launch: y starts at its own zero, and may
cross zero twice within one step. The flight is marched to the apex, where v_y (or α) changes
sign once, and from there down to where y changes sign once. Newton then corrects the time of
either crossing, integrating afresh from the last node before it, so that its accuracy is that
of the integrator and not of the interpolant.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from numbers import Real
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import integrate, optimize

__all__ = ["Apex", "Solution", "solve"]

_LANDED, _UNREACHABLE, _NOT_CONVERGED = 0, 1, 2

_Array = npt.NDArray[np.float64]
_Rates = Callable[[float, _Array], _Array]
_Drag = Callable[[float], float]
_Integrator = Callable[..., Any]  # a solver class of SciPy, with its tolerances

_METHODS = {
    "RK23": integrate.RK23,
    "RK45": integrate.RK45,
    "DOP853": integrate.DOP853,
    "Radau": integrate.Radau,
    "BDF": integrate.BDF,
    "LSODA": integrate.LSODA,
}
_FORMS = ("cartesian", "hodograph")
_MIN_RTOL = 2.3e-14  # SciPy warns below 100 ulp and uses that instead
_TURN = 1e-6  # least angle from the vertical at which eq. 16 is trusted, in radians
_MAX_STEPS = 200_000
_MAX_POLISH = 4


@dataclass(frozen=True)
class Apex:
    """The highest point, `y` above the landing plane; the launch if that is not upward."""

    x: float
    y: float
    t: float


@dataclass(frozen=True, eq=False)
class Solution:
    """A flight in SI units, its landing NaN unless `status` is 0.

    `status` is 0 (landed), 1 (unreachable: the landing plane is above the apex) or
    2 (not converged: the integrator gave up). `nodes` has the rows t, x, y, v_x, v_y from
    the launch through the apex to the landing, or to where the integration ended.
    """

    x: float
    t: float
    speed: float
    alpha: float
    arc_length: float
    apex: Apex
    status: int
    nfev: int
    nodes: _Array = field(repr=False)
    _dense: Callable[[_Array], _Array] = field(repr=False)

    @property
    def success(self) -> bool:
        """Whether the flight landed."""
        return self.status == _LANDED

    def at(self, t: npt.ArrayLike) -> tuple[_Array, _Array, _Array, _Array]:
        """x, y, v_x and v_y by dense output at the times `t`, from 0 to the last node."""
        times = np.asarray(t, dtype=float)
        last = self.nodes[0, -1]
        if not np.all((times >= 0) & (times <= last)):
            raise ValueError(f"t must be within the flight, in [0, {last:.17g}] s")
        x, y, vx, vy = self._dense(times)
        return x, y, vx, vy


def solve(
    v0: float,
    alpha0: float,
    v_lim: float,
    *,
    g: float = 9.81,
    height: float = 0.0,
    n: float = 2.0,
    drag: _Drag | None = None,
    method: str = "DOP853",
    rtol: float = 1e-10,
    atol: float = 1e-13,
    form: str = "cartesian",
) -> Solution:
    """Fly one launch by integration in time.

    Parameters
    ----------
    v0, alpha0, v_lim : float
        Launch speed, launch slope in radians in (-pi/2, pi/2], limiting speed; ``inf``
        for `v_lim` is a vacuum.
    g, height, n : float
        Gravity, launch height above the landing plane (y starts at `height` and lands at 0
        on the way down; negative for a target above the muzzle), drag exponent.
    drag : callable, optional
        The drag R(v) over the weight, a pure number, from the speed in m/s: any law in place
        of (v/v_lim)^n. `n` then stays at 2, and `v_lim` only sets the units of the integration:
        give the terminal speed, or ``inf``.
    method : str
        A solver class of ``scipy.integrate``.
    rtol, atol : float
        Tolerances of one step. `atol` is relative to the natural size of each component of
        the state in this flight, so that it means the same however flat or steep the launch.
    form : {"cartesian", "hodograph"}
        Integrate (x, y, v_x, v_y), or eq. 16 literally in (x, y, v, alpha); the arc length
        goes with either. Eq. 16 is singular at v = 0: at a launch from rest, and at the
        apex of a vertical launch. It is refused there and within 1e-6 rad of the vertical;
        a steep launch multiplies its tolerance by up to 1/cos(alpha0).

    Returns
    -------
    Solution
        A launch that is level or downward from height 0 lands where it starts.

    Raises
    ------
    TypeError, ValueError
        For an argument of the wrong type, or out of its range.

    Examples
    --------
    >>> flight = solve(50.0, 0.7, 42.7)
    >>> print(f"{flight.x:.6f} m in {flight.t:.6f} s")
    133.552390 m in 5.410978 s

    Didion's law, a cubic term beside the square:

    >>> flight = solve(50.0, 0.7, 42.7, drag=lambda v: (v / 42.7) ** 2 * (1 + v / 435.0))
    >>> print(f"{flight.x:.3f} m")
    129.129 m
    """
    v0 = _real("v0", v0, "finite and >= 0", lambda v: 0 <= v < math.inf)
    alpha0 = _real("alpha0", alpha0, "in (-pi/2, pi/2]", lambda a: -math.pi / 2 < a <= math.pi / 2)
    v_lim = _real("v_lim", v_lim, "> 0", lambda v: v > 0)
    g = _real("g", g, "finite and > 0", lambda v: 0 < v < math.inf)
    height = _real("height", height, "finite", math.isfinite)
    n = _real("n", n, "finite and > 0", lambda v: 0 < v < math.inf)
    rtol = _real("rtol", rtol, f"in [{_MIN_RTOL}, 1)", lambda v: _MIN_RTOL <= v < 1)
    atol = _real("atol", atol, "finite and > 0", lambda v: 0 < v < math.inf)
    for name, value, known in (("method", method, _METHODS), ("form", form, _FORMS)):
        if value not in known:
            raise ValueError(f"{name} must be one of {', '.join(known)}, got {value!r}")
    if form == "hodograph":
        limit = math.pi / 2 - _TURN
        _real("v0", v0, "> 0 for form='hodograph'", lambda v: v > 0)
        _real(
            "alpha0",
            alpha0,
            f"in [-{limit}, {limit}] for form='hodograph'",
            lambda a: abs(a) <= limit,
        )
    if drag is not None:
        if not callable(drag):
            raise TypeError(f"drag must be a function of the speed, got {type(drag).__name__}")
        if n != 2:
            raise ValueError(f"n must be left at 2 where drag is given, got {n}")
    problem = _problem(v0, alpha0, v_lim, g, height, n, drag, form)
    integrator = partial(_METHODS[method], rtol=rtol, atol=atol * problem.size)
    with np.errstate(all="ignore"):  # a trial step may overflow, and is then rejected
        return _fly(problem, integrator)


@dataclass(frozen=True)
class _Problem:
    """A launch in scaled units. The state is (x, y, v_x, v_y, s) or (x, y, v, alpha, s)."""

    start: _Array
    size: _Array  # natural size of each component of the state
    drag: _Drag  # over the weight, from the scaled speed
    alpha0: float
    hodograph: bool
    speed: float
    g: float

    def rates(self, _t: float, state: _Array) -> _Array:
        _, _, a, b, _ = state
        if self.hodograph:  # eq. 16
            v, sin, cos = a, np.sin(b), np.cos(b)
            return np.array([v * cos, v * sin, -sin - self.drag(v), -cos / v, v])
        v = np.hypot(a, b)
        k = self.drag(v) / v if v > 0 else 0.0
        return np.array([a, b, -k * a, -1 - k * b, v])

    def motion(self, states: _Array) -> _Array:
        """x, y, v_x and v_y in SI units, from states in columns."""
        x, y, vx, vy = states[:4]
        if self.hodograph:
            vx, vy = vx * np.cos(vy), vx * np.sin(vy)
        length = self.speed**2 / self.g
        return np.array([x * length, y * length, vx * self.speed, vy * self.speed])


@dataclass(frozen=True)
class _Leg:
    """Nodes and interpolants up to a crossing; `reached` tells whether it was found."""

    times: list[float]
    states: list[_Array]
    pieces: list[Any]
    nfev: int
    reached: bool


_HEIGHT, _SLOPE = 1, 3  # components of the state that end the fall and the rise


def _march(p: _Problem, integrator: _Integrator, t: float, state: _Array, component: int) -> _Leg:
    """Step while `component` is positive: once negative it stays so. Then polish its zero."""
    times, states = [t], [state]
    pieces: list[Any] = []
    if state[component] <= 0:
        return _Leg(times, states, pieces, 0, True)
    solver = integrator(p.rates, t, state, math.inf)
    while states[-1][component] > 0:
        solver.step()
        lost = solver.status == "failed" or not np.all(np.isfinite(solver.y))
        stalled = p.hodograph and solver.y[2] <= 0  # eq. 16 has left its domain
        if lost or stalled or len(pieces) == _MAX_STEPS:
            return _Leg(times, states, pieces, solver.nfev, False)
        times.append(float(solver.t))
        states.append(solver.y.copy())
        pieces.append(solver.dense_output())

    def interpolant(u: float) -> float:
        return float(pieces[-1](u)[component])

    t0, t = times[-2:]
    if interpolant(t0) > 0 > interpolant(t):
        t = optimize.brentq(interpolant, t0, t)
    state, nfev = _advance(integrator, p.rates, t0, states[-2], t)
    for _ in range(_MAX_POLISH):
        correction = state[component] / p.rates(t, state)[component]
        if not abs(correction) > 4 * math.ulp(t):
            break
        t = max(float(t - correction), t0)
        state, calls = _advance(integrator, p.rates, t0, states[-2], t)
        nfev += calls
    times[-1], states[-1] = t, state
    return _Leg(times, states, pieces, solver.nfev + nfev, bool(np.all(np.isfinite(state))))


def _advance(
    integrator: _Integrator, rates: _Rates, t0: float, state: _Array, t: float
) -> tuple[_Array, int]:
    """Integrate from a node to the time `t`; NaN where that fails."""
    if t <= t0:
        return state, 0
    solver = integrator(rates, t0, state, t, first_step=t - t0)
    while solver.status == "running":
        solver.step()
    end = solver.y if solver.status == "finished" else np.full_like(state, np.nan)
    return end, solver.nfev


def _fly(p: _Problem, integrator: _Integrator) -> Solution:
    time, length = p.speed / p.g, p.speed**2 / p.g
    rise = _march(p, integrator, 0.0, p.start, _SLOPE)
    legs, apex = [rise], rise.states[-1]
    status = _NOT_CONVERGED
    if rise.reached and apex[_HEIGHT] < 0:
        status = _UNREACHABLE
    elif rise.reached:
        legs.append(_march(p, integrator, rise.times[-1], apex, _HEIGHT))
        status = _LANDED if legs[-1].reached else _NOT_CONVERGED

    times = np.array([t for leg in legs for t in leg.times[leg is not rise :]])
    states = np.array([s for leg in legs for s in leg.states[leg is not rise :]]).T
    pieces = [piece for leg in legs for piece in leg.pieces]
    motion = p.motion(states)

    def dense(t: _Array) -> _Array:
        if not pieces:
            return np.broadcast_to(motion[:, :1].reshape(4, *[1] * t.ndim), (4, *t.shape)).copy()
        scaled = np.ravel(t) / time
        index = np.clip(np.searchsorted(times, scaled, "right") - 1, 0, len(pieces) - 1)
        found = np.empty((len(p.start), scaled.size))
        for i in np.unique(index):
            found[:, index == i] = pieces[i](scaled[index == i])
        return p.motion(found).reshape(4, *t.shape)

    end = dict.fromkeys(("x", "t", "speed", "alpha", "arc_length"), math.nan)
    if status == _LANDED:
        x, _, vx, vy = (float(q) for q in motion[:, -1])
        alpha = math.atan2(vy, vx) if pieces else p.alpha0
        s = float(states[4, -1]) * length
        end = {"x": x, "t": float(times[-1]) * time, "speed": math.hypot(vx, vy)}
        end |= {"alpha": alpha, "arc_length": s}
    highest = Apex(math.nan, math.nan, math.nan)
    if rise.reached:
        x, y = (float(q) for q in motion[:2, len(rise.times) - 1])
        highest = Apex(x, y, rise.times[-1] * time)
    return Solution(
        **end,
        apex=highest,
        status=status,
        nfev=sum(leg.nfev for leg in legs),
        nodes=np.vstack([times * time, motion]),
        _dense=dense,
    )


def _problem(
    v0: float,
    alpha0: float,
    v_lim: float,
    g: float,
    height: float,
    n: float,
    law: _Drag | None,
    form: str,
) -> _Problem:
    """Choose the units and the natural sizes of the state."""
    speed = min(v_lim, v0 + math.sqrt(2 * g * max(height, 0.0))) or 1.0
    length = speed**2 / g
    if not (0 < length < math.inf and 0 < speed / g < math.inf):
        raise ValueError(f"v0, v_lim and g are out of scale, got {v0}, {v_lim} and {g}")
    u, y = v0 / speed, height / length
    sin, cos = math.sin(alpha0), math.cos(alpha0)
    hodograph = form == "hodograph"
    # Sideways and upward speeds; the second is also the size of the time.
    a = max(min(1.0, u * cos), 1e-100)
    b = max(min(1.0, u * abs(sin) + math.sqrt(2 * max(y, 0.0))), 1e-100)
    size = [a * b, b * b, a, b / max(a, b) if hodograph else b, (a + b) * b]
    motion = (u, alpha0) if hodograph else (u * cos, u * sin)
    factor = (speed / v_lim) ** n

    def drag(v: float) -> float:
        if law is None:
            return float(factor * v**n)
        value = float(law(v * speed))
        if not value >= 0 and not math.isnan(v):  # the integrator would try for ever
            raise ValueError(
                f"drag must be >= 0 at every speed, got {value} at {v * speed:.6g} m/s"
            )
        return value

    return _Problem(
        start=np.array([0.0, y, *motion, 0.0]),
        size=np.array(size),
        drag=drag,
        alpha0=alpha0,
        hodograph=hodograph,
        speed=speed,
        g=g,
    )


def _real(name: str, value: object, allowed: str, legal: Callable[[float], bool]) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} must be a real number, got {type(value).__name__}")
    number = float(value)
    if not legal(number):
        raise ValueError(f"{name} must be {allowed}, got {number}")
    return number
