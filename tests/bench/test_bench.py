"""The benches: the methods right where they can be, wrong where they must be, and the tables."""

import math
import sys
import warnings
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.text import Text

from hodograph import d_norm, reference
from hodograph.bench import measurement, methods, packages, speed, stability, targets
from hodograph.report.tables import csv_rows

FAST_AND_STEEP = [(v, deg) for v in (2.0, 10.0, 1e3) for deg in (45.0, 70.0, 89.0)]


def launch_points(count=12):
    v_norm, alpha0 = speed.MIXED.launches(count)
    return list(zip(v_norm.tolist(), alpha0.tolist(), strict=True))


def error(compute, v_norm, alpha0):
    exact = reference.d_norm(v_norm, alpha0, dps=20)
    return float(abs(compute(v_norm, alpha0) - exact) / exact)


# --- the methods --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("compute", "tolerance"),
    [(methods.by_quad, 1e-12), (methods.by_solve_ivp, 2e-9), (methods.by_ode, 2e-9)],
)
def test_method_agrees_with_the_reference(compute, tolerance):
    assert max(error(compute, *point) for point in launch_points()) < tolerance


@pytest.mark.parametrize(("v_norm", "degrees"), [(1e-3, 0.01), (1.0, 1e-3), (1e4, 89.99)])
def test_quad_at_the_ends(v_norm, degrees):
    assert error(methods.by_quad, v_norm, math.radians(degrees)) < 1e-12


def test_solve_ivp_may_land_where_it_starts():
    """Its first step spans a flight so short, and the event strikes at the launch."""
    assert methods.by_solve_ivp(1e-3, math.radians(1)) == 0
    assert error(methods.by_ode, 1e-3, math.radians(1)) < 1e-12


def test_fixed_nodes_lose():
    assert error(methods.by_fixed_nodes, 0.5, math.radians(45)) < 1e-13
    steep = 50.0, math.radians(89)
    assert 0.3 < error(methods.by_fixed_nodes, *steep) < 0.4  # published: 38 %
    more = error(lambda v, a: methods.by_fixed_nodes(v, a, nodes=1024), *steep)
    assert more < 0.05 * error(methods.by_fixed_nodes, *steep)


def test_fixed_nodes_lose_at_a_right_angle_without_drag():
    assert error(methods.by_fixed_nodes, 1e-3, math.radians(89.99)) > 0.5


@pytest.mark.parametrize(("v_norm", "degrees"), FAST_AND_STEEP)
def test_paper_fails_for_fast_and_steep_launches(v_norm, degrees):
    assert math.isnan(methods.by_paper(v_norm, math.radians(degrees)))


@pytest.mark.parametrize(("v_norm", "degrees"), [(0.5, 45), (1.0, 30), (1.5, 20)])
def test_paper_holds_where_it_was_meant_to(v_norm, degrees):
    assert error(methods.by_paper, v_norm, math.radians(degrees)) < 1e-6


SLOW_TO_FAST = ((1e-3, math.radians(1)), (0.05, 0.3), (1.0, math.pi / 4), (20.0, 1.5))


@pytest.mark.parametrize("method", ["RK45", "DOP853", "LSODA"])
@pytest.mark.parametrize(("v", "a"), SLOW_TO_FAST)
def test_solve_ivp_in_units_of_the_flight(method, v, a):
    found = methods.by_solve_ivp(v, a, method=method, rtol=1e-8, atol=1e-11, scaled=True)
    assert found == pytest.approx(float(reference.d_norm(v, a)), rel=1e-6)


def test_diffrax_in_units_of_the_flight():
    pytest.importorskip("diffrax", reason="diffrax comes with the extra `bench`")
    truth = [float(reference.d_norm(v, a)) for v, a in SLOW_TO_FAST]
    batch = packages.by_diffrax(rtol=1e-8, atol=1e-11, scaled=True)
    assert batch(*np.array(SLOW_TO_FAST).T) == pytest.approx(truth, rel=1e-6)


def test_ballisticcalc_is_optional(monkeypatch):
    monkeypatch.setitem(sys.modules, "py_ballisticcalc_exts", None)
    assert packages.by_ballisticcalc() is None


@pytest.mark.parametrize(
    ("setting", "tolerance"),
    [({"steps": 8}, 1e-4), ({"steps": 128}, 1e-9), ({"rtol": 1e-4}, 1e-3), ({"rtol": 1e-10}, 1e-7)],
)
def test_ballisticcalc_agrees_with_mpmath(setting, tolerance):
    pytest.importorskip("py_ballisticcalc_exts", reason="it comes with the extra `bench`")
    fire = packages.by_ballisticcalc(**setting)
    filters = list(warnings.filters)
    for v, a in SLOW_TO_FAST:
        assert fire(v, a) == pytest.approx(float(reference.d_norm(v, a)), rel=tolerance)
    assert warnings.filters == filters


def test_diffrax_is_optional(monkeypatch):
    monkeypatch.setitem(sys.modules, "diffrax", None)
    assert packages.by_diffrax() is None


@pytest.mark.slow
def test_diffrax_agrees_with_the_engine():
    pytest.importorskip("diffrax", reason="diffrax comes with the extra `bench`")
    v_norm, alpha0 = speed.MIXED.launches(64)
    batch = packages.by_diffrax()
    np.testing.assert_allclose(batch(v_norm, alpha0), d_norm(v_norm, alpha0), rtol=1e-11)


# --- stability ----------------------------------------------------------------------------

V_NORM = np.array([1e-3, 1.0, 1e3])
ALPHA0_DEG = stability.two_sided(0.01, 3)
METHODS = {"hodograph", "paper", "fixed_nodes", "solve_ivp", "ode"}


@pytest.fixture(scope="module")
def maps():
    return stability.measure(V_NORM, ALPHA0_DEG)


def test_two_sided():
    angles = stability.two_sided(0.01, 29)
    assert (len(angles), angles[0], angles[14]) == (29, pytest.approx(0.01), 45)
    assert (np.diff(angles) > 0).all()
    np.testing.assert_allclose(angles + angles[::-1], 90, rtol=0, atol=1e-13)


def test_default_grid():
    assert (stability.V_NORM[0], stability.V_NORM[-1]) == (1e-3, 1e4)
    assert stability.ALPHA0_DEG[-1] == pytest.approx(89.99)


def test_maps(maps):
    assert set(maps.errors) == METHODS
    assert all(error.shape == (3, 3) for error in maps.errors.values())
    assert maps.errors["hodograph"].max() < 2e-15
    assert maps.errors["ode"].max() < 1e-6
    assert np.isnan(maps.errors["paper"][1:, 2]).all()
    assert maps.errors["solve_ivp"][0, 0] == 1
    assert maps.errors["fixed_nodes"][2].min() > 0.5
    np.testing.assert_allclose(
        maps.d_norm, d_norm(V_NORM, np.deg2rad(ALPHA0_DEG)[:, np.newaxis]), rtol=2e-15
    )


def test_summaries(maps):
    lines = {line.name: line for line in stability.summaries(maps)}
    assert set(lines) == METHODS
    assert lines["hodograph"].failed == lines["hodograph"].wrong == 0
    assert lines["hodograph"].median <= lines["hodograph"].nine_tenths < 2e-15
    assert lines["paper"].failed == pytest.approx(np.isnan(maps.errors["paper"]).mean())
    worst = lines["fixed_nodes"]
    assert worst.largest == maps.errors["fixed_nodes"].max()
    assert (worst.v_norm, worst.alpha0_deg) == (1e3, pytest.approx(89.99))


def test_summary_of_nothing_but_failures(maps):
    (line,) = stability.summaries(replace(maps, errors={"none": np.full((3, 3), np.nan)}))
    assert line.failed == 1
    assert math.isnan(line.largest)


def test_stability_table(maps):
    text = stability.summary_table(maps)
    assert all(method.title in text for method in stability.METHODS)
    assert max(map(len, text.splitlines())) <= 110


def test_stability_csv(maps):
    rows = csv_rows(stability.csv_text(maps))
    assert len(rows) == 9
    assert set(rows[0]) == {"v_norm", "alpha0_deg", "d_norm", *METHODS}
    last = rows[-1]
    assert float(last["v_norm"]) == 1e3
    assert float(last["alpha0_deg"]) == ALPHA0_DEG[-1]  # the very double
    assert math.isnan(float(last["paper"]))


def test_stability_figure(maps):
    drawn = stability.figure(maps)
    panels = [axes for axes in drawn.axes if axes.get_title()]
    assert len(panels) == len(stability.METHODS)
    assert len({axes.get_xlim() + axes.get_ylim() for axes in panels}) == 1
    drawn.draw_without_rendering()
    texts = [text for text in drawn.findobj(Text) if text.get_text()]
    assert len(texts) > 50
    assert min(text.get_fontsize() for text in texts) >= 8


def test_bench_stability(run, maps, tmp_path, monkeypatch):
    monkeypatch.setattr(stability, "measure", lambda *_, **__: maps)
    argv = "bench", "stability", "--out", tmp_path
    code, out, err = run(*argv)
    assert (code, out) == (0, stability.summary_table(maps))
    assert err.splitlines()[-1] == f"hodograph: wrote {tmp_path / 'stability.csv'}"
    made = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert set(made) == set(stability.FILES)
    assert made["stability.png"].startswith(b"\x89PNG")
    assert made["stability.pdf"].startswith(b"%PDF")

    monkeypatch.setattr(stability, "measure", None)  # refused before it is called
    code, out, err = run(*argv)
    assert (code, out) == (1, "")
    assert "stability.png" in err
    assert "--force" in err
    with pytest.raises(FileExistsError):
        stability.bench(tmp_path)


# --- speed --------------------------------------------------------------------------------

TINY = measurement.Sizes(many=40, each=3, few=0, checked=3, seconds=8.0, rounds=2)


@pytest.fixture(scope="module")
def found():
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "diffrax", None)
        return speed.measure(TINY)


@pytest.mark.parametrize("domain", [speed.MIXED, speed.MIXED_LOG], ids=lambda domain: domain.name)
def test_launches(domain):
    v_norm, alpha0 = domain.launches(2000)
    degrees = np.rad2deg(alpha0)
    assert 0.1 <= v_norm.min() < 0.15
    assert 19.8 < v_norm.max() <= 20
    assert 5 <= degrees.min() < 5.1
    assert 89.8 < degrees.max() <= 89.9
    middle = math.sqrt(0.1 * 20) if domain.log else 10.05
    assert np.median(v_norm) == pytest.approx(middle, rel=0.02)
    assert np.median(v_norm[:50]) == pytest.approx(middle, rel=0.2)  # the first stand for all
    np.testing.assert_array_equal(domain.launches(10)[0], v_norm[:10])


def test_rows(found):
    rows = {(row.family, row.domain): row for row in found.rows}
    assert len(rows) == len(found.rows) == 7
    assert all(row.microseconds > 0 for row in found.rows)
    assert all(row.over(row) == 1 for row in found.rows)
    assert all(row.largest < 2e-15 for row in found.rows if row.family == speed.ENGINE)
    mixed = speed.MIXED.name
    assert rows[speed.SOLVE_IVP, mixed].largest < 2e-9
    counts = [rows[way, mixed].launches for way in (speed.ENGINE, speed.SOLVE_IVP)]
    assert counts == [40, 3]


def test_over_is_the_median_of_the_ratios_within_a_round(found):
    row = found.rows[0]
    one = replace(row, rounds={0: 2.0, 1: 30.0, 3: 8.0})
    other = replace(row, rounds={0: 1.0, 1: 10.0, 2: 5.0, 3: 1.0})
    assert one.over(other) == 3.0


def test_targets(found):
    (unmeasured,) = (target for target in found.targets if target.met is None)
    assert len(found.targets) == 4
    assert "diffrax" in unmeasured.what


@pytest.mark.parametrize(("value", "most", "least"), [(2.0, True, False), (3.0, True, True),
                                                      (150.0, False, True)])  # fmt: skip
def test_a_target_is_met_or_missed(value, most, least):
    assert targets.at_most("a figure", 3, value).met is most
    assert targets.at_least("a figure", 3, value).met is least
    assert targets.at_most("a figure", 3, math.nan).met is None
    assert float(targets.at_most("a figure", 3, value).measured) == value


def test_speed_table(found):
    text = speed.speed_table(found)
    assert all(f"{row.family}, {row.domain}" in text for row in found.rows)
    assert text.count("not measured") == 1
    assert "nan" not in text
    assert max(map(len, text.splitlines())) <= 110


def test_bench_speed(run, found, tmp_path, monkeypatch):
    monkeypatch.setattr(speed, "measure", lambda: found)
    argv = ["bench", "speed"]
    assert run(*argv) == (0, speed.speed_table(found), "")
    target = tmp_path / "new" / "speed.csv"
    code, out, err = run(*argv, "--out", target.parent)
    assert (code, err) == (0, f"hodograph: wrote {target}\n")
    rows = csv_rows(target.read_text("utf-8"))
    assert [(row["way"], row["domain"]) for row in rows] == [
        (row.family, row.domain) for row in found.rows
    ]
    assert float(rows[0]["microseconds"]) == pytest.approx(found.rows[0].microseconds, rel=1e-3)

    monkeypatch.setattr(speed, "measure", None)
    code, out, err = run(*argv, "--out", target.parent)
    assert (code, out) == (1, "")
    assert "--force" in err
