"""One launch at many times, and its derivatives, against the equations of motion."""

import math

import numpy as np
import pytest

from hodograph import ode
from hodograph.engine import track

G = 9.81
KINDS = {  # v_norm, alpha0, n, time in v0 / g
    "level ground": (0.4, 0.76, 2.0, 1.2),
    "slow": (0.05, 0.5, 2.0, 1.0),
    "fast": (5.0, 0.3, 2.0, 0.5),
    "fast and steep": (5.0, 1.5, 2.0, 0.6),
    "faster": (20.0, 0.7, 2.0, 0.5),
    "downward": (1.0, -0.6, 2.0, 1.5),
    "up": (1.0, math.pi / 2, 2.0, 1.5),
    "down": (1.0, -math.pi / 2, 2.0, 1.5),
    "linear": (2.0, 0.9, 1.0, 1.5),
    "n=1.5": (2.0, 0.9, 1.5, 1.2),
    "n=3": (2.0, 0.9, 3.0, 1.2),
    "n=7": (1.2, 0.4, 7.0, 1.0),
}


def moved(t, v0, alpha0, k, n, g=G):
    """x, y, v_x and v_y, also where k is 0 or the launch goes left."""
    right = alpha0 <= math.pi / 2
    angle = alpha0 if right else math.pi - alpha0
    v_lim = math.inf if k == 0 else (g / k) ** (1 / n)
    height = v0 * t.max() + g * t.max() ** 2 / 2  # still above the ground then
    flight = ode.solve(v0, angle, v_lim, n=n, g=g, height=height, rtol=2.3e-14, atol=1e-16)
    x, y, vx, vy = flight.at(t)
    return np.array([x if right else -x, y - height, vx if right else -vx, vy])


def charted(t, v0, alpha0, k, n, g=G):
    chart = track.chart(float(t.min()), float(t.max()), v0=v0, alpha0=alpha0, k=k, n=n, g=g)
    return track.motion(chart, t)


def times(v0, part):
    return np.linspace(0.0, part * v0 / G, 40)


@pytest.mark.parametrize("kind", KINDS)
def test_place_and_velocity(kind):
    v_norm, alpha0, n, part = KINDS[kind]
    v0 = 17.0
    k, t = G * v_norm**n / v0**n, times(v0, part)
    found, true = charted(t, v0, alpha0, k, n), moved(t, v0, alpha0, k, n)
    tol = 1e-11 if abs(alpha0) < 1.57 else 1e-7  # the vertical is 1e-8 off it
    for row, (mine, exact) in enumerate(zip(found[:4], true, strict=True)):
        scale = np.abs(true[:2]).max() if row < 2 else v0
        np.testing.assert_allclose(mine, exact, rtol=0, atol=tol * scale)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("row", range(5))
def test_derivatives(kind, row):
    """In v0, alpha0, k, n and g, by differences of the oracle."""
    v_norm, alpha0, n, part = KINDS[kind]
    v0 = 17.0
    at = np.array([v0, alpha0, G * v_norm**n / v0**n, n, G])
    t = times(v0, part)
    found = charted(t, *at)
    step = np.zeros(5)
    step[row] = 1e-4 * (at[row] if row != 1 else 1.0)
    if row == 1 and kind == "down":
        pytest.skip("the oracle has no launch beyond straight down")
    up, down = moved(t, *(at + step)), moved(t, *(at - step))
    up2, down2 = moved(t, *(at + 2 * step)), moved(t, *(at - 2 * step))
    true = (8 * (up - down) - (up2 - down2)) / (12 * step[row])
    scale = np.abs(true[:2]).max() + np.abs(moved(t, *at)[:2]).max() * 1e-3 / at.max()
    tol = 2e-5 if (row, kind) == (1, "up") else 2e-6
    np.testing.assert_allclose(found.dx[row], true[0], rtol=0, atol=tol * scale)
    np.testing.assert_allclose(found.dy[row], true[1], rtol=0, atol=tol * scale)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 3.0])
def test_no_drag_is_regular(n):
    """Vacuum is exact, and the derivative in k there is that from above."""
    v0, alpha0, t = 12.0, 0.8, np.linspace(-0.5, 2.0, 30)
    found = charted(t, v0, alpha0, 0.0, n)
    np.testing.assert_allclose(found.x, v0 * math.cos(alpha0) * t, rtol=1e-13)
    np.testing.assert_allclose(found.y, v0 * math.sin(alpha0) * t - G * t**2 / 2, atol=1e-13)
    k, t = 1e-5 * G / v0**n, np.linspace(0.0, 2.0, 30)
    near, twice, none = (moved(t, v0, alpha0, each, n) for each in (k, 2 * k, 0.0))
    true = (4 * near - twice - 3 * none) / (2 * k)
    found = charted(t, v0, alpha0, 0.0, n)
    np.testing.assert_allclose(found.dx[2], true[0], atol=1e-7 * np.abs(true[0]).max())
    np.testing.assert_allclose(found.dy[2], true[1], atol=1e-7 * np.abs(true[1]).max())


@pytest.mark.parametrize("v_norm", [0.1, 1.0, 4.0])
def test_before_the_launch(v_norm):
    """The path from a later point of it goes back through the launch."""
    v0, alpha0 = 20.0, 0.9
    k = G * v_norm**2 / v0**2
    x, y, vx, vy = moved(np.array([0.02, 0.6]), v0, alpha0, k, 2.0)
    from_there = charted(
        np.array([-0.58]), math.hypot(vx[1], vy[1]), math.atan2(vy[1], vx[1]), k, 2.0
    )
    assert from_there.x[0] + x[1] == pytest.approx(x[0], abs=1e-10)
    assert from_there.y[0] + y[1] == pytest.approx(y[0], abs=1e-10)


def test_beyond_the_chart_is_the_tangent():
    chart = track.chart(0.0, 1.0, v0=10.0, alpha0=0.5, k=0.05, n=2.0, g=G)
    end = track.motion(chart, np.array([0.0, 30.0, 31.0]))
    assert np.isfinite(end.x).all()
    assert end.x[2] - end.x[1] == pytest.approx(end.vx[1])
