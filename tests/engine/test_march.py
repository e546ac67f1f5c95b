"""States along the path: against many digits, closed forms and each other."""

import math

import numpy as np
import pytest

from hodograph import Launch, reference

KINDS = [  # v_norm, alpha0, time over v_lim / g
    (0.05, 0.6, 0.06),
    (0.8, 0.7, 0.4),
    (0.8, 0.7, 3.0),
    (1.5, -0.6, 1.0),
    (2.0, 1.5, 5.0),
    (30.0, 0.0, 0.8),
    (1e4, 1.2, 2.0),
    (0.5, math.pi / 2, 1.5),
]


@pytest.mark.parametrize("n", [2.0, 1.0, 1.5, 3.0, 7.0])
@pytest.mark.parametrize(("v", "alpha0", "time"), KINDS)
def test_against_many_digits(v, alpha0, time, n):
    """Each place, by arrays and in plain floats, gives the same point of the path."""
    true = reference.position(v, alpha0, t=time, n=n, dps=25)
    point = {
        "t": time,
        "x": float(true.x),
        "y": float(true.y),
        "speed": float(true.speed),
        "alpha": float(true.alpha),
        "s": float(true.arc_length),
    }
    launch = Launch(v, alpha0, 1.0, g=1.0, n=n)
    scale = {"x": 0.0, "y": point["s"], "alpha": 1.0}
    steep = abs(math.cos(point["alpha"])) < 1e-3
    places = ["t", "s", "y"] if alpha0 == math.pi / 2 else ["t", "s", "y", "x", "alpha"]
    for place in places:
        if place == "y" and not 0 < abs(point["y"]) < 1e9:
            continue
        options = {"rising": point["alpha"] > 0} if place == "y" else {}
        true_at = {}
        if place != "t":  # the place in doubles is a little off that time
            own = {place: point[place]} | options
            exact = reference.position(v, alpha0, n=n, dps=25, **own)
            true_at = {"t": exact.t, "x": exact.x, "y": exact.y, "s": exact.arc_length}
            true_at |= {"speed": exact.speed, "alpha": exact.alpha}
        expected = {name: float(true_at.get(name, value)) for name, value in point.items()}
        for value in (point[place], np.full(20, point[place])):
            found = launch.at(**{place: value}, **options)
            assert np.all(found.success), place
            for name, right in expected.items():
                if name == "alpha" and steep:
                    continue
                off = np.abs(getattr(found, name) - right)
                assert np.all(off <= 1e-12 * (abs(right) + scale.get(name, 0.0))), (place, name)


def test_vacuum():
    v0, alpha0, g, height = 30.0, 0.7, 9.81, 2.0
    t = np.array([0.0, 1e-12, 0.5, 1.9, 3.7, 60.0, 1e6])
    found = Launch(v0, alpha0, math.inf, g=g, height=height).at(t=t)
    v_x, v_y = v0 * math.cos(alpha0), v0 * math.sin(alpha0) - g * t
    np.testing.assert_allclose(found.x, v_x * t, rtol=1e-14)
    y = height + t * (v0 * math.sin(alpha0) - g * t / 2)
    np.testing.assert_allclose(found.y, y, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(found.speed, np.hypot(v_x, v_y), rtol=1e-14)
    np.testing.assert_allclose(found.alpha, np.arctan2(v_y, v_x), rtol=1e-13)


@pytest.mark.parametrize("n", [1.0, 2.0, 3.0])
def test_a_fall_without_end(n):
    """It ends at terminal speed, straight down, x at its asymptote."""
    t = np.array([100.0, 1e4, 1e15, 1e30])
    found = Launch(30.0, 0.7, 20.0, n=n).at(t=t)
    np.testing.assert_allclose(found.speed, 20.0, rtol=1e-14)
    np.testing.assert_allclose(np.diff(found.y), -20.0 * np.diff(t), rtol=1e-14)
    np.testing.assert_allclose(np.diff(found.s), 20.0 * np.diff(t), rtol=1e-14)
    assert np.ptp(found.x) <= 1e-14 * found.x[0]
    far = Launch(30.0, 0.7, 20.0, n=n).at(x=found.x[0] * np.array([0.999, 1.001]))
    assert far.status.tolist() == [0, 1]


def test_at_rest():
    """A body let go falls as it does from y, and nowhere else."""
    launch = Launch(0.0, 0.3, 20.0)
    t = np.array([1e-9, 0.5, 3.0, 50.0])
    found = launch.at(t=t)
    u = 9.81 * t / 20.0
    fall = 400 / 9.81 * (u + np.log1p(np.exp(-2 * u)) - math.log(2))
    np.testing.assert_allclose(found.y[1:], -fall[1:], rtol=1e-13)
    np.testing.assert_allclose(found.speed, 20.0 * np.tanh(u), rtol=1e-13)
    np.testing.assert_allclose(found.x, 0.0, atol=1e-300)
    assert launch.at(x=[0.0, 1.0]).status.tolist() == [0, 1]
    assert launch.at(alpha=[0.3, 0.1]).status.tolist() == [0, 1]


def test_what_is_never_reached():
    launch = Launch(30.0, [0.7, -0.7], 40.0, height=10.0)
    assert launch.at(y=11.0, rising=True).status.tolist() == [0, 1]
    assert launch.at(y=11.0).status.tolist() == [0, 1]
    assert launch.at(y=9.0, rising=True).status.tolist() == [1, 1]
    assert launch.at(y=9.0).status.tolist() == [0, 0]
    assert launch.at(y=99.0).status.tolist() == [1, 1]
    assert launch.at(alpha=0.5).status.tolist() == [0, 1]
    assert launch.at(x=-1.0).status.tolist() == [1, 1]
    missed = launch.at(y=99.0)
    assert np.isnan([missed.t, missed.x, missed.speed, missed.s]).all()
    assert not missed.success.any()


def test_it_begins_at_the_launch():
    for place in ({"t": 0.0}, {"x": 0.0}, {"s": 0.0}, {"alpha": 0.7}, {"y": 3.0, "rising": True}):
        found = Launch(30.0, 0.7, 40.0, height=3.0).at(**place)
        assert found.to_dict() == {
            "t": 0.0, "x": 0.0, "y": 3.0, "z": 0.0, "speed": 30.0, "alpha": 0.7, "s": 0.0,
            "status": 0, "success": True,
        }  # fmt: skip


def test_the_landing_is_a_place_of_the_path():
    launch = Launch([20.0, 60.0, 5.0], [0.5, 1.2, -0.3], 40.0, height=[0.0, 5.0, 100.0])
    end, found = launch.landing(), launch.at(y=0.0)
    for name in ("t", "x", "speed", "alpha"):
        np.testing.assert_allclose(getattr(found, name), getattr(end, name), rtol=1e-14)
    np.testing.assert_allclose(found.s, end.arc_length, rtol=1e-14)


def test_one_at_a_time_is_as_in_arrays():
    rng = np.random.default_rng(3)
    for _ in range(40):
        launch = Launch(10 ** rng.uniform(-2, 1.5), rng.uniform(-1.5, 1.5), 1.0, g=1.0)
        t = rng.uniform(0.1, 4.0) * min(1.0, float(launch.v0))
        single = launch.at(t=t)
        many = launch.at(t=np.full(20, t))
        for place in ("x", "s"):
            again = launch.at(**{place: float(getattr(single, place))})
            assert abs(again.t / t - 1) <= 1e-9
        for name in ("x", "speed", "s"):
            np.testing.assert_allclose(getattr(single, name), getattr(many, name), rtol=1e-14)
        np.testing.assert_allclose(single.y, many.y, rtol=0, atol=1e-14 * single.s)
