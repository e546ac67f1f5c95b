"""The command line as ``python -m hodograph``."""

from __future__ import annotations

import sys

from hodograph.cli import main

if __name__ == "__main__":
    sys.exit(main())
