"""The folder that ``hodograph exercise`` writes: figures, numbers, programs, and a page."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter

from hodograph.exercise import comments, programs
from hodograph.exercise import figures as drawn
from hodograph.exercise.convergence import IMPACTS, REFERENCES, Convergence
from hodograph.exercise.results import command, reached, results_json, tables
from hodograph.exercise.sections import SCIPY, Findings, work
from hodograph.exercise.setup import Setup
from hodograph.exercise.words import ENGLISH, Words
from hodograph.report import folder, pages
from hodograph.report.style import files
from hodograph.report.versions import made_by

log = logging.getLogger("hodograph")


class Picture(NamedTuple):
    """A figure: how it is drawn, of what, and under which key its words stand."""

    draw: Callable[[Any, Setup, Words], Figure]
    of: Callable[[Findings], Any]
    key: str
    method: str | None = None

    def figure(self, found: Findings, words: Words = ENGLISH) -> Figure:
        """The figure, the numbers along its axes as the language writes them."""
        figure = self.draw(self.of(found), found.setup, words)
        for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
            if isinstance(axis.get_major_formatter(), ScalarFormatter) and words.language != "en":
                axis.set_major_formatter(lambda at, _: words.number(round(at, 9)))
        return figure


def _graphe1(method: str) -> Picture:
    return Picture(drawn.graphe1, lambda found: found.paths[method], "graphe1", method)


PICTURES = {
    "figure_1": Picture(drawn.figure_1, lambda found: found.figure_1, "figure_1"),
    "euler_graphe1": _graphe1("euler"),
    "cromer_graphe1": _graphe1("euler_cromer"),
    "rk2_graphe1": _graphe1("rk2"),
    "scipy_graphe1": _graphe1(SCIPY),
    "impact": Picture(drawn.impact, lambda found: found.impacts, "impact"),
    "comparaison_convergence": Picture(
        drawn.comparaison_convergence, lambda found: found.loops, "comparaison_convergence"
    ),
    "convergence_ordres": Picture(
        drawn.convergence_ordres, lambda found: found.loops, "convergence_ordres"
    ),
    "energie": Picture(drawn.energie, lambda found: found.energies, "energie"),
    "quadratique_impact": Picture(
        drawn.quadratique_impact, lambda found: found.quadratic_impacts, "quadratique_impact"
    ),
    **{
        draw.__name__: Picture(draw, lambda found: found.quadratic, draw.__name__)
        for draw in (
            drawn.quadratique,
            drawn.quadratique_ordre,
            drawn.quadratique_energie,
            drawn.quadratique_limite,
        )
    },
}
TABLES = ("trajectoires.csv", "energies.csv", "portees.csv")
FILES = (
    *(f"{name}.{kind}" for name in PICTURES for kind in ("pdf", "png")),
    *TABLES,
    *programs.PROGRAMS,
    "results.json",
    "report.html",
)


def carry_out(
    out: str | os.PathLike[str],
    setup: Setup | None = None,
    words: Words = ENGLISH,
    *,
    force: bool = False,
) -> Findings:
    """Carry out the exercise in the folder `out`.

    Writes the figures under the exercise's names, as ``.pdf`` and ``.png``, the programs that it
    asks for, tables as ``.csv``, ``results.json`` and ``report.html``, each whole, once all is
    computed.

    Parameters
    ----------
    out : path-like
        The folder; made if it is not there.
    setup : Setup, optional
        The constants; the exercise's own by default.
    words : Words, optional
        The language of figures, page and comments.
    force : bool, optional
        Replace files that are there.

    Raises
    ------
    OSError
        The folder cannot be written, or, as `FileExistsError`, it holds one of the files already.
        Both are found out before the computation.
    """
    folder.check(out, FILES, force=force)
    found = work(setup or Setup())
    log.info("figures")
    contents: dict[str, bytes | str] = {}
    for name, picture in PICTURES.items():
        contents |= files(name, picture.figure(found, words))
    contents |= tables(found, words)
    contents |= programs.solved(found)
    contents["results.json"] = results_json(found, words)
    contents["report.html"] = page(contents, found, words)
    log.info("writing")
    folder.write(out, contents, force=force)
    return found


def for_students(
    out: str | os.PathLike[str], setup: Setup | None = None, *, force: bool = False
) -> list[Path]:
    """Write the programs with their functions left blank, and the tests that a class can run."""
    contents = programs.blank(setup or Setup())
    folder.check(out, contents, force=force)
    return folder.write(out, contents, force=force)


# --- the page -------------------------------------------------------------------------------


def page(contents: dict[str, bytes | str], found: Findings, words: Words) -> str:
    """The report as one HTML page that needs nothing from outside."""

    def pictures(*names: str) -> str:
        return "".join(_figure(name, contents[f"{name}.png"], words) for name in names)

    def answers(*functions: Callable[[Findings, Words], list[str]]) -> str:
        return "".join(pages.paragraphs(function(found, words)) for function in functions)

    loops, square = found.loops, found.quadratic.loops
    three = ("euler_graphe1", "cromer_graphe1", "rk2_graphe1")
    sections = {
        "figure_1": [pictures("figure_1"), answers(comments.figure_1)],
        "s63": [pictures(*three), _paths_table(found, words), answers(comments.trajectories)],
        "s64": [pictures("scipy_graphe1"), answers(comments.scipy)],
        "s65": [pictures("impact"), answers(comments.impact)],
        "s66": [
            pictures("comparaison_convergence", "convergence_ordres"),
            _loops_table(loops, REFERENCES, "linear", found.setup, words),
            answers(comments.convergence),
        ],
        "s67": [pictures("energie"), answers(comments.energy)],
        "s68": [pictures("quadratique"), answers(comments.quadratic)],
        "impact": [
            pictures("quadratique_impact"),
            _impacts_table(found, words),
            answers(comments.quadratic_impact),
        ],
        "order": [
            pictures("quadratique_ordre"),
            _loops_table(square, ("exact",), "quadratic", found.setup, words),
            answers(comments.quadratic_order),
        ],
        "balance": [pictures("quadratique_energie"), answers(comments.quadratic_energy)],
        "terminal": [answers(comments.quadratic_terminal)],
        "weak": [
            pictures("quadratique_limite"),
            _weak_table(found, words),
            answers(comments.quadratic_weak),
        ],
    }
    setup = found.setup
    intro = words(
        "intro",
        **{name: getattr(setup, name) for name in ("mass", "v0", "g", "dt", "eta", "lambda_")},
        degrees=setup.degrees,
    )
    made = words("made", command=made_by(command(setup, words)))
    body = [str(pages.paragraphs([intro, made]))]
    for key, parts in sections.items():
        level = "h2" if key[0] in "fs" else "h3"
        body += [f"<{level}>{pages.text(words(f'heads.{key}'))}</{level}>\n", *parts]
    return pages.page(words("title"), "".join(body), language=words.language)


def _figure(name: str, image: bytes | str, words: Words) -> str:
    picture = PICTURES[name]
    method = None if picture.method is None else words.name(picture.method)
    constants = {"delta_1": Setup.delta_1, "ratio": Setup.ratio}
    caption = pages.text(words(f"captions.{picture.key}", name=method, **constants))
    file = pages.Html(f"<code>{name}.pdf</code>{' ' if words.language == 'fr' else ''}: {caption}")
    return pages.figure(name, image, file, words(f"alts.{picture.key}"))


def _heads(words: Words, *names: str) -> list[str]:
    return [words(f"tables.{name}") for name in names]


def _paths_table(found: Findings, words: Words) -> str:
    number = words.number
    rows = [
        (
            words.name(path.method),
            number(path.eta),
            *(
                number(float(x), ".4f")
                for x in (path.flight.impact_naive.x, path.flight.impact.x, path.exact)
            ),
            number(path.off, ".1e"),
        )
        for pair in found.paths.values()
        for path in pair
    ]
    caption = words("tables.paths", degrees=found.setup.degrees, dt=found.setup.dt)
    heads = _heads(words, "method", "eta", "naive", "interpolated", "exact", "off")
    return pages.table(caption, heads, rows)


def _loops_table(
    loops: Sequence[Convergence], references: Sequence[str], drag: str, setup: Setup, words: Words
) -> str:
    ends = [name for reference in references for name in (f"n_{reference}", "delta")]
    heads = _heads(words, "method", "impact", *ends, "evaluations")
    rows = []
    for run in loops:
        for impact in IMPACTS:
            row = [words.name(run.method), words(f"tables.{impact}")]
            for reference in references:
                row += reached(run, impact, reference, words)
            end = run.reached(impact, references[-1])
            rows.append([*row, "–" if end is None else str(end.evaluations)])
    caption = words(
        "tables.loops",
        drag=words(f"tables.{drag}"),
        dt=setup.reference_dt,
        delta_1=setup.delta_1,
        ratio=setup.ratio,
        limit=setup.limit,
    )
    return pages.table(caption, heads, rows)


def _impacts_table(found: Findings, words: Words) -> str:
    number = words.number
    flights, runs = found.quadratic.flights, found.quadratic_impacts
    rows = [
        (
            words.name(run.method),
            number(float(flights[run.method].impact_naive.x), ".4f"),
            number(float(flights[run.method].impact.x), ".4f"),
            number(run.best),
            number(run.best_fitted, ".3f"),
        )
        for run in runs
    ]
    exact = number(found.quadratic.exact, ".4f")
    rows.append((words("tables.exact"), "", exact, "", number(runs[0].best_exact, ".3f")))
    caption = words("tables.impacts", lambda_=found.setup.lambda_, degrees=found.setup.degrees)
    heads = _heads(words, "method", "at", "inside", "best", "fitted")
    return pages.table(caption, heads, rows)


def _weak_table(found: Findings, words: Words) -> str:
    weak, number = found.quadratic.weak, words.number
    rows = [
        (f"{drag:.0e}", number(flown, ".6f"), number(exact, ".6f"), number(loss, ".4f"))
        for drag, flown, exact, loss in zip(
            weak.drag, weak.by_rk4, weak.exact, weak.loss, strict=True
        )
    ]
    caption = words("tables.weak", degrees=found.setup.degrees, dt=found.setup.dt)
    return pages.table(caption, _heads(words, "lambda", "rk4", "hodograph", "lost"), rows)
