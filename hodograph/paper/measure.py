"""What the paper states in numbers, measured: closed forms against motion, and errors of laws.

Angles are in degrees where a name says so, in radians elsewhere.  Nothing is judged here.
"""

import timeit
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from scipy import integrate, optimize

from hodograph import laws, ode
from hodograph.engine.domain import FloatArray
from hodograph.engine.status import Status
from hodograph.engine.vial import newton_vial
from hodograph.laws.vial import V_LIM, V_MAX
from hodograph.level import d_norm, d_ref, landing_angle
from hodograph.paper.table_1 import v_axis
from hodograph.path import arc_length, position, speed

# --- closed forms against integration in time ---------------------------------------------------


class Misses(NamedTuple):
    """Largest relative differences of the closed forms from integration of (16)."""

    speed: float
    position: float
    arc_length: float


def flights() -> Iterator[tuple[float, float, ode.Solution]]:
    """(v_norm, alpha0, solution of eq. 16) for launches slow and fast, flat and steep."""
    for v_norm in (0.3, 1.0, V_MAX, 5.0):
        for alpha0 in np.deg2rad([10.0, 45.0, 80.0]):
            yield v_norm, float(alpha0), _motion(v_norm, float(alpha0), height=2.0)


def _motion(v_norm: float, alpha0: float, *, n: float = 2.0, height: float = 0.0) -> ode.Solution:
    """Eq. 16 as printed, in time; v_lim = 1 and g = 1."""
    return ode.solve(
        v_norm, alpha0, 1.0, g=1.0, height=height, n=n, rtol=1e-12, atol=1e-14, form="hodograph"
    )


def misses() -> Misses:
    """Hold eq. 13, 15 and 19 against (16) at every step of the integrator."""
    worst = np.zeros(3)
    for v_norm, alpha0, flight in flights():
        _, x, y, vx, vy = flight.nodes[:, 1:]
        alpha = np.arctan2(vy, vx)
        place = position(v_norm, alpha0, alpha)
        off = np.hypot(place.x - x, place.y - (y - flight.nodes[2, 0]))
        worst = np.maximum(
            worst,
            [
                np.max(np.abs(speed(v_norm, alpha0, alpha) / np.hypot(vx, vy) - 1)),
                np.max(off) / np.max(np.hypot(x, y)),
                abs(arc_length(v_norm, alpha0, flight.alpha) / flight.arc_length - 1),
            ],
        )
    return Misses(*(float(miss) for miss in worst))


def power_law_miss(exponents: tuple[float, ...] = (1.0, 1.5, 3.0, 4.0)) -> float:
    """Largest relative difference of eq. 8, its integral by quadrature, from (16)."""
    worst = 0.0
    for n in exponents:
        for alpha0 in np.deg2rad([30.0, 60.0]):
            flight = _motion(1.0, float(alpha0), n=n)
            _, _, _, vx, vy = flight.nodes[:, 1:]
            for alpha, v in zip(np.arctan2(vy, vx), np.hypot(vx, vy), strict=True):
                bracket = integrate.quad(
                    lambda u, n: np.cos(u) ** -(n + 1), alpha, alpha0, args=(n,), epsabs=0.0
                )[0]
                inverse = np.cos(alpha) ** n * (n * bracket + np.cos(alpha0) ** -n)  # eq. 8
                worst = max(worst, abs(inverse ** (-1 / n) / v - 1))
    return float(worst)


def terminal_misses() -> tuple[float, float, float]:
    """How far v / v_lim is from 1: by eq. 13 at -89.9 and -89.99 degrees, by (16) after a fall."""
    v_norm = np.array([0.1, 1.0, 10.0])
    steep, steeper = (
        np.max(np.abs(speed(v_norm, np.pi / 4, np.deg2rad(alpha)) - 1)) for alpha in (-89.9, -89.99)
    )
    fallen = [ode.solve(v, np.pi / 4, 1.0, g=1.0, height=20.0, rtol=1e-12).speed for v in v_norm]
    return float(steep), float(steeper), float(np.max(np.abs(np.array(fallen) - 1)))


# --- what depends on what -----------------------------------------------------------------------

BODIES = (  # g in m/s^2, m in kg, lambda in kg/m
    (9.81, 0.145, 7.8e-4),  # a baseball
    (1.62, 7.26, 5.0e-3),  # a shot, in the gravity of the Moon
    (24.8, 0.0027, 3.8e-4),  # a table tennis ball, in that of Jupiter
    (9.81, 1000.0, 2.0),
)


class Spread(NamedTuple):
    """Largest spread over g, m, lambda at one (v_norm, alpha0), and largest miss of the engine."""

    alpha_s: float  # degrees
    d_norm: float  # relative
    alpha_s_miss: float
    d_norm_miss: float


def fly_si(v0: float, alpha0: float, g: float, m: float, drag: float) -> tuple[float, float]:
    """Range and landing slope by eq. 16 in SI units, with nothing scaled out of it.

    >>> d, alpha_s = fly_si(9.81, 0.5, 9.81, 1.0, 0.0)
    >>> print(f"{d:.6f} {alpha_s:.6f}")  # v0^2 sin(2 alpha0) / g
    8.254830 -0.500000
    """

    def rates(_t: float, state: FloatArray) -> list[float]:
        _, _, v, alpha = state
        return [
            v * np.cos(alpha),
            v * np.sin(alpha),
            -g * np.sin(alpha) - drag / m * v * v,
            -g * np.cos(alpha) / v,
        ]

    # Rise and fall apart: y starts at its own zero, and an event on it could be met there.
    state: Any = [0.0, 0.0, v0, alpha0]
    for component in (3, 1):

        def end(_t: float, state: FloatArray, component: int = component) -> float:
            return float(state[component])

        event: Any = end  # solve_ivp takes these two from the function
        event.terminal, event.direction = True, -1.0
        leg = integrate.solve_ivp(
            rates, (0.0, 10 * v0 / g), state, "DOP853", events=event, rtol=1e-12, atol=1e-12
        )
        state = leg.y[:, -1]
    return float(state[0]), float(state[3])


def spread() -> Spread:
    """Vary g, m and lambda at fixed v_norm and alpha0 (section 3.1)."""
    worst = np.zeros(4)
    for v_norm in (0.5, 1.0, V_MAX):
        for alpha0 in np.deg2rad([20.0, 45.0, 70.0]):
            rows = []
            for g, m, drag in BODIES:
                v0 = v_norm * np.sqrt(m * g / drag)
                d, alpha_s = fly_si(v0, alpha0, g, m, drag)
                rows.append((np.rad2deg(alpha_s), d * g / v0**2 / np.sin(2 * alpha0)))
            alpha_s, d = np.array(rows).T
            found = [np.ptp(alpha_s), np.ptp(d) / d.min()]
            found += [np.max(np.abs(alpha_s - np.rad2deg(landing_angle(v_norm, alpha0))))]
            found += [np.max(np.abs(d / d_norm(v_norm, alpha0) - 1))]
            worst = np.maximum(worst, found)
    return Spread(*(float(value) for value in worst))


def vacuum_misses() -> tuple[float, float]:
    """Without drag, by (16): 45 + phi against 45 - phi degrees, and both against (21)."""
    phi = np.array([1.0, 5.0, 15.0, 30.0, 40.0, 44.0])
    ranges = []
    expected = []
    for sign in (-1, 1):
        alpha0 = np.deg2rad(45 + sign * phi)
        ranges.append([ode.solve(50.0, a, np.inf, rtol=1e-12).x for a in alpha0])
        expected.append(d_ref(50.0, alpha0))
    low, high = np.array(ranges)
    asymmetry = np.max(np.abs(low / high - 1))
    return float(asymmetry), float(np.max(np.abs(np.array(ranges) / np.array(expected) - 1)))


class Asymmetry(NamedTuple):
    """How much farther 45 - phi goes than 45 + phi, relative to the latter."""

    least: float  # over v_norm to 1.5 and phi from 1 to 44 degrees
    at_15_deg: float  # at v_norm = 1
    by_motion: float  # the same by (16)


def asymmetry() -> Asymmetry:
    """Compare ranges at 45 - phi and 45 + phi degrees with drag (section 3.3)."""
    v = v_axis()[10::10, np.newaxis]
    phi = np.deg2rad(np.arange(1.0, 45.0))
    excess = d_norm(v, np.pi / 4 - phi) / d_norm(v, np.pi / 4 + phi) - 1
    low, high = (ode.solve(V_LIM, np.deg2rad(a), V_LIM, rtol=1e-12).x for a in (30.0, 60.0))
    at_15 = d_norm(1.0, np.deg2rad(30.0)) / d_norm(1.0, np.deg2rad(60.0)) - 1
    return Asymmetry(float(np.min(excess)), float(at_15), low / high - 1)


# --- the paper's iteration (20) -----------------------------------------------------------------


class Newton(NamedTuple):
    """The iteration (20) over the paper's domain, as it sets it: from -alpha0, to 0.01 degree."""

    launches: int
    failures: int
    steps_most: int
    steps_mean: float
    alpha_error_deg: float
    d_error: float  # relative


NEWTON_DEGREES = (1.0, *map(float, range(3, 88, 3)), 89.0)
STEEP_DEGREES = (89.9, 89.95, 89.99)


def newton_over_domain(alpha0_deg: tuple[float, ...] = NEWTON_DEGREES) -> Newton:
    """Run (20) for v_norm 0.1 to 1.5 by 0.1, at angles in degrees."""
    v, alpha0 = np.meshgrid(v_axis()[10::10], np.deg2rad(alpha0_deg))
    found = newton_vial(v, alpha0)
    exact = landing_angle(v, alpha0)
    good = found.status == Status.CONVERGED
    v, alpha0, exact = v[good], alpha0[good], exact[good]
    d = position(v, alpha0, found.alpha[good]).x
    error = np.abs(d / position(v, alpha0, exact).x - 1)
    return Newton(
        launches=good.size,
        failures=int(np.sum(~good)),
        steps_most=int(found.steps[good].max()),
        steps_mean=float(found.steps[good].mean()),
        alpha_error_deg=float(np.rad2deg(np.max(np.abs(found.alpha[good] - exact)))),
        d_error=float(np.max(error)),
    )


def newton_thresholds(alpha0_deg: FloatArray) -> FloatArray:
    """The least v_norm for which (20) fails, at each angle, to 0.001; up to 6.

    >>> newton_thresholds(np.array([45.0])).round(1)
    array([1.9])
    """
    alpha0 = np.deg2rad(alpha0_deg)
    works, fails = np.full(alpha0.shape, 1.0), np.full(alpha0.shape, 6.0)
    while np.max(fails - works) > 1e-3:
        middle = (works + fails) / 2
        good = newton_vial(middle, alpha0).status == Status.CONVERGED
        works, fails = np.where(good, middle, works), np.where(good, fails, middle)
    return fails


# --- the laws against exact values --------------------------------------------------------------


class LawError(NamedTuple):
    """Relative error of a law of d_norm, law / exact - 1, over (v_norm, alpha0)."""

    v_norm: FloatArray
    alpha0_deg: FloatArray
    error: FloatArray

    def worst(self, low: float = 0.0, high: float = 90.0) -> tuple[float, float, float]:
        """(error, v_norm, alpha0 in degrees) where it is largest, angles from low to high."""
        error = self._inside(low, high)
        i, j = np.unravel_index(np.argmax(np.abs(error)), error.shape)
        first = np.searchsorted(self.alpha0_deg, low)
        return float(error[i, j]), float(self.v_norm[i]), float(self.alpha0_deg[first + j])

    def rms(self, low: float, high: float) -> float:
        """Root mean square, angles from low to high."""
        return float(np.sqrt(np.mean(self._inside(low, high) ** 2)))

    def share(self, bound: float, low: float, high: float) -> float:
        """The part of the grid that keeps the bound, angles from low to high."""
        return float(np.mean(np.abs(self._inside(low, high)) <= bound))

    def _inside(self, low: float, high: float) -> FloatArray:
        return self.error[:, (self.alpha0_deg >= low) & (self.alpha0_deg <= high)]

    def within(self, bound: float) -> list[tuple[float, float]]:
        """Intervals of angle on which every v_norm keeps the bound."""
        keeps = np.max(np.abs(self.error), axis=0) <= bound
        edges = np.flatnonzero(np.diff(np.concatenate([[0], keeps.astype(int), [0]])))
        ends = self.alpha0_deg
        return [
            (float(ends[i]), float(ends[j - 1]))
            for i, j in zip(edges[::2], edges[1::2], strict=True)
        ]

    def fastest(self, bound: float, low: float, high: float) -> float:
        """The largest v_norm up to which the bound is kept at all angles from low to high."""
        breaks = np.max(np.abs(self._inside(low, high)), axis=1) > bound
        return float(self.v_norm[-1 if not breaks.any() else np.argmax(breaks) - 1])


def law_error() -> LawError:
    """Relative error of eq. 22 with Table 1, v_norm to 1.5 by 0.01, 1 to 90 degrees by 0.5.

    >>> error, v_norm, alpha0_deg = law_error().worst()
    >>> print(f"{error:+.1%} at v_norm = {v_norm}, {alpha0_deg} degrees")
    -9.1% at v_norm = 1.5, 1.0 degrees
    """
    v, degrees = v_axis(), np.arange(2, 181) / 2
    return LawError(v, degrees, errors(laws.table_1, v, degrees))


def errors(law: Callable[[Any, Any], Any], v: FloatArray, degrees: FloatArray) -> FloatArray:
    """Relative error of a law of d_norm over the product of two axes."""
    alpha0 = np.deg2rad(degrees)
    exact = d_norm(v[:, np.newaxis], alpha0)
    return np.asarray(law(v[:, np.newaxis], alpha0) / exact - 1)


def gaussian_misses(shapes: tuple[float, ...] = (1e2, 1e3, 1e4)) -> list[float]:
    """Largest difference of eq. 22 from exp(-K^2 x^2), over K x from 0 to 5, for each M."""
    x = np.arange(501) / 100
    return [float(np.max(np.abs(laws.pearson_vii(x, 1.0, M) - np.exp(-x * x)))) for M in shapes]


def tilt(n: float, v_norm: float, off_deg: float = 1.0) -> float:
    """Relative gain in range from 45 - off to 45 + off degrees, for drag as v^n."""
    low, high = (
        ode.solve(v_norm, np.deg2rad(45 + s * off_deg), 1.0, g=1.0, n=n, rtol=1e-12, atol=1e-14).x
        for s in (-1, 1)
    )
    return high / low - 1


def tilting_exponent() -> float:
    """The exponent beyond which weak drag puts the best angle above 45 degrees.

    To first order, drag e v^n shortens the range by e cot(alpha0) times the integral of
    (T - t)^2 v^(n - 1) over the parabola, of time T = 2 sin(alpha0) (v0 = g = 1).  The best angle
    stays at 45 degrees if this loss has zero slope in alpha0 there.

    >>> print(f"{tilting_exponent():.8f}")
    3.41479926
    """
    nodes, weights = np.polynomial.legendre.leggauss(40)
    alpha0 = np.pi / 4
    half = np.sin(alpha0)
    t = half * (1 + nodes)
    fall = 2 * half - t
    v2 = 1 - 2 * t * half + t * t

    def slope(n: float) -> float:
        # d/d alpha0 of cot(alpha0) J, J the integral; at its end (T - t)^2 is 0
        power = v2 ** ((n - 1) / 2)
        by_time = 4 * fall * np.cos(alpha0) * power
        by_speed = -(fall**2) * (n - 1) * t * np.cos(alpha0) * power / v2
        J, slope_of_J = (half * weights @ f for f in (fall**2 * power, by_time + by_speed))
        return float(slope_of_J / np.tan(alpha0) - J / np.sin(alpha0) ** 2)

    return float(optimize.brentq(slope, 2.0, 5.0, xtol=1e-12))


def upright_limit() -> float:
    """v_norm beyond which the best angle is below 45 degrees again for n = 3.5, to 0.001."""
    return float(optimize.brentq(lambda v: tilt(3.5, v, 0.5), 0.2, 2.0, xtol=1e-3))


def simplification() -> float:
    """How many times quicker the printed law is than the iteration (20), in arrays, a launch.

    The least of three runs of each; (20) without the integral that gives the distance.
    """
    v, alpha0 = (a.ravel() for a in np.meshgrid(v_axis()[10::20], np.deg2rad([10, 30, 45, 60, 80])))
    many = np.resize(v, 10_000), np.resize(alpha0, 10_000)
    law, paper = (
        min(timeit.repeat(call, number=1, repeat=3)) / size
        for call, size in (
            (lambda: laws.table_1(*many), many[0].size),
            (lambda: newton_vial(v, alpha0), v.size),
        )
    )
    return float(paper / law)
