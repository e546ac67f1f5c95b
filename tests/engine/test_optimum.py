"""The angle of greatest range of one launch: the root of the derivative, to 25 digits by mpmath."""

import math

import mpmath
import numpy as np
import pytest

from hodograph import best_angle, optimal_angle, reference
from hodograph.engine import one, optimum, scalar
from hodograph.laws.own import alpha_max_alone


def truth(v, alpha0, height, n=2):
    """The derivative of the range over the range, the height in v0^2 / g."""
    found = reference.sensitivity(v, alpha0, mpmath.mpf(height) * v * v, n=n, dps=25)
    return float(found.alpha0 / found.range)


@pytest.mark.parametrize(
    ("v", "alpha0", "height"),
    [
        (1e-3, 0.3, 0.0),
        (0.4, 0.7, 0.0),
        (1.0, 1.5, 0.0),
        (1.0, 0.4, 0.3),
        (2.0, 1.1, -0.02),
        (7.0, 0.2, 0.02),
        (3.0, -0.3, 0.2),
        (40.0, 0.9, 0.0),
        (1e4, 0.2, 0.0),
    ],
)
def test_slant(v, alpha0, height):
    flight = scalar.fly(v, alpha0, height, ("x",))
    share = flight.tangent / (flight.tangent + math.tan(alpha0))
    found = optimum.slant(v, flight) / flight.reach / flight.cos0
    assert found == pytest.approx(share * truth(v, alpha0, height), rel=1e-13, abs=1e-14)


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("v", [1e-6, 0.1, 1.0, 3.0, 30.0, 1e4])
def test_level_ground(v, n):
    angle = optimum.best(v, 0.0, n, alpha_max_alone(v))
    assert angle == pytest.approx(float(reference.optimal_angle(v, n=n, dps=20)), rel=1e-14)
    assert optimal_angle(v, n=n) == angle


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize(
    ("v", "height"),
    [(0.01, 0.5), (0.01, -0.3), (0.8, 1.0), (1.0, -0.2), (1.5, 0.1), (5.0, 0.02), (30.0, -1e-4)],
)
def test_from_a_height(v, height, n):
    angle = optimum.best(v, height, n, alpha_max_alone(v))
    assert abs(truth(v, angle, height, n)) <= 1e-14 / angle
    g, v_lim = 9.81, 20.0
    scene = v_lim * v, v_lim
    found = best_angle(*scene, g=g, height=height * (v_lim * v) ** 2 / g, n=n)
    assert found == pytest.approx(angle, rel=3e-15)


@pytest.mark.parametrize("n", [1, 2])
def test_as_in_arrays(n, seed):
    rng = np.random.default_rng(seed)
    v = 10 ** rng.uniform(-4, 3, 60)
    height = rng.choice([0.0, 1.0, -0.1], 60) / np.maximum(v, 1) ** 2 * rng.random(60)
    together = best_angle(v, 1.0, g=1.0, height=height * v * v, n=n)
    for one_v, one_height, these in zip(v.tolist(), height.tolist(), together, strict=True):
        alone = optimum.best(one_v, one_height, n, alpha_max_alone(one_v))
        if alone is not None:
            assert alone == pytest.approx(these, rel=1e-13)
        else:  # nearly out of reach, out of it, or a fall at terminal speed
            assert np.isnan(these) or these > 1.4 or one_height > 0


def test_vacuum():
    for height in (0.3, -0.3):
        assert optimum.best(0.0, height, 1, 0.8) == pytest.approx(
            math.atan(1 / math.sqrt(1 + 2 * height)), rel=1e-15
        )
        assert best_angle(10.0, np.inf, height=height * 100 / 9.81) == pytest.approx(
            math.atan(1 / math.sqrt(1 + 2 * height)), rel=2e-15
        )
    assert optimal_angle(0.0) == optimal_angle(0, n=1) == best_angle(3.0, np.inf) == np.pi / 4


@pytest.mark.parametrize("n", [1, 2])
def test_what_is_left_to_the_arrays(n):
    assert optimum.best(2e6, 0.0, 2, 0.14) is None
    assert optimum.best(1.0, -0.6, n, 0.7) is None  # out of reach
    assert one.best_angle(1.0, 1.0, 1.0, 0.0, 3.0, alpha_max_alone) is None
    assert one.best_angle(1.0, 1.0, 1.0, math.nan, n, alpha_max_alone) is None
    assert one.best_angle(1.0, 1.0, 1.0, 0.0, [n], alpha_max_alone) is None
    assert np.isnan(best_angle(1.0, 1.0, g=1.0, height=-0.6, n=n))
    assert np.isnan(optimal_angle(math.nan, n=n))
