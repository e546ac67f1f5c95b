"""Flights in a uniform wind."""

import math

import numpy as np
import pytest

from hodograph import Launch, ode


def test_published():
    """50 g, 3 cm in diameter, Cd 0.5, launched (20, 20) m/s in 10 m/s from the side."""
    body = {"mass": 0.05, "cd": 0.5, "diameter": 0.03}
    landing = Launch.from_body(math.sqrt(800), math.pi / 4, **body, crosswind=10.0).landing()
    assert landing.x == pytest.approx(63.48134, abs=6e-6)
    assert landing.z == pytest.approx(6.23781, abs=6e-6)


def test_no_wind_is_none():
    v, angle = np.meshgrid([1.0, 40.0, 300.0], [-0.4, 0.3, 1.1])
    still = Launch(v, angle, 40.0, height=3.0).landing()
    moved = Launch(v, angle, 40.0, height=3.0, wind=1e-30, crosswind=-1e-30).landing()
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        np.testing.assert_allclose(getattr(moved, name), getattr(still, name), rtol=1e-12)
    np.testing.assert_allclose(moved.z, 0, atol=1e-28)


def test_vacuum_feels_none():
    still, moved = (Launch(30.0, 0.7, math.inf, height=2.0, **air).landing()
                    for air in ({}, {"wind": -20.0, "crosswind": 7.0}))  # fmt: skip
    assert moved.z == 0
    for name in ("x", "t", "speed", "alpha"):
        assert getattr(moved, name) == pytest.approx(getattr(still, name), rel=1e-14)


def test_carried_by_the_air():
    """Launched at rest in the air, it stays over the same air."""
    found = Launch(5.0, 0.0, 20.0, wind=5.0).at(t=[0.5, 4.0, 100.0])
    np.testing.assert_allclose(found.x, [2.5, 20.0, 500.0], rtol=1e-14)
    u = 9.81 * 4.0 / 20.0
    assert found.y[1] == pytest.approx(-400 / 9.81 * math.log(math.cosh(u)), rel=1e-13)


def test_let_go_in_a_wind():
    found = Launch(0.0, 0.0, 20.0, height=30.0, wind=3.0, crosswind=4.0).landing()
    true = ode.solve(0.0, 0.0, 20.0, height=30.0, wind=3.0, crosswind=4.0, rtol=1e-13)
    assert found.x == pytest.approx(true.x, rel=1e-11)
    assert found.z == pytest.approx(true.z, rel=1e-11)
    assert found.z == pytest.approx(found.x * 4 / 3, rel=1e-13)


def test_brought_back():
    """A headwind turns it: x is where it is first, or nowhere, or behind."""
    launch = Launch(20.0, 1.2, 15.0, wind=-10.0)
    path = launch.at(t=np.linspace(0.0, 4.0, 401))
    turn = path.x.max()
    found = launch.at(x=[0.5 * turn, 0.999 * turn, 1.001 * turn, -3.0])
    assert found.status.tolist() == [0, 0, 1, 0]
    first = path.t[np.argmax(path.x)]
    assert (found.t[:2] < first).all()
    assert found.t[3] > first
    np.testing.assert_allclose(launch.at(t=found.t[[0, 1, 3]]).x, found.x[[0, 1, 3]], rtol=1e-12)


def test_slope_angles_are_refused_in_a_wind():
    for air in ({"wind": 1.0}, {"crosswind": 1.0}):
        with pytest.raises(ValueError, match="alpha is no place in a wind"):
            Launch(30.0, 0.7, 40.0, **air).at(alpha=0.0)


def test_lengths_are_those_through_the_air():
    launch = Launch(30.0, 0.7, 40.0, wind=8.0)
    end = launch.landing()
    true = ode.solve(30.0, 0.7, 40.0, wind=8.0, rtol=1e-13)
    assert end.arc_length == pytest.approx(true.air_length, rel=1e-12)
    assert abs(end.arc_length - true.arc_length) > 1.0
    assert launch.at(s=end.arc_length).t == pytest.approx(end.t, rel=1e-12)
