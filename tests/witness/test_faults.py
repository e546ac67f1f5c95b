"""A search for faults, kind by kind, at launches that nobody has seen before.

The seed is fresh in every run and named at the head of the report; HODOGRAPH_SEED sets it.
"""

import mpmath
import numpy as np
import pytest
from test_against_reference import hold, hold_under_apex, landings, off

from hodograph import reference
from hodograph.builders import reference_points as points
from hodograph.engine.domain import RIGHT_ANGLE
from hodograph.sensitivity import range_sensitivity

pytestmark = pytest.mark.slow

POWERS = (1.0, 1.0000001, 1.2, 1.5, 2.0, 2.5, 3.0, 4.7, 7.0, 8.8, 10.0)
EACH = 8  # launches a kind and power; as many of random powers as of two of these
DIGITS = 20


def speed(rng):
    """From 1e-8 to 1e8, and one in eight beyond."""
    return 10 ** (rng.uniform(8, 15) if rng.random() < 0.125 else rng.uniform(-8, 8))


def depth(rng, v):
    """A height: of the order of the flight, or of any order."""
    if rng.random() < 0.5:
        return min(v * v, 1.0) * 10 ** rng.uniform(-6, 3)
    return 10 ** rng.uniform(-12, 6)


def level(rng):
    gap = 10 ** rng.uniform(-9, 0.19)
    return speed(rng), gap if rng.random() < 0.5 else RIGHT_ANGLE - gap, 0.0


def downward(rng):
    v, gap = speed(rng), 10 ** rng.uniform(-9, 0.19)
    slope = (0.0, -gap, gap - RIGHT_ANGLE)[rng.integers(3)]
    return v, slope, depth(rng, v)


def straight_up(rng):
    v = speed(rng)
    return v, RIGHT_ANGLE, 0.0 if rng.random() < 0.5 else depth(rng, v)


def straight_down(rng):
    v = speed(rng)
    return v, -RIGHT_ANGLE, depth(rng, v)


def from_above(rng):
    v = speed(rng)
    return v, rng.uniform(1e-3, RIGHT_ANGLE), depth(rng, v)


def under_the_apex(rng, n):
    """The launch, and how far under the apex the target is."""
    v, a = speed(rng), rng.uniform(0.01, 1.57)
    top = reference.position(v, a, 0, n=n, dps=40).y
    height = -float(top) * (1 - 10 ** rng.uniform(-15.5, -0.1))
    with mpmath.workdps(40):
        return (v, a, height), float(top + height)


def powers(rng):
    return [*np.repeat(POWERS, EACH).tolist(), *rng.uniform(1, 10, 2 * EACH).tolist()]


def table(launches):
    """As `points.load` gives it."""
    rows = []
    for n, launch in launches:
        found = reference.flight(*launch, n=n, dps=DIGITS)
        rows.append([n, *launch, *(float(getattr(found, name)) for name in points.OUTPUTS)])
    names = ("n", *points.INPUTS, *points.OUTPUTS)
    return dict(zip(names, np.array(rows).T, strict=True))


@pytest.mark.parametrize("kind", [level, downward, straight_up, straight_down, from_above])
def test_landings(kind, seed):
    rng = np.random.default_rng([seed, sum(kind.__name__.encode())])
    truth = table([(n, kind(rng)) for n in powers(rng)])
    hold(truth, landings(truth), note=f"HODOGRAPH_SEED={seed}")


def test_landings_under_the_apex(seed):
    rng = np.random.default_rng([seed, 1])
    drawn = [(n, *under_the_apex(rng, n)) for n in powers(rng)]
    drawn = [(n, launch, gap) for n, launch, gap in drawn if gap > 0]
    truth = table([(n, launch) for n, launch, _ in drawn])
    gaps = np.array([gap for _, _, gap in drawn])
    hold_under_apex(truth, landings(truth), gaps, note=f"HODOGRAPH_SEED={seed}")


@pytest.mark.parametrize("kind", [level, downward, straight_up, straight_down, from_above])
def test_derivatives(kind, seed):
    rng = np.random.default_rng([seed, 2, sum(kind.__name__.encode())])
    for n in [*np.repeat(POWERS, 3).tolist(), *[2.0] * 12]:
        v, a, h = kind(rng)
        true = reference.sensitivity(v, a, h, n=n, dps=DIGITS)
        found = range_sensitivity(v, a, 1.0, g=1.0, height=h, n=n)
        note = (f"HODOGRAPH_SEED={seed}", n, v, a, h)
        assert off(found.range, float(true.range)) <= 1e-13, note
        for name, scale in (("alpha0", 1.0), ("v0", 1 / v), ("v_lim", 1.0), ("height", 0.0)):
            value = float(getattr(true, name))
            allowed = 2e-13 * (abs(value) + scale * float(true.range))
            assert abs(getattr(found, name) - value) <= allowed, (*note, name)
