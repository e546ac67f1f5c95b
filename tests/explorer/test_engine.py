"""The engine in JavaScript against the library, in the browser that runs it."""

import math

import numpy as np
import pytest
from mpmath import MPContext
from scipy.integrate import solve_ivp

import hodograph
from hodograph import steppers

pytestmark = pytest.mark.browser

RIGHT = 1e-12
LONGEST = 400  # s that the equations of motion are integrated for
FLY = """scenes => scenes.map(([v0, alpha0, v_lim, n, g, height, slope, wind]) => {
    const scene = {v0, alpha0, vLim: v_lim ?? Infinity, n, g, height, slope, wind};
    const landing = meet(scene), top = apex(scene), v = v0 / scene.vLim;
    const found = landing
        ? [landing.x, landing.t, Math.hypot(landing.vx, landing.vy), landing.alpha]
        : [NaN, NaN, NaN, NaN];
    const fast = landing ? [landing.vx, landing.vy] : [NaN, NaN];
    return [...found, top.x, top.y, top.t, dNorm(v, alpha0, n), v, ...fast];
})"""
NAMES = ("x", "t", "speed", "alpha", "apex x", "apex y", "apex t", "d_norm", "v_norm")
ENDS = {  # of the sliders
    "v0": (0, 1000),
    "alpha0": (-math.pi / 2, math.pi / 2),
    "v_lim": (0.01, 1e4, math.inf),
    "height": (-1000, 0, 1000),
    "g": (0.01, 9.81, 100),
}


def flown(page, scenes):
    rows = [[None if value == math.inf else float(value) for value in row] for row in scenes]
    return np.array(page.evaluate(FLY, rows), dtype=float)


def spread(seed, count):
    """Scenes all over the sliders, with their ends, in still air on level ground."""
    rng = np.random.default_rng(seed)

    def mixed(even, ends):
        return np.where(rng.random(count) < 0.15, rng.choice(ends, count), even)

    v0 = mixed(1000 * rng.random(count) ** 3, ENDS["v0"])
    alpha0 = mixed(np.deg2rad(rng.uniform(-90, 90, count)), ENDS["alpha0"])
    v_lim = mixed(10 ** rng.uniform(-2, 4, count), ENDS["v_lim"])
    height = mixed(1000 * rng.uniform(-1, 1, count) ** 3, ENDS["height"])
    height[rng.random(count) < 0.3] = 0.0
    g = np.where(rng.random(count) < 0.8, 9.81, rng.choice(ENDS["g"], count))
    return np.stack(
        [v0, alpha0, v_lim, rng.choice([1.0, 2.0], count), g, height, 0 * v0, 0 * v0], axis=1
    )


def of_library(scenes):
    """The same quantities, and the library's own estimate of the error of the landing."""
    v0, alpha0, v_lim, n, g, height, *_ = scenes.T
    launch = hodograph.Launch(v0, alpha0, v_lim, n=n, g=g, height=height)
    landing, v = launch.landing(), launch.v_norm
    d_norm = np.where(alpha0 >= 0, hodograph.d_norm(v, np.maximum(alpha0, 0), n=n), np.nan)
    found = landing.x, landing.t, landing.speed, landing.alpha, *launch.apex(), d_norm, v
    return np.stack(found, axis=1), landing.error


def off(got, want, scale):
    """The error relative to `scale`; what is NaN on both sides, or the same number, has none."""
    same = (got == want) | (np.isnan(got) & np.isnan(want))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(same, 0.0, np.abs(got - want) / scale)


def test_ten_thousand_launches(visit, seed, record_property):
    scenes = spread(seed, 10_000)
    corners = np.array(np.meshgrid(*ENDS.values(), [1, 2])).reshape(6, -1)
    v0, alpha0, v_lim, height, g, n = corners
    corners = np.stack([v0, alpha0, v_lim, n, g, height, 0 * v0, 0 * v0], axis=1)
    scenes = np.concatenate([scenes, corners])
    want, error = of_library(scenes)
    got = flown(visit(), scenes)[:, :9]
    scale = np.abs(want)
    scale[:, 5] = np.abs(want[:, 5] - scenes[:, 5]) + np.abs(scenes[:, 5])  # of two terms
    errors = off(got, want, scale)
    allowed = np.full_like(errors, RIGHT)
    # just under the apex the landing is known to so many digits and no more, and level
    ill = error > RIGHT / 10
    allowed[ill, :4] = np.maximum(RIGHT, 3 * error[ill, np.newaxis])
    allowed[ill, 3] = 100 * np.sqrt(error[ill])
    worst = np.where(allowed > RIGHT, 0, errors).max(axis=0)
    record_property("worst", dict(zip(NAMES, worst.tolist(), strict=True)))
    late = np.argwhere(~(errors <= allowed))
    assert [(NAMES[k], scenes[i].tolist(), got[i, k], want[i, k]) for i, k in late[:3]] == []
    assert np.isfinite(got[:, :4]).all(axis=1).sum() > 7000


def in_wind(rng, count, n):
    """Ordinary scenes with a wind and a slope."""
    rows = []
    for _ in range(count):
        v0 = rng.choice([0.0, rng.uniform(1, 40), rng.uniform(40, 300)], p=[0.1, 0.6, 0.3])
        v_lim, alpha0 = rng.uniform(3, 80), np.deg2rad(rng.uniform(-90, 90))
        height = rng.choice([0, 2, 50, 1000], p=[0.5, 0.2, 0.2, 0.1])
        slope = np.deg2rad(rng.choice([0, 10, -10, 40, -40, 70, -75]))
        wind = rng.choice([0, 5, -5, 30, -30])
        rows.append([v0, alpha0, v_lim, n, 9.81, height, slope, wind])
    return np.array(rows)


def integrated(row):
    """x, t, speed and angle of the landing by the equations of motion; NaN if there is none."""
    v0, alpha0, v_lim, n, g, height, slope, wind = row
    rise = math.tan(slope)

    def rates(t, state):
        across, up = state[2] - wind, state[3]
        drag = g / v_lim * (math.hypot(across, up) / v_lim) ** (n - 1)
        return [state[2], up, -drag * across, -g - drag * up]

    def gap(t, state):
        return state[1] + height - state[0] * rise if t > 1e-9 else 1.0

    gap.terminal, gap.direction = True, -1
    begin = [0, 0, v0 * math.cos(alpha0), v0 * math.sin(alpha0)]
    leaving = begin[3] - begin[2] * rise
    if leaving == 0:
        leaving = rates(0, begin)[3] - rates(0, begin)[2] * rise
    if height == 0 and leaving <= 0:
        return [0, 0, v0, alpha0]
    solution = solve_ivp(
        rates, (0, LONGEST), begin, "DOP853", events=gap, rtol=1e-13, atol=1e-12, max_step=0.05
    )
    if not solution.t_events[0].size:
        return [math.nan] * 4
    x, _, across, up = solution.y_events[0][0]
    return [x, solution.t_events[0][0], math.hypot(across, up), math.atan2(up, abs(across))]


@pytest.mark.parametrize("n", [1, 2])
def test_wind_and_slope_against_the_equations_of_motion(visit, seed, n):
    scenes = in_wind(np.random.default_rng(seed), 60, n)
    want = np.array([integrated(row) for row in scenes])
    got = flown(visit(), scenes)[:, :4]
    short = ~(got[:, 1] > LONGEST)
    scenes, got, want = scenes[short], got[short], want[short]
    assert (np.isnan(got) == np.isnan(want)).all()
    scale = np.abs(want) + 1e-3
    scale[:, 0] += np.abs(scenes[:, 7] * want[:, 1])
    moving = want[:, 1] > 0  # a body at rest on the ground has no direction
    assert off(got, want, scale)[moving].max() < 2e-11  # what the integration leaves


def test_linear_drag_in_a_wind_against_the_closed_form(visit, seed):
    context = MPContext()
    context.dps = 40
    scenes = in_wind(np.random.default_rng(seed), 200, 1)
    got = flown(visit(), scenes)
    checked = 0
    for row, (x, t, speed, alpha, *_) in zip(scenes.tolist(), got.tolist(), strict=True):
        v0, alpha0, v_lim, _, g, height, slope, wind = map(context.mpf, row)
        if not t > 0:
            continue
        tau, across, up = v_lim / g, v0 * context.cos(alpha0) - wind, v0 * context.sin(alpha0)

        def place(t, tau=tau, across=across, up=up, wind=wind, v_lim=v_lim):
            part = -context.expm1(-t / tau)
            return across * tau * part + wind * t, (up + v_lim) * tau * part - v_lim * t

        def gap(t, place=place, slope=slope, height=height):
            x, y = place(t)
            return y + height - x * context.tan(slope)

        exact = context.findroot(gap, context.mpf(t))
        decay = context.exp(-exact / tau)
        velocity = across * decay + wind, (up + v_lim) * decay - v_lim
        steepness = abs(velocity[1] - velocity[0] * context.tan(slope)) / context.hypot(*velocity)
        if steepness < 1e-2:  # it grazes the ground: the landing is known to fewer digits
            continue
        length = context.hypot(*velocity) * exact + abs(wind * exact)
        assert abs(place(exact)[0] - x) <= RIGHT * length
        assert abs(exact - t) <= RIGHT * exact
        assert abs(context.hypot(*velocity) - speed) <= RIGHT * (speed + abs(row[7]))
        assert abs(context.atan2(velocity[1], abs(velocity[0])) - alpha) <= 1e-11
        checked += 1
    assert checked > 100


@pytest.mark.parametrize("ends", [False, True])
def test_wind_and_slope_against_the_library(visit, seed, ends):
    """All over the sliders again, where the way the ground is met leaves it digits to agree in."""
    scenes, rng = spread(seed, 10_000), np.random.default_rng(seed + 1)
    v0, alpha0, v_lim, n, g, height, *_ = scenes.T
    scenes[:, 6] = np.deg2rad(rng.choice([-80, 80, *rng.uniform(-80, 80, 20), 0, 0], len(v0)))
    scenes[:, 7] = rng.choice([-50, 50, *rng.uniform(-50, 50, 20), 0, 0], len(v0))
    scenes = scenes[(v0 > 1e-2) | (height > 0)]  # not at rest on the ground
    if not ends:
        v0, alpha0, v_lim, _, _, height, *_ = scenes.T
        ordinary = (v0 > 1) & (np.abs(alpha0) < 1.57) & (v_lim < math.inf) & (height >= 0)
        scenes = scenes[ordinary]
    v0, alpha0, v_lim, n, g, height, slope, wind = scenes.T
    launch = hodograph.Launch(v0, alpha0, v_lim, n=n, g=g, height=height, slope=slope, wind=wind)
    landing = launch.landing()
    want = np.stack([landing.x, landing.t, landing.speed, landing.alpha, *launch.apex()[:2]], 1)
    want = np.concatenate([want, launch.apex()[-1][:, np.newaxis]], axis=1)
    got = flown(visit(), scenes)
    rise = np.tan(slope)
    (x, t, speed), (across, up), got = got.T[:3], got.T[9:], got[:, :7]
    # what rounding in the frame of the air makes of the time, through how fast the ground is met
    closing = np.abs(up - across * rise)
    size = np.abs(height) + (np.abs(x) + np.abs(wind * t)) * (1 + np.abs(rise)) + speed * t
    well = ~(4e-16 * size > 2e-14 * closing * t)
    assert well.mean() > 0.6
    assert (np.isnan(got[well, 0]) == np.isnan(want[well, 0])).all()
    scale = np.abs(want)
    scale[:, [0, 4]] += np.abs(wind[:, np.newaxis] * want[:, [1, 6]])
    scale[:, 0] += 1e-6 * speed * t  # straight up, x is rounding
    scale[:, 2] += np.abs(wind)
    scale[:, 3] += 0.1  # rad
    scale[:, 5] += np.abs(height)
    errors = off(got, want, scale)[well]
    assert errors.max(axis=0).max() <= RIGHT, errors.max(axis=0)


def test_published_landings_on_a_slope(visit):
    slopes = {20: 11.952328, -20: 19.123275, 45: 3.345209}
    scenes = [[15, math.radians(50), 20, 2, 9.81, 0, math.radians(b), 0] for b in slopes]
    got = flown(visit(), scenes)[:, 0]
    assert got == pytest.approx(list(slopes.values()), abs=5e-7)


def test_a_wind_too_strong_to_land_in(visit):
    down, steep = math.radians(-60), math.radians(-20)
    scenes = [[10, 0, 10, n, 9.81, 5, down, 30] for n in (1, 2)]  # it glides above the slope
    scenes += [[10, 0, 10, n, 9.81, 5, steep, 20] for n in (1, 2)]
    got = flown(visit(), scenes)[:, 0]
    assert np.isnan(got[:2]).all()
    assert (got[2:] > 0).all()


@pytest.mark.parametrize("n", [1, 2])
def test_best_angle(visit, n):
    cases = [(40, 42.7, 0), (40, 42.7, 10), (1, 42.7, 0), (300, 30, 2), (1000, 1, 0)]
    best = """([v0, vLim, height, n]) =>
        bestAngle({v0, vLim, n, height, alpha0: 0, g: 9.81, slope: 0, wind: 0})"""
    page = visit()
    for v0, v_lim, height in cases:
        want = hodograph.best_angle(v0, v_lim, n=n, height=height)
        assert page.evaluate(best, [v0, v_lim, height, n]) == pytest.approx(want, abs=1e-10)


def test_best_angle_has_no_better_neighbour(visit):
    """In a wind, on a slope: dR/dalpha0 = 0, by differences of the range itself."""
    turn = """scene => { const a = bestAngle(scene), h = 1e-3;
        const R = alpha0 => meet({...scene, alpha0}).x;
        return [a, (R(a + h) - R(a - h)) / 2 / h / R(a), R(a) - Math.max(R(a - h), R(a + h))] }"""
    page = visit()
    for n in (1, 2):
        for slope, wind, height in ((0.2, 5, 0), (-0.2, -15, 10), (0.3, 0, 1), (-0.5, 10, 0)):
            scene = {"v0": 30, "vLim": 25, "n": n, "g": 9.81, "alpha0": 0}
            scene |= {"slope": slope, "wind": wind, "height": height}
            _, rate, more = page.evaluate(turn, scene)
            assert abs(rate) < 1e-5  # of third order in h
            assert more > 0
    assert page.evaluate("scene => bestAngle(scene)", scene | {"v0": 0}) is None
    assert page.evaluate("scene => bestAngle(scene)", scene | {"height": -1000}) is None


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("height", [0.0, 3.0])
def test_methods_are_those_of_steppers(visit, n, height):
    run = """([name, dt, n, height]) => {
        const scene = {v0: 40, alpha0: 0.7, vLim: 42.7, n, g: 9.81, height, slope: 0, wind: 0};
        const {x, naive, steps, status} = stepped(scene, name, dt);
        return [x, naive, steps, status] }"""
    page = visit()
    for name in ("euler", "euler_cromer", "rk2", "rk4"):
        for dt in (0.3, 0.01):
            want = steppers.integrate(
                40.0, 0.7, 42.7, dt=dt, method=name, n=float(n), height=height
            )
            x, naive, steps, status = page.evaluate(run, [name, dt, n, height])
            assert status == "landed"
            assert x == pytest.approx(want.impact.x, rel=RIGHT)
            assert naive == pytest.approx(want.impact_naive.x, rel=RIGHT)
            assert steps == want.steps


def test_a_method_says_when_its_step_is_too_long(visit):
    page = visit()
    scene = {"v0": 300, "alpha0": 0.7, "vLim": 5, "n": 2, "g": 9.81}
    scene |= {"height": 0, "slope": 0, "wind": 0}
    for name in ("euler", "euler_cromer", "rk2", "rk4"):
        want = steppers.integrate(300.0, 0.7, 5.0, dt=0.1, method=name)
        got = page.evaluate("([scene, name]) => stepped(scene, name, 0.1).status", [scene, name])
        assert want.status == steppers.UNSTABLE
        assert got == "unstable"


def test_paths_are_the_library_s(visit):
    """Every point of a path is where the library puts it, at that time and on that path."""
    page = visit()
    for n, v0, v_lim, degrees, height in (
        (2, 40, 42.7, 40, 0), (1, 40, 42.7, 40, 2), (2, 300, 10, 80, 0), (2, 20, 30, -30, 50),
        (2, 40, None, 40, 0),
    ):  # fmt: skip
        scene = {"v0": v0, "alpha0": math.radians(degrees), "n": n, "g": 9.81, "height": height}
        script = """([scene, v]) => { scene = {...scene, slope: 0, wind: 0, vLim: v ?? Infinity};
            return path(scene, meet(scene)).map(p => [p.t, p.x, p.y]) }"""
        t, x, y = np.array(page.evaluate(script, [scene, v_lim])).T
        launch = hodograph.Launch(v0, math.radians(degrees), v_lim or math.inf, n=n, height=height)
        fine = launch.trajectory(4000)
        size = np.ptp(fine.x) + np.ptp(fine.y)
        assert (np.diff(t) > 0).all()
        assert np.interp(t, fine.t, fine.x) == pytest.approx(x, abs=2e-5 * size)
        assert np.interp(t, fine.t, fine.y) == pytest.approx(y, abs=2e-5 * size)
