"""The numbers of the exercise: a table for the terminal, CSV tables, and all of them as JSON."""

import json
import math
from collections.abc import Iterable, Iterator
from dataclasses import fields
from typing import Any

import numpy as np

from hodograph.exercise.convergence import IMPACTS, Convergence
from hodograph.exercise.quadratic import Order
from hodograph.exercise.sections import Findings, energy
from hodograph.exercise.setup import Setup
from hodograph.exercise.words import ENGLISH, Words
from hodograph.launch import Trajectory
from hodograph.report.tables import csv_text, plain
from hodograph.report.versions import made_by
from hodograph.steppers import Flights, Point

_COLUMNS = ("t_s", "x_m", "y_m", "xp_m_per_s", "yp_m_per_s")
_MOST_ROWS = 1500  # of a trajectory in its CSV file


def command(setup: Setup, words: Words = ENGLISH) -> str:
    """What to type for this run.

    >>> command(Setup(mass=2.0), Words("fr"))
    'hodograph exercise --mass 2 --lang fr'
    """
    given = [(field, getattr(setup, field.name)) for field in fields(setup)[:7]]
    options = [
        f"--{field.name.strip('_')} {value:.12g}"
        for field, value in given
        if value != field.default
    ]
    if words.language != "en":
        options.append(f"--lang {words.language}")
    return " ".join(["hodograph exercise", *options])


def summary(found: Findings, words: Words = ENGLISH) -> str:
    """The main results as plain text: n, delta and order for each method, and the energy of 6.7.

    It ends without a newline.
    """
    columns = ("asked", "asked_delta", "inside", "inside_delta", "order", "energy", "square")
    rows = []
    for run, drift, order in zip(found.loops, found.energies, found.quadratic.orders, strict=True):
        small = abs(drift.gain) < 1e-9 * drift.total[0]
        rows.append(
            (
                words.short(run.method),
                *reached(run, "naive", "scipy", words),
                *reached(run, "interpolated", "exact", words),
                words.number(run.order("interpolated"), ".2f"),
                words.number(0.0 if small else drift.gain, "+.2f"),
                words.number(order.slopes[1], ".2f"),
            )
        )
    heads = [words("tables.method"), *(words(f"summary.{column}") for column in columns)]
    best, square = found.impacts, found.quadratic_impacts[-1]
    figure_1 = found.figure_1.best
    notes = [
        words("summary.loop", limit=found.setup.limit),
        words("summary.best", best=best.best, exact=best.best_exact),
        words("summary.best_square", best=square.best, exact=square.best_exact, figure_1=figure_1),
    ]
    return "\n".join([*plain(heads, rows), "", *notes])


def reached(run: Convergence, impact: str, reference: str, words: Words) -> tuple[str, str]:
    """n and delta at which a loop ends, as two cells of a table."""
    end = run.reached(impact, reference)
    if end is None:
        return f"> {len(run.n)}", "–"
    return str(end.n), words.number(end.delta, ".4g")


# --- CSV ------------------------------------------------------------------------------------


def tables(found: Findings, words: Words = ENGLISH) -> dict[str, str]:
    """Trajectories, energies and distances as CSV files, by name."""
    setup, remade = found.setup, command(found.setup, words)
    energies = ["kinetic_J", "potential_J", "total_J"]
    every = _every(setup)
    distances = {
        "theta_deg": setup.angles,
        "xmax_converge_m": found.reference.scipy,
        "exact_m": found.impacts.exact,
        "quadratic_exact_m": found.quadratic_impacts[0].exact,
    }
    for fan in (found.impacts, *found.quadratic_impacts):
        name = fan.method if fan is found.impacts else f"quadratic_{fan.method}"
        distances |= {f"{name}_{impact}_m": getattr(fan, impact) for impact in IMPACTS}
    about = {
        "trajectoires.csv": f"6.3, 6.4 and 6.8: trajectories at {setup.angle:g} degrees, DT = "
        f"{setup.dt:g} s, every {every * setup.dt:g} s and the last two points",
        "energies.csv": f"6.7: energies without drag at {setup.energy_degrees:g} degrees, "
        f"DT = {setup.energy_dt:g} s",
        "portees.csv": "6.5, 6.6 and 6.8: distance against launch angle",
    }
    heads = (
        ["method", "eta_kg_per_s", "lambda_kg_per_m", *_COLUMNS, *energies],
        ["method", "t_s", *energies],
        distances,
    )
    rows: tuple[Iterable[Iterable[Any]], ...] = (
        _trajectories(found, every),
        (
            (run.method, *row)
            for run in found.energies
            for row in zip(run.t, run.kinetic, run.potential, run.total, strict=True)
        ),
        zip(*distances.values(), strict=True),
    )
    return {
        name: csv_text([told], columns, own, command=remade)
        for (name, told), columns, own in zip(about.items(), heads, rows, strict=True)
    }


def _every(setup: Setup) -> int:
    """Which nodes of a trajectory its table has: all, or every 10th, 100th, ..."""
    nodes = setup.vacuum_time / setup.dt
    return int(10.0 ** max(0, math.ceil(math.log10(nodes / _MOST_ROWS))))


def _trajectories(found: Findings, every: int) -> Iterator[list[str]]:
    flown: list[tuple[str, float, float, Flights]] = [
        (path.method, path.eta, 0.0, path.flight) for pair in found.paths.values() for path in pair
    ]
    strong = found.setup.lambda_
    flown += [(method, 0.0, strong, flight) for method, flight in found.quadratic.flights.items()]
    for method, eta, lambda_, flight in flown:
        nodes = np.arange(len(flight.t))
        kept = (nodes % every == 0) | (nodes >= len(nodes) - 2)
        kinetic, potential = energy(found.setup, flight)
        total = kinetic + potential
        path = (flight.t, flight.x, flight.y, flight.p, flight.q, kinetic, potential, total)
        for row in np.array(path)[:, kept].T:
            yield [method, f"{eta:g}", f"{lambda_:g}", *(f"{cell:.10g}" for cell in row)]


# --- JSON -----------------------------------------------------------------------------------


def results_json(found: Findings, words: Words = ENGLISH) -> str:
    """Every number of the run as JSON, under the names of `sections` and `quadratic`.

    Of a trajectory only the landing is there; the points are in ``trajectoires.csv``.
    """
    content = {
        "made_by": made_by(command(found.setup, words)),
        "units": "SI; angles in degrees",
        **_plain(found),
    }
    return json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _plain(value: Any) -> Any:
    """The same in Python's own types; null for what is not finite."""
    if isinstance(value, Flights):
        kept = ("impact", "impact_naive", "status", "steps", "evaluations")
        return {name: _plain(getattr(value, name)) for name in kept}
    if isinstance(value, Trajectory):
        return {"t": float(value.t[-1]), "x": float(value.x[-1])}
    if isinstance(value, Setup | Point):
        return _plain(vars(value))
    if isinstance(value, Convergence):
        ends = {key: value.reached(*key) for key in value.errors}
        orders = {impact: value.order(impact) for impact in IMPACTS}
        return _plain(value._asdict() | {"reached": ends, "order": orders})
    if isinstance(value, Order):
        return _plain(value._asdict() | {"slopes": dict(zip(IMPACTS, value.slopes, strict=True))})
    if hasattr(value, "_asdict"):
        return _plain(value._asdict())
    if isinstance(value, dict):
        return {_key(key): _plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(part) for part in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _key(key: str | tuple[str, str]) -> str:
    return key if isinstance(key, str) else " against ".join(key)
