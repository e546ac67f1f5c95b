"""The exercise's sentences in English and in French, and its numbers as each language writes them.

The sentences stand in ``texts/en.toml`` and ``texts/fr.toml``, under the same keys.
"""

import string
import tomllib
from collections.abc import Iterable, Mapping
from importlib.resources import files
from typing import Any

import numpy as np

LANGUAGES = ("en", "fr")
_NO_BREAK_SPACE = "\N{NO-BREAK SPACE}"


class Words(string.Formatter):
    r"""The sentences of one language; call it with a key and what stands in the braces.

    >>> Words("fr")("axes.distance")
    'distance $x$ (m)'
    >>> Words("fr").number(1234.5, ",.1f")
    '1\xa0234,5'
    >>> ENGLISH.listed(["Euler", "RK2", "RK4"])
    'Euler, RK2 and RK4'
    """

    def __init__(self, language: str = "en") -> None:
        if language not in LANGUAGES:
            raise ValueError(f"language must be one of {', '.join(LANGUAGES)}; got {language!r}")
        self.language = language
        text = files("hodograph.exercise").joinpath("texts", f"{language}.toml").read_text("utf-8")
        self.sentences: dict[str, str] = _flat(tomllib.loads(text))

    def __call__(self, key: str, **values: Any) -> str:
        """The sentence of that key, with the values put in."""
        return self.vformat(self.sentences[key], (), values)

    def format_field(self, value: Any, format_spec: str) -> str:
        """A value as the language writes it: a comma for the decimals in French; NaN is a dash."""
        if not isinstance(value, float | int | np.number):
            return str(super().format_field(value, format_spec))
        if np.isnan(value):
            return "–"
        written = format(value, format_spec)
        if self.language == "fr":
            return written.translate({ord(","): _NO_BREAK_SPACE, ord("."): ","})
        return written

    def number(self, value: float, spec: str = "g") -> str:
        """A number alone."""
        return self.format_field(value, spec)

    def listed(self, parts: Iterable[str]) -> str:
        """Parts with commas (semicolons, where they have commas in them), "and" before the last."""
        *others, last = parts
        comma = self("semicolon" if any("," in part for part in others) else "comma")
        return f"{comma.join(others)} {self('and')} {last}" if others else last

    def each(self, key: str, values: Mapping[str, float]) -> str:
        """A list of the same sentence with the value of each method."""
        return self.listed(
            self(key, name=self.short(method), value=value) for method, value in values.items()
        )

    def name(self, method: str) -> str:
        """What a method is called."""
        return self(f"names.{method}")

    def short(self, method: str) -> str:
        """The same, without what is in brackets."""
        return self.name(method).partition(" (")[0]


def _flat(table: Mapping[str, Any], before: str = "") -> dict[str, str]:
    flat: dict[str, str] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            flat |= _flat(value, f"{before}{key}.")
        else:
            flat[before + key] = value
    return flat


ENGLISH = Words("en")
