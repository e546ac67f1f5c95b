"""Derivatives of the range, and the best angle for any landing height, against mpmath."""

import mpmath
import numpy as np
import pytest

from hodograph import Launch, laws, optimal_angle, reference
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
    [(1e5, 0.2, 1e-13), (1e4, 1.5707, 1e-12), (1e3, 1.54, 3e-9), (1e2, 1.54, 1e-11)],
)
def test_fast_and_steep(v, alpha0, rel):
    found = range_sensitivity(v, alpha0, 1.0, g=1.0).alpha0
    assert found == pytest.approx(float(slope(lambda a: exact(v, a, 0), alpha0)), rel=rel)


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
