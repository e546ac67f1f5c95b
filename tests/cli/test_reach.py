"""The inverse questions on the command line."""

import json
import math

import pytest


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
    assert "V0: must be > 0" in refused(2, "best", "0", "--v-lim", "40")
