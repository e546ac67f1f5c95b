"""The folder of files that a command makes: checked before the work, written after it."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from hodograph._files import check_targets, write_whole


def check(out: str | os.PathLike[str], names: Iterable[str], *, force: bool) -> None:
    """Raise `OSError` before the work, where `write` would after it.

    It is a `FileExistsError` if the folder holds one of the files already, unless `force`.
    """
    check_targets(*(Path(out) / name for name in names), force=force)


def write(
    out: str | os.PathLike[str], contents: Mapping[str, bytes | str], *, force: bool
) -> list[Path]:
    """Write each file whole, in a folder that is made if it is not there."""
    return [
        write_whole(Path(out) / name, content, force=force) for name, content in contents.items()
    ]
