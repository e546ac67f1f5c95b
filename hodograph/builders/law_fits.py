"""The library's own laws, fitted to exact values: the coefficients that `laws` holds.

Each law is fitted so that its largest relative error is least (minimax), by a sequence of linear
programs: near a solution the error is linear in the coefficients, and the solution of a linear
program is a vertex, the same on every machine to the last digit kept.  The coefficients are then
shortened one after another, the rest fitted again each time.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

from hodograph import laws
from hodograph.engine.domain import RIGHT_ANGLE, FloatArray
from hodograph.laws.minimax import ErrorOf, minimax
from hodograph.level import d_norm, optimal_angle

V_LAW, V_ANGLE_LAW = 1.5, 10.0  # the fits of d_norm_law and alpha_max_law go up to here
BEYOND = 0.02  # weight of the error of alpha_max_law from there to 1e6
# Largest errors that the shortened coefficients may leave.
ALLOWED = {"d_norm_law": 7.7e-5, "d_norm_law_all": 8.4e-3, "alpha_max_law": 9.7e-5}


class LawFit(NamedTuple):
    """Coefficients of a law, shortened, and the largest relative error on the fit's points."""

    name: str
    coefficients: tuple[float, ...]
    unrounded: tuple[float, ...]
    worst: float


def shorten(
    error: ErrorOf, exact: FloatArray, allowed: float, *, most: int = 8
) -> tuple[float, ...]:
    """Coefficients with the fewest decimals that keep the largest error within `allowed`.

    They start from `exact`, the solution of `minimax`, and are rounded one after another, the
    later ones fitted again to make up for it.  `RuntimeError` if `most` decimals are not enough.
    """
    for decimals in range(2, most + 1):
        kept = np.array(exact)
        for j in range(kept.size):
            kept[j] = np.round(kept[j], decimals)
            head, rest = kept[: j + 1].copy(), kept[j + 1 :]
            if rest.size and np.all(rest):
                kept[j + 1 :] = minimax(_with(error, head), rest, steps=30)[0]
        if np.max(np.abs(error(kept))) <= allowed:
            return tuple(np.round(kept, decimals).tolist())
    raise RuntimeError(f"{most} decimals leave more than {allowed:g}")


def _with(error: ErrorOf, head: FloatArray) -> ErrorOf:
    return lambda rest: error(np.concatenate([head, rest]))


def crowded(low: float, high: float, n: int) -> FloatArray:
    """n points from low to high, crowded towards both ends as Chebyshev extrema are."""
    return np.asarray(low + (high - low) * np.sin(np.linspace(0, RIGHT_ANGLE, n)) ** 2)


# --- the three laws -------------------------------------------------------------------------------


def shape_of_law(alpha0: FloatArray, v: FloatArray, c: FloatArray) -> FloatArray:
    """M of `laws.d_norm_law`: a polynomial in alpha0, and two numbers that go with v."""
    return np.asarray(Polynomial(c[:-2])(alpha0) + v * (c[-2] + c[-1] * np.sin(2 * alpha0)))


def _error_of_law() -> ErrorOf:
    v, alpha0 = crowded(0, V_LAW, 26)[1:, np.newaxis], crowded(0, RIGHT_ANGLE, 36)[1:]
    y, exact = laws.first_order(alpha0) * v * v, d_norm(v, alpha0)

    def error(c: FloatArray) -> FloatArray:
        M = shape_of_law(alpha0, v, c)
        return np.asarray((1 + y / M) ** -M / exact - 1).ravel()

    return error


def _error_of_law_all() -> ErrorOf:
    low = np.deg2rad([0.001, 0.01, 0.1, 0.5, 1, 2, 3])
    alpha0 = np.concatenate([low, crowded(np.deg2rad(5), RIGHT_ANGLE, 18)])
    parts = [np.linspace(0.1, 3, 20), np.geomspace(3.4, 100, 16), np.geomspace(150, 1e8, 12)]
    v = np.concatenate([*parts, [1e12, 1e20]])[:, np.newaxis]
    exact, S = d_norm(v, alpha0), np.sin(alpha0)
    T, y = laws.first_order(alpha0) / S, v * v * S

    def error(c: FloatArray) -> FloatArray:
        G = c[0] * T ** -c[1]
        bracket = np.abs(1 + (2 - T) * y * (1 + c[3] * y) / (c[2] * G))
        h = np.maximum(1 + G / S * (1 - bracket ** (-c[2] * S)), 1e-3)
        return np.asarray(np.log1p(4 * y * h) / (4 * y) / exact - 1).ravel()

    return error


def _error_of_angle_law() -> ErrorOf:
    v = np.concatenate([crowded(0, V_ANGLE_LAW, 80)[1:], np.geomspace(11, 1e6, 40)])
    weight, exact = np.where(v <= V_ANGLE_LAW, 1.0, BEYOND), optimal_angle(v)

    def error(c: FloatArray) -> FloatArray:
        near, far = np.log1p(np.abs(c[1]) * v * v), np.log1p(np.abs(c[3]) * v * v)
        law = np.pi / 4 * np.maximum(1 + c[0] * near + c[2] * far, 0.1) ** -c[4]
        return np.asarray((law / exact - 1) * weight)

    return error


_LAWS: dict[str, tuple[Callable[[], ErrorOf], tuple[float, ...]]] = {
    "d_norm_law": (_error_of_law, (0.65, 0.01, 0.1, -0.15, 0.16, -0.06, 0.01, 0.01)),
    "d_norm_law_all": (_error_of_law_all, (8.0, 4.0, 0.15, 0.4)),
    "alpha_max_law": (_error_of_angle_law, (0.2, 0.8, 0.1, 0.1, 0.75)),
}
WRITTEN = {
    "d_norm_law": (*laws.LAW_M, *laws.LAW_V),
    "d_norm_law_all": laws.LAW_ALL,
    "alpha_max_law": laws.LAW_ANGLE,
}


def fit_law(name: str) -> LawFit:
    """Fit one of the library's laws afresh.

    It is one of `WRITTEN`, whose coefficients it is to give back, in their order.

    >>> fit_law("d_norm_law_all").coefficients
    (7.781, 4.179, 0.135, 0.436)
    """
    if name not in _LAWS:
        raise ValueError(f"name must be one of {', '.join(map(repr, _LAWS))}; got {name!r}")
    make, start = _LAWS[name]
    error = make()
    exact, _ = minimax(error, np.array(start))
    short = shorten(error, exact, ALLOWED[name])
    worst = float(np.max(np.abs(error(np.array(short)))))
    return LawFit(name, short, tuple(exact.tolist()), worst)


def fit_all() -> list[LawFit]:
    """Fit the three laws, in some seconds."""
    return [fit_law(name) for name in _LAWS]
