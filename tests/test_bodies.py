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


def test_a_body_is_not_its_number():
    ball = bodies.CATALOGUE["golf"]
    with pytest.raises(TypeError, match=r"^v_lim must be real .* \(is it \.v_lim\(\) of that\?\)$"):
        Launch(70.0, 0.2, ball)
    with pytest.raises(TypeError, match=r"^k must be real .* \(is it \.k\(\) of that\?\)$"):
        Launch.from_drag(70.0, 0.2, ball)


# --- the air ------------------------------------------------------------------------------


def cipm_2007(kelvin, pascal, humidity):
    """Picard, Davis, Glaser and Fujii, Metrologia 45, 149 (2008), for 0.04 % carbon dioxide."""
    t = kelvin - 273.15
    saturated = np.exp(
        1.2378847e-5 * kelvin**2 - 1.9121316e-2 * kelvin + 33.93711047 - 6.3431645e3 / kelvin
    )
    x = humidity * (1.00062 + 3.14e-8 * pascal + 5.6e-7 * t**2) * saturated / pascal
    virial = 1.58123e-6 - 2.9331e-8 * t + 1.1043e-10 * t**2
    virial += (5.707e-6 - 2.051e-8 * t) * x + (1.9898e-4 - 2.376e-6 * t) * x**2
    ratio = pascal / kelvin
    z = 1 - ratio * virial + ratio**2 * (1.83e-11 - 0.765e-8 * x**2)
    return 3.483740e-3 * ratio / z * (1 - 0.3780 * x)


@pytest.mark.parametrize(
    ("low", "high", "within"), [(-45, 60, 2.5e-3), (0, 30, 8e-4), (15, 27, 6e-4)]
)
def test_moist_air(low, high, within):
    celsius, pascal, humidity = np.meshgrid(
        np.linspace(low, high, 40), np.linspace(3e4, 1.2e5, 30), np.linspace(0, 1, 6)
    )
    found = bodies.air_density(celsius + 273.15, pascal, humidity)
    np.testing.assert_allclose(found, cipm_2007(celsius + 273.15, pascal, humidity), rtol=within)


def test_published_densities():
    celsius = [-25, -10, 0, 15, 25, 35]
    tabulated = [1.4224, 1.3413, 1.2922, 1.2250, 1.1839, 1.1455]  # dry, at 101 325 Pa
    found = bodies.air_density(np.array(celsius) + 273.15)
    np.testing.assert_allclose(found, tabulated, atol=1e-4)
    assert bodies.air_density() == pytest.approx(1.225, rel=1e-7)  # ISO 2533
    assert type(bodies.air_density()) is np.float64


def test_air_broadcasts():
    found = bodies.air_density([[280.0], [300.0]], [9e4, np.nan, 1e5], 0.5)
    assert found.shape == (2, 3)
    assert np.isnan(found[:, 1]).all()
    assert found[1, 2] == bodies.air_density(300, 1e5, 0.5)


@pytest.mark.parametrize(
    ("name", "illegal"),
    [  # degrees Celsius, hPa, percent
        ("temperature", (20.0, 227.0, 335.0, -1.0, np.inf)),
        ("pressure", (1013.25, 2.9e4, 1.3e5, 0.0, np.inf)),
        ("humidity", (50.0, -0.1, 1.1, np.inf)),
    ],
)
def test_other_units_are_refused(name, illegal):
    for value in illegal:
        with pytest.raises(ValueError, match=f"^{name} must be in .*; got {value!r}$"):
            bodies.air_density(**{name: value})
    for value in ("20", None, True, [20, None]):
        with pytest.raises(TypeError, match=f"^{name} must be real numbers"):
            bodies.air_density(**{name: value})


# --- the catalogue ------------------------------------------------------------------------

RULES = {  # mass in g, diameter in mm: what the rules of each sport allow
    "baseball": ((141.7, 148.8), (72.8, 74.8)),
    "basketball": ((580, 620), (238.7, 245.1)),
    "golf": ((45, 45.93), (42.67, 43)),
    "javelin": ((800, 825), (25, 30)),
    "shot": ((7260, 7285), (110, 130)),
    "shuttlecock": ((4.74, 5.5), (58, 68)),
    "soccer": ((410, 450), (216.4, 222.9)),
    "table-tennis": ((2.67, 2.77), (39.5, 40.5)),
    "tennis": ((56, 59.4), (65.4, 68.6)),
}


def test_every_body_is_legal_in_its_sport():
    assert set(bodies.CATALOGUE) == set(RULES)
    for name, (mass, size) in RULES.items():
        body = bodies.CATALOGUE[name]
        assert mass[0] <= body.mass * 1000 <= mass[1], name
        assert size[0] <= body.diameter * 1000 <= size[1], name
        assert body.rules, name
        assert body.measured, name


@pytest.mark.parametrize(
    ("name", "v_lim"),
    [
        # Brancazio, Sport Science (1984), as textbooks have it
        *(("shot", 145), ("baseball", 42), ("basketball", 20), ("table-tennis", 9)),
        ("shuttlecock", 6.8),  # Cohen et al., New J. Phys. 17, 063001 (2015)
    ],
)
def test_published_terminal_speeds(name, v_lim):
    assert bodies.CATALOGUE[name].v_lim() == pytest.approx(v_lim, rel=0.07)


def test_a_body_in_other_air():
    ball = bodies.CATALOGUE["baseball"]
    given = bodies.drag_constant(ball.mass, ball.cd, diameter=ball.diameter, rho=1.0)
    assert ball.k(1.0) == given
    assert ball.v_lim(g=1.62, rho=1.0) == bodies.terminal_speed(given, g=1.62)


def test_the_catalogue_is_read_only():
    with pytest.raises(TypeError):
        bodies.CATALOGUE["baseball"] = None
    with pytest.raises(AttributeError):
        bodies.CATALOGUE["baseball"].mass = 1.0
