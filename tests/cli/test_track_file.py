"""The command ``calibrate``: the files that it reads, what it says of them, and its figure."""

import json
import math
from typing import get_args

import numpy as np
import pytest

from hodograph import calibrate, ode
from hodograph.calibrate import Loss
from hodograph.cli import track_file
from hodograph.cli.calibrate import LOSSES
from hodograph.cli.streams import FailedError, UsageError
from hodograph.engine import estimate

K = 0.012
FLIGHT = ode.solve(14.4, 0.76, math.sqrt(9.81 / K), height=0.5, rtol=1e-12, atol=1e-14)
T = FLIGHT.t * np.linspace(0.0, 1.0, 25)
X, Y, _, _ = FLIGHT.at(T)
X, Y = X + 0.01 * np.cos(np.arange(25) ** 2.0), Y + 0.01 * np.sin(np.arange(25) ** 2.0)


def lines(*columns, mark=",", number="{:.9g}".format):
    return "".join(
        mark.join(number(value) for value in row) + "\n" for row in zip(*columns, strict=True)
    )


def comma(value):
    return f"{value:.9f}".replace(".", ",")


def scientific(value):
    return f"{value:.9E}"


FILES = {
    "csv": "t,x,y\n" + lines(T, X, Y),
    "units": "t (s),x (m),y (m)\n" + lines(T, X, Y),
    "centimetres": "time [ms];x [cm];y [cm]\n" + lines(1e3 * T, 1e2 * X, 1e2 * Y, mark=";"),
    "mixed units": "t/s,x/mm,y/m\n" + lines(T, 1e3 * X, Y),
    "tracker": "mass A\t\t\nt\tx\ty\n" + lines(T, X, Y, mark="\t", number=scientific),
    "tracker, two rows of names": "\tmass_A\tmass_A\nt\tx\ty\n" + lines(T, X, Y, mark="\t"),
    "tracker, further columns": "t\tx\ty\tv_x\tv_y\n" + lines(T, X, Y, T, T, mark="\t"),
    "tracker, names of bodies": ('"t"\t"x_{mass A}"\t"y_{mass A}"\n' + lines(T, X, Y, mark="\t")),
    "decimal commas": "t;x;y\n" + lines(T, X, Y, mark=";", number=comma),
    "decimal commas and tabs": "t\tx\ty\n" + lines(T, X, Y, mark="\t", number=comma),
    "decimal commas and blanks": "t x y\n" + lines(T, X, Y, mark="  ", number=comma),
    "blanks": "t x y\n" + lines(T, X, Y, mark="   "),
    "comma and blank": "t, x, y\n" + lines(T, X, Y, mark=", "),
    "other order": "y,frame,t,x\n" + lines(Y, np.arange(25), T, X),
    "mass_A": "t,mass_A.x,mass_A.y,x_mass_A,y_mass_A\n" + lines(T, T, T, X, Y),
    "capitals": "Time,X Position,Y Position\n" + lines(T, X, Y),
    "German": "Zeit;x;y\n" + lines(T, X, Y, mark=";", number=comma),
    "no names": lines(T, X, Y),
    "comments": "# a film\n# of a ball, in m\nt,x,y\n" + lines(T, X, Y) + "# the end\n",
    "names behind a comment": "# t x y\n" + lines(T, X, Y, mark=" "),
    "Windows": ("t,x,y\n" + lines(T, X, Y)).replace("\n", "\r\n"),
    "byte order mark": "\ufefft,x,y\n" + lines(T, X, Y),
    "gaps": "t,x,y\n" + lines(T, X, Y) + "1.0,,\n1.1,NaN,2\n\n",
    "no first point": "t,x,y\n-0.1,,\n" + lines(T, X, Y),
    "a gap, and no names": "-0.1,,\n" + lines(T, X, Y),
    "a row of units": "t,x,y\ns,cm,m\n" + lines(T, 100 * X, Y),
    "a line below the names": "t,x,y\n---,---,---\n" + lines(T, X, Y),
    "units in words": "Time (seconds),x (millimeters),y (metres)\n" + lines(T, 1e3 * X, Y),
    "units in German": "Zeit in s;x in cm;y in m\n" + lines(T, 100 * X, Y, mark=";", number=comma),
    "units in French": "temps en s;x en m;y en m\n" + lines(T, X, Y, mark=";", number=comma),
    "units behind a dash": "t_ms,x_cm,y_m\n" + lines(1e3 * T, 100 * X, Y),
    "units behind blanks": "t [s] x [cm] y [m]\n" + lines(T, 100 * X, Y, mark=" "),
    "quoted names": '"t, s","x, cm","y, m"\n' + lines(T, 100 * X, Y),
    "quoted decimal commas": "t,x,y\n" + lines(T, X, Y, number=lambda v: f'"{comma(v)}"'),
    "Logger Pro": '"Latest: Time (s)","Latest: X (m)","Latest: Y (m)"\n' + lines(T, X, Y),
    "hyphens": "Time,X-Pos,Y-Pos\n" + lines(T, X, Y),
    "a word below": "t,x,y\n" + lines(T, X, Y) + "end of film,,\n",
}


@pytest.fixture
def file(tmp_path):
    def write(text, encoding="utf-8"):
        path = tmp_path / "track.csv"
        path.write_bytes(text.encode(encoding))
        return path

    return write


@pytest.mark.parametrize("kind", FILES)
def test_files(file, kind):
    track = track_file.read(file(FILES[kind]), None, None, None)
    count = np.isfinite(track.x + track.y)
    assert count.sum() == 25
    for found, true in zip((track.t, track.x, track.y), (T, X, Y), strict=True):
        np.testing.assert_allclose(found[count], true, rtol=1e-7, atol=1e-8)
    assert track.skipped == (kind == "a word below")


@pytest.mark.parametrize("encoding", ["utf-16", "latin-1"])
def test_encodings(file, encoding):
    path = file("# kugel für die übung\nt,x,y\n" + lines(T, X, Y), encoding)
    np.testing.assert_allclose(track_file.read(path, None, None, None).x, X, rtol=1e-7)


def test_columns_by_name_and_number(file):
    path = file("a,b,c,d\n" + lines(T, X, Y, T))
    for columns in ("a,b,c", "1,2,3", "a,2,c"):
        track = track_file.read(path, columns, None, None)
        np.testing.assert_allclose(track.y, Y, rtol=1e-7, atol=1e-8)
    assert track_file.read(path, "b,c", None, None).t is None
    assert track_file.read(path, "a,b,c", None, None, times=False).t is None
    for columns, words in (
        ("a,e,c", "no column 'e'; there are a, b, c, d"),
        ("9,1,2", "no column '9'"),
        ("a", "must be x,y or t,x,y"),
    ):
        with pytest.raises(UsageError, match=words):
            track_file.read(path, columns, None, None)
    with pytest.raises(FailedError, match="which columns are x and y"):
        track_file.read(path, None, None, None)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("t,x,y\n", "no numbers in it"),
        ("", "no numbers in it"),
        ("t,x (px),y (px)\n1,2,3\n", "'x' is in pixels: .*--scale"),
        ("frame,x,y\n1,2,3\n", None),
        ("t (frames),x,y\n1,2,3\n", "counts frames: give their rate, --fps"),
        ("t,x (parsec),y\n1,2,3\n", "is in 'parsec'; known are m, cm"),
        ("1,2,3,4\n", "which columns are x and y.*4 columns without names"),
        ("t,x,y\n0,1,0,5,1,2\n0,2,0,6,1,3\n", "rows of 6 numbers under 3 names.*semicolons"),
        ("t x y\n1 0.0 1 2\n2 0.1 2 3\n", "rows of 4 numbers under 3 names.*--columns"),
        ("t,x,y\n0:01,1,2\n0:02,2,3\n", "no numbers in t, column 1"),
    ],
)
def test_files_refused(file, text, words):
    if words is None:  # a column of frames is no time, and is left alone
        assert track_file.read(file(text), None, None, None).t is None
        return
    with pytest.raises(FailedError, match=words):
        track_file.read(file(text), None, None, None)


def test_scale_and_frames(file):
    path = file("frame,x (px),y (px)\n" + lines(30 * T, 250 * X, 250 * Y))
    track = track_file.read(path, "frame,x,y", 1 / 250, 30.0)
    np.testing.assert_allclose(track.t, T, rtol=1e-7, atol=1e-9)
    np.testing.assert_allclose(track.x, X, rtol=1e-7)
    track = track_file.read(path, None, 1 / 250, 30.0)  # the only times that there are
    np.testing.assert_allclose(track.t, T, rtol=1e-7, atol=1e-9)
    with pytest.raises(UsageError, match=r"--fps.* has no times; name them"):
        track_file.read(file("x,y\n" + lines(X, Y)), None, None, 30.0)


# --- the command --------------------------------------------------------------------------


def test_json(run, file):
    code, out, err = run(
        "calibrate", file(FILES["csv"]), "--json", "--mass", "430g", "--area", "0.04"
    )
    assert code == 0
    assert "25 rows; t is column 1 't', x is column 2 'x', y is column 3 'y'" in err
    found = json.loads(out)
    same = calibrate(X, Y, T, mass=0.43, area=0.04)
    assert found["k"] == pytest.approx(same.k, rel=1e-6)
    assert found["cd"] == pytest.approx(same.cd, rel=1e-6)
    assert found["uncertainty"]["k"] == pytest.approx(same.uncertainty["k"], rel=1e-5)
    assert found["chi2_reduced"] is None
    assert abs(found["k"] - K) < 3 * found["uncertainty"]["k"]


def test_table(run, file):
    code, out, _ = run("calibrate", file(FILES["csv"]), "--mass", "430g", "--diameter", "22cm")
    assert code == 0
    rows = {line[:16].rstrip(): line[16:].split() for line in out.splitlines()}
    k, mark, u, unit = rows["drag constant k"]
    assert (mark, unit) == ("±", "1/m")
    assert abs(float(k) - K) < 3 * float(u)
    assert len(u.lstrip("0.").rstrip("0")) <= 2
    assert rows["launch angle"][-1] == "deg"
    assert rows["drag coefficient"][1] == "±"
    assert rows["points"] == ["25"]
    assert rows["g of the track"][-1] == "m/s^2"


def test_a_lower_bound_where_drag_is_not_told(run, file):
    x, y = 5 * T, 9 * T - 4.905 * T**2
    wave = 0.03 * np.cos(np.arange(25) ** 2.0)
    code, out, _ = run("calibrate", file("t,x,y\n" + lines(T, x + wave, y - wave)))
    assert code == 0
    assert "terminal speed" in out
    (row,) = (line for line in out.splitlines() if line.startswith("terminal speed"))
    assert row.split()[2] == ">"
    assert row.endswith("(95 %)")


def test_options(run, file):
    path = file("t,x,y\n" + lines(T, X, -Y))
    code, out, _ = run("calibrate", path, "--y-down", "--json", "--fix", "v0=14.4", "--fix", "t0=0")
    assert code == 0
    found = json.loads(out)
    assert found["v0"] == 14.4
    assert found["fitted"] == ["alpha0", "k", "x0", "y0"]
    path = file(FILES["csv"])
    _, out, _ = run("calibrate", path, "--json", "--curve", "--sigma", "0.01,0.01", "--g", "9.8")
    found = json.loads(out)
    assert found["t0"] is None
    assert found["chi2_reduced"] < 2
    assert found["g"] == 9.8
    _, out, _ = run("calibrate", path, "--json", "--n", "free", "--loss", "linear")
    assert json.loads(out)["uncertainty"]["n"] > 0
    _, out, _ = run("calibrate", path, "--json", "--fix", "alpha0=43.5", "--n", "1")
    assert json.loads(out)["alpha0"] == pytest.approx(math.radians(43.5))
    code, out, _ = run("calibrate", path, "--cd-only", "--mass", "0.43", "--diameter", "0.22")
    cd, u = map(float, out.split())
    assert abs(cd - 2 * 0.43 * K / (1.225 * math.pi / 4 * 0.22**2)) < 3 * u


@pytest.mark.parametrize("form", ["png", "pdf", "svg"])
def test_figure(run, file, tmp_path, form):
    path, out = file(FILES["csv"]), tmp_path / f"ball.{form}"
    code, _, err = run("calibrate", path, "--out", out)
    assert code == 0
    assert f"wrote {out}" in err
    first = out.read_bytes()
    assert first.startswith({"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}[form])
    code, _, err = run("calibrate", path, "--out", out)
    assert code == 1
    assert "--force" in err
    assert run("calibrate", path, "--out", out, "--force")[0] == 0
    assert out.read_bytes() == first


@pytest.mark.parametrize(
    ("argv", "code", "words"),
    [
        (["--fix", "speed=3"], 2, "NAME of v0, alpha0, k, v_lim"),
        (["--fix", "v0"], 2, "must be NAME=VALUE"),
        (["--n", "0.5"], 2, "in [1, 10], or free"),
        (["--cd-only"], 2, "needs --mass"),
        (["--mass", "1kg"], 2, "give exactly one of diameter"),
        (["--mass", "1kg", "--diameter", "0.1", "--n", "1"], 1, "cd belongs to n = 2"),
        (["--out", "ball.txt"], 2, "must end in .pdf, .png, .svg"),
        (["--scale", "1cm"], 1, "the track falls at 0.09"),
        (["--y-down"], 1, "the track bends upwards"),
        (["--y-down"], 1, "leave --y-down out"),
        (["--fix", "alpha0=100"], 2, "must be in [-90, 90] degrees"),
        (["--fix", "k=-1"], 2, "must be finite and >= 0"),
        (
            ["--fix", "k=0.01", "--fix", "v_lim=30"],
            1,
            "--fix v_lim needs a given n, and no --fix k",
        ),
        (["--fix", "y0=500"], 1, ": hold it, --fix "),
        (["--curve", "--fix", "t0=0"], 1, "--fix has 't0', which a track without times has not"),
    ],
)
def test_refused(run, file, argv, code, words):
    found, out, err = run("calibrate", file(FILES["csv"]), *argv)
    assert (found, out) == (code, "")
    last = err.splitlines()[-1]
    assert last.startswith("hodograph: error: ")
    assert words in last


def test_y_down_is_hinted_at(run, file):
    code, _, err = run("calibrate", file("t,x,y\n" + lines(T, X, -Y)))
    assert (code, "--y-down turns it" in err) == (1, True)


def test_no_file(run, tmp_path):
    code, out, err = run("calibrate", tmp_path / "none.csv")
    assert (code, out) == (1, "")
    assert "none.csv: No such file" in err


@pytest.mark.filterwarnings("default")
def test_a_wrong_scale_is_said(run, file):
    code, _, err = run("calibrate", file(FILES["csv"]), "--scale", "1.08")
    assert code == 0
    assert "hodograph: warning: the track falls with g = 10." in err


def test_the_losses_are_those_of_the_library():
    assert LOSSES == estimate.LOSSES == get_args(Loss)
