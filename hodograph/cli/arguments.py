"""The arguments of the command line: what they must be, and what was probably meant."""

from __future__ import annotations

import argparse
import contextlib
import difflib
import math
import re
import textwrap
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple, NoReturn

from hodograph.cli.streams import UsageError, put

MOST_POINTS = 1_000_000

# What one of each unit is in ours.
_IN_OURS = {
    "m/s": {
        **dict.fromkeys(("m/s", "mps"), 1.0),
        **dict.fromkeys(("km/h", "kmh", "kph"), 1 / 3.6),
        "mph": 0.44704,
        **dict.fromkeys(("ft/s", "fps"), 0.3048),
        **dict.fromkeys(("kn", "kt", "knots"), 1852 / 3600),
    },
    "degrees": {
        **dict.fromkeys(("°", "deg", "degree", "degrees"), 1.0),
        **dict.fromkeys(("rad", "radian", "radians"), 180 / math.pi),
    },
    "m": {"m": 1.0, "cm": 0.01, "km": 1000.0, "in": 0.0254, "ft": 0.3048, "yd": 0.9144},
    "m/s^2": dict.fromkeys(("m/s^2", "m/s²", "m/s2"), 1.0),
    "1/m": dict.fromkeys(("1/m", "/m"), 1.0),
    "kg": {"kg": 1.0, "g": 0.001, "lb": 0.45359237, "oz": 0.028349523125},
    "s": {"s": 1.0, "ms": 0.001},
    "kg/s": {"kg/s": 1.0, "g/s": 0.001},
    "kg/m": {"kg/m": 1.0, "g/m": 0.001},
}
_QUANTITY = re.compile(
    r"([-+]?[\d.,]+(?:e[-+]?\d+)?)\s*([^\W\d_].*|[°'\"%/].*|1/.*)?", re.IGNORECASE
)


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


# --- the arguments -------------------------------------------------------------------------


def _number(words: str, unit: str, holds: Callable[[float], bool]) -> Callable[[str], float]:
    """Converter for a number for which `holds`."""

    def convert(text: str) -> float:
        text = text.strip()
        try:
            value = float(text)
        except ValueError:
            raise argparse.ArgumentTypeError(_no_number(text, unit)) from None
        overflow = math.isinf(value) and "inf" not in text.lower()
        if overflow or not holds(value):  # NaN holds nowhere
            raise argparse.ArgumentTypeError(f"must be {words}; got {text!r}")
        return value

    return convert


def _no_number(text: str, unit: str) -> str:
    """What is expected in place of what is no number, and how this one would be written."""
    expected = f"must be a number of {unit}"
    quantity = _QUANTITY.fullmatch(text.replace("\N{MINUS SIGN}", "-"))
    if quantity is None:
        return f"{expected}; got {text!r}"
    number, given = quantity[1], (quantity[2] or "").strip().lower()
    if given:
        expected += ", without a unit"
    if "," in number:
        expected += ", with a point for the decimals and no comma"
    factor = _IN_OURS[unit].get(given) if given else 1.0
    write = [f"{value * factor:.9g}" for value in _meant(number)] if factor else []
    return f"{expected}; got {text!r}" + (f" (write {' or '.join(write)})" if write else "")


def _meant(number: str) -> list[float]:
    """What a number with commas may mean."""
    point = number.replace(",", ".") if "." not in number else number.replace(",", "")
    readings = [point]
    if re.fullmatch(r"[-+]?\d{1,3},\d{3}", number):  # or thousands
        readings.append(number.replace(",", ""))
    values = []
    for reading in readings:
        with contextlib.suppress(ValueError):
            values.append(float(reading))
    return values


def _points(text: str) -> int:
    try:
        number = int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be an integer; got {text.strip()!r}") from None
    if not 2 <= number <= MOST_POINTS:
        raise argparse.ArgumentTypeError(f"must be from 2 to {MOST_POINTS}; got {number}")
    return number


def add_launch(to: Parser) -> None:
    """What `hodograph.Launch` asks for, the angle in degrees."""
    finite = math.isfinite
    to.add_argument(
        "v0",
        metavar="V0",
        type=_number("finite and >= 0", "m/s", lambda v: finite(v) and v >= 0),
        help="launch speed, m/s",
    )
    to.add_argument(
        "angle",
        metavar="ANGLE",
        type=_number("in [-90, 90] degrees", "degrees", lambda a: -90 <= a <= 90),
        help="launch angle above the horizontal, degrees, in [-90, 90]",
    )
    drag = to.add_mutually_exclusive_group(required=True)
    drag.add_argument(
        "--v-lim",
        metavar="V",
        type=_number("> 0 (inf is vacuum)", "m/s", lambda v: v > 0),
        help="terminal speed of fall, m/s; inf is vacuum",
    )
    drag.add_argument(
        "--k",
        metavar="K",
        type=_number("finite and >= 0", "1/m", lambda k: finite(k) and k >= 0),
        help="drag coefficient over mass, 1/m, in place of --v-lim; 0 is vacuum",
    )
    to.add_argument(
        "--g",
        metavar="G",
        default=9.81,
        type=_number("finite and > 0", "m/s^2", lambda g: finite(g) and g > 0),
        help="gravity, m/s^2 (default 9.81)",
    )
    to.add_argument(
        "--height",
        metavar="H",
        default=0.0,
        type=_number("finite", "m", finite),
        help="height of the launch above the landing plane, m; negative if below (default 0)",
    )


def add_exercise(to: Parser) -> None:
    """The exercise's constants, the language of what it writes, and the programs left blank."""
    for name, unit, words, usual in (
        ("mass", "kg", "mass", "1"),
        ("v0", "m/s", "launch speed", "70"),
        ("dt", "s", "time step of 6.3 to 6.5, and of 6.8", "0.001"),
        ("eta", "kg/s", "linear drag", "0.01"),
        ("lambda", "kg/m", "quadratic drag, 6.8", "0.1"),
        ("angle", "degrees", "launch angle of 6.3 and 6.8", "45"),
        ("g", "m/s^2", "gravity", "9.81"),
    ):
        to.add_argument(
            f"--{name}",
            dest="lambda_" if name == "lambda" else name,
            metavar=name[0].upper(),
            type=_number("finite and > 0", unit, lambda value: math.isfinite(value) and value > 0),
            help=f"{words}, {unit} (default {usual})",
        )
    to.add_argument(
        "--lang",
        choices=("en", "fr"),
        default="en",
        help="language of page, figures and comments (default en); programs are in French",
    )
    to.add_argument(
        "--student",
        action="store_true",
        help="instead, only the programs, with functions left blank, and tests for a class",
    )


def add_points(to: Parser) -> None:
    """How many points of a path."""
    to.add_argument(
        "-n", metavar="N", type=_points, default=200, help="number of points (default 200)"
    )


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
