"""The paper's own route to the landing, as printed (eq. 13 and 20); nothing is built on it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain
from hodograph.engine.status import Status


class VialNewton(NamedTuple):
    """What the paper's own iteration gives: the last angle, the steps taken, and its status."""

    alpha: Any
    steps: Any
    status: Any


def newton_vial(
    v_norm: ArrayLike, alpha0: ArrayLike, *, stop: float = np.deg2rad(0.01), max_steps: int = 50
) -> VialNewton:
    """The landing angle by the iteration that the paper prints (eq. 20), for comparison.

    Newton on y(alpha) in the angle itself, from -alpha0, each integral taken afresh with
    `scipy.integrate.quad` over eq. 13 as printed, until two iterates differ by less than `stop`.
    It leaves (-pi/2, pi/2) at its first step for fast, steep launches: use `landing_angle`.

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, in [0, 1e20].
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].
    stop : float, optional
        The paper's stopping difference in radians, 0.01 degree by default; positive.
    max_steps : int, optional
        Steps before the iteration is given up, at least 1.

    Returns
    -------
    VialNewton
        `alpha` (the last iterate, NaN where the iteration failed), `steps`, and `status`:
        0 converged, 2 not converged within `max_steps`, 3 a NaN among the inputs, 4 left the
        domain.

    Examples
    --------
    >>> import numpy as np
    >>> result = newton_vial([1.0, 5.0], np.pi / 4)
    >>> np.rad2deg(result.alpha).round(3), result.steps, result.status
    (array([-57.273,     nan]), array([5, 1]), array([0, 4], dtype=int8))
    """
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.V_NORM), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    stop = domain.option("stop", stop, domain.POSITIVE)
    max_steps = domain.count("max_steps", max_steps, 1)
    rows = [
        _newton_vial(*pair, stop, max_steps) for pair in zip(v.ravel(), a0.ravel(), strict=True)
    ]
    columns = zip(*rows, strict=True) if rows else ((), (), ())
    types = (np.float64, np.intp, np.int8)
    return VialNewton(
        *(
            domain.restore(np.array(column, dtype), shape)
            for column, dtype in zip(columns, types, strict=True)
        )
    )


def speed2_as_printed(v: float, alpha0: float) -> Callable[[float], float]:
    """v^2 as a function of alpha, by eq. 13 as the paper prints it, which loses digits.

    NaN where it cannot be computed.
    """

    def primitive(a: float) -> float:  # the bracket of eq. 9
        return math.log(math.tan(a / 2 + math.pi / 4)) + math.sin(a) / math.cos(a) ** 2

    def v2(a: float) -> float:
        try:
            return w / math.cos(a) ** 2 / (1 - w * (primitive(a) - first))
        except (ValueError, ZeroDivisionError):
            return math.nan

    across, first = float(v) * math.cos(alpha0), primitive(alpha0)
    w = across * across
    return v2


def _newton_vial(v: float, alpha0: float, stop: float, max_steps: int) -> tuple[float, int, int]:
    if np.isnan(v) or np.isnan(alpha0):
        return np.nan, 0, Status.INVALID
    if alpha0 == 0:
        return 0.0, 0, Status.CONVERGED

    from scipy.integrate import quad  # slow to import, and only the paper's route needs it

    v2 = speed2_as_printed(v, alpha0)
    alpha = -alpha0
    for step in range(1, max_steps + 1):
        with np.errstate(all="ignore"):
            y = quad(lambda a: v2(a) * math.tan(a), alpha0, alpha, limit=200, full_output=1)[0]
            change = y / (v2(alpha) * np.tan(alpha)) if v > 0 else 0.0
        alpha -= change
        if not abs(alpha) < np.pi / 2:
            return np.nan, step, Status.LEFT_DOMAIN
        if abs(change) < stop:
            return alpha, step, Status.CONVERGED
    return np.nan, max_steps, Status.NOT_CONVERGED
