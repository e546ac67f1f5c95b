"""Targets: closed forms in vacuum, published figures, and shots flown by `ode` that must hit.

Kinds: met climbing and falling, above, level and below, near, at the envelope, straight up and
down, slow and fast, each exponent, in winds along and across, and targets that move.
"""

import itertools
import time

import numpy as np
import pytest

import hodograph
from hodograph import Launch, aim, best_angle, envelope, least_speed, ode
from hodograph.bodies import terminal_speed
from hodograph.engine import aim as slopes
from hodograph.engine import aim_alone, pursuit, timing

G = 9.81
ARCS = ("low", "high")
EXPONENTS = (1.0, 1.5, 2.0, 3.0, 7.0)


def missed(v0, v_lim, n, shot, place, wind=0.0, crosswind=0.0, velocity=(0.0, 0.0, 0.0)):
    """How far the shot passes from the target, by the equations of motion, in sizes of flight."""
    alpha0, azimuth, t = float(shot.alpha0), float(shot.azimuth), float(shot.t)
    cos, sin = np.cos(azimuth), np.sin(azimuth)
    x, y = place[0] + velocity[0] * t, place[1] + velocity[1] * t
    high = 3 * abs(y) + 5 * G * t * t + 1
    flight = ode.solve(
        v0, alpha0, v_lim, g=G, n=n, height=high, rtol=2.3e-14, atol=1e-16,
        wind=wind * cos + crosswind * sin, crosswind=crosswind * cos - wind * sin,
    )  # fmt: skip
    state = flight.state(t)
    off = (
        float(state.x) * cos - float(state.z) * sin - x,
        float(state.y) - high - y,
        float(state.x) * sin + float(state.z) * cos - velocity[2] * t,
    )
    size = np.hypot(*place) + min(v0 * t, high)
    return np.linalg.norm(off) / size, abs(state.speed / shot.speed - 1), state.alpha - shot.alpha


def places(v0, v_lim, rng, count):
    """Random targets of which most are within reach."""
    size = min(v0**2 / G, v_lim**2 / G * np.log1p(v0 / v_lim))
    return rng.uniform(-0.8, 0.8, count) * size, rng.uniform(-0.6, 0.4, count) * size


@pytest.mark.parametrize("arc", ARCS)
@pytest.mark.parametrize("n", EXPONENTS)
@pytest.mark.parametrize("v_norm", [0.1, 1.0, 4.0])
def test_shots_in_still_air_hit(v_norm, n, arc):
    rng = np.random.default_rng(7)
    v0, v_lim = v_norm * 40.0, 40.0
    x, y = places(v0, v_lim, rng, 6)
    shots = aim(v0, x, y, v_lim, arc=arc, n=n)
    assert shots.success.sum() >= 3
    for i in np.flatnonzero(shots.success):
        shot = aim(v0, float(x[i]), float(y[i]), v_lim, arc=arc, n=n)
        off, speed, alpha = missed(v0, v_lim, n, shot, (x[i], y[i]))
        assert off < 3e-13
        assert speed < 1e-11
        assert abs(alpha) < 1e-11
        assert shot.alpha0 == pytest.approx(shots.alpha0[i], abs=1e-12)
        assert (shot.azimuth == 0) == (x[i] > 0)


KINDS = {
    "tailwind": (8.0, 0.0, (0.0, 0.0, 0.0)),
    "headwind": (-12.0, 0.0, (0.0, 0.0, 0.0)),
    "crosswind": (3.0, -9.0, (0.0, 0.0, 0.0)),
    "faster than the launch": (45.0, 0.0, (0.0, 0.0, 0.0)),
    "coming": (0.0, 0.0, (-6.0, 1.0, 0.0)),
    "going": (0.0, 0.0, (6.0, -1.0, 0.0)),
    "crossing in a wind": (5.0, 4.0, (1.0, 2.0, 9.0)),
}


@pytest.mark.parametrize("arc", ARCS)
@pytest.mark.parametrize(("kind", "n"), [*itertools.product(KINDS, (2.0,)), ("crosswind", 1.5)])
def test_shots_in_a_wind_and_at_moving_targets_hit(kind, n, arc):
    wind, crosswind, velocity = KINDS[kind]
    rng = np.random.default_rng(11)
    v0, v_lim = 30.0, 40.0
    x, y = places(v0, v_lim, rng, 5)
    shots = aim(v0, x, y, v_lim, arc=arc, n=n, wind=wind, crosswind=crosswind, velocity=velocity)
    assert shots.success.any()
    for i in np.flatnonzero(shots.success):
        shot = hodograph.Shot(**{k: np.asarray(v)[i] for k, v in vars(shots).items()})
        off, speed, alpha = missed(
            v0, v_lim, n, shot, (x[i], y[i]), wind, crosswind, velocity
        )  # fmt: skip
        assert off < 3e-13
        assert speed < 1e-10
        assert abs(alpha) < 1e-10


def test_published_figures():
    low, high = (aim(40.0, 10.0, 20.0, 40.0, arc=arc) for arc in ARCS)
    np.testing.assert_allclose(
        np.rad2deg([low.alpha0, high.alpha0]), [65.52533, 86.72944], atol=5e-6
    )
    k = 0.3 * 1.196 * np.pi * 0.0375**2 / 2 / 0.145
    found = least_speed(120.0, 2.0, terminal_speed(k))
    assert found.v0 == pytest.approx(46.385716, abs=5e-7)
    assert np.rad2deg(found.alpha0) == pytest.approx(40.94419, abs=5e-6)


def test_vacuum():
    rng = np.random.default_rng(3)
    v0, x, y = 30.0, rng.uniform(1.0, 80.0, 50), rng.uniform(-60.0, 40.0, 50)
    D = v0**4 - G * (G * x**2 + 2 * y * v0**2)
    for arc, sign in (("low", -1), ("high", 1)):
        found = aim(v0, x, y, np.inf, arc=arc)
        np.testing.assert_array_equal(found.success, D >= 0)
        root = np.sqrt(np.maximum(D, 0.0))
        tangent = np.where(sign > 0, (v0**2 + root) / (G * x), 0.0)
        if sign < 0:
            tangent = (G * x**2 + 2 * y * v0**2) / (x * (v0**2 + root))
        inside = D > 0
        np.testing.assert_allclose(found.alpha0[inside], np.arctan(tangent[inside]), rtol=1e-12)
        parabola = v0**2 / 2 / G - G * x**2 / 2 / v0**2
        np.testing.assert_allclose(found.shortfall[~inside], (y - parabola)[~inside], rtol=1e-11)
    np.testing.assert_allclose(envelope(v0, x, np.inf).y, parabola, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(envelope(v0, x, np.inf).alpha0, np.arctan(v0**2 / G / x), rtol=1e-12)
    found = least_speed(x, y, np.inf)
    np.testing.assert_allclose(found.v0, np.sqrt(G * (y + np.hypot(x, y))), rtol=1e-12)
    np.testing.assert_allclose(found.alpha0, np.pi / 4 + np.arctan2(y, x) / 2, rtol=1e-12)
    slope = np.array([-1.2, -0.3, 0.2, 0.9])
    np.testing.assert_allclose(
        best_angle(v0, np.inf, slope=slope), np.pi / 4 + slope / 2, rtol=1e-12
    )


@pytest.mark.parametrize("n", EXPONENTS)
@pytest.mark.parametrize("wind", [0.0, -5.0])
def test_the_envelope_is_where_both_arcs_meet(n, wind):
    x = np.array([20.0, 50.0])
    top = envelope(40.0, x, 42.7, n=n, wind=wind)
    assert top.success.all()
    for arc in ARCS:
        on = aim(40.0, x, top.y, 42.7, arc=arc, n=n, wind=wind)
        assert on.success.all()
        np.testing.assert_allclose(on.alpha0, top.alpha0, atol=1e-6)
        above = aim(40.0, x, top.y + 0.5, 42.7, arc=arc, n=n, wind=wind)
        assert (above.status == 1).all()
        np.testing.assert_allclose(above.shortfall, 0.5, rtol=1e-9)
        assert np.isnan(above.alpha0).all()
    slowest = least_speed(x, top.y, 42.7, n=n, wind=wind)
    np.testing.assert_allclose(slowest.v0, 40.0, rtol=1e-12)
    np.testing.assert_allclose(slowest.alpha0, top.alpha0, rtol=1e-10)


@pytest.mark.parametrize("wind", [0.0, 7.0, -7.0])
@pytest.mark.parametrize("slope", [0.0, 0.3, -0.4])
def test_the_best_angle_is_the_best(slope, wind):
    best = float(best_angle(35.0, 42.7, height=1.5, slope=slope, wind=wind))
    around = best + np.array([-2e-3, 0.0, 2e-3])
    x = [
        ode.solve(35.0, a, 42.7, height=1.5, slope=slope, wind=wind, rtol=2.3e-14, atol=1e-16).x
        for a in around
    ]
    assert x[1] > max(x[0], x[2])
    vertex = (x[0] - x[2]) / (x[0] - 2 * x[1] + x[2]) / 2  # of the parabola, in steps
    assert abs(vertex) < 1e-2


def test_straight_up_and_down():
    for arc, expected in (("low", [90.0, -90.0]), ("high", [90.0, 90.0])):
        found = aim(40.0, 0.0, [20.0, -20.0], 40.0, arc=arc)
        np.testing.assert_allclose(np.rad2deg(found.alpha0), expected)
    top = 40.0**2 / 2 / G * np.log(2.0)  # v_norm is 1
    assert envelope(40.0, 0.0, 40.0).y == pytest.approx(top, rel=1e-13)
    out = aim(40.0, 0.0, 60.0, 40.0)
    assert out.status == 1
    assert out.shortfall == pytest.approx(60.0 - top, rel=1e-12)


def test_at_the_muzzle_and_out_of_every_reach():
    here = aim(40.0, 0.0, 0.0, 40.0)
    assert (here.t, here.alpha0, here.speed) == (0.0, 0.0, 40.0)
    back = aim(40.0, 0.0, 0.0, 40.0, arc="high")
    assert back.t == pytest.approx(Launch(40.0, np.pi / 2, 40.0).flight_time(), rel=1e-13)
    near = aim(40.0, 1e-9, 0.0, 40.0)
    assert near.alpha0 == pytest.approx(G * 1e-9 / 2 / 1600, rel=1e-9)
    lost = aim(40.0, 500.0, 0.0, 40.0)
    assert lost.status == 1
    assert lost.shortfall == np.inf
    assert envelope(40.0, 500.0, 40.0).status == 1
    assert least_speed(0.0, 0.0, 40.0).v0 == 0.0


@pytest.mark.parametrize("n", [1.0, 2.0, 3.0])
@pytest.mark.parametrize("v_norm", [1e-6, 1e-3, 30.0, 1e4])
def test_slow_and_fast(v_norm, n):
    """Places on the paths of launches are targets for these launches."""
    launch = Launch(v_norm, np.array([-0.9, 0.01, 0.6, 1.2, 1.55]), 1.0, g=1.0, n=n)
    part = launch.at(alpha=np.array([-1.2, 0.0, 0.4, -1.0, 1.2]))
    assert part.success.all()
    for i in range(5):
        shots = [aim(v_norm, part.x[i], part.y[i], 1.0, arc=arc, n=n, g=1.0) for arc in ARCS]
        off = [abs(shot.alpha0 / launch.alpha0[i] - 1) for shot in shots]
        assert min(off) < 1e-11


def test_two_ways_agree():
    """By the slope, and by the time that the flight takes."""
    rng = np.random.default_rng(4)
    X, Y, v = rng.uniform(0.1, 0.4, 20), rng.uniform(-0.3, 0.3, 20), rng.uniform(0.0, 2.0, 20)
    zero, two = np.zeros(20), np.full(20, 2.0)
    rest = (zero, zero, zero)
    for side in (-1.0, 1.0):
        by_slope = slopes.meet(slopes.Target(v, two, X, Y, two * side / 2))
        chase = pursuit.Chase(v, two, (X, Y, zero), rest, rest, 100 + zero)
        t, throw, codes = timing.arcs(chase, two * side)
        np.testing.assert_array_equal(codes, by_slope.status)
        ok = codes == 0
        angle = np.arctan2(throw.u[1], throw.u[0])
        np.testing.assert_allclose(angle[ok], np.arctan(by_slope.T[ok]), atol=1e-12)
        np.testing.assert_allclose(t[ok], by_slope.t[ok], rtol=1e-12)


def test_plain_floats_agree_with_the_arrays():
    rng = np.random.default_rng(9)
    v, X, Y = rng.uniform(0.01, 3.0, 200), rng.uniform(0.02, 0.5, 200), rng.uniform(-0.5, 0.4, 200)
    told = 0
    for high in (False, True):
        side = np.full(200, 1.0 if high else -1.0)
        found = slopes.meet(slopes.Target(v, np.full(200, 2.0), X, Y, side))
        for i in range(200):
            alone = aim_alone.meet(float(v[i]), float(X[i]), float(Y[i]), high)
            if alone is None:
                continue
            told += 1
            assert found.status[i] == 0
            there = np.arctan(found.T[i]), found.t[i], found.speed[i], np.arctan(found.p[i])
            np.testing.assert_allclose(alone, there, rtol=1e-11, atol=1e-12)
    assert told > 200


def test_what_is_refused_and_what_passes():
    with pytest.raises(ValueError, match="arc must be 'low' or 'high'; got 'flat'"):
        aim(40.0, 10.0, 2.0, 40.0, arc="flat")
    for velocity in (3.0, (1.0, 2.0), np.zeros(4)):
        with pytest.raises(TypeError, match="velocity must be three components"):
            aim(40.0, 10.0, 2.0, 40.0, velocity=velocity)
    with pytest.raises(ValueError, match=r"velocity\[1\] must be .* m/s; got inf"):
        aim(40.0, 10.0, 2.0, 40.0, velocity=(0.0, np.inf, 0.0))
    found = aim(40.0, [10.0, np.nan], 2.0, 40.0)
    np.testing.assert_array_equal(found.status, [0, 3])
    assert np.isnan(found.shortfall[1])
    assert found.to_dict()["status"] == [0, 3]
    assert aim(40.0, np.ones((2, 1)), np.ones(3), 40.0).t.shape == (2, 3)


@pytest.mark.parametrize(
    ("v0", "v_lim", "options"),
    [
        (190.8, 2.56e-4, {"g": 24.3, "height": 0.17, "slope": -0.5}),  # fast beyond all
        (0.28, 40.0, {"slope": 0.17, "wind": 191.0}),  # a wind faster than the launch
        (69.0, 31.7, {"wind": -470.6}),  # against it: best almost level
        (0.1, 40.0, {"height": 3.0, "wind": -100.0}),  # all is blown back
        (7.5, 0.0211, {"wind": 0.887, "height": 5.26, "n": 1.0}),
        (1.2, 1.43, {"height": -0.046, "slope": -0.396, "wind": -0.35}),  # some fall short
        (8430.0, 453.5, {"height": -9725.0, "slope": 1.18}),
        (89.3, 6.1, {"slope": -1.26, "n": 1.0}),  # steep landings
        (57.0, 0.72, {"height": 63.0, "slope": -0.92, "n": 1.5}),
        (204.5, 13.63, {"height": 0.333, "slope": 0.972, "wind": -1786.0, "n": 1.5}),  # lost behind
        (0.911, 0.427, {"height": -1.16e-4, "slope": 0.76, "wind": -0.49}),  # few angles land
    ],
)
def test_no_other_angle_goes_farther(v0, v_lim, options):
    best = float(best_angle(v0, v_lim, **options))
    far = Launch(v0, best, v_lim, **options).landing()
    assert far.success
    angles = np.concatenate(
        [np.linspace(-np.pi / 2, np.pi / 2, 501), best + np.array([-1e-5, 1e-5])]
    )
    other = Launch(v0, np.clip(angles, -np.pi / 2, np.pi / 2), v_lim, **options).landing()
    assert np.nanmax(other.x) <= far.x + 1e-13 * abs(far.x)


def test_the_best_angle_is_a_launch_forward():
    """A wind of 190 m/s carries a launch backward farther; at 90 degrees it is best forward."""
    assert best_angle(0.2828, 40.0, slope=0.17, wind=190.9) == pytest.approx(np.pi / 2)
    for options in ({"slope": -1.569, "wind": 714.0, "n": 1.5}, {"slope": -0.9, "wind": 300.0}):
        assert np.isnan(best_angle(30.0, 40.0, **options))  # down the slope for ever


def test_flat_launches_on_the_ground_in_a_wind_fly():
    for alpha0 in (1e-9, 3e-4):
        found = Launch(30.0, alpha0, 40.0, wind=1.0).landing()
        truth = ode.solve(30.0, alpha0, 40.0, wind=1.0, rtol=2.3e-14, atol=1e-16)
        assert found.x == pytest.approx(float(truth.x), rel=1e-9)
        assert found.t == pytest.approx(2 * 30.0 * alpha0 / G, rel=1e-3)


@pytest.mark.parametrize(
    "call",
    [
        lambda: least_speed(0.0, 1e10, 45.0),
        lambda: least_speed(30.0, 30.0, 3.7e-4, wind=30.0, g=3.66),
        lambda: aim(1e-30, 1e-3, 1.3157, 1e-9, wind=7.5),
        lambda: aim(0.061, -2.37, 0.036, 1e-3, crosswind=-35.4, velocity=(0.06, 18.0, 3.4)),
    ],
)
def test_hopeless_targets_are_soon_told(call):
    begin = time.perf_counter()
    assert call().status == 1
    assert time.perf_counter() - begin < 4.0  # some tenths of a second


def test_least_speeds_in_a_wind_are_the_least():
    """Among them one whose time is shorter than a wind leaves to a slow launch."""
    places = [(8.57, -17.26, 10.5, 305.0, 1.0), (63.1, -22.4, 18.0, -226.0, 2.0)]
    places += [(30.0, 10.0, 40.0, -12.0, 2.0), (30.0, 10.0, 40.0, 25.0, 1.5)]
    for x, y, v_lim, wind, n in places:
        found = least_speed(x, y, v_lim, wind=wind, n=n)
        assert found.success
        for factor, status in ((1 - 1e-9, 1), (1 + 1e-9, 0)):
            assert aim(found.v0 * factor, x, y, v_lim, wind=wind, n=n).status == status
