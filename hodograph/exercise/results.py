"""The numbers of the exercise: a table for the terminal, and all of them as JSON."""

from __future__ import annotations

import json
import math
from importlib.metadata import version
from typing import Any

import numpy as np

from hodograph.exercise.figures import NAMES
from hodograph.exercise.quadratic import (
    FALL,
    FALL_STEPS,
)
from hodograph.exercise.scene import (
    DELTA_1,
    DT,
    ETA,
    IMPACTS,
    LAMBDA,
    MASSE,
    MOST,
    RATIO,
    TOLERANCE,
    V0,
    Convergence,
    G,
)
from hodograph.exercise.sections import (
    ENERGY_ANGLE,
    ENERGY_DT,
    FIGURE_LAMBDA,
    REFERENCE_DT,
    Findings,
)

COMMAND = "hodograph exercise"


def summary(found: Findings) -> str:
    """The main results as plain text: n, delta and order for each method, and the energy of 6.7.

    Parameters
    ----------
    found : exercise.Findings
        From `exercise.work`.

    Returns
    -------
    str
        The table; ends without a newline.
    """
    head = ("method", "6.6 as asked", "interpolated", "order", "6.7 energy", "6.8 order")
    rows: list[tuple[str, ...]] = [head]
    for run, energy, order in zip(found.loops, found.energies, found.quadratic.orders, strict=True):
        rows.append(
            (
                NAMES[run.method],
                _short(run, "naive", "scipy"),
                _short(run, "interpolated", "exact"),
                f"{run.order('interpolated'):.2f}",
                f"{energy.gain if abs(energy.gain) > 1e-6 else 0:+.2f} J",
                f"{order.slopes[1]:.2f}",
            )
        )
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    rows.insert(1, tuple("-" * width for width in widths))
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    run_of = found.impacts
    notes = [
        f"6.6: n, and delta in s, at which the mean error is first below "
        f"{found.loops[0].limit:g} m.",
        f"6.5: best angle {run_of.best:g}° of 91, exactly {run_of.best_exact:.3f}°.",
    ]
    return "\n".join([*lines, "", *notes])


def _short(run: Convergence, impact: str, reference: str) -> str:
    end = run.reached(impact, reference)
    return f"n > {len(run.n)}" if end is None else f"{end.n:2d}  {end.delta:.4g}"


def results_json(found: Findings) -> str:
    """Every number of the run, as JSON.

    Parameters
    ----------
    found : exercise.Findings
        From `exercise.work`.

    Returns
    -------
    str
        The text of the file.
    """
    constants = {
        "MASSE_kg": MASSE,
        "DT_s": DT,
        "G_m_per_s2": G,
        "V0_m_per_s": V0,
        "ETA_kg_per_s": ETA,
        "lambda_kg_per_m": LAMBDA,
        "figure_1_lambda_kg_per_m": FIGURE_LAMBDA,
        "6.6_DT_s": DELTA_1,
        "6.6_a": RATIO,
        "6.6_limit_m": TOLERANCE,
        "6.6_reference_dt_s": REFERENCE_DT,
        "6.6_largest_n_tried": MOST,
        "6.7_DT_s": ENERGY_DT,
        "6.7_theta_deg": math.degrees(ENERGY_ANGLE),
    }
    content = {
        "made_by": f"{COMMAND}, hodograph {version('hodograph')}",
        "constants": constants,
        "figure_1": [
            {"theta_deg": degrees, "distance_m": path.x[-1]} for degrees, path in found.figure_1
        ],
        "6.3_and_6.4": [
            {
                "method": path.method,
                "eta_kg_per_s": path.eta,
                "impact_last_point_m": path.flight.impact_naive.x,
                "impact_interpolated_m": path.flight.impact.x,
                "impact_exact_m": path.exact,
                "largest_distance_from_exact_motion_m": path.off,
                "evaluations": path.flight.evaluations,
            }
            for pair in found.paths.values()
            for path in pair
        ],
        "6.5": {
            "method": "rk2",
            "theta_deg": found.impacts.degrees,
            "tab_rk2_impact_m": found.impacts.tab_rk2_impact,
            "interpolated_m": found.impacts.interpolated,
            "exact_m": found.impacts.exact,
            "best_of_91_deg": found.impacts.best,
            "best_exact_deg": found.impacts.best_exact,
        },
        "6.6": {
            "xmax_converge_m": found.reference.scipy,
            "xmax_converge_mean_off_m": found.reference.mean_off,
            "xmax_converge_mean_off_interpolated_m": found.reference.mean_off_interpolated,
            "methods": [_loop(run) for run in found.loops],
        },
        "6.7": [
            {
                "method": run.method,
                "t_s": run.t,
                "kinetic_J": run.kinetic,
                "potential_J": run.potential,
                "total_J": run.total,
                "gain_J": run.gain,
                "gain_per_second_W": run.power,
            }
            for run in found.energies
        ],
        "6.8": _quadratic(found),
    }
    return json.dumps(_plain(content), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _loop(run: Convergence) -> dict[str, Any]:
    ends: dict[str, Any] = {}
    for impact, reference in run.errors:
        end = run.reached(impact, reference)
        ends[f"{impact}_against_{reference}"] = {
            "n": end and end.n,
            "delta_s": end and end.delta,
            "error_m": end and end.error,
            "evaluations": end and end.evaluations,
            "errors_m": run.errors[impact, reference],
        }
    slopes = {f"slope_{impact}": run.order(impact) for impact in IMPACTS}
    return {"method": run.method, "delta_s": run.delta, **slopes, **ends}


def _quadratic(found: Findings) -> dict[str, Any]:
    run = found.quadratic
    return {
        "impact_exact_m": run.exact,
        "impact_rk2_m": run.rk2.impact.x,
        "largest_stable_step_s": run.largest_steps,
        "loop_of_6.6": [_loop(loop) for loop in run.loops],
        "order": [
            {
                "method": order.method,
                "dt_s": order.dt,
                "naive_m": order.naive,
                "interpolated_m": order.interpolated,
                "slope_naive": order.slopes[0],
                "slope_interpolated": order.slopes[1],
            }
            for order in run.orders
        ],
        "energy_balance": [
            {"method": balance.method, "largest_J": balance.largest, "slope": balance.order}
            for balance in run.balances
        ],
        "terminal_speed": {
            "v_lim_m_per_s": run.v_lim,
            "fall_m": FALL,
            "dt_s": FALL_STEPS,
            "exact_relative": run.fall_exact,
            "relative": {fall.method: fall.off for fall in run.falls},
        },
        "weak_drag": {
            "lambda_kg_per_m": run.weak.drag,
            "rk4_m": run.weak.by_rk4,
            "exact_m": run.weak.exact,
            "loss_over_lambda_m_per_kg": run.weak.loss,
            "limit_m_per_kg": run.weak.loss_limit,
        },
    }


def _plain(value: Any) -> Any:
    """The same in Python's own types; null for what is not finite."""
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(part) for part in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value
