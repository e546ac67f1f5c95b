"""The exercise: its numbers, its files, its page, and what it refuses."""

import json
import re
import time
from html.parser import HTMLParser

import numpy as np
import pytest

from hodograph.cli import commands as cli
from hodograph.exercise import comments as exercise_comments
from hodograph.exercise import figures as exercise_figures
from hodograph.exercise import quadratic as exercise_quadratic
from hodograph.exercise import report as exercise_report
from hodograph.exercise import results as exercise_results
from hodograph.exercise import scene as exercise_scene
from hodograph.exercise import sections as exercise
from hodograph.launch import Launch
from hodograph.paper import figures
from hodograph.steppers import FIXED

ASKED_FOR = {
    "euler_graphe1.pdf",
    "cromer_graphe1.pdf",
    "rk2_graphe1.pdf",
    "scipy_graphe1.pdf",
    "impact.pdf",
    "comparaison_convergence.pdf",
    "energie.pdf",
    "quadratique.pdf",
    "figure_1.pdf",
    "report.html",
    "results.json",
}
ANSWERS = [
    value
    for name, value in vars(exercise_comments).items()
    if callable(value)
    and getattr(value, "__module__", "") == exercise_comments.__name__
    and not name.startswith("_")
    and name != "listed"
]


def coarse(patch):
    """The same exercise with longer steps and a wider limit."""
    patch.setattr(exercise, "DT", 0.01)
    patch.setattr(exercise_quadratic, "DT", 0.01)
    patch.setattr(exercise, "REFERENCE_DT", 0.01)
    patch.setattr(exercise_scene, "TOLERANCE", 2.0)
    patch.setattr(exercise_scene, "MOST", 45)


@pytest.fixture(scope="module")
def heard():
    return []


@pytest.fixture(scope="module")
def found(heard):
    with pytest.MonkeyPatch.context() as patch:
        coarse(patch)
        return exercise.work(heard.append)


@pytest.fixture(scope="module")
def made(found, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run") / "new" / "exercise"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(exercise_report, "work", lambda progress: found)
        exercise_report.carry_out(folder)
    return folder


# --- the numbers --------------------------------------------------------------------------


def test_constants_are_the_exercise_s():
    scene = exercise_scene
    assert (scene.MASSE, scene.DT, scene.V0, scene.G) == (1, 0.001, 70, 9.81)
    assert (scene.ETA, scene.LAMBDA, exercise.FIGURE_LAMBDA) == (0.01, 0.1, 0.001)
    assert (scene.DELTA_1, scene.RATIO, scene.TOLERANCE) == (1.0, 1.1, 0.1)
    assert scene.DEGREES.tolist() == list(range(91))
    assert exercise.REFERENCE_DT == 0.0001
    assert exercise.ENERGY_DT == 0.075
    assert np.rad2deg(exercise.ENERGY_ANGLE) == pytest.approx(60)


def test_launches_are_the_exercise_s():
    linear, square = exercise_scene.launch(0.7, 0.01), exercise_scene.launch(0.7, 0.1, 2)
    assert linear.v_lim == pytest.approx(981)
    assert square.v_lim == pytest.approx(np.sqrt(98.1))
    assert (linear.n, square.n) == (1, 2)
    assert np.isinf(exercise_scene.launch(0.7, 0.0).v_lim)


@pytest.mark.parametrize(
    ("method", "off"), [("euler", 0.05), ("euler_cromer", 0.06), ("rk2", 2e-7), ("dopri5", 1e-10)]
)
def test_trajectories(method, off):
    with_drag, without = exercise.paths(method)
    assert without.exact == pytest.approx(70**2 / 9.81)
    assert with_drag.exact == pytest.approx(467.760657520506, rel=1e-12)
    for path in (with_drag, without):
        assert path.off < off
        assert path.flight.impact.x == pytest.approx(path.exact, abs=1.1 * off)
        assert 0 <= path.flight.impact.x - path.flight.impact_naive.x < 0.0496


def test_impact_against_angle():
    run = exercise.impacts()
    assert run.best == 44
    assert run.best_exact == pytest.approx(44.0674803, rel=1e-8)
    assert np.all(run.tab_rk2_impact <= run.interpolated)
    assert np.max(np.abs(run.interpolated - run.exact)) < 1e-6
    assert 0.015 < np.mean(run.exact - run.tab_rk2_impact) < 0.03


def test_loop_of_6_6(found):
    """The interpolated error falls with the order; the naive one is that of the cut."""
    for run in found.loops:
        order = FIXED[run.method].order
        assert run.order("interpolated") == pytest.approx(order, abs=0.02)
        assert run.order("naive") == pytest.approx(1, abs=0.1)
        for reference in exercise_scene.REFERENCES:
            for impact in exercise_scene.IMPACTS:
                error = run.errors[impact, reference]
                assert np.all(error[-3:] < 2.0)
                end = run.reached(impact, reference)
                assert end.error < 2.0
                assert np.all(error[: end.n - 1] >= 2.0)
                assert end.delta == pytest.approx(1.1**-end.n)
    by_name = {run.method: run.reached("interpolated", "exact").n for run in found.loops}
    assert by_name["rk2"] == by_name["rk4"] == 1 < by_name["euler"]


def test_a_limit_that_is_not_reached(monkeypatch):
    monkeypatch.setattr(exercise_scene, "MOST", 4)
    scene = exercise_scene.launch(np.deg2rad(exercise_scene.DEGREES), 0.01)
    run = exercise_scene.convergence("euler", scene, {"exact": scene.range()})
    assert run.n.tolist() == [1, 2, 3, 4]
    assert run.reached("naive", "exact") is None
    assert exercise_results._short(run, "naive", "exact") == "n > 4"
    assert "no n up to 4 for Euler" in exercise_comments._end(run, "naive", "exact")
    assert exercise_results._loop(run)["naive_against_exact"]["n"] is None
    assert "&gt; 4" in exercise_report._loops_table([run], ("exact",), "Here")


def test_a_small_error_by_luck_does_not_end_the_loop(monkeypatch):
    """The loop goes on until three in a row are below; the first of them is not hidden."""
    monkeypatch.setattr(exercise_scene, "TOLERANCE", 3.0)
    scene = exercise_scene.launch(np.deg2rad(exercise_scene.DEGREES), 0.01)
    run = exercise_scene.convergence("rk4", scene, {"exact": scene.range()})
    assert len(run.n) >= run.reached("naive", "exact").n + 2


def test_energies():
    runs = {run.method: run for run in exercise.energies()}
    for method, sign in (("euler", 1), ("euler_cromer", -1), ("rk2", 0), ("rk4", 0)):
        run = runs[method]
        np.testing.assert_allclose(run.total, run.kinetic + run.potential)
        assert run.total[0] == pytest.approx(2450)
        assert run.power == pytest.approx(sign * 9.81**2 * 0.075 / 2, abs=1e-9)
        assert run.gain == pytest.approx(sign * 9.81**2 * 0.075 / 2 * run.t[-1], abs=1e-9)
        assert run.shadow < 1e-10
        assert np.all(run.potential >= 0)


def test_quadratic(found):
    run = found.quadratic
    assert run.exact == pytest.approx(float(Launch(70, np.pi / 4, np.sqrt(98.1)).range()))
    assert run.v_lim == pytest.approx(9.9045444)
    for order, balance in zip(run.orders, run.balances, strict=True):
        expected = FIXED[order.method].order
        assert order.slopes[1] == pytest.approx(expected, abs=0.15)
        assert order.slopes[0] == pytest.approx(1, abs=0.2)
        assert balance.order == pytest.approx(expected, abs=0.1)
        assert np.max(np.abs(balance.residual)) < 3 * balance.largest[0]
    for fall in run.falls:
        assert np.max(np.abs(fall.off)) < 2e-9
    assert run.weak.loss[-1] == pytest.approx(run.weak.loss_limit, rel=1e-5)
    assert run.weak.by_rk4 == pytest.approx(run.weak.exact, rel=1e-6)


def test_no_method_lands_from_beyond_its_largest_step(found):
    scene = exercise_scene.launch(np.pi / 4, 0.1, 2)
    for method, largest in found.quadratic.largest_steps.items():
        assert exercise_scene.steps(scene, method, 0.999 * largest).success
        assert not exercise_scene.steps(scene, method, 1.001 * largest).success


def test_slope():
    step = np.geomspace(1e-3, 1, 7)
    assert exercise_scene.slope(step, 5 * step**3) == pytest.approx(3)
    noise = np.array([np.nan, 1e-12, 1, 1, 1, 1, 1])
    assert exercise_scene.slope(step, noise) == pytest.approx(0, abs=1e-12)
    assert np.isnan(exercise_scene.slope(step, 1e-12 * step))


# --- the files ----------------------------------------------------------------------------


@pytest.mark.slow
def test_every_file_is_there_and_whole(made):
    names = {path.name for path in made.iterdir()}
    assert names == set(exercise_report.FILES)
    assert names >= ASKED_FOR
    for name in names:
        content = (made / name).read_bytes()
        if name.endswith(".pdf"):
            assert name.replace(".pdf", ".png") in names
            assert content.startswith(b"%PDF")
            assert b"CreationDate" not in content
        elif name.endswith(".png"):
            assert content.startswith(b"\x89PNG")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["impact", "energie"])
def test_the_same_findings_give_the_same_bytes(made, found, name):
    picture = exercise_report.PICTURES[name]
    assert figures.png(picture.draw(found)) == (made / f"{name}.png").read_bytes()
    assert figures.pdf(picture.draw(found)) == (made / f"{name}.pdf").read_bytes()
    assert exercise_results.results_json(found).encode() == (made / "results.json").read_bytes()


@pytest.mark.slow
def test_results_can_be_read_by_any_program(made, found):
    def refuse(word):
        raise AssertionError(f"{word} is no JSON")

    content = json.loads((made / "results.json").read_text(), parse_constant=refuse)
    assert content["6.5"]["best_exact_deg"] == found.impacts.best_exact
    assert len(content["6.5"]["tab_rk2_impact_m"]) == 91
    methods = content["6.6"]["methods"]
    assert [row["method"] for row in methods] == list(FIXED)
    assert methods[0]["naive_against_scipy"]["n"] == found.loops[0].reached("naive", "scipy").n
    assert len(content["6.3_and_6.4"]) == 8
    # A step too large for the drag has no error, and says so.
    assert content["6.8"]["loop_of_6.6"][0]["naive_against_exact"]["errors_m"][0] is None


class Page(HTMLParser):
    void = frozenset({"meta", "br", "img"})

    def __init__(self):
        super().__init__()
        self.open, self.tags = [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in self.void:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.mark.slow
def test_page(made):
    text = (made / "report.html").read_text(encoding="utf-8")
    page = Page()
    page.feed(text)
    page.close()
    assert page.open == []
    images = [attrs for tag, attrs in page.tags if tag == "img"]
    assert len(images) == len(exercise_report.PICTURES)
    assert all(image["alt"] and image["src"].startswith("data:") for image in images)
    assert "http" not in re.sub(r"base64,[^\"]*", "", text)
    places = [text.index(f"<h2>6.{number}") for number in range(3, 9)]
    assert places == sorted(places)


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda answer: answer.__name__)
def test_answers_are_sentences_with_numbers(answer, found):
    paragraphs = answer(found)
    assert paragraphs
    assert any(character.isdigit() for character in " ".join(paragraphs))
    for paragraph in paragraphs:
        assert paragraph.endswith(".")
        assert not re.search(r"\bnan\b|\binf\b|None|  ", paragraph)
    text = (exercise_report.text(paragraph) for paragraph in paragraphs)
    assert all(paragraph for paragraph in text)


def test_answers_follow_the_numbers(found):
    energy = " ".join(exercise_comments.energy(found))
    for run in found.energies[:2]:
        assert f"{abs(run.gain):.2f} J" in energy
    loop = " ".join(exercise_comments.convergence(found))
    for run in found.loops:
        assert f"n = {run.reached('naive', 'scipy').n}, " in loop
    reversed_runs = [run._replace(gain=-run.gain) for run in found.energies]
    energy = " ".join(exercise_comments.energy(found._replace(energies=reversed_runs)))
    assert "Euler loses" in energy
    assert "Euler-Cromer gains" in energy


def test_summary(found):
    lines = exercise_results.summary(found).splitlines()
    assert [line.split()[0] for line in lines[2:6]] == ["Euler", "Euler-Cromer", "RK2", "RK4"]
    assert max(map(len, lines)) <= 80
    assert "44.067" in lines[-1]


def test_progress(found, heard):
    for section in ("6.3", "6.5", "6.6", "6.7", "6.8"):
        assert any(message.startswith(section) for message in heard)
    assert all("\n" not in message and len(message) < 60 for message in heard)


def test_figures_are_legible(found):
    for picture in exercise_report.PICTURES.values():
        figure = picture.draw(found)
        assert figure.get_size_inches()[0] == pytest.approx(16 / 2.54)
        for text in figure.findobj(lambda artist: hasattr(artist, "get_fontsize")):
            assert not text.get_text() or text.get_fontsize() >= exercise_figures.TEXT


# --- what is refused ----------------------------------------------------------------------


@pytest.fixture
def no_work(monkeypatch):
    def refuse(progress):
        raise AssertionError("computed before refusing")

    monkeypatch.setattr(exercise_report, "work", refuse)


def test_existing_files_are_kept(tmp_path, no_work):
    (tmp_path / "energie.pdf").write_text("mine")
    with pytest.raises(FileExistsError, match=r"energie\.pdf"):
        exercise_report.carry_out(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["energie.pdf"]


def test_folders_in_the_way(tmp_path, no_work):
    (tmp_path / "report.html").mkdir()
    with pytest.raises(OSError, match=r"report\.html"):
        exercise_report.carry_out(tmp_path, force=True)
    (tmp_path / "file").write_text("")
    with pytest.raises(NotADirectoryError):
        exercise_report.carry_out(tmp_path / "file" / "exercise")


def test_command(found, tmp_path, monkeypatch, capsys):
    def work(progress):
        progress("6.3 at work")
        return found

    monkeypatch.setattr(exercise_report, "work", work)
    for kind in ("png", "pdf"):
        monkeypatch.setattr(exercise_report, kind, lambda figure: b"")
    out = tmp_path / "exercise"
    assert cli.main(["exercise", "--out", str(out)]) == 0
    said = capsys.readouterr()
    assert said.out == exercise_results.summary(found) + "\n"
    assert "hodograph: 6.3 at work\n" in said.err
    assert {path.name for path in out.iterdir()} == set(exercise_report.FILES)
    assert cli.main(["exercise", "--out", str(out)]) == 1
    assert capsys.readouterr().err.count("\n") == 1
    assert cli.main(["exercise", "--out", str(out), "--force"]) == 0


@pytest.mark.slow
def test_the_whole_exercise(tmp_path):
    start = time.perf_counter()
    found = exercise_report.carry_out(tmp_path)
    assert time.perf_counter() - start < 180
    table = {
        run.method: [run.reached(*key).n for key in run.errors]
        + [round(run.order("naive"), 1), round(run.order("interpolated"), 2)]
        for run in found.loops
    }
    assert table == {
        "euler": [57, 57, 64, 64, 1.0, 1.0],
        "euler_cromer": [68, 69, 64, 64, 1.0, 1.0],
        "rk2": [56, 56, 2, 2, 1.0, 2.0],
        "rk4": [56, 56, 1, 1, 1.0, 4.0],
    }
    assert found.reference.mean_off == pytest.approx(0.001836, rel=1e-3)
    assert found.reference.mean_off_interpolated < 1e-10
    ends = [run.reached("interpolated", "exact").n for run in found.quadratic.loops]
    assert ends == [56, 69, 36, 24]
