"""Numbers as they are written on the command line: with or without a unit, one or several."""

from __future__ import annotations

import argparse
import contextlib
import math
import re
from collections.abc import Callable

# What one of each unit is in ours: times a number over another, so that 36 km/h are 10 m/s.
_UNITS: dict[str, dict[str, tuple[float, float]]] = {
    "m/s": {
        "m/s mps": (1, 1),
        "km/h kmh kph": (1000, 3600),
        "mph": (44704, 100000),
        "ft/s fps": (3048, 10000),
        "kn kt knots": (1852, 3600),
    },
    "degrees": {"° deg degree degrees": (1, 1), "rad radian radians": (180, math.pi)},
    "m": {
        "m": (1, 1),
        "mm": (1, 1000),
        "cm": (1, 100),
        "km": (1000, 1),
        "in": (254, 10000),
        "ft": (3048, 10000),
        "yd": (9144, 10000),
        "mi": (1609344, 1000),
    },
    "m^2": {"m^2 m² m2": (1, 1), "cm^2 cm² cm2": (1, 10000)},
    "m/s^2": {"m/s^2 m/s² m/s2": (1, 1), "ft/s^2 ft/s² ft/s2": (3048, 10000)},
    "1/m": {"1/m /m": (1, 1)},
    "kg": {
        "kg": (1, 1),
        "g": (1, 1000),
        "oz": (28349523125, 10**12),
        "lb": (45359237, 10**8),
    },
    "kg/m^3": {"kg/m^3 kg/m³ kg/m3": (1, 1)},
    "s": {"s": (1, 1), "ms": (1, 1000), "min": (60, 1)},
    "kg/s": {"kg/s": (1, 1), "g/s": (1, 1000)},
    "kg/m": {"kg/m": (1, 1), "g/m": (1, 1000)},
    "": {},
}
_QUANTITY = re.compile(
    r"([-+]?[\d.,]+(?:e[-+]?\d+)?)\s*([^\W\d_].*|[°'\"%/].*|1/.*)?", re.IGNORECASE
)


def number(words: str, unit: str, holds: Callable[[float], bool]) -> Callable[[str], float]:
    """Converter for a number, in our unit or with its own, for which `holds`."""

    def convert(text: str) -> float:
        text = text.strip()
        value = _value(text, unit)
        overflow = math.isinf(value) and "inf" not in text.lower()
        if overflow or not holds(value):  # NaN holds nowhere
            raise argparse.ArgumentTypeError(f"must be {words}; got {text!r}")
        return value

    return convert


def numbers(
    words: str, unit: str, holds: Callable[[float], bool]
) -> Callable[[str], tuple[float, ...]]:
    """Converter for several, between commas: a unit after the last is that of all without one."""
    one = number(words, unit, holds)

    def convert(text: str) -> tuple[float, ...]:
        *others, last = text.split(",")
        found = _QUANTITY.fullmatch(last.strip())
        own = (found and found[2]) or ""
        return (*(one(f"{other}{own}" if _bare(other) else other) for other in others), one(last))

    return convert


def _bare(text: str) -> bool:
    found = _QUANTITY.fullmatch(text.strip())
    return found is not None and not found[2]


def _value(text: str, unit: str) -> float:
    """The number in our unit."""
    with contextlib.suppress(ValueError):
        return float(text)
    found = _QUANTITY.fullmatch(text.replace("\N{MINUS SIGN}", "-"))
    own = ((found and found[2]) or "").strip()
    times, over = _factor(own, unit) if own else (1, 1)
    if found and times:
        with contextlib.suppress(ValueError):
            return float(found[1]) * times / over
    raise argparse.ArgumentTypeError(_no_number(text, unit, found and found[1], own, times))


def _factor(own: str, unit: str) -> tuple[float, float]:
    """What one of a unit is in ours; 0 where it is none of this kind."""
    for spellings, factor in _UNITS[unit].items():
        if own.lower() in spellings.split(" "):
            return factor
    return 0, 1


def _no_number(text: str, unit: str, digits: str | None, own: str, times: float) -> str:
    """What is expected in place of what is no number, and how this one would be written."""
    expected = f"must be a number of {unit}" if unit else "must be a number"
    if digits is not None and own and not times:
        known = [spellings.split(" ")[0] for spellings in _UNITS[unit]]
        expected += f", or with its unit: {', '.join(known)}" if known else ", without a unit"
        return f"{expected}; got {text!r}"
    if digits is not None and "," in digits:
        expected += ", with a point for the decimals and no comma"
        if write := [f"{value:.9g}{own}" for value in _meant(digits)]:
            return f"{expected}; got {text!r} (write {' or '.join(write)})"
    return f"{expected}; got {text!r}"


def _meant(digits: str) -> list[float]:
    """What a number with commas may mean."""
    point = digits.replace(",", ".") if "." not in digits else digits.replace(",", "")
    readings = [point]
    if re.fullmatch(r"[-+]?\d{1,3},\d{3}", digits):  # or thousands
        readings.append(digits.replace(",", ""))
    values = []
    for reading in readings:
        with contextlib.suppress(ValueError):
            values.append(float(reading))
    return values
