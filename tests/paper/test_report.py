"""`reproduce`: what it writes and finds, what it refuses, what an interruption leaves."""

import base64
import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from helpers import Page
from matplotlib.figure import Figure

from hodograph import _files as files
from hodograph.paper import report
from hodograph.paper.verdict import Verdict

NAMES = sorted(
    [f"figure_{n}.{kind}" for n in (*range(1, 7), "didion") for kind in ("png", "pdf")]
    + ["table_1.csv", "verdicts.json", "report.html"]
)
FAILING = {"law_error"}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A whole run: folder, verdicts, messages."""
    folder = tmp_path_factory.mktemp("run") / "new" / "reproduction"
    with pytest.MonkeyPatch.context() as patch:
        heard = []
        patch.setattr(report.log, "info", lambda words, *parts: heard.append(words % parts))
        verdicts = report.reproduce(folder)
    return folder, verdicts, heard


@pytest.fixture
def quick(monkeypatch):
    """A run that computes next to nothing."""
    verdict = Verdict("one", "eq. 1", "1 < 2 & <b>", "2", "It's 2 %.", "here", True)
    figures = tuple(
        report._Figure(name, "", lambda: Figure(figsize=(1, 1)), "caption <", 'alt "')
        for name in [figure.name for figure in report.FIGURES]
    )
    monkeypatch.setattr(report, "FIGURES", figures)
    monkeypatch.setattr(report, "judge", lambda: [verdict])
    monkeypatch.setattr(report, "table_1_csv", lambda: "a,b\n")
    monkeypatch.setattr(report, "_table_1", lambda: "<table></table>")
    return verdict


@pytest.fixture
def no_computation(monkeypatch):
    def refuse():
        raise AssertionError("computed before refusing")

    monkeypatch.setattr(report, "judge", refuse)
    monkeypatch.setattr(report.style, "files", lambda *_: refuse())


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


# --- what it writes ---


@pytest.mark.slow
def test_every_file_is_there_and_whole(made):
    folder, _, _ = made
    found = contents(folder)
    assert sorted(found) == NAMES
    for name, content in found.items():
        if name.endswith(".png"):
            assert content.startswith(b"\x89PNG")
            assert b"IEND" in content[-12:]
        elif name.endswith(".pdf"):
            assert content.startswith(b"%PDF")
            assert content.rstrip().endswith(b"%%EOF")
            assert b"CreationDate" not in content


@pytest.mark.slow
def test_progress_names_each_figure(made):
    _, _, heard = made
    for number in range(1, 8):
        assert f"figure {number} of 7" in heard
    assert all("\n" not in message and len(message) < 60 for message in heard)


@pytest.mark.slow
def test_json_holds_what_was_returned(made):
    folder, verdicts, _ = made
    rows = json.loads((folder / "verdicts.json").read_text(encoding="utf-8"))
    assert rows == [verdict.to_dict() for verdict in verdicts]
    assert len({row["id"] for row in rows}) == len(rows) >= 25
    by_id = {row["id"]: row for row in rows}
    assert by_id["law_error"]["holds"] is False
    assert by_id["alpha_max_error"]["holds"] is True


@pytest.mark.slow
def test_table_1_has_the_printed_numbers_beside_ours(made):
    folder, _, _ = made
    lines = (folder / "table_1.csv").read_text(encoding="utf-8").splitlines()
    head = [line for line in lines if line.startswith("#")]
    assert "Table 1" in head[0]
    assert any("hodograph reproduce" in line for line in head)
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    printed = {
        ("K", "a0"): 0.24207,
        ("K", "a1"): 1.56854,
        ("K", "a2"): -1.16548,
        ("K", "a3"): 0.26454,
        ("M", "a0"): 0.675688,
        ("M", "a1"): 0.046397,
        ("M", "a2"): 0.031539,
    }
    assert len(rows) == 3 * len(printed)
    for row in rows:
        value = printed[row["parameter"], row["coefficient"]]
        assert float(row["paper"]) == value
        off = float(row["relative_difference"])
        assert float(row["ours"]) == pytest.approx(value * (1 + off), rel=1e-4)
        if row["fit"] == "stop at 0.01 rad":
            assert abs(off) < (2e-4 if row["parameter"] == "K" else 2e-3)
            assert (row["alpha0_min_deg"], row["alpha0_max_deg"]) == ("10", "80")
        assert row["v_norm_max"] == "1.5"


@pytest.mark.slow
def test_page_is_complete_and_needs_nothing_from_outside(made):
    folder, verdicts, _ = made
    text = (folder / "report.html").read_text(encoding="utf-8")
    page = Page(text)
    assert text.startswith("<!DOCTYPE html>")
    assert page.all("html") == [{"lang": "en"}]
    assert {"charset": "utf-8"} in page.all("meta")
    assert len(page.all("title")) == len(page.all("h1")) == 1
    assert len(page.all("h2")) >= 3
    assert not {"script", "link", "iframe", "object"} & {tag for tag, _ in page.tags}
    assert "@media print" in text
    assert "url(" not in text
    assert "@import" not in text
    for _, attrs in page.tags:
        assert attrs.get("href", "#").startswith("#")
        assert attrs.get("src", "data:").startswith("data:")
    images = page.all("img")
    assert len(images) == 7
    for name, image in zip((*range(1, 7), "didion"), images, strict=True):
        assert len(image["alt"]) > 40
        data = base64.b64decode(image["src"].removeprefix("data:image/png;base64,"))
        assert data == (folder / f"figure_{name}.png").read_bytes()
    words = "".join(page.words)
    for verdict in verdicts:
        assert "".join(Page(report.symbols(verdict.measured)).words) in words
    assert words.count("holds") >= sum(bool(verdict.holds) for verdict in verdicts)
    assert "1.56854" in words
    ids = {attrs["id"] for _, attrs in page.tags if "id" in attrs}
    assert {attrs["href"][1:] for attrs in page.all("a")} <= ids
    assert ids >= {verdict.id for verdict in verdicts}
    # each figure stands right behind the claim that it carries
    order = [attrs["id"] for tag, attrs in page.tags if tag in ("article", "figure")]
    for figure in report.FIGURES:
        assert order[order.index(figure.name) - 1] == figure.beside
    top = words[words.index("1 fails") : words.index("Contents")]
    assert top.index("fails") < top.index("hold") < top.index("not claimed")


def test_symbols_are_set_as_symbols():
    assert report.symbols("v_lim²/g") == "<i>v</i><sub>lim</sub>²/g"
    assert report.symbols("alpha0, alpha_s") == "<i>α</i><sub>0</sub>, <i>α</i><sub>s</sub>"
    assert report.symbols("less than 1e-12") == "less than 10<sup>-12</sup>"
    assert report.symbols("2.7e-03") == "2.7×10<sup>-3</sup>"


def test_page_escapes_its_text(quick, tmp_path):
    report.reproduce(tmp_path)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    page = Page(text)
    assert "1 &lt; 2 &amp; &lt;b&gt;" in text
    assert "It&#x27;s 2&nbsp;%." in text
    assert page.all("b") == []
    assert page.all("img")[0]["alt"] == 'alt "'


@pytest.mark.slow
def test_table_for_the_terminal(made):
    _, verdicts, _ = made
    lines = report.verdict_table(verdicts).splitlines()
    assert max(map(len, lines)) <= 100
    assert all(line == line.rstrip() for line in lines)
    outcomes = [
        line.split()[0] for line in lines if line.startswith(("holds", "fails", "not claimed"))
    ]
    assert len(outcomes) == len(verdicts)
    holds, fails = outcomes.count("holds"), outcomes.count("fails")
    assert lines[-1] == (
        f"{holds + fails} claims: {holds} hold, {fails} fails; "
        f"{len(verdicts) - holds - fails} not claimed, measured"
    )
    text = " ".join(" ".join(line[50:].split()) for line in lines)
    assert "0.012 %" in text


def test_table_with_something_not_claimed():
    rows = [
        Verdict("a", "1", "claim", "p", "found", "d", None),
        Verdict("b", "2", "claim", "p", "found", "d", False),
    ]
    text = report.verdict_table(rows, width=80)
    assert "not claimed 1 " in text
    assert text.endswith("1 claim: 1 fails; 1 not claimed, measured")


def test_prints_nothing(quick, tmp_path, capfd):
    report.reproduce(tmp_path)
    assert capfd.readouterr() == ("", "")


# --- what it finds ---


@pytest.mark.slow
def test_every_verdict_is_whole(made):
    _, verdicts, _ = made
    assert len({verdict.id for verdict in verdicts}) == len(verdicts) > 30
    for verdict in verdicts:
        row = verdict.to_dict()
        assert list(row) == ["id", "place", "claim", "paper", "measured", "domain", "holds"]
        assert all(isinstance(row[key], str) and row[key] for key in row if key != "holds")
        assert type(row["holds"]) in (bool, type(None))
        "".join(map(str, row.values())).encode("latin-1")  # what any terminal can print


@pytest.mark.slow
def test_what_fails_is_what_is_known_to_fail(made):
    _, verdicts, _ = made
    assert {verdict.id for verdict in verdicts if verdict.holds is False} == FAILING


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("v_lim", "42.717 m/s"),  # sqrt(9.81 / 0.005376)
        ("law_error", "0.45 %"),
        ("law_error", "-9.1 %"),
        ("alpha_max_error", "0.012 %"),
        ("law_error", "92 % of the grid"),
        ("drag_exponent", "3.4148"),
        ("ref_legendre", "+3.5 % to +4.0 %"),
        ("gaussian", "0.271/M"),  # 2 / e^2
        ("table_1_origin", "M within 0.0082 %"),
        ("newton_on_domain", "fails for 0 of 465"),
    ],
)
def test_sentences_carry_the_known_figures(made, name, words):
    _, verdicts, _ = made
    (found,) = [verdict for verdict in verdicts if verdict.id == name]
    assert words in found.measured


# --- what it refuses ---


@pytest.mark.parametrize("name", NAMES)
def test_an_existing_file_is_refused_before_computing(no_computation, tmp_path, name):
    (tmp_path / name).write_text("mine")
    with pytest.raises(FileExistsError, match=name):
        report.reproduce(tmp_path)
    assert contents(tmp_path) == {name: b"mine"}


def test_force_replaces_and_leaves_the_rest(quick, tmp_path):
    (tmp_path / "verdicts.json").write_text("old")
    (tmp_path / "notes.txt").write_text("mine")
    report.reproduce(tmp_path, force=True)
    assert json.loads((tmp_path / "verdicts.json").read_text())[0]["id"] == "one"
    assert (tmp_path / "notes.txt").read_text() == "mine"
    assert sorted(contents(tmp_path)) == sorted([*NAMES, "notes.txt"])


@pytest.mark.parametrize("below", ["", "deeper", "deeper/still"])
def test_a_path_through_a_file_is_refused_before_computing(no_computation, tmp_path, below):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(NotADirectoryError, match=r"Not a directory.*file"):
        report.reproduce(tmp_path / "file" / below)


def test_a_folder_in_place_of_a_file_is_refused_before_computing(no_computation, tmp_path):
    (tmp_path / "report.html").mkdir()
    with pytest.raises(IsADirectoryError, match=r"report\.html"):
        report.reproduce(tmp_path, force=True)


def test_a_folder_that_cannot_be_written_is_refused_before_computing(no_computation, tmp_path):
    tmp_path.chmod(0o555)
    try:
        if os.access(tmp_path, os.W_OK):
            pytest.skip("this user may write anywhere")
        with pytest.raises(PermissionError, match="Permission denied"):
            report.reproduce(tmp_path / "new")
    finally:
        tmp_path.chmod(0o755)


def test_a_file_system_that_cannot_be_written_is_refused(no_computation, tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(files.tempfile, "TemporaryFile", refuse)
    with pytest.raises(PermissionError, match="Permission denied"):
        report.reproduce(tmp_path / "new")
    assert not (tmp_path / "new").exists()


# --- what an interruption leaves ---


def test_interrupted_while_computing_nothing_is_left(quick, tmp_path, monkeypatch):
    def interrupt():
        raise KeyboardInterrupt

    monkeypatch.setattr(report, "judge", interrupt)
    with pytest.raises(KeyboardInterrupt):
        report.reproduce(tmp_path / "new")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("when", [1, 5, len(NAMES)])
def test_interrupted_while_writing_files_are_whole_or_absent(quick, tmp_path, monkeypatch, when):
    report.reproduce(tmp_path / "whole")
    whole = contents(tmp_path / "whole")
    replace, calls = os.replace, []

    def interrupted(*arguments):
        calls.append(arguments)
        if len(calls) == when:
            raise KeyboardInterrupt
        replace(*arguments)

    monkeypatch.setattr(files.os, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        report.reproduce(tmp_path / "cut")
    found = contents(tmp_path / "cut")
    assert len(found) == when - 1
    assert all(content == whole[name] for name, content in found.items())


# --- the same again ---


def test_quick_runs_give_the_same_bytes(quick, tmp_path):
    for name in ("one", "two"):
        report.reproduce(tmp_path / name)
    assert contents(tmp_path / "one") == contents(tmp_path / "two")


@pytest.mark.slow
def test_another_process_gives_the_same_bytes(made, tmp_path):
    folder, _, _ = made
    code = "import sys; from hodograph.paper.report import reproduce; reproduce(sys.argv[1])"
    environment = {**os.environ, "PYTHONHASHSEED": "7", "TZ": "Asia/Tokyo"}
    subprocess.run([sys.executable, "-c", code, str(tmp_path)], check=True, env=environment)
    assert contents(tmp_path) == contents(Path(folder))
