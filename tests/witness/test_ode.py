"""The time integration against closed forms, published figures and the mpmath path."""

import math
import pickle

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import minimize_scalar
from scipy.special import lambertw

from hodograph import ode, reference
from hodograph.witness import ode_march


def scaled(v_norm, alpha0, height=0.0, **options):
    """Fly in units of v_lim²/g and v_lim/g."""
    return ode.solve(v_norm, alpha0, 1.0, g=1.0, height=height, **options)


def naive(v_norm, alpha0, target=0.0, direction=0.0):
    """Terminal event y = target from the launch on: what one writes first."""

    def rates(_t, s):
        v = math.hypot(s[2], s[3])
        return [s[2], s[3], -v * s[2], -1 - v * s[3]]

    def landing(_t, s):
        return s[1] - target

    landing.terminal, landing.direction = True, direction
    start = [0, 0, v_norm * math.cos(alpha0), v_norm * math.sin(alpha0)]
    tight = {"rtol": 1e-10, "atol": 1e-13}
    run = solve_ivp(rates, (0, 100), start, method="DOP853", events=landing, **tight)
    return run.y_events[0][0, 0] if len(run.t_events[0]) else None


# --- the traps ----------------------------------------------------------------------------


def test_event_that_starts_at_its_zero():
    assert naive(1, 0.7) == 0  # lands where it starts
    expected = float(reference.flight(1, 0.7).x)
    assert scaled(1, 0.7).x == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize(("v_norm", "alpha0"), [(1, 1e-4), (1, 1e-6), (1e-3, 1e-3)])
def test_first_step_that_spans_the_flight(v_norm, alpha0):
    assert naive(v_norm, alpha0, direction=-1) == 0  # although told to land on the way down
    expected = reference.flight(v_norm, alpha0)
    found = scaled(v_norm, alpha0)
    assert found.x == pytest.approx(float(expected.x), rel=1e-13)
    assert found.t == pytest.approx(float(expected.t), rel=1e-13)
    assert found.alpha == pytest.approx(float(expected.alpha), rel=1e-13)


@pytest.mark.parametrize("gap", [1e-3, 1e-5, 1e-7])
def test_step_that_crosses_a_target_near_the_apex_twice(gap):
    target = float(reference.flight(1, 0.7).apex_y) * (1 - gap)
    assert naive(1, 0.7, target, direction=-1) is None  # flies past it, down to t = 100
    found = scaled(1, 0.7, -target)
    expected = reference.flight(1, 0.7, -target)
    assert found.success
    assert found.x == pytest.approx(float(expected.x), rel=1e-10)
    # The slope there goes as the square root of the gap.
    assert found.alpha == pytest.approx(float(expected.alpha), rel=1e-11 / gap)


def test_target_above_the_apex():
    top = float(reference.flight(1, 0.7).apex_y)
    found = scaled(1, 0.7, -top * (1 + 1e-9))
    assert found.status == 1
    assert not found.success
    assert math.isnan(found.x)
    assert math.isnan(found.t)
    assert found.apex.y == pytest.approx(-top * 1e-9, rel=1e-2)
    assert scaled(1, -0.7, -0.1).status == 1
    assert scaled(1, 0.0, -0.1).status == 1


# --- agreement with the mpmath path ---------------------------------------------------------

POINTS = [
    (v_norm, alpha0, height)
    for v_norm in (1e-3, 0.3, 1.5, 50.0, 1e8)
    for alpha0, height in [
        (1e-6, 0.0),
        (0.1, 0.0),
        (math.pi / 4, 0.0),
        (math.radians(89.9), 0.0),
        (math.pi / 2, 0.0),
        (0.7, 1.0),
        (0.7, 1000.0),
        (0.0, 1.0),
        (-0.7, 1.0),
        (-0.7, 1e-6),
        (-math.pi / 2 + 1e-9, 1.0),
    ]
]


@pytest.mark.parametrize(("v_norm", "alpha0", "height"), POINTS)
def test_agrees_with_the_reference(v_norm, alpha0, height):
    expected, found = reference.flight(v_norm, alpha0, height), scaled(v_norm, alpha0, height)
    assert found.success
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        value = float(getattr(expected, name))
        # The speed has a sharp least value at the apex of a steep launch.
        rel = 5e-9 if name == "arc_length" else 2e-10
        assert getattr(found, name) == pytest.approx(value, rel=rel), name
    assert found.apex.x == pytest.approx(float(expected.apex_x), rel=1e-10)
    assert found.apex.t == pytest.approx(float(expected.apex_t), rel=1e-10)
    assert found.apex.y == pytest.approx(height + float(expected.apex_y), rel=1e-10)


@pytest.mark.parametrize("v_norm", [1e-3, 1.5, 50.0])
@pytest.mark.parametrize("alpha0", [0.1, math.pi / 4, math.radians(89.9)])
def test_tighter_tolerance(v_norm, alpha0):
    expected = reference.flight(v_norm, alpha0)
    found = scaled(v_norm, alpha0, rtol=2.3e-14, atol=1e-17)
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        assert getattr(found, name) == pytest.approx(float(getattr(expected, name)), rel=1e-13)


@pytest.mark.parametrize("v_norm", [1e-3, 0.3, 1.5, 50.0, 1e8])
@pytest.mark.parametrize(
    ("alpha0", "height"),
    [(1e-6, 0.0), (math.pi / 4, 0.0), (math.radians(89.9), 0.0), (-0.7, 1.0), (0.0, 1.0)],
)
def test_paper_system_agrees_with_the_reference(v_norm, alpha0, height):
    """Eq. 16 as printed. The sharp turn at 89.9° costs it a digit."""
    expected = reference.flight(v_norm, alpha0, height)
    found = scaled(v_norm, alpha0, height, form="hodograph")
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        value = float(getattr(expected, name))
        assert getattr(found, name) == pytest.approx(value, rel=1e-9), name


@pytest.mark.parametrize("v_norm", [0.1, 1.0, 50.0])
def test_paper_system_near_the_vertical(v_norm):
    """Good to the edge of where it is allowed, and refused beyond."""
    steep = math.pi / 2 - 1.01e-6
    found = scaled(v_norm, steep, form="hodograph", rtol=1e-8)
    assert found.x == pytest.approx(float(reference.flight(v_norm, steep).x), rel=1e-7)
    for alpha0 in (math.pi / 2, math.pi / 2 - 1e-7, 1e-7 - math.pi / 2):
        with pytest.raises(ValueError, match=r"alpha0 must be in .* for form='hodograph'"):
            scaled(v_norm, alpha0, 1.0, form="hodograph")


def test_gives_up_with_a_status(monkeypatch):
    monkeypatch.setattr(ode_march, "MAX_STEPS", 3)
    found = scaled(50.0, 0.7)
    assert found.status == 2
    assert not found.success
    assert math.isnan(found.x)
    assert math.isnan(found.apex.y)
    assert found.nodes.shape == (5, 4)
    assert found.at(found.nodes[0, -1])[0] == pytest.approx(found.nodes[1, -1])


@pytest.mark.parametrize("method", ["RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA"])
def test_every_method(method):
    expected = reference.flight(2.0, 0.8)
    errors = []
    for rtol in (1e-4, 1e-7):
        found = scaled(2.0, 0.8, method=method, rtol=rtol, atol=rtol * 1e-3)
        errors.append(abs(found.x / float(expected.x) - 1))
        assert found.nfev > 10
    assert errors[0] < 3e-3
    assert errors[1] < 3e-6
    assert errors[1] < errors[0]


# --- closed forms ---------------------------------------------------------------------------


def test_vacuum():
    v0, alpha0, g, height = 20.0, 0.6, 9.81, 3.0
    found = ode.solve(v0, alpha0, math.inf, g=g, height=height)
    vy = v0 * math.sin(alpha0)
    t = (vy + math.sqrt(vy**2 + 2 * g * height)) / g
    assert found.t == pytest.approx(t, rel=1e-12)
    assert found.x == pytest.approx(v0 * math.cos(alpha0) * t, rel=1e-12)
    assert found.speed == pytest.approx(math.sqrt(v0**2 + 2 * g * height), rel=1e-12)
    assert found.apex.y == pytest.approx(height + vy**2 / (2 * g), rel=1e-12)


@pytest.mark.parametrize("v_lim", [30.0, math.inf])
def test_drop_from_rest(v_lim):
    found = ode.solve(0.0, 0.3, v_lim, g=10.0, height=45.0)
    t = 3.0 if v_lim == math.inf else 3.0 * math.acosh(math.exp(45 / 90))
    assert found.t == pytest.approx(t, rel=1e-11)
    assert found.x == 0
    assert found.alpha == pytest.approx(-math.pi / 2)


def test_vertical_flight():
    v0, v_lim, g = 40.0, 25.0, 9.81
    found = ode.solve(v0, math.pi / 2, v_lim, g=g)
    v = v0 / v_lim
    assert found.t == pytest.approx(v_lim / g * (math.atan(v) + math.asinh(v)), rel=1e-11)
    assert found.apex.y == pytest.approx(v_lim**2 / g * math.log1p(v**2) / 2, rel=1e-11)
    assert found.apex.t == pytest.approx(v_lim / g * math.atan(v), rel=1e-11)
    assert found.speed == pytest.approx(v0 / math.sqrt(1 + v**2), rel=1e-11)


@pytest.mark.parametrize(("v0", "alpha0", "v_lim"), [(1.0, 1.0, 2.0), (50.0, 0.4, 3.0)])
def test_linear_drag_in_lambert_w(v0, alpha0, v_lim):
    """T/τ = z + W0(−z e^(−z)), z = 1 + v0 sin α/v_lim."""
    g = 9.8
    tau, z = v_lim / g, 1 + v0 * math.sin(alpha0) / v_lim
    t = tau * (z + lambertw(-z * math.exp(-z)).real)
    found = ode.solve(v0, alpha0, v_lim, g=g, n=1)
    assert found.t == pytest.approx(t, rel=1e-11)
    x = -v0 * math.cos(alpha0) * tau * math.expm1(-t / tau)
    assert found.x == pytest.approx(x, rel=1e-11)


@pytest.mark.parametrize("form", ["cartesian", "hodograph"])
@pytest.mark.parametrize("n", [0.5, 1, 1.5, 2, 3, 4.7])
def test_any_power_law_keeps_its_hodograph(n, form):
    """Eq. 8: v_x⁻ⁿ + n G(tan α) is constant, with G' = (1 + p²)^((n − 1)/2)."""
    found = ode.solve(3.0, 1.0, 1.0, g=1.0, n=n, form=form)
    _, _, _, vx, vy = found.nodes
    nodes, weights = np.polynomial.legendre.leggauss(60)
    p = vy / vx
    u = np.outer((nodes + 1) / 2, p)
    primitive = p / 2 * (weights @ (1 + u**2) ** ((n - 1) / 2))
    constant = vx**-n + n * primitive
    assert constant == pytest.approx(np.full_like(p, constant[0]), rel=1e-9)


# --- a drag law that the caller gives -------------------------------------------------------


def didion(v):
    """λv²(1 + v/c) over the weight, at a terminal speed near 42.7 m/s."""
    return (v / 42.7) ** 2 * (1 + v / 435.0)


@pytest.mark.parametrize("v_lim", [42.7, 5.0, math.inf])
@pytest.mark.parametrize("form", ["cartesian", "hodograph"])
def test_a_given_square_law_is_the_power_law(form, v_lim):
    expected = ode.solve(60.0, 0.8, 42.7)
    found = ode.solve(60.0, 0.8, v_lim, drag=lambda v: (v / 42.7) ** 2, form=form)
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-8), name


def test_a_cubic_term_rises_and_falls_by_its_integrals():
    """Straight up, v dv = -g (1 + R/mg) dy, and down, v dv = g (1 - R/mg) dy."""
    v0, g = 60.0, 9.81
    found = ode.solve(v0, math.pi / 2, 42.7, drag=didion, rtol=1e-12)
    rise, _ = quad(lambda v: v / g / (1 + didion(v)), 0, v0, epsabs=0)
    time, _ = quad(lambda v: 1 / g / (1 + didion(v)), 0, v0, epsabs=0)
    assert found.apex.y == pytest.approx(rise, rel=1e-10)
    assert found.apex.t == pytest.approx(time, rel=1e-10)
    fall, _ = quad(lambda v: v / g / (1 - didion(v)), 0, found.speed, epsabs=0)
    assert fall == pytest.approx(rise, rel=1e-9)


@pytest.mark.parametrize("value", [math.nan, -1.0])
def test_a_law_that_is_no_drag_is_refused(value):
    with pytest.raises(ValueError, match=r"drag must be >= 0 at every speed, got .* at 30 m/s"):
        ode.solve(30.0, 0.7, 40.0, drag=lambda v: value)


# --- published figures ----------------------------------------------------------------------


def best(v0, v_lim, height):
    """Greatest range over the launch angle: (range, degrees)."""

    def short(alpha0):
        return -ode.solve(v0, alpha0, v_lim, height=height).x

    found = minimize_scalar(short, bounds=(0.2, 0.9), method="bounded", options={"xatol": 1e-7})
    return -found.fun, math.degrees(found.x)


def test_baltrj():
    """BalTrj, worked example, 10 s after the launch."""
    found = ode.solve(100.0, math.pi / 4, 150.0, g=9.80665)
    x, y, vx, vy = found.at(10.0)
    assert math.hypot(vx, vy) == pytest.approx(62.289, abs=5e-4)
    assert math.degrees(math.atan2(vy, vx)) == pytest.approx(-32.49, abs=5e-3)
    assert y == pytest.approx(156.404, abs=5e-4)
    assert x == pytest.approx(603.251, abs=5e-4)


@pytest.mark.parametrize(
    ("v0", "k", "height", "printed", "digits", "angle"),
    [
        (100, 0.001, 0, 600.84063, 5e-6, 40.924),
        (100, 0.0057, 50, 269.451, 5e-4, None),
        (100, 0.0057, 100, 286.965, 5e-4, None),
        (100, 0.0057, 200, 310.601, 5e-4, None),
        (100, 0.0057, 500, 337.36, 5e-3, None),
        (975, 0.0012, 0, 2481.73, 5e-3, 24.7662),
    ],
)
def test_troywigton(v0, k, height, printed, digits, angle):
    """TroyWigton/ProjectileTrajectory, README, and its .223 bullet."""
    v_lim = math.sqrt(9.81 / k)
    longest, at = best(v0, v_lim, height)
    assert longest == pytest.approx(printed, abs=digits)
    if angle is not None:
        found = ode.solve(v0, math.radians(angle), v_lim)
        assert found.x == pytest.approx(printed, abs=digits)
        assert at == pytest.approx(angle, abs=1e-2)


def test_finley():
    """Finley, linear drag. Lambert's W shows 8e-11 and 3e-11 too much in the printed T and R."""
    found = ode.solve(1.0, 1.0, 2.0, g=9.8, n=1)
    assert found.t == pytest.approx(0.1528298566, abs=1e-10)
    assert found.t == pytest.approx(0.152829856521637656, rel=1e-11)
    assert found.x == pytest.approx(0.05812082852, abs=4e-11)
    assert found.x == pytest.approx(0.0581208284903323647, rel=1e-11)


def test_phy432():
    """PHY432 course (Py4Phy), linear drag with b/m = 2.

    Ten of the thirteen digits printed hold; Lambert's W at 30 digits gives 43.300674233324.
    """
    found = ode.solve(100.0, math.radians(30), 9.81 / 2, n=1, rtol=1e-13)
    assert found.x == pytest.approx(43.30067423347, abs=2e-10)
    assert found.x == pytest.approx(43.3006742333240617, rel=1e-13)


def test_modsimpy():
    """Chapter 22 prints 99.3183, from solve_ivp at its default tolerance: 8e-5 too far."""
    k = 0.5 * 1.2 * 0.33 * math.pi * 0.0365**2 / 0.145
    v_lim = math.sqrt(9.8 / k)
    found = ode.solve(40.0, math.pi / 4, v_lim, g=9.8, height=1.0)
    assert found.x == pytest.approx(99.310656, abs=5e-7)
    assert 99.3183 / found.x - 1 == pytest.approx(8e-5, abs=5e-6)
    exact = reference.flight(40.0 / v_lim, math.pi / 4, 9.8 / v_lim**2)
    assert float(exact.x) * v_lim**2 / 9.8 == pytest.approx(99.310656, abs=5e-7)


# --- units, trajectory, refusals --------------------------------------------------------------


def test_scales():
    one = ode.solve(30.0, 0.7, 40.0, height=5.0)
    two = ode.solve(60.0, 0.7, 80.0, height=20.0)
    four = ode.solve(60.0, 0.7, 80.0, g=4 * 9.81, height=5.0)
    assert two.x == pytest.approx(4 * one.x, rel=1e-14)
    assert two.t == pytest.approx(2 * one.t, rel=1e-14)
    assert four.x == pytest.approx(one.x, rel=1e-14)
    assert four.t == pytest.approx(one.t / 2, rel=1e-14)
    assert two.nfev == one.nfev


@pytest.mark.parametrize("form", ["cartesian", "hodograph"])
def test_trajectory(form):
    found = ode.solve(30.0, 0.7, 40.0, height=5.0, form=form)
    assert found.nodes[:, 0] == pytest.approx([0, 0, 5, 30 * math.cos(0.7), 30 * math.sin(0.7)])
    assert found.nodes[0, -1] == found.t
    assert found.nodes[1, -1] == found.x
    assert abs(found.nodes[2, -1]) < 1e-12
    assert np.all(np.diff(found.nodes[0]) > 0)
    assert np.array(found.at(found.nodes[0])) == pytest.approx(found.nodes[1:], rel=1e-7, abs=1e-6)
    top = found.at(found.apex.t)
    assert [top[0], top[1]] == pytest.approx([found.apex.x, found.apex.y], rel=1e-8)
    assert abs(top[3]) < 1e-6
    grid = found.at(np.linspace(0, found.t, 12).reshape(3, 4))
    assert all(q.shape == (3, 4) for q in grid)
    for t in (-1e-3, found.t * 1.001, math.nan):
        with pytest.raises(ValueError, match="t must be within the flight"):
            found.at(t)


def test_dense_output_follows_the_reference():
    found = scaled(1.5, 0.9)
    for alpha in (0.6, 0.1, -0.5, -1.0):
        expected = reference.position(1.5, 0.9, alpha)
        x, y, vx, vy = found.at(float(expected.t))
        assert x == pytest.approx(float(expected.x), rel=1e-7)
        assert y == pytest.approx(float(expected.y), rel=1e-7)
        assert math.atan2(vy, vx) == pytest.approx(alpha, rel=1e-6)


@pytest.mark.parametrize("alpha0", [0.0, -0.4])
def test_no_way_up_from_the_plane(alpha0):
    found = ode.solve(20.0, alpha0, 40.0)
    assert found.success
    assert (found.x, found.t, found.arc_length, found.alpha) == (0, 0, 0, alpha0)
    assert found.speed == pytest.approx(20, rel=1e-15)
    assert found.nodes.shape == (5, 1)
    assert found.at([0.0])[0].shape == (1,)


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"v0": -1.0}, ValueError, "v0 must be finite and >= 0, got -1.0"),
        ({"v0": math.nan}, ValueError, "v0 must be finite and >= 0, got nan"),
        ({"v0": np.ones(2)}, TypeError, "v0 must be a real number, got ndarray"),
        ({"alpha0": 1.6}, ValueError, r"alpha0 must be in \[-pi/2, pi/2\], got 1.6"),
        ({"alpha0": 45}, ValueError, r"got 45.0 \(if these are degrees: np.deg2rad\)"),
        ({"v0": 10**400}, ValueError, "v0 must be finite and >= 0, got inf"),
        ({"alpha0": "45"}, TypeError, "alpha0 must be a real number, got str"),
        ({"v_lim": 0.0}, ValueError, "v_lim must be > 0, got 0.0"),
        ({"g": 0}, ValueError, "g must be finite and > 0, got 0.0"),
        ({"height": math.inf}, ValueError, "height must be finite, got inf"),
        ({"n": 0}, ValueError, "n must be finite and > 0, got 0.0"),
        ({"rtol": 1e-15}, ValueError, r"rtol must be in \[2.3e-14, 1\), got 1e-15"),
        ({"atol": 0}, ValueError, "atol must be finite and > 0, got 0.0"),
        ({"method": "RK4"}, ValueError, "method must be one of RK23, RK45, DOP853, Radau"),
        ({"form": "polar"}, ValueError, "form must be one of cartesian, hodograph, got 'polar'"),
        ({"drag": 2.0}, TypeError, "drag must be a function of the speed, got float"),
        ({"drag": didion, "n": 3}, ValueError, "n must be left at 2 where drag is given, got 3"),
        ({"form": "hodograph", "v0": 0.0}, ValueError, "v0 must be > 0 for form='hodograph'"),
        ({"v0": 1e-200}, ValueError, "v0, v_lim and g are out of scale"),
    ],
)
def test_refuses(change, error, message):
    with pytest.raises(error, match=message):
        ode.solve(**{"v0": 30.0, "alpha0": 0.7, "v_lim": 40.0} | change)


@pytest.mark.parametrize("v_lim", [30.0, math.inf])
def test_straight_down(v_lim):
    found = ode.solve(20.0, -math.pi / 2, v_lim, g=9.81, height=50.0)
    square = 20**2 + 2 * 9.81 * 50
    if v_lim < math.inf:
        square = v_lim**2 + (20**2 - v_lim**2) * math.exp(-2 * 9.81 * 50 / v_lim**2)
    assert found.success
    assert found.speed == pytest.approx(math.sqrt(square), rel=1e-10)
    assert found.alpha == -math.pi / 2
    assert found.x == pytest.approx(0, abs=1e-13)
    assert found.arc_length == pytest.approx(50, rel=1e-10)
    single = ode.solve(20.0, np.deg2rad(np.float32(-90)), v_lim, g=9.81, height=50.0)
    assert single.t == found.t


@pytest.mark.parametrize("method", ["RK23", "DOP853", "LSODA"])
def test_a_solution_can_be_pickled(method):
    found = ode.solve(30.0, 0.7, 40.0, method=method)
    copy = pickle.loads(pickle.dumps(found))
    times = np.linspace(0, found.t, 7)
    assert (copy.x, copy.t, copy.apex) == (found.x, found.t, found.apex)
    np.testing.assert_array_equal(copy.at(times), found.at(times))


# --- sloping ground -----------------------------------------------------------------------


@pytest.mark.parametrize("form", ["cartesian", "hodograph"])
@pytest.mark.parametrize(("slope", "x"), [(20, 11.952328), (-20, 19.123275), (45, 3.345209)])
def test_landing_on_a_slope(slope, x, form):
    """15 m/s at 50 degrees; on the steepest ground the path lands while it climbs."""
    slope = math.radians(slope)
    found = ode.solve(15.0, math.radians(50), 20.0, slope=slope, form=form)
    assert found.x == pytest.approx(x, abs=6e-7)
    assert found.nodes[2, -1] == pytest.approx(found.x * math.tan(slope), rel=1e-12)
    assert (found.alpha > 0) == (slope > 0.7)
    level = ode.solve(15.0, math.radians(50), 20.0)
    assert found.apex.y == pytest.approx(level.apex.y, rel=1e-9)  # that of the path


@pytest.mark.parametrize("slope", [-1.5, -0.4, 1e-9, 0.5, 0.899])
@pytest.mark.parametrize("height", [-0.1, 0.0, 30.0])
def test_slope_in_vacuum(slope, height):
    v0, alpha0, g, tilt = 20.0, 0.9, 9.81, math.tan(slope)
    vx, vy = v0 * math.cos(alpha0), v0 * math.sin(alpha0)
    climb = vy - vx * tilt
    found = ode.solve(v0, alpha0, math.inf, g=g, height=height, slope=slope, rtol=1e-12)
    if climb**2 + 2 * g * height < 0:
        assert found.status == 1
        return
    t = (climb + math.sqrt(climb**2 + 2 * g * height)) / g
    assert found.t == pytest.approx(t, rel=1e-10)
    assert found.x == pytest.approx(vx * t, rel=1e-10)


def test_ground_steeper_than_the_launch():
    still = ode.solve(20.0, 0.5, 30.0, slope=0.6)
    assert (still.x, still.t, still.alpha, still.status) == (0, 0, 0.5, 0)
    found = ode.solve(20.0, 0.5, 30.0, slope=0.6, height=1.0)
    assert found.nodes[2, -1] == pytest.approx(found.x * math.tan(0.6), rel=1e-12)
    assert ode.solve(20.0, 0.5, 30.0, slope=0.6, height=-1.0).status == 1


# --- wind ---------------------------------------------------------------------------------


def test_crosswind():
    """A ball of 50 g and 3 cm, Cd 0.5, thrown with 20 m/s along and up."""
    k = 0.5 * 1.225 * 0.5 * math.pi * 0.015**2 / 0.05
    v_lim = math.sqrt(9.81 / k)
    found = ode.solve(math.hypot(20, 20), math.pi / 4, v_lim, crosswind=10.0, rtol=1e-12)
    assert found.x == pytest.approx(63.48134, abs=6e-6)
    assert found.z == pytest.approx(6.23781, abs=6e-6)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0])
@pytest.mark.parametrize(
    ("v0", "alpha0", "wind", "crosswind"),
    [(30.0, 0.8, 8.0, -5.0), (10.0, 1.3, -25.0, 0.0), (30.0, 0.5, 40.0, 3.0), (0.0, 0.5, 9.0, 4.0)],
)
def test_wind_is_a_moving_frame(n, v0, alpha0, wind, crosswind):
    """The reference flies through the air; the ground moves under it against the wind."""
    v_lim, g, height = 25.0, 9.81, 12.0
    found = ode.solve(
        v0, alpha0, v_lim, height=height, n=n, wind=wind, crosswind=crosswind, rtol=1e-12
    )
    along, up = v0 * math.cos(alpha0) - wind, v0 * math.sin(alpha0)
    across = math.hypot(along, crosswind)
    air, slant = math.hypot(across, up), math.atan2(up, across)
    length, heading = v_lim**2 / g, (along / across, -crosswind / across)
    for t in (0.3 * found.t, found.t):
        there = reference.position(air / v_lim, slant, t=t * g / v_lim, n=n, dps=20)
        far = float(there.x) * length
        state = found.state(t)
        rel = 1e-9 if t == found.t else 1e-6
        assert float(state.x) == pytest.approx(far * heading[0] + wind * t, rel=rel, abs=1e-6)
        assert float(state.z) == pytest.approx(far * heading[1] + crosswind * t, rel=rel)
        assert float(state.y) == pytest.approx(height + float(there.y) * length, abs=1e-6)
        assert float(state.air_length) == pytest.approx(float(there.arc_length) * length, rel=rel)
        out = float(there.speed) * v_lim * math.cos(there.alpha)
        v_y = float(there.speed) * v_lim * math.sin(there.alpha)
        v_x, v_z = out * heading[0] + wind, out * heading[1] + crosswind
        ends = (float(state.v_x), float(state.v_y), float(state.v_z))
        assert ends == pytest.approx((v_x, v_y, v_z), rel=1e-6, abs=1e-6)
        assert float(state.speed) == pytest.approx(math.hypot(v_x, v_y, v_z), rel=1e-6)
        assert float(state.alpha) == pytest.approx(math.atan2(v_y, math.hypot(v_x, v_z)), rel=1e-5)
    assert found.z == pytest.approx(float(state.z), rel=1e-9)
    assert found.speed == pytest.approx(float(state.speed), rel=1e-6)


def test_length_over_the_ground_is_that_of_its_path():
    found = ode.solve(20.0, 1.2, 15.0, height=3.0, wind=-12.0, crosswind=6.0, rtol=1e-12)
    path = found.state(np.linspace(0, found.t, 20001))
    steps = np.diff([path.x, path.y, path.z], axis=1)
    assert found.arc_length == pytest.approx(np.linalg.norm(steps, axis=0).sum(), rel=1e-7)
    through = steps - np.array([[-12.0], [0.0], [6.0]]) * found.t / 20000
    assert found.air_length == pytest.approx(np.linalg.norm(through, axis=0).sum(), rel=1e-7)
    still = ode.solve(20.0, 1.2, 15.0, height=3.0)
    assert still.air_length == still.arc_length


def linear(v0, alpha0, v_lim, wind, g=9.81):
    """x and y above the launch at a time, for linear drag in a wind along x."""
    tau, vx, vy = v_lim / g, v0 * math.cos(alpha0), v0 * math.sin(alpha0)

    def place(t):
        gone = -math.expm1(-t / tau) * tau
        return wind * t + (vx - wind) * gone, (vy + v_lim) * gone - v_lim * t

    return place


@pytest.mark.parametrize("slope", [-1.2, -0.3, 0.0, 0.4, 1.2])
@pytest.mark.parametrize("wind", [-30.0, -5.0, 5.0, 30.0])
def test_linear_drag_in_a_wind_over_a_slope(slope, wind):
    """Where the ground falls away faster than the terminal speed, only a dip may land."""
    v0, alpha0, v_lim, height = 18.0, 0.6, 12.0, 2.0
    place = linear(v0, alpha0, v_lim, wind)
    found = ode.solve(v0, alpha0, v_lim, n=1, height=height, slope=slope, wind=wind, rtol=1e-12)

    def above(t):
        x, y = place(t)
        return height + y - x * math.tan(slope)

    times = np.linspace(0, 200, 400_001)
    below = times[np.array([above(t) for t in times]) < 0]
    assert found.success == bool(below.size)
    if found.success:
        assert found.t == pytest.approx(below[0], abs=5e-4)
        assert above(found.t) == pytest.approx(0, abs=1e-9)
        assert found.x == pytest.approx(place(found.t)[0], rel=1e-9)
    else:
        assert found.status == 1
        assert math.isnan(found.t)


@pytest.mark.parametrize("margin", [1e-6, -1e-6])
def test_a_dip_to_the_ground_before_the_wind_takes_over(margin):
    """Thrown down a slope, the path comes nearest to the ground and is blown off it again."""
    v0, alpha0, v_lim, wind, slope = 20.0, -1.2, 10.0, 25.0, -0.8
    place = linear(v0, alpha0, v_lim, wind)

    def fallen(t):
        x, y = place(t)
        return y - x * math.tan(slope)

    lowest = minimize_scalar(fallen, bounds=(0, 20), method="bounded", options={"xatol": 1e-10})
    height = -lowest.fun * (1 + margin)
    found = ode.solve(v0, alpha0, v_lim, n=1, height=height, slope=slope, wind=wind, rtol=1e-12)
    assert found.status == (1 if margin > 0 else 0)
    if margin < 0:
        assert fallen(found.t) + height == pytest.approx(0, abs=1e-9)
        assert found.t < lowest.x


def test_ways_to_have_no_flight_in_a_wind():
    still = ode.solve(0.0, 0.3, 20.0, wind=7.0)
    assert (still.x, still.t, still.status) == (0, 0, 0)
    lifted = ode.solve(0.0, 0.3, 5.0, wind=20.0, slope=-1.0)  # from rest, off a steep hill
    assert lifted.status == 1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"slope": math.pi / 2}, r"slope must be in \(-pi/2, pi/2\), got 1.57"),
        ({"wind": math.nan}, "wind must be finite, got nan"),
        ({"crosswind": math.inf}, "crosswind must be finite, got inf"),
        ({"wind": 1.0, "form": "hodograph"}, "wind must be 0 for form='hodograph', got 1.0"),
        ({"crosswind": 1, "form": "hodograph"}, "crosswind must be 0 for form='hodograph'"),
    ],
)
def test_refuses_ground_and_air(change, message):
    with pytest.raises(ValueError, match=message):
        ode.solve(30.0, 0.7, 40.0, **change)
    with pytest.raises(TypeError, match="wind must be a real number, got str"):
        ode.solve(30.0, 0.7, 40.0, wind="5")
