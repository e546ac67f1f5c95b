"""What a file says of its making: the version that wrote it, and the command."""

import contextlib
import platform

from hodograph import __version__

STAMP = f"hodograph {__version__}"


def made_by(command: str) -> str:
    """The command that wrote a file, and the version that ran it.

    >>> made_by("hodograph reproduce") == f"hodograph reproduce, {STAMP}"
    True
    """
    return f"{command}, {STAMP}"


def versions(*packages: str) -> str:
    """Python's version, this library's, and those of `packages` as far as they are installed.

    >>> [words.split()[0] for words in versions("numpy", "no such package").split(", ")]
    ['Python', 'hodograph', 'numpy']
    """
    from importlib.metadata import PackageNotFoundError, version  # not for every command

    found = [f"Python {platform.python_version()}", STAMP]
    for name in packages:
        with contextlib.suppress(PackageNotFoundError):
            found.append(f"{name} {version(name)}")
    return ", ".join(found)
