"""The claims of sections 3.2 and 3.3 that are about fitted laws: eq. 22, Table 1, alpha_max."""

from collections.abc import Iterator

import numpy as np

from hodograph import laws
from hodograph.laws.vial import V_LIM, V_MAX
from hodograph.level import optimal_angle
from hodograph.paper import angle_law, measure, table_1
from hodograph.paper.verdict import SAME, Verdict, less_than, percent

LAW, ANGLE_LAW = 0.002, 0.0008  # the bounds that the paper states
QUICKER = 1000  # "considerably": the reading taken here


def table_1_claims() -> Iterator[Verdict]:
    """Section 3.2 and annex A."""
    free = table_1.free_errors()
    worst = int(np.argmax(free))
    yield Verdict("pearson_form", "3.2, eq. 22",
        "At fixed alpha0, d_norm can be described by a Pearson VII function of v_norm",
        "figure 4, 45°",
        f"With K and M fitted at each angle the relative error is at most {percent(free[44])} at "
        f"45° and {percent(free[worst])} over all angles (at {worst + 1}°).",
        "v_norm 0 to 1.5, alpha0 1° to 90°; judged by the 0.2 % stated for the whole law",
        bool(free[worst] <= LAW))  # fmt: skip
    misses = measure.gaussian_misses()
    lorentzian = laws.pearson_vii(np.arange(6.0), 1.0, 1.0) - 1 / (1 + np.arange(6.0) ** 2)
    yield Verdict("lorentzian", "3.2, eq. 22",
        "For M = 1 the Pearson VII function is a Lorentzian", "M = 1",
        f"The difference from 1/(1 + K²x²) is {less_than(float(np.max(np.abs(lorentzian))))}.",
        "K x = 0 to 5", float(np.max(np.abs(lorentzian))) < SAME)  # fmt: skip
    fall = [misses[i] / misses[i + 1] for i in range(len(misses) - 1)]
    yield Verdict("gaussian", "3.2; annex A",
        "For M tending to infinity the Pearson VII function is a Gaussian", "exp(-K²x²)",
        f"The largest difference is {misses[0]:.1e}, {misses[1]:.1e} and {misses[2]:.1e} for "
        f"M = 1e2, 1e3 and 1e4: it falls as 1/M, towards {misses[2] * 1e4:.3f}/M.",
        "K x = 0 to 5", all(abs(ratio / 10 - 1) < 0.02 for ratio in fall))  # fmt: skip
    windows = ((10, 80), (15, 80), (5, 85), (1, 90))
    least = {window: table_1.least_error(*window) for window in windows}
    each = ", ".join(f"{percent(e)} on {low}° to {high}°" for (low, high), e in least.items())
    yield Verdict("polynomials", "3.2",
        "K and M are easily described by polynomials of degree 3 and 2", "degrees 3 and 2",
        f"The least largest error of d_norm that any polynomials of these degrees leave is {each}. "
        "Towards 0° none can serve: K vanishes there as the square root of alpha0.",
        "v_norm to 1.5; the paper states no window: judged on 15° to 80°, by the 0.2 % of the law",
        least[15, 80] <= LAW)  # fmt: skip
    yield _origin()
    yield _law_error(float(free[worst]))
    ratio = measure.simplification()
    times = f"more than {QUICKER}" if ratio > QUICKER else f"{ratio:.0f}"
    yield Verdict("simplified", "3.2",
        "The law makes the distance considerably simpler to compute than (20) and (15)",
        "considerably simplified",
        f"In arrays it is {times} times quicker a launch than the iteration (20) with its integrals"
        " by adaptive quadrature.",
        f"v_norm to 1.5, 10° to 80°, timed in this run; judged by {QUICKER} times",
        ratio > QUICKER)  # fmt: skip


def _origin() -> Verdict:
    found, degree = table_1.fit(), table_1.fit(table_1.Procedure(stop=0.01 * table_1.DEGREE))
    shares = [
        min(bound / left, 1.0) for bound, left in zip(table_1.rounding(), found.left, strict=True)
    ]
    K, M = found.curves
    K_degree, M_degree = degree.curves
    return Verdict("table_1_origin", "3.2, table 1",
        "Table 1 gives the coefficients of K and M; how they were fitted is not stated",
        "0.24207, 1.56854, -1.16548, 0.26454; 0.675688, 0.046397, 0.031539",
        f"Two plain fits give them: K and M at 10° to 80° by 5°, v_norm to 1.5 by 0.02, then the "
        f"polynomials, with Newton stopped at 0.01 radian. K(alpha0) comes back within "
        f"{percent(K, 4)} and M within {percent(M, 4)} between 10° and 80°; K's coefficients "
        f"within {percent(np.max(np.abs(found.off[:4])), 3)}, M's within "
        f"{percent(np.max(np.abs(found.off[4:])))}. Rounding to print may explain "
        f"{percent(shares[0], 0)} of what is left of K, and {percent(shares[1], 0)} of that of M. "
        f"With the 0.01° of the text the curves are {percent(K_degree)} and {percent(M_degree)} "
        "off. The steps of v and of the integrals cannot be told beyond that.",
        "an inference: v_norm to 1.5 is stated, angles, steps and weights are not",
        None)  # fmt: skip


def _law_error(free: float) -> Verdict:
    law = measure.law_error()
    error, v, angle = law.worst()
    inner_error, inner_v, inner_angle = law.worst(10, 80)
    shares = (percent(law.share(LAW, low, high), 0) for low, high in ((10, 80), (1, 90)))
    rms = (percent(law.rms(low, high)) for low, high in ((10, 80), (1, 90)))
    parts = ", ".join(f"{low:g}° to {high:g}°" for low, high in law.within(LAW))
    return Verdict("law_error", "3.2",
        "With table 1, eq. 22 gives the values of figure 3 to a relative error below 0.2 %",
        "below 0.2 %",
        f"Between 10° and 80° it is {percent(abs(inner_error))} at worst (v_norm = {inner_v:g}, "
        f"{inner_angle:g}°), rms {next(rms)}, and {next(shares)} of the grid is within 0.2 %; from "
        f"1° to 90° {percent(error, 1, sign=True)} (v_norm = {v:g}, {angle:g}°), rms {next(rms)}, "
        f"{next(shares)} within. It holds for every v_norm to 1.5 at {parts}; between 11° and 80° "
        f"up to v_norm = {law.fastest(LAW, 11, 80):.2f}; and everywhere with K and M free at each "
        f"angle ({percent(free)}).", "v_norm 0 to 1.5 by 0.01, alpha0 1° to 90° by 0.5°",
        abs(inner_error) < LAW)  # fmt: skip


def angle_law_claims() -> Iterator[Verdict]:
    """The alpha_max law of section 3.3."""
    v, error = angle_law.law_error()
    worst = int(np.argmax(np.abs(error)))
    far, beyond = angle_law.law_error(3.0)
    last = far[np.argmax(np.abs(beyond) >= ANGLE_LAW) - 1]
    yield Verdict("alpha_max_error", "3.3",
        "The alpha_max law has a relative error of at most 0.08 %", "below 0.08 %",
        f"At most {percent(abs(error[worst]), 3)} (at v0 = {v[worst] * V_LIM:.0f} m/s). The bound "
        f"holds up to v_norm = {last:.2f}, v0 = {last * V_LIM:.0f} m/s.",
        f"v_norm 0 to 1.5, that is v0 to {V_MAX * V_LIM:.0f} m/s",
        bool(abs(error[worst]) < ANGLE_LAW))  # fmt: skip
    fits = angle_law.search()
    exact, by_law = fits[0], fits[1]
    stopped = next(f for f in fits if f.distances == angle_law.STOPPED)
    scans = [f for f in fits if f.distances != angle_law.LAW and 0 < f.scan < 0.1]
    spread = " to ".join(percent(end(f.off[1] for f in scans), 1, sign=True) for end in (min, max))
    coarse = min(f.worst for f in fits if f.scan >= 0.1)
    yield Verdict("alpha_max_origin", "3.3",
        "K and M of the alpha_max law; how the angles were found is not stated",
        f"{laws.ALPHA_MAX_K} s/m, {laws.ALPHA_MAX_M}",
        f"Fitted to exact angles, {_pair(exact)}, and an error of {percent(exact.worst, 3)}; to a "
        f"scan by 0.01° on distances with Newton's stop of 0.01 radian, {_pair(stopped)}, and "
        f"{percent(stopped.worst, 3)}. Scans by 0.01° and 0.05° move M by {spread}, as much as the "
        f"choice of speeds does, so that neither can be told. A scan by 0.1° or more leaves "
        f"{percent(coarse)} at least, beyond the 0.08 % printed; and the angles of the law of "
        f"section 3.2 give M {percent(by_law.off[1], 1, sign=True)}: they are not what was fitted.",
        "v_norm to 1.5 by 0.02, and v0 to 64 m/s by 1 m/s", None)  # fmt: skip
    speeds = table_1.v_axis(step=0.1)[1:]
    best = np.rad2deg(optimal_angle(speeds))
    off = angle_law.best_of_law(speeds) - best
    most = int(np.argmax(np.abs(off)))
    yield Verdict("best_angle_by_table_1", "3.3, figure 6",
        "The best angle is easily found from the law of section 3.2", "no accuracy stated",
        f"The best angle of eq. 22 with table 1 is up to {abs(off[most]):.3f}° "
        f"({percent(abs(off[most]) / best[most])}) from the exact one, at v_norm = "
        f"{speeds[most]:g}.", "v_norm 0.1 to 1.5", None)  # fmt: skip


def _pair(fit: angle_law.AngleFit) -> str:
    K, M = fit.off
    return f"K {percent(K, sign=True)} and M {percent(M, sign=True)} from print"
