"""Ctrl-C in a process of its own: one line on standard error, and exit code 130.

Python raises `KeyboardInterrupt` wherever it happens to be.  Where that is a function which
compiled code has called back, another exception may come out of it, or none at all.  So that it
struck is written down, and whatever comes after it is taken for its consequence.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import sys

TYPE_CHECKING = False  # as in `hodograph`: nothing here may take its time
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, NoReturn

INTERRUPTED = 130
AGAIN = 0.1  # s until it is raised again where the first was swallowed
_LINE = b"hodograph: interrupted\n"


def interruptibly(run: Callable[[], int]) -> int:
    """Run what the process is there for: its exit code; ends the process if Ctrl-C strikes.

    To be called once, last, and in the main thread: afterwards the process can no longer be
    interrupted.
    """
    struck = False

    def strike(*_: Any) -> NoReturn:
        nonlocal struck
        if not struck:
            struck = True
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second one would disturb the tidying
            _last_words()
            if hasattr(signal, "setitimer"):
                signal.signal(signal.SIGALRM, strike)
                signal.setitimer(signal.ITIMER_REAL, AGAIN, AGAIN)
        raise KeyboardInterrupt

    code = INTERRUPTED
    try:
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # else it is not for us
            signal.signal(signal.SIGINT, strike)
        try:
            code = run()
        finally:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            if hasattr(signal, "setitimer"):
                signal.setitimer(signal.ITIMER_REAL, 0)
    except BaseException:
        if not struck:
            raise
    if struck:
        _leave()
    return code


def _leave() -> NoReturn:
    """End as `sys.exit` would, but for one thing.

    Python ends by the signal, and not with an exit code, once an interruption has passed through
    `exec` of a string, which imports do; that it has been caught since is not noticed.
    """
    with contextlib.suppress(BaseException):
        atexit._run_exitfuncs()
    with contextlib.suppress(BaseException):
        sys.stdout.flush()
    os._exit(INTERRUPTED)


def _last_words() -> None:
    """Say that it is interrupted, and let nothing be said after it, by compiled code either.

    Past `sys.stderr`, which may be in the middle of a line that this one would run into.
    """
    if sys.stderr is None:  # the number belongs to some other file
        return
    with contextlib.suppress(OSError):
        os.write(2, _LINE)
    with contextlib.suppress(OSError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 2)
