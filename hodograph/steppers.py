"""The equations of motion advanced step by step: Euler to Runge-Kutta, and SciPy beside them.

The methods of a first course, in its variables p = dx/dt and q = dy/dt, for any power law of
drag R = λvⁿ; many launches advance together.  Nothing is shared with the engine, nor with `ode`:
that one seeks the right answer, this one shows what a step of a given length makes of it.

Drag and weight depend on the velocity alone.  A step therefore has stages of velocity only, and
the position is carried by those same velocities: see `Method`.
"""

import math
import warnings
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, fields
from inspect import getattr_static
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import integrate as scipy_integrate

__all__ = [
    "ALOFT",
    "FIXED",
    "INVALID",
    "LANDED",
    "METHODS",
    "SCIPY",
    "STATUS",
    "UNSTABLE",
    "Flights",
    "Method",
    "Point",
    "integrate",
]

_Array = npt.NDArray[np.float64]
_Mask = npt.NDArray[np.bool_]
_Law = Callable[[_Array], _Array]  # acceleration (2, m) of velocities (2, m)


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
# SciPy has no classical method of order 4: nearest are the pairs of Dormand and Prince, which
# advance at order 5 and estimate the error by order 4.
_BY_ODE = ("dopri5", "dop853")
_BY_SOLVE_IVP = {
    "RK23": scipy_integrate.RK23,
    "RK45": scipy_integrate.RK45,
    "DOP853": scipy_integrate.DOP853,
    "LSODA": scipy_integrate.LSODA,
}
SCIPY = (*_BY_ODE, *_BY_SOLVE_IVP)
METHODS = (*FIXED, *SCIPY)

LANDED, ALOFT, UNSTABLE, INVALID = range(4)
STATUS = (
    "landed",
    "did not land within t_max",
    "the step is too large for the drag or for the flight, or SciPy gave up",
    "a NaN among the inputs",
)

_MAX_STEPS = 100_000_000
_MAX_OWN = 500_000  # evaluations for steps that SciPy chooses, some 20 s
_MAX_STORED = 100_000_000  # nodes times launches
_MIN_RTOL = 2.3e-14  # SciPy warns below 100 ulp and uses that instead
_HUGE = 1e100
_LATEST = float(np.finfo(np.float64).max)  # s
_X, _Y = 2, 3  # rows of a state: p, q, x, y


@dataclass(frozen=True, eq=False)
class Point:
    """A point of each flight: time (s), position (m) and velocity (m/s); NaN where there is none.

    Attributes
    ----------
    t, x, y, p, q
        Of the shape of the launches.
    """

    t: Any
    x: Any
    y: Any
    p: Any
    q: Any


@dataclass(frozen=True, eq=False)
class Flights:
    """What a method made of some launches; fields have their shape.

    Attributes
    ----------
    t, x, y, p, q
        The history, with the time along a last axis: every node from the launch to the first
        below the ground, as the exercise's loop stores them, and NaN after that.  None unless it
        was asked for; `t` is one axis for all launches.
    impact
        The landing between the last two nodes, interpolated to the method's own order.
    impact_naive
        The last node with y >= 0: what the exercise's loop gives.
    status
        0 landed, 1 did not land within t_max, 2 the step is too large for the drag or for the
        flight, or SciPy gave up, 3 a NaN among the inputs; `STATUS` has the words.  Only where
        it is 0 is there an impact.
    steps
        Nodes after the launch, the one below the ground included.
    evaluations
        How often the acceleration was computed, each time for all launches together.
    """

    t: Any
    x: Any
    y: Any
    p: Any
    q: Any
    impact: Point
    impact_naive: Point
    status: Any
    steps: Any
    evaluations: int

    @property
    def success(self) -> Any:
        """Whether each flight landed."""
        return self.status == LANDED


def integrate(
    v0: npt.ArrayLike,
    alpha0: npt.ArrayLike,
    v_lim: npt.ArrayLike,
    *,
    dt: float,
    method: str = "rk4",
    n: float = 2.0,
    g: npt.ArrayLike = 9.81,
    height: npt.ArrayLike = 0.0,
    t_max: float | None = None,
    rtol: float | None = None,
    atol: float | None = None,
    history: bool = False,
) -> Flights:
    """Advance launches by steps of `dt` until they are below the ground.

    Parameters
    ----------
    v0, alpha0, v_lim : array_like
        Launch speed (m/s), angle in [-pi/2, pi/2] (radians) and terminal speed of fall
        (m/s; ``inf`` is vacuum): the deceleration by drag is g (v / v_lim)ⁿ.
    dt : float
        The step in s.
    method : str, optional
        ``"euler"``, ``"euler_cromer"``, ``"rk2"`` (midpoint), ``"rk4"`` (classical);
        ``"dopri5"``, ``"dop853"`` by ``scipy.integrate.ode``; or ``"RK23"``, ``"RK45"``,
        ``"DOP853"``, ``"LSODA"`` as ``scipy.integrate.solve_ivp`` runs them.  SciPy chooses its
        own steps, one sequence for all launches of the call, and `dt` is the distance between
        the points at which it is asked.
    n : float, optional
        Exponent of the drag, at least 1.
    g, height : array_like, optional
        Gravity (m/s²) and height of the launch above the landing plane (m, >= 0).
    t_max : float, optional
        Time at which to give up, in s; by default, twice what the longest flight may take.
    rtol, atol : float, optional
        Tolerances for SciPy, whose own defaults hold otherwise; not for the fixed steps.  `rtol`
        is at least 2.3e-14, below which SciPy would take another.
    history : bool, optional
        Keep every node.

    Returns
    -------
    Flights
        Both impacts, a status for each launch and, if asked for, the history.

    Raises
    ------
    TypeError, ValueError
        An argument of the wrong type or out of its range, in one line that names it.

    Notes
    -----
    How the impact is interpolated keeps the order p of the method.  Both nodes carry an error of
    order dt^p that is smooth in time, so the interpolant must add no more than that.  For Euler
    and Euler-Cromer it is the straight line (error dt²), which is the method itself with a
    shorter last step.  For the others it is the polynomial of degree 5 that has the position,
    velocity and acceleration of both nodes (error dt⁶).

    A step is too large where it exceeds the stability interval of the method for the drag at
    that speed, n g vⁿ⁻¹/v_limⁿ: beyond it, disturbances grow, and drag may throw the projectile
    back.  The flight then ends with status 2.  Within it every speed stays finite.  So ends
    every flight where `dt` is longer than twice what the longest may take (for the fixed steps,
    which follow a parabola exactly, a million times as long), and those by SciPy where its own
    steps ask for more than 500000 accelerations.

    Examples
    --------
    The exercise's launch with its step; the closed form gives 467.760658 m.

    >>> import numpy as np
    >>> for method in ("euler", "rk2"):
    ...     flight = integrate(70.0, np.pi / 4, 981.0, method=method, dt=0.001, n=1)
    ...     print(f"{method:5} {flight.impact_naive.x:.6f} {flight.impact.x:.6f}")
    euler 467.762317 467.806231
    rk2   467.760092 467.760657
    """
    rule = _known_method(method)
    shape, arrays = _launches(v0, alpha0, v_lim, g, height)
    n = _number("n", n, "finite and >= 1", lambda a: 1 <= a < math.inf)
    dt = _number("dt", dt, "finite and > 0", lambda a: 0 < a < math.inf)
    tolerances = _tolerances(method, rtol, atol)
    valid: _Mask = np.logical_not(np.isnan(arrays).any(axis=0))
    v0s, alphas, v_lims, gs, heights = arrays[:, valid]
    with np.errstate(all="ignore"):
        longest = _long_enough(v0s, alphas, v_lims, gs, heights)
    if t_max is None:
        t_max = min(longest + 10 * dt, _LATEST)
    else:
        t_max = _number("t_max", t_max, "finite and > 0", lambda a: 0 < a < math.inf)
    if not t_max / dt < _MAX_STEPS:
        raise ValueError(
            f"dt must be > t_max / {_MAX_STEPS:.0e}, or the steps are too many; got {dt} "
            f"for t_max = {t_max:.6g}"
        )
    if history and t_max / dt * v0s.size > _MAX_STORED:
        raise ValueError(
            f"history would hold {t_max / dt * v0s.size:.1e} nodes, and may hold "
            f"{_MAX_STORED:.0e}; take a larger dt or fewer launches"
        )

    # A step that explodes, and a solver that gives up, are told by the status.
    quiet: AbstractContextManager[object] = nullcontext()
    if rule is None:
        quiet = warnings.catch_warnings(action="ignore", category=UserWarning)
    with np.errstate(all="ignore"), quiet:
        law = _Counted(_power_law(v_lims, gs, n))
        start = np.stack([v0s * np.cos(alphas), v0s * np.sin(alphas), 0 * v0s, heights])
        if rule is not None:
            nodes = _by_steps(rule, law, dt, start)
            fastest = _fastest_stable(rule.reach / dt, v_lims, gs, n)
        else:
            nodes = _by_scipy(method, law, dt, start, tolerances)
            fastest = np.full(v0s.shape, np.inf)
        # Lost between the launch and the first node; the fixed steps follow a parabola exactly.
        if 0 < longest < (dt if rule is None else dt * 1e-6):
            nodes = iter(())
        walk = _walk(nodes, start, fastest, math.ceil(t_max / dt), history)
        spent = law.calls
        line = rule is not None and rule.order == 1
        landing = (_on_line if line else _on_hermite)(walk, law, dt)
    sound = np.isfinite(landing).all(axis=0)
    if rule is None:  # what a trial step made of it
        sound &= np.abs(landing[1]) <= v0s * longest * (1 + 1e-9)
    walk.status[(walk.status == LANDED) & ~sound] = UNSTABLE
    impacts = [landing, np.vstack([(walk.steps - 1) * dt, walk.before[[_X, _Y, 0, 1]]])]
    for impact in impacts:
        impact[:, walk.status != LANDED] = np.nan
    status = np.full(valid.shape, INVALID)
    steps = np.zeros(valid.shape, dtype=np.intp)
    status[valid], steps[valid] = walk.status, walk.steps
    t, x, y, p, q = _stored(walk, dt, shape, valid)
    return Flights(
        t=t,
        x=x,
        y=y,
        p=p,
        q=q,
        impact=_point(impacts[0], shape, valid),
        impact_naive=_point(impacts[1], shape, valid),
        status=status.reshape(shape)[()],
        steps=steps.reshape(shape)[()],
        evaluations=spent,
    )


# --- the law of motion --------------------------------------------------------------------


class _Counted:
    """A law that counts its evaluations."""

    def __init__(self, law: _Law) -> None:
        self.law, self.calls = law, 0

    def __call__(self, velocity: _Array) -> _Array:
        self.calls += 1
        return self.law(velocity)


def _power_law(v_lim: _Array, g: _Array, n: float) -> _Law:
    """f1 and f2 of the exercise, (5), for drag in vⁿ (eq. 8)."""
    rate = g / v_lim

    def law(velocity: _Array) -> _Array:
        if n == 1:
            force = velocity * -rate
        else:
            ratio = np.hypot(velocity[0], velocity[1]) / v_lim
            force = velocity * (-rate * (ratio if n == 2 else ratio ** (n - 1)))
        force[1] -= g
        return force

    return law


def _fastest_stable(rate: float, v_lim: _Array, g: _Array, n: float) -> _Array:
    """The speed at which drag decays disturbances along the path at `rate`."""
    ratio = rate / n * (v_lim / g)
    if n == 1:
        return np.where(ratio >= 1, np.inf, -1.0)
    return np.asarray(v_lim * ratio ** (1 / (n - 1)))


def _long_enough(v0: _Array, alpha0: _Array, v_lim: _Array, g: _Array, height: _Array) -> float:
    """Twice the flight in vacuum and the fall at terminal speed together."""
    rise = v0 * np.sin(alpha0)
    vacuum = (rise + np.hypot(rise, np.sqrt(2 * g) * np.sqrt(height))) / g
    return float(2 * np.max(vacuum + height / v_lim, initial=0.0))


# --- from node to node --------------------------------------------------------------------


def _by_steps(method: Method, law: _Law, dt: float, state: _Array) -> Iterator[_Array]:
    """The nodes after `state`, without end."""
    while True:
        velocity, position = state[:2], state[2:]
        speeds: list[_Array] = []
        pushes: list[_Array] = []
        for row in method.stages:
            speeds.append(_moved(velocity, dt, row, pushes))
            pushes.append(law(speeds[-1]))
        speeds.append(_moved(velocity, dt, method.weights, pushes))
        state = np.concatenate([speeds[-1], _moved(position, dt, method.carry, speeds)])
        yield state


def _moved(start: _Array, dt: float, weights: tuple[float, ...], rates: list[_Array]) -> _Array:
    for weight, rate in zip(weights, rates, strict=True):
        if weight:
            start = start + (weight * dt) * rate
    return start


def _by_scipy(
    method: str, law: _Law, dt: float, state: _Array, tolerances: dict[str, float]
) -> Iterator[_Array]:
    """The nodes after `state`, until SciPy gives up."""
    shape = state.shape
    if not np.isfinite(law(state[:2])).all():
        return

    def rates(_t: float, flat: _Array) -> _Array:
        velocity = flat.reshape(shape)[:2]
        force = law(velocity)
        if not math.isfinite(np.vdot(force, force)):  # a trial step too far; SciPy rejects no NaN
            force = np.nan_to_num(force, nan=_HUGE, posinf=_HUGE, neginf=-_HUGE)
        return np.concatenate([force, velocity]).ravel()

    if method in _BY_ODE:
        solver = scipy_integrate.ode(rates)
        solver.set_integrator(method, nsteps=_MAX_OWN // 10, **tolerances)
        solver.set_initial_value(state.ravel(), 0.0)
        step = 0
        while solver.successful():
            step += 1
            with _interruptible():
                node = np.array(solver.integrate(step * dt))
            yield node.reshape(shape)
    else:  # what solve_ivp does with t_eval, node by node
        solver = _BY_SOLVE_IVP[method](rates, 0.0, state.ravel(), math.inf, **tolerances)
        step = 1
        while solver.step() is None and solver.status == "running" and solver.nfev < _MAX_OWN:
            inside = solver.dense_output()
            while step * dt <= solver.t:
                yield inside(step * dt).reshape(shape)
                step += 1


@contextmanager
def _interruptible() -> Iterator[None]:
    """An interruption that SciPy's compiled code made another error of, raised as it was."""
    try:
        yield
    except Exception as error:
        cause: BaseException | None = error
        while cause is not None:
            if isinstance(cause, KeyboardInterrupt):
                raise cause from None
            cause = cause.__cause__
        raise


@dataclass(frozen=True, eq=False)
class _Walk:
    """The end of each flight: the nodes before and after the ground, and all of them."""

    status: npt.NDArray[np.intp]
    steps: npt.NDArray[np.intp]
    before: _Array
    after: _Array
    states: list[_Array] | None


def _walk(
    nodes: Iterator[_Array], start: _Array, fastest: _Array, most: int, history: bool
) -> _Walk:
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
        ended = flying & ~(sound & (state[_Y] >= 0))
        if ended.any():  # the ground comes first: the step to it was from a sound speed
            landed = ended & ~(state[_Y] >= 0) & np.isfinite(state).all(axis=0)
            status[ended], steps[ended] = np.where(landed, LANDED, UNSTABLE)[ended], count
            before[:, landed], after[:, landed] = previous[:, landed], state[:, landed]
            flying &= ~ended
    steps[flying] = count
    return _Walk(status, steps, before, after, states if history else None)


# --- the impact ---------------------------------------------------------------------------


def _on_line(walk: _Walk, law: _Law, dt: float) -> _Array:
    """t, x, y, p, q where the straight line between the last nodes meets the ground."""
    before, after = walk.before, walk.after
    part = before[_Y] / (before[_Y] - after[_Y])
    p, q, x, _ = before + part * (after - before)
    return np.stack([(walk.steps - 1 + part) * dt, x, 0 * x, p, q])


def _on_hermite(walk: _Walk, law: _Law, dt: float) -> _Array:
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


# --- results in the shape of the launches ---------------------------------------------------


def _point(rows: _Array, shape: tuple[int, ...], valid: _Mask) -> Point:
    filled = np.full((len(fields(Point)), valid.size), np.nan)
    filled[:, valid] = rows
    return Point(*(row.reshape(shape)[()] for row in filled))


def _stored(walk: _Walk, dt: float, shape: tuple[int, ...], valid: _Mask) -> tuple[Any, ...]:
    """t, x, y, p, q: the nodes of each launch up to its last, then NaN."""
    if walk.states is None:
        return (None,) * 5
    states = np.stack(walk.states, axis=-1)  # (4, launches, nodes)
    count = np.arange(states.shape[-1])
    states[:, count > walk.steps[:, np.newaxis]] = np.nan
    filled = np.full((4, valid.size, count.size), np.nan)
    filled[:, valid] = states
    p, q, x, y = filled.reshape(4, *shape, count.size)
    return count * dt, x, y, p, q


# --- what may come in ---------------------------------------------------------------------


def _known_method(method: str) -> Method | None:
    if not isinstance(method, str) or method not in METHODS:
        raise ValueError(f"method must be one of {', '.join(METHODS)}; got {method!r}")
    return FIXED.get(method)


def _launches(*values: Any) -> tuple[tuple[int, ...], _Array]:
    """The launches checked and broadcast: their shape, and an array (5, launches)."""
    rules: dict[str, tuple[str, Callable[[_Array], _Mask]]] = {
        "v0": ("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a)),
        "alpha0": ("in [-pi/2, pi/2] radians", lambda a: np.abs(a) <= math.pi / 2),
        "v_lim": ("> 0 (inf is vacuum)", lambda a: a > 0),
        "g": ("finite and > 0", lambda a: (a > 0) & np.isfinite(a)),
        "height": ("finite and >= 0", lambda a: (a >= 0) & np.isfinite(a)),
    }
    labels = [each.index for each in values if _package(each) == "pandas"]
    if not all(labels[0].equals(index) for index in labels[1:]):
        raise ValueError("launches of pandas Series with different indices: align them first")
    arrays = []
    for (name, (words, legal)), value in zip(rules.items(), values, strict=True):
        array = _as_float(name, value)
        bad = ~(legal(array) | np.isnan(array))
        if bad.any():
            raise ValueError(f"{name} must be {words}; got {float(array[bad].flat[0])!r}")
        arrays.append(array)
    try:
        together = np.broadcast_arrays(*arrays)
    except ValueError:
        shapes = ", ".join(f"{k} {a.shape}" for k, a in zip(rules, arrays, strict=True))
        raise ValueError(f"arguments do not broadcast together: {shapes}") from None
    return together[0].shape, np.stack([array.ravel() for array in together])


def _package(value: object) -> str:
    return type(value).__module__.partition(".")[0]


def _as_float(name: str, value: npt.ArrayLike) -> _Array:
    package = _package(value)
    if package in ("xarray", "dask"):
        way = {"xarray": "xarray.apply_ufunc", "dask": "dask.array.map_blocks"}[package]
        raise TypeError(f"{name} is a {package} {type(value).__name__}; use {way}")
    if any(getattr_static(value, word, None) is not None for word in ("units", "unit")):
        raise TypeError(f"{name} carries units; pass its plain magnitude in SI units or radians")
    try:
        array: Any = np.ma.asarray(value)
    except ValueError:
        raise TypeError(f"{name} must be real numbers in a regular array") from None
    flags = isinstance(value, list | tuple) and any(isinstance(v, bool | np.bool_) for v in value)
    if array.dtype.kind not in "iuf" or np.ma.is_masked(array) or flags:
        raise TypeError(f"{name} must be real numbers; got {type(value).__name__}")
    return np.asarray(array, dtype=np.float64)


def _number(name: str, value: float, words: str, legal: Callable[[float], bool]) -> float:
    array = _as_float(name, value)
    if array.ndim:
        raise TypeError(f"{name} must be one number; got shape {array.shape}")
    if not legal(float(array)):
        raise ValueError(f"{name} must be {words}; got {float(array)!r}")
    return float(array)


def _tolerances(method: str, rtol: float | None, atol: float | None) -> dict[str, float]:
    """Those given, for SciPy alone."""
    given = {name: v for name, v in (("rtol", rtol), ("atol", atol)) if v is not None}
    if given and method in FIXED:
        raise ValueError(f"{next(iter(given))} is for SciPy's methods; {method} has none")
    rules: dict[str, tuple[str, Callable[[float], bool]]] = {
        "rtol": (f"finite and >= {_MIN_RTOL}", lambda a: _MIN_RTOL <= a < math.inf),
        "atol": ("finite and > 0", lambda a: 0 < a < math.inf),
    }
    return {name: _number(name, value, *rules[name]) for name, value in given.items()}
