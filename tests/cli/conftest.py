"""The command line, run in this process."""

import pytest

from hodograph.cli import commands as cli


@pytest.fixture
def run(capsys):
    """Runs the command line: (exit code, stdout, stderr)."""

    def call(*argv):
        code = cli.main([str(word) for word in argv])
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
