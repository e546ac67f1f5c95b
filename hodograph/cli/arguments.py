"""The words of the command line: commands, options, and what was probably meant."""

from __future__ import annotations

import argparse
import difflib
import re
import textwrap
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple, NoReturn

from hodograph.cli.streams import UsageError, put


class Parser(argparse.ArgumentParser):
    """A parser that prints and refuses as the commands do; `commands` are those below it."""

    commands: dict[str, Parser]

    def print_help(self, file: object = None) -> None:
        """Print it as data."""
        put(self.format_help())

    def error(self, message: str) -> NoReturn:
        """Leave it to `hodograph.cli.main` to say."""
        raise UsageError(f"{message} (see {self.prog} --help)")


def parser(prog: str, words: str, example: str, notes: str = "") -> Parser:
    """A parser whose help ends with an example."""
    made = Parser(prog=prog, allow_abbrev=False)
    _describe(made, words, example, notes)
    return made


def _describe(made: Parser, words: str, example: str, notes: str = "") -> None:
    made.commands = {}
    made.formatter_class = argparse.RawDescriptionHelpFormatter
    made.description = textwrap.fill(words, 78)
    made.epilog = f"{notes}example:\n  {example}"


class Command(NamedTuple):
    """A command: what it is called, what its help says, what it does.

    `do` is None where others are below it; `folder` is where its files go by default, if it is a
    command with a folder.
    """

    name: str
    words: str
    example: str
    do: Callable[[argparse.Namespace], None] | None = None
    folder: str | None = None


def add_commands(to: Parser, metavar: str, commands: Iterable[Command]) -> dict[str, Parser]:
    """Commands below a parser, by name."""
    below = to.add_subparsers(metavar=metavar, required=True)
    for command in commands:
        words = command.words
        made = below.add_parser(command.name, help=words, allow_abbrev=False)
        _describe(made, f"{words[0].upper()}{words[1:]}.", command.example)
        made.set_defaults(command=command.do)
        if command.folder is not None:
            add_out(made, command.folder)
        to.commands[command.name] = made
    return to.commands


def parse(top: Parser, argv: Sequence[str]) -> argparse.Namespace:
    """The arguments; help, where there are none or the first of them is ``help``."""
    if not argv or argv[0] == "help":
        argv = [*argv[1:], "--help"]
    argv = _shield(argv)
    _refuse_unknown_words(top, argv)
    return top.parse_args(argv)


def _shield(argv: Sequence[str]) -> list[str]:
    """Negative numbers with a space in front, so that argparse takes none for an option."""
    shielded: list[str] = []
    for text in argv:
        if text.startswith("-") and not (shielded and shielded[-1] == "--out"):
            text = f" {text}" if _begins_as_number(text) else text
        shielded.append(text)
    return shielded


def _begins_as_number(text: str) -> bool:
    return re.match(r"-(\.?\d|inf|nan)", text, re.IGNORECASE) is not None


def _refuse_unknown_words(to: Parser, argv: Sequence[str]) -> None:
    """Refuse a command or an option that is not there, and name the nearest that is."""
    for place, word in enumerate(argv):
        if word == "--":
            return
        if word.startswith("-"):
            known = to._option_string_actions
            option = word.partition("=")[0]
            short = not word.startswith("--") and word[:2] in known
            if len(word) > 1 and not (option in known or short or _begins_as_number(word)):
                _refuse(to, "option", option, known)
        elif to.commands:
            if word not in to.commands:
                _refuse(to, "command", word, to.commands)
            _refuse_unknown_words(to.commands[word], argv[place + 1 :])
            return


def _refuse(to: Parser, kind: str, word: str, known: Iterable[str]) -> NoReturn:
    near = nearest(word, known)
    if near is not None:
        raise UsageError(f"unknown {kind} {word!r}; did you mean {near!r}?")
    to.error(f"unknown {kind} {word!r}; known are {', '.join(known)}")


def nearest(word: str, known: Iterable[str]) -> str | None:
    """What was probably meant: the shortest that begins so, or one that is spelt much alike."""
    plain = {name.lstrip("-"): name for name in known}
    word = word.lstrip("-").lower()
    longer = sorted((name for name in plain if word and name.startswith(word)), key=len)
    found = longer or difflib.get_close_matches(word, plain, n=1, cutoff=0.6)
    return plain[found[0]] if found else None


def add_out(to: Parser, default: str | None) -> None:
    """The folder to write to, and whether to replace what is there."""
    to.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        default=None if default is None else Path(default),
        help=f"folder to write to, made if need be (default {default or 'is to write nothing'})",
    )
    to.add_argument("--force", action="store_true", help="replace existing files")
