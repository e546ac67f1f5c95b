"""Other ways to d_norm, to set beside the engine: the paper's own, and what one would else write.

Each takes one launch, ``v_norm = v0 / v_lim > 0`` and ``alpha0`` in radians between 0 and a right
angle, as plain floats (`by_steps` and `by_nodes`: many, as arrays), and gives d_norm: NaN where it
knows that it failed.  They are written to be fair: as short and quick as their method allows, and
no more careful than it is.  `packages` has two more.
"""

import math
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.integrate import quad, solve_ivp

from hodograph import ode, steppers
from hodograph.engine.domain import FloatArray
from hodograph.engine.position import BLOCK, layer, quadrature
from hodograph.engine.status import Status
from hodograph.engine.velocity import bracket_gap, start
from hodograph.engine.vial import newton_vial, speed2_as_printed
from hodograph.level import landing_angle
from hodograph.path import speed

Batch: TypeAlias = Callable[[FloatArray, FloatArray], FloatArray]
Scalar: TypeAlias = Callable[[float, float], float]

MAX_STEPS = 50
LAST_STEP = 1e-8  # relative: the step after it would be of rounding, since Newton squares the error
FIRST_STEP = 1e-3  # of `time_scale`: a first step over the whole flight would miss the landing


def by_paper(v_norm: float, alpha0: float) -> float:
    """The paper's literal route: its Newton (eq. 20), then eq. 15 over eq. 13 as printed.

    The landing angle is iterated from -alpha0 until it moves by less than 0.01 degree, and each
    integral is taken in alpha by `scipy.integrate.quad`.

    >>> round(by_paper(1.0, np.pi / 4), 5), by_paper(3.0, np.pi / 4)
    (0.58901, nan)
    """
    found = newton_vial(v_norm, alpha0)
    if found.status != Status.CONVERGED:
        return math.nan
    with np.errstate(all="ignore"):
        v2 = speed2_as_printed(v_norm, alpha0)
        x = quad(v2, found.alpha, alpha0, limit=200, full_output=1)[0]  # eq. 15
    return x / vacuum(v_norm, alpha0) if math.isfinite(x) else math.nan


def by_fixed_nodes(v_norm: float, alpha0: float, *, nodes: int = 64) -> float:
    """Eq. 15 by a Gauss-Legendre rule in alpha, always of `nodes` nodes.

    Speed and landing angle are the engine's, so that only the quadrature is judged.

    >>> round(by_fixed_nodes(1.0, np.pi / 4), 8)
    0.5890118
    """
    points, weights = leggauss(nodes)
    alpha_s = float(landing_angle(v_norm, alpha0))
    alpha = alpha_s + (alpha0 - alpha_s) * (1 + points) / 2
    x = (alpha0 - alpha_s) / 2 * float(weights @ speed(v_norm, alpha0, alpha) ** 2)
    return x / vacuum(v_norm, alpha0)


def by_solve_ivp(
    v_norm: float,
    alpha0: float,
    *,
    method: str = "DOP853",
    rtol: float = 1e-10,
    atol: float = 1e-13,
    scaled: bool = False,
) -> float:
    """The equations of motion through SciPy's `solve_ivp`, up to the event y = 0.

    Nothing is done but what the range needs.  The event counts on the way down only, or it would
    strike at the launch; even so a first step that spans the whole flight makes it strike there,
    and the answer is 0.

    With `scaled` the units are such that the flight is neither long nor short (see `time_scale`),
    and the first step is a thousandth; else they are v_lim and v_lim / g, and the step is SciPy's.

    >>> round(by_solve_ivp(1.0, np.pi / 4), 8)
    0.5890118
    """
    speed_unit, time_unit = units(v_norm, math.sin(alpha0)) if scaled else (1.0, 1.0)
    drag, weight = speed_unit * time_unit, time_unit / speed_unit

    def rates(_t: float, state: FloatArray) -> tuple[float, float, float, float]:
        _, _, vx, vy = state.tolist()
        v = drag * math.sqrt(vx * vx + vy * vy)
        return vx, vy, -v * vx, -weight - v * vy

    def height(_t: float, state: FloatArray) -> float:
        return float(state[1])

    event: Any = height  # solve_ivp takes these two from the function
    event.terminal, event.direction = True, -1.0
    v0 = v_norm / speed_unit
    flight = solve_ivp(
        rates,
        (0.0, (2 * v_norm + 1) / time_unit),  # the flight in vacuum is no longer than 2 v_norm
        (0.0, 0.0, v0 * math.cos(alpha0), v0 * math.sin(alpha0)),
        method=method,
        events=event,
        rtol=rtol,
        atol=atol,
        first_step=FIRST_STEP if scaled else None,
    )
    if flight.status != 1:
        return math.nan
    return float(flight.y[0, -1]) * drag / vacuum(v_norm, alpha0)


def by_ode(v_norm: float, alpha0: float) -> float:
    """The equations of motion by `hodograph.ode`: DOP853 too, with a landing that is never missed.

    >>> round(by_ode(1.0, np.pi / 4), 8)
    0.5890118
    """
    flight = ode.solve(v_norm, alpha0, 1.0, g=1.0, method="DOP853", rtol=1e-10, atol=1e-13)
    return flight.x / vacuum(v_norm, alpha0)


def by_quad(v_norm: float, alpha0: float, *, rtol: float = 1e-13) -> float:
    """The closed form by `scipy.integrate.quad` and Newton, one launch at a time.

    The same mathematics as the engine's: the integrals in delta = s0 - s, s = asinh(tan alpha),
    with the difference form of eq. 9 that does not cancel.  Rise and fall are integrated apart, so
    that no digits are lost where they cancel, and a Newton step after the first guess integrates
    only from one iterate to the next.  `rtol` is that of each integral, and of the landing.

    >>> round(by_quad(1.0, np.pi / 4), 12)
    0.589011800192
    """
    sinh, cosh = math.sinh, math.cosh
    s0, w = math.asinh(math.tan(alpha0)), (v_norm * math.cos(alpha0)) ** 2

    def dx(delta: float) -> float:  # over w
        return cosh(s0 - delta) / (1 + w * (delta + sinh(delta) * cosh(2 * s0 - delta)))

    def dy(delta: float) -> float:  # over w / 2
        return sinh(2 * (s0 - delta)) / (1 + w * (delta + sinh(delta) * cosh(2 * s0 - delta)))

    def integral(f: Callable[[float], float], low: float, high: float) -> float:
        # full_output: no warning where rounding stops it short of the tolerance
        return float(quad(f, low, high, epsabs=0, epsrel=rtol, limit=200, full_output=1)[0])

    delta = 2 * s0  # the landing in vacuum
    height = integral(dy, 0.0, s0) + integral(dy, s0, delta)
    for _ in range(MAX_STEPS):
        step = -height / dy(delta)
        if abs(step) <= rtol * delta:
            x = integral(dx, 0.0, s0) + integral(dx, s0, delta)
            return w * x / vacuum(v_norm, alpha0)
        height += integral(dy, delta, delta + step)
        delta += step
    return math.nan


def by_steps(v_norm: FloatArray, alpha0: FloatArray, *, method: str, steps: int) -> FloatArray:
    """Fixed steps in time, `steps` of them in `time_scale`, for many launches together.

    >>> by_steps(np.array([1.0]), np.array([np.pi / 4]), method="rk4", steps=64).round(6)
    array([0.589012])
    """
    unit = time_scale(
        v_norm, np.sin(alpha0)
    )  # of time, in v_lim/g; with speeds in v_lim, g is the same number
    flights = steppers.integrate(v_norm, alpha0, 1.0, dt=1 / steps, method=method, g=unit)
    return np.asarray(flights.impact.x * unit / (v_norm**2 * np.sin(2 * alpha0)))


def by_nodes(v_norm: FloatArray, alpha0: FloatArray, *, nodes: int) -> FloatArray:
    """The engine without its adaptation: one rule of `nodes` nodes for every launch.

    Newton on the height in the slope, from the landing in vacuum; x and y by the engine's
    quadrature over the whole arc.

    >>> by_nodes(np.array([1.0]), np.array([np.pi / 4]), nodes=16).round(8)
    array([0.5890118])
    """
    sin0, cos0 = np.sin(alpha0), np.cos(alpha0)
    begin, eta = start(v_norm**2, sin0, cos0), layer(v_norm**2)
    slope = np.arcsinh(sin0 / cos0)
    x = np.empty_like(slope)
    width = max(BLOCK // nodes, 1)
    for first in range(0, x.size, width):
        at = np.arange(first, min(first + width, x.size))
        arc, apex = begin.at(at), slope[at]
        delta = 2 * apex
        for _ in range(MAX_STEPS):
            length = np.log1p(delta / eta[at])
            along, height = quadrature(nodes, arc, eta[at], length, None, ("x", "y"))
            gap, C = bracket_gap(arc, delta)
            rate = C / (1 + arc.v2 * gap)  # dx / d(delta), and dy = sin(alpha) / cos(alpha0) dx
            step = -height / (rate * C * np.tanh(apex - delta))
            step = np.maximum(step, (apex - delta) / 2)  # the landing is past the apex
            x[at], delta = along + rate * step, delta + step
            if (np.abs(step) <= LAST_STEP * delta).all():
                break
    return np.asarray(x / (2 * sin0))


def one_by_one(compute: Scalar) -> Batch:
    """A function of arrays that calls `compute` launch by launch.

    >>> one_by_one(by_quad)(np.array([0.5, 1.0]), np.array([0.5, np.pi / 4])).round(6)
    array([0.874448, 0.589012])
    """

    def batch(v_norm: FloatArray, alpha0: FloatArray) -> FloatArray:
        pairs = zip(v_norm.tolist(), alpha0.tolist(), strict=True)
        return np.array([compute(v, a) for v, a in pairs])

    return batch


def time_scale(v_norm: Any, sine: Any) -> Any:
    """The time, in v_lim / g, in which drag or weight changes the velocity: steps are parts of it.

    It is the flight in vacuum, 2 v sin(alpha0), where drag is weak, and 1/v where it is strong.

    >>> time_scale(1.0, 0.5)
    0.5
    """
    rise = 2 * v_norm * sine
    return rise / (1 + v_norm * rise)


def units(v_norm: Any, sine: Any) -> tuple[Any, Any]:
    """Units of speed and time in which the numbers of a flight are of order 1."""
    return v_norm, time_scale(v_norm, sine)


def vacuum(v_norm: float, alpha0: float) -> float:
    """The range without drag, in units of v_lim^2 / g (eq. 21)."""
    return v_norm**2 * math.sin(2 * alpha0)
