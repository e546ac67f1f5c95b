"""The rules of the house, held against the source (docs/architecture.md says why)."""

import ast
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "hodograph"

# In the order the data flows. A module imports only from modules above it.
ORDER = (
    "domain",
    "record",
    "files",
    "clock",
    "velocity",
    "position",
    "descent",
    "powerlaw",
    "flight",
    "derivatives",
    "landing",
    "laws",
    "surrogate",
    "dial",
    "distance",
    "certify",
    "candidates",
    "optimum",
    "sensitivity",
    "formulas",
    "grid",
    "trajectory",
    "launch",
    "ode",
    "steppers",
    "reference",
    "points",
    "refit",
    "fit",
    "search",
    "compare",
    "figures",
    "measure",
    "verdicts",
    "report",
    "lawbook",
    "rivals",
    "stability",
    "timing",
    "trade",
    "trade_report",
    "scene",
    "exercise_scene",
    "exercise_quadratic",
    "exercise",
    "exercise_figures",
    "exercise_comments",
    "exercise_results",
    "exercise_report",
    "cli_streams",
    "cli_arguments",
    "cli_launch",
    "cli",
    "interruption",
    "__main__",
)
# These check the rest, so they share nothing with it, nor with each other.
INDEPENDENT = {"ode", "steppers", "reference"}

TOP_LEVEL = {
    "pyproject.toml",
    "hodograph",
    "notebooks",
    "tests",
    "data",
    "docs",
    "README.md",
    "LICENSE",
    "CITATION.cff",
}

# By the last part of the name that is called.
GLOBAL_STATE_CALLS = {
    "seterr": "NumPy's error state (np.errstate is local)",
    "seterrcall": "NumPy's error state (np.errstate is local)",
    "set_printoptions": "NumPy's print options (np.printoptions is local)",
    "use": "matplotlib's backend or style",
    "switch_backend": "matplotlib's backend",
    "rc": "matplotlib's rcParams (rc_context is local)",
    "rcdefaults": "matplotlib's rcParams (rc_context is local)",
}


def name(node: ast.expr) -> str:
    """``a.b.c`` as written; empty for anything but a plain dotted name."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        head = name(node.value)
        return f"{head}.{node.attr}" if head else ""
    return ""


def package_imports(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Line and target of every import from the package, absolute or relative."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                package, _, module = alias.name.partition(".")
                if package == "hodograph":
                    yield node.lineno, module or "hodograph"
        elif isinstance(node, ast.ImportFrom):
            module = node.module or ""
            if node.level == 0:
                package, _, module = module.partition(".")
                if package != "hodograph":
                    continue
            elif node.level > 1:
                yield node.lineno, "." * node.level + module
                continue
            if module:
                yield node.lineno, module
            else:
                yield from ((node.lineno, alias.name) for alias in node.names)


def import_faults(module: str, tree: ast.AST, order: tuple[str, ...]) -> Iterator[str]:
    if module in INDEPENDENT:
        allowed: tuple[str, ...] = ()
    elif module == "__init__":
        allowed = order
    else:
        allowed = order[: order.index(module)]
    for line, target in package_imports(tree):
        if target not in allowed:
            if module in INDEPENDENT:
                why = f"{module} is an independent path"
            else:
                why = f"which is not above {module} in the order"
            yield f"{module}.py:{line}: imports {target!r}: {why}"
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and any(alias.name == "*" for alias in node.names):
            yield f"{module}.py:{node.lineno}: star import"
        called = name(node.func) if isinstance(node, ast.Call) else ""
        if called.endswith(("import_module", "__import__")) and module != "__init__":
            yield f"{module}.py:{node.lineno}: imports by name at run time"


def side_effect_faults(module: str, tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        where = f"{module}.py:{getattr(node, 'lineno', 0)}"
        if isinstance(node, ast.Call):
            called = name(node.func)
            last = called.rpartition(".")[2]
            if called == "print" and module != "cli":
                yield f"{where}: prints"
            if last in GLOBAL_STATE_CALLS:
                yield f"{where}: {called}() changes {GLOBAL_STATE_CALLS[last]}"
            if called.endswith(("rcParams.update", "rcParams.setdefault")):
                yield f"{where}: changes matplotlib's rcParams (rc_context is local)"
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store | ast.Del):
            owner = name(node.value).rpartition(".")[2]
            if node.attr in {"dps", "prec", "pretty"} and owner in {"mp", "mpmath"}:
                yield f"{where}: sets mpmath's {name(node)} (mp.workdps is local)"
        elif isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store | ast.Del):
            if name(node.value).rpartition(".")[2] in {"rcParams", "environ"}:
                yield f"{where}: sets {name(node.value)}"
        elif isinstance(node, ast.Import | ast.ImportFrom):
            base = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
            if any(f"{base}{alias.name}.".startswith("matplotlib.pyplot.") for alias in node.names):
                yield f"{where}: imports pyplot, which keeps every figure and picks a backend"


def faults(module: str, source: str, order: tuple[str, ...] = ORDER) -> list[str]:
    """Every breach of the rules in one module's source."""
    tree = ast.parse(source)
    return [*import_faults(module, tree, order), *side_effect_faults(module, tree)]


def unlisted(paths: Iterable[str]) -> list[str]:
    """Files of the package (paths relative to it) that have no place in the order."""
    listed = {f"{module}.py" for module in (*ORDER, "__init__")}
    return sorted(set(paths) - listed)


def stray(paths: Iterable[str]) -> list[str]:
    """Top-level entries of the repository that do not belong there."""
    top = {path.split("/")[0] for path in paths}
    return sorted(entry for entry in top - TOP_LEVEL if not entry.startswith("."))


def sources() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


@pytest.mark.parametrize("path", sources(), ids=lambda path: path.stem)
def test_module_keeps_the_rules(path):
    # Only what exists may be imported, even where the order allows the name.
    existing = tuple(module for module in ORDER if (PACKAGE / f"{module}.py").exists())
    if path.stem in (*existing, "__init__"):
        assert faults(path.stem, path.read_text(encoding="utf-8"), existing) == []


def test_every_module_is_listed():
    found = [path.relative_to(PACKAGE).as_posix() for path in sources()]
    assert found, f"no source under {PACKAGE}"
    assert unlisted(found) == []


def test_package_is_typed():
    assert (PACKAGE / "py.typed").is_file()


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


# The checks themselves: each of these has one fault, and must be caught for it.
@pytest.mark.parametrize(
    ("module", "source", "fault"),
    [
        ("velocity", "from hodograph.engine.landing import solve", "imports 'landing'"),
        ("velocity", "from .landing import solve", "imports 'landing'"),
        ("velocity", "from . import landing", "imports 'landing'"),
        ("velocity", "from hodograph import landing", "imports 'landing'"),
        ("velocity", "import hodograph.engine.landing as engine", "imports 'landing'"),
        ("velocity", "from .velocity import speed", "imports 'velocity'"),
        ("velocity", "def f():\n    from .cli import main", "imports 'cli'"),
        ("launch", "import hodograph", "imports 'hodograph'"),
        ("launch", "from hodograph import d_norm", "imports 'd_norm'"),
        ("launch", "from ..other import thing", "imports '..other'"),
        ("launch", "from .utils import thing", "imports 'utils'"),
        ("ode", "from .domain import check", "independent"),
        ("ode", "from .reference import landing", "independent"),
        ("reference", "from . import ode", "independent"),
        ("reference", "import hodograph.engine.velocity", "independent"),
        ("__init__", "from .nowhere import thing", "imports 'nowhere'"),
        ("__init__", "from .domain import *", "star import"),
        ("position", "from numpy import *", "star import"),
        ("position", "import importlib\nimportlib.import_module('hodograph.cli')", "by name"),
        ("report", "print('done')", "prints"),
        ("__main__", "print('done')", "prints"),
        ("position", "import numpy as np\nnp.seterr(all='ignore')", "error state"),
        ("position", "from numpy import seterr\nseterr(all='ignore')", "error state"),
        ("reference", "from mpmath import mp\nmp.dps = 50", "mp.dps"),
        ("reference", "import mpmath\nmpmath.mp.prec += 10", "mpmath.mp.prec"),
        ("figures", "import matplotlib\nmatplotlib.use('Agg')", "backend"),
        ("figures", "import matplotlib as m\nm.rcParams['font.size'] = 9", "rcParams"),
        ("figures", "from matplotlib import rcParams\nrcParams.update({})", "rcParams"),
        ("figures", "import matplotlib.pyplot as plt", "pyplot"),
        ("figures", "from matplotlib import pyplot", "pyplot"),
        ("figures", "from matplotlib.pyplot import figure", "pyplot"),
        ("cli", "import os\nos.environ['MPLBACKEND'] = 'Agg'", "environ"),
    ],
)
def test_a_fault_is_caught(module, source, fault):
    found = faults(module, source)
    assert len(found) == 1
    assert fault in found[0]


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("launch", "from .domain import check\nfrom hodograph.distance import d_norm"),
        ("launch", "from . import landing, optimum\nimport hodograph.velocity"),
        ("__init__", "from .cli import main\nfrom . import ode, reference"),
        ("__init__", "import importlib\nimportlib.import_module('hodograph.laws')"),
        ("position", "import numpy as np\nwith np.errstate(over='ignore'):\n    np.exp(1e3)"),
        ("reference", "from mpmath import mp\nwith mp.workdps(50):\n    mp.sin(1)"),
        ("reference", "from mpmath import mp\ncontext = mp.clone()\ncontext.dps = 50"),
        ("figures", "import matplotlib\nwith matplotlib.rc_context({'font.size': 9}):\n    pass"),
        ("figures", "from matplotlib.figure import Figure\nfigure = Figure()"),
        ("cli", "print('1.0')"),
    ],
)
def test_what_is_allowed_passes(module, source):
    assert faults(module, source) == []


def test_strays_are_caught():
    assert unlisted(["domain.py", "utils.py", "core/kernel.py"]) == ["core/kernel.py", "utils.py"]
    assert stray(["README.md", ".ci/run", "tests/test_x.py"]) == []
    assert stray(["setup.py", "scripts/x.sh", "docs/index.md"]) == ["scripts", "setup.py"]
