"""The paper's claims, each with its verdict: what is claimed, what was measured, whether it holds.

Every figure in a sentence comes from `measure`, `refit` or the engine, in the run that wrote it.
Differences at the level of rounding or of an integrator's tolerance are given as a power of ten
that they stay below, so that the sentences are the same on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial

from hodograph import laws
from hodograph.bodies import terminal_speed
from hodograph.level import optimal_angle
from hodograph.paper import measure, refit, search
from hodograph.paper.refit import V_LIM, V_MAX, Refit, Table1, v_axis

SAME = 1e-8  # relative: closed form and integration in time are the same thing
COEFFICIENT = 0.01  # relative: a coefficient of a fit is the printed one
LAW, ANGLE_LAW = 0.002, 0.0008  # the bounds that the paper states
SLIGHT = 0.05  # relative: the reading of "slight" taken here
K_BASEBALL = 0.005376  # lambda / m, 1/m


@dataclass(frozen=True)
class Verdict:
    """One claim of the paper, judged.

    Attributes
    ----------
    id
        A short name.
    place
        Where in the paper.
    claim, paper
        The claim in words, and the number or formula that the paper gives.
    measured
        What was found, in a sentence.
    domain
        Where it was looked for.
    holds
        True or false; None where it is not judged.
    """

    id: str
    place: str
    claim: str
    paper: str
    measured: str
    domain: str
    holds: bool | None

    def to_dict(self) -> dict[str, Any]:
        """The fields by name, in order."""
        return asdict(self)

    @property
    def outcome(self) -> str:
        """The verdict in a word or two."""
        return {True: "holds", False: "fails", None: "not judged"}[self.holds]


def less_than(value: float) -> str:
    """A power of ten that a small number stays clearly below.

    Examples
    --------
    >>> less_than(3e-13), less_than(0.0)
    ('less than 1e-12', 'less than 1e-14')
    """
    return f"less than 1e{math.ceil(math.log10(3 * max(value, 1e-15)))}"


def percent(value: float, digits: int = 2, *, sign: bool = False) -> str:
    """A ratio in per cent.

    Examples
    --------
    >>> percent(0.0123), percent(0.0123, 1, sign=True)
    ('1.23 %', '+1.2 %')
    """
    return f"{100 * value:{'+' if sign else ''}.{digits}f} %"


def _motion() -> Iterator[Verdict]:
    found = measure.misses()
    domain = (
        "v_norm 0.3, 1, 1.5 and 5 at 10°, 45° and 80°, from the launch to 2 v_lim²/g below it; "
        "at every step of the integrator"
    )
    miss = measure.power_law_miss()
    yield Verdict(
        "speed_any_power",
        "2.2, eq. 8",
        "For drag as v^n the speed is a closed form, up to one integral over the slope",
        "1/v^n = ...",
        f"Eq. 8 and integration of (16) differ by {less_than(miss)}, relative.",
        "n = 1, 1.5, 3 and 4; v_norm = 1 at 30° and 60°",
        miss < SAME,
    )
    yield Verdict(
        "speed",
        "2.3, eq. 13",
        "For n = 2 the speed is a closed form of the slope",
        "v²(alpha) = ...",
        f"Eq. 13 and integration of (16) differ by {less_than(found.speed)}, relative.",
        domain,
        found.speed < SAME,
    )
    steep, steeper, fallen = measure.terminal_misses()
    yield Verdict(
        "terminal_fall",
        "2.3, eq. 11",
        "The speed tends to v_lim as alpha tends to -90°",
        "v -> v_lim",
        f"By (13) the speed is within {percent(steep, 3)} of v_lim at -89.9° and "
        f"{less_than(steeper)} away at -89.99°; after the fall, by (16), {less_than(fallen)}.",
        "v_norm 0.1, 1 and 10 at 45°; a fall of 20 v_lim²/g",
        steeper < steep / 10 and fallen < SAME,
    )
    v_lim = float(terminal_speed(K_BASEBALL))
    yield Verdict(
        "v_lim",
        "2.3, eq. 12; 3.3",
        "lambda/m = 0.005376 1/m is v_lim = 42.7 m/s",
        "42.7 m/s",
        f"v_lim = {v_lim:.3f} m/s.",
        "g = 9.81 m/s²",
        round(v_lim, 1) == V_LIM,
    )
    yield Verdict(
        "position",
        "2.3, eq. 15",
        "x and y follow from v²(alpha) by two integrals",
        "x = ..., y = ...",
        f"Eq. 15 and integration of (16) differ by {less_than(found.position)} of the path's size.",
        domain,
        found.position < SAME,
    )
    yield Verdict(
        "arc_length",
        "2.4, eq. 19",
        "The arc length is a closed form of the slope",
        "s = (v_lim²/2g) ln(...)",
        f"Eq. 19 and integration of (16) differ by {less_than(found.arc_length)}, relative.",
        domain.replace("at every step of the integrator", "whole arcs"),
        found.arc_length < SAME,
    )


def _newton() -> Iterator[Verdict]:
    found = measure.newton_over_domain()
    steep = measure.newton_over_domain(measure.STEEP_DEGREES)
    domain = "v_norm 0.1 to 1.5 by 0.1, alpha0 1°, 3° to 87° by 3°, 89°"
    yield Verdict(
        "newton_on_domain",
        "3.1, eq. 20",
        "Newton's iteration from -alpha0 finds the landing angle",
        "stop at 0.01°",
        f"It fails for {found.failures} of {found.launches} launches and takes "
        f"{found.steps_mean:.1f} steps on average, {found.steps_most} at most.",
        domain,
        found.failures == 0,
    )
    yield Verdict(
        "newton_stop",
        "3.1, eq. 20",
        "Stopping at a change below 0.01° is fine enough",
        "0.01°",
        f"The error left is at most {found.alpha_error_deg:.5f}° in alpha_s and "
        f"{percent(found.d_error, 4)} in d up to 89°. Steeper, 0.01° is a good part of what is "
        f"left to 90°: up to {percent(steep.d_error)} in d.",
        domain + ", and 89.9°, 89.95°, 89.99°",
        max(found.alpha_error_deg, steep.alpha_error_deg) < 0.01
        and max(found.d_error, steep.d_error) < LAW,
    )
    degrees = np.array([30.0, 45.0, 55.0, 60.0, 62.0, 64.0, 66.0, 68.0, 70.0, 75.0, 80.0, 89.0])
    limits = measure.newton_thresholds(degrees)
    least = int(np.argmin(limits))
    at = dict(zip(degrees, limits, strict=True))
    yield Verdict(
        "newton_beyond",
        "3.1, eq. 20",
        "Newton's iteration from -alpha0 can be used; no limit is stated",
        "no limit",
        f"It leaves (-90°, 90°) from v_norm = {limits[least]:.2f} at {degrees[least]:.0f}° on "
        f"(the paper's domain ends at {V_MAX:g}); from {at[45.0]:.2f} at 45°, "
        f"{at[30.0]:.2f} at 30° and {at[89.0]:.2f} at 89°. At 90° its first guess is "
        "-90°, where (20) is undefined.",
        "v_norm to 6, alpha0 30° to 89°",
        bool(np.all(limits >= 6.0)),
    )


def _similarity() -> Iterator[Verdict]:
    found = measure.spread()
    domain = (
        f"{len(measure.BODIES)} sets of g, m, lambda; v_norm 0.5, 1, 1.5 at 20°, 45°, 70°; "
        "(16) in SI units"
    )
    yield Verdict(
        "landing_angle_similar",
        "3.1",
        "alpha_s depends on v_norm and alpha0 alone",
        "alpha_s(v_norm, alpha0)",
        f"The spread over g, m, lambda is {less_than(found.alpha_s)} degrees; the engine's alpha_s "
        f"is {less_than(found.alpha_s_miss)} degrees away.",
        domain,
        found.alpha_s < 1e-6,
    )
    yield Verdict(
        "d_norm_similar",
        "3.1, eq. 21",
        "d_norm depends on v_norm and alpha0 alone",
        "d_norm(v_norm, alpha0)",
        f"The spread over g, m, lambda is {less_than(found.d_norm)}, relative; the engine's d_norm "
        f"is {less_than(found.d_norm_miss)} away.",
        domain,
        found.d_norm < SAME,
    )


def _table_1(fits: Refit) -> Iterator[Verdict]:
    table, near, whole = fits.table, fits.nearest, fits.whole
    worst = int(np.argmax(table.worst))
    yield Verdict(
        "pearson_form",
        "3.2, eq. 22",
        "At fixed alpha0, d_norm can be described by a Pearson VII function of v_norm",
        "figure 4, 45°",
        f"With K and M fitted at each angle the relative error is at most "
        f"{percent(table.worst[44])} at 45° and {percent(table.worst[worst])} over all angles "
        f"(at {worst + 1}°).",
        "v_norm 0 to 1.5, alpha0 1° to 90°; judged by the 0.2 % stated for the whole law",
        bool(table.worst[worst] <= LAW),
    )
    misses = measure.gaussian_misses()
    lorentzian = laws.pearson_vii(np.arange(6.0), 1.0, 1.0) - 1 / (1 + np.arange(6.0) ** 2)
    yield Verdict(
        "lorentzian",
        "3.2, eq. 22",
        "For M = 1 the Pearson VII function is a Lorentzian",
        "M = 1",
        f"The difference from 1/(1 + K²x²) is {less_than(float(np.max(np.abs(lorentzian))))}.",
        "K x = 0 to 5",
        float(np.max(np.abs(lorentzian))) < SAME,
    )
    fall = [misses[i] / misses[i + 1] for i in range(len(misses) - 1)]
    yield Verdict(
        "gaussian",
        "3.2; annex A",
        "For M tending to infinity the Pearson VII function is a Gaussian",
        "exp(-K²x²)",
        f"The largest difference is {misses[0]:.1e}, {misses[1]:.1e} and {misses[2]:.1e} for "
        f"M = 1e2, 1e3 and 1e4: it falls as 1/M, towards {misses[2] * 1e4:.3f}/M.",
        "K x = 0 to 5",
        all(abs(ratio / 10 - 1) < 0.02 for ratio in fall),
    )
    off, all_off = near.differences(), whole.differences()
    inside = slice(9, 80)  # 10 to 80 degrees
    alpha0 = table.alpha0[inside]
    K_off, M_off = (
        float(np.max(np.abs(Polynomial(coefficients)(alpha0) / points[inside] - 1)))
        for coefficients, points in ((laws.TABLE_1_K, table.K), (laws.TABLE_1_M, table.M))
    )
    yield Verdict(
        "table_1_window",
        "3.2, table 1",
        "Table 1 is a fit over the domain of figures 3 and 5 (the window is not stated)",
        "v_norm to 1.5 (section 3.3); angles not stated",
        f"Coefficients fitted on {_on(whole)} are up to {percent(np.max(np.abs(all_off)), 0)} "
        f"from print. Of the windows tried, {_on(near)} comes nearest: all seven are within "
        f"{percent(np.max(np.abs(off)))}, none to the printed digits. Between 10° and 80° the "
        f"printed polynomials are within {percent(K_off)} of K and {percent(M_off)} of M as fitted "
        f"at each angle with v_norm to {table.v_max:g}.",
        f"least squares at each angle by 1° and v_norm by 0.01; from {refit.LOWEST_TRIED[0]}°-"
        f"{refit.LOWEST_TRIED[-1]}° to {refit.HIGHEST_TRIED[0]}°-{refit.HIGHEST_TRIED[-1]}°, "
        f"v_norm to {refit.V_MAX_TRIED[0]:g}-{refit.V_MAX_TRIED[-1]:g}",
        bool(np.max(np.abs(all_off)) <= COEFFICIENT),
    )
    names = [f"{letter}_a{i}" for letter, n in (("K", 4), ("M", 3)) for i in range(n)]
    rows = zip(
        names,
        (*laws.TABLE_1_K, *laws.TABLE_1_M),
        (*near.K, *near.M),
        off,
        (*whole.K, *whole.M),
        all_off,
        strict=True,
    )
    for name, printed, here, here_off, all_, over in rows:
        letter, index = name.split("_")
        yield Verdict(
            f"table_1_{name}",
            "3.2, table 1",
            f"{letter}: {index} = {printed} (to be found again within {percent(COEFFICIENT, 0)} "
            "on some window)",
            f"{printed}",
            f"{here:.5f} ({percent(here_off, sign=True)}) on the nearest window; "
            f"{all_:.5f} ({percent(over, 1, sign=True)}) on {_on(whole)}.",
            f"nearest window: {_on(near)}",
            bool(abs(here_off) <= COEFFICIENT),
        )
    inner = refit.fit_table_1(table, 10, 80)
    error, v, angle = measure.law_error(whole.K, whole.M).worst()
    inner_error, *_ = measure.law_error(inner.K, inner.M).worst(10, 80)
    yield Verdict(
        "polynomials",
        "3.2",
        "K and M are easily described by polynomials of degree 3 and 2",
        "degrees 3 and 2",
        f"Our own polynomials of these degrees leave {percent(abs(error), 1)} in d_norm (at "
        f"{_at(v, angle)}); fitted to 10° to 80° and used there, {percent(abs(inner_error))}. "
        f"K vanishes as the square root of alpha0, which no cubic does.",
        "v_norm to 1.5, alpha0 1° to 90°; judged by the 0.2 % stated for the whole law",
        abs(error) <= LAW,
    )
    law = measure.law_error()
    error, v, angle = law.worst()
    inner_error, inner_v, inner_angle = law.worst(10, 80)
    parts = ", ".join(f"{low:g}° to {high:g}°" for low, high in law.within(LAW))
    yield Verdict(
        "law_error",
        "3.2",
        "With table 1, eq. 22 gives figure 3 to a relative error below 0.2 %",
        "below 0.2 %",
        f"At worst {percent(error, 1, sign=True)}, at {_at(v, angle)}. Between 10° and 80°, "
        f"{percent(abs(inner_error))} (at {_at(inner_v, inner_angle)}). It holds for every "
        f"v_norm to 1.5 only at {parts}; between 11° and 80° it holds up to "
        f"v_norm = {law.fastest(LAW, 11, 80):.2f}. With K and M free at each angle it holds at all "
        f"angles ({percent(table.worst[worst])}).",
        "v_norm 0 to 1.5, alpha0 1° to 90°",
        abs(error) < LAW,
    )


def _settings() -> Iterator[Verdict]:
    ways = search.search()
    nearest = ways[0]
    near = sum(way.worst < 0.02 for way in ways)
    at_once = min(way.worst for way in ways if way.variant.startswith("at once"))
    yield Verdict(
        "table_1_settings",
        "3.2, table 1",
        "Table 1 comes of eq. 22 fitted at each angle, and polynomials through what that gives",
        "window, steps and weights not stated",
        f"Of {len(ways)} ways tried, the nearest is {nearest.variant}, {nearest.low_deg}° to "
        f"{nearest.high_deg}° with v_norm to {nearest.v_max:g}: all seven coefficients within "
        f"{percent(nearest.worst)}. {near} ways come within 2 %, which leaves steps and weights "
        f"open; a fit of all seven at once comes no nearer than {percent(at_once, 0)}.",
        "each way at its nearest window; all seven coefficients within 1 %",
        nearest.variant.startswith("two stages") and nearest.worst < 0.01,
    )


def _on(fit: Table1) -> str:
    return f"{fit.low_deg}° to {fit.high_deg}° with v_norm to {fit.v_max:g}"


def _at(v_norm: float, angle: float) -> str:
    return f"v_norm = {v_norm:g}, {angle:g}°"


def _best_angle() -> Iterator[Verdict]:
    miss, reference_miss = measure.vacuum_misses()
    yield Verdict(
        "vacuum_symmetry",
        "3.3",
        "Without drag, 45° + phi and 45° - phi give the same distance",
        "d(45° ± phi) equal",
        f"The two ranges by (16) differ by {less_than(miss)}, relative, and by "
        f"{less_than(reference_miss)} from (21).",
        "v_lim infinite; phi 1° to 44°",
        miss < SAME and reference_miss < SAME,
    )
    found = measure.asymmetry()
    yield Verdict(
        "drag_asymmetry",
        "3.3",
        "With drag the symmetry is lost, and the lower angle goes farther",
        "figure 3",
        f"30° goes {percent(found.at_15_deg)} farther than 60° at v_norm = 1 "
        f"({percent(found.by_motion)} by (16)). Over the domain the lower angle always goes "
        f"farther, by at least {percent(found.least, 3)}.",
        "v_norm 0.1 to 1.5, phi 1° to 44°",
        found.least > 0,
    )
    v = np.concatenate([v_axis()[1:], [2.0, 5.0, 10.0, 100.0, 1e4]])
    best = np.rad2deg(optimal_angle(v))
    yield Verdict(
        "best_angle_below_45",
        "3.3; 4",
        "The angle of greatest distance is below 45° and falls as v0 grows",
        "below 45°",
        f"It goes from {best[0]:.4f}° at v_norm = {v[0]:g} to {best[149]:.2f}° at "
        f"1.5, {best[152]:.2f}° at 10 and {best[-1]:.2f}° at 1e4.",
        "v_norm 0.01 to 1.5 by 0.01, then to 1e4",
        bool(best[0] < 45 and np.all(np.diff(best) < 0)),
    )
    exponent, turn, gain = (
        measure.tilting_exponent(),
        measure.upright_limit(),
        measure.tilt(3.5, 0.3),
    )
    yield Verdict(
        "drag_exponent",
        "3.3",
        "For drag as v^n with n >= 3.5 the best angle may be above 45°",
        "n >= 3.5",
        f"For weak drag it is above 45° from n = {exponent:.2f} on. At n = 3.5 it is above 45° up "
        f"to v_norm = {turn:.2f}: 46° goes {percent(gain, 4)} farther than 44° at v_norm = 0.3.",
        "(16) with n from 2 to 5, 45° ± 0.5°; weak drag is 0.001 of the weight at launch",
        exponent <= 3.5 and gain > 0,
    )


def _angle_law() -> Iterator[Verdict]:
    v_max = float(int(V_MAX * V_LIM))
    fit, near = refit.fit_angle_law(v_max), refit.nearest_angle_law()
    by_table = refit.fit_angle_law(v_max, by_table_1=True)
    printed = {"K": laws.ALPHA_MAX_K, "M": laws.ALPHA_MAX_M}

    def off(each: refit.AngleFit, name: str) -> str:
        return percent(getattr(each, name) / printed[name] - 1, sign=True)

    start = float(np.rad2deg(optimal_angle(0.0)))
    slow = float(np.rad2deg(optimal_angle(1e-6)))
    yield Verdict(
        "alpha_max_h",
        "3.3",
        "alpha_max law: h = 45°",
        "45° (imposed)",
        f"The best angle is {start:.9g}° at v0 = 0, and {less_than(abs(slow - 45))} degrees from "
        "45° at v_norm = 1e-6.",
        "v0 tending to 0",
        start == 45.0 and abs(slow - 45.0) < 1e-6,
    )
    for name, unit in (("K", " s/m"), ("M", "")):
        yield Verdict(
            f"alpha_max_{name}",
            "3.3",
            f"alpha_max law: {name} = {printed[name]}{unit} (to be found again within "
            f"{percent(COEFFICIENT, 0)})",
            f"{printed[name]}{unit}",
            f"{getattr(fit, name):.7f} ({off(fit, name)}) fitted for v0 to {fit.v_max:g} m/s; "
            f"nearest to print is {getattr(near, name):.7f} ({off(near, name)}) for v0 to "
            f"{near.v_max:g} m/s.",
            f"exact best angles for v_lim = {V_LIM} m/s, v0 from 0 by 1 m/s",
            bool(abs(getattr(fit, name) / printed[name] - 1) <= COEFFICIENT),
        )
    v, error = measure.angle_law_error()
    worst = int(np.argmax(np.abs(error)))
    far, beyond = measure.angle_law_error(3.0)
    last = far[np.argmax(np.abs(beyond) >= ANGLE_LAW) - 1]
    yield Verdict(
        "alpha_max_error",
        "3.3",
        "alpha_max law: relative error at most 0.08 %",
        "below 0.08 %",
        f"At most {percent(abs(error[worst]), 3)} (at v0 = {v[worst] * V_LIM:.0f} m/s). The bound "
        f"holds up to v_norm = {last:.2f}, v0 = {last * V_LIM:.0f} m/s.",
        f"v_norm 0 to 1.5, that is v0 to {V_MAX * V_LIM:.0f} m/s",
        bool(abs(error[worst]) < ANGLE_LAW),
    )
    speeds = v_axis()[10::10]
    exact = optimal_angle(speeds)
    by_law = np.array([refit.best_angle_of_law(each) for each in speeds])
    relative = np.abs(by_law / exact - 1)
    most = int(np.argmax(relative))
    off_deg = np.rad2deg(abs(by_law[most] - exact[most]))
    yield Verdict(
        "best_angle_by_table_1",
        "3.3, figure 6",
        "Figure 6 follows from the law of section 3.2, to the accuracy stated for alpha_max",
        "below 0.08 %",
        f"The best angle of eq. 22 with table 1 is up to {off_deg:.3f}° "
        f"({percent(relative[most])}) from the exact one, at v_norm = {speeds[most]:g}. An "
        f"alpha_max law fitted to it for v0 to {by_table.v_max:g} m/s has K {off(by_table, 'K')} "
        f"and M {off(by_table, 'M')} from print; fitted to exact angles, {off(fit, 'K')} and "
        f"{off(fit, 'M')}.",
        "v_norm 0.1 to 1.5",
        bool(relative[most] < ANGLE_LAW),
    )
    degrees = np.arange(10.0, 81.0)
    deviation = measure.legendre_deviation(degrees)
    middle = deviation[20:51]
    yield Verdict(
        "legendre",
        "3.3",
        "At v_norm = sqrt(10), about twice the limit of the fit, the law deviates slightly",
        "slight deviation",
        f"The law is {percent(middle.min(), 1, sign=True)} to {percent(middle.max(), 1, sign=True)}"
        f" off between 30° and 60°, and {percent(deviation.min(), 1, sign=True)} to "
        f"{percent(deviation.max(), 1, sign=True)} between 10° and 80°. "
        f"sqrt(10)/{V_MAX:g} = {math.sqrt(10) / V_MAX:.2f}.",
        f"v_norm = sqrt(10), alpha0 10° to 80°; slight is read as below {percent(SLIGHT, 0)}",
        bool(np.max(np.abs(deviation)) < SLIGHT),
    )


def judge(
    fits: Refit | None = None, *, progress: Callable[[str], None] = lambda message: None
) -> list[Verdict]:
    """Judge every claim, in the order of the paper.

    Parameters
    ----------
    fits : refit.Refit, optional
        The fits of K and M, from `refit.refit_table_1`; made afresh (some seconds) if left out.
    progress : callable, optional
        Called with a short message before each group of claims.

    Returns
    -------
    list of Verdict
        The claims, judged.
    """
    groups: tuple[tuple[str, Callable[[], Iterator[Verdict]]], ...] = (
        ("section 2", _motion),
        ("section 3.1, Newton", _newton),
        ("section 3.1, similarity", _similarity),
        ("section 3.2, table 1", lambda: _table_1(refit.refit_table_1() if fits is None else fits)),
        ("section 3.2, settings of the fit", _settings),
        ("section 3.3, best angle", _best_angle),
        ("section 3.3, alpha_max law", _angle_law),
    )
    verdicts = []
    for name, group in groups:
        progress(f"claims of {name}")
        verdicts += list(group())
    return verdicts
