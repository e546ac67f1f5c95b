"""The equations of motion integrated in time by SciPy: one independent path to the truth.

Any power law R = λvⁿ: the drag deceleration is g (v/v_lim)ⁿ, along the velocity through the air.
Everything is in SI units, and all is told from the ground: a wind moves the air, not the origin.

Landing is found without an event on y from the launch: y starts at its own zero, and may
cross zero twice within one step. The flight is marched to its top over the ground, where the
climb over it changes sign once, and from there down to the ground. Newton then corrects the time
of either crossing, integrating afresh from the last node before it, so that its accuracy is that
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
from scipy import integrate

from hodograph.witness.ode_march import Array, Integrator, Problem, march, problem, to_ground

__all__ = ["Apex", "Solution", "State", "solve"]

_LANDED, _UNREACHABLE, _NOT_CONVERGED = 0, 1, 2
_METHODS = {
    name: getattr(integrate, name) for name in ("RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA")
}
_FORMS = ("cartesian", "hodograph")
_MIN_RTOL = 2.3e-14  # SciPy warns below 100 ulp and uses that instead
_RIGHT = math.pi / 2
_ROUNDING = float(np.spacing(np.float32(_RIGHT)))  # of the right angle in single precision
_TURN = 1e-6  # least angle from the vertical at which eq. 16 is trusted, in radians


@dataclass(frozen=True)
class Apex:
    """The highest point of the path, `y` as in `Solution`; the launch if that is not upward.

    Steep ground may cut the path short of it.
    """

    x: float
    y: float
    t: float
    z: float = 0.0


@dataclass(frozen=True)
class State:
    """The flight at some times, seen from the ground: place, velocity and length of path."""

    x: Array
    y: Array
    z: Array
    v_x: Array
    v_y: Array
    v_z: Array
    arc_length: Array
    air_length: Array

    @property
    def speed(self) -> Array:
        """The speed over the ground."""
        return np.hypot(np.hypot(self.v_x, self.v_z), self.v_y)

    @property
    def alpha(self) -> Array:
        """The elevation of the path over the ground, in [-pi/2, pi/2]."""
        return np.arctan2(self.v_y, np.hypot(self.v_x, self.v_z))


@dataclass(frozen=True, eq=False)
class Solution:
    """A flight in SI units, its landing NaN unless `status` is 0.

    `status` is 0 (landed), 1 (unreachable: the landing plane is above the apex, or falls away
    faster than the flight) or 2 (not converged: the integrator gave up).  `alpha` and
    `arc_length` belong to the path over the ground, `air_length` is its length through the air.
    `nodes` has the rows t, x, y, v_x, v_y from the launch through the apex to the landing, or to
    where the integration ended.
    """

    x: float
    z: float
    t: float
    speed: float
    alpha: float
    arc_length: float
    air_length: float
    apex: Apex
    status: int
    nfev: int
    nodes: Array = field(repr=False)
    _dense: Callable[[Array], Array] = field(repr=False)

    @property
    def success(self) -> bool:
        """Whether the flight landed."""
        return self.status == _LANDED

    def at(self, t: npt.ArrayLike) -> tuple[Array, Array, Array, Array]:
        """x, y, v_x and v_y by dense output at the times `t`, from 0 to the last node."""
        state = self.state(t)
        return state.x, state.y, state.v_x, state.v_y

    def state(self, t: npt.ArrayLike) -> State:
        """The whole state by dense output at the times `t`, from 0 to the last node."""
        times = np.asarray(t, dtype=float)
        last = self.nodes[0, -1]
        if not np.all((times >= 0) & (times <= last)):
            raise ValueError(f"t must be within the flight, in [0, {last:.17g}] s")
        return State(*self._dense(times))


def solve(
    v0: float,
    alpha0: float,
    v_lim: float,
    *,
    g: float = 9.81,
    height: float = 0.0,
    slope: float = 0.0,
    wind: float = 0.0,
    crosswind: float = 0.0,
    n: float = 2.0,
    drag: Callable[[float], float] | None = None,
    method: str = "DOP853",
    rtol: float = 1e-10,
    atol: float = 1e-13,
    form: str = "cartesian",
) -> Solution:
    """Fly one launch by integration in time.

    Parameters
    ----------
    v0, alpha0, v_lim : float
        Launch speed, launch slope in radians in [-pi/2, pi/2], limiting speed; ``inf``
        for `v_lim` is a vacuum.
    g, height, n : float
        Gravity, launch height above the landing plane at x = 0 (y starts at `height`, and level
        ground is at 0; negative for a target above the muzzle), drag exponent.
    slope : float
        Angle of the ground in radians, in (-pi/2, pi/2): it is met from above, climbing or
        falling, where y = x tan(slope).
    wind, crosswind : float
        Speed of the air along x and along z; the launch is told from the ground.
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
        a steep launch multiplies its tolerance by up to 1/cos(alpha0). It knows no wind.

    Returns
    -------
    Solution
        A launch from height 0 that climbs no more than the ground lands where it starts.

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
    alpha0 = _real("alpha0", alpha0, "in [-pi/2, pi/2]", lambda a: abs(a) <= _RIGHT + _ROUNDING)
    alpha0 = min(max(alpha0, -_RIGHT), _RIGHT)
    v_lim = _real("v_lim", v_lim, "> 0", lambda v: v > 0)
    g = _real("g", g, "finite and > 0", lambda v: 0 < v < math.inf)
    height = _real("height", height, "finite", math.isfinite)
    for name, air in (("wind", wind), ("crosswind", crosswind)):
        _real(name, air, "finite", math.isfinite)
    level = "in (-pi/2, pi/2)"
    slope = _real("slope", slope, level, lambda a: abs(a) < math.pi / 2)
    n = _real("n", n, "finite and > 0", lambda v: 0 < v < math.inf)
    rtol = _real("rtol", rtol, f"in [{_MIN_RTOL}, 1)", lambda v: _MIN_RTOL <= v < 1)
    atol = _real("atol", atol, "finite and > 0", lambda v: 0 < v < math.inf)
    for name, value, known in (("method", method, _METHODS), ("form", form, _FORMS)):
        if value not in known:
            raise ValueError(f"{name} must be one of {', '.join(known)}, got {value!r}")
    if form == "hodograph":
        limit, only = math.pi / 2 - _TURN, "for form='hodograph'"
        _real("v0", v0, f"> 0 {only}", lambda v: v > 0)
        _real("alpha0", alpha0, f"in [-{limit}, {limit}] {only}", lambda a: abs(a) <= limit)
        _real("wind", wind, f"0 {only}", lambda v: v == 0)
        _real("crosswind", crosswind, f"0 {only}", lambda v: v == 0)
    if drag is not None:
        if not callable(drag):
            raise TypeError(f"drag must be a function of the speed, got {type(drag).__name__}")
        if n != 2:
            raise ValueError(f"n must be left at 2 where drag is given, got {n}")
    ground = {"slope": slope, "wind": float(wind), "crosswind": float(crosswind)}
    eq_16 = form == "hodograph"
    p = problem(v0, alpha0, v_lim, g, height, n, **ground, hodograph=eq_16, law=drag)
    integrator = partial(_METHODS[method], rtol=rtol, atol=atol * p.size)
    with np.errstate(all="ignore"):  # a trial step may overflow, and is then rejected
        return _fly(p, integrator)


def _fly(p: Problem, integrator: Integrator) -> Solution:
    time = p.speed / p.g
    legs, beyond = to_ground(p, integrator)
    rise = legs[0]  # to the apex, where the ground is level
    nfev = sum(leg.nfev for leg in legs)
    if p.slope:
        rise = march(p, integrator, 0.0, p.start, p.climb(0.0))
        nfev += rise.nfev
    status = _UNREACHABLE if beyond else _LANDED if legs[-1].reached else _NOT_CONVERGED

    times = np.array([t for leg in legs for t in leg.times[leg is not legs[0] :]])
    states = np.array([s for leg in legs for s in leg.states[leg is not legs[0] :]]).T
    pieces = [piece for leg in legs for piece in leg.pieces]
    motion = p.motion(states)

    names = ("x", "z", "t", "speed", "alpha", "arc_length", "air_length")
    end = dict.fromkeys(names, math.nan)
    if status == _LANDED:
        last = State(*motion[:, -1])
        end = {name: float(getattr(last, name)) for name in names if name != "t"}
        end |= {"t": float(times[-1]) * time}
        if not pieces:
            end["alpha"] = p.alpha0
    apex = Apex(math.nan, math.nan, math.nan, math.nan)
    if rise.reached:
        x, y, z = (float(q) for q in p.motion(rise.states[-1][:, np.newaxis])[:3, 0])
        apex = Apex(x, y, rise.times[-1] * time, z)
    dense = partial(_between, p, times, motion, pieces)
    nodes = np.vstack([times * time, motion[[0, 1, 3, 4]]])
    return Solution(**end, apex=apex, status=status, nfev=nfev, nodes=nodes, _dense=dense)


def _between(p: Problem, times: Array, motion: Array, pieces: list[Any], t: Array) -> Array:
    """The motion at the times `t` in s, by the interpolants between the nodes."""
    if not pieces:
        return np.broadcast_to(motion[:, :1].reshape(8, *[1] * t.ndim), (8, *t.shape)).copy()
    scaled = np.ravel(t) / (p.speed / p.g)
    index = np.clip(np.searchsorted(times, scaled, "right") - 1, 0, len(pieces) - 1)
    found = np.empty((len(p.start), scaled.size))
    for i in np.unique(index):
        found[:, index == i] = pieces[i](scaled[index == i])
    return p.motion(found).reshape(8, *t.shape)


def _real(name: str, value: Any, allowed: str, legal: Callable[[float], bool]) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} must be a real number, got {type(value).__name__}")
    try:
        number = float(value)
    except OverflowError:  # of an integer
        number = math.inf if abs(value) == value else -math.inf
    if not legal(number):
        degrees = name in ("alpha0", "slope") and math.isfinite(number)
        hint = " (if these are degrees: np.deg2rad)" if degrees else ""
        raise ValueError(f"{name} must be {allowed}, got {number}{hint}")
    return number
