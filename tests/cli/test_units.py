"""Numbers with units, and several at once, as the command line takes them."""

import json
import math

import pytest

DRAG = ["--v-lim", "40"]


def found(run, *argv):
    code, out, err = run(*argv, "--json")
    assert (code, err) == (0, "")
    each = json.loads(out)
    for one in each if isinstance(each, list) else [each]:
        assert one.pop("status") == "converged"
    return each


@pytest.mark.parametrize(
    ("text", "metres_per_second"),
    [
        ("90mph", 40.2336),
        ("90 mph", 40.2336),
        ("36 km/h", 10.0),
        ("36KM/H", 10.0),
        ("1e2kmh", 100 / 3.6),
        ("130ft/s", 39.624),
        ("100fps", 30.48),
        ("50kn", 50 * 1852 / 3600),
        ("40m/s", 40.0),
    ],
)
def test_speeds(run, text, metres_per_second):
    assert found(run, "range", text, "45", *DRAG) == found(
        run, "range", repr(metres_per_second), "45", *DRAG
    )
    assert found(run, "range", "30", "45", "--v-lim", text) == found(
        run, "range", "30", "45", "--v-lim", repr(metres_per_second)
    )


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        *(("5m", 5.0), ("3ft", 0.9144), ("-10ft", -3.048), ("2yd", 1.8288), ("36in", 0.9144)),
        *(("12cm", 0.12), ("12mm", 0.012), ("0.1km", 100.0), ("0.01mi", 16.09344)),
    ],
)
def test_lengths(run, text, metres):
    scene = ["range", "30", "60", *DRAG, "--height"]
    assert found(run, *scene, text) == found(run, *scene, repr(metres))


@pytest.mark.parametrize(
    ("mass", "diameter"), [("0.145", "0.074"), ("145g", "74mm"), ("145 g", "7.4cm")]
)
def test_masses(run, mass, diameter):
    body = ["--mass", mass, "--diameter", diameter, "--cd", "0.35"]
    k = 0.5 * 1.225 * 0.35 * math.pi * 0.037**2 / 0.145
    assert found(run, "range", "40", "40", *body) == pytest.approx(
        found(run, "range", "40", "40", "--k", repr(k)), rel=1e-14
    )


@pytest.mark.parametrize(
    ("mass", "kilograms"), [("5.25oz", 0.14883499640625), ("16lb", 7.257477920), ("2kg", 2.0)]
)
def test_ounces_and_pounds(run, mass, kilograms):
    body = ["--area", "45cm2", "--cd", "0.35", "--mass"]
    assert found(run, "range", "40", "40", *body, mass) == pytest.approx(
        found(run, "range", "40", "40", *body, kilograms), rel=1e-14
    )


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        *(("40°", 40), ("-40°", -40), ("\N{MINUS SIGN}40", -40), ("40 deg", 40)),
        ("0.5rad", math.degrees(0.5)),
    ],
)
def test_angles(run, text, degrees):
    scene = [*DRAG, "--height", "50"]
    assert found(run, "range", "30", text, *scene) == found(
        run, "range", "30", repr(float(degrees)), *scene
    )


def test_other_quantities(run):
    assert found(run, "range", "30", "40", "--k", "0.01/m", "--g", "9.81m/s²") == found(
        run, "range", "30", "40", "--k", "0.01"
    )


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("30,40,50", [30, 40, 50]),
        ("-10, 20", [-10, 20]),
        ("30°,40°", [30, 40]),
        ("30,40deg", [30, 40]),
        ("0.5,0.6rad", [math.degrees(0.5), math.degrees(0.6)]),
        ("30deg,0.6rad", [30, math.degrees(0.6)]),
    ],
)
def test_several_angles(run, text, degrees):
    scene = [*DRAG, "--height", "50"]
    each = found(run, "range", "30", text, *scene)
    assert [one.pop("launch_angle_deg") for one in each] == degrees
    for one, angle in zip(each, degrees, strict=True):
        assert one == pytest.approx(found(run, "range", "30", repr(angle), *scene), rel=1e-13)


@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["range", "40,5", "45", *DRAG], ["V0", "m/s", "point", "no comma", "(write 40.5)"]),
        (["range", "1,000", "45", *DRAG], ["V0", "(write 1 or 1000)"]),
        (["range", "1,234.5", "45", *DRAG], ["V0", "(write 1234.5)"]),
        (["range", "40,5km/h", "45", *DRAG], ["V0", "(write 40.5km/h)"]),
        (["range", "40m", "45", *DRAG], ["V0", "of m/s", "km/h", "mph", "ft/s", "kn", "'40m'"]),
        (["range", "40", "45", *DRAG, "--height", "2s"], ["--height", "of m", "ft", "yd", "mi"]),
        (["range", "40", "40'", *DRAG], ["ANGLE", "degrees", "rad"]),
        (["range", "40", "40,", *DRAG], ["ANGLE", "number of degrees", "got ''"]),
        (["range", "40", "40,fast", *DRAG], ["ANGLE", "number of degrees", "'fast'"]),
        (["range", "40", "40,91", *DRAG], ["ANGLE", "[-90, 90] degrees", "'91'"]),
        (["range", "40", "45", "--mass", "5stone"], ["--mass", "kg", "g, oz, lb"]),
        (["range", "40", "45", *DRAG, "--n", "2m"], ["--n", "number, without a unit", "'2m'"]),
        (["range", "40", "45", "--v-lim", "1e308km"], ["--v-lim", "m/s"]),
        (["range", "40", "45", "--v-lim", "1e308km/h"], ["--v-lim", "> 0", "'1e308km/h'"]),
    ],
)
def test_no_number_is_told_what_is_expected(refused, argv, words):
    message = refused(2, *argv)
    assert [word for word in words if word not in message] == []


@pytest.mark.parametrize("text", ["30parsecs", "3+4j", "1.2.3", ".", "", "1,2,3,", "fast", "3e"])
def test_no_number_and_no_guess(refused, text):
    message = refused(2, "range", text, "45", *DRAG)
    assert "must be a number of m/s" in message
    assert f"got '{text}'" in message
    assert "write" not in message
