"""The inverse questions on the command line."""

import json
import math

import pytest

from hodograph import ode


def found(run, *argv):
    code, out, err = run(*argv, "--json")
    assert (code, err) == (0, "")
    return json.loads(out)


def test_best_without_drag(run):
    """A shot of 14 m/s from 2 m: tan(alpha) = v0 / sqrt(v0^2 + 2 g h)."""
    best = found(run, "best", "14", "--v-lim", "inf", "--height", "2")
    assert best["status"] == "converged"
    assert best["launch_angle_deg"] == pytest.approx(
        math.degrees(math.atan(14 / math.sqrt(14**2 + 4 * 9.81))), rel=1e-12
    )
    assert best["range_m"] == pytest.approx(14 / 9.81 * math.sqrt(14**2 + 4 * 9.81), rel=1e-12)


@pytest.mark.parametrize(
    ("below", "expected"), [(50, 269.451), (100, 286.965), (200, 310.601), (500, 337.36)]
)
def test_published_greatest_range(run, below, expected):
    best = found(run, "best", "100", "--k", "0.0057", "--height", below)
    assert best["range_m"] == pytest.approx(expected, abs=6e-4)


def test_best_as_a_table(run):
    code, out, err = run("best", "14m/s", "--v-lim", "inf")
    assert (code, err) == (0, "")
    assert out.splitlines() == [
        "launch angle  45.0000   deg",
        "range         19.9796   m",
        "flight time    2.01825  s",
        "status        converged",
    ]


def test_best_out_of_reach(run):
    code, out, err = run("best", "10", "--body", "golf", "--height", "-20")
    assert code == 1
    assert err == "hodograph: error: the landing height is never reached at any angle\n"
    assert out.splitlines()[-1].split() == ["status", "unreachable"]


def test_best_at_rest(refused):
    assert "v0 must be in [1e-30, 1e30] m/s" in refused(2, "best", "0", "--v-lim", "40")


def test_best_on_a_slope_in_a_wind(run):
    """No other angle goes further."""
    scene = ["--v-lim", "40", "--slope", "-15", "--wind", "-7", "--height", "3"]
    best = found(run, "best", "30", *scene)
    assert best.pop("status") == "converged"

    def reach(angle):
        return ode.solve(
            30.0, math.radians(angle), 40.0, slope=math.radians(-15), wind=-7.0, height=3.0,
            rtol=1e-12,
        )  # fmt: skip

    there = reach(best["launch_angle_deg"])
    assert best["range_m"] == pytest.approx(there.x, rel=1e-10)
    assert best["flight_time_s"] == pytest.approx(there.t, rel=1e-10)
    for aside in (-0.1, 0.1):
        assert reach(best["launch_angle_deg"] + aside).x < there.x


def test_best_is_forward(run):
    """Up a slope in a strong wind, where a slow launch would go farthest against the wind."""
    best = found(run, "best", "1m/s", "--v-lim", "40", "--wind", "200", "--slope", "20")
    assert best["launch_angle_deg"] == pytest.approx(90.0)

    def reach(angle):
        return ode.solve(1.0, angle, 40.0, wind=200.0, slope=math.radians(20), rtol=1e-12).x

    assert best["range_m"] == pytest.approx(reach(math.pi / 2), rel=1e-9)
    assert max(reach(1.5), reach(1.0), reach(0.5)) < best["range_m"]


# --- aim ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("arc", "degrees"), [("low", 65.52533), ("high", 86.72944)])
def test_published_aim(run, arc, degrees):
    shot = found(run, "aim", "40", "10", "20", "--v-lim", "40", "--arc", arc)
    assert shot["launch_angle_deg"] == pytest.approx(degrees, abs=1e-5)
    flight = ode.solve(40.0, math.radians(shot["launch_angle_deg"]), 40.0, rtol=1e-12)
    state = flight.state(shot["flight_time_s"])
    assert [state.x, state.y] == pytest.approx([10, 20], abs=1e-8)
    assert shot["impact_speed_m_per_s"] == pytest.approx(state.speed, rel=1e-9)
    assert shot["impact_angle_deg"] == pytest.approx(math.degrees(state.alpha), rel=1e-8)


@pytest.mark.parametrize("velocity", ["0,0,0", "-3,0.5,6", "5,0,-20km/h"])
def test_aim_in_a_wind_at_a_moving_target(run, velocity):
    argv = ["aim", "40m/s", "120ft", "10", "--v-lim", "40", "--wind", "-5", "--crosswind", "4"]
    shot = found(run, *argv, "--velocity", velocity)
    angle, azimuth = (math.radians(shot[f"{name}_deg"]) for name in ("launch_angle", "azimuth"))
    # The launch's own axis lies along its azimuth, and the wind is told along that.
    flight = ode.solve(
        40.0, angle, 40.0, rtol=1e-12,
        wind=-5 * math.cos(azimuth) + 4 * math.sin(azimuth),
        crosswind=5 * math.sin(azimuth) + 4 * math.cos(azimuth),
    )  # fmt: skip
    t = shot["flight_time_s"]
    state = flight.state(t)
    x = state.x * math.cos(azimuth) - state.z * math.sin(azimuth)
    z = state.x * math.sin(azimuth) + state.z * math.cos(azimuth)
    ahead, up, across = {"0,0,0": (0, 0, 0), "-3,0.5,6": (-3, 0.5, 6)}.get(
        velocity, (5 / 3.6, 0, -20 / 3.6)
    )
    target = [120 * 0.3048 + ahead * t, 10 + up * t, across * t]
    assert [x, state.y, z] == pytest.approx(target, abs=1e-7)


def test_aim_as_a_table(run):
    code, out, err = run("aim", "40", "10", "20", "--v-lim", "40")
    assert (code, err) == (0, "")
    assert [line[:12].rstrip() for line in out.splitlines()] == [
        *("launch angle", "flight time", "impact speed", "impact angle", "status")
    ]
    names = run("aim", "40", "10", "20", "--v-lim", "40", "--crosswind", "1")[1]
    assert "azimuth" in names


def test_aim_out_of_reach(run):
    """In vacuum the envelope is y = v^2 / 2g - g x^2 / 2v^2."""
    code, out, err = run("aim", "10", "5", "50", "--k", "0")
    short = 50 - (100 / 19.62 - 9.81 * 25 / 200)
    assert code == 1
    assert err == f"hodograph: error: the target is out of reach, {short:.6g} m too high\n"
    assert out.splitlines()[-1].split() == ["status", "unreachable"]
    _, out, _ = run("aim", "10", "5", "50", "--k", "0", "--json")
    assert json.loads(out)["launch_angle_deg"] is None
    far = run("aim", "10", "500", "0", "--v-lim", "20")[2]  # past where any path falls straight
    assert far.endswith("the target is out of reach, and so is any lower place there\n")


@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["10", "5"], ["Y", "required"]),
        (["10", "5", "1", "--arc", "flat"], ["--arc", "low", "high"]),
        (["10", "5", "1", "--velocity", "1,2"], ["--velocity", "VX,VY,VZ"]),
        (["10", "5kg", "1"], ["X", "m", "ft", "yd"]),
        (["0", "5", "1"], ["v0 must be in [1e-30, 1e30] m/s"]),
    ],
)
def test_what_is_no_target(refused, argv, words):
    message = refused(2, "aim", *argv, "--v-lim", "40")
    assert [word for word in words if word not in message] == []


# --- the least speed ----------------------------------------------------------------------


def test_published_least_speed(run):
    """Over a fence of 3 m at 120 m, hit from 1 m."""
    body = ["--mass", "145g", "--cd", "0.3", "--diameter", "75mm", "--rho", "1.196"]
    least = found(run, "least-speed", "120", "2", *body)
    assert least["launch_speed_m_per_s"] == pytest.approx(46.385716, abs=1e-6)
    assert least["launch_angle_deg"] == pytest.approx(40.94419, abs=1e-5)
    out = run("least-speed", "120", "2", *body)[1]
    assert [line[:12] for line in out.splitlines()][:2] == ["launch speed", "launch angle"]


def test_least_speed_in_vacuum(run):
    """v^2 = g (y + sqrt(x^2 + y^2)), at half way between the target and the vertical."""
    least = found(run, "least-speed", "30ft", "4", "--v-lim", "inf")
    x, y = 9.144, 4.0
    speed = math.sqrt(9.81 * (y + math.hypot(x, y)))
    assert least["launch_speed_m_per_s"] == pytest.approx(speed, rel=1e-12)
    angle = 45 + math.degrees(math.atan2(y, x)) / 2
    assert least["launch_angle_deg"] == pytest.approx(angle, rel=1e-8)
