"""What the command line says: data to standard output, one line of the rest to standard error."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import sys
from collections.abc import Iterator
from typing import TextIO


class UsageError(Exception):
    """The command line asks for something that cannot be."""


class FailedError(Exception):
    """The command was understood and has no result, or not the whole of it."""


def put(text: str) -> None:
    """Data, to standard output; what its encoding lacks becomes a question mark."""
    if sys.stdout is None:
        raise OSError(errno.EBADF, "standard output is closed")
    encoding = sys.stdout.encoding or "utf-8"
    try:
        sys.stdout.write(text.encode(encoding, "replace").decode(encoding))
        sys.stdout.flush()
    except OSError:
        _abandon_stdout()
        raise


def _abandon_stdout() -> None:
    """Send what is still to be flushed nowhere, so that Python's exit does not fail on it."""
    with contextlib.suppress(OSError), open(os.devnull, "wb") as nowhere:
        os.dup2(nowhere.fileno(), sys.stdout.fileno())


def say(message: str) -> None:
    """One line of diagnostics, to standard error.

    In one write, as `print` does not do: an interruption within would leave a line without its end.
    """
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            sys.stderr.write(f"hodograph: {' '.join(message.split())}\n")
            sys.stderr.flush()


def show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """What `warnings.showwarning` is while a command runs."""
    say(f"warning: {message}")


class _Said(logging.Handler):
    """Each message as a line of diagnostics."""

    def emit(self, record: logging.LogRecord) -> None:
        say(record.getMessage())


@contextlib.contextmanager
def progress_shown() -> Iterator[None]:
    """What the library logs of its progress, said while a command runs."""
    log, shown = logging.getLogger("hodograph"), _Said()
    before = log.level, log.propagate
    log.addHandler(shown)
    log.setLevel(logging.INFO)
    log.propagate = False  # a caller of `main` may have handlers of its own
    try:
        yield
    finally:
        log.removeHandler(shown)
        log.setLevel(before[0])
        log.propagate = before[1]
