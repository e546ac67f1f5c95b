"""The equations of motion advanced step by step: Euler to Runge-Kutta, and SciPy beside them.

The methods of a first course, in its variables p = dx/dt and q = dy/dt, for any power law of
drag R = λvⁿ; many launches advance together.  Nothing is shared with the engine, nor with `ode`:
that one seeks the right answer, this one shows what a step of a given length makes of it.
"""

import math
import warnings
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hodograph.witness.stepping_fixed import (
    FIXED,
    Counted,
    Method,
    X,
    Y,
    by_steps,
    fastest_stable,
    power_law,
)
from hodograph.witness.stepping_inputs import Array, Mask, launches, number
from hodograph.witness.stepping_scipy import MIN_RTOL, SCIPY, by_scipy
from hodograph.witness.stepping_walk import (
    ALOFT,
    INVALID,
    LANDED,
    UNSTABLE,
    Walk,
    follow,
    on_hermite,
    on_line,
)

__all__ = [
    "ALOFT", "FIXED", "INVALID", "LANDED", "METHODS", "SCIPY", "STATUS", "UNSTABLE",
    "Flights", "Method", "Point", "integrate",
]  # fmt: skip

METHODS = (*FIXED, *SCIPY)
STATUS = (
    "landed",
    "did not land within t_max",
    "the step is too large for the drag or for the flight, or SciPy gave up",
    "a NaN among the inputs",
)
_MAX_STEPS = 100_000_000
_MAX_STORED = 100_000_000  # nodes times launches
_LATEST = float(np.finfo(np.float64).max)  # s


@dataclass(frozen=True, eq=False)
class Point:
    """A point of each flight: time (s), position (m) and velocity (m/s); NaN where there is none.

    The fields have the shape of the launches.
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
        LANDED, ALOFT, UNSTABLE or INVALID; `STATUS` has the words.  Only where it is LANDED is
        there an impact.
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
    if not isinstance(method, str) or method not in METHODS:
        raise ValueError(f"method must be one of {', '.join(METHODS)}; got {method!r}")
    rule = FIXED.get(method)
    shape, arrays = launches(v0, alpha0, v_lim, g, height)
    n = number("n", n, "finite and >= 1", lambda a: 1 <= a < math.inf)
    dt = number("dt", dt, "finite and > 0", lambda a: 0 < a < math.inf)
    tolerances = _tolerances(method, rtol, atol)
    valid: Mask = np.logical_not(np.isnan(arrays).any(axis=0))
    v0s, alphas, v_lims, gs, heights = arrays[:, valid]
    with np.errstate(all="ignore"):
        longest = _long_enough(v0s, alphas, v_lims, gs, heights)
    most = _most_steps(t_max, min(longest + 10 * dt, _LATEST), dt, v0s.size if history else 0)

    # A step that explodes, and a solver that gives up, are told by the status.
    quiet: AbstractContextManager[object] = nullcontext()
    if rule is None:
        quiet = warnings.catch_warnings(action="ignore", category=UserWarning)
    with np.errstate(all="ignore"), quiet:
        law = Counted(power_law(v_lims, gs, n))
        start = np.stack([v0s * np.cos(alphas), v0s * np.sin(alphas), 0 * v0s, heights])
        nodes: Iterator[Array]
        if rule is not None:
            nodes = by_steps(rule, law, dt, start)
            fastest = fastest_stable(rule.reach / dt, v_lims, gs, n)
        else:
            nodes = by_scipy(method, law, dt, start, tolerances)
            fastest = np.full(v0s.shape, np.inf)
        # Over before the first node: no step tells of it, though a fixed one follows a parabola.
        if 0 < longest < (dt if rule is None else dt * 1e-6):
            nodes = iter(())
        walk = follow(nodes, start, fastest, most, history)
        spent = law.calls
        line = rule is not None and rule.order == 1
        landing = (on_line if line else on_hermite)(walk, law, dt)
    sound = np.isfinite(landing).all(axis=0)
    if rule is None:  # a trial step of SciPy may have ended where no flight can go
        sound &= np.abs(landing[1]) <= v0s * longest * (1 + 1e-9)
    walk.status[(walk.status == LANDED) & ~sound] = UNSTABLE
    return _in_shape(walk, landing, dt, spent, shape, valid)


def _long_enough(v0: Array, alpha0: Array, v_lim: Array, g: Array, height: Array) -> float:
    """Twice the time of the flight in vacuum and of a fall at terminal speed together."""
    rise = v0 * np.sin(alpha0)
    vacuum = (rise + np.hypot(rise, np.sqrt(2 * g) * np.sqrt(height))) / g
    return float(2 * np.max(vacuum + height / v_lim, initial=0.0))


def _most_steps(t_max: float | None, default: float, dt: float, stored: int) -> int:
    """The steps until t_max, of which `stored` launches are to keep the nodes."""
    if t_max is None:
        t_max = default
    else:
        t_max = number("t_max", t_max, "finite and > 0", lambda a: 0 < a < math.inf)
    if not t_max / dt < _MAX_STEPS:
        raise ValueError(
            f"dt must be > t_max / {_MAX_STEPS:.0e}, or the steps are too many; got {dt} "
            f"for t_max = {t_max:.6g}"
        )
    if t_max / dt * stored > _MAX_STORED:
        raise ValueError(
            f"history would hold {t_max / dt * stored:.1e} nodes, and may hold "
            f"{_MAX_STORED:.0e}; take a larger dt or fewer launches"
        )
    return math.ceil(t_max / dt)


def _tolerances(method: str, rtol: float | None, atol: float | None) -> dict[str, float]:
    """The tolerances that were given; only SciPy's methods have any."""
    given = {name: v for name, v in (("rtol", rtol), ("atol", atol)) if v is not None}
    if given and method in FIXED:
        raise ValueError(f"{next(iter(given))} is for SciPy's methods; {method} has none")
    if rtol is not None:
        words = f"finite and >= {MIN_RTOL}"
        given["rtol"] = number("rtol", rtol, words, lambda a: MIN_RTOL <= a < math.inf)
    if atol is not None:
        given["atol"] = number("atol", atol, "finite and > 0", lambda a: 0 < a < math.inf)
    return given


def _in_shape(
    walk: Walk, landing: Array, dt: float, spent: int, shape: tuple[int, ...], valid: Mask
) -> Flights:
    """The results in the shape of the launches."""

    def shaped(rows: npt.NDArray[Any], blank: float = np.nan) -> tuple[Any, ...]:
        filled = np.full((len(rows), valid.size, *rows.shape[2:]), blank, rows.dtype)
        filled[:, valid] = rows
        return tuple(row.reshape((*shape, *rows.shape[2:]))[()] for row in filled)

    impacts = [landing, np.vstack([(walk.steps - 1) * dt, walk.before[[X, Y, 0, 1]]])]
    for rows in impacts:
        rows[:, walk.status != LANDED] = np.nan
    history: tuple[Any, Any, Any, Any, Any] = (None,) * 5
    if walk.states is not None:
        states = np.stack(walk.states, axis=-1)  # (4, launches, nodes)
        count = np.arange(states.shape[-1])
        states[:, count > walk.steps[:, np.newaxis]] = np.nan
        p, q, x, y = shaped(states)
        history = count * dt, x, y, p, q
    (status,) = shaped(walk.status[np.newaxis], INVALID)
    (steps,) = shaped(walk.steps[np.newaxis], 0)
    impact, naive = (Point(*shaped(rows)) for rows in impacts)
    return Flights(*history, impact, naive, status, steps, spent)
