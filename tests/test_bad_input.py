"""What every public function does with input it was not made for, case by case.

The decisions held here: a boolean is not a number and is refused; integers, float16, float32 and
longdouble become float64 and the result is float64; NaN passes through, element by element;
options, and the data of a fit, must not be NaN; nothing that is passed in is modified.
"""

import dataclasses
import subprocess
import sys
import warnings
from collections.abc import Callable
from datetime import timedelta
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

import mpmath
import numpy as np
import pytest

import hodograph
from hodograph import Launch, d_norm, d_ref, grid, landing_angle, laws, optimal_angle
from hodograph.bodies import air_density, drag_constant, terminal_speed
from hodograph.engine.vial import newton_vial
from hodograph.path import arc_length, position, speed

INF, NAN = float("inf"), float("nan")
LEAST, MOST = 5e-324, float(np.finfo(float).max)
RIGHT = np.pi / 2
BEYOND_RIGHT = 1.570797  # by more than a rounding in single precision
SHORT_OF_RIGHT = float(np.nextafter(RIGHT, 0))


class Kind(NamedTuple):
    """A legal range, as the documentation has it."""

    words: str
    illegal: tuple[float, ...]
    legal: tuple[float, ...]  # its ends, and what is huge, tiny or subnormal


NON_NEGATIVE = Kind(
    "finite and >= 0",
    (-1.0, -LEAST, -INF, INF),
    (0.0, -0.0, LEAST, 1e-310, 1e-200, 1e-8, 1e8, 1e60, 1e155, MOST),
)
POSITIVE = Kind("finite and > 0", (0.0, -0.0, -1.0, -LEAST, INF, -INF), (LEAST, 1e-200, 1e200))
POSITIVE_OR_INF = Kind(
    "> 0 (inf is allowed)", (0.0, -0.0, -1.0, -LEAST, -INF), (1e-300, 1e200, MOST, INF)
)
V_NORM = Kind(
    "in [0, 1e20]",
    (-1.0, -LEAST, 1.01e20, 1e155, -INF, INF),
    (0.0, -0.0, LEAST, 1e-310, 1e-200, 1e-8, 1e8, 1e15, 1e20),
)
LAUNCH_SPEED = Kind(
    "0 or in [1e-30, 1e30] m/s",
    (-1.0, -LEAST, LEAST, 9e-31, 1.1e30, MOST, -INF, INF),
    (0.0, -0.0, 1e-30, 1e-8, 1e8, 1e15),
)
MOVING = Kind(
    "in [1e-30, 1e30] m/s",
    (0.0, -0.0, -1.0, -LEAST, LEAST, 9e-31, 1.1e30, MOST, -INF, INF),
    (1e-30, 1e-8, 1e8, 1e15),
)
TERMINAL_SPEED = Kind(
    "at least 1e-30 m/s (inf is vacuum)",
    (0.0, -0.0, -1.0, LEAST, 9e-31, -INF),
    (1e-8, 1.0, 1e15, 1e30, 1e200, MOST, INF),
)
GRAVITY = Kind(
    "in [1e-30, 1e30] m/s^2", (0.0, -0.0, -1.0, LEAST, 9e-31, 1.1e30, INF, -INF), (1e-30, 1.0, 1e20)
)
HEIGHT = Kind(
    "in [-1e30, 1e30] m",
    (INF, -INF, 1.1e30, -MOST),
    (0.0, -LEAST, LEAST, 1e-200, -1e-200, 1e15, 1e22, -1e22),
)
MASS = Kind(
    "in [1e-30, 1e30] kg", (0.0, -0.0, -1.0, LEAST, 9e-31, 1.1e30, INF, -INF), (1e-30, 1.0, 1e30)
)
AMOUNT = Kind(
    "0 or in [1e-30, 1e30]",
    (-1.0, -LEAST, LEAST, 9e-31, 1.1e30, MOST, -INF, INF),
    (0.0, -0.0, 1e-30, 1.0, 1e30),
)
HUMIDITY = Kind(
    "in [0, 1] (percent over 100)", (-LEAST, -1.0, 1.1, 50.0, INF, -INF), (0.0, -0.0, LEAST, 1.0)
)
FINITE = Kind("finite", (INF, -INF), (0.0, -LEAST, LEAST, 1e-200, -1e-200, 1e200, -1e200, MOST))
LEVEL = Kind(
    "in [0, pi/2] radians",
    (-LEAST, -0.5, BEYOND_RIGHT, 45.0, INF, -INF),
    (0.0, -0.0, LEAST, 1e-310, 1e-160, 1e-8, SHORT_OF_RIGHT, RIGHT),
)
LAUNCH_ANGLE = Kind(
    "in [-pi/2, pi/2] radians",
    (-BEYOND_RIGHT, BEYOND_RIGHT, 45.0, INF, -INF),
    (-RIGHT, -SHORT_OF_RIGHT, -1e-8, -LEAST, 0.0, LEAST, 1e-160, SHORT_OF_RIGHT, RIGHT),
)
GROUND = Kind(
    "in (-pi/2, pi/2) radians",
    (-RIGHT, RIGHT, BEYOND_RIGHT, 45.0, INF, -INF),
    (-1.5, -LEAST, 0.0, LEAST, 1e-160, 1e-8, 1.5),
)
WIND = Kind(
    "0, or of a size in [1e-30, 1e30] m/s",
    (INF, -INF, 1.1e30, -MOST, -LEAST, 9e-31),
    (0.0, -0.0, 1e-30, -1e-30, 1e8, -1e15),
)
DURATION = Kind("in [0, 1e30] s", (-1.0, -LEAST, 1.1e30, INF, -INF), (0.0, LEAST, 1e-8, 1e30))
LENGTH = Kind("in [0, 1e30] m", (-1.0, -LEAST, 1.1e30, INF, -INF), (0.0, LEAST, 1e-8, 1e30))
SLOPE = LAUNCH_ANGLE._replace(legal=(-RIGHT, -SHORT_OF_RIGHT, -1e-8, -LEAST, 0.0))
FALLING = Kind(
    "in (-pi/2, pi/2] radians",
    (-RIGHT, BEYOND_RIGHT, 45.0, INF, -INF),
    (-SHORT_OF_RIGHT, -1e-8, -LEAST, 0.0),
)


class Case(NamedTuple):
    """A public function, ordinary values of its arguments, and the legal range of each."""

    call: Callable[..., object]
    good: dict[str, float]
    kinds: dict[str, Kind]


def case(call, **arguments):
    good = {name: value for name, (value, _) in arguments.items()}
    return Case(call, good, {name: kind for name, (_, kind) in arguments.items()})


def of_launch(method):
    def call(**arguments):
        return getattr(Launch(**arguments), method)()

    return call


def at(place):
    def call(**arguments):
        value = arguments.pop(place)
        return Launch(**arguments).at(**{place: value})

    return call


LEVEL_FLIGHT = {"v_norm": (1.25, V_NORM), "alpha0": (0.75, LEVEL)}
SCENE = {
    "v0": (30.0, LAUNCH_SPEED),
    "alpha0": (0.75, LAUNCH_ANGLE),
    "v_lim": (40.0, TERMINAL_SPEED),
    "g": (9.75, GRAVITY),
    "height": (2.0, HEIGHT),
}
WINDY = SCENE | {"slope": (0.1, GROUND), "wind": (-3.0, WIND), "crosswind": (5.0, WIND)}
DRAG_SCENE = {
    "v0": SCENE["v0"],
    "alpha0": SCENE["alpha0"],
    "k": (0.006, NON_NEGATIVE),
    "g": SCENE["g"],
    "height": SCENE["height"],
}
TARGET = {
    "v0": (30.0, MOVING),
    "x": (20.0, HEIGHT),
    "y": (2.0, HEIGHT),
    "v_lim": SCENE["v_lim"],
    "g": SCENE["g"],
}
BODY = {"mass": (0.145, MASS), "cd": (0.35, AMOUNT), "rho": (1.25, AMOUNT)}

CASES = {
    "d_norm": case(d_norm, **LEVEL_FLIGHT),
    "landing_angle": case(landing_angle, **LEVEL_FLIGHT),
    "newton_vial": case(newton_vial, **LEVEL_FLIGHT),
    "table_1": case(laws.table_1, v_norm=(1.25, NON_NEGATIVE), alpha0=(0.75, LEVEL)),
    "optimal_angle": case(optimal_angle, v_norm=LEVEL_FLIGHT["v_norm"]),
    "d_ref": case(d_ref, v0=SCENE["v0"], alpha0=(0.75, LEVEL), g=SCENE["g"]),
    "terminal_speed": case(terminal_speed, k=DRAG_SCENE["k"], g=SCENE["g"]),
    "drag_constant": case(drag_constant, **BODY, diameter=(0.075, AMOUNT)),
    "drag_constant, by area": case(drag_constant, **BODY, area=(0.0045, AMOUNT)),
    "air_density": case(air_density, humidity=(0.5, HUMIDITY)),
    "speed": case(speed, v_norm=(1.25, V_NORM), alpha0=(0.75, LAUNCH_ANGLE), alpha=(-0.5, SLOPE)),
    "arc_length": case(
        arc_length, v_norm=(1.25, V_NORM), alpha0=(0.75, LAUNCH_ANGLE), alpha=(-0.5, SLOPE)
    ),
    "position": case(
        position, v_norm=(1.25, V_NORM), alpha0=(0.75, LAUNCH_ANGLE), alpha=(-0.5, FALLING)
    ),
    "pearson_vii": case(
        laws.pearson_vii,
        x=(1.25, FINITE),
        K=(0.9, FINITE),
        M=(0.7, POSITIVE_OR_INF),
        h=(0.8, FINITE),
    ),
    "alpha_max_vial": case(laws.alpha_max_vial, v0=(30.0, NON_NEGATIVE)),
    "Launch": case(Launch, **SCENE),
    "from_drag": case(Launch.from_drag, **DRAG_SCENE),
    "range": case(of_launch("range"), **SCENE),
    "flight_time": case(of_launch("flight_time"), **SCENE),
    "apex": case(of_launch("apex"), **SCENE),
    "landing": case(of_launch("landing"), **SCENE),
    "aim": case(hodograph.aim, **TARGET),
    "envelope": case(hodograph.envelope, **{k: v for k, v in TARGET.items() if k != "y"}),
    "least_speed": case(hodograph.least_speed, **{k: v for k, v in TARGET.items() if k != "v0"}),
    "Launch in a wind": case(Launch, **WINDY),
    "from_body": case(
        Launch.from_body,
        **BODY,
        diameter=(0.075, AMOUNT),
        **{name: kind for name, kind in WINDY.items() if name != "v_lim"},
    ),
    "range in a wind": case(of_launch("range"), **WINDY),
    "apex in a wind": case(of_launch("apex"), **WINDY),
    "landing in a wind": case(of_launch("landing"), **WINDY),
    "at t": case(at("t"), t=(1.0, DURATION), **WINDY),
    "at x": case(at("x"), x=(20.0, HEIGHT), **WINDY),
    "at y": case(at("y"), y=(5.0, HEIGHT), **WINDY),
    "at s": case(at("s"), s=(25.0, LENGTH), **WINDY),
    "at alpha": case(at("alpha"), alpha=(-0.5, SLOPE), **SCENE),
}
ARGUMENTS = [(name, argument) for name, case_ in CASES.items() for argument in case_.good]
# The literal iteration of the paper is one of these, and takes its time over each launch.
each_function = pytest.mark.parametrize("name", CASES)
each_argument = pytest.mark.parametrize(("name", "argument"), ARGUMENTS)


def call(name, **changed):
    function, good, _ = CASES[name]
    return function(**(good | changed))


def outputs(result):
    """The numbers in a result that broadcast: a list of scalars or arrays."""
    if dataclasses.is_dataclass(result):
        names = [field.name for field in dataclasses.fields(result) if field.name != "n"]
        result = tuple(getattr(result, name) for name in names)
    return list(result) if isinstance(result, tuple) else [result]


def floats(result):
    """Those that are not a status, a count or a flag."""
    return [output for output in outputs(result) if np.asarray(output).dtype.kind == "f"]


def assert_same(found, expected):
    """Bit for bit, and of one shape and type."""
    found, expected = outputs(found), outputs(expected)
    assert len(found) == len(expected)
    for one, other in zip(found, expected, strict=True):
        assert np.asarray(one).dtype == np.asarray(other).dtype
        np.testing.assert_array_equal(one, other, strict=True)


def refusal(error, function, *args, **options):
    """The message of a refusal, which is one line and comes from no deeper error."""
    with pytest.raises(error) as caught:
        function(*args, **options)
    assert type(caught.value) is error
    message = str(caught.value)
    assert message
    assert "\n" not in message
    return message


# --- wrong types --------------------------------------------------------------------------

WRONG_TYPES = [
    "30",
    b"30",
    None,
    1j,
    True,
    np.True_,
    object(),
    {1.0},
    {"v0": 1.0},
    iter([1.0]),
    Fraction(1, 2),
    Decimal("0.5"),
    timedelta(1),
    np.datetime64("2008-01-01"),
    np.timedelta64(1, "s"),
    [True, False],
    ["1", "2"],
    [0.5, None],
    [0.5, "a"],
    [0.5, 1j],
    [0.5, [0.5, 0.5]],
    np.array([0.5, 0.5], dtype=object),
    np.array([0.5 + 0j]),
    np.zeros(2, dtype=[("a", float)]),
]


@each_argument
def test_wrong_type(name, argument):
    for value in WRONG_TYPES:
        message = refusal(TypeError, call, name, **{argument: value})
        absent = value is None and (argument in ("diameter", "area") or f"at {argument}" == name)
        words = "give exactly one of" if absent else f"{argument} must be real numbers"
        assert message.startswith(words), value


@each_argument
def test_masked(name, argument):
    value = CASES[name].good[argument]
    for mask in (False, True):
        masked = np.ma.masked_array([value, value], [False, mask])
        message = refusal(TypeError, call, name, **{argument: masked})
        assert message.startswith(f"{argument} is a masked array; fill")


def test_masked_in_a_list():
    for value in ([np.ma.masked, 1.0], [np.ma.masked_array([0.5], [True])]):
        assert refusal(TypeError, d_norm, value, 0.5).startswith("v_norm ")


class PintLike:
    """A number with ``units``, which turns into an array when asked, as pint's do."""

    def __init__(self, value):
        self.magnitude, self.units = value, "metre"

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.magnitude, dtype)

    def __float__(self):
        return float(self.magnitude)


class AstropyLike(np.ndarray):
    """An array with ``unit``, as astropy's are."""

    unit = "deg"


class Stubborn:
    """A quantity that will not become a plain number at all."""

    units = "metre"

    def __array__(self, dtype=None, copy=None):
        raise RuntimeError("cannot strip the units")

    def __float__(self):
        raise RuntimeError("cannot strip the units")


@each_argument
def test_units(name, argument):
    value = CASES[name].good[argument]
    for quantity in (
        PintLike(value),
        PintLike([value, value]),
        np.array([value, value]).view(AstropyLike),
        np.array(value).view(AstropyLike),
        Stubborn(),
    ):
        message = refusal(TypeError, call, name, **{argument: quantity})
        assert message.startswith(f"{argument} carries units; pass its plain magnitude")


@pytest.mark.parametrize(
    "value",
    [
        [PintLike(0.5), PintLike(0.75)],
        (0.5, PintLike(0.75)),
        [[0.5], [PintLike(0.75)]],
        [np.array([0.5, 0.75]).view(AstropyLike)],
        [Stubborn()],
    ],
    ids=["list", "tuple", "nested", "arrays", "stubborn"],
)
def test_units_in_a_list(value):
    """Degrees in a list are as wrong as degrees in an array."""
    message = refusal(TypeError, d_norm, 1.0, value)
    assert message.startswith("alpha0 ")
    assert "units" in message


# --- out of range -------------------------------------------------------------------------


@each_argument
def test_out_of_range(name, argument):
    kind = CASES[name].kinds[argument]
    for value in kind.illegal:
        message = refusal(ValueError, call, name, **{argument: value})
        assert message.startswith(f"{argument} must be {kind.words}; got {value!r}")
        hint = " (if these are degrees: np.deg2rad)"
        assert message.endswith(hint) == ("radians" in kind.words and RIGHT < abs(value) < INF)


@each_argument
def test_out_of_range_in_an_array(name, argument):
    """How many, and the first; NaN is not one of them."""
    good, kind = CASES[name].good[argument], CASES[name].kinds[argument]
    for value in kind.illegal:
        array = np.array([[good, NAN, good], [value, good, kind.illegal[0]]])
        message = refusal(ValueError, call, name, **{argument: array})
        assert message.startswith(f"{argument} must be {kind.words}")
        assert f"; 2 of 6 are not, the first is {value!r}" in message
    message = refusal(ValueError, call, name, **{argument: [kind.illegal[0]]})
    assert f"; 1 of 1 are not, the first is {kind.illegal[0]!r}" in message


@each_argument
def test_the_first_is_the_first_in_order(name, argument):
    good, (words, illegal, _) = CASES[name].good[argument], CASES[name].kinds[argument]
    array = np.array([[good, illegal[-1]], [illegal[0], good]], order="F")
    message = refusal(ValueError, call, name, **{argument: array})
    assert words in message
    assert f"the first is {illegal[-1]!r}" in message


@pytest.mark.parametrize("function", [speed, arc_length, position])
def test_slope_above_the_launch(function):
    for alpha in (0.75, [0.25, 0.75], np.nextafter(0.5, 1)):
        message = refusal(ValueError, function, 1.0, 0.5, alpha)
        assert "alpha0" in message
    function(1.0, 0.5, 0.5)


def test_arguments_that_are_legal_one_by_one():
    words = "v0 / v_lim must be at most 1e20"
    assert words in refusal(ValueError, Launch, 1e25, 0.5, 1e-20)
    assert words in refusal(ValueError, Launch, [1.0, 1e25], 0.5, 1e-20, n=1)
    for height in (1e30, -1e30):
        message = refusal(ValueError, Launch, 1.0, 0.5, 1e-3, height=height)
        assert message.startswith("abs(height) * g / v_lim**2 must be at most 1e20; got ")
    assert Launch(1e20, 0.5, 1.0, n=10).v_norm == 1e20


@each_argument
def test_shapes_that_do_not_broadcast(name, argument):
    good = CASES[name].good
    if len(good) == 1:
        return
    other = next(word for word in good if word != argument)
    shapes = {argument: np.full(2, good[argument]), other: np.full((4, 3), good[other])}
    message = refusal(ValueError, call, name, **shapes)
    assert message.startswith("arguments do not broadcast together: ")
    for word, shape in ((argument, "(2,)"), (other, "(4, 3)")):  # a body has become k, then v_lim
        assert any(f"{part} {shape}" in message for part in (word, "k", "v_lim", "launch"))


def test_keywords():
    """Options are keyword-only, and none is swallowed."""
    refusal(TypeError, Launch, 30.0, 0.5)
    refusal(TypeError, Launch, 30.0, 0.5, 40.0, 9.81)
    refusal(TypeError, Launch, 30.0, 0.5, 40.0, gravity=9.81)
    refusal(TypeError, Launch.from_drag, 30.0, 0.5, 0.01, 9.81)
    refusal(TypeError, d_norm, 1.0)
    refusal(TypeError, d_norm, 1.0, 0.5, 0.5)
    refusal(TypeError, d_ref, 1.0, 0.5, 9.81)


# --- NaN ----------------------------------------------------------------------------------


@each_argument
def test_nan(name, argument):
    """NaN in, NaN out, and the neighbours are what they were."""
    good = CASES[name].good[argument]
    clean = call(name, **{argument: np.full((2, 3), good)})
    array = np.full((2, 3), good)
    array[0, 1] = NAN
    nan = np.isnan(array)
    dirty = call(name, **{argument: array})
    for before, after in zip(outputs(clean), outputs(dirty), strict=True):
        assert before.shape == after.shape == (2, 3)
        assert before.dtype == after.dtype
        np.testing.assert_array_equal(after[~nan], before[~nan])
    if name.startswith("Launch"):  # it holds what it was given
        assert np.isnan(getattr(dirty, argument)[nan]).all()
        return
    if name in ("from_drag", "from_body"):
        dirty = dirty.landing()
    if name in ("apex", "apex in a wind") and argument == "height":
        dirty = dirty[1]  # where and when the apex comes does not depend on the height
    for output in floats(dirty):
        assert np.isnan(output[nan]).all()


@each_argument
def test_nan_alone(name, argument):
    if name in ("apex", "apex in a wind") and argument == "height":
        return
    result = call(name, **{argument: NAN})
    if name in ("Launch", "Launch in a wind", "from_drag", "from_body"):
        result = result.range()
    for output in floats(result):
        assert np.isnan(output)


def test_nan_beats_the_limits():
    """v_norm = 0 and alpha0 = 0 have their answer without a flight, but not beside NaN."""
    for function in (d_norm, landing_angle, laws.table_1):
        assert np.isnan(function([0.0, NAN], [NAN, 0.0])).all()
    assert np.isnan(newton_vial([0.0, NAN], [NAN, 0.0]).alpha).all()


def test_nan_is_no_success():
    landing = Launch([30.0, NAN], 0.5, 40.0).landing()
    assert landing.success.tolist() == [True, False]
    assert landing.success.dtype == bool


def test_trajectory_of_nan():
    path = Launch([30.0, NAN, 20.0], 0.5, 40.0).trajectory(5)
    alone = Launch([30.0, 20.0], 0.5, 40.0).trajectory(5)
    for column, expected in zip(outputs(path), outputs(alone), strict=True):
        assert column.shape == (3, 5)
        assert np.isnan(column[1]).all()
        np.testing.assert_array_equal(column[[0, 2]], expected)


# --- unreachable --------------------------------------------------------------------------


def test_unreachable():
    launch = Launch(30.0, [0.5, 0.5, -0.5, 0.0], 40.0, height=[0.0, -100.0, -1e-3, -1e-9])
    landing = launch.landing()
    assert landing.status.tolist() == [0, 1, 1, 1]
    assert landing.success.tolist() == [True, False, False, False]
    for output in (landing.x, landing.t, landing.speed, landing.alpha, landing.arc_length):
        np.testing.assert_array_equal(np.isnan(output), [False, True, True, True])
    np.testing.assert_array_equal(np.isnan(launch.range()), [False, True, True, True])
    np.testing.assert_array_equal(np.isnan(launch.flight_time()), [False, True, True, True])
    for column in outputs(launch.trajectory(3)):
        np.testing.assert_array_equal(np.isnan(column).any(axis=-1), [False, True, True, True])
        np.testing.assert_array_equal(np.isnan(column).all(axis=-1), [False, True, True, True])
    assert np.isfinite(launch.apex()).all()


def test_unreachable_alone():
    landing = Launch(30.0, 0.5, np.inf, height=-100.0).landing()
    assert landing.status == 1
    assert not landing.success
    assert np.isnan(landing.x)


@pytest.mark.parametrize("v_lim", [0.5, 40.0, np.inf])
def test_the_apex_parts_reachable_from_not(v_lim):
    apex = Launch(30.0, 0.75, v_lim).apex()[1]
    heights = -apex * np.array([1 - 1e-9, 1 + 1e-9])
    assert Launch(30.0, 0.75, v_lim, height=heights).landing().status.tolist() == [0, 1]


# --- shapes and memory --------------------------------------------------------------------


@each_function
def test_scalars(name):
    for output in floats(call(name)):
        assert type(output) is np.float64
    for output in outputs(call(name)):
        assert isinstance(output, np.generic)


@each_argument
def test_0d_arrays_are_scalars(name, argument):
    value = CASES[name].good[argument]
    assert_same(call(name, **{argument: np.array(value)}), call(name))
    for output in outputs(call(name, **{argument: np.array(value)})):
        assert isinstance(output, np.generic)


@each_argument
@pytest.mark.parametrize("shape", [(0,), (0, 3), (2, 0)])
def test_empty(name, argument, shape):
    result = call(name, **{argument: np.empty(shape)})
    full = call(name, **{argument: np.full((1, 1), CASES[name].good[argument])})
    for output, like in zip(outputs(result), outputs(full), strict=True):
        assert output.shape == shape
        assert output.dtype == like.dtype


def test_empty_list():
    for output in (d_norm([], 0.5), landing_angle([], []), optimal_angle([])):
        assert output.shape == (0,)
        assert output.dtype == np.float64
    assert Launch([], 0.5, 40.0).trajectory(4).x.shape == (0, 4)
    assert d_norm(np.empty((0, 1)), np.full(3, 0.5)).shape == (0, 3)


@each_function
def test_broadcast(name):
    """Each element is what the scalars give, to some units in the last place."""
    good = CASES[name].good
    names = list(good)
    arrays = {names[0]: good[names[0]] * np.array([[1.0], [0.875]])}
    if len(names) > 1:
        arrays[names[1]] = good[names[1]] * np.array([1.0, 0.5, 0.25])
    shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    found = outputs(call(name, **arrays))
    each = {word: np.broadcast_to(array, shape) for word, array in arrays.items()}
    for at in np.ndindex(shape):
        expected = call(name, **{word: array[at] for word, array in each.items()})
        for output, value in zip(found, outputs(expected), strict=True):
            assert output.shape == shape
            np.testing.assert_allclose(output[at], value, rtol=4e-15, atol=1e-15)


@each_argument
def test_layout(name, argument):
    """Any layout in memory, writable or not, gives the same and is left alone."""
    good = CASES[name].good[argument]
    plain = np.ascontiguousarray(np.linspace(1, 0.75, 6).reshape(2, 3) * good)
    expected = call(name, **{argument: plain.copy()})
    wide = np.full((4, 9), NAN)
    wide[::2, ::3] = plain
    read_only = plain.copy()
    read_only.flags.writeable = False
    backwards = np.ascontiguousarray(plain[::-1, ::-1])[::-1, ::-1]
    for array in (
        plain,
        wide[::2, ::3],
        np.asfortranarray(plain),
        backwards,
        plain.astype(">f8"),
        plain.tolist(),
        read_only,
    ):
        before = np.array(array)
        assert_same(call(name, **{argument: array}), expected)
        np.testing.assert_array_equal(array, before)
    assert not read_only.flags.writeable
    stretched = np.broadcast_to(np.array(good), (2, 3))  # every element at one address
    assert_same(
        call(name, **{argument: stretched}), call(name, **{argument: np.full((2, 3), good)})
    )


def test_results_do_not_share_memory_with_the_input():
    v0, alpha0 = np.array([20.0, 30.0]), np.array([0.5, 0.75])
    launch = Launch(v0, alpha0, 40.0)
    before = launch.range()
    axis = np.array([0.5, 1.0])
    table = grid.tabulate(axis, alpha0)
    v0[:], alpha0[:], axis[:] = 1.0, 0.1, 0.0
    np.testing.assert_array_equal(launch.range(), before)
    np.testing.assert_array_equal(table.v_norm, [0.5, 1.0])
    np.testing.assert_array_equal(table.alpha0, [0.5, 0.75])


def test_a_launch_is_frozen():
    launch = Launch(30.0, 0.5, 40.0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        launch.v0 = 40.0


# --- other number types -------------------------------------------------------------------


@each_argument
@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.longdouble, ">f4"])
def test_float_types(name, argument, dtype):
    """They are converted, exactly or to the nearest double, and the result is a double."""
    array = np.array([CASES[name].good[argument]] * 2, dtype)
    expected = call(name, **{argument: array.astype(np.float64)})
    assert_same(call(name, **{argument: array}), expected)
    assert_same(call(name, **{argument: array[0]}), call(name, **{argument: float(array[0])}))
    for output in floats(expected):
        assert output.dtype == np.float64


@each_argument
def test_integers(name, argument):
    whole = 0 if argument.startswith("alpha") else 1
    changed = {"alpha": -0.5} if argument == "alpha0" and "alpha" in CASES[name].good else {}
    expected = call(name, **changed, **{argument: float(whole)})
    for integer in (whole, np.int8(whole), np.uint64(whole), np.array(whole, np.int32)):
        assert_same(call(name, **changed, **{argument: integer}), expected)
    array = np.array([whole, whole], np.int64)
    assert_same(
        call(name, **changed, **{argument: array}),
        call(name, **changed, **{argument: array.astype(float)}),
    )


def test_integers_beyond_64_bits():  # which NumPy knows only as objects
    assert d_norm(2**64, 0.5) == d_norm(2.0**64, 0.5)
    np.testing.assert_array_equal(d_norm([2**64, 1, 0.5], 0.5), d_norm([2.0**64, 1, 0.5], 0.5))
    assert Launch([[2**70], [1]], 0.5, 2**70).v0.tolist() == [[2.0**70], [1.0]]
    for value in (2**70, 10**400):
        message = refusal(ValueError, d_norm, value, 0.5)
        assert message.startswith("v_norm must be in [0, 1e20]; got ")
    message = refusal(ValueError, d_norm, [1, -(10**400)], 0.5)
    assert message.endswith("; 1 of 2 are not, the first is -inf")
    for value in ([2**70, None], [2**70, 1j], [2**70, Fraction(1, 2)], [2**70, True]):
        assert refusal(TypeError, d_norm, value, 0.5).startswith("v_norm must be real numbers")
    many = np.array([2**70], dtype=object)
    assert refusal(TypeError, d_norm, many, 0.5).startswith("v_norm must be real numbers")


@pytest.mark.parametrize(
    "value",
    [
        [1.0, True],
        [1, False],
        (1.0, np.True_),
        [[1.0], [True]],
        [np.array([True]), np.array([1.0])],
    ],
    ids=repr,
)
def test_flags_among_numbers(value):  # which NumPy would take for 1 and 0
    message = refusal(TypeError, d_norm, value, 0.5)
    assert message.startswith("v_norm must be real numbers; got ")
    assert message.endswith(" of dtype bool")


def test_longdouble_beyond_float64():
    if np.finfo(np.longdouble).max <= MOST:
        pytest.skip("longdouble is float64 here")
    message = refusal(ValueError, d_norm, np.longdouble("1e4000"), 0.5)
    assert message == "v_norm must be in [0, 1e20]; got inf"
    assert d_norm(np.longdouble("1e-4000"), 0.5) == 1.0


def test_right_angle_in_few_digits():
    """The float32 nearest to pi/2 lies above it and counts as it; the nearest float16 below."""
    right = np.deg2rad(np.float32(90))
    assert float(right) > RIGHT
    for angle in (right, float(right), np.nextafter(RIGHT, 2), RIGHT + 1.19e-7):
        assert d_norm(1.0, angle) == d_norm(1.0, RIGHT)
        assert d_norm(1.0, [0.5, angle])[1] == pytest.approx(d_norm(1.0, RIGHT), rel=4e-15)
        assert Launch(1.0, angle, 1.0).alpha0 == RIGHT
        assert Launch(1.0, -angle, 1.0).alpha0 == -RIGHT
        assert speed(1.0, angle, -angle) == 1
    assert Launch(1.0, SHORT_OF_RIGHT, 1.0).alpha0 == SHORT_OF_RIGHT
    message = refusal(ValueError, position, 1.0, 0.5, -right)
    assert message == "alpha must be in (-pi/2, pi/2] radians; got -1.5707963267948966"
    assert 0 < d_norm(1.0, np.float16(RIGHT)) < 1
    assert d_norm(1.0, np.arctan2(np.longdouble(1), 0)) == d_norm(1.0, RIGHT)


# --- huge, tiny, subnormal ----------------------------------------------------------------

SPEEDS = np.array([*V_NORM.legal, 2e-308, 1e-100, 0.5, 1e10])
ANGLES = np.array([*LEVEL.legal, 1e-300, 1e-100, 1e-20, 0.5, 1.5])
PLANE = [axis.ravel() for axis in np.meshgrid(SPEEDS, ANGLES)]


def test_d_norm_at_the_extremes():
    found = d_norm(*PLANE)
    assert ((found >= 0) & (found <= 1)).all()
    vacuum = (PLANE[0] < 1e-9) | (PLANE[1] == 0)
    np.testing.assert_allclose(found[vacuum], 1, rtol=1e-15)


def test_landing_angle_at_the_extremes():
    found = landing_angle(*PLANE)
    assert (found >= -RIGHT).all()
    assert (found <= -PLANE[1] * (1 - 1e-15)).all()


def test_optimal_angle_at_the_extremes():
    found = optimal_angle(np.sort(SPEEDS))
    assert ((found > 0) & (found <= np.pi / 4)).all()
    assert (np.diff(found) <= 1e-15).all()


@pytest.mark.parametrize("function", [speed, arc_length, position])
def test_paths_at_the_extremes(function):
    angles = np.sort([*ANGLES, *-ANGLES[ANGLES < RIGHT]])
    v, alpha0, alpha = (axis.ravel() for axis in np.meshgrid(SPEEDS, angles, angles))
    down = alpha <= alpha0
    if function is position:  # which excludes the vertical, and in the end the fall below it
        down &= alpha > -RIGHT
    for output in outputs(function(v[down], alpha0[down], alpha[down])):
        assert np.isfinite(output).all()


def test_speed_at_the_launch():
    angles = np.array([*ANGLES, *-ANGLES[ANGLES < RIGHT]])
    found = speed(SPEEDS[:, np.newaxis], angles, angles)
    np.testing.assert_allclose(found, SPEEDS[:, np.newaxis] + 0 * angles, rtol=1e-15)


@each_argument
def test_one_extreme_argument(name, argument):
    """No warning, and a result; what no double holds is infinite, and never NaN."""
    for value in CASES[name].kinds[argument].legal:
        changed = {argument: value}
        if argument == "alpha0" and "alpha" in CASES[name].good:
            changed["alpha"] = min(-0.5, value)
            if name == "position" and value == -RIGHT:
                continue  # from there it falls along one slope, which has no end
        refused = ""
        try:
            result = call(name, **changed)
        except ValueError as error:
            refused = str(error)
        if refused:  # a fall whose depth in the natural unit no double holds
            ratios = "abs(height) * g / v_lim**2 ", "v0 / v_lim ", "v_lim ", "abs(wind) / v_lim "
            assert refused.startswith(ratios)
            assert argument in ("v_lim", "k", "g", "height", *BODY, "diameter")
            continue
        if hasattr(result, "status") and name != "newton_vial":
            assert result.status in (0, 1), value
            if result.status == 1 and name != "landing":
                continue
        for output in floats(result):
            unreachable = argument == "height" and value < -2
            if name == "range in a wind":  # a gale blows it off the ground
                unreachable = Launch(**(CASES[name].good | changed)).landing().status == 1
            assert unreachable or name == "newton_vial" or not np.isnan(output), value


def test_the_vacuum_range_at_the_extremes():
    for v0, g in ((1e30, 1e-30), (1e30, 1e30), (1e-30, 1e-30), (1e-30, 1e30)):
        assert d_ref(v0, 0.5, g=g) == pytest.approx(v0 * np.sin(1.0) * (v0 / g), rel=1e-15)


def test_terminal_speed_at_the_extremes():
    assert terminal_speed(0) == INF
    assert terminal_speed(LEAST, g=1.0) == pytest.approx(2.0**537, rel=1e-15)
    assert terminal_speed(1e300, g=1e-30) == pytest.approx(1e-165, rel=1e-15)
    assert terminal_speed(1e-300, g=1e30) == pytest.approx(1e165, rel=1e-15)


def test_a_very_long_fall():
    """Drag ends the way across: from some depth on the range no longer changes."""
    heights = np.array([1e6, 1e9, 1e12, 1e15, 1e20])
    launch = Launch(10.0, 0.5, 5.0, height=heights)
    np.testing.assert_allclose(launch.range(), launch.range()[0], rtol=1e-13)
    np.testing.assert_allclose(launch.flight_time(), heights / 5.0, rtol=1e-5)
    np.testing.assert_allclose(launch.apex()[0], Launch(10.0, 0.5, 5.0).apex()[0], rtol=1e-13)


def test_a_launch_scales():
    """Lengths and speeds in other units: powers of two change no digit."""
    launch = Launch(30.0, 0.75, 40.0, height=[-2.0, 0.0, 50.0])
    for unit in (2.0**-80, 2.0**-30, 2.0**50, 2.0**80):
        scaled = Launch(30.0 * unit, 0.75, 40.0 * unit, g=9.81 * unit, height=launch.height * unit)
        np.testing.assert_array_equal(scaled.range(), launch.range() * unit)
        np.testing.assert_array_equal(scaled.flight_time(), launch.flight_time())
        np.testing.assert_array_equal(scaled.landing().speed, launch.landing().speed * unit)


def test_a_trajectory_begins_as_it_was_launched():
    for v0 in (0.0, 1e-30, 1e-20, 30.0, 1e8, 1e20):
        path = Launch(v0, 0.5, 5.0).trajectory(4)
        start = [column[0] for column in outputs(path)]
        assert start == [0, 0, 0, 0, pytest.approx(v0, rel=1e-15), 0.5, 0]
        assert path.y[-1] == 0
        assert (np.diff(path.x) >= 0).all()
        assert (np.diff(path.t) >= 0).all()


# --- options ------------------------------------------------------------------------------

NOT_INTEGERS = (2.0, 2.5, "2", None, NAN, [2], np.array([2, 3]), True)


def test_points_of_a_trajectory():
    launch = Launch(30.0, 0.5, 40.0)
    for n in NOT_INTEGERS:
        assert refusal(TypeError, launch.trajectory, n).startswith("points must be an integer")
    for n in (1, 0, -5, np.int64(1)):
        assert refusal(ValueError, launch.trajectory, n) == f"points must be >= 2; got {n}"
    for n in (2, np.int64(3), np.uint8(4)):
        assert launch.trajectory(n).x.shape == (int(n),)


def test_options_of_the_papers_newton():
    for steps in NOT_INTEGERS:
        message = refusal(TypeError, newton_vial, 1.0, 0.5, max_steps=steps)
        assert message.startswith("max_steps must be an integer")
    assert (
        refusal(ValueError, newton_vial, 1.0, 0.5, max_steps=0) == "max_steps must be >= 1; got 0"
    )
    for stop in ("0.1", None, 1j, True):
        assert refusal(TypeError, newton_vial, 1.0, 0.5, stop=stop).startswith("stop must be")
    for stop in (0.0, -1.0, INF, NAN):
        message = refusal(ValueError, newton_vial, 1.0, 0.5, stop=stop)
        assert message.startswith("stop must be finite and > 0")
    for stop in ([0.1, 0.2], np.array([0.1])):
        with pytest.raises((TypeError, ValueError), match=r"^stop must be .*number"):
            newton_vial(1.0, 0.5, stop=stop)


def test_degree_of_a_polynomial():
    x = y = [0.0, 1.0, 2.0, 3.0]
    for degree in NOT_INTEGERS:
        message = refusal(TypeError, laws.fit_polynomial, x, y, degree)
        assert message.startswith("degree must be an integer")
    message = refusal(ValueError, laws.fit_polynomial, x, y, -1)
    assert message == "degree must be >= 0; got -1"
    assert "at least 5" in refusal(ValueError, laws.fit_polynomial, x, y, 4)


def test_height_of_a_fit():
    x, y = [0.5, 1.0, 1.5], [0.9, 0.8, 0.7]
    for h in (0.0, -1.0, INF, NAN):
        message = refusal(ValueError, laws.fit_pearson, x, y, h=h)
        assert message.startswith("h must be finite and > 0")
    for h in ("1", None, True):
        assert refusal(TypeError, laws.fit_pearson, x, y, h=h).startswith("h must be real")
    with pytest.raises((TypeError, ValueError), match=r"^h must be .*number"):
        laws.fit_pearson(x, y, h=[1.0, 1.0, 1.0])


# --- data of a fit ------------------------------------------------------------------------

FITS = {
    "pearson": laws.fit_pearson,
    "polynomial": lambda x, y: laws.fit_polynomial(x, y, 1),
}


@pytest.mark.parametrize("fit", FITS.values(), ids=FITS)
@pytest.mark.parametrize("argument", ["x", "y"])
def test_data_of_a_fit(fit, argument):
    good = {"x": [0.5, 1.0, 1.5], "y": [0.9, 0.8, 0.7]}
    for value in WRONG_TYPES:
        message = refusal(TypeError, fit, **(good | {argument: value}))
        assert message.startswith(f"{argument} must be real numbers")
    for value in (INF, -INF):
        message = refusal(ValueError, fit, **(good | {argument: [1.0, value, 2.0]}))
        assert message.startswith(f"{argument} must be finite; 1 of 3 are not")
    message = refusal(ValueError, fit, **(good | {argument: [1.0, NAN, 2.0]}))
    assert message == f"{argument} must not hold NaN"
    for value in (1.0, [1.0, 2.0], [[0.5, 1.0, 1.5]], []):
        message = refusal(ValueError, fit, **(good | {argument: value}))
        assert message.startswith("x and y must be 1-D, of one length, at least 2; got")
    masked = np.ma.masked_array(good[argument], [False, True, False])
    assert "masked" in refusal(TypeError, fit, **(good | {argument: masked}))


def test_too_few_points():
    assert "at least 2" in refusal(ValueError, laws.fit_pearson, [1.0], [0.5])
    assert "at least 3" in refusal(ValueError, laws.fit_polynomial, [1.0, 2.0], [0.5, 0.4], 2)


@pytest.mark.parametrize("x", [[1.0, 1.0, 1.0], [1.0, 1.0, 2.0]])
def test_points_too_few_apart_for_the_degree(x):
    """Three data at one or two places do not determine a parabola."""
    message = refusal(ValueError, laws.fit_polynomial, x, [1.0, 2.0, 3.0], 2)
    assert message.startswith("x must")


def test_points_that_say_nothing_of_the_width():
    """At x = 0 the law is h whatever K and M."""
    message = refusal(ValueError, laws.fit_pearson, [0.0, 0.0, 0.0], [0.9, 0.8, 0.7])
    assert message.startswith("x must")


def test_relative_weights():
    message = refusal(ValueError, laws.fit_pearson, [1, 2, 3], [0.9, 0.0, -1.0], relative=True)
    assert message == "y must be finite and > 0; 2 of 3 are not, the first is 0.0"


def test_fits_leave_their_data_alone():
    x, y = np.array([0.5, 1.0, 1.5]), np.array([0.9, 0.8, 0.7])
    x.flags.writeable = y.flags.writeable = False
    laws.fit_pearson(x, y)
    laws.fit_polynomial(x[::-1], y[::-1], 1)
    laws.fit_pearson(x.astype(np.float32), [1, 1, 1])


# --- the grid and its files ---------------------------------------------------------------


@pytest.mark.parametrize(("argument", "kind"), [("v_norm", V_NORM), ("alpha0", LEVEL)])
def test_axes_of_a_grid(argument, kind):
    for value in WRONG_TYPES:
        if value is not None:  # None is the default axis
            message = refusal(TypeError, grid.tabulate, **{argument: value})
            assert message.startswith(f"{argument} must be real numbers")
    for value in kind.illegal:
        message = refusal(ValueError, grid.tabulate, **{argument: [0.5, value]})
        assert message.startswith(f"{argument} must be {kind.words}; 1 of 2 are not")
    for value in (0.5, [[0.5]], np.zeros((2, 2))):
        message = refusal(ValueError, grid.tabulate, **{argument: value})
        assert message.startswith(f"{argument} must be a 1-D axis; got")
    quantity = PintLike([0.5])
    assert "units" in refusal(TypeError, grid.tabulate, **{argument: quantity})


def test_grid_of_anything_legal():
    table = grid.tabulate(np.float32([0, 1, NAN]), [])
    assert table.d_norm.shape == (3, 0)
    table = grid.tabulate([1, NAN], [0.5])
    assert np.isnan(table.d_norm).tolist() == [[False], [True]]
    assert {array.dtype for array in outputs(table)} == {np.dtype(np.float64)}


@pytest.fixture
def small():
    return grid.tabulate([0.0, 1.0], [0.0, 0.5])


SAVERS = pytest.mark.parametrize("save", [grid.save_npz, grid.save_csv])


@SAVERS
def test_an_existing_file_is_kept(save, small, tmp_path):
    target = tmp_path / "table"
    target.write_text("mine")
    message = refusal(FileExistsError, save, small, target)
    assert str(target) in message
    assert "force" in message
    assert target.read_text() == "mine"
    save(small, target, force=True)
    assert target.read_bytes() != b"mine"
    assert [path.name for path in tmp_path.iterdir()] == ["table"]


@SAVERS
def test_a_place_that_cannot_be_written(save, small, tmp_path):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "folder").mkdir()
    for target in (tmp_path / "file" / "table", tmp_path / "file" / "deeper" / "table"):
        with pytest.raises(OSError, match="file"):
            save(small, target)
    with pytest.raises(OSError, match="folder"):
        save(small, tmp_path / "folder", force=True)
    assert (tmp_path / "file").read_text() == "mine"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "folder"]
    assert list((tmp_path / "folder").iterdir()) == []


@SAVERS
def test_a_path_that_is_none(save, small):
    for path in (None, 3, 3.5, b"bytes"):
        refusal(TypeError, save, small, path)


@SAVERS
def test_a_failed_write_leaves_nothing(save, small, tmp_path, monkeypatch):
    import os

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OSError, match="No space left"):
        save(small, tmp_path / "table")
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_is_no_grid(tmp_path):
    with pytest.raises(FileNotFoundError):
        grid.load(tmp_path / "none.npz")


# --- nothing else happens -----------------------------------------------------------------


def state():
    import matplotlib

    return (
        np.geterr(),
        np.geterrcall(),
        np.get_printoptions(),
        mpmath.mp.dps,
        mpmath.mp.pretty,
        matplotlib.rcParams.copy(),
        warnings.filters[:],
        np.random.get_state()[1].tolist(),  # noqa: NPY002 (the global state, to see it kept)
    )


def test_nothing_prints_and_nothing_changes(capfd):
    before = state()
    for name, (_, good, kinds) in CASES.items():
        call(name)
        for argument in good:
            call(name, **{argument: [good[argument], NAN]})
            for value in ("a", kinds[argument].illegal[0]):
                with pytest.raises((TypeError, ValueError)):
                    call(name, **{argument: value})
    launch = Launch(30.0, [0.5, 1.0], 40.0, height=-10.0)
    launch.landing()
    launch.trajectory()
    launch.v_norm  # noqa: B018 (a property, read for its effects)
    grid.tabulate()
    laws.fit_pearson([0.5, 1.0, 1.5], [0.9, 0.8, 0.7])
    laws.fit_polynomial([0.5, 1.0, 1.5], [0.9, 0.8, 0.7], 1)
    assert capfd.readouterr() == ("", "")
    assert state() == before


def test_the_callers_error_state_does_not_matter():
    """Who asks NumPy to raise gets the same answers, and no error."""
    rest = Launch([0.0, 30.0], 0.5, [40.0, INF], height=[2.0, 0.0])
    flights = {"v_norm": np.array([0.0, 1e-200, 1.0, 1e8]), "alpha0": np.array([0, 1e-200, 1, 1.5])}
    expected = d_norm(**flights), landing_angle(**flights), rest.landing(), rest.apex()
    with np.errstate(divide="raise", over="raise", invalid="raise"):
        found = d_norm(**flights), landing_angle(**flights), rest.landing(), rest.apex()
    for one, other in zip(found, expected, strict=True):
        assert_same(one, other)


def test_import_is_light_and_silent():
    script = (
        "import sys, hodograph\n"
        "print(sorted({'numpy', 'scipy', 'matplotlib', 'mpmath', 'IPython'} & set(sys.modules)))\n"
        "for n in (2.0, 1.5):\n"
        "    hodograph.d_norm(1.0, 0.5, n=n), hodograph.landing_angle(1.0, 0.5, n=n)\n"
        "    launch = hodograph.Launch(30.0, 0.5, 40.0, height=1.0, n=n)\n"
        "    launch.landing(), launch.apex(), launch.trajectory(3)\n"
        "print(sorted({'scipy', 'matplotlib', 'mpmath', 'IPython'} & set(sys.modules)))\n"
    )
    found = subprocess.run(
        [sys.executable, "-W", "error", "-c", script], capture_output=True, text=True, timeout=60
    )
    assert (found.stdout, found.stderr) == ("[]\n[]\n", "")


def test_submodules_are_there_without_import():
    """Error messages and documents name them so."""
    script = (
        "import hodograph, sys\n"
        "assert 'hodograph.reference' not in sys.modules\n"
        "print(*(getattr(hodograph, name).__name__ for name in hodograph.__all__[-4:]))\n"
    )
    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    names = "sensitivity", "steppers", "surrogate", "sweep"
    assert found.stdout.split() == [f"hodograph.{name}" for name in names]


def test_every_public_function_is_here():
    """A new public name needs its cases."""
    covered = {"d_norm", "d_ref", "landing_angle", "optimal_angle", "best_angle", "Launch"}
    covered |= {"aim", "envelope", "least_speed"}
    covered |= {"calibrate"}  # a film has cases of its own: test_calibrate.py
    results = {"Landing", "State", "Trajectory", "Shot", "LeastSpeed", "Envelope", "Calibration"}
    modules = {"bodies", "grid", "laws", "ode", "reference", "sensitivity", "steppers", "surrogate"}
    assert set(hodograph.__all__) == covered | results | modules | {"sweep", "__version__"}
    methods = {word for word in vars(Launch) if not word.startswith("_")}
    fields = {field.name for field in dataclasses.fields(Launch)}
    assert methods - fields == {
        *("from_drag", "from_body", "v_norm"),
        *("range", "flight_time", "landing", "apex", "at", "trajectory"),
    }
    assert Path(hodograph.__file__).with_name("py.typed").is_file()
