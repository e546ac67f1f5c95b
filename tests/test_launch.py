"""Launches in SI: published figures, closed forms, mpmath and the equations of motion."""

import mpmath
import numpy as np
import pytest

from hodograph import Launch, ode, optimal_angle, reference, sensitivity
from hodograph.engine.status import Status


class TestPublished:
    """Published figures, each to the digits printed."""

    def test_baltrj_worked_example(self):
        from scipy.optimize import brentq

        from hodograph.path import position, speed

        launch = Launch(100.0, np.pi / 4, 150.0, g=9.80665)
        length, time = 150.0**2 / 9.80665, 150.0 / 9.80665

        def late(alpha):
            return position(launch.v_norm, np.pi / 4, alpha).t * time - 10.0

        alpha = brentq(late, -1.5, 0.0, xtol=1e-14)
        x, y, _ = position(launch.v_norm, np.pi / 4, alpha)
        assert speed(launch.v_norm, np.pi / 4, alpha) * 150 == pytest.approx(62.289, abs=5e-4)
        assert np.rad2deg(alpha) == pytest.approx(-32.49, abs=5e-3)
        assert y * length == pytest.approx(156.404, abs=5e-4)
        assert x * length == pytest.approx(603.251, abs=5e-4)

    def test_troy_wigton(self):
        best = Launch.from_drag(100.0, np.deg2rad(40.924), 0.001)
        assert best.range() == pytest.approx(600.84063, abs=5e-6)
        bullet = Launch.from_drag(975.0, np.deg2rad(24.7662), 0.0012)
        assert bullet.range() == pytest.approx(2481.73, abs=5e-3)

    def test_troy_wigton_landing_below(self):
        for height, printed in [(50, 269.451), (100, 286.965), (200, 310.601), (500, 337.36)]:
            angles = np.deg2rad(np.linspace(0, 45, 4501))
            farthest = Launch.from_drag(100.0, angles, 0.0057, height=height).range().max()
            assert farthest == pytest.approx(printed, rel=2e-6)

    def test_modsimpy(self):
        k = 0.5 * 1.2 * 0.33 * np.pi * 0.0365**2 / 0.145
        launch = Launch.from_drag(40.0, np.pi / 4, k, g=9.8, height=1.0)
        assert launch.range() == pytest.approx(99.310656, abs=5e-7)  # 99.3183 printed, 8e-5 off


class TestVacuum:
    def test_closed_forms(self):
        v0, alpha0, g, height = 12.0, np.deg2rad([-40.0, 0.0, 30.0, 75.0]), 3.7, 20.0
        launch = Launch(v0, alpha0, np.inf, g=g, height=height)
        vy = v0 * np.sin(alpha0)
        t = (vy + np.sqrt(vy**2 + 2 * g * height)) / g
        landing = launch.landing()
        np.testing.assert_allclose(landing.t, t, rtol=1e-14)
        np.testing.assert_allclose(landing.x, v0 * np.cos(alpha0) * t, rtol=1e-14)
        np.testing.assert_allclose(landing.speed, np.sqrt(v0**2 + 2 * g * height), rtol=1e-14)
        np.testing.assert_allclose(
            np.tan(landing.alpha), (vy - g * t) / (v0 * np.cos(alpha0)), rtol=1e-13
        )

    def test_symmetric_about_45_degrees(self):
        phi = np.deg2rad(np.linspace(0, 45, 10))
        low, high = (Launch(5.0, np.pi / 4 + sign * phi, np.inf).range() for sign in (-1, 1))
        np.testing.assert_allclose(low, high, rtol=1e-14, atol=1e-15)


class TestVertical:
    """Arctangent up, artanh down (Timmerman and van der Weele 1999)."""

    v0 = np.array([1e-3, 1.0, 42.7, 1e3, 1e6])
    v_lim, g = 42.7, 9.81

    def test_up(self):
        _, y, t = Launch(self.v0, np.pi / 2, self.v_lim, g=self.g).apex()
        v = self.v0 / self.v_lim
        np.testing.assert_allclose(t, self.v_lim / self.g * np.arctan(v), rtol=2e-14)
        np.testing.assert_allclose(y, self.v_lim**2 / self.g * np.log1p(v * v) / 2, rtol=2e-14)

    def test_and_down(self):
        landing = Launch(self.v0, np.pi / 2, self.v_lim, g=self.g).landing()
        v = self.v0 / self.v_lim
        down = v / np.sqrt(1 + v * v)  # speed at the ground, from v^2 / (1 + v^2)
        np.testing.assert_allclose(landing.speed, self.v_lim * down, rtol=2e-14)
        time = np.arctan(v) + np.arcsinh(v)  # artanh(down) = asinh(v)
        np.testing.assert_allclose(landing.t, self.v_lim / self.g * time, rtol=2e-14)

    def test_dropped_from_rest(self):
        height = np.array([0.1, 10.0, 1e4])
        landing = Launch(0.0, 0.3, self.v_lim, g=self.g, height=height).landing()
        fall = height * self.g / self.v_lim**2
        time = np.log(np.exp(fall) * (1 + np.sqrt(-np.expm1(-2 * fall))))  # acosh(exp(fall))
        np.testing.assert_allclose(landing.t, self.v_lim / self.g * time, rtol=2e-13)
        np.testing.assert_allclose(
            landing.speed, self.v_lim * np.sqrt(-np.expm1(-2 * fall)), rtol=2e-14
        )
        assert np.all(landing.x == 0)


SCENES = [
    (v, np.deg2rad(a), h)
    for v in (0.05, 0.8, 1.5, 12.0)
    for a, h in [(45, 0.0), (20, 3.0), (-35, 2.0), (0, 0.4), (80, 1e-3), (89.9, 50.0)]
]


@pytest.mark.parametrize(("v", "alpha0", "height"), SCENES)
def test_landing_and_apex_against_mpmath(v, alpha0, height):
    v_lim, g = 7.0, 2.0
    length, time = v_lim**2 / g, v_lim / g
    launch = Launch(v * v_lim, alpha0, v_lim, g=g, height=height * length)
    exact_v, exact_height = launch.v_norm, float(launch.height * g / v_lim**2)
    truth = reference.flight(exact_v, alpha0, exact_height)
    landing = launch.landing()
    assert landing.success
    assert landing.x == pytest.approx(float(truth.x) * length, rel=1e-13)
    assert landing.t == pytest.approx(float(truth.t) * time, rel=1e-13)
    assert landing.speed == pytest.approx(float(truth.speed) * v_lim, rel=1e-13)
    assert landing.alpha == pytest.approx(float(truth.alpha), rel=1e-13)
    assert landing.arc_length == pytest.approx(float(truth.arc_length) * length, rel=1e-13)
    assert launch.range() == landing.x
    assert launch.flight_time() == landing.t
    x, y, t = launch.apex()
    assert x == pytest.approx(float(truth.apex_x) * length, rel=1e-13)
    assert y - launch.height == pytest.approx(
        float(truth.apex_y) * length, rel=1e-13, abs=1e-15 * max(launch.height, 1.0)
    )
    assert t == pytest.approx(float(truth.apex_t) * time, rel=1e-13)


def test_target_above_the_muzzle():
    truth = reference.flight(1.0, 1.0, -0.2)
    landing = Launch(1.0, 1.0, 1.0, g=1.0, height=-0.2).landing()
    assert landing.x == pytest.approx(float(truth.x), rel=1e-13)
    assert landing.alpha < 0  # on the way down
    beyond = Launch(1.0, 1.0, 1.0, g=1.0, height=-0.3).landing()
    assert beyond.status == Status.UNREACHABLE
    assert not beyond.success
    assert np.isnan([beyond.x, beyond.t, beyond.speed, beyond.alpha]).all()
    assert np.isnan(Launch(1.0, -0.1, 1.0, height=-1.0).range())


@pytest.mark.parametrize("scene", [(0.5, 0.7, 0.0), (3.0, 1.4, 0.5), (1.0, -0.6, 2.0)])
def test_trajectory_satisfies_the_equations_of_motion(scene):
    v, alpha0, height = scene
    path = Launch(v, alpha0, 1.0, g=1.0, height=height).trajectory(60)
    flight = ode.solve(v, alpha0, 1.0, g=1.0, height=height, rtol=1e-12, atol=1e-14)
    x, y, vx, vy = flight.at(path.t)
    np.testing.assert_allclose(path.x, x, atol=2e-10)
    np.testing.assert_allclose(path.y, y, atol=2e-10)
    np.testing.assert_allclose(path.speed, np.hypot(vx, vy), atol=2e-10)
    np.testing.assert_allclose(np.tan(path.alpha), vy / vx, rtol=2e-9, atol=2e-9)


def test_trajectory_balances_energy():
    # d(v^2/2 + g y) = -g v^2/v_lim^2 ds: the work of drag, by Simpson over the points
    from scipy.integrate import simpson

    path = Launch(30.0, 0.9, 20.0).trajectory(20_001)
    energy = path.speed**2 / 2 + 9.81 * path.y
    work = 9.81 / 20.0**2 * simpson(path.speed**2, x=path.s)
    assert energy[0] - energy[-1] == pytest.approx(work, rel=1e-11)


@pytest.mark.parametrize(
    ("v0", "degrees", "v_lim", "height"),
    [
        (40, 40, 42.7, 0), (40, 90, 42.7, 0), (40, 89.99, 42.7, 1e3), (40, -30, 42.7, 100),
        (40, 40, np.inf, 0), (40, 40, 1e-3, 0), (40, 40, 1e-9, 3), (0, 20, 10, 50),
        (40, 40, 1, 1e9), (1e-9, 89, 5, 1e6),
    ],
)  # fmt: skip
def test_trajectory_ends_at_the_landing(v0, degrees, v_lim, height):
    launch = Launch(v0, np.deg2rad(degrees), v_lim, height=height)
    path, landing = launch.trajectory(50), launch.landing()
    assert (path.x[0], path.t[0], path.s[0]) == (0, 0, 0)
    assert path.y[0] == pytest.approx(height, rel=1e-15, abs=1e-300)
    for name in ("x", "t", "speed", "alpha"):
        assert getattr(path, name)[-1] == pytest.approx(getattr(landing, name), rel=1e-14)
    assert path.y[-1] == 0
    assert np.all(np.diff(path.t) > 0)
    assert np.all(np.diff(path.x) >= 0)
    assert np.all(np.diff(path.alpha) <= 0)
    np.testing.assert_allclose(np.diff(path.s), landing.arc_length / 49, rtol=1e-9)
    # no step runs farther than its arc
    chord = np.hypot(np.diff(path.x), np.diff(path.y))
    assert np.all(chord <= np.diff(path.s) * (1 + 1e-9))


def test_trajectory_shape():
    launch = Launch([[10.0], [20.0]], [0.3, 0.6, np.nan], 15.0, height=[0.0, -100.0, 0.0])
    path = launch.trajectory(7)
    assert path.x.shape == (2, 3, 7)
    assert np.isfinite(path.x[:, 0]).all()
    assert np.isnan(path.x[:, 1:]).all()
    one = Launch(20.0, 0.3, 15.0).trajectory(7)
    np.testing.assert_array_equal(path.y[1, 0], one.y)


def test_scaling_of_units():
    base = Launch(1.3, 0.8, 1.0, g=1.0, height=0.5).landing()
    scaled = Launch(1.3 * 30, 0.8, 30.0, g=4.0, height=0.5 * 30**2 / 4).landing()
    assert scaled.x == pytest.approx(base.x * 30**2 / 4, rel=1e-14)
    assert scaled.t == pytest.approx(base.t * 30 / 4, rel=1e-14)
    assert scaled.alpha == pytest.approx(base.alpha, rel=1e-14)


def test_fields_broadcast_and_scalars_stay_scalar():
    launch = Launch(10, 0.5, 20)
    assert np.ndim(launch.range()) == 0
    assert launch.v_norm == 0.5
    many = Launch(np.array([10, 20]), np.array([[0.5], [0.6]]), 20)
    assert many.range().shape == (2, 2)
    assert many.range()[0, 0] == pytest.approx(launch.range(), rel=1e-15)
    assert Launch(10.0, 0.5, np.inf).v_norm == 0.0


def test_best_angle_beats_45_degrees():
    v_norm = 50 / 42.7
    best = Launch(50.0, optimal_angle(v_norm), 42.7).range()
    assert best > Launch(50.0, np.pi / 4, 42.7).range()


def test_a_fall_from_rest_as_deep_as_may_be():
    # nearly from rest; far below terminal speed is reached, and x is final
    found = Launch(1e-30, 0.3, 1.0, height=[40.0, 1e10, 1e19]).range()
    np.testing.assert_allclose(found, found[0], rtol=1e-14)


def test_a_path_begins_as_it_was_launched():
    path = Launch([0.0, 1e-20, 30.0], [0.5, -0.3, 0.7], 40.0, height=100.0).trajectory(3)
    assert path.speed[:, 0].tolist() == [0.0, 1e-20, 30.0]
    assert path.y[:, 0].tolist() == [100.0] * 3
    assert path.alpha[:, 0].tolist() == [0.5, -0.3, 0.7]


@pytest.mark.parametrize("v_norm", [0.0, 1e-3, 0.5, 3.0, 1e4])
@pytest.mark.parametrize("height", [1e-3, 2.0, 300.0])
def test_straight_down(v_norm, height):
    # v dv/dy = g (1 - v^2/v_lim^2): v is the tangent or cotangent of g t / v_lim + a constant
    v_lim, g = 20.0, 9.81
    landing = Launch(v_norm * v_lim, -np.pi / 2, v_lim, g=g, height=height).landing()
    with mpmath.workdps(40):
        v0 = mpmath.mpf(v_norm)
        speed = mpmath.sqrt(1 + (v0**2 - 1) * mpmath.exp(-2 * g * mpmath.mpf(height) / v_lim**2))
        constant = mpmath.atanh if v_norm < 1 else mpmath.acoth
        t = (constant(speed) - constant(v0)) * v_lim / g
    assert landing.status == 0
    assert landing.speed == pytest.approx(float(speed) * v_lim, rel=1e-13)
    assert landing.t == pytest.approx(float(t), rel=1e-12)
    assert landing.arc_length == pytest.approx(height, rel=1e-13)
    assert landing.alpha == -np.pi / 2
    assert 0 <= landing.x <= height * 1e-16  # the cosine of the double nearest to pi/2 is 6e-17


def test_straight_down_everywhere():
    """Legal in every function that takes a launch angle."""
    from hodograph import path, sensitivity

    down = -np.pi / 2
    assert path.speed(2.0, down, down) == 2.0
    found = sensitivity.range_sensitivity(30.0, down, 40.0, height=2.0)
    assert found.range == pytest.approx(0.0, abs=1e-15)
    launch = Launch(30.0, down, 40.0, height=2.0)
    assert [float(value) for value in launch.apex()] == [0.0, 2.0, 0.0]
    assert launch.trajectory(5).y == pytest.approx(np.linspace(2, 0, 5), rel=1e-12)
    for n in (1.0, 1.5, 3.0):
        flight = ode.solve(30.0, down + 1e-9, 40.0, n=n, height=2.0, rtol=1e-12, atol=1e-14)
        landing = Launch(30.0, down, 40.0, n=n, height=2.0).landing()
        assert landing.t == pytest.approx(flight.t, rel=1e-9)
        assert landing.speed == pytest.approx(flight.speed, rel=1e-9)
    assert Launch(30.0, down, 40.0).range() == 0  # on the ground it has landed


def test_from_drag_of_the_weakest_drag_is_vacuum():
    for n in (1, 2, 10):
        slight = Launch.from_drag(30.0, 0.5, 5e-324, n=n).range()
        assert slight == pytest.approx(Launch(30.0, 0.5, np.inf).range(), rel=1e-15)


@pytest.mark.parametrize("spacing", ["arc", "time", "x"])
@pytest.mark.parametrize("air", [{}, {"wind": 4.0, "crosswind": -3.0, "slope": 0.1}])
def test_the_spacing_of_a_trajectory(spacing, air):
    launch = Launch([30.0, 5.0], [0.7, 0.2], 40.0, height=2.0, n=[[2.0], [1.5]], **air)
    path, end = launch.trajectory(9, spacing=spacing), launch.landing()
    row, last = {
        "arc": (path.s, end.arc_length), "time": (path.t, end.t), "x": (path.x, end.x)
    }[spacing]  # fmt: skip
    assert row.shape == (2, 2, 9)
    even = last[..., np.newaxis] * np.linspace(0, 1, 9)
    np.testing.assert_allclose(row, even, rtol=1e-9, atol=1e-10)
    for name in ("t", "x", "y", "z", "speed", "alpha"):
        np.testing.assert_allclose(getattr(path, name)[..., -1], getattr(end, name), rtol=1e-15)
    found = launch.at(t=path.t[..., 4])
    np.testing.assert_allclose(path.x[..., 4], found.x, rtol=1e-12)
    np.testing.assert_allclose(path.y[..., 4], found.y, rtol=1e-11)


def test_what_a_path_is_not_asked():
    launch = Launch(30.0, 0.7, 40.0)
    for wrong, words in (
        ({"spacing": "even"}, "spacing must be one of arc, time, x; got 'even'"),
        ({"points": 1}, "points must be >= 2; got 1"),
    ):
        with pytest.raises(ValueError, match=words):
            launch.trajectory(**wrong)
    with pytest.raises(ValueError, match="not for a headwind"):
        Launch(30.0, 0.7, 40.0, wind=-1.0).trajectory(spacing="x")
    with pytest.raises(TypeError, match=r"give exactly one of t, x, y, s, alpha; got t, x"):
        launch.at(t=1.0, x=2.0)
    with pytest.raises(TypeError, match="rising goes with y"):
        launch.at(t=1.0, rising=True)
    with pytest.raises(TypeError, match="rising goes with y, and is True or False"):
        launch.at(y=1.0, rising=1)


def test_the_right_constructor_is_named():
    with pytest.raises(TypeError, match=r"takes no mass: use Launch.from_body\(v0, alpha0, mass="):
        Launch(30.0, 0.7, mass=0.1)
    with pytest.raises(TypeError, match=r"takes no k: use Launch.from_drag\(v0, alpha0, k\)"):
        Launch(30.0, 0.7, k=0.1)


def test_sensitivity_says_what_it_does_not_know():
    for word in ("slope", "wind", "crosswind"):
        with pytest.raises(ValueError, match=f"range_sensitivity knows no {word}: take differ"):
            sensitivity.range_sensitivity(30.0, 0.7, 40.0, **{word: 0.1})


class TestSlopesAndWinds:
    """Where the ground is met hardly after the launch, or the launch is one of the extremes."""

    @pytest.mark.parametrize("above", [1e-2, 1e-4, 1e-7, 1e-10])
    @pytest.mark.parametrize("slope", [0.3, -0.8])
    def test_launched_hardly_above_the_slope(self, above, slope):
        alpha0 = slope + above
        t = 2 * 10.0 * np.sin(alpha0 - slope) / (9.81 * np.cos(slope))
        for v_lim in (np.inf, 1e9):
            landing = Launch(10.0, alpha0, v_lim, slope=slope).landing()
            assert landing.t == pytest.approx(t, rel=landing.error + 1e-8)
            assert landing.t == pytest.approx(t, rel=1e-15 / above + 1e-8)

    def test_a_wind_does_nothing_in_vacuum(self):
        launch = Launch(0.012129213824357976, -0.2522699795017111, np.inf, n=1.0,
                        slope=-0.8169836906782288, wind=-37.6989011789417)  # fmt: skip
        landing = launch.landing()
        assert landing.t == pytest.approx(0.0019335871710862167, rel=1e-14)
        assert landing.error < 1e-12
        x = launch.v0 * np.cos(launch.alpha0) * np.array([1e-3, 2.0])
        assert launch.at(x=x).t == pytest.approx([1e-3, 2.0], rel=1e-15)
        assert launch.at(x=-1.0).status == 1
        up = Launch(2000.0, np.pi / 2, np.inf, height=1200.0, wind=2.0).landing()
        assert up.x == pytest.approx(2000 * np.cos(np.pi / 2) * up.t, rel=1e-14)
        assert up.error < 1e-12

    def test_at_rest(self):
        landing = Launch(0.0, 0.2, 118.0, slope=-0.86).landing()
        assert (landing.t, landing.x, landing.status) == (0, 0, 0)
        assert landing.error < 1e-13
        assert Launch(0.0, 0.6, 0.2, n=1.0, height=1000.0, slope=-1.0).apex() == (0, 1000, 0)
        assert Launch(0.0, 0.2, 118.0, slope=-0.86).landing().alpha == pytest.approx(
            Launch(1e-6, 0.2, 118.0, slope=-0.86).landing().alpha, rel=1e-6
        )
        beside = Launch([0.0, 9.0], 0.4, 20.0, slope=[0.0, 0.1]).landing()
        assert beside.alpha[0] == pytest.approx(Launch(0.0, 0.4, 20.0).landing().alpha, rel=1e-14)
        falling = Launch(0.0, 0.6, 20.0, height=1000.0, slope=-1.0).landing()
        assert falling.t == pytest.approx(
            20 / 9.81 * np.arccosh(np.exp(9.81 * 1000 / 400)), rel=1e-14
        )
        assert falling.error < 1e-12

    @pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0])
    def test_straight_up_over_a_slope(self, n):
        v_lim, height = 2.6639301953686636, 91.16840984119719
        flat, steep = (
            Launch(1000.0, np.pi / 2, v_lim, n=n, height=height, slope=slope).landing()
            for slope in (0.0, -0.88)
        )
        assert steep.t == pytest.approx(flat.t, rel=1e-14)
        assert steep.arc_length == pytest.approx(flat.arc_length, rel=1e-14)

    @pytest.mark.parametrize("n", [1.0, 2.0])
    def test_below_the_ground_beside_one_that_is_blown_along(self, n):
        below = (93.27, -0.45, 12.43, -38.1, -0.2156, 38.2)
        blown = (10.0, 0.0, 10.0, 5.0, -1.05, 30.0)
        v0, alpha0, v_lim, height, slope, wind = np.array([below, blown]).T
        landing = Launch(v0, alpha0, v_lim, n=n, height=height, slope=slope, wind=wind).landing()
        assert landing.status.tolist() == [1, 1]
        assert np.isnan(landing.t).all()


class TestStates:
    @pytest.mark.parametrize("t", [1e-5, 1e-3, 3e-3, 8e-3, 0.1, 3.0])
    @pytest.mark.parametrize("many", [1, 20])
    def test_near_the_launch_to_the_last_digits(self, t, many):
        """Linear drag has closed forms."""
        launch = Launch(np.full(many, 20.0), 0.3, 20.0, n=1.0)
        tau = 20 / 9.81
        fallen = -np.expm1(-t / tau)
        state = launch.at(t=t)
        assert state.x == pytest.approx(20 * np.cos(0.3) * tau * fallen, rel=3e-15)
        y = tau * (20 * np.sin(0.3) + 20) * fallen - 20 * t
        assert state.y == pytest.approx(y, rel=3e-15 * (20 * t / abs(y)) + 3e-15)

    def test_quadratic_drag_near_the_launch(self):
        """s(t) = v_lim^2 / g ln(1 + g t v / v_lim^2) to the order of g, straight down at v_lim."""
        for t in (1e-4, 2e-3, 5e-3):
            for launch in (Launch(20.0, -np.pi / 2, 20.0), Launch([20.0] * 20, -np.pi / 2, 20.0)):
                state = launch.at(t=t)
                assert state.s == pytest.approx(20 * t, rel=1e-15)
                assert state.y == pytest.approx(-20 * t, rel=1e-15)

    @pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0])
    @pytest.mark.parametrize("many", [1, 20])
    def test_the_height_of_the_apex_is_reached(self, n, many):
        launch = Launch(np.full(many, 40.0), 0.7, 30.0, n=n)
        _, y, t = launch.apex()
        for rising in (True, False):
            state = launch.at(y=y, rising=rising)
            assert state.success.all()
            assert state.t == pytest.approx(t, abs=1e-7)
        assert (launch.at(y=y * (1 + 1e-13)).status == 1).all()

    @pytest.mark.parametrize("n", [1.0, 2.0, 3.0])
    def test_straight_up_in_a_wind(self, n):
        launch = Launch(100.0, np.pi / 2, 20.0, n=n, wind=2.0)
        there = launch.at(t=52.479392164039645)
        assert launch.at(x=there.x).t == pytest.approx(there.t, rel=1e-13)


def test_results_share_no_memory():
    rows = list(vars(Launch([20.0, 30.0], 0.5, 40.0).landing()).values())
    for i, row in enumerate(rows):
        assert not any(np.shares_memory(row, other) for other in rows[i + 1 :])
