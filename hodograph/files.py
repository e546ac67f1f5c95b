"""How files are written: whole or not at all, and never over another unless told to."""

from __future__ import annotations

import os
import secrets
from pathlib import Path


def refuse_existing(path: Path, *, force: bool) -> None:
    """Raise `FileExistsError` if `path` is there and may not be replaced."""
    if path.exists() and not force:
        raise FileExistsError(f"{path} exists; it is replaced only by force")


def write_whole(path: str | os.PathLike[str], content: bytes | str, *, force: bool = False) -> Path:
    """Write a file under a temporary name beside it, then rename it into place.

    An interruption leaves what was there before.  Folders are made as needed.
    """
    target = Path(path)
    refuse_existing(target, force=force)
    data = content.encode() if isinstance(content, str) else content
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = target.with_name(f".{secrets.token_hex(8)}.part")
    try:  # the name is known before the file is there, so that no interruption can leave it
        with open(temporary, "xb") as stream:
            stream.write(data)
        os.replace(temporary, target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    return target
