"""A formula called for any arguments: checked once, and computed in plain floats or by blocks."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, one
from hodograph.engine.domain import Rule
from hodograph.engine.functions import ARRAYS, PLAIN

BLOCK = 4096  # elements worked on at once: what fits the cache


def evaluate(formula: Callable[..., Any], **arguments: tuple[ArrayLike, Rule]) -> Any:
    """What the formula makes of named arguments, which are given as to `domain.broadcast`.

    It is handed the arguments and the `Functions` that suit them: plain floats without NaN, or
    arrays.
    """
    given: list[tuple[Any, Rule]] = list(arguments.values())
    for value, rule in given:
        if not (one.is_within(-one.HUGE, value, one.HUGE) and rule.holds(value)):
            break
    else:
        return np.float64(formula(*(float(value) for value, _ in given), PLAIN))
    shape, arrays = domain.broadcast(**arguments)
    if shape == () and not any(map(np.isnan, arrays)):
        return np.float64(formula(*map(float, arrays), PLAIN))
    flat = [array.reshape(-1) for array in arrays]
    result = np.empty(flat[0].size)
    for first in range(0, result.size, BLOCK):
        block = slice(first, first + BLOCK)
        result[block] = formula(*(part[block] for part in flat), ARRAYS)
    return domain.restore(result, shape)
