"""How files are written: whole or not at all, and never over another unless told to."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path


def check_targets(*targets: Path, force: bool) -> None:
    """Raise `OSError` now, before the work, where `write_whole` would after it."""
    for folder in {target.parent for target in targets}:
        require_writable(folder)
    for target in targets:
        if target.is_dir():
            raise _error(errno.EISDIR, target)
        refuse_existing(target, force=force)


def require_writable(folder: Path) -> None:
    """Raise `OSError` where no file can be made: in the folder, or the nearest that is there."""
    there = folder
    while not there.exists() and there != there.parent:
        there = there.parent
    if not there.is_dir():
        raise _error(errno.ENOTDIR, there)
    try:
        with tempfile.TemporaryFile(dir=there):
            pass
    except OSError as error:
        raise _error(error.errno or errno.EIO, folder) from None


@contextlib.contextmanager
def alone(path: Path) -> Iterator[None]:
    """Hold a name while it is written, against other processes; one that is killed lets go."""
    lock = path.with_name(f".{path.name}.lock")
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(lock, "w") as held:
        with contextlib.suppress(ImportError, NotImplementedError):  # not every system has it
            import fcntl

            try:
                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise OSError(errno.EBUSY, "another process is writing it", str(path)) from None
            except OSError:  # nor every file system
                pass
        try:
            yield
        finally:
            lock.unlink(missing_ok=True)


def discard(path: Path) -> None:
    """Take a folder away at once: what is left of one that was half deleted has another name."""
    gone = path.with_name(f".{path.name}.gone")
    shutil.rmtree(gone, ignore_errors=True)
    if path.is_dir():
        path.rename(gone)
        shutil.rmtree(gone, ignore_errors=True)


def refuse_existing(path: Path, *, force: bool) -> None:
    """Raise `FileExistsError` if `path` is there and may not be replaced."""
    if path.exists() and not force:
        raise FileExistsError(f"{path} exists; it is replaced only by force")


def _error(number: int, path: Path) -> OSError:
    return OSError(number, os.strerror(number), str(path))


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
    except BaseException as error:
        temporary.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno:  # of a name that nobody asked for
            raise _error(error.errno, target) from None
        raise
    return target
