"""What launches and their results can do as values: compare, be shown, become plain Python."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any

import numpy as np


class Record:
    """A frozen dataclass of numbers and arrays, which has no hash, as arrays have none."""

    def __eq__(self, other: object) -> bool:
        """Whether all fields are the same numbers in the same shape; NaN is equal to NaN."""
        if type(self) is not type(other):
            return NotImplemented
        mine, theirs = _items(self), _items(other)
        return all(_same(mine[name], theirs[name]) for name in mine)

    def __repr__(self) -> str:
        """One line: numbers as they are, arrays by their shape."""
        return shown(self)

    def to_dict(self) -> dict[str, Any]:
        """The fields as plain numbers and nested lists, ready for ``json.dumps``.

        Returns
        -------
        dict
            Every field by its name; NaN stays a float.

        Examples
        --------
        >>> import hodograph
        >>> hodograph.Launch([30.0, 40.0], 0.5, 42.7).to_dict()["v0"]
        [30.0, 40.0]
        """
        return plain(self)


def plain(record: Any) -> dict[str, Any]:
    """The fields of a record or a named tuple as plain numbers and nested lists."""
    return {name: np.asarray(value).tolist() for name, value in _items(record).items()}


def shown(record: Any) -> str:
    """Its fields in one line: numbers as they are, arrays by their shape."""
    parts = (
        f"{name}=<array {value.shape}>" if np.ndim(value) else f"{name}={np.asarray(value).item()}"
        for name, value in _items(record).items()
    )
    return f"{type(record).__name__}({', '.join(parts)})"


def rounded(value: float, uncertainty: float) -> tuple[str, str]:
    """A value and its uncertainty, to two digits of the latter, which is finite and > 0."""
    places = 1 - math.floor(math.log10(uncertainty))
    if not 0 <= places <= 12:
        return f"{value:.6g}", f"{uncertainty:.2g}"
    return f"{value:.{places}f}", f"{uncertainty:.{places}f}"


def _same(mine: Any, theirs: Any) -> bool:
    if isinstance(mine, dict) and isinstance(theirs, dict):
        return mine.keys() == theirs.keys() and all(_same(mine[key], theirs[key]) for key in mine)
    if {np.asarray(mine).dtype.kind, np.asarray(theirs).dtype.kind} <= set("biuf"):
        return np.array_equal(mine, theirs, equal_nan=True)
    return bool(mine == theirs)  # words, or None


def _items(record: Any) -> dict[str, Any]:
    if hasattr(record, "_asdict"):  # a named tuple
        return dict(record._asdict())
    return {field.name: getattr(record, field.name) for field in fields(record)}
