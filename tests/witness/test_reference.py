"""The mpmath path against closed forms, expansions, a Taylor integration and itself."""

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import astuple
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from hodograph import reference

RIGHT_ANGLE = math.pi / 2
SPEEDS = [1e-8, 0.1, 1.0, 50.0, 1e8]
ANGLES = [1e-6, 0.5, RIGHT_ANGLE - math.radians(1e-9), RIGHT_ANGLE]


@pytest.fixture(autouse=True)
def _digits():
    """Comparisons here are made at 70 digits."""
    with mpmath.mp.workdps(70):
        yield


def distance(a, b):
    """Largest relative difference between two results, field by field."""
    pairs = zip(astuple(a), astuple(b), strict=True)
    return max((abs(p - q) / abs(q) if q else abs(p)) for p, q in pairs)


# --- the digits asked for ---------------------------------------------------------------


@pytest.mark.parametrize("v_norm", SPEEDS)
@pytest.mark.parametrize("alpha0", ANGLES)
def test_30_digits_agree_with_50(v_norm, alpha0):
    level = reference.flight(v_norm, alpha0)
    assert distance(level, reference.flight(v_norm, alpha0, dps=50)) < 1e-28
    near_apex = -level.apex_y * (1 - mpmath.mpf(2) ** -40)
    short, long = (reference.flight(v_norm, alpha0, near_apex, dps=d) for d in (30, 50))
    assert distance(short, long) < 1e-28


@pytest.mark.parametrize("v_norm", [1e-8, 1.0, 1e8])
@pytest.mark.parametrize("height", [-0.01, 1.0, 1e5])
def test_30_digits_agree_with_50_upward(v_norm, height):
    height = height if height > 0 else height * min(v_norm, 1) ** 2
    short, long = (reference.flight(v_norm, 0.5, height, dps=d) for d in (30, 50))
    assert distance(short, long) < 1e-28


@pytest.mark.parametrize("v_norm", [1e-8, 1.0, 1e8])
@pytest.mark.parametrize("alpha0", [-1e-6, -0.5, -RIGHT_ANGLE])
@pytest.mark.parametrize("height", [1e-12, 0.3, 1e5])
def test_30_digits_agree_with_50_downward(v_norm, alpha0, height):
    short, long = (reference.flight(v_norm, alpha0, height, dps=d) for d in (30, 50))
    assert distance(short, long) < 1e-28


@pytest.mark.parametrize("v_norm", SPEEDS)
def test_30_digits_agree_with_50_between_close_slopes(v_norm):
    for alpha in (1.5 * (1 - 1e-12), 0.1, -1.4):
        short, long = (reference.position(v_norm, 1.5, alpha, dps=d) for d in (30, 50))
        assert distance(short, long) < 1e-28


@pytest.mark.parametrize("v_norm", [1e-8, 1.0, 50.0])
def test_30_digits_of_optimal_angle_agree_with_50(v_norm):
    short, long = (reference.optimal_angle(v_norm, dps=d) for d in (30, 50))
    assert abs(short / long - 1) < 1e-28


# --- closed forms -----------------------------------------------------------------------


@pytest.mark.parametrize("v_norm", [1e-4, 0.3, 1.0, 1.5, 20.0, 1e8])
def test_vertical_flight(v_norm):
    """d_norm in closed form, and the textbook rise and fall. The float pi/2 is 6e-17 rad off."""
    v = mpmath.mpf(v_norm)
    root = mpmath.sqrt(1 + v**2)
    expected = (mpmath.asinh(v) + mpmath.atan(v)) / (2 * v * root)
    assert abs(reference.d_norm(v_norm, RIGHT_ANGLE) / expected - 1) < 1e-28
    up = reference.flight(v_norm, RIGHT_ANGLE)
    assert abs(up.apex_y / (mpmath.log1p(v**2) / 2) - 1) < 1e-28
    assert abs(up.apex_t / mpmath.atan(v) - 1) < 1e-28
    assert abs(up.t / (mpmath.atan(v) + mpmath.asinh(v)) - 1) < 1e-28
    assert abs(up.speed / (v / root) - 1) < 1e-28
    assert abs(up.arc_length / mpmath.log1p(v**2) - 1) < 1e-28


def test_vertical_fall_from_a_height():
    v, height = mpmath.mpf(2), mpmath.mpf("0.7")
    up = reference.flight(v, RIGHT_ANGLE, height)
    fall = mpmath.log1p(v**2) / 2 + height
    assert abs(up.t / (mpmath.atan(v) + mpmath.acosh(mpmath.exp(fall))) - 1) < 1e-28
    assert abs(up.speed / mpmath.sqrt(-mpmath.expm1(-2 * fall)) - 1) < 1e-28


def test_vertical_throw_down_at_the_terminal_speed():
    down = reference.flight(1, -RIGHT_ANGLE, 3)
    assert abs(down.t - 3) < 1e-28
    assert abs(down.speed - 1) < 1e-28


def test_long_fall_ends_at_terminal_velocity():
    """Far down, every further unit of height takes one unit of time, and x stays."""
    low, high = (reference.flight(3, 0.6, h) for h in (1000, 100_000))
    assert abs(high.t - low.t - 99_000) < 1e-24
    assert high.x == low.x
    assert abs(high.speed - 1) < 1e-28


@pytest.mark.parametrize("alpha0", [0.01, 0.3, 0.8, 1.2, 1.55])
def test_weak_drag(alpha0):
    """d_norm = 1 − c1 v² + O(v⁴)."""
    a = mpmath.mpf(alpha0)
    sin, cos = mpmath.sin(a), mpmath.cos(a)
    c1 = 3 * sin / 4 + cos**2 / (8 * sin)
    c1 += mpmath.atanh(sin) * cos**2 * (mpmath.mpf(1) / 2 - cos**2 / (8 * sin**2))
    v = mpmath.mpf("1e-12")
    found = (1 - reference.d_norm(v, alpha0, dps=60)) / v**2
    assert abs(found / c1 - 1) < 1e-22


@pytest.mark.parametrize("alpha0", [0.3, 1.2])
def test_vacuum_limit(alpha0):
    """Heights as well: the parabola, to O(v²)."""
    v = mpmath.mpf("1e-20")
    a, height = mpmath.mpf(alpha0), v**2 / 5
    found = reference.flight(v, alpha0, height, dps=45)
    vy = v * mpmath.sin(a)
    t = vy + mpmath.sqrt(vy**2 + 2 * height)
    assert abs(found.t / t - 1) < 1e-38
    assert abs(found.x / (t * v * mpmath.cos(a)) - 1) < 1e-38
    assert abs(found.apex_y / (vy**2 / 2) - 1) < 1e-38


def test_hodograph_and_arc_length():
    """Eq. 13 and 19, written as the paper writes them."""
    v, a0, a1 = (mpmath.mpf(q) for q in ("1.3", "0.9", "-0.4"))

    def bracket(u):
        half = u / 2 + mpmath.pi / 4
        return mpmath.log(mpmath.tan(half)) + mpmath.sin(u) / mpmath.cos(u) ** 2

    u = 1 - v**2 * mpmath.cos(a0) ** 2 * (bracket(a1) - bracket(a0))
    found = reference.position(v, a0, a1)
    speed = v * mpmath.cos(a0) / mpmath.cos(a1) / mpmath.sqrt(u)
    assert abs(found.speed / speed - 1) < 1e-28
    assert abs(found.arc_length / (mpmath.log(u) / 2) - 1) < 1e-28


# --- the equations of motion ------------------------------------------------------------


@pytest.mark.parametrize(
    ("v_norm", "alpha0", "height"), [(1, 0.75, 0), (3, 1.2, 0.5), (1, -0.5, 1)]
)
def test_taylor_integration_in_time(v_norm, alpha0, height):
    """mpmath's Taylor method, fed with nothing but eq. 2 in cartesian form, lands as well."""
    found = reference.flight(v_norm, alpha0, height)
    with mpmath.mp.workdps(22):

        def rates(_t, s):
            v = mpmath.hypot(s[2], s[3])
            return [s[2], s[3], -v * s[2], -1 - v * s[3]]

        v, a = mpmath.mpf(v_norm), mpmath.mpf(alpha0)
        start = [0, mpmath.mpf(height), v * mpmath.cos(a), v * mpmath.sin(a)]
        x, y, vx, vy = mpmath.odefun(rates, 0, start)(found.t)
        assert abs(x / found.x - 1) < 1e-18
        assert abs(y) < 1e-18
        assert abs(mpmath.hypot(vx, vy) / found.speed - 1) < 1e-18
        assert abs(mpmath.atan2(vy, vx) / found.alpha - 1) < 1e-18


def test_landing_is_the_position_at_the_landing_slope():
    for v_norm, alpha0, height in [(0.2, 0.5, 0), (5, 1.4, 0.3), (2, -0.3, 2)]:
        land = reference.flight(v_norm, alpha0, height, dps=40)
        there = reference.position(v_norm, alpha0, land.alpha, dps=40)
        assert abs(there.y + height) < 1e-36
        for name in ("x", "t", "speed", "arc_length"):
            assert abs(getattr(there, name) / getattr(land, name) - 1) < 1e-36
        top = reference.position(v_norm, alpha0, min(alpha0, 0), dps=40)
        assert abs(top.y - land.apex_y) < 1e-36


@pytest.mark.parametrize("v_norm", ["1e-3", "1", "50"])
def test_optimal_angle_is_the_top_of_the_range(v_norm):
    """The range falls to either side by the same amount, to the third order in the step."""
    best = reference.optimal_angle(v_norm, dps=50)
    step = mpmath.mpf("1e-12")
    low, top, high = (
        reference.flight(v_norm, best + k * step, dps=50).x / reference.flight(v_norm, best).x
        for k in (-1, 0, 1)
    )
    assert top > low
    assert top > high
    assert abs((top - low) / (top - high) - 1) < 1e-9


# --- limits, edges, inputs --------------------------------------------------------------


def test_limits():
    assert reference.d_norm(0, 0.5) == 1
    assert reference.d_norm(2, 0) == 1
    assert reference.landing_angle(0, 0.5) == -0.5
    assert reference.landing_angle(2, 0) == 0
    with mpmath.mp.workdps(30):
        assert reference.optimal_angle(0) == mpmath.pi / 4
    assert abs(reference.d_norm(2, 1e-12) - 1) < 1e-10


@pytest.mark.parametrize("alpha0", [0, -0.4])
def test_no_way_up_from_the_plane(alpha0):
    still = reference.flight(2, alpha0)
    assert (still.x, still.t, still.alpha, still.speed) == (0, 0, alpha0, 2)
    assert still.arc_length == still.apex_x == still.apex_y == still.apex_t == 0


def test_downward_launch_has_its_apex_at_the_launch():
    down = reference.flight(2, -0.4, 1)
    assert down.apex_x == down.apex_y == down.apex_t == 0
    assert down.x > 0


def test_target_within_1e_25_of_the_apex():
    top = reference.flight(1, 0.7, dps=60)
    near = reference.flight(1, 0.7, -top.apex_y * (1 - mpmath.mpf("1e-25")), dps=30)
    fall = mpmath.sqrt(2 * top.apex_y * mpmath.mpf("1e-25"))
    assert abs((near.t - top.apex_t) / fall - 1) < 1e-11
    with pytest.raises(ValueError, match="height must be at least"):
        reference.flight(1, 0.7, -top.apex_y * (1 + mpmath.mpf("1e-25")))


def test_inputs_are_exact():
    tenth = reference.flight("0.1", 0.5)
    assert tenth == reference.flight(Fraction(1, 10), 0.5)
    assert tenth != reference.flight(0.1, 0.5)
    assert reference.flight(0.1, 0.5) == reference.flight(mpmath.mpf(0.1), np.float64(0.5))
    assert reference.flight(2, 0.5) == reference.flight(np.int64(2), mpmath.mpf(0.5))


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ((-1, 0.5), ValueError, "v_norm must be > 0, got -1"),
        ((0, 0.5), ValueError, "v_norm must be > 0, got 0"),
        ((math.nan, 0.5), ValueError, "v_norm must be a finite number, got nan"),
        (("fast", 0.5), ValueError, "v_norm must be a finite number, got 'fast'"),
        (([1.0], 0.5), TypeError, "v_norm must be a real number or a string, got list"),
        ((1, 1.6), ValueError, r"alpha0 must be in \[-pi/2, pi/2\], got 1.6"),
        ((1, np.nextafter(RIGHT_ANGLE, 2)), ValueError, "alpha0 must be in"),
        ((1, 1 + 2 * math.pi), ValueError, "alpha0 must be in"),
        ((1, 0.5, math.inf), ValueError, "height must be a finite number"),
        ((1, 0.5, -1), ValueError, "height must be at least -0.09"),
        ((1, -0.5, -1), ValueError, "height must be at least 0"),
    ],
)
def test_flight_refuses(arguments, error, message):
    with pytest.raises(error, match=message):
        reference.flight(*arguments)


def test_others_refuse():
    with pytest.raises(ValueError, match=r"alpha must be in \(-pi/2, alpha0\], got 0.6"):
        reference.position(1, 0.5, 0.6)
    with pytest.raises(ValueError, match=r"alpha0 must be in \[0, pi/2\] on level ground"):
        reference.d_norm(1, -0.1)
    with pytest.raises(ValueError, match=r"alpha0 must be in \[0, pi/2\] on level ground"):
        reference.landing_angle(1, -0.1)
    with pytest.raises(ValueError, match="v_norm must be >= 0"):
        reference.optimal_angle(-1)
    with pytest.raises(ValueError, match="dps must be a whole number of digits"):
        reference.d_norm(1, 0.5, dps=0)


def test_leaves_mpmath_alone_and_runs_in_threads():
    mpmath.mp.dps = 17  # the caller's own, which is to be left alone
    work = [(v, dps) for v in (0.5, 5.0) for dps in (15, 30, 45)] * 4
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda q: reference.flight(q[0], 0.7, dps=q[1]), work))
    assert found == [reference.flight(v, 0.7, dps=dps) for v, dps in work]
    assert mpmath.mp.dps == 17


# --- other powers -----------------------------------------------------------------------

RISES = [(1.5, 0.9, 0.3), (0.7, -0.5, 0.8)]


@pytest.mark.parametrize("n", [1, pytest.param(2.5, marks=pytest.mark.slow), 7])
@pytest.mark.parametrize(("v_norm", "alpha0", "height"), RISES)
def test_taylor_integration_of_any_power(n, v_norm, alpha0, height):
    found = reference.flight(v_norm, alpha0, height, n=n)
    with mpmath.mp.workdps(16):
        power = (mpmath.mpf(n) - 1) / 2

        def rates(_t, s):
            drag = (s[2] ** 2 + s[3] ** 2) ** power
            return [s[2], s[3], -drag * s[2], -1 - drag * s[3]]

        v, a = mpmath.mpf(v_norm), mpmath.mpf(alpha0)
        start = [0, mpmath.mpf(height), v * mpmath.cos(a), v * mpmath.sin(a)]
        x, y, vx, vy = mpmath.odefun(rates, 0, start)(found.t)
        assert abs(x / found.x - 1) < 1e-14
        assert abs(y) < 1e-14
        assert abs(mpmath.hypot(vx, vy) / found.speed - 1) < 1e-14
        assert abs(mpmath.atan2(vy, vx) / found.alpha - 1) < 1e-14


@pytest.mark.parametrize("v_norm", [1e-6, 1.0, 1e4, 1e15])
@pytest.mark.parametrize("alpha0", [1e-6, 0.8, -1.2, RIGHT_ANGLE, -RIGHT_ANGLE])
@pytest.mark.parametrize("t", ["1e-8", "0.3", "20"])
def test_linear_drag_is_elementary_in_time(v_norm, alpha0, t):
    found = reference.position(v_norm, alpha0, t=t, n=1)
    v, a, t = mpmath.mpf(v_norm), mpmath.mpf(alpha0), mpmath.mpf(t)
    vx, vy, gone = v * mpmath.cos(a), v * mpmath.sin(a), -mpmath.expm1(-t)
    assert abs(found.x / (vx * gone) - 1) < 1e-28
    assert abs(found.y / ((vy + 1) * gone - t) - 1) < 1e-28
    now = vx * (1 - gone), (vy + 1) * (1 - gone) - 1
    assert abs(found.speed / mpmath.hypot(*now) - 1) < 1e-28
    assert abs(found.alpha / mpmath.atan2(now[1], now[0]) - 1) < 1e-28


@pytest.mark.parametrize("v_norm", [0.3, 2.0, 1e6])
@pytest.mark.parametrize("n", [1, 3, 4])
def test_straight_down_from_rest_or_thrown(v_norm, n):
    """The fall is the integral of v / (1 - v^n) dv, and the time that of 1 / (1 - v^n)."""
    speed = (1 + mpmath.mpf(v_norm)) / 2  # between the launch and the terminal speed
    path = [mpmath.mpf(v_norm), *([10, 2] if v_norm > 10 else []), speed]
    v0 = mpmath.mpf(v_norm)
    path = [v0 * (speed / v0) ** (mpmath.mpf(i) / 40) for i in range(41)]
    with mpmath.workdps(40):
        drop = mpmath.quad(lambda v: v / (1 - v**n), path)
        time = mpmath.quad(lambda v: 1 / (1 - v**n), path)
    found = reference.flight(v_norm, -RIGHT_ANGLE, drop, n=n)
    assert abs(found.t / time - 1) < 1e-28
    assert abs(found.speed / speed - 1) < 1e-28


@pytest.mark.parametrize("v_norm", [1e-8, 1.0, 1e8, 1e15])
@pytest.mark.parametrize(("alpha0", "height"), [(0.7, 0), (RIGHT_ANGLE, 1), (-0.5, 1e3)])
def test_quadratic_drag_by_the_way_of_the_others(v_norm, alpha0, height):
    """A power within 1e-45 of 2 has no closed form."""
    near = reference.flight(v_norm, alpha0, height, n=2 + mpmath.mpf("1e-45"))
    assert distance(near, reference.flight(v_norm, alpha0, height)) < 1e-28


@pytest.mark.slow
@pytest.mark.parametrize("n", [1, 1.2, 3, 10])
@pytest.mark.parametrize("v_norm", [1e-8, 1.0, 1e15])
@pytest.mark.parametrize(
    ("alpha0", "height"), [(1e-6, 0), (RIGHT_ANGLE, 1e3), (-RIGHT_ANGLE, 1e-3), (0, 1e15)]
)
def test_30_digits_agree_with_45_for_other_powers(n, v_norm, alpha0, height):
    short, long = (reference.flight(v_norm, alpha0, height, n=n, dps=d) for d in (30, 45))
    assert distance(short, long) < 1e-28


# --- a place on the path ----------------------------------------------------------------


@pytest.mark.parametrize("n", [1.5, 2])
@pytest.mark.parametrize(
    ("v_norm", "alpha0", "alpha"),
    [(1e-3, 0.8, 0.3), (50.0, 0.8, -1.2), (1e8, 1.2, 1.1), (1.0, -0.3, -1.5), (2.0, 0.5, -1.57)],
)
def test_a_place_by_each_of_its_coordinates(n, v_norm, alpha0, alpha):
    point = reference.position(v_norm, alpha0, alpha, n=n, dps=45)
    places = {"t": point.t, "x": point.x, "s": point.arc_length, "y": point.y}
    for name, value in places.items():
        rising = name == "y" and alpha > 0
        found = reference.position(v_norm, alpha0, **{name: value}, rising=rising, n=n, dps=25)
        assert distance(found, point) < 1e-23, name


def test_a_place_near_the_apex_and_at_the_launch():
    top = reference.position(3, 1, 0, n=3, dps=60)
    later = reference.position(3, 1, t=top.t * (1 + mpmath.mpf("1e-30")), n=3)
    assert abs(later.alpha / (-top.t * mpmath.mpf("1e-30") / top.speed) - 1) < 1e-25
    start = reference.position(3, 1, t=0, n=3)
    assert (start.x, start.y, start.alpha, start.speed) == (0, 0, 1, 3)
    again = reference.position(3, 1, y=0, n=3)
    assert abs(again.x / reference.flight(3, 1, n=3).x - 1) < 1e-28


def test_a_place_never_reached():
    limit = 3 * mpmath.cos(mpmath.mpf(0.5))  # linear drag: v_x0
    assert reference.position(3, 0.5, x=limit * (1 - mpmath.mpf("1e-12")), n=1).t > 27
    with pytest.raises(ValueError, match=r"x must be less than 2\.632"):
        reference.position(3, 0.5, x=limit * (1 + mpmath.mpf("1e-12")), n=1)
    with pytest.raises(ValueError, match=r"y must be at most 0\.09"):
        reference.position(1, 0.5, y=1, rising=True)
    with pytest.raises(ValueError, match="y must be at most 0"):
        reference.position(1, -0.5, y=1)
    with pytest.raises(ValueError, match="t must be >= 0"):
        reference.position(1, 0.5, t=-1)
    with pytest.raises(TypeError, match="exactly one of alpha, t, x, s and y, got none"):
        reference.position(1, 0.5)
    with pytest.raises(TypeError, match="exactly one of"):
        reference.position(1, 0.5, t=1, x=1)
    for n in (0.9, 11):
        with pytest.raises(ValueError, match=r"n must be in \[1, 10\]"):
            reference.flight(1, 0.5, n=n)


# --- derivatives ------------------------------------------------------------------------


@pytest.mark.parametrize("n", [2, 4.7])
@pytest.mark.parametrize(
    ("v_norm", "alpha0", "height"),
    [
        (1e-3, 0.7854, 0),
        (30, 1.2, -0.1),
        pytest.param(1e3, RIGHT_ANGLE, 1, marks=pytest.mark.slow),
        (1e3, -0.5, 0.7),
        (1e5, 0, 1e-3),
    ],
)
def test_sensitivities_are_differences(n, v_norm, alpha0, height):
    """Central, of flights of 60 digits; and the range is homogeneous in the lengths."""
    found = reference.sensitivity(v_norm, alpha0, height, n=n)
    v, a, h = mpmath.mpf(v_norm), mpmath.mpf(alpha0), mpmath.mpf(height)

    def change(step, flights):
        """The derivative along `flights`, of (v, alpha0, height, scale), to about 1e-20."""
        ends = []
        for e in (step, -step):
            *launch, scale = flights(e)
            ends.append(scale * reference.flight(*launch, n=n, dps=60).x)
        return (ends[0] - ends[1]) / (2 * step)

    small = mpmath.mpf("1e-15") * min(1, 1 / v**2)
    expected = {
        "alpha0": change(small * mpmath.cos(a), lambda e: (v, a + e, h, 1)),
        "v0": change(small * v, lambda e: (v + e, a, h, 1)),
        "v_lim": change(small, lambda e: (v / (1 + e), a, h / (1 + e) ** 2, (1 + e) ** 2)),
    }
    for name, value in expected.items():
        assert abs(getattr(found, name) / value - 1) < 1e-20, name
    slant = reference.flight(v, a, h, n=n, dps=60).alpha
    assert abs(found.height * -mpmath.tan(slant) - 1) < 1e-28
    whole = v * found.v0 + found.v_lim + 2 * h * found.height
    assert abs(whole / (2 * found.range) - 1) < 1e-28


@pytest.mark.parametrize(("n", "v_norm", "alpha0"), [(7, 1e-5, "1.57"), (3, 1, "0.3")])
def test_30_digits_of_a_sensitivity_agree_with_45_after_a_fall_at_terminal_speed(n, v_norm, alpha0):
    few, many = (reference.sensitivity(v_norm, alpha0, 20000, n=n, dps=dps) for dps in (30, 45))
    for name in ("range", "alpha0", "v0", "v_lim", "height"):
        true = getattr(many, name)
        assert abs(getattr(few, name) - true) <= 1e-27 * abs(true), name


@pytest.mark.parametrize(
    ("v_norm", "n"),
    [
        (1, 1),
        (3, 3),
        *(pytest.param(v, n, marks=pytest.mark.slow) for v, n in [(1e6, 1.5), (1e4, 10)]),
    ],
)
def test_optimal_angle_of_any_power(v_norm, n):
    best = reference.optimal_angle(v_norm, n=n, dps=30)
    found = reference.sensitivity(v_norm, best, n=n, dps=10)
    assert abs(found.alpha0 / found.range) < 1e-28


def test_weak_drag_exponent_of_45_degrees():
    low, high = (reference.optimal_angle(1e-3, n=n, dps=20) for n in (3.41479, 3.41481))
    assert low < mpmath.pi / 4 < high


def test_a_launch_that_is_the_landing_has_no_derivatives():
    with pytest.raises(ValueError, match="the launch is the landing"):
        reference.sensitivity(1, -0.1)


# --- sloping ground -----------------------------------------------------------------------


@pytest.mark.parametrize(("slope", "x"), [(20, 11.952328), (-20, 19.123275), (45, 3.345209)])
def test_slopes_of_the_hillside(slope, x):
    """15 m/s at 50 degrees, v_lim 20 m/s; the steepest is met while climbing."""
    found = reference.flight("0.75", math.radians(50), slope=math.radians(slope))
    assert abs(found.x * 400 / mpmath.mpf("9.81") - x) < 6e-7
    assert (found.alpha > 0) == (slope == 45)
    assert abs(found.apex_y / reference.position("0.75", math.radians(50), 0).y - 1) < 1e-28


@pytest.mark.parametrize("n", [1, 2, pytest.param(3.5, marks=pytest.mark.slow)])
@pytest.mark.parametrize("v_norm", [1e-3, 1.0, 1e4])
@pytest.mark.parametrize(
    ("alpha0", "slope", "height"),
    [
        (0.8, 0.8 - 1e-9, 0),
        (0.8, -1.2, 0),
        (1.5, 1.2, "1e-3"),
        (-0.3, -0.9, "1e-7"),
        (0.3, 0.6, 50),
        (RIGHT_ANGLE, -1.5, 1000),
    ],
)
def test_a_slope_is_met_on_its_plane(n, v_norm, alpha0, slope, height):
    found, long = (
        reference.flight(v_norm, alpha0, height, slope=slope, n=n, dps=dps) for dps in (30, 50)
    )
    assert distance(found, long) < 1e-28
    there = reference.position(v_norm, alpha0, t=long.t, n=n, dps=45)
    for name in ("x", "alpha", "speed", "arc_length"):
        assert abs(getattr(there, name) / getattr(long, name) - 1) < 1e-30
    ground = there.x * mpmath.tan(slope) - mpmath.mpf(height)
    assert abs(there.y - ground) < 1e-30 * there.arc_length * (1 + abs(mpmath.tan(slope)))
    assert mpmath.mpf(long.alpha) < slope or alpha0 > slope


def test_slope_in_the_vacuum_limit():
    v, a, tilt = mpmath.mpf("1e-20"), mpmath.mpf("0.9"), mpmath.tan(mpmath.mpf("0.4"))
    t = 2 * v * (mpmath.sin(a) - mpmath.cos(a) * tilt)
    found = reference.flight(v, "0.9", slope="0.4", dps=45)
    assert abs(found.t / t - 1) < 1e-19
    assert abs(found.x / (t * v * mpmath.cos(a)) - 1) < 1e-19


def test_ground_steeper_than_the_launch():
    still = reference.flight(2, 0.5, slope=0.6)
    assert (still.x, still.t, still.alpha, still.speed) == (0, 0, 0.5, 2)
    assert still.apex_y > 0
    with pytest.raises(ValueError, match="height must be at least 0"):
        reference.flight(2, 0.5, -1, slope=0.6)
    with pytest.raises(ValueError, match=r"slope must be in \[-pi/2, pi/2\], got 1.6"):
        reference.flight(2, 0.5, slope=1.6)
