"""How Table 1 may have come about: the paper's fit remade in every plausible way.

The paper states neither the angles and speeds that it fitted nor how it weighed them.  Each
variant below is tried on every window; how near the seven printed coefficients come says what
can be told, and what cannot.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial
from scipy.integrate import trapezoid
from scipy.optimize import least_squares

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.engine.vial import newton_vial
from hodograph.level import d_norm
from hodograph.paper.refit import LOWEST_TRIED, pearson_table
from hodograph.path import speed

V_MAX_TRIED = tuple(round(0.1 * i, 1) for i in range(9, 21))
LOW_TRIED, HIGH_TRIED = range(1, LOWEST_TRIED[-1] + 1), range(70, 91)
PRINTED = np.array([*laws.TABLE_1_K, *laws.TABLE_1_M])
DEGREES = np.arange(1.0, 91.0)


class Found(NamedTuple):
    """The window of a variant that comes nearest to print."""

    variant: str
    v_max: float
    low_deg: int
    high_deg: int
    coefficients: FloatArray  # K's four, then M's three

    @property
    def off(self) -> FloatArray:
        """Relative differences from print."""
        return np.asarray(self.coefficients / PRINTED - 1)

    @property
    def worst(self) -> float:
        """The largest of them."""
        return float(np.max(np.abs(self.off)))


def fit_columns(v: FloatArray, d: FloatArray, weight: FloatArray) -> tuple[FloatArray, FloatArray]:
    """K and M of eq. 22 for each column of d(v, alpha0), by weighted least squares.

    Gauss-Newton in K and M, all columns at once.

    Parameters
    ----------
    v : ndarray
        Speeds, one a row.
    d : ndarray
        d_norm, of shape (speeds, angles).
    weight : ndarray
        Weights of the residuals, broadcast against `d`.

    Returns
    -------
    K, M : ndarray
        One for each column.
    """
    square = (v * v)[:, np.newaxis]
    K, M = np.full(d.shape[1], 0.8), np.full(d.shape[1], 0.7)
    for _ in range(60):
        x = K * K * square / M
        law = (1 + x) ** -M
        by_K = -2 * law * K * square / (1 + x) * weight
        by_M = law * (x / (1 + x) - np.log1p(x)) * weight
        left = (d - law) * weight
        a, b, c = (np.sum(p * q, axis=0) for p, q in ((by_K, by_K), (by_K, by_M), (by_M, by_M)))
        e, f = np.sum(by_K * left, axis=0), np.sum(by_M * left, axis=0)
        determinant = a * c - b * b
        dK, dM = (c * e - b * f) / determinant, (a * f - b * e) / determinant
        K = np.clip(K + dK, 0.5 * K, 2 * K)
        M = np.clip(M + dM, 0.5 * M, 2 * M)
        if np.max(np.abs(dK / K)) < 1e-12 and np.max(np.abs(dM / M)) < 1e-12:
            break
    return K, M


def coarse_d_norm(v: FloatArray, alpha0: FloatArray, step: float) -> FloatArray:
    """d_norm by the trapezium rule in steps of alpha, to the landing of (20) at 0.01 degree.

    Parameters
    ----------
    v, alpha0 : ndarray
        Axes.
    step : float
        Step in alpha, radians; 0 for the exact integral to the inexact landing.

    Returns
    -------
    ndarray
        d_norm, of shape (speeds, angles).
    """
    landing = newton_vial(v[:, np.newaxis], alpha0).alpha
    result = np.ones((v.size, alpha0.size))
    for i, j in np.ndindex(result.shape):
        if v[i] > 0:
            nodes = max(round((alpha0[j] - landing[i, j]) / step), 1) + 1
            alpha = np.linspace(alpha0[j], landing[i, j], nodes)
            x = -float(trapezoid(speed(v[i], alpha0[j], alpha) ** 2, x=alpha))
            result[i, j] = x / (v[i] ** 2 * np.sin(2 * alpha0[j]))
    return result


def _windows(
    variant: str, v_max: float, degrees: FloatArray, K: FloatArray, M: FloatArray
) -> Found:
    """The nearest of all windows of angle, K and M being given at `degrees`."""
    alpha0, best = np.deg2rad(degrees), None
    for low in LOW_TRIED:
        for high in HIGH_TRIED:
            inside = (degrees >= low) & (degrees <= high)
            if np.count_nonzero(inside) < 5:
                continue
            a = alpha0[inside]
            powers = np.vander(a, 4, increasing=True)
            cubic = np.linalg.lstsq(powers, K[inside], rcond=None)[0]
            quadratic = np.linalg.lstsq(powers[:, :3], M[inside], rcond=None)[0]
            found = Found(variant, v_max, low, high, np.concatenate([cubic, quadratic]))
            if best is None or found.worst < best.worst:
                best = found
    assert best is not None
    return best


def _two_stage() -> Iterator[Found]:
    alpha0 = np.deg2rad(DEGREES)
    fine = np.arange(201) / 100
    exact = d_norm(fine[:, np.newaxis], alpha0)
    variants: dict[str, tuple[int, int, Callable[[FloatArray, FloatArray], FloatArray]]] = {
        "two stages, d_norm": (1, 1, lambda v, d: np.ones_like(d)),
        "two stages, relative": (1, 1, lambda v, d: 1 / d),
        "two stages, distance d": (1, 1, lambda v, d: v * v * np.ones_like(d)),
        "two stages, v_norm by 0.05": (5, 1, lambda v, d: np.ones_like(d)),
        "two stages, v_norm by 0.1": (10, 1, lambda v, d: np.ones_like(d)),
        "two stages, angles by 5 degrees": (1, 5, lambda v, d: np.ones_like(d)),
        "two stages, angles by 10 degrees": (1, 10, lambda v, d: np.ones_like(d)),
    }
    for name, (every, apart, weigh) in variants.items():
        columns = slice(apart - 1, None, apart)
        best = None
        for v_max in V_MAX_TRIED:
            v = fine[: round(100 * v_max) + 1 : every]
            d = exact[: round(100 * v_max) + 1 : every, columns]
            K, M = fit_columns(v, d, weigh(v[:, np.newaxis], d))
            found = _windows(name, v_max, DEGREES[columns], K, M)
            best = found if best is None or found.worst < best.worst else best
        assert best is not None
        yield best


def _inexact() -> Iterator[Found]:
    """d_norm as a paper of 2008 may have computed it."""
    degrees = np.arange(5.0, 90.0, 5.0)
    v = np.arange(1.6, step=0.1)
    for step_deg in (0.1, 1.0):
        d = coarse_d_norm(v, np.deg2rad(degrees), np.deg2rad(step_deg))
        best = None
        for v_max in (1.2, 1.3, 1.4, 1.5):
            rows = slice(0, round(10 * v_max) + 1)
            K, M = fit_columns(v[rows], d[rows], np.ones_like(d[rows]))
            name = f"two stages, 0.01° stop, trapezia of {step_deg:g}°"
            found = _windows(name, v_max, degrees, K, M)
            best = found if best is None or found.worst < best.worst else best
        assert best is not None
        yield best


def _at_once() -> Iterator[Found]:
    weights: dict[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
        "at once, d_norm": lambda v, a, d: np.ones_like(d),
        "at once, relative": lambda v, a, d: 1 / d,
        "at once, distance d": lambda v, a, d: v * v * np.sin(2 * a) + 0 * d,
    }
    for name, weigh in weights.items():
        best = None
        for v_max in (1.0, 1.2, 1.3, 1.4, 1.5):
            v = np.linspace(0, v_max, 16)[1:, np.newaxis]
            for low in (1, 5, 8, 9, 10, 12, 15):
                for high in (75, 80, 85, 90):
                    a = np.deg2rad(np.arange(low, high + 1, 2))
                    d = d_norm(v, a)
                    found = Found(name, v_max, low, high, _fit_at_once(v, a, d, weigh(v, a, d)))
                    best = found if best is None or found.worst < best.worst else best
        assert best is not None
        yield best


def _fit_at_once(v: FloatArray, a: FloatArray, d: FloatArray, weight: FloatArray) -> FloatArray:
    def residuals(c: FloatArray) -> FloatArray:
        K, M = Polynomial(c[:4])(a), np.maximum(Polynomial(c[4:])(a), 0.05)
        return np.asarray(((1 + K * K * v * v / M) ** -M - d) * weight).ravel()

    return np.asarray(least_squares(residuals, PRINTED, xtol=1e-12, ftol=1e-12).x)


def search() -> list[Found]:
    """Every variant at its nearest window, nearest first; some seconds.

    Returns
    -------
    list of Found
        One for each variant.
    """
    return sorted([*_two_stage(), *_inexact(), *_at_once()], key=lambda found: found.worst)


class Conditioning(NamedTuple):
    """How the coefficients of K's cubic move when the fit hardly changes (window 9-80 degrees)."""

    condition: float  # of the powers of alpha0, each scaled to length 1
    one_degree: FloatArray  # largest relative change of each as an end of the window moves by 1°
    curve: float  # largest relative change of K(alpha0) itself as the window moves


def conditioning(v_max: float = 1.3, low: int = 9, high: int = 80) -> Conditioning:
    """Measure how well the window determines the cubic.

    Parameters
    ----------
    v_max : float, optional
        Speeds fitted.
    low, high : int, optional
        Window, degrees.

    Returns
    -------
    Conditioning
        The measures.
    """
    table = pearson_table(v_max)
    alpha0 = np.deg2rad(DEGREES)

    def cubic(first: int, last: int) -> FloatArray:
        inside = slice(first - 1, last)
        powers = np.vander(alpha0[inside], 4, increasing=True)
        return np.asarray(np.linalg.lstsq(powers, table.K[inside], rcond=None)[0])

    here = cubic(low, high)
    others = [cubic(low + i, high + j) for i, j in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    inside = slice(low - 1, high)
    powers = np.vander(alpha0[inside], 4, increasing=True)
    curves = [np.max(np.abs(powers @ (other - here) / (powers @ here))) for other in others]
    return Conditioning(
        float(np.linalg.cond(powers / np.linalg.norm(powers, axis=0))),
        np.max([np.abs(other / here - 1) for other in others], axis=0),
        float(max(curves)),
    )
