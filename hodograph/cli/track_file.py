"""A track as programs export it: which of the columns are t, x and y, and in which units.

Comma, semicolon, tab or blanks between the cells, a comma or a point for the decimals, comment
lines, a name of the track above the names of the columns, further columns: all as Tracker and
spreadsheets write them.
"""

from __future__ import annotations

import codecs
import csv
import math
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hodograph.cli.streams import FailedError, UsageError
from hodograph.engine.domain import FloatArray

LARGEST = 50_000_000  # bytes
COMMENTS = ("#", "%", "//")
MISSING = {"", "nan", "-", "--", "na", "n/a", "none", "null"}
LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0, "ft": 0.3048, "in": 0.0254}
TIMES = {"s": 1.0, "sec": 1.0, "ms": 0.001, "min": 60.0}
# and their other names, in the singular
WORDS = {
    "metre": "m",
    "meter": "m",
    "centimetre": "cm",
    "centimeter": "cm",
    "millimetre": "mm",
    "millimeter": "mm",
    "foot": "ft",
    "feet": "ft",
    "inch": "in",
    "inche": "in",
    "mètre": "m",
    "second": "s",
    "sekunde": "s",
    "sekunden": "s",
    "seconde": "s",
    "millisecond": "ms",
    "minute": "min",
}
PIXELS = {"px", "pixel", "pixels", "pix"}
FRAMES = {"frame", "frames", "step", "image"}
# A unit behind the name: x (m), x [m], x/m, "x, m", x in m, x_cm
UNIT = (
    r"(.*?)\s*(?:\(\s*(.*?)\s*\)|\[\s*(.*?)\s*\]|/\s*(\w+)|,\s*(\w+)|\s(?:in|en)\s+(\w+)"
    r"|[ _](cm|mm|ms|px|pixels?))"
)
# The names of a column, the surest first: alone, then with that of the body.
NAMES = {
    "t": (r"t|time|zeit|temps|tiempo|tempo", r"(t|time|zeit|temps|tiempo|tempo)[ _].*"),
    "x": (r"x|(pos(ition)?[ _.-]?)x|x[ _.-]?pos(ition)?", r"x[ _.](?!v|a\b|acc).*"),
    "y": (r"y|(pos(ition)?[ _.-]?)y|y[ _.-]?pos(ition)?", r"y[ _.](?!v|a\b|acc).*"),
}


class Column(NamedTuple):
    """A column by its place, its name as it stands, and its unit; both may be empty."""

    place: int
    name: str
    unit: str


class Track(NamedTuple):
    """Times (None if there are none), positions, and the columns they were."""

    t: FloatArray | None
    x: FloatArray
    y: FloatArray
    taken: dict[str, Column]
    skipped: int


def read(
    path: Path, columns: str | None, scale: float | None, fps: float | None, *, times: bool = True
) -> Track:
    """The track of a file.

    `columns` names two or three columns, or tells their numbers, as x,y or t,x,y; `scale` is the
    length in m of one unit of the file, and `fps` how many units of its time are a second.
    """
    names, rows, skipped = _table(_text(path))
    if not rows:
        raise FailedError(f"{path}: no numbers in it")
    width = max(map(len, rows))
    found = _named(names, width) if columns is None else _asked(columns, names, width)
    if found is None:
        known = ", ".join(names) or f"{width} columns without names"
        raise FailedError(f"{path}: which columns are x and y? --columns t,x,y; there are {known}")
    if times and columns is None and fps is not None and "t" not in found:
        found |= _of_frames(path, names, width)
    if not times:
        found.pop("t", None)
    cells = np.array([[*row, *[math.nan] * (width - len(row))] for row in rows])
    if columns is None and names and np.isfinite(cells[:, len(names) :]).any(axis=1).mean() > 0.5:
        raise FailedError(
            f"{path}: rows of {width} numbers under {len(names)} names: which are they? "
            "--columns by numbers, 2,3,4; decimal commas need semicolons or tabs between the cells"
        )
    sizes = {"x": scale, "y": scale, "t": None if fps is None else 1 / fps}
    values = {
        role: cells[:, column.place] * (sizes[role] or _unit(path, role, column))
        for role, column in found.items()
    }
    for role, column in found.items():
        if not np.isfinite(values[role]).any():
            raise FailedError(f"{path}: no numbers in {role}, column {column.place + 1}")
    return Track(values.get("t"), values["x"], values["y"], found, skipped)


def _text(path: Path) -> str:
    if path.stat().st_size > LARGEST:
        raise FailedError(f"{path}: too large for a track")
    data = path.read_bytes()
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _table(text: str) -> tuple[list[str], list[list[float]], int]:
    """The names of the columns, the numbers, and how many lines below them were none."""
    lines = [line.strip("\r\n") for line in text.splitlines() if line.strip()]
    comments = [line.lstrip("#%/ ") for line in lines if line.lstrip().startswith(COMMENTS)]
    lines = [line for line in lines if not line.lstrip().startswith(COMMENTS)]
    split = _splitter(lines)
    names: list[str] = []
    rows: list[list[float]] = []
    skipped = 0
    for line in lines:
        cells = [cell.strip().strip("\"'").strip() for cell in split(line)]
        numbers = [_number(cell) for cell in cells]
        several = sum(number is not None and not math.isnan(number) for number in numbers) >= 2
        gap = len(cells) > 1 and None not in numbers
        if several or (gap and (rows or names)):
            rows.append([math.nan if number is None else number for number in numbers])
        elif rows:
            skipped += 1
        elif len(cells) > 1 and not gap and any(cell.strip("-=_") for cell in cells):
            names = _with_units(names, cells) or cells
    for line in comments if not names else ():  # names behind a mark of comment
        cells = [cell.strip().strip("\"'").strip() for cell in split(line)]
        if rows and len(cells) == len(rows[0]) and _named(cells, len(cells)):
            names = cells
    return names, rows, skipped


def _with_units(names: Sequence[str], units: Sequence[str]) -> list[str] | None:
    """The names with what a line below them, if it is of units, says."""
    known = {_unit_name(unit) for unit in units} - {""}
    if not names or not known or not known <= {*LENGTHS, *TIMES, *PIXELS, *FRAMES}:
        return None
    units = [*units, *[""] * len(names)]
    return [f"{name} ({unit})" if unit else name for name, unit in zip(names, units, strict=False)]


def _at_commas(line: str) -> list[str]:
    try:
        return next(csv.reader([line], skipinitialspace=True))
    except csv.Error:  # no text at all
        return line.split(",")


def _at_semicolons(line: str) -> list[str]:
    return line.split(";")


def _at_tabs(line: str) -> list[str]:
    return line.split("\t")


def _at_blanks(line: str) -> list[str]:
    return re.sub(r"\s+(?=[\[(])", "", line).split()  # a unit belongs to its name


def _splitter(lines: Sequence[str]) -> Callable[[str], list[str]]:
    """What separates the cells: most lines have it."""

    def share(mark: str) -> float:
        return sum(mark in line for line in lines) / max(len(lines), 1)

    if share("\t") > 0.5:
        return _at_tabs
    if share(";") > 0.5:
        return _at_semicolons
    digits = [line for line in lines if re.match(r"\s*[-+\d.]", line)]
    blanks = sum(len(line.split()) >= 2 and not re.search(r",\s", line) for line in digits)
    if share(",") > 0.5 and not blanks > len(digits) / 2:
        return _at_commas
    return _at_blanks


def _number(cell: str) -> float | None:
    """The number in a cell; NaN where there is none, None where there is a word."""
    text = cell.replace("\N{MINUS SIGN}", "-").replace("\N{NO-BREAK SPACE}", "")
    if text.lower() in MISSING:
        return math.nan
    if text.rfind(",") > text.rfind("."):  # the last mark is that of the decimals
        text = text.replace(".", "").replace(",", ".")
    text = text.replace(",", "")
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else math.nan


def _column(place: int, text: str) -> Column:
    """Name and unit of a column: ``x (m)``, ``x [m]``, ``x/m``, ``x in m``, ``x_cm``, ``x``."""
    found = re.fullmatch(UNIT, text)
    if found is None:
        return Column(place, text, "")
    return Column(place, found[1], next(part for part in found.groups()[1:] if part is not None))


def _named(names: Sequence[str], width: int) -> dict[str, Column] | None:
    """The columns by their names or, without, by their number."""
    if not names:
        roles = {2: "xy", 3: "txy"}.get(width)
        return {role: Column(i, "", "") for i, role in enumerate(roles)} if roles else None
    columns = [_column(place, name) for place, name in enumerate(names[:width])]
    found = {}
    for role, patterns in NAMES.items():
        for pattern in patterns:
            fits = [
                each
                for each in columns
                if re.fullmatch(pattern, re.sub(r"[{}$\\]|^[^:]*: *", "", each.name), re.IGNORECASE)
            ]
            if fits:
                found[role] = fits[0]
                break
    return found if {"x", "y"} <= set(found) else None


def _of_frames(path: Path, names: Sequence[str], width: int) -> dict[str, Column]:
    """The column that counts frames, for times."""
    columns = [_column(place, name) for place, name in enumerate(names[:width])]
    fits = [each for each in columns if each.name.lower() in FRAMES]
    if not fits:
        raise UsageError(f"argument --fps: {path} has no times; name them, --columns t,x,y")
    return {"t": fits[0]}


def _asked(columns: str, names: Sequence[str], width: int) -> dict[str, Column]:
    """The columns by what the user says they are."""
    words = [word.strip() for word in columns.split(",")]
    roles = {2: "xy", 3: "txy"}.get(len(words))
    if roles is None:
        raise UsageError(f"argument --columns: must be x,y or t,x,y; got {columns!r}")
    known = [_column(place, name) for place, name in enumerate(names[:width])]
    found = {}
    for role, word in zip(roles, words, strict=True):
        fits = [each for each in known if word in (names[each.place], each.name)]
        if not fits and word.isdecimal() and 1 <= int(word) <= width:
            place = int(word) - 1
            fits = [known[place] if place < len(known) else Column(place, "", "")]
        if not fits:
            have = ", ".join(names) or f"numbers from 1 to {width}"
            raise UsageError(f"argument --columns: no column {word!r}; there are {have}")
        found[role] = fits[0]
    return found


def _unit_name(text: str) -> str:
    """The symbol of a unit, by which it is known."""
    name = text.lower().strip("()[] ")
    return WORDS.get(name, WORDS.get(name.removesuffix("s"), name))


def _unit(path: Path, role: str, column: Column) -> float:
    """One unit of the column in m or s."""
    unit = _unit_name(column.unit)
    if role == "t" and (unit in FRAMES or column.name.lower() in FRAMES):
        raise FailedError(f"{path}: {column.name!r} counts frames: give their rate, --fps")
    known = TIMES if role == "t" else LENGTHS
    if not unit:
        return 1.0
    if unit in PIXELS:
        raise FailedError(
            f"{path}: {column.name!r} is in pixels: calibrate the film, or give the length of a "
            "pixel, --scale"
        )
    if unit not in known:
        hint = "--fps" if role == "t" else "--scale"
        raise FailedError(
            f"{path}: {column.name!r} is in {column.unit!r}; known are {', '.join(known)} ({hint} "
            "for others)"
        )
    return known[unit]
