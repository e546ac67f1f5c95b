"""The paper's fits made again on exact values: K and M, Table 1, the alpha_max law.

The paper does not say on which angles and speeds it fitted; the windows tried here are data.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import optimize

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.level import d_norm, optimal_angle

V_MAX = 1.5  # the paper fits up to here
V_LIM = 42.7  # m/s, its baseball
# Windows tried for Table 1: the largest v_norm, the first and the last angle in degrees.
V_MAX_TRIED = (1.0, 1.1, 1.2, 1.3, 1.4, V_MAX)
LOWEST_TRIED, HIGHEST_TRIED = range(5, 16), range(70, 91)


class PearsonTable(NamedTuple):
    """K and M of eq. 22 fitted to exact d_norm at each angle, v_norm from 0 to v_max."""

    v_max: float
    alpha0: FloatArray
    K: FloatArray
    M: FloatArray
    worst: FloatArray  # largest relative residual of d_norm at each angle


class Table1(NamedTuple):
    """Coefficients of K(alpha0) and M(alpha0), and the window that they were fitted on."""

    low_deg: int
    high_deg: int
    v_max: float
    K: FloatArray
    M: FloatArray

    def differences(self) -> FloatArray:
        """Relative differences from the printed coefficients, K's four and then M's three."""
        printed = np.array([*laws.TABLE_1_K, *laws.TABLE_1_M])
        return np.asarray(np.concatenate([self.K, self.M]) / printed - 1)


class Refit(NamedTuple):
    """Table 1 made again: on the paper's whole domain, and where it comes nearest to print."""

    table: PearsonTable
    whole: Table1
    nearest: Table1


class AngleFit(NamedTuple):
    """K and M of the alpha_max law (angles in degrees) fitted up to v_max, in m/s."""

    v_max: float
    K: float
    M: float
    worst: float


def v_axis(v_max: float = V_MAX) -> FloatArray:
    """v_norm from 0 to v_max by 0.01, as the tables have it."""
    return np.asarray(np.arange(round(100 * v_max) + 1) / 100)


def pearson_table(v_max: float = V_MAX) -> PearsonTable:
    """Fit K and M to exact d_norm at each angle from 1 to 90 degrees (eq. 22, figure 5).

    Parameters
    ----------
    v_max : float, optional
        The fit takes v_norm from 0 to this, by 0.01.

    Returns
    -------
    PearsonTable
        K and M at each angle, and the largest relative residual.

    Examples
    --------
    >>> table = pearson_table()
    >>> print(f"K = {table.K[44]:.3f}, M = {table.M[44]:.3f} at 45 degrees")
    K = 0.882, M = 0.731 at 45 degrees
    """
    v, alpha0 = v_axis(v_max), np.deg2rad(np.arange(1, 91))
    exact = d_norm(v[:, np.newaxis], alpha0)
    fits = [laws.fit_pearson(v, column) for column in exact.T]
    worst = [np.max(np.abs(f.residuals / y)) for f, y in zip(fits, exact.T, strict=True)]
    K, M = np.array([f.K for f in fits]), np.array([f.M for f in fits])
    return PearsonTable(v_max, alpha0, K, M, np.array(worst))


def fit_table_1(table: PearsonTable, low_deg: int, high_deg: int) -> Table1:
    """The cubic for K and the quadratic for M over the angles of a window, in radians.

    Parameters
    ----------
    table : PearsonTable
        K and M at 1, 2, ..., 90 degrees.
    low_deg, high_deg : int
        First and last angle taken.

    Returns
    -------
    Table1
        The coefficients.

    Examples
    --------
    >>> fit_table_1(pearson_table(1.3), 9, 80).K.round(2)  # printed: 0.24, 1.57, -1.17, 0.26
    array([ 0.24,  1.57, -1.17,  0.27])
    """
    window = slice(low_deg - 1, high_deg)
    alpha0 = table.alpha0[window]
    K = laws.fit_polynomial(alpha0, table.K[window], 3).coefficients
    M = laws.fit_polynomial(alpha0, table.M[window], 2).coefficients
    return Table1(low_deg, high_deg, table.v_max, K, M)


def refit_table_1() -> Refit:
    """Make Table 1 again, and look for the window that the printed one was fitted on.

    The paper does not state its window.  Of those tried, the nearest is the one whose worst
    coefficient of the seven differs least from print.

    Returns
    -------
    Refit
        The fits at each angle, and the coefficients on both windows.
    """
    table = pearson_table()
    tables = [table if v_max == V_MAX else pearson_table(v_max) for v_max in V_MAX_TRIED]
    tried = (
        fit_table_1(each, low, high)
        for each in tables
        for low in LOWEST_TRIED
        for high in HIGHEST_TRIED
    )
    nearest = min(tried, key=lambda fit: float(np.max(np.abs(fit.differences()))))
    return Refit(table, fit_table_1(table, 1, 90), nearest)


def fit_angle_law(v_max: float, *, by_table_1: bool = False) -> AngleFit:
    """K and M of the alpha_max law, h = 45 degrees, to best angles at 0, 1, ..., v_max m/s.

    Parameters
    ----------
    v_max : float
        Fastest launch in m/s, for v_lim = 42.7 m/s.
    by_table_1 : bool, optional
        Take the angles from the printed law of section 3.2 instead of exact distances.

    Returns
    -------
    AngleFit
        K in s/m, M, and the largest relative residual.

    Examples
    --------
    >>> fit = fit_angle_law(64.0)
    >>> print(f"K = {fit.K:.4f} s/m, M = {fit.M:.3f}")  # printed: 0.0085864, 0.1366571
    K = 0.0086 s/m, M = 0.138
    """
    v0 = np.arange(v_max + 0.5)
    best = optimal_angle(v0 / V_LIM)
    if by_table_1:
        best = np.array([best_angle_of_law(v) for v in v0 / V_LIM])
    degrees = np.rad2deg(best)
    fit = laws.fit_pearson(v0, degrees, h=45.0)
    return AngleFit(v_max, fit.K, fit.M, float(np.max(np.abs(fit.residuals / degrees))))


def best_angle_of_law(v_norm: float) -> float:
    """Launch angle of greatest range by the printed law of section 3.2."""
    found = optimize.minimize_scalar(
        lambda a: -float(np.sin(2 * a) * laws.table_1(v_norm, a)),
        bounds=(0.5, 1.0),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return float(found.x)


def nearest_angle_law() -> AngleFit:
    """The fit of the alpha_max law nearest to print, by the fastest launch taken, 50-100 m/s."""
    printed = laws.ALPHA_MAX_K, laws.ALPHA_MAX_M
    fits = (fit_angle_law(float(v_max)) for v_max in range(50, 101))
    return min(fits, key=lambda f: max(abs(f.K / printed[0] - 1), abs(f.M / printed[1] - 1)))
