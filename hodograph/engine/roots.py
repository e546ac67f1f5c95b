"""Roots of many functions at once, each from a guess that is near."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from hodograph.engine.domain import BoolArray, FloatArray

ROUNDS = 10
ENOUGH = 1e-15  # relative
STEADY = 4.0  # a secant slope that has changed by more is rounding noise, or far from the root


def near(
    function: Callable[..., FloatArray],
    guess: FloatArray,
    slope: float,
    bracket: tuple[FloatArray, FloatArray],
    args: Sequence[FloatArray],
) -> tuple[FloatArray, BoolArray]:
    """Roots of `function(x, *args)` within brackets, and whether they are found.

    The roots are positive.  The first step is taken with `slope`, which holds to some tens of
    percent, and those after it by the secant, until what two of them leave, their product, is
    rounding.  Where that does not settle, since the guess was far off, the bracket is searched.
    """
    low, high = bracket
    x, found = np.clip(guess, low, high), np.zeros(guess.shape, bool)
    slopes, before, value = np.full_like(x, slope), np.full_like(x, np.inf), np.full_like(x, np.nan)
    todo = np.arange(x.size)
    for _ in range(ROUNDS):
        if not todo.size:
            break
        here, moved = x[todo], before[todo]
        now = function(here, *(arg[todo] for arg in args))
        with np.errstate(divide="ignore", invalid="ignore"):
            secant = (now - value[todo]) / moved
            part = secant / slopes[todo]
        steady = (part * STEADY > 1) & (part < STEADY)
        slopes[todo] = np.where(steady, secant, slopes[todo])
        step = -now / slopes[todo]
        following = np.clip(here + step, low[todo], high[todo])
        x[todo], value[todo], before[todo] = following, now, following - here
        left = np.where(steady, np.minimum(np.abs(moved), here), here) * np.abs(step)
        found[todo] = (following == here + step) & (left < ENOUGH * here * here)
        todo = todo[~found[todo]]
    if todo.size:
        from scipy.optimize import elementwise  # slow to import, and seldom needed

        searched = elementwise.find_root(
            function,
            (low[todo], high[todo]),
            args=tuple(arg[todo] for arg in args),
            tolerances={"xrtol": 1e-15},
        )
        x[todo], found[todo] = searched.x, searched.success
    return x, found
