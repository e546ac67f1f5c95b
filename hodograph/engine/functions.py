"""The functions that a formula is made of, for arrays and for plain floats: one text serves both.

Of one number those of the `math` module take a twentieth of the time.  They pass no NaN through
`maximum`, and are not to meet one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np


class Functions(NamedTuple):
    """NumPy's names."""

    sin: Callable[..., Any]
    cos: Callable[..., Any]
    sqrt: Callable[..., Any]
    log: Callable[..., Any]
    log1p: Callable[..., Any]
    exp: Callable[..., Any]
    expm1: Callable[..., Any]
    arctan: Callable[..., Any]
    minimum: Callable[..., Any]
    maximum: Callable[..., Any]


ARRAYS = Functions(
    np.sin, np.cos, np.sqrt, np.log, np.log1p, np.exp, np.expm1, np.arctan, np.minimum, np.maximum
)
PLAIN = Functions(
    math.sin, math.cos, math.sqrt, math.log, math.log1p, math.exp, math.expm1, math.atan, min, max
)


def horner(coefficients: tuple[float, ...], x: Any) -> Any:
    """The polynomial, in place: `numpy.polynomial` takes twice as long."""
    value = x * coefficients[-1]
    value += coefficients[-2]
    for coefficient in coefficients[-3::-1]:
        value *= x
        value += coefficient
    return value
