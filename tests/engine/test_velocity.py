"""Speed and arc length in closed form, against mpmath and the limits of the paper."""

import numpy as np
import pytest

from hodograph import bodies, path, reference

CASES = [
    (v, np.deg2rad(a0), np.deg2rad(a))
    for v in (1e-6, 0.3, 1.5, 20.0, 1e8)
    for a0, a in [(45, 44.999999), (45, 0), (45, -60), (1e-5, -3), (89.9, -89.9), (-30, -80)]
]


@pytest.mark.parametrize(("v", "alpha0", "alpha"), CASES)
def test_speed_and_arc_length_against_mpmath(v, alpha0, alpha):
    truth = reference.position(v, alpha0, alpha)
    assert path.speed(v, alpha0, alpha) == pytest.approx(float(truth.speed), rel=3e-15)
    assert path.arc_length(v, alpha0, alpha) == pytest.approx(float(truth.arc_length), rel=3e-15)


def test_at_the_launch():
    v = np.array([0.0, 1e-310, 1e-8, 1.0, 1e8, 1e20])
    for alpha0 in (0.3, -1.2, np.pi / 2):
        np.testing.assert_allclose(path.speed(v, alpha0, alpha0), v, rtol=1e-15)
        assert np.all(path.arc_length(v, alpha0, alpha0) == 0)


def test_terminal_speed_is_the_limit_straight_down():  # eq. 11
    v = np.array([1e-3, 1.0, 1e8, 1e20])
    np.testing.assert_allclose(path.speed(v, 0.7, -np.pi / 2), 1.0, rtol=1e-15)


def test_vertical_launch_slows_as_the_arctangent_law():
    # upwards dv/ds = -(1 + v^2)/v, so that the path up to the apex is ln(1 + v0^2) / 2
    v = np.array([1e-4, 1.0, 50.0])
    length = path.arc_length(v, np.pi / 2, 0.0)
    np.testing.assert_allclose(length, 0.5 * np.log1p(v**2), rtol=1e-15)


def test_terminal_speed_from_drag():  # eq. 12; section 3.3 prints 42.7 m/s
    assert bodies.terminal_speed(0.005376) == pytest.approx(42.7, abs=0.05)
    assert bodies.terminal_speed(0.25, g=1.0) == 2.0
    assert bodies.terminal_speed(0.0) == np.inf


def test_path_to_the_vertical_is_endless():  # eq. 19; eq. 11 gives the speed there
    v = np.array([1e-300, 1e-3, 1.5, 1e20])
    for alpha0 in (0.7, -1.0, np.pi / 2):
        assert np.all(path.arc_length(v, alpha0, -np.pi / 2) == np.inf)
    near = path.arc_length(1.5, 0.7, [-np.pi / 2, np.nextafter(-np.pi / 2, 0), np.nan])
    assert np.isinf(near).tolist() == [True, False, False]
    assert path.arc_length(0.0, 0.7, -np.pi / 2) == 0  # at rest, as the speed


def test_at_the_last_slope_all_fall_at_terminal_speed():
    """Eq. 11: however slow the launch was, or how steep; at rest in vacuum there is no fall."""
    assert path.speed([1e-300, 1e-20, 1.0, 1e8, 0.0], 0.7, -np.pi / 2).tolist() == [
        1,
        1,
        1,
        1,
        0,
    ]
    assert path.speed(1.5, np.pi / 2, -np.pi / 2) == 1
