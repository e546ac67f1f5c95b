"""The folder that ``hodograph exercise`` writes: figures, numbers, programs, and a page."""

import logging
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

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


_GRAPHES = {"euler": "euler", "cromer": "euler_cromer", "rk2": "rk2", "scipy": SCIPY}
PICTURES: dict[str, Callable[[Findings, Words], Figure]] = {
    "figure_1": drawn.figure_1,
    **{f"{name}_graphe1": partial(drawn.graphe1, method) for name, method in _GRAPHES.items()},
    "impact": drawn.impact,
    "comparaison_convergence": drawn.comparaison_convergence,
    "convergence_ordres": drawn.convergence_ordres,
    "energie": drawn.energie,
    "quadratique": drawn.quadratique,
    "quadratique_impact": drawn.quadratique_impact,
    "quadratique_ordre": drawn.quadratique_ordre,
    "quadratique_energie": drawn.quadratique_energie,
    "quadratique_limite": drawn.quadratique_limite,
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
    """Carry out the exercise in the folder `out`, with its own constants if there is no `setup`.

    Writes the figures under the exercise's names, as ``.pdf`` and ``.png``, the programs that it
    asks for, tables as ``.csv``, ``results.json`` and ``report.html``, each whole, once all is
    computed.  Before that comes `OSError` if the folder cannot be written: a `FileExistsError` if
    it holds one of the files already, unless `force`.
    """
    folder.check(out, FILES, force=force)
    found = work(setup or Setup())
    log.info("figures")
    contents: dict[str, bytes | str] = {}
    for name in PICTURES:
        contents |= files(name, picture(name, found, words))
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


def picture(name: str, found: Findings, words: Words = ENGLISH) -> Figure:
    """A figure by its name, the numbers along its axes as the language writes them."""
    figure = PICTURES[name](found, words)
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        if isinstance(axis.get_major_formatter(), ScalarFormatter) and words.language != "en":
            axis.set_major_formatter(lambda at, _: words.number(round(at, 9)))
    return figure


# --- the page -------------------------------------------------------------------------------


def page(contents: Mapping[str, bytes | str], found: Findings, words: Words = ENGLISH) -> str:
    """The report as one HTML page that needs nothing from outside."""
    setup = found.setup
    constants = {name: getattr(setup, name) for name in ("mass", "v0", "g", "dt", "eta", "lambda_")}
    intro = words("intro", **constants, degrees=setup.angle)
    made = words("made", command=made_by(command(setup, words)))
    body = [str(pages.paragraphs([intro, made]))]
    for key, names, table, comment in _sections():
        level = "h2" if key[0] in "fs" else "h3"
        body.append(f"<{level}>{pages.text(words(f'heads.{key}'))}</{level}>\n")
        body += [_figure(name, contents[f"{name}.png"], found, words) for name in names]
        body += [] if table is None else [table(found, words)]
        body.append(pages.paragraphs(comment(found, words)))
    return pages.page(words("title"), "".join(body), language=words.language)


_Table = Callable[[Findings, Words], str]
_Comment = Callable[[Findings, Words], Iterator[str]]


def _sections() -> list[tuple[str, tuple[str, ...], _Table | None, _Comment]]:
    """Key of the heading, figures, table and comment."""

    def linear(found: Findings, words: Words) -> str:
        return _loops_table(found.loops, REFERENCES, "linear", found.setup, words)

    def quadratic(found: Findings, words: Words) -> str:
        return _loops_table(found.quadratic.loops, ("exact",), "quadratic", found.setup, words)

    three = ("euler_graphe1", "cromer_graphe1", "rk2_graphe1")
    both = ("comparaison_convergence", "convergence_ordres")
    return [
        ("figure_1", ("figure_1",), None, comments.figure_1),
        ("s63", three, _paths_table, comments.trajectories),
        ("s64", ("scipy_graphe1",), None, comments.scipy),
        ("s65", ("impact",), None, comments.impact),
        ("s66", both, linear, comments.convergence),
        ("s67", ("energie",), None, comments.energy),
        ("s68", ("quadratique",), None, comments.quadratic),
        ("impact", ("quadratique_impact",), _impacts_table, comments.quadratic_impact),
        ("order", ("quadratique_ordre",), quadratic, comments.quadratic_order),
        ("balance", ("quadratique_energie",), None, comments.quadratic_energy),
        ("terminal", (), None, comments.quadratic_terminal),
        ("weak", ("quadratique_limite",), _weak_table, comments.quadratic_weak),
    ]


def _figure(name: str, image: bytes | str, found: Findings, words: Words) -> str:
    method, graphe, _ = name.partition("_graphe1")
    key = "graphe1" if graphe else name
    what = words.name(_GRAPHES[method]) if graphe else ""
    setup = found.setup
    caption = words(f"captions.{key}", name=what, delta_1=setup.delta_1, ratio=setup.ratio)
    space = " " if words.language == "fr" else ""
    caption = pages.Html(f"<code>{name}.pdf</code>{space}: {pages.text(caption)}")
    return pages.figure(name, image, caption, words(f"alts.{key}"))


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
    caption = words("tables.paths", degrees=found.setup.angle, dt=found.setup.dt)
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
    loop = {"delta_1": setup.delta_1, "ratio": setup.ratio, "limit": setup.limit}
    drag = words(f"tables.{drag}")
    caption = words("tables.loops", drag=drag, dt=setup.reference_dt, **loop)
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
    caption = words("tables.impacts", lambda_=found.setup.lambda_, degrees=found.setup.angle)
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
    caption = words("tables.weak", degrees=found.setup.angle, dt=found.setup.dt)
    return pages.table(caption, _heads(words, "lambda", "rk4", "hodograph", "lost"), rows)
