"""Drag of any exponent: mpmath from eq. 8, the Lambert-W flight, published cases, time stepping."""

from itertools import pairwise

import mpmath
import numpy as np
import pytest
from scipy.special import lambertw

from hodograph import Launch, d_norm, landing_angle, ode, optimal_angle
from hodograph.level import balanced_exponent

CONTEXT = mpmath.MPContext()
CONTEXT.dps = 25
EXPONENTS = (1.0, 1.5, 2.5, 3.0, 4.0, 5.0)


class Truth:
    """x, t, landing slope and speed from eq. 8 and 15, with G as a hypergeometric function."""

    def __init__(self, v, alpha0, n, start):
        c = CONTEXT
        v, alpha0, n = c.mpf(v), c.mpf(alpha0), c.mpf(n)
        self.n, self.s0, self.w = n, c.asinh(c.tan(alpha0)), v * c.cos(alpha0)
        self.eta = c.log1p(v**-n) / n
        self.G0 = self.G(self.s0)
        rise = self.integral(self.dy, self.s0, 0)
        s = -c.asinh(c.mpf(start))
        self.rest = 0
        if s > -35:
            for _ in range(4):  # Newton on y, from a start that only speeds it up
                s += (rise + self.integral(self.dy, 0, s)) / self.dy(s)
        else:  # vertical and at terminal speed from here on
            s = -60 + min(0, c.log(self.vx(c.zero)))
            self.rest = rise + self.integral(self.dy, 0, s)
        self.x = self.integral(self.dx, self.s0, 0) + self.integral(self.dx, 0, s)
        self.t = self.integral(self.dt, self.s0, 0) + self.integral(self.dt, 0, s) + self.rest
        self.alpha = c.atan(c.sinh(s))
        self.speed = self.vx(s) * c.cosh(s)

    def G(self, s):
        c, p = CONTEXT, CONTEXT.sinh(s)
        return p * c.hyp2f1(c.mpf(1) / 2, (1 - self.n) / 2, c.mpf(3) / 2, -p * p)

    def vx(self, s):
        U = 1 + self.n * self.w**self.n * (self.G0 - self.G(s))
        return self.w * U ** (-1 / self.n)

    def dx(self, s):
        return self.vx(s) ** 2 * CONTEXT.cosh(s)

    def dy(self, s):
        return self.vx(s) ** 2 * CONTEXT.cosh(s) * CONTEXT.sinh(s)

    def dt(self, s):
        return self.vx(s) * CONTEXT.cosh(s)

    def integral(self, f, high, low):
        c = CONTEXT
        a, b = (c.log1p((self.s0 - s) / self.eta) for s in (high, low))
        panels = int(5 + 2 * abs(high - low))
        ends = [
            self.s0 - self.eta * c.expm1(b + (a - b) * c.mpf(k) / panels) for k in range(panels + 1)
        ]
        return c.quad(f, ends, maxdegree=5)


def check(v, degrees, n):
    alpha0 = float(np.deg2rad(degrees))
    landing = Launch(v, alpha0, 1.0, g=1.0, n=n).landing()
    truth = Truth(v, alpha0, n, -np.tan(landing.alpha))
    for name in ("x", "t", "alpha", "speed"):
        assert getattr(landing, name) == pytest.approx(float(getattr(truth, name)), rel=1e-13)
    assert landing_angle(v, alpha0, n=n) == landing.alpha


@pytest.mark.parametrize("n", EXPONENTS)
@pytest.mark.parametrize(("v", "degrees"), [(0.3, 45.0), (5.0, 20.0)])
def test_against_mpmath(v, degrees, n):
    check(v, degrees, n)


@pytest.mark.slow
@pytest.mark.parametrize("n", EXPONENTS)
@pytest.mark.parametrize(("v", "degrees"), [(5.0, 0.5), (0.01, 85.0), (5.0, 89.9)])
def test_against_mpmath_at_every_corner(v, degrees, n):
    check(v, degrees, n)


def test_two_is_the_engine_itself():
    rng = np.random.default_rng(2)
    v, alpha0 = rng.uniform(0.01, 5, 300), rng.uniform(1e-3, np.pi / 2, 300)
    almost = d_norm(v, alpha0, n=2.0 + 1e-15)  # by panels
    np.testing.assert_allclose(almost, d_norm(v, alpha0), rtol=2e-14)


@pytest.mark.parametrize("v", [0.05, 0.5, 2.0, 5.0])
def test_linear_drag_against_lambert_w(v):
    alpha0 = np.deg2rad(np.array([10.0, 45.0, 80.0]))
    z = 1 + v * np.sin(alpha0)
    t = z + lambertw(-z * np.exp(-z)).real
    launch = Launch(v, alpha0, 1.0, g=1.0, n=1)
    np.testing.assert_allclose(launch.flight_time(), t, rtol=1e-13 / v)
    np.testing.assert_allclose(launch.range(), -v * np.cos(alpha0) * np.expm1(-t), rtol=1e-13 / v)


def linear(v, alpha0, height):
    """x, t, speed and slope angle of the landing under linear drag; None where there is none."""
    c = CONTEXT
    with c.workdps(40 + 2 * int(abs(np.log10(v)) + abs(np.log10(abs(alpha0))))):
        v, alpha0, height = c.mpf(v), c.mpf(alpha0), c.mpf(height)
        vx, vy = v * c.cos(alpha0), v * c.sin(alpha0)
        top = c.log1p(max(vy, 0))
        if height < 0 and height + (vy + 1) * (1 - c.exp(-top)) - top < 0:
            return None
        z = height + vy + 1
        t = z + c.lambertw(-(vy + 1) * c.exp(-z)).real
        vx_end, vy_end = vx * c.exp(-t), (vy + 1) * c.exp(-t) - 1
        truth = -vx * c.expm1(-t), t, c.hypot(vx_end, vy_end), c.atan2(vy_end, vx_end)
        return [float(value) for value in truth]


LINEAR_SPEEDS = (1e-3, 1.0, 1e3, 1e6, 1e11, 1e15, 1e20)


@pytest.mark.parametrize("alpha0", [1e-110, 1e-12, 1e-6, 1e-3, 0.1, 0.8, 1.57, np.pi / 2])
def test_linear_drag_up_to_the_limit(alpha0):
    landing = Launch(LINEAR_SPEEDS, alpha0, 1.0, g=1.0, n=1).landing()
    truth = np.transpose([linear(v, alpha0, 0.0) for v in LINEAR_SPEEDS])
    assert np.all(landing.status == 0)
    found = landing.x, landing.t, landing.speed, landing.alpha
    np.testing.assert_allclose(found, truth, rtol=1e-12)
    ratio = d_norm(LINEAR_SPEEDS, alpha0, n=1)
    np.testing.assert_allclose(
        ratio, truth[0] / np.sin(2 * alpha0) / LINEAR_SPEEDS / LINEAR_SPEEDS, rtol=1e-12
    )


@pytest.mark.parametrize("height", [1e-3, 50.0, 1e4, -1e-3, -10.0])
@pytest.mark.parametrize("alpha0", [-1.5, -1e-3, 1e-6, 1e-3, 0.8])
def test_linear_drag_onto_other_heights(alpha0, height):
    landing = Launch(LINEAR_SPEEDS, alpha0, 1.0, g=1.0, n=1, height=height).landing()
    truth = [linear(v, alpha0, height) for v in LINEAR_SPEEDS]
    reached = np.array([row is not None for row in truth])
    np.testing.assert_array_equal(landing.status, np.where(reached, 0, 1))
    if reached.any():
        found = np.array([landing.x, landing.t, landing.speed, landing.alpha])[:, reached]
        truth = np.transpose([row for row in truth if row is not None])
        np.testing.assert_allclose(found, truth, rtol=1e-11)


@pytest.mark.parametrize(("v", "alpha0"), [(1e6, 1e-3), (1e20, 1e-17)])
def test_linear_drag_along_the_path(v, alpha0):
    path = Launch(v, alpha0, 1.0, g=1.0, n=1).trajectory(40)
    lost = -np.expm1(-path.t)
    vx, vy = v * np.cos(alpha0) * np.exp(-path.t), v * np.sin(alpha0) * np.exp(-path.t) - lost
    np.testing.assert_allclose(path.x, v * np.cos(alpha0) * lost, rtol=1e-12)
    y = (v * np.sin(alpha0) + 1) * lost - path.t
    np.testing.assert_allclose(path.y, y, atol=1e-11 * np.max(path.y))
    np.testing.assert_allclose(path.speed, np.hypot(vx, vy), rtol=1e-10)

    def speed(t):
        c = CONTEXT
        return c.hypot(v * c.cos(alpha0) * c.exp(-t), (v * c.sin(alpha0) + 1) * c.exp(-t) - 1)

    ends = np.append(np.arange(0.0, path.t[-1], max(1.0, path.t[-1] / 30)), path.t[-1])
    assert path.s[-1] == pytest.approx(float(CONTEXT.quad(speed, list(ends))), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("v", "alpha0", "n"),
    [(1e6, 1e-2, 1.05), (1e11, 1e-6, 1.2), (1e16, 1e-6, 1.5), (1e6, 0.8, 1.5), (1e6, 1e-3, 3.0)],
)
def test_fast_launches_against_mpmath(v, alpha0, n):
    landing = Launch(v, alpha0, 1.0, g=1.0, n=n).landing()
    with CONTEXT.workdps(25 + int(n * np.log10(v))):
        truth = Truth(v, alpha0, n, -np.tan(landing.alpha))
        for name in ("x", "t", "speed"):
            assert getattr(landing, name) == pytest.approx(float(getattr(truth, name)), rel=1e-12)


@pytest.mark.parametrize("n", [1.0, 1.05, 1.2, 1.5, 3.0, 10.0])
def test_every_fast_launch_lands(n):
    v = 10 ** np.linspace(-6, 20 - 1e-9, 12)
    alpha0 = np.concatenate([-np.geomspace(1e-12, 1.57, 8), np.geomspace(1e-12, np.pi / 2, 8)])
    height = np.geomspace(1e-3, 1e5, 4)
    launch = Launch(v[:, np.newaxis, np.newaxis], alpha0[:, np.newaxis], 1.0, g=1.0, n=n,
                    height=height)  # fmt: skip
    landing = launch.landing()
    assert np.all(landing.status == 0)
    assert np.all(landing.speed[..., -1][v < 1e3] == pytest.approx(1.0, rel=1e-12))
    assert np.all(d_norm(v[:, np.newaxis], alpha0[8:], n=n) <= 1)
    rest = Launch(0.0, alpha0, 1.0, g=1.0, n=n, height=1e5).landing()
    np.testing.assert_allclose(rest.speed, 1.0, rtol=1e-12)


def test_published_linear_cases():
    # Finley prints T 0.1528298566 and R 0.05812082852; PHY432 prints R 43.30067423347
    finley = Launch(1.0, 1.0, 2.0, g=9.8, n=1).landing()
    assert finley.t == pytest.approx(0.1528298566, rel=1e-9)
    assert finley.x == pytest.approx(0.05812082852, rel=1e-9)
    course = Launch.from_drag(100.0, np.deg2rad(30), 2.0, n=1)
    assert course.range() == pytest.approx(43.30067423347, rel=1e-11)


@pytest.mark.parametrize("n", [1.0, 1.7, 3.0, 10.0])
@pytest.mark.parametrize(("degrees", "height"), [(50.0, 0.0), (-20.0, 8.0), (70.0, -2.0)])
def test_against_time_stepping(n, degrees, height):
    alpha0 = np.deg2rad(degrees)
    launch = Launch(20.0, alpha0, 15.0, n=n, height=height)
    landing, path = launch.landing(), launch.trajectory(30)
    flight = ode.solve(20.0, alpha0, 15.0, n=n, height=height, rtol=1e-12, atol=1e-14)
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        assert getattr(landing, name) == pytest.approx(getattr(flight, name), rel=2e-10)
    apex = launch.apex()
    for found, name in zip(apex, ("x", "y", "t"), strict=True):
        assert found == pytest.approx(getattr(flight.apex, name), rel=1e-9, abs=1e-9)
    x, y, vx, vy = flight.at(np.minimum(path.t, flight.t))
    np.testing.assert_allclose(path.x, x, atol=3e-9)
    np.testing.assert_allclose(path.y, y, atol=3e-9)
    np.testing.assert_allclose(path.speed, np.hypot(vx, vy), rtol=3e-9)
    np.testing.assert_allclose(np.diff(path.s), landing.arc_length / 29, rtol=1e-7)


@pytest.mark.parametrize(
    ("n", "v", "alpha0"),
    [
        (1.0, 1e3, 0.7),
        (3.0, 100.0, 0.7),
        (1.5, 1e3, 1.2),
        (1.0, 3.0, np.pi / 2),
        (2.5, 3.0, np.pi / 2),
        (1.0, 1e20, 1e-17),
        (1.0, 1e20, 0.8),
        (3.0, 1e-3, 0.5),
        (10.0, 1e-6, -1e-9),
    ],
)
def test_points_are_evenly_spaced(n, v, alpha0):
    launch = Launch(v, alpha0, 1.0, g=1.0, n=n, height=1.0 if alpha0 < 0 else 0.0)
    for count in (3, 9, 50, 200):
        s = launch.trajectory(count).s
        np.testing.assert_allclose(np.diff(s), s[-1] / (count - 1), rtol=1e-7)
        assert s[-1] == pytest.approx(launch.landing().arc_length, rel=1e-12)


def test_limits():
    angles = np.deg2rad(np.linspace(0, 90, 7))
    for n in (1, 3.5, 10):
        assert np.all(d_norm(0.0, angles, n=n) == 1)
        assert np.all(d_norm([0.0, 2.0], 0.0, n=n) == 1)
        assert d_norm(1.0, 1e-300, n=n) == pytest.approx(1.0, rel=1e-14)
        vacuum = Launch(10.0, angles, np.inf, n=n).range()
        np.testing.assert_allclose(vacuum, 100 * np.sin(2 * angles) / 9.81, atol=1e-13)
    # a fall from high up ends at the terminal speed, whatever the law
    for n in (1, 1.5, 3, 6):
        landing = Launch(3.0, 0.5, 2.0, n=n, height=1e3).landing()
        assert landing.speed == pytest.approx(2.0, rel=1e-14)


class TestBestAngle:
    def test_no_other_angle_reaches_farther(self):
        for n, v in [(1, 0.5), (1, 3.0), (1.5, 1.0), (3, 2.0), (5, 0.8), (5, 3.0)]:
            best = optimal_angle(v, n=n)
            ranges = Launch(v, best + np.array([-1e-3, 0, 1e-3]), 1.0, g=1.0, n=n).range()
            assert ranges[1] > max(ranges[0], ranges[2])

    def test_the_two_forms_of_the_condition_meet(self):
        for n in (1, 1.5, 3, 5):
            below, above = optimal_angle([1 - 1e-9, 1 + 1e-9], n=n)
            assert below == pytest.approx(above, rel=1e-8)

    @pytest.mark.slow
    @pytest.mark.parametrize("v", [1e3, 1e8])
    def test_fast_launches_against_mpmath(self, v):
        c, n, best = CONTEXT, 1.5, float(optimal_angle(v, n=1.5))
        with c.workdps(30 + int(2 * n * np.log10(v))):
            step = c.mpf(10) ** -7 * best
            x = []
            for alpha0 in (best - step, c.mpf(best), best + step):
                alpha = landing_angle(v, float(alpha0), n=n)
                x.append(Truth(v, alpha0, n, -np.tan(alpha)).x)
            error = step * (x[2] - x[0]) / (x[2] - 2 * x[1] + x[0]) / 2 / best
        assert abs(error) < 1e-12

    def test_can_exceed_45_degrees(self):  # Price and Romano 1998, cited for n >= 3.5
        assert optimal_angle(0.3, n=3.5) > np.pi / 4
        assert optimal_angle(0.3, n=3.4) < np.pi / 4
        assert optimal_angle(1.5, n=5) > np.pi / 4

    def test_weak_drag_threshold_to_ten_digits(self):
        c = CONTEXT

        def weak(n):
            def G(p):
                return p * c.hyp2f1(c.mpf(1) / 2, (1 - n) / 2, c.mpf(3) / 2, -p * p)

            A = c.quad(lambda p: p * G(p), [0, 1])
            return (n + 2) * (G(c.mpf(1)) - A) - 2 * A - c.mpf(2) ** ((n + 1) / 2)

        truth = float(c.findroot(weak, 3.4))
        assert truth == pytest.approx(3.4147992596, abs=1e-10)
        assert balanced_exponent(0.0) == pytest.approx(truth, rel=1e-13)
        # and from weak drag itself
        assert balanced_exponent(0.05) == pytest.approx(truth, abs=1e-3)

    @pytest.mark.parametrize(
        "v",
        [1e-12, *(pytest.param(v, marks=pytest.mark.slow) for v in (1e-6, 1e-3, 0.01, 0.05, 0.3))],
    )
    def test_threshold_of_weak_drag(self, v):
        c, found = CONTEXT, balanced_exponent(v)

        def condition(n):  # of the module's docstring, undivided: v^n is what is left of it
            eps, root = c.mpf(v) ** n, c.sqrt(2)

            def G(p):
                return p * c.hyp2f1(c.mpf(1) / 2, (1 - n) / 2, c.mpf(3) / 2, -p * p)

            def U(p):
                return 1 + n * eps * c.mpf(2) ** (-n / 2) * (G(c.one) - G(p))

            q = c.one
            for _ in range(4):  # Newton on the height of the landing
                y = c.quad(lambda p: p * U(p) ** (-2 / n), [-q, 1])
                q += y * U(-q) ** (2 / n) / q
            integral = c.quad(lambda p: (p + q) * U(p) ** (-1 - 2 / n), [-q, 1])
            return 1 + q - root * (1 / root + eps) * integral

        with c.workdps(25 + int(-3.6 * np.log10(v))):
            below, above = (condition(c.mpf(found) * (1 + c.mpf(d))) for d in (-1e-12, 1e-12))
        assert below * above < 0

    def test_threshold_moves_up_with_speed(self):
        exponents = [balanced_exponent(v) for v in (0.0, 0.5, 1.0, 2.0, 5.0)]
        assert all(a < b for a, b in pairwise(exponents))
        v = 1.0
        assert optimal_angle(v, n=balanced_exponent(v)) == pytest.approx(np.pi / 4, rel=1e-12)


@pytest.mark.parametrize(
    ("n", "error", "words"),
    [
        (0.5, ValueError, r"n must be in \[1, 10\]; got 0.5"),
        (10.5, ValueError, r"n must be in \[1, 10\]; got 10.5"),
        ("2", TypeError, "n must be real numbers"),
    ],
)
def test_bad_exponent(n, error, words):
    for call in (
        lambda: d_norm(1.0, 0.5, n=n),
        lambda: landing_angle(1.0, 0.5, n=n),
        lambda: optimal_angle(1.0, n=n),
        lambda: Launch(1.0, 0.5, 1.0, n=n),
        lambda: Launch.from_drag(1.0, 0.5, 1.0, n=n),
    ):
        with pytest.raises(error, match=words):
            call()


def test_the_exponent_broadcasts():
    n = np.array([1.0, 2.0, 3.5, np.nan, 2.0])
    for call in (
        lambda n: d_norm(1.0, 0.5, n=n),
        lambda n: landing_angle(1.0, 0.5, n=n),
        lambda n: optimal_angle(1.0, n=n),
        lambda n: Launch(1.0, 0.5, 1.0, n=n).range(),
        lambda n: Launch.from_drag(1.0, 0.5, 0.3, n=n).flight_time(),
    ):
        found = call(n)
        assert found.shape == n.shape
        np.testing.assert_allclose(found, [call(each) for each in n], rtol=1e-14)
        assert np.isnan(found[3])


def test_speed_beyond_the_domain():
    """The same for every exponent."""
    for n in (1, 2, 5):
        with pytest.raises(ValueError, match=r"v_norm must be in \[0, 1e20\]; got 1e\+30"):
            d_norm(1e30, 0.5, n=n)
        assert 0 < d_norm(1e20, 0.5, n=n) < 1
