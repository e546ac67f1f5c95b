"""Derivatives of the range, and the best angle for any landing height, against mpmath."""

import mpmath
import numpy as np
import pytest
from scipy.optimize import elementwise

from hodograph import Launch, laws, optimal_angle, reference
from hodograph.engine import driver
from hodograph.sensitivity import best_angle, range_sensitivity


def exact(v, alpha0, height):
    """Range in v_lim^2 / g, to 40 digits."""
    return reference.flight(v, alpha0, height, dps=40).x


def slope(f, x):
    """Derivative by Richardson's central difference, to about 20 digits."""
    with mpmath.workdps(50):
        x = mpmath.mpf(x)
        step = mpmath.mpf(10) ** -9 * (abs(x) or 1)

        def central(h):
            return (f(x + h) - f(x - h)) / (2 * h)

        return (4 * central(step) - central(2 * step)) / 3


CASES = [
    (1.0, 0.7, 0.0),
    (0.01, 0.3, 0.0),
    (1e-4, 1.0, 0.0),
    (1e3, 1.2, 0.0),
    (2.0, 0.01, 0.0),
    (1.0, -0.5, 0.3),
    (0.3, 0.8, -0.01),
    (1.0, 0.7, 20.0),
    (1.0, 1.57, 0.0),
    (50.0, 1.57, 0.0),
    (1.0, 0.0, 0.5),
]


@pytest.mark.parametrize(("v", "alpha0", "height"), CASES)
def test_against_mpmath(v, alpha0, height):
    found = range_sensitivity(v, alpha0, 1.0, g=1.0, height=height)
    assert found.range == pytest.approx(float(exact(v, alpha0, height)), rel=1e-14)
    by_angle = slope(lambda a: exact(v, a, height), alpha0)
    assert found.alpha0 == pytest.approx(float(by_angle), rel=2e-12, abs=1e-14 * found.range)
    by_speed = slope(lambda s: exact(s, alpha0, height), v)
    assert found.v0 == pytest.approx(float(by_speed), rel=1e-13)
    # R = l^2 X(v / l, alpha0, h / l^2), v_lim = l
    by_limit = slope(lambda x: x * x * exact(v / x, alpha0, height / x**2), 1)
    assert found.v_lim == pytest.approx(float(by_limit), rel=1e-13)
    if height:
        by_height = slope(lambda h: exact(v, alpha0, h), height)
        assert found.height == pytest.approx(float(by_height), rel=1e-13)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("v", "alpha0", "rel"),
    [
        (1e5, 0.2, 1e-13),
        (1e4, 1.5707, 2e-13),
        (1e3, 1.54, 2e-13),
        (1e2, 1.54, 2e-13),
        (1e3, 1.5606, 2e-13),
        (6e3, 1.5606, 2e-13),
        (3e5, 1.5606, 2e-13),
        (2.5e3, 1.36, 1e-11),  # cos(alpha0) above STEEP: by the closed form
    ],
)
def test_fast_and_steep(v, alpha0, rel):
    found = range_sensitivity(v, alpha0, 1.0, g=1.0).alpha0
    assert found == pytest.approx(float(slope(lambda a: exact(v, a, 0), alpha0)), rel=rel)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("height", "rel"), [(1.0, 2e-13), (-1.0, 2e-13), (-6.8937, 1e-9), (-6.90075, 1e-9)]
)
def test_fast_and_steep_to_another_height(height, rel):
    # the highest point is at 6.9014: 1e-3 and 1e-4 below it are the last two
    v, alpha0 = 1e3, float(np.arccos(0.04))
    found = range_sensitivity(v, alpha0, 1.0, g=1.0, height=height).alpha0
    truth = slope(lambda a: exact(v, a, height), alpha0)
    assert found == pytest.approx(float(truth), rel=rel)


@pytest.mark.parametrize(
    ("height", "by_angle", "by_speed"), [(1e-3, 1e-11, 5e-11), (1e-6, 5e-9, 4e-9)]
)
def test_short_downward_fall(height, by_angle, by_speed):
    # dR/dv0 is 2.7e-8 of R / v0 from 1e-6 m, and loses as many digits
    v0, alpha0, v_lim, g = 40.0, -0.5, 42.7, 9.81
    found = range_sensitivity(v0, alpha0, v_lim, g=g, height=height)
    with mpmath.workdps(50):
        length = mpmath.mpf(v_lim) ** 2 / mpmath.mpf(g)
        limit = mpmath.mpf(v_lim)

        def distance(v, a):
            return length * exact(v / limit, a, mpmath.mpf(height) / length)

        truth = distance(mpmath.mpf(v0), alpha0)
        turned = slope(lambda a: distance(mpmath.mpf(v0), a), alpha0)
        faster = slope(lambda v: distance(v, alpha0), v0)
    assert found.range == pytest.approx(float(truth), rel=1e-14)
    assert found.alpha0 == pytest.approx(float(turned), rel=by_angle)
    assert found.v0 == pytest.approx(float(faster), rel=by_speed)


def test_vacuum_by_hand():
    v0, a, g = 20.0, 0.6, 9.81
    found = range_sensitivity(v0, a, np.inf)
    assert found.range == pytest.approx(v0**2 * np.sin(2 * a) / g, rel=1e-14)
    assert found.alpha0 == pytest.approx(2 * v0**2 * np.cos(2 * a) / g, rel=1e-13)
    assert found.v0 == pytest.approx(2 * v0 * np.sin(2 * a) / g, rel=1e-14)
    assert found.v_lim == 0
    assert found.height == pytest.approx(1 / np.tan(a), rel=1e-14)


def test_upright_range_turns_over():
    # cos(alpha0) changes sign at 90 degrees: the range goes as -(alpha0 - 90 degrees)
    found = range_sensitivity(3.0, np.pi / 2, 1.0, g=1.0)
    near = Launch(3.0, np.pi / 2 - 1e-4, 1.0, g=1.0).range() / np.sin(1e-4)
    assert found.alpha0 == pytest.approx(-near, rel=1e-6)


def test_shape_nan_and_refusals():
    found = range_sensitivity([[10.0], [20.0]], [0.3, np.nan, 0.6], 30.0)
    assert all(part.shape == (2, 3) for part in found)
    assert np.isnan(found.v0[:, 1]).all()
    assert np.isfinite(found.v0[:, [0, 2]]).all()
    unreachable = range_sensitivity(1.0, 0.5, 1.0, g=1.0, height=-1.0)
    assert np.isnan(unreachable).all()
    assert np.isnan(range_sensitivity(1.0, 0.0, 1.0)).all()  # a level launch goes nowhere
    for arguments in ((0.0, 0.5, 1.0), (1.0, 2.0, 1.0), (1.0, 0.5, 0.0), (1e61, 0.5, 1.0)):
        with pytest.raises(ValueError, match=r"v0|alpha0|v_lim"):
            range_sensitivity(*arguments)


def test_best_angle_on_level_ground_is_optimal_angle():
    v = np.array([1e-6, 0.1, 1.0, 3.0, 1e3, 1e8])
    np.testing.assert_array_equal(best_angle(v, 1.0), optimal_angle(v))
    # and by the other way round: a height too small to matter
    np.testing.assert_allclose(
        best_angle(v, 1.0, g=1.0, height=1e-40), optimal_angle(v), rtol=1e-13
    )
    slopes = range_sensitivity(v, optimal_angle(v), 1.0, g=1.0)
    np.testing.assert_allclose(slopes.alpha0 / slopes.range, 0, atol=1e-14)


@pytest.mark.parametrize(
    ("v", "height"), [(1.0, 0.5), (1.5, -0.05), (3.0, 10.0), (30.0, 0.01), (1.0, -0.25), (1e-3, 10)]
)
def test_best_angle_against_mpmath(v, height):
    found = best_angle(v, 1.0, g=1.0, height=height)

    def rise(a):
        h = mpmath.mpf(10) ** -12
        return exact(v, a + h, height) - exact(v, a - h, height)

    with mpmath.workdps(45):  # one secant step through two points beside it
        a, b = (mpmath.mpf(float(found)) * (1 + s * mpmath.mpf(10) ** -8) for s in (-1, 1))
        fa, fb = rise(a), rise(b)
        root = (a * fb - b * fa) / (fb - fa)
    assert found == pytest.approx(float(root), rel=1e-12)


def test_best_angle_in_vacuum():
    v0, h = 14.0, np.array([-5.0, 0.0, 2.0, 1e3])
    expected = np.arctan(v0 / np.sqrt(v0**2 + 2 * 9.81 * h))
    np.testing.assert_allclose(best_angle(v0, np.inf, height=h), expected, rtol=1e-13)
    assert np.isnan(best_angle(v0, np.inf, height=-11.0))  # above the highest point
    assert np.isnan(best_angle([np.nan, 1.0], 1.0, height=np.nan)).all()


@pytest.mark.parametrize(
    ("below", "printed"), [(50.0, 269.451), (100.0, 286.965), (200.0, 310.601), (500.0, 337.36)]
)
def test_published(below, printed):
    # TroyWigton/ProjectileTrajectory: v0 100, k 0.0057
    v_lim = np.sqrt(9.81 / 0.0057)
    best = best_angle(100.0, v_lim, height=below)
    found = Launch(100.0, best, v_lim, height=below).range()
    assert found == pytest.approx(printed, abs=6e-4)
    # the last one is printed with a digit less


def test_small_speed_expansion():
    # the maximum of sin(2a) (1 - c1(a) v^2) is at 45 degrees - c1'(45 degrees) v^2 / 4
    with mpmath.workdps(45):
        root = mpmath.sqrt(2)
        first = -mpmath.degrees((3 * root - mpmath.log(1 + root)) / 32)
        speeds = [mpmath.mpf(k) / 100 for k in range(1, 6)]
        off = [(mpmath.degrees(reference.optimal_angle(v, dps=40)) - 45) / v**2 for v in speeds]
        powers = mpmath.matrix([[v ** (2 * j) for j in range(5)] for v in speeds])
        series = mpmath.lu_solve(powers, mpmath.matrix(off))
    assert float(series[0]) == pytest.approx(float(first), rel=1e-13)
    assert float(first) == pytest.approx(-6.0183256, abs=5e-8)
    assert float(series[1]) == pytest.approx(3.2897596, abs=5e-8)


def test_the_law_agrees():
    assert laws.alpha_max_law(2.0) == pytest.approx(best_angle(2.0, 1.0), rel=1e-4)


def test_a_launch_almost_at_rest():
    # all but dR/dv0 in proportion to v0, and R = v0 cos(alpha0) times the time of a fall from rest
    v_lim, g, height, a = 3.0, 9.81, 2.0, 0.3
    slow, slower = (range_sensitivity(v, a, v_lim, height=height) for v in (1e-18, 1e-30))
    for name in ("range", "alpha0", "v_lim", "height"):
        ratio = getattr(slower, name) / 1e-30 / (getattr(slow, name) / 1e-18)
        assert ratio == pytest.approx(1, rel=1e-13), name
    truth = reference.flight("1e-30", a, height * g / v_lim**2)
    assert slower.range / 1e-30 == pytest.approx(float(truth.x * 10**30) * v_lim / g, rel=1e-13)
    assert slower.v0 == pytest.approx(slower.range / 1e-30, rel=1e-13)
    assert slower.range == pytest.approx(Launch(1e-30, a, v_lim, height=height).range(), rel=1e-15)
    level = range_sensitivity(1e-30, a, v_lim)
    assert level.range == pytest.approx(1e-60 * np.sin(2 * a) / g, rel=1e-14)
    assert level.v_lim < 1e-100
    assert level.v0 == pytest.approx(2e-30 * np.sin(2 * a) / g, rel=1e-14)
    assert level.height == pytest.approx(1 / np.tan(a), rel=1e-14)


@pytest.mark.parametrize("v", [1e-12, 1e-20, 1e-30])
def test_best_angle_almost_at_rest(v):
    # in vacuum by hand; with drag alpha = v c (1 + O(v)), c by mpmath from a slow launch
    height = 1.0
    vacuum = best_angle(v, np.inf, height=height)
    assert vacuum == pytest.approx(v / np.sqrt(2 * 9.81 * height), rel=1e-13)
    with mpmath.workdps(60):
        # R = v cos(a) (x1 + x2 v sin(a)): tan(a) = v x2 / x1
        tiny = mpmath.mpf(10) ** -15
        across = reference.flight(tiny, 0, height, dps=60).x / tiny
        lean = mpmath.mpf(10) ** -3
        up, down = (reference.flight(tiny, s * lean, height, dps=60).x for s in (1, -1))
        c = (up - down) / (tiny**2 * mpmath.sin(2 * lean)) / across
    assert best_angle(v, 1.0, g=1.0, height=height) / v == pytest.approx(float(c), rel=1e-11)


def test_deep_falls():
    # once at terminal speed, R does not change and dR/dh falls as exp(-depth)
    at = range_sensitivity(1.0, 0.3, 1.0, g=1.0, height=np.array([42.0, 60.0, 1e4, 1e15, 1e20]))
    assert np.all(at.range == pytest.approx(at.range[0], rel=1e-14))
    np.testing.assert_allclose(at.v_lim, at.v_lim[0], rtol=1e-13)
    np.testing.assert_allclose(at.v0 + at.v_lim, 2 * at.range, rtol=1e-13)  # R goes as a length
    assert at.height[1] == pytest.approx(at.height[0] * np.exp(-18), rel=1e-12)
    assert np.all(at.height[2:] == 0)


def test_extremes_are_refused_or_answered_without_a_warning():
    for call in (lambda: range_sensitivity(1e30, 0.5, 1e-20), lambda: best_angle(1e30, 1e-20)):
        with pytest.raises(ValueError, match=r"v0 / v_lim must be at most 1e20"):
            call()
    for height in (1e30, -1e30):
        with pytest.raises(ValueError, match=r"abs\(height\) \* g / v_lim\*\*2 must be at most"):
            range_sensitivity(1.0, 0.5, 1e-19, height=height)
        with pytest.raises(ValueError, match=r"abs\(height\) \* g / v_lim\*\*2 must be at most"):
            best_angle(1.0, 1e-19, height=height)
    found = range_sensitivity(1e30, 0.5, np.inf)
    assert found.range == pytest.approx(1e60 * np.sin(1.0) / 9.81, rel=1e-14)
    assert found.v_lim == 0
    assert np.isfinite(best_angle(1e20, 1.0, height=1e19))
    assert np.isnan(best_angle(1e-30, 1.0, height=-1.0))


def test_failures_are_told(monkeypatch):
    found = elementwise.find_root

    def fail(*args, **kwargs):
        result = found(*args, **kwargs)
        result.success = np.zeros_like(result.success)
        return result

    monkeypatch.setattr(driver, "FEW", 0)
    monkeypatch.setattr(elementwise, "find_root", fail)
    with pytest.warns(RuntimeWarning, match="not converged for 2 of 3 launches"):
        angle = best_angle(1.0, 1.0, height=[0.1, -100.0, 0.2])  # the second is out of reach
    assert np.isnan(angle).all()


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0, 7.0])
@pytest.mark.parametrize("v", [1e-5, 1.0, 2e4])
@pytest.mark.parametrize("height", [30.0, 2e4])
def test_a_fall_at_terminal_speed(n, v, height):
    """dR/dv_lim, unlike the others, owes as much to it as the range does."""
    for alpha0 in (0.3, -0.5):
        found = range_sensitivity(v, alpha0, 1.0, g=1.0, height=height, n=n)
        true = reference.sensitivity(v, alpha0, height, n=n, dps=20)
        size = {"alpha0": true.range}
        for name in ("range", "alpha0", "v0", "v_lim"):
            value = getattr(true, name)
            error = abs(getattr(found, name) - value)
            assert error <= 1e-13 * (abs(value) + size.get(name, 0)), (alpha0, name)
