"""The command line: its numbers, its files, its streams, and how it refuses and stops."""

import errno
import io
import json
import logging
import math
import os
import random
import shlex
import signal
import subprocess
import sys
import time
import types
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

import hodograph
from hodograph import _files as files
from hodograph import grid
from hodograph.cli import arguments as cli_arguments
from hodograph.cli import commands as cli
from hodograph.cli import show as cli_show
from hodograph.cli import streams as cli_streams

LEVEL = ["range", "30", "45", "--v-lim", "40"]
PATH = ["trajectory", "30", "45", "--v-lim", "40"]
BASEBALL = 0.5 * 1.2 * 0.33 * math.pi * 0.0365**2 / 0.145  # lambda / m, in 1/m
UNREACHABLE = ["30", "45", "--v-lim", "40", "--height", "-100"]


def one_line(err):
    head = "hodograph: error: "
    assert err.startswith(head)
    assert err.count("\n") == 1
    assert err.endswith("\n")
    return err.removeprefix(head).rstrip("\n")


def results(run, *argv):
    code, out, err = run("range", "--json", *argv)
    assert (code, err) == (0, "")
    assert out.count("\n") == 1
    return json.loads(out)


def table(text):
    """The columns of a CSV, by name."""
    rows = [line for line in text.splitlines() if not line.startswith("#")]
    data = np.loadtxt(io.StringIO("\n".join(rows[1:])), delimiter=",", ndmin=2)
    return dict(zip(rows[0].split(","), data.T, strict=True))


def command(*argv, **options):
    """A command in a process of its own."""
    argv = [sys.executable, "-m", "hodograph", *map(str, argv)]
    return subprocess.run(argv, capture_output=True, text=True, timeout=120, **options)


# --- the numbers --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("argv", "expected", "tolerance"),
    [
        (["100", "40.924", "--k", "0.001"], 600.84063, 1e-5),
        (["975", "24.7662", "--k", "0.0012"], 2481.73, 1e-2),
        # printed as 99.3183, by solve_ivp at its default tolerance
        (["40", "45", "--k", BASEBALL, "--g", "9.8", "--height", "1"], 99.310656, 1e-6),
    ],
)
def test_published_range(run, argv, expected, tolerance):
    assert results(run, *argv)["range_m"] == pytest.approx(expected, abs=tolerance)


@pytest.mark.parametrize(
    ("below", "expected"), [(50, 269.451), (100, 286.965), (200, 310.601), (500, 337.36)]
)
def test_published_greatest_range(run, below, expected):
    def reach(angle):
        return results(run, "100", angle, "--k", "0.0057", "--height", below)["range_m"]

    found = minimize_scalar(lambda a: -reach(a), bounds=(10, 45), method="bounded")
    assert -found.fun == pytest.approx(expected, abs=6e-4)


def test_published_point_of_a_trajectory(run):
    code, out, err = run(
        *("trajectory", "100", "45", "--v-lim", "150", "--g", "9.80665", "-n", "400")
    )
    assert (code, err) == (0, "")
    path = table(out)
    at_10_s = {name: float(CubicSpline(path["t"], column)(10)) for name, column in path.items()}
    assert at_10_s["speed"] == pytest.approx(62.289, abs=1e-3)
    assert at_10_s["alpha_deg"] == pytest.approx(-32.49, abs=1e-2)
    assert at_10_s["y"] == pytest.approx(156.404, abs=1e-3)
    assert at_10_s["x"] == pytest.approx(603.251, abs=1e-3)


@pytest.mark.parametrize("vacuum", [("--v-lim", "inf"), ("--v-lim", "Infinity"), ("--k", "0")])
@pytest.mark.parametrize(
    ("v0", "degrees", "height"), [(30, 45, 0), (30, 70, 12), (30, 40, -5), (30, -10, 50), (0, 5, 8)]
)
def test_vacuum(run, vacuum, v0, degrees, height):
    found = results(run, v0, degrees, *vacuum, "--g", "9.8", "--height", height)
    sine, cosine = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    up = v0 * sine
    down = math.sqrt(up**2 + 2 * 9.8 * height)
    duration = (up + down) / 9.8
    rise = max(up, 0)
    expected = {
        "range_m": v0 * cosine * duration,
        "flight_time_s": duration,
        "impact_speed_m_per_s": math.hypot(v0 * cosine, down),
        "impact_angle_deg": -math.degrees(math.atan2(down, v0 * cosine)),
        "apex_distance_m": v0 * cosine * rise / 9.8,
        "apex_height_m": height + rise**2 / (2 * 9.8),
        "apex_time_s": rise / 9.8,
    }
    assert found.pop("status") == "converged"
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(("drag", "height"), [("inf", "0"), ("40", "3")])
def test_straight_up_goes_nowhere(run, drag, height):
    found = results(run, "30", "90", "--v-lim", drag, "--height", height)
    assert found["range_m"] == found["apex_distance_m"] == 0
    assert found["impact_angle_deg"] == -90
    code, out, _ = run("trajectory", "30", "90", "--v-lim", drag, "--height", height)
    assert code == 0
    assert not table(out)["x"].any()


def test_k_and_v_lim_agree(run):
    assert results(run, "30", "50", "--k", "0.0109", "--g", "9.81") == pytest.approx(
        results(run, "30", "50", "--v-lim", math.sqrt(9.81 / 0.0109))
    )


def test_table(run):
    code, out, err = run("range", "100", "45", "--v-lim", "inf", "--g", "10", "--height", "0")
    assert (code, err) == (0, "")
    assert out.splitlines() == [
        "range          1000.00     m",
        "flight time      14.1421   s",
        "impact speed    100.000    m/s",
        "impact angle    -45.0000   deg",
        "apex distance   500.000    m",
        "apex height     250.000    m",
        "apex time         7.07107  s",
        "status         converged",
    ]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (-0.0, "0"),
        (1 / 3, "0.333333"),
        (-2e-3, "-0.00200000"),
        (123456.7, "123457"),
        (1234567.0, "1.23457e+06"),
        (1e-7, "1e-07"),
        (math.nan, "-"),
        (math.inf, "inf"),
    ],
)
def test_digits(value, text):
    assert cli_show.digits(value) == text


@pytest.mark.parametrize(
    "argv",
    [
        ("30", "-10", "--v-lim", "40", "--height", "50"),
        ("30", "-1e1", "--v-lim", "40", "--height", "5e1"),
        ("30", "-10.", "--v-lim=40", "--height=50"),
        ("--v-lim", "40", "--height", "50", "30", "-10"),
        ("--v-lim", "40", "--height", "50", "--", "30", "-10"),
    ],
)
def test_negative_angle(run, argv):
    assert results(run, *argv)["impact_angle_deg"] == pytest.approx(-56.3471, abs=1e-4)


@pytest.mark.parametrize("height", [["--height", "-5"], ["--height=-5"], ["--height", "-5e0"]])
def test_negative_height(run, height):
    found = results(run, "30", "60", "--v-lim", "inf", *height)
    up = 30 * math.sin(math.pi / 3)
    assert found["flight_time_s"] == pytest.approx((up + math.sqrt(up**2 - 2 * 9.81 * 5)) / 9.81)


# --- no result ----------------------------------------------------------------------------


def test_unreachable(run):
    code, out, err = run("range", *UNREACHABLE)
    assert code == 1
    assert one_line(err).startswith("the landing height is never reached: the apex is 81.")
    assert out.splitlines()[0].split() == ["range", "-", "m"]
    assert out.splitlines()[-1].split() == ["status", "unreachable"]


def test_unreachable_as_json(run):
    code, out, err = run("range", *UNREACHABLE, "--json")
    assert code == 1
    one_line(err)
    found = json.loads(out, parse_constant=pytest.fail)  # NaN is not JSON
    assert found["status"] == "unreachable"
    assert found["range_m"] is found["impact_angle_deg"] is None
    assert -100 < found["apex_height_m"] < 0


def test_unreachable_trajectory(refused, tmp_path):
    message = refused(1, "trajectory", *UNREACHABLE)
    assert "never reached: the apex is 81.1571 m below it" in message
    assert "--to-apex" in message
    target = tmp_path / "path.csv"
    assert "never reached" in refused(1, "trajectory", *UNREACHABLE, "--out", target)
    assert not target.exists()


def ascent(v0, degrees, v_lim, times, g=9.81):
    """x, y, speed and slope at the times, by Newton's law and DOP853."""

    def law(_, state):
        p, q = state[2:]
        drag = g * math.hypot(p, q) / v_lim**2
        return [p, q, -drag * p, -g - drag * q]

    alpha = math.radians(degrees)
    begin = [0.0, 0.0, v0 * math.cos(alpha), v0 * math.sin(alpha)]
    # Past the end, so that its last time is not the end of a step.
    span = (0.0, 1.01 * times[-1])
    path = solve_ivp(law, span, begin, "DOP853", times, rtol=1e-12, atol=1e-13)
    x, y, p, q = path.y
    return x, y, np.hypot(p, q), np.degrees(np.arctan2(q, p))


@pytest.mark.parametrize(
    ("v0", "degrees", "v_lim"),
    [(30, 45, 40), (300, 80, 40), (30, 5, "inf"), (5, 89.99, 100), (40, 1.75, 42)],
)
def test_path_to_the_apex(run, v0, degrees, v_lim):
    launch = [v0, degrees, "--v-lim", v_lim, "--height", "-5000", "-n", "20"]
    code, out, err = run("trajectory", *launch, "--to-apex")
    assert code == 1
    path = table(out)
    assert one_line(err) == (
        f"the landing height is never reached: the apex is {-path['y'][-1]:.6g} m below it"
    )
    x, y, speed, alpha = ascent(v0, degrees, float(v_lim), path["t"])
    np.testing.assert_allclose(path["x"], x, rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(path["y"] + 5000, y, rtol=0, atol=3e-12 * 5000)
    np.testing.assert_allclose(path["speed"], speed, rtol=1e-9)
    np.testing.assert_allclose(path["alpha_deg"], alpha, rtol=1e-9, atol=1e-7)
    assert path["alpha_deg"][-1] == 0
    chords = np.hypot(np.diff(path["x"]), np.diff(path["y"]))
    np.testing.assert_allclose(np.diff(path["s"]), path["s"][-1] / 19, rtol=1e-5)
    assert (chords <= np.diff(path["s"]) + 1e-11).all()
    assert chords.sum() > 0.99 * path["s"][-1]


def test_path_straight_up_to_the_apex(run):
    _, out, _ = run("trajectory", "30", "90", "--v-lim", "40", "--height=-500", "--to-apex")
    path = table(out)
    assert not path["x"].any()
    assert path["speed"][-1] == 0
    height = 40**2 / (2 * 9.81) * math.log1p((30 / 40) ** 2)
    assert path["y"][-1] + 500 == pytest.approx(height, rel=1e-12)
    assert path["s"][-1] == pytest.approx(height, rel=1e-12)
    assert path["t"][-1] == pytest.approx(40 / 9.81 * math.atan(30 / 40), rel=1e-13)
    fast = 40 * np.tan(math.atan(30 / 40) - 9.81 / 40 * path["t"])
    np.testing.assert_allclose(path["speed"][:-1], fast[:-1], rtol=1e-11)


def test_straight_down(run):
    launch = ("30", "-90", "--v-lim", "40", "--height", "10")
    code, out, err = run("range", *launch, "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    speed = math.sqrt(40**2 + (30**2 - 40**2) * math.exp(-2 * 9.81 * 10 / 40**2))
    assert found["impact_speed_m_per_s"] == pytest.approx(speed, rel=1e-14)
    assert (found["range_m"], found["impact_angle_deg"]) == (0, -90)
    path = table(run("trajectory", *launch)[1])
    assert not path["x"].any()
    assert (path["alpha_deg"] == -90).all()


def test_path_to_the_apex_of_a_launch_that_lands(run):
    code, out, err = run(*PATH, "--to-apex", "-n", "5")
    assert (code, err) == (0, "")
    apex = results(run, *LEVEL[1:])
    last = {name: column[-1] for name, column in table(out).items()}
    assert last["x"] == apex["apex_distance_m"]
    assert last["y"] == apex["apex_height_m"]
    assert last["t"] == apex["apex_time_s"]


@pytest.mark.parametrize("angle", ["0", "-5"])
def test_a_launch_that_is_its_own_apex(run, angle):
    launch = ("30", angle, "--v-lim", "40", "--height", "-3")
    code, out, err = run("trajectory", *launch, "--to-apex")
    assert code == 1
    assert one_line(err).endswith("the apex is 3 m below it")
    assert out.splitlines()[-1] == f"0.0,0.0,-3.0,30.0,{float(angle)},0.0"
    assert len(out.splitlines()) == 4


def test_path_to_the_apex_as_a_file(run, tmp_path):
    for name in ("path.csv", "path.svg"):
        target = tmp_path / name
        code, out, err = run("trajectory", *UNREACHABLE, "--to-apex", "--out", target)
        assert (code, out) == (1, "")
        wrote, wrong = err.splitlines(keepends=True)
        assert wrote == f"hodograph: wrote {target}\n"
        assert "81.1571 m below it" in one_line(wrong)
    _, printed, _ = run("trajectory", *UNREACHABLE, "--to-apex")
    assert (tmp_path / "path.csv").read_text() == printed


@pytest.mark.parametrize("name", ["range", "trajectory"])
def test_launch_beyond_the_domain(refused, name):
    assert "in [1e-30, 1e30]" in refused(2, name, "1e200", "45", "--v-lim", "inf")


# --- wrong usage --------------------------------------------------------------------------

DRAG = ["--v-lim", "40"]


@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["fly"], ["command", "'fly'", "range", "trajectory", "grid", "reproduce", "help"]),
        (["help", "fly"], ["command", "'fly'", "range"]),
        (["range", "30"], ["ANGLE"]),
        (["range", "30", "45"], ["--v-lim", "--k", "one of"]),
        (["range", "30", "45", *DRAG, "--k", "1"], ["--v-lim", "--k", "not allowed"]),
        (["range", "30", "45", *DRAG, "7"], ["7"]),
        (["range", "30", "45", *DRAG, "--spin", "7"], ["--spin"]),
        (["range", "30", "45", "--v", "7"], ["--v"]),  # no abbreviations
        (["range", "30", "45", *DRAG, "--height"], ["--height"]),
        (["range", "fast", "45", *DRAG], ["V0", "number", "'fast'"]),
        (["range", "", "45", *DRAG], ["V0", "number", "''"]),
        (["range", "30m", "45", *DRAG], ["V0", "number", "'30m'"]),
        (["range", "3+4j", "45", *DRAG], ["V0", "number"]),
        (["range", "nan", "45", *DRAG], ["V0", ">= 0", "'nan'"]),
        (["range", "inf", "45", *DRAG], ["V0", "finite", "'inf'"]),
        (["range", "-inf", "45", *DRAG], ["V0", "finite", "'-inf'"]),
        (["range", "1e400", "45", *DRAG], ["V0", "finite", "'1e400'"]),
        (["range", "-1", "45", *DRAG], ["V0", ">= 0", "'-1'"]),
        (["range", "-1e-300", "45", *DRAG], ["V0", ">= 0", "'-1e-300'"]),
        (["range", "30", "nan", *DRAG], ["ANGLE", "[-90, 90] degrees", "'nan'"]),
        (["range", "30", "-nan", *DRAG], ["ANGLE", "[-90, 90] degrees", "'-nan'"]),
        (["range", "30", "-90.5", *DRAG], ["ANGLE", "[-90, 90] degrees", "'-90.5'"]),
        (["range", "30", "90.00001", *DRAG], ["ANGLE", "[-90, 90] degrees"]),
        (["range", "30", "inf", *DRAG], ["ANGLE", "[-90, 90] degrees"]),
        (["range", "30", "45", "--v-lim", "0"], ["--v-lim", "> 0", "inf", "'0'"]),
        (["range", "30", "45", "--v-lim", "-40"], ["--v-lim", "> 0", "'-40'"]),
        (["range", "30", "45", "--v-lim", "nan"], ["--v-lim", "> 0", "'nan'"]),
        (["range", "30", "45", "--v-lim", "-inf"], ["--v-lim", "> 0", "'-inf'"]),
        (["range", "30", "45", "--v-lim", "1e999"], ["--v-lim", "'1e999'"]),  # not vacuum
        (["range", "30", "45", "--k", "-1e-3"], ["--k", ">= 0", "'-1e-3'"]),
        (["range", "30", "45", "--k", "inf"], ["--k", "finite", "'inf'"]),
        (["range", "30", "45", "--k", "nan"], ["--k", "finite", "'nan'"]),
        (["range", "30", "45", *DRAG, "--g", "0"], ["--g", "> 0", "'0'"]),
        (["range", "30", "45", *DRAG, "--g", "-9.81"], ["--g", "> 0", "'-9.81'"]),
        (["range", "30", "45", *DRAG, "--g", "inf"], ["--g", "finite", "'inf'"]),
        (["range", "30", "45", *DRAG, "--g", "nan"], ["--g", "> 0", "'nan'"]),
        (["range", "30", "45", *DRAG, "--height", "-inf"], ["--height", "finite", "'-inf'"]),
        (["range", "30", "45", *DRAG, "--height", "nan"], ["--height", "finite", "'nan'"]),
        (["range", "1e25", "45", "--v-lim", "1e-20"], ["v0 / v_lim"]),
        ([*PATH, "-n", "1"], ["-n", "2", "got 1"]),
        ([*PATH, "-n", "-3"], ["-n", "2", "got -3"]),
        ([*PATH, "-n", "1000001"], ["-n", "1000000"]),
        ([*PATH, "-n", "2.5"], ["-n", "integer", "'2.5'"]),
        ([*PATH, "-n", "many"], ["-n", "integer", "'many'"]),
        ([*PATH, "--json", "--out", "path.csv"], ["--json", "--out"]),
        ([*PATH, "--out", "path.txt"], ["--out", ".csv", ".pdf", ".png", ".svg", "'path.txt'"]),
        ([*PATH, "--out", "path"], ["--out", ".csv", "'path'"]),
        (["grid", "--out"], ["--out"]),
        (["reproduce", "results"], ["results"]),
    ],
)
def test_wrong_usage(refused, argv, words):
    message = refused(2, *argv)
    assert [word for word in words if word not in message] == []


@pytest.mark.parametrize(
    ("argv", "meant"),
    [
        (["rnage", "30", "45", *DRAG], "range"),
        (["Range", "30", "45", *DRAG], "range"),
        (["traj", "30", "45", *DRAG], "trajectory"),
        (["reproduction"], "reproduce"),
        (["hlep"], "help"),
        (["help", "excercise"], "exercise"),
        (["bench", "sped"], "speed"),
        (["--verison"], "--version"),
        (["range", "30", "45", "--vlim", "40"], "--v-lim"),
        (["range", "30", "45", "--v_lim=40"], "--v-lim"),
        (["range", "30", "45", "--v", "40"], "--v-lim"),
        (["range", "--hieght", "2", "30", "45", *DRAG], "--height"),
        (["range", "30", "45", *DRAG, "-json"], "--json"),
        ([*PATH, "--to-appex"], "--to-apex"),
        (["bench", "calls", "--quik"], "--quick"),
    ],
)
def test_a_slip_gets_its_nearest_neighbour(refused, argv, meant):
    message = refused(2, *argv)
    assert message.startswith("unknown ")
    assert message.endswith(f"; did you mean '{meant}'?")


@pytest.mark.parametrize("angle", ["0.785", "1.5708", "-0.2"])
@pytest.mark.parametrize("name", ["range", "trajectory"])
def test_what_may_be_radians_gets_a_hint(run, name, angle):
    code, out, err = run(name, "40", angle, *DRAG, "--height", "1")
    assert code == 0
    assert out
    assert err.startswith("hodograph: hint: angles are in degrees; ")
    assert f"{math.degrees(float(angle)):.6g}" in err
    assert err.count("\n") == 1


@pytest.mark.parametrize("angle", ["0", "1", "-1", "1.0", "1.6", "2.5", "45"])
def test_what_are_degrees_gets_none(run, angle):
    assert run("range", "40", angle, *DRAG, "--height", "1")[2] == ""


# --- trajectory ---------------------------------------------------------------------------


def test_trajectory_csv(run):
    code, out, err = run(*PATH, "-n", "33", "--height", "2")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert f"hodograph {hodograph.__version__}" in lines[0]
    for given in ("v0 = 30 m/s", "angle = 45 deg", "v_lim = 40 m/s", "height = 2 m", "m/s^2"):
        assert given in lines[0]
    assert lines[1].startswith("# units: t s, x m, y m")
    assert lines[2] == "t,x,y,speed,alpha_deg,s"
    assert len(lines) == 3 + 33
    path = table(out)
    assert {name: column[0] for name, column in path.items()} == {
        "t": 0,
        "x": 0,
        "y": 2,
        "speed": 30,
        "alpha_deg": 45,
        "s": 0,
    }
    landing = hodograph.Launch(30.0, np.pi / 4, 40.0, height=2.0).landing()
    last = {name: column[-1] for name, column in path.items()}
    assert last == pytest.approx(
        {
            "t": landing.t,
            "x": landing.x,
            "y": 0,
            "speed": landing.speed,
            "alpha_deg": math.degrees(landing.alpha),
            "s": landing.arc_length,
        },
        rel=1e-14,
    )


def test_trajectory_csv_holds_every_digit(run):
    _, out, _ = run(*PATH)
    path = hodograph.Launch(30.0, math.radians(45), 40.0).trajectory()
    read = table(out)
    for name in ("t", "x", "y", "speed", "s"):
        np.testing.assert_array_equal(read[name], getattr(path, name))


def test_trajectory_of_k_says_k(run):
    _, out, _ = run("trajectory", "30", "45", "--k", "0.01", "-n", "2")
    assert "k = 0.01 /m" in out.splitlines()[0]


def test_trajectory_csv_file_is_what_is_printed(run, tmp_path):
    target = tmp_path / "made" / "path.CSV"
    code, out, err = run(*PATH, "--out", target)
    assert (code, out, err) == (0, "", f"hodograph: wrote {target}\n")
    _, printed, _ = run(*PATH)
    assert target.read_text() == printed


@pytest.mark.parametrize(
    ("suffix", "head", "tail"),
    [
        ("png", b"\x89PNG", b"IEND\xaeB`\x82"),
        ("PDF", b"%PDF", b"%%EOF\n"),
        ("svg", b"<?xml", b"</svg>\n"),
    ],
)
def test_trajectory_plot(run, tmp_path, suffix, head, tail):
    for name in ("a", "b"):
        target = tmp_path / f"{name}.{suffix}"
        code, out, err = run(*PATH, "--out", target)
        assert (code, out, err) == (0, "", f"hodograph: wrote {target}\n")
    content = target.read_bytes()
    assert content.startswith(head)
    assert content.endswith(tail)
    assert content == (tmp_path / f"a.{suffix}").read_bytes()  # no date, no random names


def test_plot_leaves_matplotlib_as_it_was(run, tmp_path):
    import matplotlib

    before = matplotlib.rcParams.copy()
    assert run(*PATH, "--out", tmp_path / "path.svg")[0] == 0
    assert matplotlib.rcParams == before


@pytest.mark.parametrize("launch", [("0", "45"), ("30", "90"), ("1e-30", "45"), ("1e30", "45")])
def test_plot_of_any_scale(run, tmp_path, launch):
    code, _, err = run("trajectory", *launch, "--v-lim", "inf", "--out", tmp_path / "path.png")
    assert (code, err.count("\n")) == (0, 1)


# --- files --------------------------------------------------------------------------------


@pytest.fixture
def fake_report(monkeypatch):
    """A `hodograph.paper.report` that writes two files."""

    def reproduce(out, *, force=False):
        targets = [Path(out) / name for name in ("figure_1.png", "verdicts.json")]
        files.check_targets(*targets, force=force)
        logging.getLogger("hodograph").info("figure 1 of 1")
        for target in targets:
            files.write_whole(target, "whole", force=force)
        return ["a verdict"]

    module = types.ModuleType("hodograph.paper.report")
    module.reproduce = reproduce
    module.verdict_table = lambda verdicts: f"claim α: {', '.join(verdicts)}"
    monkeypatch.setitem(sys.modules, "hodograph.paper.report", module)
    return module


@pytest.fixture
def fake_measures(monkeypatch):
    """Benches that measure nothing, and two reference points in place of all."""
    from matplotlib.figure import Figure

    from hodograph.bench import measurement, speed, stability, targets
    from hodograph.builders import reference_points as points

    twice = [points.Inputs(1.0, 0.5, 0.0), points.Inputs(1.0, 0.5, 0.1)]
    monkeypatch.setattr(points, "inputs", lambda: iter(twice))
    monkeypatch.setattr(points, "TABLES", points.TABLES[:1])
    errors = {method.name: np.full((2, 2), 1e-9) for method in stability.METHODS}
    maps = stability.Maps(np.array([0.1, 1.0]), np.array([30.0, 60.0]), np.ones((2, 2)), errors)
    monkeypatch.setattr(stability, "measure", lambda *_, **__: maps)
    monkeypatch.setattr(stability, "figure", lambda maps: Figure())
    row = measurement.Measurement(
        "a set", speed.ENGINE, "", 1.5, 1e-9, 1e-9, 0.0, 10, True, rounds={0: 1.5}
    )
    found = speed.Speed([row], [targets.at_most("a bound", 2, 1.5)], "one core")
    monkeypatch.setattr(speed, "measure", lambda **_: found)


WRITERS = [
    ([*PATH, "--out", "{}/path.csv"], ["path.csv"]),
    ([*PATH, "--out", "{}/path.svg"], ["path.svg"]),
    (["grid", "--out", "{}"], ["d_norm.npz", "d_norm.csv"]),
    (["reproduce", "--out", "{}"], ["figure_1.png", "verdicts.json"]),
    (["reference", "--out", "{}"], ["reference.csv"]),
    (["bench", "speed", "--out", "{}"], ["speed.csv"]),
    (
        ["bench", "stability", "--out", "{}"],
        ["stability.png", "stability.pdf", "stability.csv"],
    ),
]


@pytest.fixture(params=WRITERS, ids=lambda writer: writer[1][0])
def writer(request, fake_report, fake_measures):
    """(command that writes into a folder, the files that it writes)."""
    argv, names = request.param
    return lambda folder: [word.format(folder) for word in argv], names


def test_existing_file_is_kept(run, writer, tmp_path):
    argv, names = writer
    for name in names:  # each of them alone, too
        (tmp_path / name).write_text("mine")
        code, out, err = run(*argv(tmp_path))
        assert (code, out) == (1, "")
        message = one_line(err.splitlines(keepends=True)[-1])  # progress may come before
        assert name in message
        assert "--force" in message
        assert [path.name for path in tmp_path.iterdir()] == [name]
        assert (tmp_path / name).read_text() == "mine"
        (tmp_path / name).unlink()


def test_force_replaces(run, writer, tmp_path):
    argv, names = writer
    assert run(*argv(tmp_path))[0] == 0
    before = {name: (tmp_path / name).read_bytes() for name in names}
    for name in names:
        (tmp_path / name).write_text("mine")
    assert run(*argv(tmp_path), "--force")[0] == 0
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_folder_below_a_file(refused, writer, tmp_path):
    argv, _ = writer
    (tmp_path / "file").write_text("mine")
    for folder in ("file", "file/deeper"):
        message = refused(1, *argv(tmp_path / folder))
        assert str(tmp_path / "file") in message
        assert "Not a directory" in message
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs /proc")
def test_folder_that_cannot_be_made(run, writer):
    argv, _ = writer
    code, out, err = run(*argv("/proc/none/here"))
    assert (code, out) == (1, "")
    assert "/proc/none" in one_line(err.splitlines(keepends=True)[-1])


def refuse_to_write(*_, **__):
    raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


def test_folder_without_permission(refused, writer, tmp_path, monkeypatch):
    argv, _ = writer
    monkeypatch.setattr(files.tempfile, "TemporaryFile", refuse_to_write)  # for root, too
    message = refused(1, *argv(tmp_path / "new"))
    assert str(tmp_path) in message
    assert "Permission denied" in message
    assert list(tmp_path.iterdir()) == []


def test_folder_in_place_of_the_file(refused, tmp_path):
    target = tmp_path / "path.csv"
    target.mkdir()
    assert f"{target}: Is a directory" in refused(1, *PATH, "--out", target, "--force")


def test_a_name_too_long(refused, tmp_path):
    assert "name too long" in refused(1, *PATH, "--out", tmp_path / f"{'x' * 300}.csv")


def test_a_failed_write_names_the_file(tmp_path, monkeypatch):
    """And not the temporary one, of which nobody has heard."""

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "a temporary name")

    monkeypatch.setattr(files.os, "replace", full)
    with pytest.raises(OSError, match=r"No space left.*path\.csv") as caught:
        files.write_whole(tmp_path / "path.csv", "new")
    assert caught.value.errno == errno.ENOSPC
    assert list(tmp_path.iterdir()) == []


def test_a_line_break_in_a_name(refused, tmp_path):
    target = tmp_path / "two\nlines.csv"
    target.write_text("mine")
    assert "two lines.csv" in refused(1, *PATH, "--out", target)


def test_grid(run, tmp_path):
    code, out, err = run("grid", "--out", tmp_path)
    assert (code, out) == (0, "")
    assert err.splitlines() == [
        f"hodograph: wrote {tmp_path / name}" for name in ("d_norm.npz", "d_norm.csv")
    ]
    made = grid.load(tmp_path / "d_norm.npz")
    np.testing.assert_allclose(made.d_norm, grid.tabulate().d_norm, rtol=0, atol=1e-13)
    lines = (tmp_path / "d_norm.csv").read_text().splitlines()
    assert len([line for line in lines if not line.startswith("#")]) == 1 + 151 * 91


def test_grid_is_remade_by_the_command_that_it_names(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    program, *argv = grid.COMMAND.split()
    assert program == "hodograph"
    copies = []
    for _ in range(2):
        assert run(*argv)[0] == 0
        copies.append({path.name: path.read_bytes() for path in (tmp_path / "data").iterdir()})
    assert copies[0] == copies[1]
    assert grid.COMMAND.encode() in copies[0]["d_norm.csv"]


def test_grid_goes_to_the_working_folder(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run("grid")[0] == 0
    assert {path.name for path in tmp_path.iterdir()} == {"d_norm.npz", "d_norm.csv"}


def test_reference_is_remade_by_the_command_that_it_names(
    run, fake_measures, tmp_path, monkeypatch
):
    from hodograph.builders import reference_points as points

    monkeypatch.chdir(tmp_path)
    program, *argv = points.COMMAND.split()
    assert program == "hodograph"
    assert run(*argv)[0] == 0
    target = Path("data", "reference.csv")
    assert points.COMMAND in target.read_text()
    assert list(points.load(target)["height"]) == [0.0, 0.1]
    first = target.read_bytes()
    code, out, err = run(*argv)
    assert (code, out, target.read_bytes()) == (0, "", first)
    done = "hodograph: reference.csv: point 2 of 2"
    assert err.splitlines() == [done, f"hodograph: wrote {target}"]


def test_progress_is_what_the_library_logs(run, fake_measures, monkeypatch):
    from hodograph.bench import speed

    measure, log = speed.measure, logging.getLogger("hodograph")
    before = log.level, log.propagate, list(log.handlers)

    def told(**options):
        log.info("round %d\nof 2", 1)
        log.debug("a detail")
        return measure(**options)

    monkeypatch.setattr(speed, "measure", told)
    for _ in range(2):  # said once, the second time too
        assert run("bench", "speed")[2] == "hodograph: round 1 of 2\n"
    assert (log.level, log.propagate, list(log.handlers)) == before


def test_bench_wants_to_know_what(refused):
    assert "WHAT" in refused(2, "bench")
    assert "'memory'" in refused(2, "bench", "memory")


def test_bench_prints_its_table(run, fake_measures, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run("bench", "speed")
    assert (code, err) == (0, "")
    assert "a set" in out
    assert "met" in out
    code, out, err = run("bench", "stability")
    assert (code, out.splitlines()[0][:14]) == (0, "Relative error")
    assert err.count("wrote") == 3
    assert {path.suffix for path in tmp_path.iterdir()} == {".png", ".pdf", ".csv"}


def test_reproduce(run, fake_report, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run("reproduce")
    assert (code, out) == (0, "claim α: a verdict\n")
    assert err == "hodograph: figure 1 of 1\n"
    made = {path.name for path in (tmp_path / "reproduction").iterdir()}
    assert made == {"figure_1.png", "verdicts.json"}


def test_reproduce_a_second_time(run, fake_report, tmp_path):
    assert run("reproduce", "--out", tmp_path)[0] == 0
    code, out, err = run("reproduce", "--out", tmp_path)
    assert (code, out) == (1, "")
    assert "--force" in one_line(err.splitlines(keepends=True)[-1])
    assert run("reproduce", "--out", tmp_path, "--force")[0] == 0


@pytest.mark.slow
def test_reproduce_for_real(tmp_path):
    begun = time.monotonic()
    first = command("reproduce", cwd=tmp_path)
    assert first.returncode == 0
    assert time.monotonic() - begun < 60
    folder = tmp_path / "reproduction"
    verdicts = json.loads((folder / "verdicts.json").read_text())
    keys = {"id", "place", "claim", "paper", "measured", "domain", "holds"}
    assert all(set(verdict) == keys for verdict in verdicts)
    claims = sum(verdict["holds"] is not None for verdict in verdicts)
    assert f"{claims} claims" in first.stdout
    expected = {f"figure_{n}.{form}" for n in range(1, 7) for form in ("png", "pdf")}
    expected |= {"table_1.csv", "verdicts.json", "report.html"}
    expected |= {"figure_didion.png", "figure_didion.pdf"}
    assert {path.name for path in folder.iterdir()} == expected
    assert first.stderr.startswith("hodograph: ")
    assert "warning" not in first.stderr

    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    second = command("reproduce", cwd=tmp_path)
    assert (second.returncode, second.stdout) == (1, "")
    assert "--force" in one_line(second.stderr.splitlines(keepends=True)[-1])
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


# --- interruption -------------------------------------------------------------------------


def started(*argv, on_interrupt=signal.default_int_handler, **options):
    """Python with these arguments; what it makes of Ctrl-C is handed down to it, as by a shell."""
    before = signal.signal(signal.SIGINT, on_interrupt)
    try:
        return subprocess.Popen(
            [sys.executable, *argv],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **options,
        )
    finally:
        signal.signal(signal.SIGINT, before)


def interrupted(line_awaited, *argv):
    """Ctrl-C once a line on stderr holds the text: (exit code, stdout, later stderr)."""
    with started(*argv) as process:
        try:
            for line in process.stderr:
                if line_awaited in line:
                    break
            else:
                pytest.fail(f"ended before it said {line_awaited!r}")
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=60)
        finally:
            process.kill()
    return process.returncode, out, err


def struck(seconds, folder, *argv):
    """Ctrl-C after so many seconds, by the clock: (exit code, stdout, stderr)."""
    with started("-c", CONSOLE, *argv, cwd=folder) as process:
        try:
            assert process.stdout.readline() == "begun\n"
            time.sleep(seconds)
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=60)
        finally:
            process.kill()
    return process.returncode, out, err


# What the console script that pip makes does; it says when the first line of ours is next.
CONSOLE = """
import os, re, sys
from hodograph.__main__ import main
os.write(1, b"begun\\n")
sys.exit(main())
"""


@pytest.mark.skipif(os.name != "posix", reason="signals are sent the POSIX way")
@pytest.mark.parametrize(
    ("argv", "latest", "trials"),
    [
        ("range 40 45 --v-lim 40", 0.1, 12),
        ("trajectory 40 45 --v-lim 40 --out path.svg", 0.6, 10),
        ("exercise", 1.5, 6),
        pytest.param("range 40 45 --v-lim 40", 0.12, 150, marks=pytest.mark.slow),
        pytest.param("trajectory 40 45 --v-lim 40 --out path.svg", 1.0, 80, marks=pytest.mark.slow),
        pytest.param("trajectory 40 45 --v-lim 40 -n 99999", 0.7, 60, marks=pytest.mark.slow),
        pytest.param("grid", 0.4, 60, marks=pytest.mark.slow),
        pytest.param("exercise", 3.0, 60, marks=pytest.mark.slow),
        pytest.param("reproduce", 10.0, 20, marks=pytest.mark.slow),
    ],
)
def test_interrupted_at_any_moment(tmp_path, argv, latest, trials):
    """From the imports on, and within the functions that SciPy's compiled code calls."""
    seed = random.SystemRandom().randrange(2**32)
    moments = random.Random(seed)
    for trial in range(trials):
        moment = moments.uniform(0.0, latest)
        folder = tmp_path / str(trial)
        folder.mkdir()
        code, _, err = struck(moment, folder, *argv.split())
        where = f"seed {seed}, trial {trial}, after {moment:.4f} s: {code}, {err!r}"
        lines = err.splitlines()
        if "Traceback" in err and "hodograph" not in err:  # too early: not a line of ours has run
            continue
        if code == 0:  # too late
            assert "interrupted" not in err, where
        else:
            assert code == 130, where
            assert lines[-1] == "hodograph: interrupted", where
            assert not [line for line in lines if not line.startswith("hodograph: ")], where
            assert "error" not in err, where
        files = [path for path in folder.rglob("*") if path.is_file()]
        assert not [path for path in files if path.name.startswith(".")], where


def test_what_scipy_makes_of_an_interruption_is_undone(monkeypatch):
    """As its compiled code does: an error from an error from what was raised in the callback."""

    def misled(*_):
        try:
            try:
                raise KeyboardInterrupt
            except KeyboardInterrupt as struck:
                raise SystemError("returned a result with an exception set") from struck
        except SystemError as error:
            raise ValueError("Function to integrate must not return a tuple.") from error

    monkeypatch.setattr("scipy.integrate.ode.integrate", misled)
    with pytest.raises(KeyboardInterrupt):
        hodograph.steppers.integrate(70.0, 0.7, 981.0, method="dopri5", dt=0.1)


SWALLOWED = """
import gc, os, sys, time
from hodograph.cli.interruption import interruptibly

class Deaf:
    def __del__(self):  # what is raised here is lost
        os.write(1, b"deaf\\n")
        end = time.monotonic() + 0.5
        while time.monotonic() < end:
            pass

def work():
    Deaf()
    while True:
        try:
            sum(range(1000))
        except KeyboardInterrupt:
            raise ValueError("something else")

sys.exit(interruptibly(work))
"""


@pytest.mark.skipif(os.name != "posix", reason="signals are sent the POSIX way")
def test_an_interruption_that_is_swallowed_comes_again():
    with started("-c", SWALLOWED) as process:
        try:
            assert process.stdout.readline() == "deaf\n"
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=20)
        finally:
            process.kill()
    assert (process.returncode, err) == (130, "hodograph: interrupted\n")


@pytest.mark.skipif(os.name != "posix", reason="signals are sent the POSIX way")
def test_what_runs_in_the_background_is_not_interrupted():
    """A shell tells it to ignore Ctrl-C, and it does."""
    with started("-c", CONSOLE, *LEVEL, on_interrupt=signal.SIG_IGN) as process:
        assert process.stdout.readline() == "begun\n"
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=20)
    assert (process.returncode, err) == (0, "")
    assert out.startswith("range ")


def whole(path):
    """Whether a file that `reproduce` writes has its end."""
    content = path.read_bytes()
    match path.suffix:
        case ".png":
            return content.endswith(b"IEND\xaeB`\x82")
        case ".pdf":
            return content.rstrip().endswith(b"%%EOF")
        case ".html":
            return content.rstrip().endswith(b"</html>")
        case ".json":
            return bool(json.loads(content))
        case ".csv":
            return content.endswith(b"\n")
    return False


SLOW_WRITER = """
import itertools, logging, sys, types
from hodograph.cli import commands as cli
from hodograph import _files as files

def reproduce(out, *, force=False):
    for n in itertools.count():
        files.write_whole(out / f"{n % 3}.csv", "0123456789\\n" * 100_000, force=True)
        logging.getLogger("hodograph").info(f"file {n}")

module = types.ModuleType("hodograph.paper.report")
module.reproduce, module.verdict_table = reproduce, str
sys.modules["hodograph.paper.report"] = module
sys.exit(cli.main(["reproduce", "--out", sys.argv[1]]))
"""


@pytest.mark.skipif(os.name != "posix", reason="signals are sent the POSIX way")
@pytest.mark.parametrize("after", [1, 4])
def test_interrupted_while_it_writes(tmp_path, after):
    code, out, err = interrupted(f"file {after}", "-c", SLOW_WRITER, str(tmp_path))
    assert (code, out) == (130, "")
    assert err.splitlines()[-1] == "hodograph: interrupted"
    assert "Traceback" not in err
    assert {path.stat().st_size for path in tmp_path.iterdir()} == {1_100_000}
    assert {path.name for path in tmp_path.iterdir()} <= {"0.csv", "1.csv", "2.csv"}


def test_a_line_of_diagnostics_is_one_write(monkeypatch):
    """An interruption between two writes would run two lines together."""

    class Recorder(io.StringIO):
        def write(self, text):
            writes.append(text)
            return super().write(text)

    writes = []
    monkeypatch.setattr(sys, "stderr", Recorder())
    assert cli.main(["range", "100"]) == 2
    assert len(writes) == 1
    assert writes[0].startswith("hodograph: error: ")
    assert writes[0].endswith("\n")


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals are sent the POSIX way")
@pytest.mark.parametrize("moment", ["", "figure 3", "claims", "writing"])
def test_reproduce_interrupted_for_real(tmp_path, moment):
    folder = tmp_path / "new"
    code, out, err = interrupted(moment, "-m", "hodograph", "reproduce", "--out", str(folder))
    if code:  # it may come too late to interrupt the writing
        assert (code, out) == (130, "")
        assert err.splitlines()[-1] == "hodograph: interrupted"
    else:
        assert moment == "writing"
    assert "Traceback" not in err
    if moment != "writing":
        assert not folder.exists() or list(folder.iterdir()) == []
    assert [path.name for path in tmp_path.rglob("*") if path.is_file() and not whole(path)] == []


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # a file unclosed
def test_interrupted_at_any_line_of_a_write(tmp_path):
    """Ctrl-C can strike between any two lines: what is there is old or new, and alone."""
    target = tmp_path / "file"
    code = files.write_whole.__code__
    for strike in range(100):
        target.write_text("old")
        lines = 0

        def trace(frame, event, _, strike=strike):
            nonlocal lines
            if frame.f_code is not code:
                return None
            if event == "line":
                lines += 1
                if lines == strike + 1:
                    raise KeyboardInterrupt
            return trace

        before = sys.gettrace()
        sys.settrace(trace)
        try:
            files.write_whole(target, "new", force=True)
            interrupted = False
        except KeyboardInterrupt:
            interrupted = True
        finally:
            sys.settrace(before)
        assert [path.name for path in tmp_path.iterdir()] == ["file"], strike
        assert target.read_text() in ("old", "new")
        if not interrupted:
            break
    else:
        pytest.fail("never came to an end")


@pytest.mark.parametrize(("name", "method"), [("range", "landing"), ("trajectory", "trajectory")])
def test_interrupted_within(run, monkeypatch, name, method):
    def strike(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(hodograph.Launch, method, strike)
    assert run(name, "30", "45", "--v-lim", "40") == (130, "", "hodograph: interrupted\n")


# --- the streams --------------------------------------------------------------------------


def test_version(run):
    assert run("--version") == (0, f"hodograph {hodograph.__version__}\n", "")


COMMANDS = [
    *([command.name] for command in cli._COMMANDS if command.name != "help"),
    *(["bench", bench.name] for bench in cli._BENCHES),
]


@pytest.mark.parametrize("argv", [[], *COMMANDS], ids=" ".join)
def test_help(run, argv):
    code, out, err = run(*argv, "--help")
    assert (code, err) == (0, "")
    assert out.startswith("usage: hodograph")
    assert run("help", *argv) == (0, out, "")
    assert max(map(len, out.splitlines())) < 100
    if not argv:
        assert run() == (0, out, "")
        assert all(command in out for command, *_ in COMMANDS)


def example(run, argv):
    """The command with which its help ends, split as a shell would."""
    head, line = run(*argv, "--help")[1].splitlines()[-2:]
    assert head == "example:"
    program, *words = shlex.split(line)
    assert program == "hodograph"
    return words


@pytest.mark.parametrize("argv", COMMANDS, ids=" ".join)
def test_examples_are_understood(run, argv):
    words = example(run, argv)
    assert words[: len(argv)] == argv
    assert cli_arguments.parse(cli._parser(), words).command is not None


@pytest.mark.parametrize(
    ("argv", "made"),
    [
        ([], []),
        (["range"], []),
        (["trajectory"], ["path.svg"]),
        (["grid"], ["tables/d_norm.csv", "tables/d_norm.npz"]),
        (["help"], []),
        pytest.param(["exercise"], ["exercise/report.html"], marks=pytest.mark.slow),
        pytest.param(["fit"], ["laws/formulas.csv"], marks=pytest.mark.slow),
        pytest.param(["reference"], ["tables/reference.csv"], marks=pytest.mark.slow),
        pytest.param(["bench", "speed"], [], marks=pytest.mark.slow),
    ],
    ids=lambda value: " ".join(value),
)
def test_examples_do_what_they_say(run, argv, made, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(*(["help", "range"] if argv == ["help"] else example(run, argv)))
    assert code == 0
    assert "error: " not in err
    assert bool(out) == (not made or argv in (["exercise"], ["fit"]))
    found = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.*")}
    assert set(made) <= found


def test_module_as_a_command(run):
    found = command(*LEVEL, "--json")
    assert (found.returncode, found.stdout, found.stderr) == run(*LEVEL, "--json")
    wrong = command("range", "30")
    assert (wrong.returncode, wrong.stdout) == (2, "")
    one_line(wrong.stderr)


@pytest.mark.skipif(os.name != "posix", reason="pipes close the POSIX way")
def test_a_reader_that_leaves(tmp_path):
    with subprocess.Popen(
        [sys.executable, "-m", "hodograph", *PATH, "-n", "100000"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout.readline().startswith("# hodograph")
        process.stdout.close()
        assert process.stderr.read() == ""
    assert process.returncode == 0


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk():
    with open("/dev/full", "w") as full:
        found = subprocess.run(
            [sys.executable, "-m", "hodograph", *LEVEL],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
        )
    assert found.returncode == 1
    assert "No space left" in one_line(found.stderr)


def test_no_standard_output(run, monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdout", None)
    assert cli.main(LEVEL) == 1
    monkeypatch.undo()
    assert one_line(capsys.readouterr().err) == "standard output is closed"


def test_no_standard_error(monkeypatch, capsys):
    monkeypatch.setattr(sys, "stderr", None)
    assert cli.main(["range"]) == 2
    monkeypatch.undo()
    assert capsys.readouterr() == ("", "")


def test_an_encoding_without_greek(fake_report, tmp_path, monkeypatch):
    stdout = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stdout", stdout)
    assert cli.main(["reproduce", "--out", str(tmp_path)]) == 0
    assert stdout.buffer.getvalue() == b"claim ?: a verdict\n"


def test_a_defect_is_one_line(refused, monkeypatch):
    def broken(*_):
        raise ZeroDivisionError("of\ntwo lines")

    monkeypatch.setattr(hodograph.Launch, "landing", broken)
    assert refused(1, *LEVEL) == "unexpected ZeroDivisionError: of two lines"


def test_memory_that_runs_out(refused, monkeypatch):
    def greedy(*_):
        raise MemoryError

    monkeypatch.setattr(hodograph.Launch, "landing", greedy)
    assert refused(1, *LEVEL) == "not enough memory"


def test_a_warning_is_one_line(run, monkeypatch):
    def careless(self, landing=hodograph.Launch.landing):
        warnings.warn("take care", RuntimeWarning, stacklevel=2)
        return landing(self)

    monkeypatch.setattr(hodograph.Launch, "landing", careless)
    show = warnings.showwarning
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        code, _, err = run(*LEVEL)
        assert warnings.showwarning is not cli_streams.show_warning
    assert (code, err) == (0, "hodograph: warning: take care\n")
    assert warnings.showwarning is show


def test_not_converged(run, monkeypatch):
    import dataclasses

    def stuck(self, landing=hodograph.Launch.landing):
        return dataclasses.replace(landing(self), status=np.int8(2), x=np.nan)

    monkeypatch.setattr(hodograph.Launch, "landing", stuck)
    code, out, err = run(*LEVEL)
    assert (code, one_line(err)) == (1, "the landing could not be computed")
    assert out.splitlines()[-1].split(maxsplit=1) == ["status", "not converged"]


def test_heavy_modules_stay_out(tmp_path):
    """A range does not wait for the plots, the arbitrary precision or the paper."""
    script = (
        "import sys; from hodograph.cli.commands import main\n"
        "codes = [main(command.split()) for command in sys.argv[1:]]\n"
        "heavy = {'scipy', 'matplotlib', 'mpmath', 'hodograph.paper', 'hodograph.report.pages'}\n"
        "print(codes, sorted(heavy & set(sys.modules)))\n"
    )
    commands = [LEVEL, [*PATH, "-n", "2"], ["--version"], ["grid", "--out", str(tmp_path)]]
    found = subprocess.run(
        [sys.executable, "-c", script, *map(" ".join, commands)],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert found.stdout.splitlines()[-1] == "[0, 0, 0, 0] []"
