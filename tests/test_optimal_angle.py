"""The angle of greatest range, against mpmath, an expansion and published values."""

import mpmath
import numpy as np
import pytest
from scipy.optimize import elementwise

from hodograph import Launch, optimal_angle, reference
from hodograph.engine import driver

CONTEXT = mpmath.MPContext()


@pytest.mark.parametrize("v", [1e-6, 1e-3, 0.3, 0.999999, 1.000001, 1.5, 5.0, 100.0])
def test_against_mpmath(v):
    assert optimal_angle(v) == pytest.approx(float(reference.optimal_angle(v)), rel=1e-13)


@pytest.mark.slow
@pytest.mark.parametrize("v", [1e4, 1e8])
def test_against_mpmath_far_out(v):
    assert optimal_angle(v) == pytest.approx(float(reference.optimal_angle(v)), rel=1e-13)


def test_limits():
    assert optimal_angle(0.0) == np.pi / 4
    v = np.array([0.01, 0.02])  # DESIGN section 3, issue 5: 45 - 6.01833 v^2 + 3.28976 v^4 degrees
    np.testing.assert_allclose(
        np.rad2deg(optimal_angle(v)), 45 - 6.01833 * v**2 + 3.28976 * v**4, atol=5e-9
    )
    far = optimal_angle(np.geomspace(1e-3, 1e20, 200))
    assert np.all(np.diff(far) < 0)
    assert np.all(far > 0)


def test_published():
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
    """Under linear drag, where the derivative of the range of DESIGN fact 10 vanishes.

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

    def reach(alpha0):
        z = 1 + v * c.sin(alpha0)
        return -v * c.cos(alpha0) * c.expm1(-z - c.lambertw(-z * c.exp(-z)).real)

    with c.workdps(150):
        best = c.mpf(linear(v))
        below, above = (reach(best * (1 + c.mpf(d))) for d in (-1e-12, 1e-12))
        assert reach(best) > max(below, above)


@pytest.mark.parametrize("n", [1.0, 1.001, 1.05, 1.2, 1.5, 1.9, 1.999, 2.001, 3.0, 10.0])
def test_no_other_angle_reaches_farther_up_to_the_limit(n):
    v = np.concatenate([[1e-20, 1e-3], np.geomspace(1.5, 10 ** (20 - 1e-9), 12)])
    best = optimal_angle(v, n=n)
    assert np.all((best > 0) & (best < np.pi / 3))
    offset = np.array([0.1, 0.3, 0.7, 1.0, 1.2])[:, np.newaxis]  # flat: x changes as alpha0^2
    ranges = Launch(1.0, best * offset, 1 / v, g=1.0, n=n).range()
    assert np.all(ranges[3] >= ranges.max(axis=0) * (1 - 1e-14))


def test_failure_is_told(monkeypatch):
    find_root = elementwise.find_root
    monkeypatch.setattr(driver, "FEW", 0)
    monkeypatch.setattr(elementwise, "find_root", lambda *a, **k: find_root(*a, maxiter=1, **k))
    with pytest.warns(RuntimeWarning, match="angle not converged for 2 of 3 launches"):
        angle = optimal_angle([0.0, 1.0, 2.0])
    np.testing.assert_array_equal(angle, [np.pi / 4, np.nan, np.nan])
