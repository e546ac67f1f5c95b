"""What the paper refers to, measured beside it: its references' formulas and laws of drag.

Only formulas that could be had from a reliable source, or that follow from their assumption without
a choice, are here; where the text of a reference could not be read, its verdict says so.
"""

from collections.abc import Iterator

import numpy as np
from scipy import optimize

from hodograph import laws, ode
from hodograph.engine.domain import FloatArray
from hodograph.launch import Launch
from hodograph.laws.vial import V_LIM
from hodograph.level import optimal_angle
from hodograph.paper import measure
from hodograph.paper.measure import errors
from hodograph.paper.table_1 import v_axis
from hodograph.paper.verdict import SAME, Verdict, less_than, percent

K_BASEBALL = 0.005376  # lambda / m, 1/m
NOT_READ = "the reference itself could not be read here"


def throw_up_misses() -> float:
    """Largest relative difference of the vertical throw's closed forms from (16).

    The rise takes (v_lim/g) atan v and reaches (v_lim^2/2g) ln(1 + v^2); the fall takes
    (v_lim/g) asinh v and ends at v_lim v / sqrt(1 + v^2), v being v_norm.
    """
    worst = 0.0
    for v in (0.1, 1.0, np.sqrt(10.0)):
        by_motion = ode.solve(v, np.pi / 2, 1.0, g=1.0, rtol=1e-12, atol=1e-14)
        found = (by_motion.apex.t, by_motion.apex.y, by_motion.t - by_motion.apex.t)
        closed = (np.arctan(v), np.log1p(v * v) / 2, np.arcsinh(v), v / np.hypot(1, v))
        off = np.array([*found, by_motion.speed]) / closed - 1
        worst = max(worst, float(np.max(np.abs(off))))
    return worst


def best_angle_didion(v_norm: float, c: float) -> float:
    """Angle of greatest range, degrees, for the drag v^2 (1 + v/c) over the weight, in v_lim."""

    def drag(v: float) -> float:
        return v * v * (1 + v / c)

    def short(alpha0: float) -> float:
        return -ode.solve(v_norm, alpha0, 1.0, g=1.0, drag=drag, rtol=1e-9, atol=1e-11).x

    near = float(optimal_angle(v_norm))
    found = optimize.minimize_scalar(
        short, bounds=(near - 0.15, near + 0.15), method="bounded", options={"xatol": 1e-5}
    )
    return float(np.rad2deg(found.x))


def claims() -> Iterator[Verdict]:
    """Its references judged, in their order in the paper."""
    yield _didion()
    miss = throw_up_misses()
    yield Verdict("ref_timmerman", "1, ref. [4]",
        "The vertical throw under quadratic drag has a solution in closed form (Timmerman and "
        "van der Weele 1999, without their buoyancy)", "1D",
        f"Times of rise and fall, height and speed of return differ by {less_than(miss)} from "
        "(16), relative. d_norm at 90° is (asinh v + atan v)/(2v sqrt(1 + v²)).",
        "v_norm 0.1, 1 and sqrt(10), 90°", miss < SAME)  # fmt: skip
    yield _legendre()
    v, degrees = v_axis()[1:], np.arange(1.0, 90.0)
    low = np.abs(errors(laws.d_norm_low, v, degrees))
    yield Verdict("ref_parker", "1, ref. [6]",
        "Approximate solutions were proposed: a low trajectory, the speed taken for its horizontal "
        "part (Parker 1977)", "no error quoted",
        f"Its distance is within {percent(low[:, :5].max())} up to 5°, {percent(low[:, :10].max())}"
        f" up to 10° and {percent(low[:, :45].max(), 0)} up to 45°; it tends to the exact one as "
        f"alpha0 tends to 0. The formula follows from the approximation; {NOT_READ}.",
        "v_norm 0 to 1.5", None)  # fmt: skip
    chudinov = np.abs(errors(laws.d_norm_chudinov, v, degrees))
    slow, steep = v * v <= 1.5, degrees <= 70
    inside = chudinov[np.ix_(slow, steep)]
    yield Verdict("ref_chudinov", "1, refs. [7], [8]",
        "Approximate solutions were proposed: range, time and height without a fitted number "
        "(Chudinov 2001, 2004)", "no error quoted",
        f"His range is within {percent(inside.max(), 1)} (rms {percent(_rms(inside), 1)}) for "
        f"v_norm² to 1.5 and angles to 70°, and within {percent(chudinov.max(), 1)} (rms "
        f"{percent(_rms(chudinov), 1)}) over the whole domain; table 1 has an rms of "
        f"{percent(measure.law_error().rms(1, 90), 1)} there. {_chudinov_scene()} The formulas are "
        "those of his paper of 2014; the two references could not be read here.",
        "v_norm 0 to 1.5, alpha0 1° to 89°", None)  # fmt: skip
    drag = K_BASEBALL * 2 * 0.145 / (1.2 * np.pi * 0.0366**2)
    yield Verdict("ref_tan", "3.3, refs. [7], [12]",
        "lambda/m = 0.005376 1/m is a baseball's (Chudinov 2001; Tan, Frick and Castillo 1987)",
        "0.005376 1/m",
        f"It is the drag of a ball of 145 g and 36.6 mm in radius, in air of 1.2 kg/m³, for a drag "
        f"coefficient of {drag:.2f}; and 9.81 × 0.000548, a drag over weight of 0.000548 v² with "
        f"v in m/s. Neither reference could be read here.", "g = 9.81 m/s²", None)  # fmt: skip
    yield _price_romano()


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _chudinov_scene() -> str:
    """His height and time on the paper's domain."""
    v, alpha0 = np.linspace(0.01, 1.5, 80)[:, np.newaxis], np.deg2rad(np.linspace(0.5, 89.5, 120))
    launch = Launch(v, alpha0, 1.0, g=1.0)
    H = v**2 * np.sin(alpha0) ** 2 / (2 + v**2 * np.sin(alpha0))
    height = np.max(np.abs(H / launch.apex()[1] - 1))
    time = np.max(np.abs(2 * np.sqrt(2 * H) / launch.flight_time() - 1))
    return f"His height is within {percent(height, 1)}, his time within {percent(time, 1)}."


def _legendre() -> Verdict:
    degrees = np.arange(10.0, 81.0)
    deviation = errors(laws.table_1, np.sqrt([10.0]), degrees)[0]
    middle = deviation[20:51]
    return Verdict("ref_legendre", "3.3, ref. [5]",
        "At Legendre's v_norm = sqrt(10), near twice the limit of the fit, the law is slightly off",
        "a slight deviation",
        f"The law is {percent(middle.min(), 1, sign=True)} to {percent(middle.max(), 1, sign=True)}"
        f" off between 30° and 60°, and {percent(deviation.min(), 1, sign=True)} to "
        f"{percent(deviation.max(), 1, sign=True)} between 10° and 80°. sqrt(10)/1.5 = "
        f"{np.sqrt(10) / 1.5:.2f}. How much is slight is not said; Legendre's own values could not "
        "be read here.", "v_norm = sqrt(10), alpha0 10° to 80°", None)  # fmt: skip


def _price_romano() -> Verdict:
    exponent, turn = measure.tilting_exponent(), measure.upright_limit()
    gain = measure.tilt(3.5, 0.3)
    return Verdict("drag_exponent", "3.3, ref. [14]",
        "For drag as v^n with n >= 3.5 the best angle may be above 45° (Price and Romano 1998)",
        "n >= 3.5",
        f"For weak drag it is above 45° from n = {exponent:.4f} on. At n = 3.5 it is above 45° up "
        f"to v_norm = {turn:.2f}: 46° goes {percent(gain, 4)} farther than 44° at v_norm = 0.3.",
        "weak drag: the first order in the drag; n = 3.5: (16), 45° ± 1°",
        exponent <= 3.5 and gain > 0)  # fmt: skip


def _didion() -> Verdict:
    speeds = (1.0, 1.5, 3.0)
    square, cubic = np.rad2deg(optimal_angle(speeds)), [best_angle_didion(v, 10.0) for v in speeds]
    pairs = [f"{old:.2f}° to {new:.2f}°" for old, new in zip(square, cubic, strict=True)]
    return Verdict("ref_didion", "4, refs. [1], [2]",
        "A realistic law of drag has a term in v³ beside that in v² (Didion)",
        "a term in v³ as well",
        f"With lambda v²(1 + v/c) and c = 10 v_lim the best angle goes from {pairs[0]} at "
        f"v_norm = 1, from {pairs[1]} at 1.5 and from {pairs[2]} at 3: more drag lowers it, a "
        f"steeper law raises it. The paper gives no c, and {NOT_READ}.",
        f"(16) with that law; for the baseball c = 10 v_lim is {10 * V_LIM:.0f} m/s",
        None)  # fmt: skip
