"""d_norm against mpmath, its limits in closed form, and the equations of motion."""

import numpy as np
import pytest

from hodograph import d_norm, d_ref, ode, reference

DEGREES = [1e-4, 0.1, 1.0, 5.0, 20.0, 45.0, 60.0, 80.0, 89.0, 89.9, 89.9999, 89.999999999, 90.0]


@pytest.mark.parametrize("v", [1e-6, 1e-3, 0.1, 0.7, 1.0, 1.3, 1.5])
@pytest.mark.parametrize("degrees", DEGREES)
def test_against_mpmath_on_the_papers_domain(v, degrees):
    alpha0 = np.deg2rad(degrees)
    truth = float(reference.d_norm(v, alpha0))
    assert d_norm(v, alpha0) == pytest.approx(truth, rel=1e-14)


def test_against_the_equations_of_motion():
    for v, degrees in [(0.2, 10.0), (1.0, 45.0), (1.5, 80.0), (10.0, 89.0)]:
        alpha0 = np.deg2rad(degrees)
        flight = ode.solve(v, alpha0, 1.0, g=1.0, rtol=1e-12, atol=1e-14)
        assert d_norm(v, alpha0) == pytest.approx(flight.x / (v * v * np.sin(2 * alpha0)), rel=1e-9)


def test_limits_are_exact():
    angles = np.deg2rad(np.linspace(0, 90, 91))
    assert np.all(d_norm(0.0, angles) == 1.0)
    assert np.all(d_norm([0.0, 1.0, 1e8, 1e20], 0.0) == 1.0)


def test_vertical_limit():
    v = np.geomspace(1e-6, 1e8, 57)
    closed = (np.arcsinh(v) + np.arctan(v)) / (2 * v * np.sqrt(1 + v * v))
    np.testing.assert_allclose(d_norm(v, np.pi / 2), closed, rtol=1e-14)


def test_weak_drag_to_second_order():
    # d_norm = 1 - c1 v^2 + O(v^4), c1 from the vacuum path (DESIGN fact 7, derived in the docs)
    a = np.deg2rad(np.linspace(2, 88, 44))
    s, c2 = np.sin(a), np.cos(a) ** 2
    c1 = 0.75 * s + c2 / (8 * s) + np.arctanh(s) * c2 * (0.5 - c2 / (8 * s * s))
    v = 1e-3
    np.testing.assert_allclose((1 - d_norm(v, a)) / v**2, c1, rtol=3e-6)


def test_low_angle_limit_is_the_straight_line_with_drag():
    # alpha0 -> 0 with beta = v^2 alpha0 held: the slope obeys dp/dx = -g/v_x^2, v_x = v0 exp(-x),
    # so that y = 0 where alpha0 x = (exp(2 x) - 1 - 2 x) / (4 v^2)
    from scipy.optimize import brentq

    alpha0 = 1e-9
    for beta in (0.01, 1.0, 100.0):
        v = np.sqrt(beta / alpha0)
        x = brentq(lambda x, b=beta: np.expm1(2 * x) - 2 * x - 4 * b * x, 1e-9, 50, xtol=1e-15)
        assert d_norm(v, alpha0) == pytest.approx(x / (2 * beta), rel=1e-8)


def test_range_without_drag():
    assert d_ref(10.0, np.pi / 4, g=10.0) == pytest.approx(10.0, rel=1e-15)
    np.testing.assert_allclose(d_ref(3.0, 0.3), 9 * np.sin(0.6) / 9.81, rtol=1e-15)
