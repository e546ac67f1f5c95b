"""The alpha_max law of section 3.3: what it was fitted to, as far as that can be told.

The paper states neither the speeds nor how the best angle was looked for.  Here the law is fitted
to angles that are exact, or found by a scan of the angle in steps, on distances that are exact or
from Newton's iteration as it was stopped for Table 1.
"""

from typing import NamedTuple

import numpy as np

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.laws.vial import V_LIM, V_MAX
from hodograph.level import d_norm, optimal_angle
from hodograph.paper.table_1 import Procedure, newton_d_norm, v_axis

EXACT, STOPPED, LAW = "exact", "stop of 0.01 rad", "law of table 1"
SPEEDS = {"v_norm by 0.02": v_axis(step=0.02), "v0 by 1 m/s": np.arange(65.0) / V_LIM}
FINE = 0.01  # degrees: the finest scan
SCAN = np.arange(3500, 4551) * FINE  # where the best angle is, for v_norm to 1.5
STEPS = (0.05, 0.1, 0.5)


class AngleFit(NamedTuple):
    """K (s/m) and M of the law fitted to best angles, h = 45 degrees held."""

    distances: str
    scan: float  # step in degrees; 0 for exact angles
    speeds: str
    K: float
    M: float
    worst: float  # largest relative residual

    @property
    def off(self) -> tuple[float, float]:
        """Relative differences of K and M from print."""
        return self.K / laws.ALPHA_MAX_K - 1, self.M / laws.ALPHA_MAX_M - 1


def fit(distances: str, scan: float, speeds: str, degrees: FloatArray) -> AngleFit:
    """The law fitted to best angles in degrees, at the speeds named."""
    v0 = SPEEDS[speeds] * V_LIM
    found = laws.fit_pearson(v0, degrees, h=45.0)
    worst = float(np.max(np.abs(found.residuals / degrees)))
    return AngleFit(distances, scan, speeds, found.K, found.M, worst)


def ranges(distances: str, v: FloatArray) -> FloatArray:
    """d / (v0^2/g) at speeds and the angles of `SCAN`; where v is 0, that of vacuum."""
    alpha0 = np.deg2rad(SCAN)
    if distances == EXACT:
        d = d_norm(v[:, np.newaxis], alpha0)
    elif distances == LAW:
        d = laws.table_1(v[:, np.newaxis], alpha0)
    else:
        stopped = newton_d_norm(v[v > 0], alpha0, Procedure().stop)
        d = np.ones((v.size, alpha0.size))
        d[v > 0] = stopped
    return np.asarray(d * np.sin(2 * alpha0))


def best_of_law(v: FloatArray) -> FloatArray:
    """Angle of greatest distance by the printed law of section 3.2, in degrees, to 1e-4."""
    return _peak(ranges(LAW, v))


def _peak(values: FloatArray) -> FloatArray:
    """Where a smooth row is largest: the vertex of the parabola through the top of the scan."""
    top = np.argmax(values, axis=1)
    rows = np.arange(len(values))
    left, here, right = (values[rows, top + i] for i in (-1, 0, 1))
    return np.asarray(SCAN[top] + FINE / 2 * (left - right) / (left - 2 * here + right))


def search() -> list[AngleFit]:
    """Every fit: exact angles, scans of exact and of stopped distances, and Table 1's own.

    >>> exact = search()[0]
    >>> print(f"K = {exact.K:.4f} s/m, M = {exact.M:.3f}")  # printed: 0.0085864, 0.1366571
    K = 0.0086 s/m, M = 0.138
    """
    found = []
    for name, v in SPEEDS.items():
        found.append(fit(EXACT, 0, name, np.rad2deg(optimal_angle(v))))
        found.append(fit(LAW, 0, name, best_of_law(v)))
        for distances in (EXACT, STOPPED):
            values = ranges(distances, v)
            for step in (FINE, *STEPS):
                every = round(step / FINE)
                best = SCAN[::every][np.argmax(values[:, ::every], axis=1)]
                found.append(fit(distances, step, name, best))
    return found


def law_error(v_max: float = V_MAX) -> tuple[FloatArray, FloatArray]:
    """v_norm from 0 to v_max, and there the relative error of the printed law."""
    v = v_axis(v_max)
    return v, np.asarray(laws.alpha_max_vial(v * V_LIM) / optimal_angle(v) - 1)
