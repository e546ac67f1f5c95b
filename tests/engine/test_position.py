"""Quadrature of the position, against mpmath."""

import mpmath
import numpy as np
import pytest

from hodograph import path, reference
from hodograph.engine import position


@pytest.mark.parametrize("n", [6, 7, 28, 96, 1024])
def test_gauss_legendre_to_full_relative_accuracy(n):
    nodes, weights = (column.ravel() for column in position.gauss_legendre(n))
    context = mpmath.MPContext()
    context.dps = 40
    for i in {0, 1, n // 3, n // 2, n - 1}:
        x = 2 * context.mpf(float(nodes[i])) - 1
        for _ in range(3):  # polish the root in 40 digits
            below, here = context.mpf(1), x
            for k in range(2, n + 1):
                below, here = here, ((2 * k - 1) * x * here - (k - 1) * below) / k
            slope = n * (x * here - below) / (x * x - 1)
            x -= here / slope
        assert nodes[i] == pytest.approx(float((x + 1) / 2), rel=1e-15)
        assert weights[i] == pytest.approx(float(1 / ((1 - x * x) * slope**2)), rel=1e-14)


@pytest.mark.parametrize("v", [1e-8, 0.2, 1.5, 30.0, 1e8])
@pytest.mark.parametrize(
    ("alpha0", "alpha"), [(45, 0), (45, -70), (0.01, -1), (89.99, -80), (-20, -60), (0, -1e-3)]
)
def test_position_against_mpmath(v, alpha0, alpha):
    alpha0, alpha = np.deg2rad(alpha0), np.deg2rad(alpha)
    truth = reference.position(v, alpha0, alpha)
    found = path.position(v, alpha0, alpha)
    assert found.x == pytest.approx(float(truth.x), rel=1e-13)
    assert found.t == pytest.approx(float(truth.t), rel=1e-13)
    # y is a difference of rise and fall: its error is relative to the path
    assert found.y == pytest.approx(float(truth.y), rel=1e-13, abs=1e-14 * float(truth.arc_length))


def test_position_at_the_launch_is_the_origin():
    for value in path.position([0.0, 1.0, 1e20], 0.5, 0.5):
        assert np.all(value == 0)


def test_arcs_add_up():
    # the state at a slope launches the rest of the arc
    from hodograph import path

    first = path.position(3.0, 1.0, 0.4)
    rest = path.position(path.speed(3.0, 1.0, 0.4), 0.4, -1.1)
    whole = path.position(3.0, 1.0, -1.1)
    for a, b, c in zip(first, rest, whole, strict=True):
        assert a + b == pytest.approx(c, rel=1e-14, abs=1e-15)
