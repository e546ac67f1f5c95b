"""Each public answer against the equations of motion, integrated in time by `hodograph.ode`.

`CHECKS` has one entry for every public function and for every field and method of every public
class; a name without an entry fails the last test.  The oracle is DOP853 at the tightest
tolerance SciPy takes: measured against closed forms and against mpmath it is good to about
1e-14 at the landing and the apex, to 1.4e-13 where a vertical launch meets a drag that is not
smooth at rest (n = 1.5), and to 6e-13 of the flight in between.
"""

import dataclasses
import importlib
import inspect
import math
import tempfile
import types
from collections.abc import Callable, Iterator, Mapping
from functools import cache, partial
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import hodograph
from hodograph import Launch, bodies, grid, laws, ode, reference, sensitivity, steppers, surrogate
from hodograph.bodies import drag_constant, terminal_speed
from hodograph.engine.vial import VialNewton, newton_vial
from hodograph.level import balanced_exponent
from hodograph.path import arc_length, position, speed

TOL = 2e-13  # at the landing and at the apex, relative
INSIDE = 5e-12  # between them, of the length or the speed of the flight
UPRIGHT = 3e-11  # straight up with n > 2, where dense output is 2e-11 off, by `reference`
DERIVATIVE = 1e-11  # of differences of the oracle, relative
EVEN = 1e-8  # how evenly the points of a path are spaced, of its length
POINTS = 9
EXPONENTS = (2.0, 1.0, 1.5, 3.0, 7.0)


class Scene(NamedTuple):
    """A launch in SI units; the fields are the arguments of `Launch` and of `ode.solve`."""

    v0: float
    alpha0: float
    v_lim: float
    g: float = 9.81
    height: float = 0.0
    n: float = 2.0
    slope: float = 0.0
    wind: float = 0.0
    crosswind: float = 0.0


KINDS = {  # v_norm, alpha0, height in v_lim^2 / g
    "level ground": (1.0, math.pi / 4, 0.0),
    "slow": (0.05, 0.5, 0.0),
    "shallow and fast": (20.0, 0.1, 0.0),
    "fast, from above": (20.0, 0.8, 2.0),
    "steep, from above": (3.0, 1.4, 0.5),
    "to a target above": (1.5, 1.0, -0.1),
    "downward": (0.5, -0.5, 1.0),
    "level, from above": (5.0, 0.0, 0.3),
    "vertical": (2.0, math.pi / 2, 0.4),
}


def scene(v_norm: float, alpha0: float, height: float, n: float) -> Scene:
    v_lim, g = (42.7, 9.81) if n == 2 else (31.0, 1.62)
    return Scene(v_norm * v_lim, alpha0, v_lim, g, height * v_lim**2 / g, n)


def scenes(*exponents: float) -> dict[str, Scene]:
    return {f"{kind}, n={n:g}": scene(*KINDS[kind], n) for n in exponents for kind in KINDS}


SCENES = scenes(*EXPONENTS) | {"vacuum": Scene(20.0, 0.7, math.inf, height=3.0)}
QUADRATIC = scenes(2.0)
GROUNDS = {  # slope, and wind and crosswind in v_lim
    "uphill": (0.35, 0.0, 0.0),
    "downhill": (-0.6, 0.0, 0.0),
    "tailwind": (0.0, 0.4, 0.0),
    "headwind": (0.0, -0.3, 0.0),
    "crosswind": (0.0, 0.0, 0.25),
    "gale from the side, uphill": (0.2, 0.9, -0.7),
    "blown uphill": (0.3, 1.2, 0.1),
    "blown back downhill": (-0.4, -0.5, 0.2),
    "blown back uphill": (0.45, -0.4, 0.0),
    "blown on downhill": (-0.5, 0.8, 0.0),
}


def on(ground: str, case: Scene) -> Scene:
    slope, wind, crosswind = GROUNDS[ground]
    unit = case.v_lim if math.isfinite(case.v_lim) else case.v0
    return case._replace(slope=slope, wind=wind * unit, crosswind=crosswind * unit)


OUTDOORS = {  # each scene on one ground, and quadratic drag on all
    f"{name}, {ground}": on(ground, case)
    for i, (name, case) in enumerate(SCENES.items())
    for j, ground in enumerate(GROUNDS)
    if case.n == 2 or (i - j) % len(GROUNDS) == 0
}
SLANTED = {name: case for name, case in SCENES.items() if abs(case.alpha0) < 1.5}
ON_FOOT = {name: case for name, case in SLANTED.items() if case.height >= 0 and case.v0 < 300}
SHARP = {name: case for name, case in SCENES.items() if name != "vertical, n=1.5"}  # see above
CURVED = {name: case for name, case in QUADRATIC.items() if name in SLANTED}
INPUTS = {name: case for name, case in SCENES.items() if "target" in name or "vacuum" in name}
MISSED = {f"n={n:g}": scene(1.0, 0.8, -0.5, n) for n in EXPONENTS}
LEVEL = {
    f"v={v:g}, {round(math.degrees(a))}°, n={n:g}": (v, a, n)
    for v, a, n in product((0.05, 0.8, 1.5, 7.0), (0.02, 0.6, 1.2, math.pi / 2), EXPONENTS)
}
SQUARE = {name: case for name, case in LEVEL.items() if case[2] == 2}
WEAK = {name: case for name, case in SQUARE.items() if case[0] <= 1.5}
EXTREME = {name: case for name, case in SQUARE.items() if case[0] in (0.05, 7.0)}
PAPER = {  # where the paper claims its law
    f"v={v:g}, {degrees}°": (v, math.radians(degrees), 2.0)
    for v, degrees in product((0.3, 0.9, 1.5), (10, 25, 45, 65, 80))
}


def still(case: Scene) -> dict[str, float]:
    """The fields of a scene over level ground in still air."""
    return {name: getattr(case, name) for name in Scene._fields[:6]}


# --- the oracle ---------------------------------------------------------------------------


@cache
def oracle(case: Scene) -> ode.Solution:
    """The flight by the equations of motion."""
    return ode.solve(**case._asdict(), rtol=2.3e-14, atol=1e-16)


def level(v_norm: float, alpha0: float, n: float = 2.0) -> ode.Solution:
    """A flight on level ground, in v_lim^2 / g and v_lim / g."""
    return oracle(Scene(v_norm, alpha0, 1.0, g=1.0, n=n))


def true_d_norm(v_norm: float, alpha0: float, n: float = 2.0) -> float:
    return level(v_norm, alpha0, n).x / (v_norm**2 * math.sin(2 * alpha0))


def distance(case: Scene, **changes: float) -> float:
    return oracle(case._replace(**changes)).x


OFFSETS = np.array([1, 2, 3, 4])
FIRST = np.array([4 / 5, -1 / 5, 4 / 105, -1 / 280])
SECOND = np.array([8 / 5, -1 / 5, 8 / 315, -1 / 560])


def differences(function: Callable[[float], Any], at: float, step: float) -> tuple[Any, Any]:
    """First and second derivative by central differences of eighth order."""
    up = np.array([function(at + k * step) for k in OFFSETS])
    down = np.array([function(at - k * step) for k in OFFSETS])
    middle = function(at)
    return FIRST @ (up - down) / step, SECOND @ (up + down - 2 * middle) / step**2


def close(found: Any, expected: Any, tol: float = TOL, scale: Any = 0.0) -> None:
    """Equal within `tol` of the expected value and of `scale`; a NaN is not."""
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    off = np.abs(found - expected)
    right = bool(np.all(off <= tol * (np.abs(expected) + scale)))
    assert right, f"{found!r} for {expected!r}: off by up to {np.max(off):.2g}"


# --- level ground, in v_norm and alpha0 ---------------------------------------------------

TIERS = {
    f"{name}, {option}": (*case, options, bound)
    for name, case in WEAK.items()
    for option, options, bound in [
        *((f"rtol={rtol:g}", {"rtol": rtol}, rtol) for rtol in (1e-1, 1e-3, 1e-6, 1e-9, 1e-12)),
        ("law", {"method": "law"}, 7.7e-5),
        ("law_all", {"method": "law_all"}, 8.5e-3),
        ("surrogate", {"method": "surrogate"}, 1e-9),
        ("exact", {"method": "exact"}, TOL),
    ]
}
EXACT = {name: (*case, {}, TOL) for name, case in LEVEL.items()}


def check_d_norm(case: tuple[float, float, float, dict[str, Any], float]) -> None:
    v, a, n, options, bound = case
    close(hodograph.d_norm(v, a, n=n, **options), true_d_norm(v, a, n), max(bound, TOL))


def check_d_ref(case: Scene) -> None:
    vacuum = case._replace(v_lim=math.inf, height=0.0, alpha0=abs(case.alpha0))
    close(hodograph.d_ref(case.v0, vacuum.alpha0, g=case.g), oracle(vacuum).x)


def check_landing_angle(case: tuple[float, float, float]) -> None:
    v, a, n = case
    close(hodograph.landing_angle(v, a, n=n), level(v, a, n).alpha)


def check_newton_vial(case: tuple[float, float, float]) -> None:
    found = newton_vial(*case[:2], stop=1e-9)
    close(found.alpha, level(*case).alpha, 1e-11)
    assert found.status == 0
    assert 1 <= found.steps <= 50


def check_greatest(angle: float, case: Scene, tol: float = DERIVATIVE) -> None:
    """The oracle's range is greatest there: the step of Newton's method towards it is nil."""
    slope, curvature = differences(lambda a: distance(case, alpha0=a), angle, 0.005)
    assert curvature < 0
    assert abs(slope / curvature) <= tol


def check_optimal_angle(case: tuple[float, float]) -> None:
    v, n = case
    check_greatest(hodograph.optimal_angle(v, n=n), Scene(v, 0.0, 1.0, g=1.0, n=n))


def check_balanced_exponent(v: float) -> None:
    n = balanced_exponent(v)
    slow = v == 0  # the limit, to first order in v^n
    at_45 = Scene(0.05 if slow else v, 0.0, 1.0, g=1.0, n=n)
    check_greatest(math.pi / 4, at_45, 1e-8 if slow else DERIVATIVE)


# --- along the path, in v_norm and alpha --------------------------------------------------


def nodes(case: Scene) -> Iterator[tuple[float, float, float, float, float, float]]:
    """Some nodes of the oracle in v_lim^2 / g and v_lim / g: t, x, y, speed, s and slope."""
    own = scaled(case)
    flight = oracle(own)
    for i in np.linspace(1, flight.nodes.shape[1] - 1, 4).astype(int):
        t, x, y, vx, vy = (float(row[i]) for row in flight.nodes)
        s, v = float(flight.state(t).air_length), math.hypot(vx, vy)
        yield t, x, y - own.height, v, s, math.atan2(vy, vx)


def scaled(case: Scene) -> Scene:
    """The launch in v_lim, v_lim^2 / g and v_lim / g."""
    height = case.height * case.g / case.v_lim**2
    return case._replace(v0=case.v0 / case.v_lim, v_lim=1.0, g=1.0, height=height)


def check_position(field: str, case: Scene) -> None:
    for t, x, y, *_, alpha in nodes(case):
        found = position(case.v0 / case.v_lim, case.alpha0, alpha)
        close(getattr(found, field), {"t": t, "x": x, "y": y}[field], INSIDE, scale=abs(t) + abs(x))


def check_speed(case: Scene) -> None:
    for *_, v, _, alpha in nodes(case):
        close(speed(case.v0 / case.v_lim, case.alpha0, alpha), v, INSIDE)


def check_arc_length(case: Scene) -> None:
    for *_, s, alpha in nodes(case):
        close(arc_length(case.v0 / case.v_lim, case.alpha0, alpha), s, INSIDE)


def check_terminal_speed(k: float) -> None:
    found = float(terminal_speed(k, g=9.81))
    close(found, math.sqrt(9.81 / k))  # what `ode` means by v_lim
    close(found, oracle(Scene(0.0, 0.0, found, height=25 * found**2 / 9.81)).speed)


def check_drag_constant(cd: float) -> None:
    mass, area, rho, g = 0.2, 0.007, 1.28, 9.81
    k = float(drag_constant(mass, cd, area=area, rho=rho))

    def drag(v: float) -> float:
        return rho * cd * area * v * v / 2 / (mass * g)

    close(
        oracle(Scene(50.0, 0.7, math.sqrt(g / k))).x,
        ode.solve(50.0, 0.7, math.inf, drag=drag, rtol=1e-13).x,
        INSIDE,
    )


def check_body(body: bodies.Body) -> None:
    """Let fall for long, its drag is its weight."""
    v_lim = float(body.v_lim())
    close(v_lim, float(terminal_speed(body.k())))
    speed = ode.solve(0.0, 0.0, v_lim, height=25 * v_lim**2 / 9.81, rtol=1e-12).speed
    close(0.5 * 1.225 * body.cd * math.pi / 4 * body.diameter**2 * speed**2, body.mass * 9.81)


# --- scenes -------------------------------------------------------------------------------


@cache
def fly(case: Scene) -> Launch:
    return Launch(**case._asdict())


@cache
def landing(case: Scene) -> hodograph.Landing:
    return fly(case).landing()


@cache
def path(case: Scene) -> hodograph.Trajectory:
    return fly(case).trajectory(POINTS)


def check_scene(launch: Launch, case: Scene) -> None:
    close(launch.range(), oracle(case).x)
    close(launch.flight_time(), oracle(case).t)


def check_launch_field(name: str, case: Scene) -> None:
    """What the launch says of itself is what was flown."""
    own = {field: float(getattr(fly(case), field)) for field in Scene._fields}
    assert own[name] == getattr(case, name)
    check_scene(fly(case), Scene(**own))


def check_v_norm(case: Scene) -> None:
    launch = fly(case)
    if math.isinf(case.v_lim):
        assert launch.v_norm == 0
        return
    own = oracle(scaled(case)._replace(v0=float(launch.v_norm)))
    close(launch.range(), own.x * case.v_lim**2 / case.g)


def check_from_drag(case: Scene) -> None:
    k = case.g / case.v_lim**case.n
    launch = Launch.from_drag(case.v0, case.alpha0, k, n=case.n, g=case.g, height=case.height)
    check_scene(launch, case)


def check_from_body(case: Scene) -> None:
    """A ball of 145 g and 74 mm, in air as thick as it takes."""
    own = case._asdict()
    area, k = math.pi / 4 * 0.074**2, case.g / own.pop("v_lim") ** 2
    body = {"mass": 0.145, "cd": 0.35, "rho": 2 * 0.145 * k / (0.35 * area)}
    del own["n"]
    check_scene(Launch.from_body(**own, **body, diameter=0.074), case)
    check_scene(Launch.from_body(**own, **body, area=area), case)


def check_range(case: Scene) -> None:
    close(fly(case).range(), oracle(case).x)
    for rtol in (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12):
        close(fly(case).range(rtol=rtol), oracle(case).x, rtol)


def check_flight_time(case: Scene) -> None:
    close(fly(case).flight_time(), oracle(case).t)


def check_apex(case: Scene) -> None:
    top = oracle(case).apex
    size = oracle(case).arc_length
    for found, expected in zip(fly(case).apex(), (top.x, top.y, top.t), strict=True):
        close(found, expected, scale=size * 1e-3)


def check_landing(field: str, case: Scene) -> None:
    flight = oracle(case)
    if field == "y":
        expected, scale = flight.x * math.tan(case.slope), 0.0
    else:
        name = {"arc_length": "air_length"}.get(field, field)
        expected, scale = getattr(flight, name), 0.0
    if case.wind or case.crosswind or case.slope:
        size = {"alpha": 1.0, "t": 0.0, "speed": 0.0}.get(field, flight.air_length)
        scale = 0.3 * size
    close(getattr(landing(case), field), expected, scale=scale)


def check_error(case: Scene) -> None:
    """The estimate is no less than the error, of which the oracle leaves 1e-14 open."""
    found, true = landing(case), oracle(case)
    for answer, expected in ((found.x, true.x), (found.t, true.t)):
        if expected:
            assert abs(answer / expected - 1) <= found.error + 1e-14
    assert found.error <= 1e-12


def check_status(case: Scene) -> None:
    assert landing(case).status == oracle(case).status
    assert landing(case).success == oracle(case).success
    if not oracle(case).success:
        assert np.isnan([landing(case).x, landing(case).t, fly(case).range()]).all()
        assert np.isnan(path(case).x).all()


def hold_points(field: str, case: Scene, points: Any) -> None:
    """Points of a path against the oracle at their times."""
    flight = oracle(case)
    true = flight.state(np.minimum(points.t, flight.nodes[0, -1]))
    length = max(flight.arc_length, flight.air_length)
    expected, scale = {
        "x": (true.x, length * (1.0 if case.wind else math.cos(case.alpha0))),
        "y": (true.y, length),
        "z": (true.z, length),
        "speed": (true.speed, case.v0),
        "alpha": (true.alpha, 1 + min(case.v0, case.v_lim) / true.speed),
        "s": (true.air_length, length),
    }[field]
    upright = case.alpha0 == math.pi / 2 and case.n > 2
    close(getattr(points, field), expected, UPRIGHT if upright else INSIDE, scale)


def check_path(field: str, case: Scene) -> None:
    """Each point against the oracle at that time."""
    hold_points(field, case, path(case))


def states(case: Scene) -> Iterator[tuple[str, Any, Any]]:
    """Places within a flight, what they are by the oracle, and the states there."""
    flight = oracle(case)
    t = flight.t * np.array([0.0, 1e-9, 0.03, 0.4, 0.8, 0.99])
    true, launch = flight.state(t), fly(case)
    rises = flight.apex.t > t
    yield "t", t, launch.at(t=t)
    yield "s", true.air_length, launch.at(s=true.air_length)
    if case.wind >= 0:  # it may have been there before
        x = np.maximum(true.x, 0.0)
        yield "x", x, launch.at(x=x)
    for rising in (True, False):
        if (rises == rising).any():
            y = np.maximum(true.y[rises == rising], case.height if rising else -math.inf)
            yield "y", y, launch.at(y=y, rising=rising)
    if case in SLANTED.values() and not (case.wind or case.crosswind):
        alpha = np.minimum(true.alpha, case.alpha0)
        yield "alpha", alpha, launch.at(alpha=alpha)


def check_state(field: str, case: Scene) -> None:
    """States by any place: at it, and where the oracle is at their time."""
    if oracle(case).t == 0:
        return
    for place, value, found in states(case):
        assert found.success.all(), place
        close(getattr(found, place), value, 1e-14, scale=10 * abs(case.wind) * found.t)
        if field in ("t", "status", "success"):
            continue
        hold_points(field, case, found)


def check_path_length(case: Scene) -> None:
    """The length of the oracle's path up to the time of each point."""
    flight = oracle(case)
    hold_points("s", case, path(case))
    close(path(case).s[-1], flight.air_length)


def check_path_time(case: Scene) -> None:
    """The points stand at even lengths of the oracle's path, and the last is the landing."""
    flight = oracle(case)
    even = np.linspace(0, flight.air_length, POINTS)
    true = flight.state(np.minimum(path(case).t, flight.nodes[0, -1])).air_length
    close(true, even, EVEN, scale=flight.air_length)
    close(path(case).t[[0, -1]], [0, flight.t])


# --- derivatives and best angles ----------------------------------------------------------


@cache
def sensitivity_of(case: Scene) -> sensitivity.Sensitivity:
    return sensitivity.range_sensitivity(
        case.v0, case.alpha0, case.v_lim, g=case.g, height=case.height
    )


def check_sensitivity(field: str, case: Scene, of: Callable[[Scene], Any] = sensitivity_of) -> None:
    found = getattr(of(case), field)
    if field == "range":
        close(found, oracle(case).x)
        return
    size = {"v0": case.v0, "v_lim": case.v_lim, "height": oracle(case).apex.y}.get(field, 1.0)
    if field == "alpha0" and case.alpha0 == math.pi / 2:
        slope = -oracle(case).x / math.cos(case.alpha0)  # from there to the vertical, and nil
    else:
        step = 0.002 * size
        slope, _ = differences(lambda q: distance(case, **{field: q}), getattr(case, field), step)
    close(found, slope, DERIVATIVE, scale=abs(oracle(case).x) / size)


def check_best_angle(case: Scene) -> None:
    found = hodograph.best_angle(case.v0, case.v_lim, g=case.g, height=case.height)
    check_greatest(float(found), case)


def check_shot(field: str, case: Scene) -> None:
    """A place on the path is the target: one of the arcs is the launch."""
    t = 0.7 * oracle(case).t
    state = oracle(case).state(t)
    place = float(state.x), float(state.y) - case.height
    shots = [
        hodograph.aim(case.v0, *place, case.v_lim, arc=arc, n=case.n, g=case.g, wind=case.wind)
        for arc in ("low", "high")
    ]
    found = min(shots, key=lambda shot: abs(shot.alpha0 - case.alpha0))
    expected = {"alpha0": case.alpha0, "t": t, "azimuth": 0.0, "shortfall": 0.0, "status": 0}
    expected |= {"speed": float(state.speed), "alpha": float(state.alpha), "success": 1}
    close(getattr(found, field), expected[field], 20 * INSIDE, scale=1.0)


def check_least_speed(case: Scene) -> None:
    found = hodograph.least_speed(oracle(case).x, -case.height, case.v_lim, g=case.g)
    assert found.success
    assert found.status == 0
    slowest = case._replace(v0=float(found.v0))
    close(distance(slowest, alpha0=float(found.alpha0)), oracle(case).x, INSIDE)
    check_greatest(float(found.alpha0), slowest)


def check_envelope(case: Scene) -> None:
    x = 0.9 * oracle(case).x
    found = hodograph.envelope(case.v0, x, case.v_lim, g=case.g)
    assert found.success
    assert found.status == 0
    reached = case._replace(height=-float(found.y))
    close(distance(reached, alpha0=float(found.alpha0)), x, 100 * INSIDE)
    check_greatest(float(found.alpha0), reached)


# --- films --------------------------------------------------------------------------------


@cache
def filmed(case: Scene, points: int = 40) -> tuple[Any, hodograph.Calibration]:
    """The oracle's flight as a film without noise, and what is found in it."""
    t = np.linspace(0.0, oracle(case).t, points)
    x, y, _, _ = oracle(case).at(t)
    return (x, y, t), hodograph.calibrate(x, y, t, n=case.n, g=case.g, mass=1.0, area=0.01) if (
        case.n == 2
    ) else hodograph.calibrate(x, y, t, n=case.n, g=case.g)


def check_calibrated(name: str, case: Scene) -> None:
    """The launch comes back from its film."""
    _, found = filmed(case)
    k = case.g / case.v_lim**case.n
    true = {
        "k": k,
        "x0": 0.0,
        "y0": case.height,
        "t0": 0.0,
        "g_track": case.g,
        "cd": 2 * k / (1.225 * 0.01) if case.n == 2 else None,
        "v_lim_low": case.v_lim,
    } | {each: getattr(case, each) for each in ("v0", "alpha0", "v_lim", "n", "g")}
    if true[name] is None:
        assert getattr(found, name) is None
    else:
        close(getattr(found, name), true[name], 1e-5, scale=abs(case.height) + oracle(case).x)


def check_film_missed(case: Scene) -> None:
    """Next to nothing is left over."""
    (x, _, _), found = filmed(case)
    size = np.ptp(x)
    assert found.success
    assert (found.points, found.dof, found.heading) == (40, 75, 1)
    assert found.fitted == ("v0", "alpha0", "k", "x0", "y0")
    assert np.abs(found.residuals).max() < 1e-9 * size
    assert max(found.rms, found.sigma) < 1e-9 * size
    assert np.isnan(found.chi2_reduced)
    close(found.launch.range(), oracle(case).x, 1e-5)


def check_film_spread(case: Scene) -> None:
    """Covariance and profile, by differences of the oracle along the path."""
    (x, y, t), _ = filmed(case)
    sigma = 1e-3 * float(np.ptp(x))
    found = hodograph.calibrate(x, y, t, g=case.g, sigma=sigma)

    def path(v0: float, alpha0: float, k: float) -> Any:
        longer = case._replace(v0=v0, alpha0=alpha0, v_lim=math.sqrt(case.g / k), height=1.0)
        return np.concatenate(oracle(longer).at(t)[:2])

    at = (found.v0, found.alpha0, found.k)
    columns = [
        differences(lambda value, i=i: path(*at[:i], value, *at[i + 1 :]), at[i], 1e-3 * at[i])[0]
        for i in range(3)
    ]
    J = np.stack([*columns, np.repeat([1.0, 0.0], 40), np.repeat([0.0, 1.0], 40)], axis=1)
    close(found.covariance, sigma**2 * np.linalg.inv(J.T @ J), 1e-5, scale=found.covariance.max())
    for name, variance in zip(found.fitted, np.diag(found.covariance), strict=True):
        close(found.uncertainty[name] ** 2, variance)
        low, high = found.profile(name)
        close((high - low) / 2, found.uncertainty[name], 0.05)
    close(found.aic, 10.0, 1e-6)


FILMED = {name: case for name, case in SCENES.items() if name in ON_FOOT and "slow" not in name}


# --- laws, the grid and the surrogate -----------------------------------------------------


def check_law(law: Callable[..., Any], bound: float, case: tuple[float, float, float]) -> None:
    close(law(*case[:2]), true_d_norm(*case), bound)


def check_angle_law(law: Callable[[float], Any], bound: float, v_lim: float, v: float) -> None:
    """The law's angle is off the oracle's best by no more than it says."""
    angle = float(law(v * v_lim))
    case = Scene(v, 0.0, 1.0, g=1.0)
    for _ in range(2):  # Newton's method on the oracle, from the law's angle
        slope, curvature = differences(lambda a: distance(case, alpha0=a), angle, 0.02)
        angle -= slope / curvature
    close(law(v * v_lim), angle, bound)


def check_first_order(degrees: float) -> None:
    """What weak drag takes, extrapolated to none."""
    angle = math.radians(degrees)
    lost = [(1 - true_d_norm(v, angle)) / v**2 for v in (0.02, 0.04, 0.08)]
    once = [(4 * lost[0] - lost[1]) / 3, (4 * lost[1] - lost[2]) / 3]
    close(laws.first_order(angle), (16 * once[0] - once[1]) / 15, 3e-8)


def check_low(v: float) -> None:
    """Exact as the launch becomes level, in the square of the angle."""
    for angle in (0.01, 0.02):
        close(laws.d_norm_low(v, angle), true_d_norm(v, angle), 2 * angle**2)


def check_pearson(field: str, degrees: float) -> None:
    """The paper's function, fitted to the oracle's ranges up to its v_norm of 1.5."""
    v = np.linspace(0.1, 1.5, 15)
    true = np.array([true_d_norm(x, math.radians(degrees)) for x in v])
    fit = laws.fit_pearson(v, true)
    close(laws.pearson_vii(v, fit.K, fit.M), true, 2e-3)
    close(fit.residuals, laws.pearson_vii(v, fit.K, fit.M) - true, 1e-9, scale=1e-3)
    best = np.sum(fit.residuals**2)
    for factor in (1 - 1e-4, 1 + 1e-4) if field in ("K", "M") else ():
        changed = {"K": fit.K, "M": fit.M} | {field: getattr(fit, field) * factor}
        assert np.sum((laws.pearson_vii(v, **changed) - true) ** 2) > best


def check_polynomial(degrees: float) -> None:
    v = np.linspace(0.1, 0.6, 12)
    true = np.array([true_d_norm(x, math.radians(degrees)) for x in v])
    fit = laws.fit_polynomial(v**2, true, 5)
    fitted = np.polynomial.Polynomial(fit.coefficients)(v**2)
    close(fitted, true, 1e-6)
    close(fit.residuals, fitted - true, 1e-12, scale=1.0)
    c1 = float(laws.first_order(math.radians(degrees)))
    close(fit.coefficients[:2], [1.0, -c1], 1e-3)


def check_grid(table: Callable[..., grid.Grid]) -> None:
    v, a = np.array([0.2, 0.9, 1.4]), np.array([0.1, 0.7, 1.3, np.pi / 2])
    found = table(v, a)
    close(found.v_norm, v)
    close(found.alpha0, a)
    true = [[true_d_norm(float(x), float(y)) for y in a] for x in v]
    close(found.d_norm, true, scale=1.0)


def by_npz(v: Any, a: Any) -> grid.Grid:
    with tempfile.TemporaryDirectory() as folder:
        return grid.load(grid.save_npz(grid.tabulate(v, a), folder + "/grid.npz"))


def by_csv(v: Any, a: Any) -> grid.Grid:
    with tempfile.TemporaryDirectory() as folder:
        file = grid.save_csv(grid.tabulate(v, a), folder + "/grid.csv")
        rows = np.loadtxt(file, delimiter=",", comments=["#", "v_norm"])
    table = rows.reshape(len(v), len(a), 3)
    return grid.Grid(table[:, 0, 0], np.deg2rad(table[0, :, 1]), table[:, :, 2])


def check_surrogate_angle(case: tuple[float, float, float]) -> None:
    close(surrogate.landing_angle(*case[:2]), level(*case).alpha, 1e-9)


# --- the other witnesses ------------------------------------------------------------------


@cache
def by_slope(case: Scene) -> ode.Solution:
    """The flight by eq. 16, in (v, alpha) for (v_x, v_y)."""
    return ode.solve(**still(case), rtol=1e-13, atol=1e-15, form="hodograph")


def check_solution(field: str, case: Scene) -> None:
    close(getattr(by_slope(case), field), getattr(oracle(case), field), 1e-11)


def check_solved_apex(field: str, case: Scene) -> None:
    found, expected = (getattr(flight.apex, field) for flight in (by_slope(case), oracle(case)))
    close(found, expected, 1e-11, scale=1e-3 * oracle(case).arc_length)


def check_motion(case: Scene) -> None:
    """The oracle obeys the equations of motion between its nodes, and begins and ends there."""
    flight = oracle(case)
    end = flight.t
    for part in (0.2, 0.5, 0.8):
        state = flight.at(part * end)
        rates, _ = differences(lambda t: np.array(flight.at(t)), part * end, 1e-3 * end)
        _, _, vx, vy = state
        v = math.hypot(vx, vy)
        drag = case.g / case.v_lim * (v / case.v_lim) ** (case.n - 1)
        expected = [vx, vy, -drag * vx, -case.g - drag * vy]
        close(rates, expected, 1e-8, scale=v + case.g + drag * v)
    first, last = flight.nodes[:, 0], flight.nodes[:, -1]
    v0, alpha0 = case.v0, case.alpha0
    close(first, [0, 0, case.height, v0 * math.cos(alpha0), v0 * math.sin(alpha0)])
    close(last[[0, 1, 2]], [flight.t, flight.x, 0], scale=flight.arc_length)
    assert np.all(np.diff(flight.nodes[0]) > 0)
    assert flight.nfev >= 12 * (flight.nodes.shape[1] - 1)
    assert (flight.status, flight.success) == (0, True)
    close(np.array(flight.at(flight.nodes[0])), flight.nodes[1:], INSIDE, scale=flight.arc_length)


exact_flight = cache(partial(reference.flight, dps=20))
exact_position = cache(partial(reference.position, dps=20))


def check_reference_flight(field: str, case: Scene) -> None:
    own = scaled(case)
    found, true = exact_flight(own.v0, own.alpha0, own.height), oracle(own)
    name, _, part = field.partition("_")
    top = {"x": true.apex.x, "y": true.apex.y - own.height, "t": true.apex.t}
    expected = top[part] if name == "apex" else getattr(true, field)
    close(getattr(found, field), expected, scale=1e-3 * true.arc_length if name == "apex" else 0)


def check_reference_position(field: str, case: Scene) -> None:
    for row in nodes(case):
        expected = dict(zip(("t", "x", "y", "speed", "arc_length"), row, strict=False))
        expected["alpha"] = row[-1]
        found = exact_position(case.v0 / case.v_lim, case.alpha0, row[-1])
        close(getattr(found, field), expected[field], INSIDE, scale=row[0] + row[1])


@cache
def exact_sensitivity(case: Scene) -> reference.Sensitivity:
    return reference.sensitivity(case.v0, case.alpha0, case.height, dps=20)


def check_reference_sensitivity(field: str, case: Scene) -> None:
    check_sensitivity(field, scaled(case), exact_sensitivity)


def check_reference(name: str, case: tuple[float, float, float]) -> None:
    true = {"d_norm": true_d_norm(*case), "landing_angle": level(*case).alpha}
    close(getattr(reference, name)(*case[:2], dps=20), true[name])


def check_reference_angle(v: float) -> None:
    check_greatest(float(reference.optimal_angle(v, dps=20)), Scene(v, 0.0, 1.0, g=1.0))


@cache
def stepped(case: Scene, method: str, cuts: int, **options: Any) -> steppers.Flights:
    dt = oracle(case).t / (cuts + 0.4)
    return steppers.integrate(**still(case), dt=dt, method=method, **options)


def tight(case: Scene) -> steppers.Flights:
    return stepped(case, "DOP853", 100, rtol=2.3e-14, atol=1e-15, history=True)


STEPPED = 1e-9  # SciPy's dense output, and a landing interpolated between its points


def check_integrate(method: str, case: Scene) -> None:
    tolerances = {} if method in steppers.FIXED else {"rtol": 1e-10, "atol": 1e-12}
    found = stepped(case, method, 400, **tolerances)
    bound = {"euler": 0.1, "euler_cromer": 0.1, "rk2": 1e-3, "rk4": 1e-6, "RK23": 1e-7}
    close(found.impact.x, oracle(case).x, bound.get(method, 1e-8))


def check_history(field: str, case: Scene) -> None:
    found, flight = tight(case), oracle(case)
    aloft = found.t <= flight.nodes[0, -1]
    assert np.count_nonzero(~aloft) == 1
    if field == "t":
        close(np.diff(found.t), flight.t / 100.4, 1e-12, scale=1.0)
        return
    true = dict(zip("xypq", flight.at(found.t[aloft]), strict=True))
    scale = flight.arc_length if field in "xy" else case.v0
    close(getattr(found, field)[aloft], true[field], STEPPED, scale)


def check_impact(field: str, case: Scene) -> None:
    found, flight = tight(case).impact, oracle(case)
    _, _, p, q = flight.nodes[1:, -1]
    true = {"t": flight.t, "x": flight.x, "y": 0.0, "p": p, "q": q}
    close(getattr(found, field), true[field], STEPPED, scale=flight.arc_length * (field == "y"))


def check_naive(case: Scene) -> None:
    """The last node above the ground."""
    found, flight = tight(case), oracle(case)
    last = found.impact_naive
    assert last.t < flight.t <= last.t + flight.t / 100.4
    true = flight.at(last.t)
    close([last.x, last.y, last.p, last.q], true, STEPPED, scale=flight.arc_length)
    assert found.steps == 101
    assert found.evaluations > 0


def check_flown(case: Scene) -> None:
    """It lands when the oracle does, and not before."""
    early = stepped(case, "DOP853", 50, t_max=0.9 * oracle(case).t)
    assert (early.status, early.success) == (steppers.ALOFT, False)
    assert (tight(case).status, tight(case).success) == (steppers.LANDED, True)


def check_order(method: str) -> None:
    """Half the step, and the error is divided by two to the order."""
    case = SCENES["level ground, n=2"]
    errors = [stepped(case, method, cuts).impact.x - oracle(case).x for cuts in (100, 200, 400)]
    order = steppers.FIXED[method].order
    assert np.log2(errors[1] / errors[2]) == pytest.approx(order, abs=0.2)


def check_reach(method: str) -> None:
    """A fall at the terminal speed, where linear drag undoes a disturbance at the rate g / v_lim.

    A step within reach follows the oracle; a longer one is refused.
    """
    case = Scene(1.2, 0.3, 1.0, g=1.0, height=60.0, n=1.0)
    reach = steppers.FIXED[method].reach
    options = {**still(case), "method": method}
    within = steppers.integrate(**options, dt=0.9 * reach)
    assert within.status == steppers.LANDED
    close(within.impact.t, oracle(case).t, 0.05)
    assert steppers.integrate(**options, dt=1.1 * reach).status == steppers.UNSTABLE


# --- the registry -------------------------------------------------------------------------


class Check(NamedTuple):
    """A function that holds one public name against the oracle, and the cases it is given."""

    hold: Callable[[Any], None]
    cases: Mapping[str, Any]


def each(*values: Any) -> dict[str, Any]:
    return {str(value): value for value in values}


def fields(prefix: str, hold: Callable[..., None], cases: Mapping[str, Any], names: str) -> Any:
    """The same check for some fields, each of which it is told."""
    return {f"{prefix}.{name}": Check(partial(hold, name), cases) for name in names.split()}


def alike(prefix: str, check: Check, names: str) -> Any:
    """One check that covers some fields together."""
    return {f"{prefix}.{name}": check for name in names.split()}


ANGLES = each(1, 10, 30, 45, 60, 80, 90)
OPTIMA = {f"v={v:g}, n={n:g}": (v, n) for v, n in product((0.2, 9.0), EXPONENTS)}
AIMED = {
    name: case
    for name, case in SCENES.items()
    if abs(case.alpha0) < 1.5 and case.slope == 0 and case.crosswind == 0
}
TARGETS = {name: QUADRATIC[f"{name}, n=2"] for name in ("level ground", "to a target above")}
HEIGHTS = {
    f"v={v:g}, {kind}": Scene(v * 42.7, 0.0, 42.7, height=h * (v * 42.7) ** 2 / 19.62)
    for v, (kind, h) in product((0.2, 5.0), {"below": 0.8, "level": 0.0, "above": -0.05}.items())
}
RELATIONS = {
    f"{method}, {name}": (method, case)
    for method in steppers.METHODS
    for name, case in ON_FOOT.items()
    if name in ("level ground, n=2", "downward, n=1", "level ground, n=3")
}
ON_LEVEL = {"level": scene(0.8, 0.6, 0.0, 2.0), "vertical": scene(0.8, math.pi / 2, 0.0, 2.0)}
STATUS = Check(check_status, SCENES | MISSED | OUTDOORS)
LENGTH = Check(check_path_length, SCENES)
STATE = Check(partial(check_state, "t"), SCENES | OUTDOORS)

CHECKS: dict[str, Check] = {
    "d_norm": Check(check_d_norm, EXACT | TIERS),
    "d_ref": Check(check_d_ref, ON_LEVEL),
    "landing_angle": Check(check_landing_angle, LEVEL),
    "optimal_angle": Check(check_optimal_angle, OPTIMA),
    # Launch, Landing and Trajectory.
    **fields(
        "Launch", check_launch_field, INPUTS, "v0 alpha0 v_lim g height n slope wind crosswind"
    ),
    "Launch.v_norm": Check(check_v_norm, SCENES),
    "Launch.from_drag": Check(check_from_drag, SCENES),
    "Launch.from_body": Check(check_from_body, QUADRATIC),
    "Launch.range": Check(check_range, SCENES | OUTDOORS),
    "Launch.flight_time": Check(check_flight_time, SCENES | OUTDOORS),
    "Launch.apex": Check(check_apex, SCENES | OUTDOORS),
    "Launch.landing": STATUS,
    "Launch.at": STATE,
    "Launch.trajectory": LENGTH,
    **fields("Landing", check_landing, SCENES | OUTDOORS, "x y z t speed alpha arc_length"),
    **alike("Landing", STATUS, "status success"),
    "Landing.error": Check(check_error, SHARP),
    **fields("State", check_state, SCENES | OUTDOORS, "x y z speed alpha s"),
    **alike("State", STATE, "t status success"),
    **fields("Trajectory", check_path, SCENES | OUTDOORS, "x y z speed alpha"),
    "Trajectory.t": Check(check_path_time, SCENES),
    "Trajectory.s": LENGTH,
    # Along the path.
    "path.position": Check(partial(check_position, "x"), {"": CURVED["steep, from above, n=2"]}),
    **fields("path.Position", check_position, CURVED, "x y t"),
    "path.speed": Check(check_speed, CURVED),
    "path.arc_length": Check(check_arc_length, CURVED),
    "bodies.terminal_speed": Check(check_terminal_speed, each(0.001, 0.005376, 0.3)),
    "bodies.drag_constant": Check(check_drag_constant, each(0.1, 0.47, 1.3)),
    **alike("bodies.Body", Check(check_body, bodies.CATALOGUE), "k v_lim mass diameter cd"),
    # The landing angle as the paper finds it, and the exponent of 45 degrees.
    "vial.newton_vial": Check(check_newton_vial, PAPER),
    **alike("vial.VialNewton", Check(check_newton_vial, PAPER), "alpha steps status"),
    "level.balanced_exponent": Check(check_balanced_exponent, each(0.0, 0.3, 1.0, 3.0)),
    # Sensitivity.
    "sensitivity.range_sensitivity": Check(partial(check_sensitivity, "range"), QUADRATIC),
    **fields(
        "sensitivity.Sensitivity", check_sensitivity, QUADRATIC, "range alpha0 v0 v_lim height"
    ),
    "best_angle": Check(check_best_angle, HEIGHTS),
    "aim": Check(partial(check_shot, "alpha0"), {"": SCENES["vacuum"]}),
    **fields("Shot", check_shot, AIMED, "alpha0 azimuth t speed alpha shortfall status success"),
    **dict.fromkeys(
        ("least_speed", *(f"LeastSpeed.{name}" for name in ("v0", "alpha0", "status", "success"))),
        Check(check_least_speed, TARGETS),
    ),
    **dict.fromkeys(
        ("envelope", *(f"Envelope.{name}" for name in ("y", "alpha0", "status", "success"))),
        Check(check_envelope, TARGETS),
    ),
    # Out of a film.
    "calibrate": Check(partial(check_calibrated, "k"), FILMED),
    **fields(
        "Calibration",
        check_calibrated,
        FILMED,
        "k v_lim v_lim_low v0 alpha0 x0 y0 t0 n cd g g_track",
    ),
    **alike(
        "Calibration",
        Check(check_film_missed, FILMED),
        "heading fitted residuals rms sigma chi2_reduced points dof success launch",
    ),
    **alike(
        "Calibration",
        Check(check_film_spread, {"": SCENES["level ground, n=2"]}),
        "uncertainty covariance aic profile",
    ),
    # Laws, and other authors' formulas: each within the error it states.
    "laws.table_1": Check(partial(check_law, laws.table_1, 5e-3), PAPER),
    "laws.d_norm_law": Check(partial(check_law, laws.d_norm_law, 7.7e-5), WEAK),
    "laws.d_norm_law_all": Check(partial(check_law, laws.d_norm_law_all, 8.5e-3), SQUARE),
    "laws.alpha_max_law": Check(
        partial(check_angle_law, laws.alpha_max_law, 9.7e-5, 1.0), each(0.1, 1.0, 10.0)
    ),
    "laws.alpha_max_vial": Check(
        partial(check_angle_law, laws.alpha_max_vial, 8e-4, 42.7), each(0.2, 0.8, 1.5)
    ),
    "laws.first_order": Check(check_first_order, ANGLES),
    **alike("laws", Check(partial(check_pearson, ""), each(20, 45, 70)), "pearson_vii fit_pearson"),
    **fields("laws.PearsonFit", check_pearson, each(20, 45, 70), "K M residuals"),
    "laws.fit_polynomial": Check(check_polynomial, each(20, 45, 70)),
    **alike(
        "laws.PolynomialFit", Check(check_polynomial, each(20, 45, 70)), "coefficients residuals"
    ),
    "laws.d_norm_chudinov": Check(partial(check_law, laws.d_norm_chudinov, 0.055), WEAK),
    "laws.d_norm_low": Check(check_low, each(0.5, 2.0, 10.0)),
    "laws.d_norm_upright": Check(
        partial(check_law, laws.d_norm_upright, TOL),
        {f"v={v:g}": (v, math.pi / 2, 2.0) for v in (0.1, 1.0, 8.0)},
    ),
    "laws.d_norm_first_order": Check(
        partial(check_law, laws.d_norm_first_order, 1e-5),
        {f"{degrees}°": (0.05, math.radians(degrees), 2.0) for degrees in ANGLES.values()},
    ),
    # The grid and the surrogate.
    "grid.tabulate": Check(check_grid, {"": grid.tabulate}),
    **alike("grid.Grid", Check(check_grid, {"": grid.tabulate}), "v_norm alpha0 d_norm"),
    **alike("grid", Check(check_grid, {"": by_npz}), "save_npz load"),
    "grid.save_csv": Check(check_grid, {"": by_csv}),
    "surrogate.d_norm": Check(partial(check_law, surrogate.d_norm, 1e-9), SQUARE),
    "surrogate.landing_angle": Check(check_surrogate_angle, SQUARE),
    # The oracle itself, and the other witnesses.
    "ode.solve": Check(check_motion, SLANTED),
    **alike("ode.Solution", Check(check_motion, SLANTED), "status success nfev nodes at"),
    **fields("ode.Solution", check_solution, SLANTED, "x t speed alpha arc_length"),
    **alike("ode.Solution", Check(partial(check_solved_apex, "y"), SLANTED), "apex"),
    **fields("ode.Apex", check_solved_apex, SLANTED, "x y t"),
    "reference.d_norm": Check(partial(check_reference, "d_norm"), EXTREME),
    "reference.landing_angle": Check(partial(check_reference, "landing_angle"), EXTREME),
    "reference.optimal_angle": Check(check_reference_angle, each(0.2, 1.0, 9.0)),
    "reference.flight": Check(partial(check_reference_flight, "x"), {"": QUADRATIC["slow, n=2"]}),
    **fields(
        "reference.Flight",
        check_reference_flight,
        QUADRATIC,
        "x t alpha speed arc_length apex_x apex_y apex_t",
    ),
    "reference.position": Check(partial(check_reference_position, "x"), {"": CURVED["slow, n=2"]}),
    **fields(
        "reference.Position", check_reference_position, CURVED, "x y t speed arc_length alpha"
    ),
    "reference.sensitivity": Check(
        partial(check_reference_sensitivity, "range"), {"": QUADRATIC["slow, n=2"]}
    ),
    **fields(
        "reference.Sensitivity",
        check_reference_sensitivity,
        QUADRATIC,
        "range alpha0 v0 v_lim height",
    ),
    "steppers.integrate": Check(lambda case: check_integrate(*case), RELATIONS),
    **fields("steppers.Flights", check_history, ON_FOOT, "t x y p q"),
    **fields("steppers.Point", check_impact, ON_FOOT, "t x y p q"),
    "steppers.Flights.impact": Check(partial(check_impact, "x"), ON_FOOT),
    **alike("steppers.Flights", Check(check_naive, ON_FOOT), "impact_naive steps evaluations"),
    **alike("steppers.Flights", Check(check_flown, ON_FOOT), "status success"),
    **alike(
        "steppers.Method",
        Check(check_order, each(*steppers.FIXED)),
        "order stages weights carry",
    ),
    "steppers.Method.reach": Check(check_reach, each(*steppers.FIXED)),
}

ONE_BY_ONE = (
    *("Launch", "Landing", "State", "Trajectory", "Calibration"),
    *("Shot", "LeastSpeed", "Envelope"),
)
INNER = {  # what a public module needs for itself
    "Launch.is_bare",
    "grid.about",
    # the same numbers with labels: test_sweep.py
    *("sweep.d_norm", "sweep.landings", "sweep.write", "grid.save_netcdf"),
    *("bodies.air_density", "bodies.Body.name", "bodies.Body.rules", "bodies.Body.measured"),
    # The oracle's own, in wind: against closed forms in test_ode.py.
    *("ode.Apex.z", "ode.Solution.z", "ode.Solution.air_length", "ode.Solution.state"),
    *(f"ode.State.{name}" for name in ("x", "y", "z", "v_x", "v_y", "v_z", "speed", "alpha")),
    *(f"ode.State.{name}" for name in ("arc_length", "air_length")),
    *(f"{name}.to_dict" for name in ONE_BY_ONE),  # what is checked above
    *(f"{name}.to_dict" for name in ("sensitivity.Sensitivity", "path.Position", "grid.Grid")),
}
KERNELS = {"cheapest", "on_level_ground", "best_on_level_ground", "best_alone"}  # for callers
ELSEWHERE = {  # public, and not in a module that is walked
    "steppers.Method": steppers.Method,
    "vial.newton_vial": newton_vial,
    "vial.VialNewton": VialNewton,
}


def public(name: str, thing: object) -> Iterator[str]:
    """A function by its name, a class by its fields and methods, a module by all it defines."""
    if isinstance(thing, types.ModuleType):
        exported = getattr(thing, "__all__", [key for key in vars(thing) if key[0] != "_"])
        for key in exported:
            part = getattr(thing, key)
            if getattr(part, "__module__", "").startswith(thing.__name__):
                yield from public(f"{name}.{key}", part)
    elif inspect.isclass(thing):
        members = {key for key in dir(thing) if key[0] != "_"} - set(dir(tuple))
        if dataclasses.is_dataclass(thing):
            members |= {field.name for field in dataclasses.fields(thing) if field.name[0] != "_"}
        yield from (f"{name}.{key}" for key in members)
    elif callable(thing):
        yield name


def each_once() -> Iterator[Any]:
    """Every check with each of its cases, under the first of the names that share it."""
    first: dict[int, str] = {}
    for name, check in CHECKS.items():
        if first.setdefault(id(check), name) == name:
            for label, case in check.cases.items():
                yield pytest.param(check.hold, case, id=f"{name}-{label}" if label else name)


@pytest.mark.parametrize(("hold", "case"), list(each_once()))
def test_against_the_equations_of_motion(hold, case):
    hold(case)


OF_A_LAUNCH = [
    name for name in CHECKS if name.startswith(("Launch.apex", "Landing.", "Trajectory."))
]


def scenes_of_every_kind(n: float) -> Iterator[Scene]:
    angles = (-1.2, -0.3, 0.0, 0.02, 0.5, 1.0, 1.4)
    if n % 1 == 0:  # the oracle is no judge where the drag of a vertical launch is not smooth
        angles += (math.pi / 2,)
    for v, alpha0, height in product((0.05, 0.4, 1.5, 4.0, 9.0), angles, (0.02, 0.5, 3.0)):
        yield scene(v, alpha0, height, n)
    for v, alpha0 in product((0.05, 0.4, 1.5, 4.0, 9.0), (angle for angle in angles if angle > 0)):
        on_level = scene(v, alpha0, 0.0, n)
        yield on_level
        yield on_level._replace(height=-0.4 * oracle(on_level).apex.y)


@pytest.mark.slow
@pytest.mark.parametrize("n", [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.5, 7.0, 10.0])
def test_scenes_of_every_kind(n):
    """All that a launch answers, over its speeds, angles and heights."""
    failed = []
    for case, name in product(scenes_of_every_kind(n), OF_A_LAUNCH):
        try:
            CHECKS[name].hold(case)
        except AssertionError as error:
            failed.append(f"{name}, {case}: {error}")
    assert len(failed) == 0, f"{len(failed)} failed: " + "\n".join(failed[:10])


def test_no_public_name_is_without_a_check():
    things = {name: getattr(hodograph, name) for name in hodograph.__all__} | ELSEWHERE
    for path in Path(hodograph.__file__).parent.glob("[!_]*.py"):  # every module of the listing
        things.setdefault(path.stem, importlib.import_module(f"hodograph.{path.stem}"))
    names = {found for name, thing in things.items() for found in public(name, thing)}
    for home in ("launch", "level", "reach"):  # whose names are the package's own
        kept = {*hodograph.__all__, *(KERNELS if home == "level" else ())}
        names -= {
            name for name in names if name.split(".")[0] == home and name.split(".")[1] in kept
        }
    assert sorted(names - CHECKS.keys() - INNER) == []
    assert sorted(CHECKS.keys() - names) == []
