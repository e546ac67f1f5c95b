"""The command line as a process: ``hodograph``, or ``python -m hodograph``."""

from __future__ import annotations

import os
import sys


def main() -> int:
    """Run the command line as the one thing that this process does; return its exit code."""
    try:
        from hodograph.cli.interruption import interruptibly

        return interruptibly(_command_line)
    except KeyboardInterrupt:  # before that took it in hand
        os.write(2, b"hodograph: interrupted\n")
        os._exit(130)


def _command_line() -> int:
    from hodograph.cli import commands as cli  # whose imports can be interrupted, too

    return cli.main()


if __name__ == "__main__":
    sys.exit(main())
