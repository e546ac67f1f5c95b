"""The engine on the whole domain, against flights computed to 30 digits (data/reference.csv)."""

from pathlib import Path

import mpmath
import numpy as np
import pytest

from hodograph import Launch, d_norm, landing_angle, points, reference
from hodograph.flight import CONVERGED

EPSILON = np.finfo(float).eps
FILE = Path(__file__).parents[1] / "data" / "reference.csv"


@pytest.fixture(scope="module")
def truth():
    return points.load(FILE)


@pytest.fixture(scope="module")
def landing(truth):
    return Launch(truth["v_norm"], truth["alpha0"], 1.0, g=1.0, height=truth["height"]).landing()


def off(found, true):
    return np.abs(found / true - 1)


def test_the_file_is_what_it_says(truth):
    v, a, h = (truth[name] for name in points.INPUTS)
    assert v.size >= 600
    assert (v.min(), v.max()) == (1e-8, 1e8)
    assert np.sum((a < 1e-3) & (a > 0)) >= 50
    assert np.sum((np.pi / 2 - a) < 1e-3) >= 50
    assert np.sum(h > 0) >= 100
    assert np.sum(h < 0) >= 30
    assert np.sum(a < 0) >= 50
    launches = np.array(list(points.inputs()))
    if np.lib.NumpyVersion(np.__version__) >= "2.4.0":
        np.testing.assert_array_equal(launches, np.column_stack([v, a, h]))
    # the powers of ten and the angles are NumPy's, whose last bit varies with its version
    np.testing.assert_allclose(launches, np.column_stack([v, a, h]), rtol=1e-15)


def test_level_ground_to_1e_13(truth, landing):
    level = truth["height"] == 0
    assert np.all(landing.status == CONVERGED)
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        error = off(getattr(landing, name), truth[name])[level]
        assert error.max() <= 1e-13, name
        assert np.median(error) < 1e-15, name


def test_d_norm_and_landing_angle_to_1e_13(truth):
    level = truth["height"] == 0
    v, a = truth["v_norm"][level], truth["alpha0"][level]
    error = off(landing_angle(v, a), truth["alpha"][level])
    assert error.max() <= 1e-13
    assert np.median(error) < 1e-15
    # sin(2 alpha0) at the doubles passed in, from mpmath: near 90 degrees it has no room for error
    import mpmath

    context = mpmath.MPContext()
    context.dps = 40
    d_ref = np.array([float(context.sin(2 * context.mpf(angle))) for angle in a]) * v**2
    error = off(d_norm(v, a), truth["x"][level] / d_ref)
    assert error.max() <= 1e-13
    assert np.median(error) < 1e-15


def test_heights_and_downward_launches_where_well_conditioned(truth, landing):
    # an error e in the drop is one of e / tan(alpha_s) in x, e / (v sin(alpha_s)) in t and
    # e (1 - v^2 / sin(alpha_s)) / v in speed: a drop that is a small difference of apex and
    # height carries the rounding of both
    other = truth["height"] != 0
    x, t, speed, alpha = (truth[name] for name in ("x", "t", "speed", "alpha"))
    size = truth["apex_y"] + np.abs(truth["height"])
    conditions = {
        "x": size / (x * np.abs(np.tan(alpha))),
        "t": size / (t * speed * np.abs(np.sin(alpha))),
        "speed": size * (1 / speed + speed / np.abs(np.sin(alpha))) / speed,
    }
    for name, condition in conditions.items():
        error = off(getattr(landing, name), truth[name])
        well = other & (condition < 30)
        assert np.sum(well) > 0.6 * np.sum(other)
        assert error[well].max() <= 1e-13, name
        assert np.median(error[well]) < 1e-15, name
        ill = other & (condition >= 30)
        assert np.all(error[ill] <= 1e-13 + 2 * EPSILON * condition[ill]), name


def test_apex(truth):
    launch = Launch(truth["v_norm"], truth["alpha0"], 1.0, g=1.0)
    rising = truth["alpha0"] > 0
    for found, name in zip(launch.apex(), ("apex_x", "apex_y", "apex_t"), strict=True):
        assert off(found[rising], truth[name][rising]).max() <= 1e-13
        assert np.all(found[~rising] == 0)


def test_error_estimate_covers_the_error(truth, landing):
    true = np.maximum(off(landing.x, truth["x"]), off(landing.t, truth["t"]))
    assert np.all(landing.error >= true)
    assert landing.error.max() <= 1e-11


@pytest.mark.slow
def test_a_sample_of_the_file_computed_again(truth, seed):
    rng = np.random.default_rng(seed)
    for i in rng.choice(truth["v_norm"].size, 60, replace=False):
        launch = [float(truth[name][i]) for name in points.INPUTS]
        flight = reference.flight(*launch, dps=40)
        for name in points.OUTPUTS:
            assert float(getattr(flight, name)) == pytest.approx(truth[name][i], rel=1e-15), launch


@pytest.mark.slow
def test_random_points_of_the_domain(seed):
    rng = np.random.default_rng(seed)
    for _ in range(150):
        v = 10 ** rng.uniform(-8, 8)
        gap = 10 ** rng.uniform(-14, 0.19)
        a = gap if rng.random() < 0.5 else np.pi / 2 - gap
        flight = reference.flight(v, a)
        landing = Launch(v, a, 1.0, g=1.0).landing()
        for name in ("x", "t", "speed", "alpha", "arc_length"):
            true = float(getattr(flight, name))
            assert getattr(landing, name) == pytest.approx(true, rel=1e-13), (v, a)


@pytest.mark.slow
def test_a_million_random_launches():
    rng = np.random.default_rng(8)
    n = 1_000_000
    v = 10 ** rng.uniform(-8, 8, n)
    gap = 10 ** rng.uniform(-14, 0.19, n)
    alpha0 = np.where(rng.random(n) < 0.5, gap, np.pi / 2 - gap)
    from hodograph.flight import blocks, fly

    steps = 0
    for block in blocks(n):
        flight = fly(v[block], alpha0[block], np.zeros_like(v[block]), ())
        assert np.all(flight.status == CONVERGED)
        steps = max(steps, int(flight.down.steps.max()))
    assert steps <= 3  # the largest number seen, quoted in the docs


@pytest.mark.slow
def test_a_million_random_launches_with_landings_below():
    rng = np.random.default_rng(24)
    n = 1_000_000
    v = 10 ** rng.uniform(-8, 8, n)
    alpha0 = rng.uniform(-1.5707, np.pi / 2, n)
    alpha0[::2] *= 10 ** rng.uniform(-9, 0, n // 2)
    height = 10 ** rng.uniform(-12, 3, n)
    from hodograph.flight import blocks, fly

    steps = 0
    for block in blocks(n):
        flight = fly(v[block], alpha0[block], height[block], ())
        assert np.all(flight.status == CONVERGED)
        steps = max(steps, int(flight.down.steps.max()))
    assert steps <= 12


def test_deep_fall_of_a_slow_downward_launch_gives_no_warning():
    landing = Launch(2.016e-06, -0.12956, 1.0, g=1.0, height=958.608253148003).landing()
    assert landing.success
    assert landing.speed == pytest.approx(1.0, rel=1e-15)


def flat_fire(v, alpha0):
    """d_norm where every slope is small: X (1 + z) = e^X - 1, z = 2 v^2 alpha0, d_norm = X / 2z."""
    with mpmath.workdps(50):
        z = 2 * mpmath.mpf(v) ** 2 * mpmath.mpf(alpha0)
        start = mpmath.log1p(2 * z) + mpmath.log1p(mpmath.log1p(z))
        return mpmath.findroot(lambda X: mpmath.log1p(X * (1 + z)) - X, start) / (2 * z)


@pytest.mark.parametrize("v", [1e8, 1e12, 1e16, 1e20])
@pytest.mark.parametrize("z", [1e-2, 1.0, 1e3, 2e10, 1e40])
def test_almost_level_launches_of_any_speed(v, z):
    alpha0 = min(z / 2 / v**2, 1e-12)
    truth = flat_fire(v, alpha0)
    assert float(abs(d_norm(v, alpha0) / truth - 1)) < 2e-15
    assert float(abs(reference.d_norm(v, alpha0, dps=30) / truth - 1)) < 1e-17
