"""What every test shares: no display, a fixed search in CI, and one seed for fresh points."""

import importlib.util
import os
import secrets

import pytest
from hypothesis import settings

# An environment variable, so that it reaches the commands that tests start as well.
os.environ["MPLBACKEND"] = "Agg"

# No deadline: the first call in a process pays for imports. In CI the same examples
# come every time, so that a red run is about the change and not about luck.
settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")

# Some promises are to hold at points that nobody has seen before.
SEED = int(os.environ.get("HODOGRAPH_SEED") or secrets.randbits(32))


def pytest_report_header():
    return f"fresh points: HODOGRAPH_SEED={SEED} draws these again"


def pytest_collection_modifyitems(items):
    """The examples of `hodograph.sweep` run where its extra is installed."""
    if importlib.util.find_spec("xarray") is None:
        for item in items:
            if item.nodeid.startswith("hodograph/sweep.py"):
                item.add_marker(pytest.mark.skip(reason="they need the extra `sweep`"))


@pytest.fixture(scope="session")
def seed():
    """Another one in every run; the head of the report says which."""
    return SEED


@pytest.fixture
def run(capsys):
    """Runs the command line: (exit code, stdout, stderr)."""
    from hodograph.cli import commands

    def call(*argv):
        code = commands.main([str(word) for word in argv])
        return code, *capsys.readouterr()

    return call


@pytest.fixture
def refused(run):
    """Runs a command that must fail: the text after ``hodograph: error: ``."""

    def call(code, *argv):
        got, out, err = run(*argv)
        assert (got, out) == (code, "")
        head = "hodograph: error: "
        assert err.startswith(head)
        assert err.count("\n") == 1
        assert err.endswith("\n")
        return err.removeprefix(head).rstrip("\n")

    return call
