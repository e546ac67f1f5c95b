"""What a type checker sees of the public names."""

import re
import subprocess
import sys

import pytest
from helpers import ROOT

SNIPPET = """
import numpy as np
import hodograph
from hodograph import Launch, d_norm, d_ref, landing_angle, optimal_angle
from hodograph import laws

from hodograph import sensitivity, surrogate
from hodograph import bodies, path

hodograph.d_nrom(1.0, 0.5)  # wrong
hodograph.sensitivty  # wrong
Launch(30.0, 0.5)  # wrong
Launch(30.0, 0.5, 40.0).rnage()  # wrong

v = np.array([0.5, 1.0])
reveal_type(hodograph.d_norm(1, 0.5))  # scalar
reveal_type(d_norm(np.float32(1), np.float64(0.5), rtol=1e-3))  # scalar
reveal_type(d_norm(v, 0.5))  # array
reveal_type(d_norm([0.5, 1.0], 0.5))  # array
reveal_type(d_ref(30.0, 0.5))  # scalar
reveal_type(landing_angle(1.0, [0.5]))  # array
reveal_type(optimal_angle(1.0))  # scalar
reveal_type(laws.d_norm_law(1.0, 0.5))  # scalar
reveal_type(laws.alpha_max_law(v))  # array
reveal_type(surrogate.landing_angle(v, 0.5))  # array
reveal_type(path.speed(1.0, 0.5, 0.1))  # scalar
reveal_type(bodies.drag_constant(0.145, 0.35, diameter=0.074))  # scalar
reveal_type(bodies.drag_constant(0.145, 0.35, area=v))  # array
reveal_type(sensitivity.range_sensitivity(30.0, 0.5, 40.0).alpha0)  # scalar
reveal_type(sensitivity.range_sensitivity(v, 0.5, 40.0).alpha0)  # array
reveal_type(hodograph.aim(30.0, 10.0, 2.0, 40.0).alpha0)  # scalar
reveal_type(hodograph.aim(30.0, v, 2.0, 40.0, velocity=(v, 0.0, 1.0)).t)  # array
reveal_type(hodograph.least_speed(10.0, v, 40.0).v0)  # array
reveal_type(hodograph.envelope(30.0, 10, 40.0).y)  # scalar
reveal_type(hodograph.best_angle(30.0, 40.0, slope=0.1, wind=v))  # array
hodograph.aim(30.0, 10.0, 2.0)  # wrong
one, many = Launch(30.0, 0.5, 40.0), Launch(30.0, 0.5, 40.0, height=v)
reveal_type(one.range())  # scalar
reveal_type(one.apex()[0])  # scalar
reveal_type(one.landing().t)  # scalar
reveal_type(many.flight_time())  # array
reveal_type(many.v0)  # array
reveal_type(one.trajectory().x)  # array
reveal_type(Launch.from_drag(30.0, 0.5, 0.01).range())  # scalar
reveal_type(Launch.from_drag(v, 0.5, 0.01).range())  # array
film = hodograph.calibrate(v, [1.0, 2.0], v, n=None, fixed={"y0": 0.0}, sigma=(0.01, v))
film.alpah0  # wrong
hodograph.calibrate(v, v, fps=25)  # wrong
reveal_type(film.k)  # float
reveal_type(film.uncertainty["k"])  # float
reveal_type(film.residuals)  # array
reveal_type(film.launch.range())  # scalar
reveal_type(film.profile("k").low)  # float


def unknown(launch: Launch) -> None:
    launch.range()
"""
KINDS = {
    "float": r'Revealed type is "(?:builtins\.)?float"',
    "scalar": r'Revealed type is "numpy\.float64"',
    "array": r'Revealed type is "numpy\.ndarray\[.*numpy\.dtype\[numpy\.float64\]\]"',
    "wrong": "error: ",
}


def test_the_type_checker(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "snippet.py").write_text(SNIPPET)
    found = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(ROOT / ".mypy_cache"),
         str(tmp_path / "snippet.py")],
        cwd=ROOT, capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    said: dict[int, str] = {}
    for number, text in re.findall(r"snippet\.py:(\d+): (.*)", found.stdout):
        said.setdefault(int(number), text)  # the notes after an error say more of it
    expected = {
        number: line.rpartition("# ")[2]
        for number, line in enumerate(SNIPPET.split("\n"), 1)
        if line.rpartition("# ")[2] in KINDS
    }
    assert set(said) == set(expected), found.stdout + found.stderr
    for number, kind in expected.items():
        assert re.search(KINDS[kind], said[number]), said[number]
