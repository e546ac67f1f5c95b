"""Table 1: the fit that gives back its digits, and what can be told of its settings.

The paper states v_norm to 1.5 and "for example 0.01 degree" for Newton's stop; neither angles, nor
steps, nor weights.  `search` varies each setting about the one `Procedure` that gives the printed
numbers: d_norm by eqs. 20, 15 and 21 with Newton stopped at a step of 0.01 *radian*; K and M of
eq. 22 by least squares at each angle; then the cubic of K and the quadratic of M.
"""

import itertools
import logging
import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial
from scipy.integrate import trapezoid

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.laws.minimax import minimax
from hodograph.laws.vial import V_MAX
from hodograph.level import d_norm
from hodograph.path import position, speed
from hodograph.report import tables

FILE = "table_1_search.csv"
COMMAND = "hodograph fit --out data/laws --force"
NAMES = (*(f"K_a{i}" for i in range(4)), *(f"M_a{i}" for i in range(3)))
PRINTED = np.array([*laws.TABLE_1_K, *laws.TABLE_1_M])
HALF_DIGITS = np.array([0.5e-5] * 4 + [0.5e-6] * 3)
DEGREE = math.radians(1)
SHOWN = np.deg2rad(np.arange(10.0, 80.5, 0.5))  # where curves are compared


class Procedure(NamedTuple):
    """How Table 1 is fitted; the defaults give the printed digits."""

    stop: float = 0.01  # of Newton, in radians; 0 is the exact landing
    v_max: float = V_MAX
    v_step: float = 0.02
    low: int = 10  # angles, in degrees
    high: int = 80
    step: float = 5
    weight: str = "d_norm"  # the residuals that are squared: of d_norm, relative, or of d
    held: bool = False  # a third stage: K fitted once more with M held at its polynomial
    panel: float = 0.0  # trapezia of so many degrees; 0 is the exact integral


class Fit(NamedTuple):
    """K and M at each angle, and the polynomials through them."""

    how: Procedure
    alpha0: FloatArray
    K: FloatArray
    M: FloatArray
    coefficients: FloatArray  # K's four, then M's three

    @property
    def off(self) -> FloatArray:
        """Relative differences of the coefficients from print."""
        return np.asarray(self.coefficients / PRINTED - 1)

    @property
    def left(self) -> tuple[float, float]:
        """The largest difference from the printed curves K and M, between 10 and 80 degrees."""
        K, M = (np.max(np.abs(off)) for off in _curves(self.coefficients - PRINTED))
        return float(K), float(M)

    @property
    def curves(self) -> tuple[float, float]:
        """The same, relative."""
        pairs = zip(_curves(self.coefficients), _curves(PRINTED), strict=True)
        K, M = (np.max(np.abs(ours / printed - 1)) for ours, printed in pairs)
        return float(K), float(M)


def _curves(seven: FloatArray) -> tuple[FloatArray, FloatArray]:
    return Polynomial(seven[:4])(SHOWN), Polynomial(seven[4:])(SHOWN)


def v_axis(v_max: float = V_MAX, step: float = 0.01) -> FloatArray:
    """v_norm from 0 to v_max, by 0.01 as in the tables."""
    return np.asarray(np.arange(round(v_max / step) + 1) * step)


def newton_d_norm(v: FloatArray, alpha0: FloatArray, stop: float, panel: float = 0.0) -> FloatArray:
    """d_norm by the paper's own route, over the product of axes without 0.

    The iteration (20) stops at a step below `stop` radians, and its last iterate is kept: NaN if it
    passed the vertical.  The integrals are exact, or by trapezia of `panel` degrees.

    >>> newton_d_norm(np.array([1.4]), np.deg2rad([80]), 0.01).round(5)  # exactly 0.42682
    array([[0.42718]])
    """
    place = _trapezia if panel else position
    v, start = (np.ravel(axis) for axis in np.meshgrid(v, alpha0, indexing="ij"))
    width = (panel * DEGREE,) if panel else ()
    alpha, going = -start, np.ones(start.shape, bool)
    for _ in range(50):
        at = v[going], start[going], alpha[going]
        change = place(*at, *width)[1] / (speed(*at) ** 2 * np.tan(at[2]))
        new = at[2] + change
        alpha[going] = np.where(new > -np.pi / 2, new, np.nan)
        going[going] = np.abs(change) >= stop
        going &= np.isfinite(alpha)
        if not going.any():
            break
    x = np.full(v.shape, np.nan)
    good = np.isfinite(alpha)
    x[good] = place(v[good], start[good], alpha[good], *width)[0]
    return np.asarray(x / (v * v * np.sin(2 * start))).reshape(-1, alpha0.size)


def _trapezia(
    v: FloatArray, start: FloatArray, alpha: FloatArray, width: float
) -> tuple[FloatArray, FloatArray]:
    """x and y of eq. 15 by the trapezium rule, in panels of about `width`."""
    found = np.empty((2, v.size))
    for i in range(v.size):
        count = max(int(np.ceil((start[i] - alpha[i]) / width - 1e-9)), 2)
        u = np.linspace(start[i], alpha[i], count + 1)
        f = speed(v[i], start[i], u) ** 2
        found[:, i] = [-trapezoid(f, u), -trapezoid(f * np.tan(u), u)]
    return found[0], found[1]


def fit_columns(
    v: FloatArray, d: FloatArray, weight: FloatArray | float = 1.0, M: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """K and M of eq. 22 for each column of d(v, alpha0), by weighted least squares.

    Gauss-Newton, all columns at once; K alone where the `M` of each column is given.
    """
    square = (v * v)[:, np.newaxis]
    held = M is not None
    K, M = np.full(d.shape[1], 0.8), np.full(d.shape[1], 0.7) if M is None else M
    for _ in range(60):
        x = K * K * square / M
        law = (1 + x) ** -M
        by_K = -2 * law * K * square / (1 + x) * weight
        by_M = law * (x / (1 + x) - np.log1p(x)) * weight * (not held)
        left = (d - law) * weight
        a, b, c = (np.sum(p * q, axis=0) for p, q in ((by_K, by_K), (by_K, by_M), (by_M, by_M)))
        e, f = np.sum(by_K * left, axis=0), np.sum(by_M * left, axis=0)
        c = c + held  # the step in M is then 0
        determinant = a * c - b * b
        dK, dM = (c * e - b * f) / determinant, (a * f - b * e) / determinant
        K = np.clip(K + dK, 0.5 * K, 2 * K)
        M = np.clip(M + dM, 0.5 * M, 2 * M)
        if np.max(np.abs(dK / K)) < 1e-12 and np.max(np.abs(dM / M)) < 1e-12:
            break
    return K, M


def fit(how: Procedure | None = None) -> Fit:
    """Table 1 by one procedure, by default the one that gives the printed digits.

    >>> fit().coefficients[:4].round(4)  # printed: 0.24207, 1.56854, -1.16548, 0.26454
    array([ 0.2421,  1.5686, -1.1655,  0.2646])
    """
    how = Procedure() if how is None else how
    v, alpha0 = _axes(how)
    d = _distances(how._replace(weight="", held=False))
    weight = {"d_norm": np.ones_like(d), "relative": 1 / d, "d": (v * v)[:, np.newaxis] + 0 * d}
    K, M = fit_columns(v, d, weight[how.weight])
    quadratic = laws.fit_polynomial(alpha0, M, 2).coefficients
    if how.held:
        K, _ = fit_columns(v, d, weight[how.weight], Polynomial(quadratic)(alpha0))
    cubic = laws.fit_polynomial(alpha0, K, 3).coefficients
    return Fit(how, alpha0, K, M, np.concatenate([cubic, quadratic]))


def _axes(how: Procedure) -> tuple[FloatArray, FloatArray]:
    """v_norm without 0, where eq. 22 is 1 whatever K and M; and the angles."""
    v = v_axis(how.v_max, how.v_step)[1:]
    return v, np.arange(how.low, how.high + 1e-6, how.step) * DEGREE


@lru_cache(maxsize=256)
def _distances(how: Procedure) -> FloatArray:
    v, alpha0 = _axes(how)
    if how.stop == 0:
        return d_norm(v[:, np.newaxis], alpha0)
    return newton_d_norm(v, alpha0, how.stop, how.panel)


def whole() -> Fit:
    """K and M on exact distances at 1, 2, ..., 90 degrees, v_norm to 1.5 by 0.01."""
    return fit(Procedure(stop=0, v_step=0.01, low=1, high=90, step=1))


def free_errors() -> FloatArray:
    """Largest relative error of eq. 22 at 1, ..., 90 degrees with the K and M of `whole`."""
    found = whole()
    v = v_axis()[:, np.newaxis]
    law = laws.pearson_vii(v, found.K, found.M)
    return np.asarray(np.max(np.abs(law / d_norm(v, found.alpha0) - 1), axis=0))


# --- what can be told -----------------------------------------------------------------------


class Found(NamedTuple):
    """One way to fit, and which setting it varies."""

    varied: str
    fit: Fit


def variations() -> list[tuple[str, Procedure]]:
    """(what is varied, the procedure): each setting alone, all others as `Procedure` has them."""
    base = Procedure()
    windows = ((5, 80, 5), (15, 80, 5), (10, 75, 5), (10, 85, 5), (10, 80, 10), (10, 80, 7),
               (10, 80, 3.5), (10, 80, 2.5), (10, 80, 1))  # fmt: skip
    ways = [("nothing", base)]
    ways += [("stop", base._replace(stop=s)) for s in (0, 0.01 * DEGREE, 0.005, 0.009, 0.011, 0.02)]
    ways += [("v_norm_max", base._replace(v_max=v)) for v in (1.3, 1.4, 1.48, 1.52, 1.56)]
    ways += [("v_norm_step", base._replace(v_step=v)) for v in (0.005, 0.01, 0.025, 0.05, 0.1)]
    ways += [("angles", base._replace(low=a, high=b, step=c)) for a, b, c in windows]
    ways += [("weight", base._replace(weight=w)) for w in ("relative", "d")]
    ways += [("third stage", base._replace(held=True))]
    ways += [("trapezia", base._replace(panel=p)) for p in (0.1, 0.5, 1.0)]
    return ways


def combinations(stop: float) -> list[Procedure]:
    """Every combination of the other settings at one stop."""
    axes = itertools.product(
        (1.3, 1.4, V_MAX), (0.02, 0.05, 0.1), (5, 10, 15), (70, 75, 80, 85), (1, 5),
        ("d_norm", "relative", "d"), (False, True),
    )  # fmt: skip
    return [
        Procedure(stop, v_max, v_step, low, high, step, weight, held)
        for v_max, v_step, low, high, step, weight, held in axes
    ]


def search() -> list[Found]:
    """Every variation, and the nearest of all combinations with the stop of the text.

    After the `variations`, with Newton stopped at 0.01 degree as the text has it: the combination
    nearest to the printed K, and the one nearest to M, which may have had another window.
    """
    logging.getLogger("hodograph").info("Table 1, each setting of its fit varied")
    found = [Found(varied, fit(how)) for varied, how in variations()]
    others = [fit(how) for how in combinations(0.01 * DEGREE)]
    for i, letter in enumerate("KM"):
        near = min(others, key=lambda each: each.curves[i])
        found.append(Found(f"nearest {letter} of {len(others)} with 0.01 degree", near))
    return found


def rounding() -> tuple[float, float]:
    """How far K and M between 10 and 80 degrees may move by the rounding of the printed digits."""
    powers = SHOWN[-1] ** np.arange(4)
    return float(HALF_DIGITS[:4] @ powers), float(HALF_DIGITS[4:] @ powers[:3])


class Conditioning(NamedTuple):
    """How the coefficients of K's cubic move when the fit hardly changes."""

    condition: float  # of the powers of alpha0, each scaled to length 1
    one_angle: FloatArray  # largest relative change of each as an end of the window moves by 5°
    curve: float  # largest change of K(alpha0) itself, relative


def conditioning() -> Conditioning:
    """Measure how well the angles determine the cubic."""
    here = fit()
    powers = np.vander(here.alpha0, 4, increasing=True)
    ends = ((5, 80), (15, 80), (10, 75), (10, 85))
    moved = [fit(Procedure(low=low, high=high)).coefficients[:4] for low, high in ends]
    cubic = here.coefficients[:4]
    curves = [np.max(np.abs(powers @ (other - cubic) / (powers @ cubic))) for other in moved]
    return Conditioning(
        float(np.linalg.cond(powers / np.linalg.norm(powers, axis=0))),
        np.max([np.abs(other / cubic - 1) for other in moved], axis=0),
        float(max(curves)),
    )


@lru_cache
def least_error(low: float, high: float) -> float:
    """The least largest error of d_norm that a cubic K and a quadratic M can leave on a window.

    >>> f"{least_error(15, 80):.2%}"
    '0.12%'
    """
    v = np.linspace(0.05, V_MAX, 30)[:, np.newaxis]
    bend = np.cos(np.linspace(np.pi, 0, 36))  # crowded towards the ends
    alpha0 = np.deg2rad((low + high) / 2 + (high - low) / 2 * bend)
    exact = d_norm(v, alpha0)

    def error(seven: FloatArray) -> FloatArray:
        K, M = Polynomial(seven[:4])(alpha0), Polynomial(seven[4:])(alpha0)
        return np.asarray(laws.pearson_vii(v, K, np.maximum(M, 0.05)) / exact - 1).ravel()

    return minimax(error, PRINTED)[1]


def search_csv(found: list[Found]) -> str:
    """The content of `FILE`."""
    near = conditioning()
    about = (
        "Table 1 of Vial 2008 fitted again: the procedure that gives its digits, and each setting",
        "of it varied alone. K_curve, M_curve: largest relative difference of the curves from the",
        "printed ones between 10 and 80 degrees; then the same of each coefficient",
        f"K's cubic: condition number {near.condition:.0f}; an end of the window moved by 5",
        "degrees changes a0..a3 by up to "
        + ", ".join(f"{100 * x:.1f} %" for x in near.one_angle)
        + f", and K itself by {100 * near.curve:.2f} %",
    )
    heads = ("varied", "stop_deg", "v_norm_max", "v_norm_step", "alpha0_min_deg", "alpha0_max_deg")
    others = ("alpha0_step_deg", "residuals_of", "M_held", "trapezia_deg", "K_curve", "M_curve")
    rows = []
    for varied, each in found:
        stop, *rest, held, panel = each.how
        curves = (f"{curve:.1e}" for curve in each.curves)
        off = (f"{part:+.1e}" for part in each.off)
        rows.append((varied, f"{stop / DEGREE:.4g}", *rest, int(held), panel, *curves, *off))
    return tables.csv_text(about, (*heads, *others, *NAMES), rows, command=COMMAND)


def summary(found: list[Found]) -> str:
    """The procedure that gives the digits, in a line."""
    near = found[0].fit
    return (
        f"Table 1: {near.how.low} to {near.how.high} deg by {near.how.step:g}, v_norm to "
        f"{near.how.v_max:g}, Newton stopped at {near.how.stop:g} rad: K within "
        f"{100 * near.curves[0]:.4f} % of print, M within {100 * near.curves[1]:.4f} %"
    )
