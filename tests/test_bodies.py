"""Drag from what a body is: against the definition, published figures and measured air."""

import numpy as np
import pytest

from hodograph import Launch, bodies


@pytest.mark.parametrize(
    ("body", "v0", "degrees", "height", "expected"),
    [  # published ranges, with the body they are told of
        ({"mass": 0.2, "cd": 0.47, "diameter": 0.1, "rho": 1.28}, 50, 65, 0, 64.0846882),
        # the least speed that clears a fence of 3 m at 120 m, hit from 1 m
        ({"mass": 0.145, "cd": 0.3, "diameter": 0.075, "rho": 1.196}, 46.385716, 40.94419, -2, 120),
    ],
)
def test_published_scenes(body, v0, degrees, height, expected):
    launch = Launch.from_drag(v0, np.deg2rad(degrees), bodies.drag_constant(**body), height=height)
    assert launch.range() == pytest.approx(expected, rel=2e-7)


def test_by_diameter_and_by_area():
    by_area = bodies.drag_constant(0.145, 0.35, area=np.pi * 0.037**2)
    assert by_area == pytest.approx(bodies.drag_constant(0.145, 0.35, diameter=0.074), rel=1e-15)
    assert by_area == pytest.approx(0.5 * 1.225 * 0.35 * np.pi * 0.037**2 / 0.145, rel=1e-15)


def test_broadcasting():
    k = bodies.drag_constant([[1.0], [2.0]], [0.0, 0.5, 1.0], area=0.01, rho=1.0)
    np.testing.assert_allclose(k, [[0, 0.0025, 0.005], [0, 0.00125, 0.0025]], rtol=1e-15)
    assert type(bodies.drag_constant(1, 1, diameter=1)) is np.float64


@pytest.mark.parametrize(("sizes", "word"), [({}, "neither"), ({"area": 1, "diameter": 1}, "both")])
def test_exactly_one_size(sizes, word):
    with pytest.raises(TypeError, match=rf"exactly one of diameter .* and area .*; got {word}"):
        bodies.drag_constant(1.0, 0.5, **sizes)
