"""Formulas for d_norm side by side: error, cost, fitted numbers and length, measured in one run."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.laws import others as formulas
from hodograph.level import d_norm
from hodograph.report import clock

V_MAX = 1.5  # of the paper's domain
LAUNCHES, ROUNDS = 10_000, 25  # of the timing
C1 = "c1=3S/4+C^2/(8S)+artanh(S)C^2(1/2-C^2/(8S^2))"
# Points of the judgement: none is a point of a fit, but for the ends of the domain.
V_JUDGED = np.linspace(0.0037, V_MAX, 201)
ANGLES_JUDGED = np.deg2rad(np.concatenate([[0.0], np.geomspace(0.01, 1.03, 20),
                                           np.linspace(1.37, 90, 251)]))  # fmt: skip


class Formula(NamedTuple):
    """A formula for d_norm: v is v_norm, a alpha0, S and C its sine and cosine."""

    name: str
    text: str
    numbers: int
    source: str
    law: Callable[[Any, Any], Any]


FORMULAS = (
    Formula("1 - c1 v²", f"1-c1v^2;{C1}", 0, "expansion", formulas.d_norm_first_order),
    Formula("vertical limit", "(asinh(v)+atan(v))/(2v(1+v^2)^(1/2))", 0,
            "exact at 90°; Timmerman 1999", formulas.d_norm_upright),
    Formula("low angle, Lambert W", "-(b+W(-b exp(-b)))/(2z);z=2v^2SC;b=1/(1+z)", 0,
            "Parker 1977; Stewart 2014", formulas.d_norm_low),
    Formula("Chudinov", "((1+v^2(S+C^2artanh(S)))(1+v^2S/2))^(-1/2)", 0,
            "Chudinov 2014, table 1", formulas.d_norm_chudinov),
    Formula("Table 1", "(1+K^2v^2/M)^-M;K=0.24207+1.56854a-1.16548a^2+0.26454a^3;"
            "M=0.675688+0.046397a+0.031539a^2", 7, "Vial 2008, eq. 22", laws.table_1),
    Formula("d_norm_law_all", "ln(1+4v^2Sh)/(4v^2S);h=1+G/S(1-(1+(2-T)v^2S(1+0.436v^2S)/(0.135G))"
            f"^(-0.135S));G=7.781/T^4.179;T=c1/S;{C1}", len(laws.LAW_ALL), "this library",
            laws.d_norm_law_all),
    Formula("d_norm_law", "(1+c1v^2/M)^-M;M=0.65326+0.00779a+0.09792a^2-0.1493a^3+0.16266a^4"
            f"-0.05561a^5+v(0.01186+0.01082sin(2a));{C1}", len(laws.LAW_M) + len(laws.LAW_V),
            "this library", laws.d_norm_law),
)  # fmt: skip


class Compared(NamedTuple):
    """A formula measured."""

    formula: Formula
    domain: float  # largest relative error, v_norm to 1.5 and 0 to 90 degrees
    inner: float  # the same, 10 to 80 degrees
    legendre: float  # the same, v_norm = sqrt(10)
    far: float  # largest, v_norm to 1e6 and 0 to 90 degrees
    nanoseconds: float  # per launch, in arrays of LAUNCHES

    @property
    def length(self) -> int:
        """Characters of the formula as written, without spaces."""
        return len(self.formula.text.replace(" ", ""))


def error(law: Callable[[Any, Any], Any], v: FloatArray, alpha0: FloatArray) -> FloatArray:
    """Relative error of a law over the product of two axes."""
    exact = d_norm(v[:, np.newaxis], alpha0)
    return np.asarray(law(v[:, np.newaxis], alpha0) / exact - 1)


def costs() -> list[float]:
    """Nanoseconds per launch of every formula: medians, over one array, on one core."""
    rng = np.random.default_rng(0)
    v, alpha0 = rng.uniform(0, V_MAX, LAUNCHES), rng.uniform(0, np.pi / 2, LAUNCHES)
    calls = [partial(formula.law, v, alpha0) for formula in FORMULAS]
    with clock.one_core():
        return [1e9 * seconds / LAUNCHES for seconds in clock.medians(calls, ROUNDS)]


def compare() -> list[Compared]:
    """Measure every one of `FORMULAS` on the paper's domain and beyond; some seconds."""
    inner = np.abs(np.rad2deg(ANGLES_JUDGED) - 45) <= 35
    far = np.concatenate([V_JUDGED[::5], np.geomspace(1.51, 1e6, 150)])
    rows = []
    for formula, nanoseconds in zip(FORMULAS, costs(), strict=True):
        near = np.abs(error(formula.law, V_JUDGED, ANGLES_JUDGED))
        wide = np.abs(error(formula.law, far, ANGLES_JUDGED))
        fast = np.abs(error(formula.law, np.sqrt([10.0]), ANGLES_JUDGED[inner]))
        errors = (near, near[:, inner], fast, wide)
        domain, middle, root, beyond = (float(part.max()) for part in errors)
        rows.append(Compared(formula, domain, middle, root, beyond, nanoseconds))
    return rows
