"""The angle of greatest range, against mpmath, an expansion and published values."""

import numpy as np
import pytest

from hodograph import Launch, optimal_angle, reference


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
    far = optimal_angle(np.geomspace(1e-3, 1e300, 200))
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
