"""What is launched: bodies, exponents, several launches at once, and what does not go together."""

import json

import numpy as np
import pytest

from hodograph import Launch, bodies

BALL = ["--mass", "0.145", "--cd", "0.35", "--diameter", "0.074"]
PATH = ["trajectory", "30", "30,60", "--v-lim", "40"]


@pytest.mark.parametrize("name", bodies.CATALOGUE)
@pytest.mark.parametrize("rho", [None, 1.0])
def test_bodies_of_the_catalogue(run, name, rho):
    air = [] if rho is None else ["--rho", rho]
    code, out, err = run("range", "20", "40", "--body", name, *air, "--json")
    assert (code, err) == (0, "")
    k = bodies.CATALOGUE[name].k(rho or 1.225)
    expected = Launch.from_drag(20.0, np.deg2rad(40.0), k).range()
    assert json.loads(out)["range_m"] == pytest.approx(expected, rel=1e-14)


def test_the_help_names_every_body(run):
    words = " ".join(run("range", "--help")[1].split())
    assert [name for name in bodies.CATALOGUE if name not in words] == []


def test_published_range_of_a_body(run):
    body = ("--mass", "200g", "--cd", "0.47", "--diameter", "10cm", "--rho", "1.28")
    _, out, _ = run("range", "50", "65", *body, "--json")
    found = json.loads(out)
    assert found["range_m"] == pytest.approx(64.0846882, abs=1e-7)
    assert found["flight_time_s"] == pytest.approx(6.3359572, abs=1e-7)


@pytest.mark.parametrize("n", [1.0, 1.5, 3.0])
def test_other_exponents(run, n):
    for drag, launch in (
        (["--v-lim", "40"], Launch(30.0, np.deg2rad(40), 40.0, n=n)),
        (["--k", "0.02"], Launch.from_drag(30.0, np.deg2rad(40), 0.02, n=n)),
    ):
        _, out, _ = run("range", "30", "40", *drag, "--n", n, "--json")
        assert json.loads(out)["range_m"] == pytest.approx(launch.range(), rel=1e-14)
    assert f"n = {n:g}" in run("trajectory", "30", "40", "--v-lim", "40", "--n", n)[1]


@pytest.mark.parametrize(
    ("drag", "words"),
    [
        ([], ["--v-lim", "--k", "--body", "--mass", "one of"]),
        (["--body", "golf", "--k", "1"], ["--k", "--body", "not allowed"]),
        (["--body", "gofl"], ["--body", "'gofl'", "did you mean 'golf'?"]),
        (["--body", "xyz"], ["--body", "'xyz'", "known are", "golf", "table-tennis"]),
        (["--mass", "1"], ["--mass", "needs --cd"]),
        (["--mass", "1", "--cd", "1"], ["--mass", "one of --diameter and --area"]),
        ([*BALL, "--area", "1"], ["--mass", "one of --diameter and --area"]),
        (["--v-lim", "40", "--cd", "1"], ["--cd", "without argument --mass"]),
        (["--body", "golf", "--area", "1"], ["--area", "without argument --mass"]),
        (["--v-lim", "40", "--rho", "1"], ["--rho", "without argument --mass or --body"]),
        ([*BALL, "--n", "1.5"], ["--n", "n = 2", "--v-lim"]),
        (["--body", "golf", "--n", "3"], ["--n", "n = 2"]),
        (["--v-lim", "40", "--n", "0.5"], ["--n", "[1, 10]", "'0.5'"]),
        (["--mass", "0", "--cd", "1", "--area", "1"], ["--mass", "> 0"]),
        (["--body", "golf", "--rho", "1e40"], ["rho must be 0 or in [1e-30, 1e30]"]),
        (["--body", "golf", "--g", "1e-40"], ["g must be in [1e-30, 1e30] m/s^2"]),
        (["--mass", "1e-40", "--cd", "1", "--area", "1"], ["mass must be in [1e-30, 1e30] kg"]),
    ],
)
def test_what_is_no_drag(refused, drag, words):
    for name in (["range", "30"], ["trajectory", "30"]):
        message = refused(2, *name, "45", *drag)
        assert [word for word in words if word not in message] == []


# --- several launches ---------------------------------------------------------------------


def test_a_table_of_several(run):
    code, out, err = run("range", "100", "45,30,-90", "--v-lim", "inf", "--g", "10")
    assert (code, err) == (0, "")
    assert out.splitlines() == [
        "launch angle     45.0000    30.0000   -90.0000  deg",
        "range          1000.00     866.025      0       m",
        "flight time      14.1421    10.0000     0       s",
        "impact speed    100.000    100.000    100.000   m/s",
        "impact angle    -45.0000   -30.0000   -90.0000  deg",
        "apex distance   500.000    433.013      0       m",
        "apex height     250.000    125.000      0       m",
        "apex time         7.07107    5.00000    0       s",
        "status         converged   converged  converged",
    ]


def test_some_unreachable(run):
    code, out, err = run("range", "30", "20,80,10", "--v-lim", "40", "--height", "-20")
    assert code == 1
    assert err == ("hodograph: error: the landing height is never reached at 20,10 degrees\n")
    assert out.splitlines()[-1].split() == ["status", "unreachable", "converged", "unreachable"]
    assert out.splitlines()[1].split()[1::2] == ["-", "-"]


def test_a_file_of_several(run, tmp_path):
    code, out, err = run(*PATH, "-n", "5")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert "angle = 30,60 deg" in lines[0]
    assert lines[2] == "launch_deg,t,x,y,speed,alpha_deg,s"
    data = np.array([line.split(",") for line in lines[3:]], dtype=float)
    for angle, part in ((30.0, data[:5]), (60.0, data[5:])):
        assert (part[:, 0] == angle).all()
        path = Launch(30.0, np.radians(angle), 40.0).trajectory(5)
        np.testing.assert_array_equal(part[:, 2], path.x)
    code, out, err = run(*PATH, "--points", "5", "--json")
    assert (code, err) == (0, "")
    each = json.loads(out)
    assert [one["launch_angle_deg"] for one in each] == [30.0, 60.0]
    np.testing.assert_array_equal([one["y"] for one in each], data[:, 3].reshape(2, 5))


def test_a_path_as_json(run):
    _, out, _ = run("trajectory", "30", "30", "--v-lim", "40", "-n", "4", "--json")
    path = Launch(30.0, np.radians(30.0), 40.0).trajectory(4)
    found = json.loads(out)
    assert list(found) == ["t", "x", "y", "speed", "alpha_deg", "s"]
    assert found["t"] == path.t.tolist()


def test_a_plot_of_several(run, tmp_path):
    from matplotlib import image

    target = tmp_path / "paths.png"
    code, out, err = run(*PATH, "--out", target)
    assert (code, out, err) == (0, "", f"hodograph: wrote {target}\n")
    pixels = image.imread(target)[..., :3].reshape(-1, 3)
    for colour in ((0x1F, 0x77, 0xB4), (0xFF, 0x7F, 0x0E)):  # the first two of matplotlib's
        assert (np.abs(pixels - np.array(colour) / 255) < 0.01).all(axis=1).sum() > 100
    svg = tmp_path / "paths.svg"
    run(*PATH, "--out", svg)
    for words in ("30°", "60°", "apex", "landing"):
        assert f"<!-- {words} -->" in svg.read_text()


def test_one_unreachable_leaves_no_file(refused, tmp_path):
    target = tmp_path / "paths.csv"
    message = refused(
        1, "trajectory", "30", "20,80", "--k", "0", "--height", "-20", "--out", target
    )
    assert "never reached at 20 degrees; --to-apex gives" in message
    assert not target.exists()
