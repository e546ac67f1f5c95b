"""Error against time, way by way, and the cost of a scene: what is measured, and how it is told.

Nothing here asserts a time: how quick a way is, is for the commands to say.
"""

import logging
import math
import re

import numpy as np
import pytest
from helpers import DATA, ROOT
from matplotlib.figure import Figure

from hodograph import Launch, d_norm, landing_angle
from hodograph.bench import measurement, methods, scene, ways, work_precision
from hodograph.engine import driver, position
from hodograph.engine import fall as descent
from hodograph.report.tables import csv_rows
from hodograph.tiers import dial

TINY = measurement.Sizes(many=30, several=5, each=3, few=2, checked=4, seconds=1e-3, rounds=1)
FAST = measurement.Domain("fast", (3.0, 4.0), (40.0, 60.0))


@pytest.fixture(scope="module")
def points():
    return work_precision.measure((measurement.DOMAINS[0], FAST), TINY)


def one(points, family, setting, domain="paper"):
    (found,) = (p for p in points if (p.domain, p.family, p.setting) == (domain, family, setting))
    return found


def point(family, setting, microseconds, largest, general=True, promise=math.inf):
    return measurement.Measurement(
        "paper", family, setting, microseconds, largest / 3, largest, 0.0, 10, general, promise
    )


@pytest.mark.parametrize("where", measurement.DOMAINS, ids=lambda where: where.name)
def test_launches_lie_in_their_domain(where):
    v, a0 = where.launches(1000)
    for values, ends in ((v, where.v_norm), (np.rad2deg(a0), where.alpha0_deg)):
        assert ends[0] < values.min() < values.max() < ends[1]
        assert values.max() - values.min() > 0.99 * (ends[1] - ends[0])
    assert np.array_equal(where.launches(10)[0], v[:10])  # the first stand for all


@pytest.mark.parametrize("domain", ["paper", "fast"])
@pytest.mark.parametrize("steps", [32, 128])
def test_fixed_steps_stand_in_their_order(points, domain, steps):
    errors = [
        one(points, family, f"{steps} steps", domain).largest
        for family in (ways.EULER, ways.RK2, ways.RK4)
    ]
    assert errors[0] > 10 * errors[1] > 100 * errors[2]


@pytest.mark.parametrize("family", list(ways.STEPPERS))
def test_smaller_steps_are_better(points, family):
    errors = [one(points, family, f"{steps} steps").largest for steps in ways.STEPS]
    assert errors == sorted(errors, reverse=True)


def test_solvers_and_engine_are_as_good_as_they_should_be(points):
    for domain in ("paper", "fast"):
        assert one(points, "solve_ivp DOP853", "rtol=1e-10", domain).largest < 1e-8
        assert 0 < one(points, ways.TIER, "method='exact'", domain).largest < 1e-13
        assert one(points, ways.MPMATH, "15 digits", domain).largest < 1e-14
        assert one(points, ways.MPMATH, "30 digits", domain).largest < 1e-28
    assert one(points, ways.ENGINE, "64 nodes").largest < 1e-13
    assert one(points, ways.ENGINE, "8 nodes").largest > 1e-12


def test_dial_keeps_its_promise(points):
    for rtol in ways.TOLERANCES:
        for domain in ("paper", "fast"):
            found = one(points, ways.DIAL, f"rtol={rtol:.0e}", domain)
            assert 0 < found.largest <= rtol
            assert found.promise == rtol
    for tier in dial.METHODS:
        found = one(points, ways.TIER, f"method={tier!r}")
        assert 0 < found.largest <= found.promise


def test_what_is_not_general(points):
    route = one(points, ways.PAPER, "", "fast")
    assert route.failed > 0
    assert not route.general
    assert one(points, ways.PAPER, "").general
    assert not one(points, ways.ENGINE, "64 nodes").general


def test_tier_sees_only_its_domain(monkeypatch):
    tiers = [way for way in ways.ways(TINY._replace(many=9)) if way.family == ways.TIER]
    monkeypatch.setattr(ways, "ways", lambda sizes: tiers)
    found = work_precision.measure(
        (measurement.Domain("half", (3.0, 17.0), (40.0, 41.0)),), TINY._replace(many=9)
    )
    surrogate = one(found, ways.TIER, "method='surrogate'", "half")
    assert 0 < surrogate.launches < 9
    assert surrogate.largest < 1e-9
    assert not surrogate.general


def test_nodes_agree_with_the_engine_beyond_one_block():
    v, a0 = measurement.DOMAINS[0].launches(300)
    assert methods.by_nodes(v, a0, nodes=64) == pytest.approx(d_norm(v, a0), rel=1e-13)


def test_cheapest():
    law = point(ways.LAW, "table_1", 1.0, 1e-3)
    hidden = point(ways.ENGINE, "4 nodes", 0.5, 1e-9, general=False)
    loose = point(ways.DIAL, "rtol=1e-06", 3.1, 1e-7, promise=1e-6)
    tight = point(ways.DIAL, "rtol=1e-08", 3.0, 1e-9, promise=1e-8)
    fixed = point(ways.RK4, "8 steps", 2.95, 1e-8)
    found = [law, hidden, loose, tight, fixed]
    assert work_precision.cheapest(found, 1e-2) is law
    assert work_precision.cheapest(found, 1e-4) is loose  # as quick as the others, and promised
    assert work_precision.cheapest(found, 1e-8) is tight
    assert work_precision.cheapest([loose], 1e-7) is None  # as good by luck, and not by its word
    assert work_precision.cheapest(found, 1e-12) is None
    broken = point(ways.PAPER, "", 0.1, math.nan, general=False)
    assert work_precision.cheapest([broken], 1.0) is None


def test_choice_table(points):
    text = work_precision.choice_table(points, (1e-2, 1e-30))
    assert text.count("1e-02") == text.count("1e-30") == 2
    assert "v_norm 0 to 1.5, alpha0 1 to 89 degrees" in text
    assert max(map(len, text.splitlines())) <= 100
    assert (
        work_precision.choice_table([point(ways.RK2, "8 steps", 1.0, 0.1)], (1e-2,)).count("none")
        == 1
    )


def test_csv(points):
    text = measurement.csv_text(points, TINY, "make it")
    rows = csv_rows(text)
    assert list(rows[0]) == list(measurement.COLUMNS)
    assert len(rows) == len(points)
    for row, found in zip(rows, points, strict=True):
        assert (row["domain"], row["way"]) == (found.domain, found.family)
        assert float(row["microseconds"]) > 0
        assert float(row["max_error"]) == pytest.approx(found.largest, rel=1e-3, nan_ok=True)


def test_figure(points):
    drawn = work_precision.figure(points)
    assert len(drawn.axes) == 2
    (key,) = drawn.legends
    texts = [text.get_text() for text in key.get_texts()]
    assert {"RK4", "solve_ivp LSODA", "mpmath", "laws"} <= set(texts)
    assert all(text.get_fontsize() >= 8 for text in key.get_texts())
    drawn.draw_without_rendering()
    low = min(axes.get_tightbbox().y0 for axes in drawn.axes)
    assert key.get_window_extent().y1 <= low  # below the panels, not on them


def test_bench_work_precision(run, points, tmp_path, monkeypatch):
    monkeypatch.setattr(work_precision, "measure", lambda *_, **__: points)
    monkeypatch.setattr(work_precision, "figure", lambda points: Figure())
    argv = "bench", "work-precision", "--out", tmp_path
    code, out, err = run(*argv)
    assert (code, out) == (0, work_precision.choice_table(points))
    assert err.splitlines()[-1] == f"hodograph: wrote {tmp_path / 'work_precision.csv'}"
    made = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert set(made) == set(work_precision.FILES)
    assert made["work_precision.png"].startswith(b"\x89PNG")
    assert made["work_precision.pdf"].startswith(b"%PDF")

    assert run(*argv, "--force")[0] == 0
    monkeypatch.setattr(work_precision, "measure", None)  # refused before it is called
    code, out, err = run(*argv)
    assert (code, out) == (1, "")
    assert "work_precision.png" in err
    with pytest.raises(FileExistsError, match=r"work_precision\.png"):
        work_precision.bench(tmp_path)


def test_readme_says_what_was_measured():
    rows = csv_rows((DATA / "work_precision.csv").read_text("utf-8"))
    times = {
        (row["way"], row["setting"]): float(row["microseconds"])
        for row in rows
        if row["domain"] == "paper"
    }
    said = re.search(
        r"exact answers take (\S+) µs a launch in arrays, and (\S+) µs when 1e-8 will do",
        (ROOT / "README.md").read_text("utf-8"),
    )
    measured = times[ways.TIER, "method='exact'"], times[ways.DIAL, "rtol=1e-08"]
    assert [float(f"{time:.1f}") for time in measured] == [float(word) for word in said.groups()]


def test_scene(run, monkeypatch, caplog):
    caplog.set_level(logging.INFO, "hodograph")
    found = scene.measure(count=4, paths=2, rounds=1)
    assert caplog.messages[-1] == "round 1 of 1"
    names = list(scene.scenes(1))
    for quantity, row in found.costs.items():
        assert list(row) == names
        absent = {"below", "above"} if quantity == "landing_angle" else set()
        assert {name for name in names if math.isnan(row[name])} == absent
    assert sum(name.startswith("trajectory") for name in found.costs) == len(scene.POINTS)

    monkeypatch.setattr(scene, "measure", lambda **_: found)
    code, out, _ = run("bench", "scene")
    assert (code, out) == (0, scene.scene_table(found))
    head, *rows = out.splitlines()[: 1 + len(found.costs)]
    assert {len(row) for row in rows} == {len(head)}  # aligned


@pytest.mark.parametrize(
    ("compute", "integrals", "arcs"),
    [
        (lambda launch: launch.range(), {"x", "y"}, 2),
        (lambda launch: launch.flight_time(), {"t", "y"}, 2),
        (lambda launch: landing_angle(launch.v_norm, launch.alpha0), {"y"}, 2),
        (lambda launch: launch.apex(), {"t", "x", "y"}, 1),  # and nothing after it
    ],
    ids=["range", "time", "angle", "apex"],
)
def test_only_what_is_asked_is_integrated(monkeypatch, compute, integrals, arcs):
    seen = []
    for module in (position, descent):

        def spy(begin, slope, delta, wanted, *ahead, real=module.arc):
            seen.append(set(wanted))
            return real(begin, slope, delta, wanted, *ahead)

        monkeypatch.setattr(module, "arc", spy)
    monkeypatch.setattr(driver, "FEW", 0)  # which go by plain floats
    compute(Launch([30.0], 0.7, 42.7))
    assert set().union(*seen) == integrals
    assert len(seen) == arcs


def test_scenes_all_land():
    for launch in scene.scenes(20).values():
        assert launch.landing().success.all()
