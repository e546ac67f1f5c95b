"""The folder that ``hodograph exercise`` writes: figures, numbers, and a page to print."""

from __future__ import annotations

import base64
import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from html import escape
from importlib.metadata import version
from pathlib import Path

from matplotlib.figure import Figure

from hodograph._files import check_targets, write_whole
from hodograph.exercise import comments
from hodograph.exercise import figures as drawn
from hodograph.exercise.figures import NAMES
from hodograph.exercise.results import COMMAND, results_json
from hodograph.exercise.scene import (
    DELTA_1,
    DT,
    MASSE,
    RATIO,
    REFERENCES,
    V0,
    Convergence,
    G,
)
from hodograph.exercise.sections import REFERENCE_DT, SCIPY, Findings, work
from hodograph.paper.figures import pdf, png
from hodograph.paper.report import STYLE, text

RIGHT = ' style="text-align: right"'


@dataclass(frozen=True)
class _Picture:
    """A figure: its file, how it is drawn, and the words that go with it."""

    name: str
    draw: Callable[[Findings], Figure]
    caption: str
    alt: str


def _graphe1(name: str, method: str) -> _Picture:
    return _Picture(
        f"{name}_graphe1",
        lambda found: drawn.graphe1(found.paths[method]),
        f"Trajectories by {NAMES[method]}, with drag and without; the last stored points are in "
        "the legend.",
        "Two arcs from the origin, the one with drag a little lower and shorter.",
    )


PICTURES = {
    picture.name: picture
    for picture in (
        _Picture(
            "figure_1",
            lambda found: drawn.figure_1(found.figure_1),
            "The exercise's figure 1: quadratic drag, three launch angles.",
            "Three trajectories from the origin, each steeper at its end than at its start.",
        ),
        _graphe1("euler", "euler"),
        _graphe1("cromer", "euler_cromer"),
        _graphe1("rk2", "rk2"),
        _graphe1("scipy", SCIPY),
        _Picture(
            "impact",
            lambda found: drawn.impact(found.impacts),
            "Distance against launch angle, every degree; below, how far the last stored point "
            "and the interpolated landing are from the exact one.",
            "The distance rises from 0 to a flat top near 44° and falls to 0 at 90°. The last "
            "stored point is short by a jagged amount; the interpolated landing is not.",
        ),
        _Picture(
            "comparaison_convergence",
            lambda found: drawn.comparaison_convergence(found.loops),
            "Mean error over 91 angles against n, delta = 1/1.1ⁿ s; above, delta itself.",
            "With the last stored point all curves fall alike. Interpolated, they fall with three "
            "slopes: Euler and Euler-Cromer together, RK2 steeper, RK4 steepest.",
        ),
        _Picture(
            "energie",
            lambda found: drawn.energie(found.energies),
            "Energies in time without drag; below, how the total changes.",
            "The total rises in a straight line by Euler, falls in one by Euler-Cromer, and stays "
            "by RK2 and RK4.",
        ),
        _Picture(
            "quadratique",
            lambda found: drawn.quadratique(found.quadratic),
            "Quadratic drag: the exact trajectory, and RK2 in steps.",
            "The trajectory rises nearly straight, turns over and falls steeply; the dots of RK2 "
            "lie on it.",
        ),
        _Picture(
            "quadratique_ordre",
            lambda found: drawn.quadratique_ordre(found.quadratic),
            "Quadratic drag: mean error over 91 angles against the step.",
            "With the last stored point all slopes are near 1; interpolated they are near 1, 1, 2 "
            "and 4.",
        ),
        _Picture(
            "quadratique_energie",
            lambda found: drawn.quadratique_energie(found.quadratic),
            "Quadratic drag: energy plus the work done against drag, less the energy at launch.",
            "What is missing grows in the first tenth of a second and then stays: most for Euler "
            "and Euler-Cromer, least for RK4.",
        ),
        _Picture(
            "quadratique_limite",
            lambda found: drawn.quadratique_limite(found.quadratic),
            "Weak quadratic drag: the part of the distance lost, over lambda.",
            "The curve rises to a limit as lambda falls, and the dots of RK4 lie on it.",
        ),
    )
}
FILES = (
    *(f"{name}.{kind}" for name in PICTURES for kind in ("pdf", "png")),
    "results.json",
    "report.html",
)


def carry_out(
    out: str | os.PathLike[str],
    *,
    force: bool = False,
    progress: Callable[[str], None] = lambda message: None,
) -> Findings:
    """Carry out the exercise in the folder `out`: its figures, its numbers, and a page.

    Writes the figures under the exercise's names, as ``.pdf`` and ``.png``, ``results.json`` and
    ``report.html``, each whole, once all is computed.

    Parameters
    ----------
    out : path-like
        The folder; made if it is not there.
    force : bool, optional
        Replace files that are there.
    progress : callable, optional
        Called with a short message as each part begins.

    Returns
    -------
    exercise.Findings
        The results.

    Raises
    ------
    OSError
        The folder cannot be written, or, as `FileExistsError`, it holds one of the files already.
        Both are found out before the computation.
    """
    folder = Path(out)
    check_targets(*(folder / name for name in FILES), force=force)

    found = work(progress)
    progress("figures")
    contents: dict[str, bytes] = {}
    for name, picture in PICTURES.items():
        figure = picture.draw(found)
        contents[f"{name}.pdf"] = pdf(figure)
        contents[f"{name}.png"] = png(figure)
    contents["results.json"] = results_json(found).encode()
    contents["report.html"] = _page(contents, found).encode()
    progress("writing")
    for name, content in contents.items():
        write_whole(folder / name, content, force=force)
    return found


# --- the page -------------------------------------------------------------------------------


def _page(contents: dict[str, bytes], found: Findings) -> str:
    """The report as one HTML page that needs nothing from outside."""
    title = "A ballistics exercise, carried out and answered"

    def pictures(*names: str) -> str:
        return "".join(_figure(PICTURES[name], contents[f"{name}.png"]) for name in names)

    def words(*answers: Callable[[Findings], list[str]]) -> str:
        return "".join(f"<p>{text(part)}</p>\n" for answer in answers for part in answer(found))

    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(title)}</title>
<style>{STYLE}</style>
</head>
<body>
<h1>{escape(title)}</h1>
<p>The exercise integrates the motion of a projectile under linear, then quadratic drag by the
methods of Euler, Euler-Cromer and Runge-Kutta. Its sections 6.3 to 6.8 are carried out here with
its own constants ({MASSE:g} kg, v0 = {V0:g} m/s, g = {G} m/s²) and file names, and RK4, of its
annex, is taken along. Every distance is held against the exact one, and the comments are worked out
from the numbers of this run.</p>
<p>Made by <code>{COMMAND}</code>, hodograph {escape(version("hodograph"))}.</p>
<h2>Figure 1</h2>
{pictures("figure_1")}{words(comments.figure_1)}
<h2>6.3 The three methods</h2>
{pictures("euler_graphe1", "cromer_graphe1", "rk2_graphe1")}{_paths_table(found)}
{words(comments.trajectories)}
<h2>6.4 The same by SciPy</h2>
{pictures("scipy_graphe1")}{words(comments.scipy)}
<h2>6.5 Point of impact</h2>
{pictures("impact")}{words(comments.impact)}
<h2>6.6 Speed of convergence</h2>
{pictures("comparaison_convergence")}{_loops_table(found.loops, REFERENCES, "Linear drag")}
{words(comments.convergence)}
<h2>6.7 Stability: the energy</h2>
{pictures("energie")}{words(comments.energy)}
<h2>6.8 Quadratic drag</h2>
{pictures("quadratique")}{words(comments.quadratic)}
<h3>Order and error against the hodograph</h3>
{pictures("quadratique_ordre")}
{_loops_table(found.quadratic.loops, ("exact",), "Quadratic drag")}
{words(comments.quadratic_order)}
<h3>Energy and the work of drag</h3>
{pictures("quadratique_energie")}{words(comments.quadratic_energy)}
<h3>Terminal speed</h3>
{words(comments.quadratic_terminal)}
<h3>Lambda to 0</h3>
{pictures("quadratique_limite")}{_weak_table(found)}
{words(comments.quadratic_weak)}
</body>
</html>
"""


def _figure(picture: _Picture, image: bytes) -> str:
    data = base64.b64encode(image).decode("ascii")
    return (
        f'<figure id="{picture.name}">'
        f'<img src="data:image/png;base64,{data}" alt="{escape(picture.alt)}">\n'
        f"<figcaption><code>{picture.name}.pdf</code>: {text(picture.caption)}"
        "</figcaption></figure>\n"
    )


def table_html(caption: str, heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table of numbers for HTML; the first cell of a row names it.

    Parameters
    ----------
    caption : str
        What the table shows.
    heads : sequence of str
        One for each column.
    rows : iterable of sequence of str
        The cells.

    Returns
    -------
    str
        A ``table`` element.

    Examples
    --------
    >>> "<td" in table_html("Primes", ("which", "value"), [("first", "2")])
    True
    """
    top = "".join(
        f'<th scope="col"{RIGHT if i else ""}>{text(head)}</th>' for i, head in enumerate(heads)
    )
    body = "".join(
        f'<tr><th scope="row">{text(first)}</th>'
        + "".join(f'<td class="number">{text(cell)}</td>' for cell in cells)
        + "</tr>\n"
        for first, *cells in rows
    )
    return (
        f"<table>\n<caption>{text(caption)}</caption>\n<thead><tr>{top}</tr></thead>\n"
        f"<tbody>\n{body}</tbody>\n</table>\n"
    )


def _paths_table(found: Findings) -> str:
    heads = ("Method", "eta (kg/s)", "last point", "interpolated", "exact", "farthest point")
    rows = [
        (
            NAMES[path.method],
            f"{path.eta:g}",
            f"{path.flight.impact_naive.x:.4f}",
            f"{path.flight.impact.x:.4f}",
            f"{path.exact:.4f}",
            f"{path.off:.1e}",
        )
        for pair in found.paths.values()
        for path in pair
    ]
    caption = (
        f"Distance at 45° with DT = {DT:g} s, and the largest distance of a stored point from the "
        "exact position at its time; all in m."
    )
    return table_html(caption, heads, rows)


def _loops_table(loops: Sequence[Convergence], references: Sequence[str], caption: str) -> str:
    against = {"scipy": f"SciPy at {REFERENCE_DT:g} s", "exact": "the exact answer"}
    heads = ["Method", "impact"]
    for reference in references:
        heads += [f"n, against {against[reference]}", "delta (s)"]
    heads += ["evaluations"]
    rows = []
    for run in loops:
        for impact, words in (("naive", "last point"), ("interpolated", "interpolated")):
            row = [NAMES[run.method], words]
            end = None
            for reference in references:
                end = run.reached(impact, reference)
                row += [f"> {len(run.n)}", "–"] if end is None else [str(end.n), f"{end.delta:.4g}"]
            rows.append([*row, "–" if end is None else str(end.evaluations)])
    words = (
        f"{caption}: n and delta = {DELTA_1:g}/{RATIO:g}ⁿ s at which the mean error over 91 angles "
        f"is first below {loops[0].limit:g} m, and how often the acceleration is computed there "
        "for the longest flight."
    )
    return table_html(words, heads, rows)


def _weak_table(found: Findings) -> str:
    weak = found.quadratic.weak
    heads = ("lambda (kg/m)", "RK4 (m)", "hodograph (m)", "lost / lambda (m/kg)")
    rows = [
        (f"{drag:.0e}", f"{flown:.6f}", f"{exact:.6f}", f"{loss:.4f}")
        for drag, flown, exact, loss in zip(
            weak.drag, weak.by_rk4, weak.exact, weak.loss, strict=True
        )
    ]
    return table_html(f"Distance at 45° by RK4 with DT = {DT:g} s, and exact.", heads, rows)
