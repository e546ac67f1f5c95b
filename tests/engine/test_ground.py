"""Landings on sloping ground, and in a wind on it."""

import math

import numpy as np
import pytest

from hodograph import Launch, ode


@pytest.mark.parametrize(("degrees", "x"), [(20, 11.952328), (-20, 19.123275), (45, 3.345209)])
def test_published(degrees, x):
    landing = Launch(15.0, np.deg2rad(50), 20.0, slope=np.deg2rad(degrees)).landing()
    assert landing.x == pytest.approx(x, abs=6e-7)
    assert landing.y == pytest.approx(landing.x * math.tan(np.deg2rad(degrees)), rel=1e-15)


def test_vacuum():
    """x = 2 v^2 cos(alpha0) sin(alpha0 - beta) / (g cos(beta)), in whatever wind."""
    beta = np.array([-1.2, -0.3, 0.0, 0.4, 0.9, 0.99])
    launch = Launch(30.0, 1.0, math.inf, slope=beta, wind=[[0.0], [7.0], [-50.0]])
    true = 2 * 900 * math.cos(1.0) * np.sin(1.0 - beta) / (9.81 * np.cos(beta))
    np.testing.assert_allclose(launch.range(), np.broadcast_to(true, (3, 6)), rtol=2e-13)


@pytest.mark.parametrize("n", [2.0, 1.0, 3.0])
def test_a_level_slope_is_level_ground(n):
    v, angle, height = np.meshgrid([5.0, 40.0, 400.0], [-0.6, 0.1, 0.9, 1.5], [0.5, 30.0])
    level = Launch(v, angle, 40.0, n=n, height=height).landing()
    tilted = Launch(v, angle, 40.0, n=n, height=height, slope=1e-300).landing()
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        np.testing.assert_allclose(getattr(tilted, name), getattr(level, name), rtol=1e-12)


def test_where_it_begins():
    """A launch from the ground that climbs no more than the ground does lands where it starts."""
    landing = Launch(20.0, [0.2, 0.3, -1.0], 40.0, slope=[0.4, 0.3, -0.5]).landing()
    assert landing.x.tolist() == [0.0, 0.0, 0.0]
    assert landing.status.tolist() == [0, 0, 0]


def test_ground_above():
    """Ground over the muzzle is met from above, or never."""
    launch = Launch(30.0, [1.2, 0.3, -0.2], 40.0, height=-5.0, slope=0.3)
    found = launch.landing()
    assert found.status.tolist() == [0, 1, 1]
    true = ode.solve(30.0, 1.2, 40.0, height=-5.0, slope=0.3, rtol=1e-13)
    assert found.x[0] == pytest.approx(true.x, rel=1e-12)


BLOWN = [  # v0, alpha0, height, slope, wind, n, terminal speed 20 m/s
    (10.0, 0.6, 2.0, 1.0, -14.0, 2.0),
    (20.0, -1.3, 10.0, 1.2, -9.0, 2.0),
    (60.0, -1.2, 50.0, 1.0, -30.0, 2.0),
    (2.0, 0.5, -5.0, 1.0, -40.0, 2.0),
    (60.0, 1.0, 0.0, -0.5, 30.0, 1.0),
    (20.0, 0.2, 10.0, -0.9, 25.0, 3.0),
    (200.0, -1.0, 10.0, 1.3, -40.0, 2.0),
]


@pytest.mark.parametrize(("v0", "alpha0", "height", "slope", "wind", "n"), BLOWN)
def test_a_fall_that_a_wind_turns(v0, alpha0, height, slope, wind, n):
    """The first meeting counts, and there may be none."""
    scene = {"height": height, "slope": slope, "wind": wind, "n": n}
    found = Launch(v0, alpha0, 20.0, **scene).landing()
    if height < 0:  # blown off, never over the ground
        assert found.status == 1
        return
    true = ode.solve(v0, alpha0, 20.0, **scene, rtol=1e-13)
    assert found.status == true.status
    if true.success:
        assert found.t == pytest.approx(true.t, rel=1e-11)
        assert found.x == pytest.approx(true.x, rel=1e-11, abs=1e-11 * true.air_length)
