"""The exercise's questions answered in sentences that follow from the numbers of a run.

One function a section; each returns paragraphs of plain text.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hodograph.exercise.figures import NAMES
from hodograph.exercise.quadratic import (
    BALANCE_STEPS,
    FALL,
    FALL_STEPS,
)
from hodograph.exercise.scene import (
    DELTA_1,
    DT,
    ETA,
    LAMBDA,
    MASSE,
    RATIO,
    V0,
    Convergence,
    G,
)
from hodograph.exercise.sections import (
    ENERGY_DT,
    FIGURE_LAMBDA,
    REFERENCE_DT,
    SCIPY,
    THREE,
    Findings,
    Path,
)
from hodograph.steppers import FIXED

_SHORT = {method: name.removesuffix(" (midpoint)") for method, name in NAMES.items()}


def listed(words: Iterable[str]) -> str:
    """Words with commas, and an "and" before the last.

    Parameters
    ----------
    words : iterable of str
        At least one.

    Returns
    -------
    str
        The list.

    Examples
    --------
    >>> listed(["Euler", "RK2", "RK4"])
    'Euler, RK2 and RK4'
    """
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _round(number: float) -> str:
    """One digit, and zeros."""
    return f"{float(f'{number:.0e}'):,.0f}"


def _percent(part: float) -> str:
    return f"{100 * part:.2g} %"


def figure_1(found: Findings) -> list[str]:
    """On the exercise's figure 1."""
    ranges = [f"{path.x[-1]:.1f} m at {degrees:g}°" for degrees, path in found.figure_1]
    farthest = max(found.figure_1, key=lambda pair: pair[1].x[-1])[0]
    return [
        f"With quadratic drag, lambda = {FIGURE_LAMBDA} kg/m, the projectile lands at "
        f"{listed(ranges)}; of these angles {farthest:g}° goes farthest. The exercise does not "
        "say which three angles it drew."
    ]


def trajectories(found: Findings) -> list[str]:
    """6.3."""
    first, vacuum = found.paths["rk2"]
    lost = vacuum.exact - first.exact
    misses = [
        f"{_SHORT[method]} {1000 * abs(miss):.3g} mm {'too far' if miss > 0 else 'too short'}"
        for method in THREE
        for miss in [_miss(found.paths[method][0])]
    ]
    dropped = [float(p.flight.impact.x - p.flight.impact_naive.x) for p in _first(found)]
    return [
        f"Drag with eta = {ETA:g} kg/s takes {lost:.2f} m of {vacuum.exact:.2f} m, "
        f"{_percent(lost / vacuum.exact)}. The landing interpolated between the last two points "
        f"is off by so much: {listed(misses)}.",
        f"The last stored point is {1000 * min(dropped):.2g} to {1000 * max(dropped):.2g} mm short "
        f"of the landing it belongs to, anything up to one step of {1000 * DT * _speed(first):.3g} "
        "mm. It is what the exercise's loop gives, and whether it flatters a method is luck.",
    ]


def _first(found: Findings) -> list[Path]:
    return [found.paths[method][0] for method in THREE]


def _miss(path: Path) -> float:
    return float(path.flight.impact.x - path.exact)


def _speed(path: Path) -> float:
    return float(path.flight.impact.p)


def scipy(found: Findings) -> list[str]:
    """6.4."""
    ours, theirs = found.paths["rk2"][0], found.paths[SCIPY][0]
    ratio = theirs.flight.evaluations / ours.flight.evaluations
    return [
        f"scipy.integrate.ode has no Runge-Kutta method of order 4. What it has is {SCIPY}, the "
        "pair of Dormand and Prince that advances at order 5, estimates its error by a result of "
        "order 4 and chooses steps of its own between the points it is asked for; order 4 as in "
        "the exercise's annex is rk4 here.",
        f"With the default tolerances, asked every {DT:g} s, its points are within "
        f"{theirs.off:.1e} m of the exact motion with drag, those of RK2 within {ours.off:.1e} m. "
        f"It computes the acceleration {ratio:.1f} times as often, because a step that short is "
        "far below what it would choose.",
    ]


def impact(found: Findings) -> list[str]:
    """6.5."""
    run = found.impacts
    short = 1000 * (run.exact - run.tab_rk2_impact)
    inside = np.max(np.abs(run.interpolated - run.exact))
    side = "below" if run.best_exact < 45 else "above"
    return [
        f"The best of the 91 angles is {run.best:g}°, with {run.tab_rk2_impact.max():.2f} m. The "
        f"exact optimum is {run.best_exact:.3f}°, {side} the 45° of flight without drag.",
        f"The last stored point falls short by {np.mean(short):.3g} mm in the mean and by "
        f"{np.max(short):.3g} mm at most. Interpolated, the same points give the landing to "
        f"{inside:.1e} m: the error of this curve is not that of RK2.",
    ]


def convergence(found: Findings) -> list[str]:
    """6.6."""
    reference, loops = found.reference, found.loops
    limit = loops[0].limit
    interpolated = [_end(run, "interpolated", "exact") for run in loops]
    asked = [_end(run, "naive", "scipy") for run in loops]
    paragraphs = [
        f"SciPy's distances at {REFERENCE_DT:g} s are last stored points too, "
        f"{1000 * reference.mean_off:.2g} mm from the exact ones in the mean; the landings "
        f"interpolated in the same run are within {reference.mean_off_interpolated:.0e} m. Both "
        f"serve for a limit of {limit:g} m.",
        f"With the last stored point, as asked, the loop ends at {listed(asked)}. "
        f"{_naive_order(found)}",
        f"With the landing interpolated, it ends at {listed(interpolated)}. The slopes are now "
        + listed(f"{run.order('interpolated'):.2f} ({_SHORT[run.method]})" for run in loops)
        + ", the orders of the methods.",
    ]
    return paragraphs + _shifts(found) + _conclusion(loops)


def _end(run: Convergence, impact: str, reference: str) -> str:
    end = run.reached(impact, reference)
    name = _SHORT[run.method]
    if end is None:
        return f"no n up to {len(run.n)} for {name}"
    return f"n = {end.n}, delta = {end.delta:.4g} s for {name}"


def _naive_order(found: Findings) -> str:
    slopes = [run.order("naive") for run in found.loops]
    orders = [str(FIXED[run.method].order) for run in found.loops]
    run = next(run for run in found.loops if run.method == "rk2")
    part = (
        DELTA_1 / RATIO ** len(run.n) / 2 * np.mean(V0 * np.cos(np.deg2rad(found.impacts.degrees)))
    )
    last = run.errors["naive", "exact"][-1]
    return (
        f"The slopes of log error on log delta are {listed(f'{slope:.2f}' for slope in slopes)}, "
        f"for methods of order {listed(orders)}: what is measured of RK2 and RK4 is the part of a "
        f"step that was cut off, half a step on average. For RK2 at its last delta that is about "
        f"{part:.3f} m, and the error found is {last:.3f} m."
    )


def _shifts(found: Findings) -> list[str]:
    """Methods of order 1 that the naive impact flatters, or the reverse."""
    sentences = []
    for run in found.loops:
        if run.method not in found.paths:
            continue
        far = _miss(found.paths[run.method][0]) > 0
        naive, inside = (run.reached(impact, "exact") for impact in ("naive", "interpolated"))
        if naive is None or inside is None or FIXED[run.method].order > 1:
            continue
        if far and naive.n < inside.n:
            sentences.append(
                f"{_SHORT[run.method]} ends sooner with the last stored point than interpolated "
                f"(n = {naive.n} against {inside.n}): it lands too far, and cutting the last step "
                "takes some of that away. Two errors cancel, and the method looks better than it "
                "is."
            )
        elif not far and naive.n > inside.n:
            sentences.append(
                f"{_SHORT[run.method]} ends later with the last stored point (n = {naive.n} "
                f"against {inside.n}): it lands too short already, and the cut adds to it."
            )
    return [" ".join(sentences)] if sentences else []


def _conclusion(loops: list[Convergence]) -> list[str]:
    limit = loops[0].limit
    ends = {run.method: run.reached("interpolated", "exact") for run in loops}
    cut = {run.method: run.reached("naive", "exact") for run in loops}
    euler, rk2, rk4 = ends["euler"], ends["rk2"], ends["rk4"]
    if euler is None or rk2 is None or rk4 is None or cut["rk2"] is None or cut["rk4"] is None:
        return []
    same = "the same" if cut["rk2"].n == cut["rk4"].n else "nearly the same"
    return [
        f"Conclusion: for {limit:g} m RK2 can take steps {rk2.delta / euler.delta:.0f} times "
        f"as long as Euler, with {euler.evaluations / rk2.evaluations:.0f} times fewer evaluations "
        f"of the acceleration; RK4 is below the limit by a factor {_round(limit / rk4.error)} "
        f"at n = {rk4.n}. The loop as written hides this: it asks of RK2 and RK4 {same} step, "
        f"{rk2.delta / cut['rk2'].delta:.0f} times shorter than RK2 needs. A method is no better "
        "than the way its result is read off."
    ]


def energy(found: Findings) -> list[str]:
    """6.7."""
    by_name = {run.method: run for run in found.energies}
    start = float(by_name["euler"].total[0])
    rate = MASSE * G**2 * ENERGY_DT / 2
    drifting = [
        f"{_SHORT[m]} {'gains' if run.gain > 0 else 'loses'} {abs(run.gain):.2f} J of {start:.0f} "
        f"J ({_percent(abs(run.gain) / start)}), a steady {run.power:+.3f} W"
        for m, run in by_name.items()
        if abs(run.gain) > 1e-6
    ]
    keeping = [_SHORT[m] for m, run in by_name.items() if abs(run.gain) <= 1e-6]
    worst = max(
        np.max(np.abs(run.total - start)) for run in by_name.values() if abs(run.gain) <= 1e-6
    )
    shadows = max(by_name[m].shadow for m in ("euler", "euler_cromer"))
    return [
        f"{listed(drifting)}. {listed(keeping)} keep it to {worst:.0e} J: without drag y is a "
        "parabola in time, which a method of order 2 follows exactly.",
        "Why: the force is constant, so every method has the velocity right, and the error is all "
        "in y. Euler carries it with the velocity at the beginning of the step, Euler-Cromer with "
        "that at its end; y comes out too high, or too low, by g t DT/2, and the energy with it by "
        f"m g² DT/2 = {rate:.3f} W.",
        "Euler-Cromer does keep an energy, only not this one: the total less m g DT q/2 is "
        f"constant to {shadows:.0e} J, as is the total plus m g DT q/2 for Euler. That keeps the "
        "error bounded where q comes back to its value, as in an oscillation. In a flight q falls "
        "from launch to landing, and Euler-Cromer loses as fast as Euler gains: the stability "
        "that the exercise speaks of does not show here.",
    ]


def quadratic(found: Findings) -> list[str]:
    """6.8: the flight, and how the methods may be tested."""
    run = found.quadratic
    off = abs(float(run.rk2.impact.x) - run.exact)
    limits = [f"{step:.3f} s ({_SHORT[m]})" for m, step in run.largest_steps.items()]
    ratio = LAMBDA * V0**2 / (MASSE * G)
    return [
        f"Drag at launch is {ratio:.0f} times the weight: the projectile lands at {run.exact:.3f} "
        f"m, and RK2 with DT = {DT:g} s at {float(run.rk2.impact.x):.3f} m, {off:.1e} m off.",
        "No solution in time is known, but the speed is one of the slope, in closed form (the "
        "hodograph), and the landing follows by quadrature: the exact answer that the exercise "
        "misses. Beside it stand three tests that need none: the balance of energy and work, the "
        "terminal speed, and the limit of no drag.",
        "First, the step must not be too large: beyond "
        f"{listed(limits)} a disturbance of the velocity at the launch would grow from step to "
        "step, and the run ends with a status that says so.",
    ]


def quadratic_order(found: Findings) -> list[str]:
    """6.8: order and error against the hodograph."""
    run = found.quadratic
    inside = [f"{order.slopes[1]:.2f} ({_SHORT[order.method]})" for order in run.orders]
    cut = [f"{order.slopes[0]:.2f}" for order in run.orders]
    ends = [_end(loop, "interpolated", "exact") for loop in run.loops]
    return [
        f"Against the hodograph the slopes are {listed(inside)} with the landing interpolated, and "
        f"{listed(cut)} with the last stored point. This test tells every method from every other "
        "of another order, and gives the error itself.",
        f"The loop of 6.6, with this drag and the landing interpolated, ends at {listed(ends)}.",
    ]


def quadratic_energy(found: Findings) -> list[str]:
    """6.8: energy and the work of drag."""
    balances = found.quadratic.balances
    at = f"{BALANCE_STEPS[-1]:g} s"
    sizes = [f"{balance.largest[-1]:.2g} J ({_SHORT[balance.method]})" for balance in balances]
    slopes = [f"{balance.order:.2f}" for balance in balances]
    return [
        "Energy, plus the work done against drag (summed by the trapezoidal rule with end "
        f"corrections, error dt⁴), should stay what it was. What is missing at a step of {at}: "
        f"{listed(sizes)}. It falls with the slopes {listed(slopes)}: the order shows without "
        "any exact answer."
    ]


def quadratic_terminal(found: Findings) -> list[str]:
    """6.8: terminal speed."""
    run = found.quadratic
    worst = {fall.method: max(map(abs, fall.off)) for fall in run.falls}
    return [
        f"After a fall of {FALL:g} m from rest, the speed differs from sqrt(m g/lambda) = "
        f"{run.v_lim:.6f} m/s by {abs(run.fall_exact):.1e} of it exactly, and by at most "
        f"{max(worst.values()):.1e} with any method, at steps of "
        f"{listed(f'{step:g} s' for step in FALL_STEPS)}. At the terminal speed the acceleration "
        "is zero, so every method stays there, whatever its order and step: a test that catches a "
        "wrong law of drag, and says nothing of the method."
    ]


def quadratic_weak(found: Findings) -> list[str]:
    """6.8: lambda to 0."""
    weak = found.quadratic.weak
    off = np.max(np.abs(weak.by_rk4 / weak.exact - 1))
    gap = abs(weak.loss[-1] / weak.loss_limit - 1)
    return [
        f"As lambda goes to 0 the part of the distance lost is lambda times {weak.loss_limit:.4f} "
        f"m/kg. RK4 gives {weak.loss[-1]:.4f} m/kg at lambda = {weak.drag[-1]:.0e} kg/m "
        f"({gap:.0e} from the limit), and follows the hodograph to {off:.0e} from there to "
        f"{weak.drag[0]:g} kg/m. Without drag RK2 and RK4 are exact, so near the limit this tests "
        "the program more than the method."
    ]
