"""d_norm, the landing angle and the best angle: mpmath, closed forms, the equations of motion."""

import mpmath
import numpy as np
import pytest
from scipy.optimize import brentq, elementwise

from hodograph import Launch, d_norm, d_ref, landing_angle, ode, optimal_angle, reference
from hodograph.engine import driver, roots

CONTEXT = mpmath.MPContext()
DEGREES = [1e-4, 0.1, 1.0, 5.0, 20.0, 45.0, 60.0, 80.0, 89.0, 89.9, 89.9999, 89.999999999, 90.0]


@pytest.mark.parametrize("v", [1e-6, 1e-3, 0.1, 0.7, 1.0, 1.3, 1.5])
@pytest.mark.parametrize("degrees", DEGREES)
def test_d_norm_against_mpmath_on_the_papers_domain(v, degrees):
    alpha0 = np.deg2rad(degrees)
    truth = float(reference.d_norm(v, alpha0))
    assert d_norm(v, alpha0) == pytest.approx(truth, rel=1e-14)


def test_d_norm_against_the_equations_of_motion():
    for v, degrees in [(0.2, 10.0), (1.0, 45.0), (1.5, 80.0), (10.0, 89.0)]:
        alpha0 = np.deg2rad(degrees)
        flight = ode.solve(v, alpha0, 1.0, g=1.0, rtol=1e-12, atol=1e-14)
        assert d_norm(v, alpha0) == pytest.approx(flight.x / (v * v * np.sin(2 * alpha0)), rel=1e-9)


def test_limits_of_d_norm_are_exact():
    angles = np.deg2rad(np.linspace(0, 90, 91))
    assert np.all(d_norm(0.0, angles) == 1.0)
    assert np.all(d_norm([0.0, 1.0, 1e8, 1e20], 0.0) == 1.0)


def test_vertical_limit():
    v = np.geomspace(1e-6, 1e8, 57)
    closed = (np.arcsinh(v) + np.arctan(v)) / (2 * v * np.sqrt(1 + v * v))
    np.testing.assert_allclose(d_norm(v, np.pi / 2), closed, rtol=1e-14)


def test_weak_drag_to_second_order():
    # d_norm = 1 - c1 v^2 + O(v^4), c1 from the vacuum path (docs/equations.md)
    a = np.deg2rad(np.linspace(2, 88, 44))
    s, c2 = np.sin(a), np.cos(a) ** 2
    c1 = 0.75 * s + c2 / (8 * s) + np.arctanh(s) * c2 * (0.5 - c2 / (8 * s * s))
    v = 1e-3
    np.testing.assert_allclose((1 - d_norm(v, a)) / v**2, c1, rtol=3e-6)


def test_low_angle_limit_is_the_straight_line_with_drag():
    # alpha0 -> 0 with beta = v^2 alpha0 held: the slope obeys dp/dx = -g/v_x^2, v_x = v0 exp(-x),
    # so that y = 0 where alpha0 x = (exp(2 x) - 1 - 2 x) / (4 v^2)
    alpha0 = 1e-9
    for beta in (0.01, 1.0, 100.0):
        v = np.sqrt(beta / alpha0)
        x = brentq(lambda x, b=beta: np.expm1(2 * x) - 2 * x - 4 * b * x, 1e-9, 50, xtol=1e-15)
        assert d_norm(v, alpha0) == pytest.approx(x / (2 * beta), rel=1e-8)


def test_range_without_drag():
    assert d_ref(10.0, np.pi / 4, g=10.0) == pytest.approx(10.0, rel=1e-15)
    np.testing.assert_allclose(d_ref(3.0, 0.3), 9 * np.sin(0.6) / 9.81, rtol=1e-15)


# --- the landing angle ----------------------------------------------------------------------


@pytest.mark.parametrize("v", [1e-6, 0.01, 0.4, 1.0, 1.5])
@pytest.mark.parametrize("degrees", [1e-4, 1.0, 20.0, 45.0, 70.0, 89.0, 89.99999, 90.0])
def test_landing_angle_against_mpmath_on_the_papers_domain(v, degrees):
    alpha0 = np.deg2rad(degrees)
    truth = float(reference.landing_angle(v, alpha0))
    assert landing_angle(v, alpha0) == pytest.approx(truth, rel=1e-15, abs=0)


def test_landing_angle_against_the_equations_of_motion():
    for v, alpha0 in [(0.5, 0.3), (1.5, 1.2), (20.0, 0.8)]:
        flight = ode.solve(v, alpha0, 1.0, g=1.0, rtol=1e-12, atol=1e-14)
        assert landing_angle(v, alpha0) == pytest.approx(flight.alpha, rel=1e-10)


def test_limits_of_the_landing_angle_are_exact():
    assert landing_angle(0.0, 0.7) == -0.7
    assert landing_angle(5.0, 0.0) == 0.0
    assert landing_angle(5.0, np.pi / 2) == -np.pi / 2
    assert landing_angle(1.0, 5e-324) == -5e-324


# --- the angle of greatest range ------------------------------------------------------------


@pytest.mark.parametrize("v", [1e-6, 1e-3, 0.3, 0.999999, 1.000001, 1.5, 5.0, 100.0])
def test_best_angle_against_mpmath(v):
    assert optimal_angle(v) == pytest.approx(float(reference.optimal_angle(v)), rel=1e-13)


@pytest.mark.slow
@pytest.mark.parametrize("v", [1e4, 1e8])
def test_best_angle_against_mpmath_far_out(v):
    assert optimal_angle(v) == pytest.approx(float(reference.optimal_angle(v)), rel=1e-13)


def test_limits_of_the_best_angle():
    assert optimal_angle(0.0) == np.pi / 4
    v = np.array([0.01, 0.02])  # to fourth order, in degrees
    np.testing.assert_allclose(
        np.rad2deg(optimal_angle(v)), 45 - 6.01833 * v**2 + 3.28976 * v**4, atol=5e-9
    )
    far = optimal_angle(np.geomspace(1e-3, 1e20, 200))
    assert np.all(np.diff(far) < 0)
    assert np.all(far > 0)


def test_published_best_angles():
    # TroyWigton/ProjectileTrajectory: v0 100, k 0.001, and v0 975, k 0.0012, best angles
    first = Launch.from_drag(100.0, 0.0, 0.001).v_norm
    second = Launch.from_drag(975.0, 0.0, 0.0012).v_norm
    assert np.rad2deg(optimal_angle(first)) == pytest.approx(40.924, abs=5e-4)
    # 24.766278 is printed as 24.7662, cut rather than rounded
    assert np.rad2deg(optimal_angle(second)) == pytest.approx(24.7662, abs=1e-4)


def test_no_other_angle_reaches_farther():
    for v in (0.2, 1.0, 7.0, 1e5):
        best = optimal_angle(v)
        ranges = Launch(v, best + np.array([-1e-3, 0.0, 1e-3]), 1.0, g=1.0).range()
        assert ranges[1] > max(ranges[0], ranges[2])


def linear(v):
    """The best angle under linear drag, where the derivative of the range in closed form vanishes.

    Launch and landing are perpendicular there, u = e^t has u (ln u - 1) = v^2 - 1, and
    sin(alpha0) = v / (u - 1).
    """
    c = CONTEXT
    with c.workdps(40 + 2 * int(abs(np.log10(v)))):
        v = c.mpf(v)
        u = c.exp(1 + c.lambertw((v * v - 1) / c.e).real)
        return float(c.asin(v / (u - 1)))


def test_linear_drag_against_lambert_w():
    v = np.concatenate([[1e-3, 0.1, 0.5, 2.0, 10.0, 9e3, 1.1e4, 2e4], np.geomspace(1e5, 1e20, 20)])
    np.testing.assert_allclose(optimal_angle(v, n=1), [linear(a) for a in v], rtol=2e-14)


@pytest.mark.parametrize("v", [0.5, 2e4, 1e30])
def test_the_closed_angle_is_the_maximum_of_the_closed_range(v):
    c = CONTEXT

    def distance(alpha0):
        z = 1 + v * c.sin(alpha0)
        return -v * c.cos(alpha0) * c.expm1(-z - c.lambertw(-z * c.exp(-z)).real)

    with c.workdps(150):
        best = c.mpf(linear(v))
        below, above = (distance(best * (1 + c.mpf(d))) for d in (-1e-12, 1e-12))
        assert distance(best) > max(below, above)


@pytest.mark.parametrize("n", [1.0, 1.001, 1.05, 1.2, 1.5, 1.9, 1.999, 2.001, 3.0, 10.0])
def test_no_other_angle_reaches_farther_up_to_the_limit(n):
    v = np.concatenate([[1e-20, 1e-3], np.geomspace(1.5, 10 ** (20 - 1e-9), 12)])
    best = optimal_angle(v, n=n)
    assert np.all((best > 0) & (best < np.pi / 3))
    offset = np.array([0.1, 0.3, 0.7, 1.0, 1.2])[:, np.newaxis]  # flat: x changes as alpha0^2
    ranges = Launch(1.0, best * offset, 1 / v, g=1.0, n=n).range()
    assert np.all(ranges[3] >= ranges.max(axis=0) * (1 - 1e-14))


def test_a_best_angle_that_is_not_found_is_told(monkeypatch):
    monkeypatch.setattr(driver, "FEW", 0)
    monkeypatch.setattr(roots, "ROUNDS", 0)
    find_root = elementwise.find_root
    monkeypatch.setattr(elementwise, "find_root", lambda *a, **k: find_root(*a, maxiter=1, **k))
    with pytest.warns(RuntimeWarning, match="angle not converged for 2 of 3 launches"):
        angle = optimal_angle([0.0, 1.0, 2.0])
    np.testing.assert_array_equal(angle, [np.pi / 4, np.nan, np.nan])
