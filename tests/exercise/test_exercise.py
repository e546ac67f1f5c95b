"""The exercise: its numbers, its files, its page, and what it refuses."""

import ast
import json
import logging
import os
import re
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy as np
import pytest
from helpers import Page

from hodograph.cli import commands as cli
from hodograph.exercise import comments, programs, report, results, sections
from hodograph.exercise.convergence import IMPACTS, REFERENCES, convergence, slope
from hodograph.exercise.setup import Setup, steps
from hodograph.exercise.words import ENGLISH, LANGUAGES, Words
from hodograph.launch import Launch
from hodograph.report import style
from hodograph.report.tables import csv_rows
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
    "quadratique_impact.pdf",
    "figure_1.pdf",
    "balistique1.py",
    "balistique2.py",
    "balistique3.py",
    "trajectoires.csv",
    "energies.csv",
    "report.html",
    "results.json",
}
ANSWERS = [
    value
    for name, value in vars(comments).items()
    if callable(value)
    and getattr(value, "__module__", "") == comments.__name__
    and not name.startswith("_")
    and name != "ending"
]
COARSE = Setup(dt=0.01, reference_dt=0.01, limit=2.0, most=45)
FRENCH = Words("fr")


@pytest.fixture(scope="module")
def found():
    return sections.work(COARSE)


@pytest.fixture(scope="module")
def made(found, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run") / "new" / "exercise"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report, "work", lambda setup: found)
        report.carry_out(folder)
    return folder


# --- the numbers --------------------------------------------------------------------------


def test_constants_are_the_exercise_s():
    setup = Setup()
    assert (setup.mass, setup.dt, setup.v0, setup.g) == (1, 0.001, 70, 9.81)
    assert (setup.eta, setup.lambda_, setup.figure_lambda) == (0.01, 0.1, 0.001)
    assert (setup.delta_1, setup.ratio, setup.limit) == (1.0, 1.1, 0.1)
    assert setup.angles.tolist() == list(range(91))
    assert (setup.reference_dt, setup.energy_dt, setup.angle) == (0.0001, 0.075, 45)
    assert setup.energy_degrees == 60


def test_launches_are_the_exercise_s():
    setup = Setup()
    linear, square = setup.launch(0.7, 0.01), setup.launch(0.7, 0.1, 2)
    assert linear.v_lim == pytest.approx(981)
    assert square.v_lim == pytest.approx(np.sqrt(98.1))
    assert (linear.n, square.n) == (1, 2)
    assert np.isinf(setup.launch(0.7).v_lim)


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"mass": 0.0}, "mass must be finite and > 0"),
        ({"eta": np.nan}, "eta must be finite and > 0"),
        ({"lambda_": np.inf}, "lambda_ must be finite and > 0"),
        ({"angle": 90.0}, "angle must be below 90°; got 90°"),
        ({"v0": 5.0}, "v0 / g must be from 1 to 50 s"),
        ({"v0": 1000.0}, "v0 / g must be from 1 to 50 s"),
        ({"dt": 0.2}, "dt must be from"),
        ({"dt": 1e-6}, "dt must be from"),
        ({"lambda_": 100.0}, r"to 0.000143 s .* got 0.001 s"),
    ],
)
def test_setups_that_are_refused(change, word):
    with pytest.raises(ValueError, match=word) as refused:
        Setup(**change)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("method", "off"), [("euler", 0.05), ("euler_cromer", 0.06), ("rk2", 2e-7), ("dopri5", 1e-10)]
)
def test_trajectories(method, off):
    with_drag, without = sections.paths(Setup(), method)
    assert without.exact == pytest.approx(70**2 / 9.81)
    assert with_drag.exact == pytest.approx(467.760657520506, rel=1e-12)
    for path in (with_drag, without):
        assert path.off < off
        assert path.flight.impact.x == pytest.approx(path.exact, abs=1.1 * off)
        assert 0 <= path.flight.impact.x - path.flight.impact_naive.x < 0.0496


def test_impact_against_angle():
    run = sections.impacts(Setup(), "rk2", 0.01)
    assert run.best == 44
    assert run.best_exact == pytest.approx(44.0674803, rel=1e-8)
    assert run.best_fitted == pytest.approx(run.best_exact, abs=1e-3)
    assert np.all(run.naive <= run.interpolated)
    assert np.max(np.abs(run.interpolated - run.exact)) < 1e-6
    assert 0.015 < np.mean(run.exact - run.naive) < 0.03


def test_best_angles_with_quadratic_drag():
    assert sections.figure_1(Setup()).best == pytest.approx(42.6108, abs=1e-4)
    for method, off in (("euler", 0.02), ("euler_cromer", 0.06), ("rk2", 0.001)):
        run = sections.impacts(Setup(), method, 0.1, 2)
        assert run.best == 27
        assert run.best_exact == pytest.approx(27.09833, abs=1e-5)
        assert run.best_fitted == pytest.approx(run.best_exact, abs=off)


def test_loop_of_6_6(found):
    """The interpolated error falls with the order; the naive one is that of the cut."""
    for run in found.loops:
        order = FIXED[run.method].order
        assert run.order("interpolated") == pytest.approx(order, abs=0.02)
        assert run.order("naive") == pytest.approx(1, abs=0.1)
        for reference in REFERENCES:
            for impact in IMPACTS:
                error = run.errors[impact, reference]
                assert np.all(error[-3:] < 2.0)
                end = run.reached(impact, reference)
                assert end.error < 2.0
                assert np.all(error[: end.n - 1] >= 2.0)
                assert end.delta == pytest.approx(1.1**-end.n)
    by_name = {run.method: run.reached("interpolated", "exact").n for run in found.loops}
    assert by_name["rk2"] == by_name["rk4"] == 1 < by_name["euler"]


def test_a_limit_that_is_not_reached():
    setup = Setup(most=4)
    scene = setup.fan(0.01)
    run = convergence(setup, "euler", scene, {"exact": scene.range()})
    assert run.n.tolist() == [1, 2, 3, 4]
    assert run.reached("naive", "exact") is None
    assert results.reached(run, "naive", "exact", ENGLISH) == ("> 4", "–")
    assert "no n up to 4 for Euler" in comments.ending(run, "naive", "exact")
    assert results._plain(run)["reached"]["naive against exact"] is None
    assert "&gt; 4" in report._loops_table([run], ("exact",), "linear", setup, ENGLISH)


def test_a_small_error_by_luck_does_not_end_the_loop():
    """The loop goes on until three in a row are below; the first of them is not hidden."""
    setup = Setup(limit=3.0)
    scene = setup.fan(0.01)
    run = convergence(setup, "rk4", scene, {"exact": scene.range()})
    assert len(run.n) >= run.reached("naive", "exact").n + 2


def test_energies():
    runs = {run.method: run for run in sections.energies(Setup())}
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
    assert (run.fall.height, run.fall.dt) == (pytest.approx(100), (0.1, 0.01))
    assert np.max(np.abs(list(run.fall.by_method.values()))) < 2e-9
    assert run.weak.loss[-1] == pytest.approx(run.weak.loss_limit, rel=1e-5)
    assert run.weak.by_rk4 == pytest.approx(run.weak.exact, rel=1e-6)


def test_no_method_lands_from_beyond_its_largest_step(found):
    scene = Setup().launch(drag=0.1, n=2)
    for method, largest in found.quadratic.largest_steps.items():
        assert steps(scene, method, 0.999 * largest).success
        assert not steps(scene, method, 1.001 * largest).success


def test_slope():
    step = np.geomspace(1e-3, 1, 7)
    assert slope(step, 5 * step**3) == pytest.approx(3)
    noise = np.array([np.nan, 1e-12, 1, 1, 1, 1, 1])
    assert slope(step, noise) == pytest.approx(0, abs=1e-12)
    assert np.isnan(slope(step, 1e-12 * step))


# --- the files ----------------------------------------------------------------------------


@pytest.mark.slow
def test_every_file_is_there_and_whole(made):
    names = {path.name for path in made.iterdir()}
    assert names == set(report.FILES)
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
    figure = report.picture(name, found)
    assert style.png(figure) == (made / f"{name}.png").read_bytes()
    assert style.pdf(report.picture(name, found)) == (made / f"{name}.pdf").read_bytes()
    assert results.results_json(found).encode() == (made / "results.json").read_bytes()


@pytest.mark.slow
def test_results_can_be_read_by_any_program(made, found):
    def refuse(word):
        raise AssertionError(f"{word} is no JSON")

    content = json.loads((made / "results.json").read_text(), parse_constant=refuse)
    assert content["impacts"]["best_exact"] == found.impacts.best_exact
    assert len(content["impacts"]["naive"]) == 91
    assert [run["method"] for run in content["loops"]] == list(FIXED)
    end = content["loops"][0]["reached"]["naive against scipy"]
    assert (end["n"], end["delta"]) == found.loops[0].reached("naive", "scipy")[:2]
    assert list(content["paths"]) == [*sections.THREE, sections.SCIPY]
    # A step too large for the drag has no error, and says so.
    assert content["quadratic"]["loops"][0]["errors"]["naive against exact"][0] is None


def test_tables(found):
    texts = results.tables(found)
    assert tuple(texts) == report.TABLES
    path = [row for row in csv_rows(texts["trajectoires.csv"]) if row["method"] == "rk2"]
    flight = found.paths["rk2"][0].flight
    with_drag = [row for row in path if row["eta_kg_per_s"] == "0.01"]
    assert float(with_drag[-2]["x_m"]) == pytest.approx(float(flight.impact_naive.x))
    assert float(with_drag[-1]["y_m"]) < 0
    assert {row["lambda_kg_per_m"] for row in path} == {"0", "0.1"}
    energies = csv_rows(texts["energies.csv"])
    assert len(energies) == sum(len(run.t) for run in found.energies)
    for row in energies:
        parts = float(row["kinetic_J"]) + float(row["potential_J"])
        assert float(row["total_J"]) == pytest.approx(parts)
    distances = csv_rows(texts["portees.csv"])
    assert float(distances[45]["rk2_naive_m"]) == found.impacts.naive[45]
    assert all("hodograph exercise --dt 0.01" in text for text in texts.values())


@pytest.mark.slow
@pytest.mark.parametrize("language", LANGUAGES)
def test_page(made, found, language):
    contents = {path.name: path.read_bytes() for path in made.iterdir()}
    text = report.page(contents, found, Words(language))
    if language == "en":
        assert text == (made / "report.html").read_text(encoding="utf-8")
    page = Page(text)
    images = page.all("img")
    assert ("html", {"lang": language}) in page.tags
    assert len(images) == len(report.PICTURES)
    assert all(image["alt"] and image["src"].startswith("data:") for image in images)
    assert "http" not in re.sub(r"base64,[^\"]*", "", text)
    places = [text.index(f"<h2>6.{number}") for number in range(3, 9)]
    assert places == sorted(places)


@pytest.mark.parametrize("words", [ENGLISH, FRENCH], ids=LANGUAGES)
@pytest.mark.parametrize("answer", ANSWERS, ids=lambda answer: answer.__name__)
def test_answers_are_sentences_with_numbers(answer, words, found):
    paragraphs = list(answer(found, words))
    assert paragraphs
    assert any(character.isdigit() for character in " ".join(paragraphs))
    for paragraph in paragraphs:
        assert paragraph.endswith(".")
        assert not re.search(r"\bnan\b|\binf\b|None|  ", paragraph)


def test_answers_follow_the_numbers(found):
    energy = " ".join(comments.energy(found))
    for run in found.energies[:2]:
        assert f"{abs(run.gain):.2f} J" in energy
    loop = " ".join(comments.convergence(found))
    for run in found.loops:
        assert f"n = {run.reached('naive', 'scipy').n}, " in loop
    reversed_runs = [run._replace(gain=-run.gain) for run in found.energies]
    energy = " ".join(comments.energy(found._replace(energies=reversed_runs)))
    assert "Euler loses" in energy
    assert "Euler-Cromer gains" in energy


def test_languages_have_the_same_sentences():
    fields = re.compile(r"{(\w+):?[^}]*}")
    assert ENGLISH.sentences.keys() == FRENCH.sentences.keys()
    for key, sentence in ENGLISH.sentences.items():
        there = sorted(fields.findall(sentence))
        assert there == sorted(fields.findall(FRENCH.sentences[key])), key
    with pytest.raises(ValueError, match="language must be one of en, fr; got 'de'"):
        Words("de")


def test_numbers_in_french():
    assert FRENCH.number(12345.678, ",.2f") == "12\N{NO-BREAK SPACE}345,68"
    assert FRENCH.number(np.nan, ".2f") == ENGLISH.number(np.nan) == "–"
    assert FRENCH.listed(["1,5 m", "2 m"]) == "1,5 m et 2 m"
    assert FRENCH.listed(["1,5 m", "2 m", "3 m"]) == "1,5 m ; 2 m et 3 m"


@pytest.fixture(scope="module")
def another():
    """A heavier body on the moon, with another drag and angle."""
    setup = Setup(
        mass=2.0,
        v0=30.0,
        dt=0.02,
        eta=0.2,
        lambda_=0.05,
        angle=30.0,
        g=1.62,
        reference_dt=0.02,
        limit=1.0,
    )
    return sections.work(setup)


def test_everything_follows_the_setup(another):
    scene = Launch.from_drag(30.0, np.deg2rad(30), 0.05 / 2, g=1.62)
    assert another.quadratic.exact == pytest.approx(float(scene.range()))
    assert another.paths["rk2"][1].exact == pytest.approx(30**2 * np.sin(np.deg2rad(60)) / 1.62)
    assert another.energies[0].total[0] == pytest.approx(30**2)
    assert another.quadratic.weak.loss[-1] == pytest.approx(
        another.quadratic.weak.loss_limit, rel=1e-3
    )
    assert another.quadratic.weak.by_rk4 == pytest.approx(another.quadratic.weak.exact, rel=1e-4)
    for order in another.quadratic.orders:
        assert order.slopes[1] == pytest.approx(FIXED[order.method].order, abs=0.2)
    for balance in another.quadratic.balances:
        assert balance.order == pytest.approx(FIXED[balance.method].order, abs=0.15)
    assert np.max(np.abs(list(another.quadratic.fall.by_method.values()))) < 2e-9
    for run in another.quadratic_impacts:
        assert run.best_fitted == pytest.approx(run.best_exact, abs=0.5)
    assert results.command(another.setup, FRENCH) == (
        "hodograph exercise --mass 2 --v0 30 --dt 0.02 --eta 0.2 --lambda 0.05 --angle 30 "
        "--g 1.62 --lang fr"
    )


@pytest.mark.parametrize("words", [ENGLISH, FRENCH], ids=LANGUAGES)
def test_words_follow_the_setup(another, words):
    text = "\n".join(part for answer in ANSWERS for part in answer(another, words))
    for name in report.PICTURES:
        drawn = report.picture(name, another, words)
        text += "\n".join(artist.get_text() for artist in drawn.findobj(match=_has_text))
    text += report.page(dict.fromkeys((f"{n}.png" for n in report.PICTURES), b""), another, words)
    for stale in (
        "70 m/s",
        "0.001 s",
        "0,001 s",
        "with 45",
        "0.1 kg/m",
        "0,1 kg/m",
        "1 kg,",
        " nan",
    ):
        assert stale not in text, stale
    assert f"launch at {another.setup.angle:g}°" in text or words is FRENCH
    for there in ("30°, ", "2 kg", words("figures.eta", eta=0.2, x=201.41)[:16]):
        assert there in text


def _has_text(artist):
    return hasattr(artist, "get_text")


def test_summary(found):
    for words in (ENGLISH, FRENCH):
        lines = results.summary(found, words).splitlines()
        names = [line.split()[0] for line in lines[1:5]]
        assert names == ["Euler", "Euler-Cromer", "RK2", "RK4"]
        assert max(map(len, lines)) <= 96
        assert words.number(44.067) in lines[-2]
        assert words.number(27.098) in lines[-1]


def test_progress(caplog):
    caplog.set_level(logging.INFO, "hodograph")
    sections.work(Setup(dt=0.05, reference_dt=0.05, limit=20.0, most=5))
    for section in ("6.3", "6.5", "6.6", "6.7", "6.8"):
        assert any(message.startswith(section) for message in caplog.messages)
    assert all("\n" not in message and len(message) < 60 for message in caplog.messages)


@pytest.mark.parametrize("words", [ENGLISH, FRENCH], ids=LANGUAGES)
def test_figures_are_legible(found, words):
    for name in report.PICTURES:
        figure = report.picture(name, found, words)
        assert figure.get_size_inches()[0] == pytest.approx(16 / 2.54)
        figure.draw_without_rendering()
        for text in figure.findobj(lambda artist: hasattr(artist, "get_fontsize")):
            assert not text.get_text() or text.get_fontsize() >= style.TEXT
        whole = figure.bbox
        for axes in figure.axes:
            label = axes.yaxis.label.get_window_extent()
            assert label.y0 >= whole.y0
            assert label.y1 <= whole.y1


def test_the_graph_asked_for(found):
    """Three curves in one panel, against xmax_converge, each up to where its loop ends."""
    figure = report.picture("comparaison_convergence", found)
    assert len(figure.axes) == 1
    curves = [line for line in figure.axes[0].lines if len(line.get_xdata()) > 2]
    assert len(curves) == 3
    for line, run in zip(curves, found.loops, strict=False):
        end = run.reached("naive", "scipy")
        assert line.get_ydata().tolist() == run.errors["naive", "scipy"][: end.n].tolist()


# --- the programs -------------------------------------------------------------------------


def run_program(folder, name, *options):
    return subprocess.run(
        [sys.executable, "-W", "ignore", *options, name],
        cwd=folder,
        env={**os.environ, "MPLBACKEND": "Agg", "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        timeout=500,
    )


def arrays_of(folder, name):
    """The arrays of a program after it has run, by name."""
    runner = (
        f"import runpy, numpy as np; found = runpy.run_path('{name}'); "
        "np.savez('arrays.npz', **{key: value for key, value in found.items() "
        "if key.startswith('tab_') and isinstance(value, np.ndarray)}, "
        "n=[*found.get('tab_n', {}).values()], delta=[*found.get('tab_delta', {}).values()], "
        "**{f'total_{key}': value[3] for key, value in found.get('energies', {}).items()})"
    )
    (folder / "runner.py").write_text(runner)
    done = run_program(folder, "runner.py")
    assert done.returncode == 0, done.stderr
    with np.load(folder / "arrays.npz") as file:
        return dict(file), done.stdout


@pytest.fixture
def solved(found, tmp_path):
    """The programs, with the exercise's own constants in place of the coarse ones."""
    for name, text in programs.solved(found._replace(setup=Setup())).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def test_programs_are_as_asked(found):
    for name, text in programs.solved(found._replace(setup=Setup())).items():
        tree = ast.parse(text)
        assert "MASSE = 1.0 " in text
        assert "V0 = 70.0 " in text
        assert "DT = 0.001 " in text
        assert "@" not in text
        assert "#!" not in text
        assert max(map(len, text.splitlines())) <= 100
        modules = {
            (node.module if isinstance(node, ast.ImportFrom) else node.names[0].name).split(".")[0]
            for node in ast.walk(tree)
            if isinstance(node, ast.Import | ast.ImportFrom)
        }
        assert modules == {"numpy", "scipy", "matplotlib"}
        functions = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
        assert functions >= {"f1", "f2", "euler", "euler_cromer", "rk2"}
        if name == "balistique3.py":
            assert functions >= {"f1_quadra", "f2_quadra"}
            assert f"# n = {found.loops[0].reached('naive', 'scipy').n}, delta" in text
        within = [node for part in tree.body for node in ast.walk(part)]
        loops = [ast.unparse(node.test) for node in within if isinstance(node, ast.While)]
        assert "y >= 0" in loops
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                assert not any(isinstance(part, ast.While | ast.For) for part in ast.walk(node))


def test_balistique1_gives_the_library_s_numbers(solved):
    arrays, said = arrays_of(solved, "balistique1.py")
    for name, method in (
        ("euler", "euler"),
        ("cromer", "euler_cromer"),
        ("rk2", "rk2"),
        ("scipy", "dopri5"),
    ):
        flight = sections.paths(Setup(), method)[0].flight
        for letter, column in (("x", "x"), ("y", "y"), ("xp", "p"), ("yp", "q")):
            found = arrays[f"tab_{letter}_{name}"]
            np.testing.assert_allclose(found, getattr(flight, column), rtol=1e-9, atol=1e-9)
        assert f"{float(flight.impact_naive.x):.4f} m" in said
        assert (solved / f"{name}_graphe1.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.slow
def test_balistique2_gives_the_library_s_numbers(solved):
    arrays, said = arrays_of(solved, "balistique2.py")
    run = sections.impacts(Setup(), "rk2", 0.01)
    np.testing.assert_allclose(arrays["tab_rk2_impact"], run.naive, rtol=1e-9, atol=1e-9)
    assert "44°" in said
    assert (solved / "impact.pdf").exists()


@pytest.mark.slow
def test_balistique3_gives_the_library_s_numbers(solved):
    arrays, said = arrays_of(solved, "balistique3.py")
    assert arrays["n"].tolist() == [57, 68, 56]  # as `test_the_whole_exercise` has them
    assert arrays["delta"] == pytest.approx(1.1 ** -arrays["n"].astype(float))
    for name, method in (("euler", "euler"), ("cromer", "euler_cromer"), ("rk2", "rk2")):
        run = sections.impacts(Setup(), method, 0.1, 2)
        found = arrays[f"tab_{name}_impact_quadra"]
        np.testing.assert_allclose(found, run.naive, rtol=1e-9, atol=1e-9)
    energies = {run.method: run.total for run in sections.energies(Setup())}
    np.testing.assert_allclose(arrays["total_euler"], energies["euler"])
    np.testing.assert_allclose(arrays["total_cromer"], energies["euler_cromer"])
    assert "angle optimal 27." in said
    for name in ("comparaison_convergence", "energie", "quadratique_impact"):
        assert (solved / f"{name}.pdf").exists()


def test_tests_for_a_class(solved):
    """They fail on the blank programs, function by function, and pass on the solution."""
    blank = solved / "blank"
    report.for_students(blank)
    assert {path.name for path in blank.iterdir()} == {*programs.PROGRAMS, programs.TESTS}
    for name in programs.PROGRAMS:
        text = (blank / name).read_text(encoding="utf-8")
        ast.parse(text)
        assert "à compléter" in text
        assert "return -eta" not in text
        assert "mm trop loin" not in text
    failed = run_program(blank, programs.TESTS)
    assert failed.returncode == 1
    assert failed.stdout.count("ÉCHEC") == 6
    assert "réussi" not in failed.stdout
    (solved / programs.TESTS).write_bytes((blank / programs.TESTS).read_bytes())
    passed = run_program(solved, programs.TESTS)
    assert passed.returncode == 0, passed.stdout
    assert passed.stdout.count("réussi") == 6
    by_pytest = run_program(solved, programs.TESTS, "-m", "pytest", "-q", "-p", "no:cacheprovider")
    assert "6 passed" in by_pytest.stdout, by_pytest.stdout
    with pytest.raises(FileExistsError):
        report.for_students(blank)


# --- what is refused ----------------------------------------------------------------------


@pytest.fixture
def no_work(monkeypatch):
    def refuse(setup):
        raise AssertionError("computed before refusing")

    monkeypatch.setattr(report, "work", refuse)


def test_existing_files_are_kept(tmp_path, no_work):
    (tmp_path / "energie.pdf").write_text("mine")
    with pytest.raises(FileExistsError, match=r"energie\.pdf"):
        report.carry_out(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["energie.pdf"]


def test_folders_in_the_way(tmp_path, no_work):
    (tmp_path / "report.html").mkdir()
    with pytest.raises(OSError, match=r"report\.html"):
        report.carry_out(tmp_path, force=True)
    (tmp_path / "file").write_text("")
    with pytest.raises(NotADirectoryError):
        report.carry_out(tmp_path / "file" / "exercise")


@pytest.fixture
def quick(found, monkeypatch):
    """The command without its computation; what it was asked for."""
    asked = SimpleNamespace(setup=None)

    def work(setup):
        logging.getLogger("hodograph").info("6.3 at work")
        asked.setup = setup
        return found

    monkeypatch.setattr(report, "work", work)
    monkeypatch.setattr(
        report, "files", lambda name, figure: {f"{name}.png": b"", f"{name}.pdf": b""}
    )
    return asked


def test_command(found, quick, tmp_path, capsys):
    out = tmp_path / "exercise"
    assert cli.main(["exercise", "--out", str(out)]) == 0
    said = capsys.readouterr()
    assert said.out == results.summary(found) + "\n"
    assert said.err.startswith("hodograph: 6.3 at work\n")
    assert quick.setup == Setup()
    assert {path.name for path in out.iterdir()} == set(report.FILES)
    assert cli.main(["exercise", "--out", str(out)]) == 1
    assert capsys.readouterr().err.count("\n") == 1
    assert cli.main(["exercise", "--out", str(out), "--force"]) == 0


def test_command_with_other_constants_in_french(found, quick, tmp_path, capsys):
    options = "--mass 2 --v0 80 --dt 0.002 --eta 0.02 --lambda 0.2 --angle 30 --g 9.8 --lang fr"
    assert cli.main(["exercise", "--out", str(tmp_path), *options.split()]) == 0
    assert quick.setup == Setup(2.0, 80.0, 0.002, 0.02, 0.2, 30.0, 9.8)
    assert capsys.readouterr().out == results.summary(found, FRENCH) + "\n"
    assert "Frottement quadratique" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_command_for_students(no_work, tmp_path, capsys):
    options = ["--out", str(tmp_path), "--student", "--mass", "2", "--angle", "30"]
    assert cli.main(["exercise", *options]) == 0
    assert capsys.readouterr().err.count("wrote") == 4
    text = (tmp_path / "balistique1.py").read_text(encoding="utf-8")
    assert "MASSE = 2.0 " in text
    assert "THETA = np.deg2rad(30.0)" in text


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ("--mass 0", "must be finite and > 0; got '0'"),
        ("--angle 90", "angle must be below 90°; got 90°"),
        ("--v0 2000", "v0 / g must be from 1 to 50 s"),
        ("--dt 1", "dt must be from"),
        ("--lang de", "de"),
        ("--lamda 1", "did you mean '--lambda'?"),
        ("--mass 2furlongs", "must be a number of kg"),
    ],
)
def test_command_refuses(options, words, no_work, tmp_path, capsys):
    assert cli.main(["exercise", "--out", str(tmp_path), *options.split()]) == 2
    said = capsys.readouterr().err
    assert words in said
    assert said.count("\n") == 1


@pytest.mark.slow
def test_the_whole_exercise(tmp_path):
    start = time.perf_counter()
    found = report.carry_out(tmp_path)
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
