"""How files are written: whole or not at all, and never over another unless told to."""

from __future__ import annotations

import os
import tempfile
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
    handle, temporary = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, target)
    except BaseException:
        os.unlink(temporary)
        raise
    return target


def _umask() -> int:
    """The permissions withheld from new files; there is no way to read them but to set them."""
    mask = os.umask(0o022)
    os.umask(mask)
    return mask
