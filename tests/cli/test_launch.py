"""A launch on the command line: in a wind, on a slope, at a place, point by point."""

import json
import math

import numpy as np
import pytest

from hodograph import ode

STILL = ["30", "50", "--v-lim", "40", "--height", "2"]
WINDY = ["--wind", "-6", "--crosswind", "3m/s"]
SPEEDS = {"wind": -6.0, "crosswind": 3.0}


def found(run, *argv):
    code, out, err = run(*argv, "--json")
    assert (code, err) == (0, "")
    return json.loads(out)


def oracle(**scene):
    return ode.solve(30.0, math.radians(50), 40.0, height=2.0, rtol=1e-13, **scene)


# --- wind and slope -----------------------------------------------------------------------


@pytest.mark.parametrize("slope", [0, 12, -20])
@pytest.mark.parametrize("wind", [0, -6, 9])
def test_range(run, slope, wind):
    scene = ["--slope", slope, "--wind", wind, "--crosswind", "4"]
    landing = found(run, "range", *STILL, *scene)
    flight = oracle(slope=math.radians(slope), wind=wind, crosswind=4.0)
    expected = {
        "range_m": flight.x,
        "drift_m": flight.z,
        "flight_time_s": flight.t,
        "impact_speed_m_per_s": flight.speed,
        "impact_angle_deg": math.degrees(flight.alpha),
        "apex_distance_m": flight.apex.x,
        "apex_height_m": flight.apex.y,
        "apex_time_s": flight.apex.t,
    }
    if slope:
        expected["landing_height_m"] = flight.x * math.tan(math.radians(slope))
    assert landing.pop("status") == "converged"
    assert landing == pytest.approx(expected, rel=1e-10)


def test_a_table_has_what_the_scene_has(run):
    names = [line[:14].rstrip() for line in run("range", *STILL)[1].splitlines()]
    assert "drift" not in names
    assert "landing height" not in names
    out = run("range", *STILL, *WINDY, "--slope", "10deg")[1]
    names = [line[:14].rstrip() for line in out.splitlines()]
    assert names[:3] == ["range", "drift", "landing height"]


@pytest.mark.parametrize(("slope", "x"), [("20", 11.952328), ("-20", 19.123275), ("45", 3.345209)])
def test_published_slopes(run, slope, x):
    landing = found(run, "range", "15", "50", "--v-lim", "20", "--slope", slope)
    assert landing["range_m"] == pytest.approx(x, abs=1e-6)


def test_published_crosswind(run):
    body = ["--mass", "50g", "--diameter", "3cm", "--cd", "0.5", "--crosswind", "10"]
    landing = found(run, "range", math.hypot(20, 20), "45", *body)
    assert landing["range_m"] == pytest.approx(63.48134, abs=1e-5)
    assert landing["drift_m"] == pytest.approx(6.23781, abs=1e-5)


def test_straight_up_in_a_wind(run):
    landing = found(run, "range", "30", "90", "--v-lim", "40", "--wind", "5")
    assert landing["range_m"] > landing["apex_distance_m"] > 0


@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["--slope", "90"], ["--slope", "(-90, 90) degrees", "'90'"]),
        (["--wind", "inf"], ["--wind", "finite"]),
        (["--crosswind", "5kg"], ["--crosswind", "m/s", "km/h"]),
        (["--wind", "1e200"], ["wind", "1e30"]),
    ],
)
def test_what_is_no_scene(refused, argv, words):
    message = refused(2, "range", *STILL, *argv)
    assert [word for word in words if word not in message] == []


# --- at a place ---------------------------------------------------------------------------


@pytest.mark.parametrize("wind", [[], WINDY])
@pytest.mark.parametrize("t", [0.5, 2.5, 4.0])
def test_at(run, wind, t):
    expected = oracle(**(SPEEDS if wind else {})).state(t)
    by_time = found(run, "at", *STILL, *wind, "--t", t)
    assert by_time.pop("status") == "converged"
    words = {"t_s": t, "x_m": expected.x, "y_m": expected.y, "speed_m_per_s": expected.speed}
    words["angle_deg"] = math.degrees(expected.alpha)
    words["s_m"] = expected.air_length
    if wind:
        words["z_m"] = expected.z
    assert by_time == pytest.approx(words, rel=1e-9)
    rising = ["--rising"] if by_time["angle_deg"] > 0 else []
    for name, more in (("x", []), ("y", rising), ("s", [])):
        again = found(run, "at", *STILL, *wind, f"--{name}", by_time[f"{name}_m"], *more)
        assert again.pop("status") == "converged"
        assert again == pytest.approx(by_time, rel=1e-10)


def test_at_several_angles(run):
    argv = ["at", "30", "30,60", "--v-lim", "40", "--x", "40ft"]
    each = found(run, *argv)
    assert [one["launch_angle_deg"] for one in each] == [30.0, 60.0]
    assert [one["x_m"] for one in each] == pytest.approx([12.192, 12.192], rel=1e-14)
    code, out, err = run(*argv)
    assert (code, err) == (0, "")
    assert [line[:12].rstrip() for line in out.splitlines()] == [
        *("launch angle", "time", "distance", "height", "speed", "angle", "path", "status")
    ]


@pytest.mark.parametrize(
    ("place", "words"),
    [
        (["--x", "500"], "never comes to x = 500 m"),
        (["--y", "50"], "never comes to y = 50 m"),
        (["--y", "1", "--rising"], "never comes to y = 1 m"),
    ],
)
def test_a_place_never_reached(run, place, words):
    code, out, err = run("at", *STILL, *place)
    assert (code, err.count("\n")) == (1, 1)
    assert words in err
    assert out.splitlines()[-1].split() == ["status", "unreachable"]
    assert json.loads(run("at", *STILL, *place, "--json")[1])["x_m"] is None


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ([], ["--t", "--x", "--y", "--s", "one of"]),
        (["--t", "1", "--x", "1"], ["--x", "--t", "not allowed"]),
        (["--t", "-1"], ["--t", ">= 0", "'-1'"]),
        (["--t", "1m"], ["--t", "of s"]),
        (["--x", "1", "--rising"], ["--rising", "--y"]),
        (["--t", "1e200"], ["t must be in"]),
    ],
)
def test_what_is_no_place(refused, place, words):
    message = refused(2, "at", *STILL, *place)
    assert [word for word in words if word not in message] == []


# --- point by point -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("spacing", "name", "wind"),
    [
        *(("time", "t", []), ("x", "x", []), ("arc", "s", [])),
        *(("time", "t", WINDY), ("x", "x", ["--wind", "6"]), ("arc", "s", WINDY)),
    ],
)
@pytest.mark.parametrize("end", [[], ["--to-apex"]])
def test_spacing(run, spacing, name, wind, end):
    path = found(run, "trajectory", *STILL, *wind, "--spacing", spacing, "-n", "9", *end)
    np.testing.assert_allclose(path[name], np.linspace(0, path[name][-1], 9), rtol=1e-9)
    landing = found(run, "range", *STILL, *wind)
    last = ("apex_time_s", "apex_distance_m") if end else ("flight_time_s", "range_m")
    assert [path["t"][-1], path["x"][-1]] == pytest.approx([landing[key] for key in last])
    flight = oracle(**(SPEEDS if wind == WINDY else {"wind": 6.0 if wind else 0.0}))
    for at, t in enumerate(path["t"][:-1]):
        state = flight.state(t)
        assert path["x"][at] == pytest.approx(state.x, rel=1e-9, abs=1e-9)
        assert path["y"][at] == pytest.approx(state.y, rel=1e-9)
        if wind == WINDY:
            assert path["z"][at] == pytest.approx(state.z, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("end", [[], ["--to-apex"]])
def test_a_point_every_so_often(run, end):
    path = found(run, "trajectory", *STILL, "--dt", "0.25s", *end)
    landing = found(run, "range", *STILL)
    last = landing["apex_time_s" if end else "flight_time_s"]
    assert path["t"] == [*(0.25 * k for k in range(math.ceil(last / 0.25))), last]
    assert path["y"][-1] == pytest.approx(landing["apex_height_m"] if end else 0, abs=1e-12)


def test_every_so_often_ends_once(run):
    """Where the flight is a whole number of steps, to rounding."""
    path = found(run, "trajectory", "30", "30", "--k", "0", "--g", "10", "--dt", "0.1")
    np.testing.assert_allclose(path["t"], np.linspace(0, 3, 31), rtol=1e-14)


def test_columns_in_a_wind(run):
    lines = run("trajectory", *STILL, *WINDY, "-n", "3")[1].splitlines()
    assert "wind = -6 m/s, crosswind = 3 m/s" in lines[0]
    assert "z m across" in lines[1]
    assert lines[2] == "t,x,y,z,speed,alpha_deg,s"


@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["--dt", "0"], ["--dt", "> 0"]),
        (["--dt", "1e-9"], ["--dt", "more than 1000000 points"]),
        (["--spacing", "even"], ["--spacing", "arc", "time", "x"]),
        (["--spacing", "x", "--wind", "-1"], ["--spacing", "x", "against the wind"]),
    ],
)
def test_what_is_no_spacing(refused, argv, words):
    message = refused(2, "trajectory", *STILL, *argv)
    assert [word for word in words if word not in message] == []


def test_plots_on_a_slope_and_in_a_wind(run, tmp_path):
    scenes = (["--slope", "15"], WINDY, ["--slope", "-30", *WINDY], ["--to-apex"])
    for number, scene in enumerate(scenes):
        target = tmp_path / f"{number}.png"
        code, out, err = run(
            "trajectory", "30", "20,50,90", "--v-lim", "40", *scene, "--out", target
        )
        assert (code, out, err) == (0, "", f"hodograph: wrote {target}\n")
