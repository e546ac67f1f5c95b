"""The command line that must refuse."""

import pytest


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
