"""The rules of the house: what its tools cannot hold, and that they catch what they should.

The layers and their siblings are contracts of import-linter, the ban on global state is rules of
ruff, both in pyproject.toml (docs/architecture.md says why).
"""

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterable
from pathlib import Path
from shutil import copy, copytree, ignore_patterns

import pytest
from helpers import ROOT

PACKAGE = ROOT / "hodograph"

TOP_LEVEL = {
    "pyproject.toml",
    "hodograph",
    "notebooks",
    "tests",
    "data",
    "docs",
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "LICENSE",
    "CITATION.cff",
}

MODULES, FOLDERS = 16, 11  # at most, at the top level of the package
LONGEST = 400  # lines of one module
# What quadratic drag takes, from the closed form to the points of a path: read in one sitting.
CORE = ("velocity", "position", "fall", "flight", "extremes", "path")
CORE_LINES, FUNCTION_LINES = 1000, 50


def stray(paths: Iterable[str]) -> list[str]:
    """Top-level entries of the repository that do not belong there."""
    top = {path.split("/")[0] for path in paths}
    return sorted(entry for entry in top - TOP_LEVEL if not entry.startswith("."))


def lines() -> dict[str, int]:
    """The length of every module."""
    paths = sorted(PACKAGE.rglob("*.py"))
    return {
        path.relative_to(PACKAGE).as_posix(): len(path.read_text(encoding="utf-8").splitlines())
        for path in paths
    }


def test_package_is_typed():
    assert (PACKAGE / "py.typed").is_file()


def test_listing_is_short():
    modules = {path.stem for path in PACKAGE.glob("*.py")}
    folders = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert modules
    assert len(modules) <= MODULES
    assert len(folders) <= FOLDERS


def test_no_module_is_long():
    assert {name: count for name, count in lines().items() if count > LONGEST} == {}


def test_the_core_is_short():
    count = lines()
    assert sum(count[f"engine/{name}.py"] for name in CORE) <= CORE_LINES
    for name in CORE:
        tree = ast.parse((PACKAGE / "engine" / f"{name}.py").read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef):
                assert node.end_lineno - node.lineno < FUNCTION_LINES, (name, node.name)


def test_top_level_is_fixed():
    def git(*args: str) -> str:
        run = subprocess.run(["git", *args], cwd=ROOT, capture_output=True, text=True, check=True)
        return run.stdout

    try:
        checkout = Path(git("rev-parse", "--show-toplevel").strip())
    except (FileNotFoundError, subprocess.CalledProcessError):
        pytest.skip("not a git checkout: what belongs to the project cannot be told")
    if checkout.resolve() != ROOT:
        pytest.skip(f"the project is not its own git checkout, but lies inside {checkout}")
    # Untracked files count, so that a stray one is seen before it is committed.
    paths = git("ls-files", "-z", "--cached", "--others", "--exclude-standard")
    assert stray(filter(None, paths.split("\0"))) == []


PAGES = ("CONTRIBUTING.md", "docs/architecture.md", "docs/engine.md", "docs/equations.md")


def named(page: str) -> set[str]:
    """The files and folders of the package that a page names."""
    text = (ROOT / page).read_text(encoding="utf-8")
    words = re.findall(r"[\w/]*\w\.(?:py|json)\b", text) + re.findall(r"`(\w+/)`", text)
    others = ("test", "docs", "data", "notebooks", "verdicts.json")  # not of the package
    ours = {word.removeprefix("hodograph/") for word in words if not word.startswith(others)}
    return ours - {""}


@pytest.mark.parametrize("page", PAGES)
def test_pages_name_what_is_there(page):
    names = named(page)
    assert names
    assert [name for name in sorted(names) if not any(PACKAGE.glob(f"**/{name}"))] == []


def test_the_listing_is_complete():
    modules = {path.name for path in PACKAGE.glob("*.py")} - {"__init__.py"}
    folders = {f"{path.parent.name}/" for path in PACKAGE.glob("*/__init__.py")}
    listing = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    assert {name for name in modules | folders if name not in listing} == set()


def test_strays_are_caught():
    assert stray(["README.md", ".ci/run", "tests/test_x.py"]) == []
    assert stray(["setup.py", "scripts/x.sh", "docs/index.md"]) == ["scripts", "setup.py"]


# Each of these modules, planted in a copy of the package, breaks one rule, and the tool has to say
# so: where the module goes, what it says, and what the tool must answer.

BAD_IMPORTS = {
    "up: engine to public": (
        "engine/planted_a.py",
        "from hodograph.launch import Launch",
        "hodograph.engine.planted_a -> hodograph.launch",
    ),
    "up: laws to tiers": (
        "laws/planted_b.py",
        "import hodograph.tiers",
        "hodograph.laws.planted_b -> hodograph.tiers ",
    ),
    "up: tiers to public": (
        "tiers/planted_c.py",
        "import hodograph.level",
        "hodograph.tiers.planted_c -> hodograph.level",
    ),
    "up: report to paper": (
        "report/planted_d.py",
        "import hodograph.paper",
        "hodograph.report.planted_d -> hodograph.paper ",
    ),
    "up: anything to the command line, inside a function": (
        "paper/planted_e.py",
        "def f():\n    from hodograph.cli import main",
        "hodograph.paper.planted_e -> hodograph.cli",
    ),
    "sibling: exercise to bench": (
        "exercise/planted_f.py",
        "import hodograph.bench",
        "hodograph.exercise.planted_f -> hodograph.bench ",
    ),
    "sibling: builders to exercise": (
        "builders/planted_g.py",
        "import hodograph.exercise",
        "hodograph.builders.planted_g -> hodograph.exercise ",
    ),
    "a witness leans on the engine": (
        "ode.py",
        "import hodograph.engine",
        "hodograph.ode -> hodograph.engine ",
    ),
    "a witness leans on the writer of files": (
        "steppers.py",
        "from hodograph import _files",
        "hodograph.steppers -> hodograph._files",
    ),
    "a witness leans on another": (
        "reference.py",
        "from hodograph.steppers import integrate",
        "hodograph.reference -> hodograph.steppers",
    ),
    "the engine leans on a witness": (
        "engine/planted_h.py",
        "from hodograph import reference",
        "hodograph.engine.planted_h -> hodograph.reference",
    ),
    "a public module leans on a witness": (
        "level.py",
        "from hodograph import ode",
        "hodograph.level -> hodograph.ode",
    ),
    "a public module leans on a part of a witness": (
        "launch.py",
        "import hodograph.witness.ode_march",
        "hodograph.launch -> hodograph.witness.ode_march",
    ),
    "a witness leans on a part of another": (
        "ode.py",
        "import hodograph.witness.stepping_walk",
        "hodograph.ode -> hodograph.witness.stepping_walk",
    ),
    "a part of a witness leans on a part of another": (
        "witness/stepping_inputs.py",
        "import hodograph.witness.reference_numbers",
        "hodograph.witness.stepping_inputs -> hodograph.witness.reference_numbers",
    ),
    "a part of a witness leans on the engine": (
        "witness/reference_rules.py",
        "import hodograph.engine",
        "hodograph.witness.reference_rules -> hodograph.engine ",
    ),
    "from the package itself": (
        "bench/planted_i.py",
        "from hodograph import d_norm",
        "hodograph.bench.planted_i -> hodograph ",
    ),
    "a cycle": (
        "builders/planted_j.py",
        "from hodograph.builders import planted_k",
        "No cycles are allowed in hodograph.builders.",
    ),
    "the other half of it": (
        "builders/planted_k.py",
        "from hodograph.builders import planted_j",
        ".planted_k -> .planted_j",
    ),
}

BAD_STATEMENTS = {
    "relative import": ("from .level import d_norm", "TID252"),
    "star import": ("from numpy import *", "F403"),
    "import by name": ("import importlib\nimportlib.import_module('hodograph.cli')", "TID251"),
    "print": ("print('done')", "T201"),
    "error state": ("import numpy as np\nnp.seterr(all='ignore')", "TID251"),
    "error state, by name": ("from numpy import seterr\nseterr(all='ignore')", "TID251"),
    "error handler": ("import numpy as np\nnp.seterrcall(None)", "TID251"),
    "print options": ("import numpy\nnumpy.set_printoptions(precision=3)", "TID251"),
    "random state": ("import numpy as np\nnp.random.seed(1)", "NPY002"),
    "precision": ("from mpmath import mp\nmp.dps = 50", "TID251"),
    "precision, in place": ("import mpmath\nmpmath.mp.prec += 10", "TID251"),
    "backend": ("import matplotlib\nmatplotlib.use('Agg')", "TID251"),
    "style": ("from matplotlib import style\nstyle.use('ggplot')", "TID251"),
    "rc": ("import matplotlib\nmatplotlib.rc('font', size=9)", "TID251"),
    "rcParams": ("import matplotlib as m\nm.rcParams['font.size'] = 9", "TID251"),
    "rcParams, by name": ("from matplotlib import rcParams\nrcParams.update({})", "TID251"),
    "pyplot": ("import matplotlib.pyplot as plt", "TID251"),
    "pyplot, from above": ("from matplotlib import pyplot", "TID251"),
    "pyplot, a part": ("from matplotlib.pyplot import figure", "TID251"),
    "environment": ("import os\nos.environ['MPLBACKEND'] = 'Agg'", "TID251"),
    "environment, set": ("import os\nos.putenv('MPLBACKEND', 'Agg')", "TID251"),
}

GOOD = '''"""What is allowed."""

import matplotlib as mpl
import mpmath
import numpy as np
from matplotlib.figure import Figure

context = mpmath.MPContext()
context.dps = 50
with np.errstate(over="ignore"), np.printoptions(precision=3):
    np.exp(1e3)
with mpl.rc_context({"font.size": 9}):
    Figure()
'''


def tool(where: Path, *words: str) -> str:
    """What a tool says when it is run in a folder; an answer of neither yes nor no is an error."""
    run = subprocess.run([sys.executable, *words], cwd=where, capture_output=True, text=True)
    assert run.returncode in (0, 1), run.stderr
    return run.stdout


def lint_imports(where: Path) -> str:
    command = "from importlinter.cli import lint_imports_command as command; command()"
    said = tool(where, "-c", command, "--no-cache", "--no-logo")
    assert "Contracts: " in said
    return said


def ruff(where: Path) -> str:
    return tool(where, "-m", "ruff", "check", "--no-cache", "--output-format=concise", "hodograph")


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of what the tools read."""
    where = tmp_path_factory.mktemp("tree")
    copy(ROOT / "pyproject.toml", where)
    copytree(PACKAGE, where / "hodograph", ignore=ignore_patterns("__pycache__", "*.npz"))
    return where


def test_imports_keep_the_contracts():
    pytest.importorskip("importlinter")
    said = lint_imports(ROOT)
    assert "0 broken" in said, said


@pytest.fixture(scope="module")
def imports_report(tree):
    pytest.importorskip("importlinter")
    for where, source, _ in BAD_IMPORTS.values():
        path = tree / "hodograph" / where
        if path.with_suffix("").is_dir():
            path = path.with_suffix("") / "__init__.py"
        with path.open("a", encoding="utf-8") as file:
            file.write(f"\n{source}\n")
    return lint_imports(tree)


@pytest.mark.parametrize("fault", BAD_IMPORTS)
def test_a_bad_import_is_caught(imports_report, fault):
    _, _, answer = BAD_IMPORTS[fault]
    assert answer in imports_report


def test_every_part_of_a_witness_has_its_contract():
    with (ROOT / "pyproject.toml").open("rb") as file:
        contracts = tomllib.load(file)["tool"]["importlinter"]["contracts"]
    kept = {part for each in contracts for part in each.get("protected_modules", ())}
    parts = {f"hodograph.witness.{path.stem}" for path in PACKAGE.glob("witness/[!_]*.py")}
    assert parts
    assert parts <= kept


def test_a_module_without_a_layer_is_caught(tree):
    pytest.importorskip("importlinter")
    stray_module = tree / "hodograph" / "utils.py"
    stray_module.write_text('"""Odds and ends."""\n', encoding="utf-8")
    said = lint_imports(tree)
    stray_module.unlink()
    assert "utils" in said


@pytest.fixture(scope="module")
def ruff_report(tree):
    pytest.importorskip("ruff")
    for number, (source, _) in enumerate(BAD_STATEMENTS.values()):
        path = tree / "hodograph" / "paper" / f"planted_{number}.py"
        path.write_text(f'"""Planted."""\n\n{source}\n', encoding="utf-8")
    (tree / "hodograph" / "paper" / "allowed.py").write_text(GOOD, encoding="utf-8")
    return ruff(tree)


@pytest.mark.parametrize("fault", BAD_STATEMENTS)
def test_a_bad_statement_is_caught(ruff_report, fault):
    number = list(BAD_STATEMENTS).index(fault)
    said = [line for line in ruff_report.splitlines() if f"planted_{number}.py:" in line]
    assert any(f" {BAD_STATEMENTS[fault][1]} " in line for line in said)


def test_what_is_allowed_passes(ruff_report):
    assert "allowed.py" not in ruff_report
