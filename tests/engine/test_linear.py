"""Linear drag in closed form, against Lambert's W at many digits and against the reference."""

import math

import mpmath
import numpy as np
import pytest

from hodograph import reference
from hodograph.engine import flight, linear, power, velocity
from hodograph.engine.status import Status

NAMES = ("reach", "t", "speed", "tangent")
KINDS = ("play", "level", "steep", "shallow", "above", "below", "down", "plumb", "fast_down")


def launches(kind, count, seed):
    """v_norm, launch angle, and launch height in v0^2 / g."""
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    v, a = 10 ** rng.uniform(-8, 20, count), np.arcsin(rng.uniform(0, 1, count))
    height = np.zeros(count)
    if kind == "play":
        v = 10 ** rng.uniform(-2, 1, count)
    elif kind == "steep":
        a = math.pi / 2 - 10 ** rng.uniform(-17, -1, count)
    elif kind == "shallow":
        a = 10 ** rng.uniform(-12, -1, count)
    elif kind == "above":
        height = 10 ** rng.uniform(-8, 19, count) / v ** rng.choice([0, 1, 2], count)
    elif kind == "below":
        height = -linear.climb(v, a)[1] * rng.uniform(0, 1, count)
    elif kind in ("down", "plumb"):
        v = 10 ** rng.uniform(-8, 3, count)
        height = 10 ** rng.uniform(-6, 6, count) / v ** rng.choice([0, 1, 2], count)
        a = -a if kind == "down" else -math.pi / 2 + 10 ** rng.uniform(-17, -1, count)
    elif kind == "fast_down":  # where it falls about as far as its momentum carries it
        v = 10 ** rng.uniform(0, 20, count)
        height = np.sin(a) / v * 10 ** rng.uniform(-3, 1, count)
        a = -a
    return v, a, np.minimum(height, 1e20 / v / v)


def among_arrays(*launch):
    """The only one of an array of one."""
    flown = linear.fly(*(np.array([each]) for each in launch), ("x", "t", "s"))
    return linear.Flight(*(part[0] for part in flown))


def by_lambert(v, alpha0, height):
    """reach, t, speed and tangent, from z = b + W(-A exp(-b)), A = 1 + q, b = A + v^2 h."""
    with mpmath.workdps(110):
        v, alpha0, height = mpmath.mpf(v), mpmath.mpf(alpha0), mpmath.mpf(height)
        sine, cosine = mpmath.sin(alpha0), mpmath.cos(alpha0)
        A = 1 + v * sine
        b = A + v * v * height
        z = mpmath.re(b + mpmath.lambertw(-A * mpmath.exp(-b)))
        decay = mpmath.exp(-z)
        down = (1 - decay) / v - sine * decay
        across = cosine * decay
        return (1 - decay) / v, z / v, mpmath.hypot(across, down), down / across


def check(kind, count, seed):
    v, a, height = launches(kind, count, seed)
    with np.errstate(all="raise", under="ignore"):
        flown = linear.fly(v, a, height, ("x", "t", "s"))
    assert (flown.status == Status.CONVERGED).all()
    sound = NAMES[:2] if kind == "below" else NAMES[:3]  # speed and slope vanish at an apex
    truth = [by_lambert(*each) for each in zip(v, a, height, strict=True)]
    for i, true in enumerate(truth):
        alpha = -mpmath.atan(true[3])
        mine = -math.atan(flown.tangent[i])
        if kind != "below":
            assert mine == pytest.approx(float(alpha), rel=1e-14 + 2 * flown.error[i], abs=1e-300)
        for name, value in zip(sound, true, strict=False):
            mine = mpmath.mpf(float(getattr(flown, name)[i]))
            growth = max(1.0, v[i] * flown.t[i]) if name == "speed" else 1.0
            limit = 0.6 * growth * flown.error[i] * value
            assert abs(mine - value) <= limit, (name, v[i], a[i], height[i])
    if kind not in ("below", "down", "plumb", "fast_down"):  # which magnify rounding
        assert flown.error.max() <= 1e-14
    begin = velocity.start(v * v, np.sin(a), np.cos(a))
    curve = power.arc(begin, flown.delta, np.ones(count), ("s",))[0]["s"]
    np.testing.assert_allclose(flown.curve, curve, rtol=4e-14)
    for i, each in enumerate(zip(v.tolist(), a.tolist(), height.tolist(), strict=True)):
        alone = linear.fly_alone(*each, ("x", "t", "s"))
        if alone is None:
            assert v[i] * flown.t[i] > 30
            continue
        assert alone.status == Status.CONVERGED
        for name in (*sound, "delta", "curve", "error"):
            mine, theirs = getattr(alone, name), getattr(flown, name)[i]
            assert mine == pytest.approx(theirs, rel=2e-14 + 2 * flown.error[i]), name


@pytest.mark.parametrize("kind", KINDS)
def test_lambert(kind, seed):
    check(kind, 60, seed)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_lambert_more(kind, seed):
    check(kind, 10_000, seed)


@pytest.mark.parametrize(
    ("v", "alpha0", "height"),
    [
        (1e-6, 0.7, 0.0),
        (0.3, 0.7, 0.0),
        (1.0, 1.2, 0.5),
        (5.0, 0.4, -0.01),
        (30.0, 0.9, 0.0),
        (2.0, -0.5, 3.0),
        (1.0, math.pi / 2, 0.0),
        (50.0, -1.2, 0.01),
        (0.5, 1.0, 400.0),
        (1e4, 0.6, 0.0),
        (1e6, 1.5707, 1e-6),
        (1e-3, 1e-3, 1e5),
    ],
)
def test_reference(v, alpha0, height):
    square = mpmath.mpf(v) ** 2
    true = reference.flight(v, alpha0, mpmath.mpf(height) * square, n=1, dps=25)
    flown = among_arrays(v, alpha0, height)
    alone = linear.fly_alone(v, alpha0, height, ("x", "t", "s"))
    for each in (flown, alone) if alone else (flown,):
        assert each.reach * each.cos0 == pytest.approx(float(true.x / square), rel=2e-15)
        assert each.t == pytest.approx(float(true.t / v), rel=2e-15)
        assert each.speed == pytest.approx(float(true.speed / v), rel=2e-15)
        assert each.curve + each.tail == pytest.approx(float(true.arc_length / square), rel=8e-15)
        assert -math.atan(each.tangent) == pytest.approx(float(true.alpha), rel=2e-15)
        slopes = math.asinh(math.tan(alpha0)) + math.asinh(math.sqrt(each.P))
        assert each.delta == pytest.approx(slopes, rel=1e-13)


@pytest.mark.parametrize("v", [0.0, 1e-8, 0.3, 3.0, 1e8])
@pytest.mark.parametrize("alpha0", [-0.4, 0.0, 1e-5, 0.8, math.pi / 2])
def test_climb(v, alpha0):
    expected = (0.0, 0.0, 0.0)
    if v and alpha0 > 0:
        top = reference.flight(v, alpha0, n=1, dps=25)
        expected = (top.apex_x / v / v, top.apex_y / v / v, top.apex_t / v)
    elif alpha0 > 0:
        sine = math.sin(alpha0)
        expected = (sine * math.cos(alpha0), sine * sine / 2, sine)
    arrays = linear.climb(np.array([v]), np.array([alpha0]))
    for mine, many, true in zip(linear.climb_alone(v, alpha0), arrays, expected, strict=True):
        assert mine == pytest.approx(float(true), rel=1e-15)
        assert many[0] == pytest.approx(float(true), rel=1e-15)


def test_as_for_any_power():
    rng = np.random.default_rng(3)
    v, a = 10 ** rng.uniform(-3, 1, 200), rng.uniform(-0.5, 1.5, 200)
    height = np.where(a > 0, 0.0, 1.0) + rng.uniform(0, 1, 200)
    these = linear.fly(v, a, height, ("x", "t", "s"))
    those = flight.fly(v, a, height, np.ones_like(v), ("x", "t", "s"))
    for name in ("reach", "t", "speed", "slope"):
        np.testing.assert_allclose(getattr(these, name), getattr(those, name), rtol=2e-14)
    length = these.curve + these.tail
    np.testing.assert_allclose(length, those.curve + those.tail, rtol=2e-14)
    np.testing.assert_allclose(np.arctan(these.tangent), np.arctan(those.tangent), rtol=2e-14)
    whole = (these.tail == 0) & (those.tail == 0)  # each has its own end of the curve
    assert whole.sum() > 100
    np.testing.assert_allclose(these.delta[whole], those.delta[whole], rtol=2e-14)


def test_vacuum():
    angle = math.pi / 3
    for flown in (
        among_arrays(0.0, angle, 0.0),
        linear.fly_alone(0.0, angle, 0.0, ("x", "t", "s")),
    ):
        assert flown.reach == pytest.approx(2 * math.sin(angle), rel=1e-15)
        assert flown.t == pytest.approx(2 * math.sin(angle), rel=1e-15)
        assert flown.tangent == pytest.approx(math.tan(angle), rel=1e-15)
        parabola = math.sin(angle) + math.cos(angle) ** 2 * math.asinh(math.tan(angle))
        assert flown.curve == pytest.approx(parabola, rel=2e-15)


def test_no_flight_and_no_landing():
    v, a = np.array([1.0, 1.0, 0.0]), np.array([0.0, 0.5, 0.5])
    flown = linear.fly(v, a, np.array([0.0, -1.0, -1.0]), ("x", "t", "s"))
    assert flown.status.tolist() == [Status.CONVERGED] + 2 * [Status.UNREACHABLE]
    assert flown.reach[0] == flown.t[0] == flown.curve[0] == 0.0


@pytest.mark.parametrize(
    ("v", "alpha0", "height"),
    [
        (1.0, 0.0, 0.0),
        (1.0, 0.5, -1.0),
        (1.0, 0.5, 100.0),  # most of the fall at terminal speed
        (math.nan, 0.5, 0.0),
        (1.0, math.nan, 0.0),
        (1.0, 0.5, math.nan),
        (1.0, 0.5, math.inf),
    ],
)
def test_what_is_left_to_the_arrays(v, alpha0, height):
    assert linear.fly_alone(v, alpha0, height, ("x",)) is None
