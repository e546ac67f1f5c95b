"""The command line: ``hodograph range | trajectory | grid | reproduce | exercise | ...``."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line: see `hodograph.cli.commands.main`."""
    from hodograph.cli import commands  # whose imports can be interrupted, too

    return commands.main(argv)
