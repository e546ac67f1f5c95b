"""What must hold for every launch, searched for counterexamples."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from hodograph import Launch, d_norm, landing_angle, optimal_angle, path

speeds = st.floats(-8, 8).map(lambda e: 10.0**e)
any_speed = st.floats(0, 1e20) | speeds
angles = st.floats(0, np.pi / 2) | st.floats(-14, 0).map(lambda e: 10.0**e)
launch_angles = st.floats(-np.pi / 2, np.pi / 2)


@given(any_speed, angles)
def test_d_norm_lies_in_0_1(v, alpha0):
    value = d_norm(v, alpha0)
    assert 0 <= value <= 1 + 1e-15
    assert value > 0


@given(speeds, st.floats(1e-3, 1), angles)
def test_d_norm_falls_as_v_norm_grows(v, more, alpha0):
    slower, faster = d_norm([v, v * (1 + more)], alpha0)
    assert faster <= slower * (1 + 4e-15)


@given(any_speed, angles)
def test_lands_at_least_as_steep_as_launched(v, alpha0):
    alpha = landing_angle(v, alpha0)
    assert -np.pi / 2 <= alpha <= -alpha0 * (1 - 1e-15)


heights = st.just(0.0) | st.floats(1e-200, 50)


@given(st.floats(0.1, 100), launch_angles, st.floats(1, 100), st.floats(0.1, 30), heights)
def test_scales_with_g_and_v_lim(v0, alpha0, v_lim, g, height):
    assume(alpha0 == 0 or abs(alpha0) > 1e-200)  # or a result is subnormal
    # lengths go with v_lim^2/g: double the speeds and halve g, and they grow eightfold
    one = Launch(v0, alpha0, v_lim, g=g, height=height).landing()
    other = Launch(2 * v0, alpha0, 2 * v_lim, g=g / 2, height=8 * height).landing()
    assert other.x == 8 * one.x  # powers of two: to the bit
    assert other.t == 4 * one.t
    assert other.alpha == one.alpha
    assert other.speed == 2 * one.speed


@given(st.floats(0, 1e6), launch_angles, st.floats(1e-3, 1e6), heights | st.floats(-1e3, 1e6))
def test_range_is_never_negative(v0, alpha0, v_lim, height):
    assume(v0 == 0 or v0 >= 1e-30)
    assume(abs(height) * 9.81 / v_lim**2 <= 1e20)
    assume(height == 0 or abs(height) > 1e-200)  # or squares of it are subnormal
    landing = Launch(v0, alpha0, v_lim, height=height).landing()
    assert landing.success == (landing.status == 0)
    if landing.success:
        assert landing.x >= 0
        assert landing.t >= 0
        assert landing.arc_length >= max(height, 0) * (1 - 1e-12)
    else:
        assert height < 0
        assert np.isnan(landing.x)


@given(st.lists(st.tuples(any_speed, angles), min_size=1, max_size=40), st.randoms())
def test_order_does_not_change_a_bit_and_company_hardly_does(launches, random):
    v, alpha0 = np.array(launches).T
    together = d_norm(v, alpha0)
    landing = landing_angle(v, alpha0)
    order = list(range(len(launches)))
    random.shuffle(order)
    np.testing.assert_array_equal(d_norm(v[order], alpha0[order]), together[order])
    for i in range(len(launches)):
        assert d_norm(v[i], alpha0[i]) == pytest.approx(together[i], rel=4e-15)
        assert landing_angle(v[i], alpha0[i]) == pytest.approx(landing[i], rel=4e-15)


def test_chunking_does_not_change_a_bit():
    rng = np.random.default_rng(5)
    v, alpha0 = 10 ** rng.uniform(-3, 3, 40_000), rng.uniform(0, np.pi / 2, 40_000)
    launch = Launch(v, alpha0, 1.0, height=rng.uniform(0, 2, 40_000))
    whole = launch.range()
    for part in (slice(50, 100), slice(7, 2003), slice(16_000, 39_000), slice(39_900, None)):
        piece = Launch(v[part], alpha0[part], 1.0, height=launch.height[part])
        np.testing.assert_array_equal(piece.range(), whole[part])
        np.testing.assert_array_equal(d_norm(v[part], alpha0[part]), d_norm(v, alpha0)[part])


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0, 7.0])
def test_company_changes_a_flight_by_no_more_than_rounding(n):
    """The sums over nodes are products of matrices, whose order depends on how many there are."""
    rng = np.random.default_rng(9)
    v, height = 10 ** rng.uniform(-2, 3, (2, 24))
    launches = Launch(v, rng.uniform(-1.5, 1.57, 24), 1.0, g=1.0, n=n, height=height)
    together, landings = launches.trajectory(12), launches.landing()
    for i, launch in enumerate(launches):
        alone = launch.trajectory(12)
        for name in ("t", "x", "y", "speed", "alpha", "s"):
            one = getattr(alone, name)
            room = 1e-13 if name == "alpha" else 1e-14  # close to the apex the slope turns quickly
            np.testing.assert_allclose(
                getattr(together, name)[i], one, rtol=0, atol=room * np.abs(one).max()
            )
        for name in ("x", "t", "speed", "alpha", "arc_length"):
            one = getattr(launch.landing(), name)
            assert getattr(landings, name)[i] == pytest.approx(one, rel=1e-14, abs=0)


@given(st.floats(-4, 4).map(lambda e: 10.0**e), st.floats(0.01, 1.55))
def test_read_backwards_a_trajectory_lands_where_it_began(v, alpha0):
    # from the landing back up: the arcs between the slopes, each launched from its own upper end;
    # a slope rounded to double is known to one part in 1/(2 v^2 eps) of the layer of drag
    flown = Launch(v, alpha0, 1.0, g=1.0).trajectory(12)
    x = y = 0.0
    for k in reversed(range(11)):
        leg = path.position(flown.speed[k], flown.alpha[k], flown.alpha[k + 1])
        x, y = x + leg.x, y + leg.y
    # and each of the 11 legs brings some roundings, 16 at most
    room = (11 * 16 + 4 * v * v) * np.finfo(float).eps * flown.s[-1]
    assert abs(x - flown.x[-1]) <= room
    assert abs(y) <= room


@given(speeds, launch_angles, launch_angles)
def test_speed_is_bounded_by_launch_and_terminal(v, one, two):
    alpha0, alpha = max(one, two), min(one, two)
    assume(alpha < alpha0)
    assert 0 <= path.speed(v, alpha0, alpha) <= max(v, 1.0) * (1 + 4e-15)


@given(speeds)
def test_best_angle_is_stationary_and_below_45_degrees(v):
    best = optimal_angle(v)
    assert 0 < best <= np.pi / 4
    around = best * (1 + np.array([-1e-4, 0, 1e-4]))
    ranges = Launch(v, around, 1.0, g=1.0).range()
    assert ranges[1] >= max(ranges[0], ranges[2]) * (1 - 1e-14)


def test_no_scale_is_too_large_or_too_small(seed):
    """Fresh scenes of any size: every flight ends with a status, finite, and without a warning."""
    rng = np.random.default_rng(seed)
    n = 20_000
    v0, v_lim = 10 ** rng.uniform(-30, 30, n), 10 ** rng.uniform(-30, 40, n)
    v0[::100], v_lim[::50] = 0, np.inf
    g, height = 10 ** rng.uniform(-30, 30, n), 10 ** rng.uniform(-60, 30, n)
    height *= rng.choice([-1, 0, 1], n)
    alpha0 = rng.uniform(-np.pi / 2, np.pi / 2, n)
    alpha0[::70], alpha0[1::70] = -np.pi / 2, np.pi / 2
    alpha0[height == 0] = np.abs(alpha0[height == 0])
    allowed = (v0 / v_lim <= 1e20) & (np.abs(height) * g / v_lim / v_lim <= 1e20)
    v0, alpha0, v_lim, g, height = (part[allowed] for part in (v0, alpha0, v_lim, g, height))
    landing = Launch(v0, alpha0, v_lim, g=g, height=height).landing()
    assert v0.size > n / 4
    assert np.isin(landing.status, [0, 1]).all()
    for name in ("x", "t", "speed", "alpha", "arc_length", "error"):
        assert np.isfinite(getattr(landing, name)[landing.success]).all(), name
    path = Launch(v0, alpha0, v_lim, g=g, height=height).trajectory(3)
    assert np.isfinite(path.x[landing.success]).all()
    assert np.array_equal(path.speed[landing.success, 0], v0[landing.success])
    unreachable = landing.status == 1
    apex = Launch(v0, alpha0, v_lim, g=g).apex()[1]
    assert np.array_equal(unreachable, -height > apex)
