"""The programs that the exercise asks for: solved, or left blank for a class with tests.

They stand in ``templates/`` as a student would write them, in French, with the constants and the
results to be filled in (``@{name}``) and the solution between two marks.
"""

import re
import textwrap
from collections.abc import Iterable
from importlib.resources import files
from string import Template

from hodograph.exercise import comments
from hodograph.exercise.sections import THREE, Findings
from hodograph.exercise.setup import Setup
from hodograph.exercise.words import Words

PROGRAMS = ("balistique1.py", "balistique2.py", "balistique3.py")
TESTS = "test_balistique.py"
_TITLES = {
    "balistique1.py": "Balistique, 6.3 et 6.4 : les trois méthodes, et scipy.",
    "balistique2.py": "Balistique, 6.5 : le point d'impact en fonction de l'angle de tir.",
    "balistique3.py": "Balistique, 6.6 à 6.8 : convergence, énergie, frottement quadratique.",
}
_SOLUTION = re.compile(r"^( *)#! solution\n(.*?)^ *#! fin\n", re.MULTILINE | re.DOTALL)


class _Filled(Template):
    delimiter = "@"


def solved(found: Findings) -> dict[str, str]:
    """The three programs with their solution, and this run's results as comments."""
    return {name: _fill(name, found.setup, _results(found)) for name in PROGRAMS}


def blank(setup: Setup) -> dict[str, str]:
    """The three programs with functions and comments left blank, and the tests of a class."""
    return {name: _fill(name, setup, None) for name in PROGRAMS} | {TESTS: _template(TESTS)}


def _template(name: str) -> str:
    return files("hodograph.exercise").joinpath("templates", f"{name}.txt").read_text("utf-8")


def _fill(name: str, setup: Setup, results: dict[str, str] | None) -> str:
    text = _template(name).replace("@{fonctions}\n", _template("fonctions.py"))

    def solution(block: re.Match[str]) -> str:
        if results is not None:
            return block[2]
        missing = 'raise NotImplementedError("à compléter")' if block[1] else "# à compléter"
        return f"{block[1]}{missing}\n"

    constants = {"title": _TITLES[name], **_constants(setup)}
    return _Filled(_SOLUTION.sub(solution, text)).substitute(constants | (results or {}))


def _constants(setup: Setup) -> dict[str, object]:
    usual = setup.angle == Setup.angle
    return {
        "MASSE": setup.mass,
        "DT": setup.dt,
        "G": setup.g,
        "V0": setup.v0,
        "ETA": setup.eta,
        "THETA": "np.pi / 4" if usual else f"np.deg2rad({setup.angle!r})",
        "DT_1": setup.delta_1,
        "A": setup.ratio,
        "PRECISION": setup.limit,
        "DT_REFERENCE": setup.reference_dt,
        "N_MAX": setup.most,
        "DT_ENERGIE": setup.energy_dt,
        "LAMBDA": setup.lambda_,
        "PAS": float(f"{min(0.02, 0.28 / setup.rates[1]):.2g}"),
    }


def _results(found: Findings) -> dict[str, str]:
    """The answers of this run in French, as lines of comment."""
    words = Words("fr")
    first = ("trajectories", "scipy", "impact", "convergence", "energy")
    answers: dict[str, Iterable[str]] = {n: getattr(comments, n)(found, words) for n in first}
    answers["boucles"] = [
        comments.ending(run, "naive", "scipy", words) for run in found.loops if run.method in THREE
    ]
    flight, *procedure = comments.quadratic(found, words)
    answers["quadratic"] = [flight, *comments.quadratic_impact(found, words)]
    tests = (
        comments.quadratic_order,
        comments.quadratic_energy,
        comments.quadratic_terminal,
        comments.quadratic_weak,
    )
    answers["quadratic_tests"] = [
        *procedure,
        *(part for test in tests for part in test(found, words)),
    ]
    return {name: _commented(paragraphs) for name, paragraphs in answers.items()}


def _commented(paragraphs: Iterable[str]) -> str:
    lines = (textwrap.wrap(words, 96, break_on_hyphens=False) for words in paragraphs)
    return "\n".join("\n".join(f"# {line}" for line in part) for part in lines)
