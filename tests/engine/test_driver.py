"""What the driver does to every call; and launches at the ends of the legal domain."""

import numpy as np
import pytest

from hodograph import Launch, best_angle, d_norm, landing_angle, optimal_angle, reference
from hodograph.engine import domain, driver
from hodograph.sensitivity import range_sensitivity

HALF = np.pi / 2


@pytest.mark.parametrize(
    "call",
    [
        lambda: d_norm(1.0, [0.5, 0.7]),
        lambda: d_norm(1.0, [0.5, 0.7], n=[1.5, 2.0]),
        lambda: d_norm(1.0, [0.5, 0.7], rtol=1e-3),
        lambda: d_norm(1.0, [0.5, 0.7], method="law"),
        lambda: landing_angle(1.0, [0.5]),
        lambda: optimal_angle([1.0, 2.0]),
        lambda: best_angle(20.0, [30.0, 40.0], height=[0.0, 1.0]),
        lambda: range_sensitivity(20.0, 0.5, 30.0),
        lambda: Launch(20.0, [0.5, 0.7], 30.0),
        lambda: Launch(20.0, [0.5], 30.0).range(),
        lambda: Launch(20.0, [0.5, -0.7], 30.0, height=1.0).range(rtol=1e-3),
        lambda: Launch(20.0, [0.5], 30.0, n=3).landing(),
        lambda: Launch(20.0, [0.5], 30.0).apex(),
        lambda: Launch(20.0, [0.5], 30.0).trajectory(5),
    ],
)
def test_one_call_one_broadcast(monkeypatch, call):
    seen = []
    real = domain.broadcast
    monkeypatch.setattr(domain, "broadcast", lambda **named: seen.append(named) or real(**named))
    call()
    assert len(seen) == 1


@pytest.mark.parametrize("size", [1, 3, driver.FEW, driver.FEW + 1])
def test_few_launches_are_asked_one_by_one(size):
    """What is not answered so goes to the kernel, with its neighbours or without."""
    alone, together = [], []

    def double(v, n):
        alone.append(v)
        return 2 * v if v < 5 else None

    def kernel(v, n):
        together.extend(v.tolist())
        return [2 * v], np.zeros(v.size, np.int8)

    v = np.arange(float(size))
    v[0] = np.nan
    (row,), status = driver.apply(
        kernel, v.shape, [v, np.full(size, 2.0)], 1, exponent=1, alone=double
    )
    few = size <= driver.FEW
    assert together == [each for each in v[1:] if each >= 5 or not few]
    assert len(alone) == (size if few else 0)
    np.testing.assert_array_equal(row[1:], 2 * v[1:])
    assert status.tolist() == [3, *[0] * (size - 1)]


# By a Taylor integration of the equations of motion to 33 digits.
@pytest.mark.parametrize(
    ("v", "alpha0", "n", "ratio"),
    [
        (1e3, 1e-25, 10, 0.0754431656018560653),
        (1e5, 1e-29, 10, 4.76020911748819e-5),
        (1e6, 1e-31, 5.5, 0.142296484195784492),
        (1e-10, np.pi / 4, 1, 0.999999999905719096),
        (1e-8, 1e-3, 1, 0.999999999986666669),
        (1e-9, 0.7, 1.2, 0.999999999986788194),
    ],
)
def test_almost_level_or_slow_for_every_exponent(v, alpha0, n, ratio):
    assert d_norm(v, alpha0, n=n) == pytest.approx(ratio, rel=2e-14)
    angle = reference.landing_angle(v, alpha0, n=n, dps=20)
    assert landing_angle(v, alpha0, n=n) == pytest.approx(float(angle), rel=2e-14)


@pytest.mark.parametrize(
    ("v", "alpha0", "n", "x"),
    [
        (1e20, 1e-150, 5.5, 2.0e-110),
        (1e10, 1e-101, 9.0, 1.99999999997333344e-81),
        (1e9, 1e-110, 10, 2.0e-92),
        (1e20, 9e-101, 4.5, 1.79999999978399993e-60),
    ],
)
def test_angles_without_end(v, alpha0, n, x):
    landing = Launch(v, alpha0, 1.0, g=1.0, n=n).landing()
    assert landing.x == pytest.approx(x, rel=2e-14)
    assert landing.alpha == pytest.approx(-alpha0, rel=1e-9)
    assert landing.t == pytest.approx(x / v, rel=1e-9)
    assert Launch(v, alpha0, 1.0, g=1.0, n=n).trajectory(3).x[-1] == landing.x


def test_the_drag_part_of_a_launch_almost_level():
    found = range_sensitivity(1.0, [1e-101, 1e-120], 1.0, g=1.0).v_lim
    np.testing.assert_allclose(found, [16 / 3 * 1e-202, 16 / 3 * 1e-240], rtol=1e-12)


@pytest.mark.parametrize("v", [1.3e-4, 0.7, 60.56358475651109, 2e6, 48491235768.82479])
@pytest.mark.parametrize("count", [3, 4, 10])
@pytest.mark.parametrize("n", [2.0, 1.0, 3.0])
def test_straight_up_with_few_points(v, count, n):
    """A leg over the apex turns right round; every point is where it is at its own time."""
    height = min(v * v, 100.0)
    path = Launch(v, HALF, 1.0, g=1.0, height=height, n=n).trajectory(count)
    top = path.y.max()
    for t, x, y, s in zip(path.t[1:-1], path.x[1:], path.y[1:], path.s[1:], strict=False):
        true = reference.position(v, HALF, t=float(t), n=n, dps=18)
        assert abs(y - height - float(true.y)) <= 2e-14 * top
        assert x == pytest.approx(float(true.x), rel=1e-13)
        assert s == pytest.approx(float(true.arc_length), rel=1e-13)


def test_points_at_terminal_speed():
    path = Launch(2.0, 0.7, 1.0, g=1.0, height=100.0, n=3).trajectory(4)
    assert path.x[1] == pytest.approx(1.60545078497063023, rel=1e-14)
    assert path.alpha[1] == pytest.approx(-1.57079632679489286, rel=1e-15)
    high = Launch(1e18, 1.5, 1.0, g=1.0, height=1.0, n=1).trajectory(20)
    assert high.speed[10] == pytest.approx(1.0, rel=1e-13)
    assert high.alpha[10] == pytest.approx(-HALF, rel=1e-15)


def test_no_warning_at_the_corners():
    fast = Launch(4.012920280607624e18, 0.0, 1.0, g=1.0, height=0.4, n=9.218406921860739)
    assert fast.landing().success
    low = Launch(1e-30, 1e-300, np.inf, g=2.27e-17, height=-1e30).landing()
    assert low.status == 1
    x, _, t = Launch(1e30, 5e-324, 1e30, g=1e-30, n=1).apex()
    assert (x, t) == (pytest.approx(4.940656458412465e-234), pytest.approx(4.940656458412465e-264))
