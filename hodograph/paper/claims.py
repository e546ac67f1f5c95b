"""The paper's claims, in its order, each with its verdict.

Every figure in a sentence comes from the engine or a measurement in the run that wrote it.
"""

import logging
from collections.abc import Callable, Iterator

import numpy as np

from hodograph.bodies import terminal_speed
from hodograph.laws.vial import V_LIM, V_MAX
from hodograph.level import optimal_angle
from hodograph.paper import claims_of_laws, measure, references
from hodograph.paper.table_1 import v_axis
from hodograph.paper.verdict import SAME, Verdict, less_than, percent


def _motion() -> Iterator[Verdict]:
    found = measure.misses()
    domain = (
        "v_norm 0.3, 1, 1.5 and 5 at 10°, 45° and 80°, from the launch to 2 v_lim²/g below it; "
        "at every step of the integrator"
    )
    miss = measure.power_law_miss()
    yield Verdict("speed_any_power", "2.2, eq. 8",
        "For drag as v^n the speed is a closed form, up to one integral over the slope",
        "closed form, (8)",
        f"Eq. 8 and integration of (16) differ by {less_than(miss)}, relative.",
        "n = 1, 1.5, 3 and 4; v_norm = 1 at 30° and 60°", miss < SAME)  # fmt: skip
    yield Verdict("speed", "2.3, eq. 13", "For n = 2 the speed is a closed form of the slope",
        "closed form, (13)",
        f"Eq. 13 and integration of (16) differ by {less_than(found.speed)}, relative.", domain,
        found.speed < SAME)  # fmt: skip
    steep, steeper, fallen = measure.terminal_misses()
    yield Verdict("terminal_fall", "2.3, eq. 11",
        "The speed tends to v_lim as alpha tends to -90°", "v -> v_lim",
        f"By (13) the speed is within {percent(steep, 3)} of v_lim at -89.9° and "
        f"{less_than(steeper)} away at -89.99°; after the fall, by (16), {less_than(fallen)}.",
        "v_norm 0.1, 1 and 10 at 45°; a fall of 20 v_lim²/g",
        steeper < steep / 10 and fallen < SAME)  # fmt: skip
    v_lim = float(terminal_speed(references.K_BASEBALL))
    yield Verdict("v_lim", "2.3, eq. 12; 3.3", "lambda/m = 0.005376 1/m is v_lim = 42.7 m/s",
        "42.7 m/s", f"v_lim = {v_lim:.3f} m/s.", "g = 9.81 m/s²",
        round(v_lim, 1) == V_LIM)  # fmt: skip
    yield Verdict("position", "2.3, eq. 15", "x and y follow from v²(alpha) by two integrals",
        "two integrals, (15)",
        f"Eq. 15 and integration of (16) differ by {less_than(found.position)} of the path's size.",
        domain, found.position < SAME)  # fmt: skip
    yield Verdict("arc_length", "2.4, eq. 19", "The arc length is a closed form of the slope",
        "closed form, (19)",
        f"Eq. 19 and integration of (16) differ by {less_than(found.arc_length)}, relative.",
        domain.replace("at every step of the integrator",
        "whole arcs"), found.arc_length < SAME)  # fmt: skip


def _newton() -> Iterator[Verdict]:
    found = measure.newton_over_domain()
    steep = measure.newton_over_domain(measure.STEEP_DEGREES)
    domain = "v_norm 0.1 to 1.5 by 0.1, alpha0 1°, 3° to 87° by 3°, 89°"
    yield Verdict("newton_on_domain", "3.1, eq. 20",
        "Newton's iteration from -alpha0 finds the landing angle", "stop at 0.01°",
        f"It fails for {found.failures} of {found.launches} launches and takes "
        f"{found.steps_mean:.1f} steps on average, {found.steps_most} at most.", domain,
        found.failures == 0)  # fmt: skip
    yield Verdict("newton_stop", "3.1, eq. 20",
        "The iteration stops at a change below a value set beforehand, for example 0.01°",
        "for example 0.01°",
        f"The error left is at most {found.alpha_error_deg:.5f}° in alpha_s and "
        f"{percent(found.d_error, 4)} in d up to 89°. Steeper, 0.01° is a good part of what is "
        f"left to 90°: up to {percent(steep.d_error)} in d.",
        domain + ", and 89.9°, 89.95°, 89.99°", None)  # fmt: skip
    degrees = np.array([30.0, 45.0, 55.0, 60.0, 62.0, 64.0, 66.0, 68.0, 70.0, 75.0, 80.0, 89.0])
    limits = measure.newton_thresholds(degrees)
    least = int(np.argmin(limits))
    at = dict(zip(degrees, limits, strict=True))
    yield Verdict("newton_beyond", "3.1, eq. 20",
        "Newton's iteration beyond the speeds of the paper", "no limit stated",
        f"It leaves (-90°, 90°) from v_norm = {limits[least]:.2f} at {degrees[least]:.0f}° on "
        f"(the paper's domain ends at {V_MAX:g}); from {at[45.0]:.2f} at 45°, "
        f"{at[30.0]:.2f} at 30° and {at[89.0]:.2f} at 89°. At 90° its first guess is "
        "-90°, where (20) is undefined.", "v_norm to 6, alpha0 30° to 89°", None)  # fmt: skip


def _similarity() -> Iterator[Verdict]:
    found = measure.spread()
    domain = (
        f"{len(measure.BODIES)} sets of g, m, lambda; v_norm 0.5, 1, 1.5 at 20°, 45°, 70°; "
        "(16) in SI units"
    )
    yield Verdict("landing_angle_similar", "3.1", "alpha_s depends on v_norm and alpha0 alone",
        "alpha_s(v_norm, alpha0)",
        f"The spread over g, m, lambda is {less_than(found.alpha_s)} degrees; the engine's alpha_s "
        f"is {less_than(found.alpha_s_miss)} degrees away.",
        domain, found.alpha_s < 1e-6)  # fmt: skip
    yield Verdict("d_norm_similar", "3.1, eq. 21", "d_norm depends on v_norm and alpha0 alone",
        "d_norm(v_norm, alpha0)",
        f"The spread over g, m, lambda is {less_than(found.d_norm)}, relative; the engine's d_norm "
        f"is {less_than(found.d_norm_miss)} away.", domain, found.d_norm < SAME)  # fmt: skip


def _best_angle() -> Iterator[Verdict]:
    miss, reference_miss = measure.vacuum_misses()
    yield Verdict("vacuum_symmetry", "3.3",
        "Without drag, 45° + phi and 45° - phi give the same distance", "d(45° ± phi) equal",
        f"The two ranges by (16) differ by {less_than(miss)}, relative, and by "
        f"{less_than(reference_miss)} from (21).", "v_lim infinite; phi 1° to 44°",
        miss < SAME and reference_miss < SAME)  # fmt: skip
    start, slow = (float(np.rad2deg(optimal_angle(v))) for v in (0.0, 1e-6))
    yield Verdict("vacuum_best_angle", "3.3",
        "Without drag the distance is greatest at 45°, which the alpha_max law imposes (h)",
        "45°",
        f"The best angle is {start:.9g}° at v0 = 0, and {less_than(abs(slow - 45))} degrees from "
        "45° at v_norm = 1e-6.", "v0 tending to 0",
        start == 45.0 and abs(slow - 45.0) < 1e-6)  # fmt: skip
    found = measure.asymmetry()
    yield Verdict("drag_asymmetry", "3.3",
        "With drag the symmetry is lost, and the lower angle goes farther", "figure 3",
        f"30° goes {percent(found.at_15_deg)} farther than 60° at v_norm = 1 "
        f"({percent(found.by_motion)} by (16)). Over the domain the lower angle always goes "
        f"farther, by at least {percent(found.least, 3)}.", "v_norm 0.1 to 1.5, phi 1° to 44°",
        found.least > 0)  # fmt: skip
    v = np.concatenate([v_axis()[1:], [2.0, 5.0, 10.0, 100.0, 1e4]])
    best = np.rad2deg(optimal_angle(v))
    yield Verdict("best_angle_below_45", "3.3; 4",
        "The angle of greatest distance is below 45° and falls as v0 grows", "below 45°",
        f"It goes from {best[0]:.4f}° at v_norm = {v[0]:g} to {best[149]:.2f}° at "
        f"1.5, {best[152]:.2f}° at 10 and {best[-1]:.2f}° at 1e4.",
        "v_norm 0.01 to 1.5 by 0.01, then to 1e4",
        bool(best[0] < 45 and np.all(np.diff(best) < 0)))  # fmt: skip


def _misprints() -> Iterator[Verdict]:
    yield Verdict("misprints", "2.2, eq. 7; 2.4, eq. 18", "Two slips of the pen",
        "g in place of q; ds in place of s",
        "Above (7), g stands for q of (4): with q, (7) and (8) follow, and (8) holds. In (18) the "
        "left side is s, not ds, and alpha is both the variable and the end of the integral; its "
        "integral is (19), which holds.", "read, and by the verdicts on (8) and (19)",
        None)  # fmt: skip


GROUPS: tuple[tuple[str, Callable[[], Iterator[Verdict]]], ...] = (
    ("section 2", _motion),
    ("section 2, as printed", _misprints),
    ("section 3.1, Newton", _newton),
    ("section 3.1, similarity", _similarity),
    ("section 3.2, table 1", claims_of_laws.table_1_claims),
    ("section 3.3, best angle", _best_angle),
    ("section 3.3, alpha_max law", claims_of_laws.angle_law_claims),
    ("its references", references.claims),
)


def judge() -> list[Verdict]:
    """Judge every claim, in the order of the paper, and then its references."""
    verdicts = []
    for name, group in GROUPS:
        logging.getLogger("hodograph").info("claims of %s", name)
        verdicts += list(group())
    return verdicts
