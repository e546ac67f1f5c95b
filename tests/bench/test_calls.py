"""One launch a call: what is measured, and how it is told.  Nothing here asserts a time."""

import math
import re
import sys
from dataclasses import replace

import pytest
from helpers import DATA, ROOT
from matplotlib.text import Text

from hodograph.bench import by_size, calls, measurement, ways
from hodograph.bench import work_precision as look
from hodograph.report.tables import csv_rows

TINY = measurement.Sizes(each=5, few=0, checked=5, seconds=1e-3, rounds=1)
COUNTS = (1, 3, 400)
DOMAINS = [where.name for where in measurement.DOMAINS]


@pytest.fixture(scope="module")
def found():
    return calls.measure(TINY, counts=COUNTS, remembered=False)


def largest(found, family, setting, domain="paper"):
    (row,) = (
        row
        for row in found.rows
        if (row.domain, row.family, row.setting) == (domain, family, setting)
    )
    return row.largest


@pytest.mark.parametrize("domain", DOMAINS)
def test_errors_stand_in_their_order(found, domain):
    exact = largest(found, ways.TIER, ways.EXACT, domain)
    assert exact < 3e-15
    assert exact <= largest(found, ways.QUAD, "rtol=1e-13", domain) < 1e-12
    assert largest(found, ways.QUAD, "rtol=1e-13", domain) < largest(
        found, ways.QUAD, "rtol=1e-06", domain
    )
    dop853 = largest(found, "solve_ivp DOP853", "rtol=1e-10", domain)
    assert exact < dop853 < 1e-8 < 1e-6 < largest(found, calls.DEFAULTS, ways.DEFAULTS, domain)


@pytest.mark.parametrize("domain", DOMAINS)
@pytest.mark.parametrize("rtol", ways.TOLERANCES_ALONE)
def test_one_call_keeps_its_promise(found, domain, rtol):
    assert 0 < largest(found, ways.DIAL, f"rtol={rtol:.0e}", domain) <= rtol


def test_paper_answers_its_own_launches(found):
    assert 1e-12 < largest(found, ways.PAPER, "") < 1e-4
    (wide,) = (row for row in found.rows if (row.domain, row.family) == ("wide", ways.PAPER))
    assert wide.failed > 0


def test_ballisticcalc_gets_better_with_shorter_steps(found):
    pytest.importorskip("py_ballisticcalc_exts", reason="it comes with the extra `bench`")
    family = ways.BALLISTICCALC["rk4"]
    errors = [largest(found, family, f"{steps} steps") for steps in ways.STEPS]
    assert errors == sorted(errors, reverse=True)
    assert largest(found, ways.TIER, ways.EXACT) < errors[-1]


def test_all_is_measured(found):
    assert all(row.microseconds > 0 for row in found.rows)
    assert [(cost.setting, cost.launches) for cost in found.costs] == [
        (name, count) for name in by_size.DIALS for count in COUNTS
    ]
    assert all(cost.microseconds > 0 and math.isnan(cost.megabytes) for cost in found.costs)
    absent = {
        (question, n) for question, row in found.asked.items() for n in row if math.isnan(row[n])
    }
    assert absent == {("laws.d_norm_law", "n=1"), ("laws.d_norm_law", "n=3")}


def point(family, setting, microseconds, error, general=True):
    return measurement.Measurement(
        "paper", family, setting, microseconds, error, error, 0.0, 5, general, math.inf,
        {0: microseconds},
    )  # fmt: skip


def test_ahead_is_against_no_larger_an_error():
    exact, loose = (
        point(ways.TIER, ways.EXACT, 20.0, 1e-15),
        point(ways.DIAL, "rtol=1e-03", 2.0, 1e-4),
    )
    rough, fine = point("other", "rough", 50.0, 1e-3), point("other", "fine", 80.0, 1e-13)
    assert calls.ahead([exact, loose, rough], ["other"]) == 25
    assert calls.ahead([exact, loose, rough, fine], ["other"]) == 4  # where it is least
    assert calls.ahead([exact, loose, rough], ["other"], [ways.TIER]) == 2.5  # as for exact answers
    assert calls.ahead([exact, loose, replace(fine, largest=1e-16)], ["other"]) == 0
    assert math.isnan(calls.ahead([exact, replace(rough, general=False)], ["other"]))


def test_without_the_packages_nothing_is_said_of_them(monkeypatch):
    monkeypatch.setitem(sys.modules, "py_ballisticcalc_exts", None)
    families = {way.family for way in ways.ways_alone(3)}
    assert not families & set(ways.BALLISTICCALC.values())
    assert families <= set(look.STYLES)


def test_calls_table(found):
    text = calls.calls_table(found)
    assert all(measurement.domain_words(name) in text for name in DOMAINS)
    for name in DOMAINS:
        for words in ("no larger an error", "exact"):
            assert f"{name}: times ahead of quad + Newton, {words}" in text
    assert all(word in text for word in ("launches a call", "optimal_angle", "400", "MB"))
    assert "nan" not in text
    assert max(map(len, text.splitlines())) <= 110


def test_calls_figure(found):
    drawn = calls.figure(
        replace(found, costs=[cost._replace(megabytes=7.0) for cost in found.costs])
    )
    assert len(drawn.axes) == 2
    drawn.draw_without_rendering()
    texts = [text for text in drawn.findobj(Text) if text.get_text()]
    assert min(text.get_fontsize() for text in texts if text.get_visible()) >= 6
    assert any(text.get_text() == "exact, 7 MB" for text in texts)
    (key,) = drawn.legends
    box = key.get_window_extent()
    assert box.x0 >= 0
    assert box.x1 <= drawn.bbox.width


@pytest.mark.parametrize("quick", [True, False])
def test_bench_calls(run, found, tmp_path, monkeypatch, quick):
    asked = {}

    def measure(**options):
        asked.update(options)
        return found

    monkeypatch.setattr(calls, "measure", measure)
    argv = ["bench", "calls", "--out", tmp_path, *(["--quick"] if quick else [])]
    code, out, err = run(*argv)
    assert (code, out) == (0, calls.calls_table(found))
    assert max(asked["counts"]) == (10**5 if quick else 10**7)
    assert err.count("wrote") == len(calls.FILES)
    assert {path.name for path in tmp_path.iterdir()} == set(calls.FILES)
    rows = csv_rows((tmp_path / "calls.csv").read_text("utf-8"))
    assert [(row["domain"], row["way"]) for row in rows] == [
        (row.domain, row.family) for row in found.rows
    ]
    sizes = csv_rows((tmp_path / "calls_by_size.csv").read_text("utf-8"))
    assert [row["launches"] for row in sizes] == 3 * ["1", "3", "400"]

    monkeypatch.setattr(calls, "measure", None)  # refused before it is called
    code, out, err = run(*argv)
    assert (code, out) == (1, "")
    assert "--force" in err


def test_readme_says_what_was_measured():
    rows = csv_rows((DATA / "calls.csv").read_text("utf-8"))
    own = {
        row["setting"]: float(row["microseconds"])
        for row in rows
        if row["domain"] == "paper" and row["way"] in calls.OWN
    }
    said = re.search(
        r"one launch a call takes (\S+) µs, and (\S+) µs", (ROOT / "README.md").read_text("utf-8")
    )
    measured = own[ways.EXACT], own["rtol=1e-08"]
    assert [float(f"{time:.2g}") for time in measured] == [float(word) for word in said.groups()]
