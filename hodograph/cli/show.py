"""How results are shown: a table for people, JSON for programs."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from hodograph.cli.streams import FailedError, put

STATUS = ("converged", "unreachable", "not converged", "invalid")  # in the order of `Status`


class Row(NamedTuple):
    """One quantity: its name in JSON and in a table, its unit, and its values."""

    key: str
    name: str
    unit: str
    values: Any


def show(rows: Sequence[Row], status: Any, *, as_json: bool) -> None:
    """The rows, and the status below them: one object or column for each result."""
    words = [STATUS[int(code)] for code in np.ravel(status)]
    columns = [[float(value) for value in np.ravel(row.values)] for row in rows]
    if as_json:
        each = [
            {row.key: _finite_or_none(column[i]) for row, column in zip(rows, columns, strict=True)}
            | {"status": word}
            for i, word in enumerate(words)
        ]
        put(json.dumps(each if np.ndim(status) else each[0]) + "\n")
    else:
        put(_table(rows, columns, words))


def require_finite(*values: Any) -> None:
    """Refuse what no double holds."""
    if not all(np.isfinite(value).all() for value in values):
        raise FailedError("a result is beyond the range of double precision")


def _finite_or_none(value: float) -> float | None:
    return value if math.isfinite(value) else None


def digits(value: float) -> str:
    """Six significant digits; a dash where there is no result."""
    if math.isnan(value):
        return "-"
    if 1e-4 <= abs(value) < 1e6:
        return f"{value:#.6g}".rstrip(".")
    return f"{abs(value) and value:.6g}"


def _table(rows: Sequence[Row], columns: list[list[float]], words: list[str]) -> str:
    """Names, values with their decimal points in columns, units."""
    shown = [_aligned([digits(value) for value in each]) for each in zip(*columns, strict=True)]
    several = len(shown) > 1
    width = max(len(row.name) for row in rows)
    lines = [
        "  ".join([f"{row.name:<{width}}", *cells, row.unit])
        for row, *cells in zip(rows, *shown, strict=True)
    ]
    wide = [f"{word:<{len(cells[0])}}" for word, cells in zip(words, shown, strict=True)]
    last = "  ".join([f"{'status':<{width}}", *(wide if several else words)])
    return "\n".join(line.rstrip() for line in [*lines, last]) + "\n"


def _aligned(column: list[str]) -> list[str]:
    """The decimal points below one another."""
    parts = [text.partition(".") for text in column]
    whole = max(len(before) for before, *_ in parts)
    tail = max(len(point + after) for _, point, after in parts)
    return [f"{before:>{whole}}{point + after:<{tail}}" for before, point, after in parts]
