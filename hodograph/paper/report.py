"""The paper remade in one folder: figures, table 1, verdicts, and a page to print."""

from __future__ import annotations

import base64
import csv
import io
import json
import os
import textwrap
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from importlib.metadata import version
from pathlib import Path

from matplotlib.figure import Figure

from hodograph import laws
from hodograph._files import check_targets, write_whole
from hodograph.paper import figures
from hodograph.paper.claims import Verdict, judge
from hodograph.paper.refit import Refit, Table1, refit_table_1

COMMAND = "hodograph reproduce"
CSV_COLUMNS = (
    "parameter",
    "coefficient",
    "paper",
    "ours",
    "relative_difference",
    "window",
    "alpha0_min_deg",
    "alpha0_max_deg",
    "v_norm_max",
)
NO_BREAK_SPACE = "\N{NO-BREAK SPACE}"


@dataclass(frozen=True)
class _Figure:
    """A figure of the paper: how it is drawn, and the words that go with it."""

    number: int
    draw: Callable[[Refit], Figure]
    caption: str
    alt: str

    @property
    def name(self) -> str:
        return f"figure_{self.number}"


FIGURES = (
    _Figure(
        1,
        lambda fits: figures.figure_1(),
        "Trajectory and Frenet frame, for a launch at v_norm = 1.5 and 60°. Weight and drag are "
        "drawn to one scale.",
        "A trajectory with the tangent T, the normal N, the velocity v, the weight mg and the "
        "drag at a point M on its rising part.",
    ),
    _Figure(
        2,
        lambda fits: figures.figure_2(),
        "Trajectory with and without drag in v². The dots are the apex and the landing.",
        "Two trajectories from one launch: with drag it is lower, shorter, and steeper at its end.",
    ),
    _Figure(
        3,
        lambda fits: figures.figure_3(),
        "Normalised distance d_norm = d/d_ref against v_norm and alpha0.",
        "Map of d_norm: 1 at rest and at 0°, falling with v_norm, least for steep, fast launches.",
    ),
    _Figure(
        4,
        lambda fits: figures.figure_4(),
        "d_norm at 45°, a Pearson VII function fitted to it, and what the fit leaves. Table 1 "
        "gives the dashed line.",
        "d_norm falls from 1 as v_norm grows, and the fit follows it; a panel below shows its "
        "relative residual.",
    ),
    _Figure(
        5,
        figures.figure_5,
        "K and M against alpha0: fitted at each angle, and the polynomials of degree 3 and 2. "
        "Below, the relative deviation of the polynomials from the points, cut off at 3 %.",
        "K rises with the angle and then falls a little; M rises. Panels below show how far the "
        "polynomials are from the points.",
    ),
    _Figure(
        6,
        lambda fits: figures.figure_6(),
        "Launch angle of greatest distance against v0 for v_lim = 42.7 m/s, the law of section "
        "3.3, and its relative deviation.",
        "The best angle falls from 45° as v0 grows, with the law beside it; a panel below shows "
        "its relative deviation within the stated bound.",
    ),
)


def reproduce(
    out: str | os.PathLike[str],
    *,
    force: bool = False,
    progress: Callable[[str], None] = lambda message: None,
) -> list[Verdict]:
    """Make the paper again in the folder `out`: its figures, its table, and the verdicts.

    Writes ``figure_1`` to ``figure_6`` as ``.png`` and ``.pdf``, ``table_1.csv``,
    ``verdicts.json`` and ``report.html``, each whole, once all is computed.

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
    list of Verdict
        The claims, judged.

    Raises
    ------
    OSError
        The folder cannot be written, or, as `FileExistsError`, it holds one of the files already.
        Both are found out before the computation.
    """
    folder = Path(out)
    drawn = [f"{figure.name}.{kind}" for figure in FIGURES for kind in ("png", "pdf")]
    names = (*drawn, "table_1.csv", "verdicts.json", "report.html")
    check_targets(*(folder / name for name in names), force=force)

    progress("fits of K and M")
    fits = refit_table_1()
    contents: dict[str, bytes] = {}
    for figure in FIGURES:
        progress(f"figure {figure.number} of {len(FIGURES)}")
        picture = figure.draw(fits)
        contents[f"{figure.name}.png"] = figures.png(picture)
        contents[f"{figure.name}.pdf"] = figures.pdf(picture)
    verdicts = judge(fits, progress=progress)
    contents["table_1.csv"] = table_1_csv(fits).encode()
    contents["verdicts.json"] = verdicts_json(verdicts).encode()
    contents["report.html"] = _page(contents, fits, verdicts).encode()
    progress("writing")
    for name, content in contents.items():
        write_whole(folder / name, content, force=force)
    return verdicts


def verdict_table(verdicts: Iterable[Verdict], *, width: int = 100) -> str:
    """The verdicts as plain text: outcome, place, claim and what was measured.

    Parameters
    ----------
    verdicts : iterable of Verdict
        What to print.
    width : int, optional
        Columns to fill.

    Returns
    -------
    str
        The table, and a last line that counts the outcomes; ends without a newline.

    Examples
    --------
    >>> claim = Verdict("one", "eq. 1", "1 + 1 = 2", "2", "It is 2.", "here", True)
    >>> print(verdict_table([claim], width=60))
    verdict place        claim        measured
    ------- ------------ ------------ --------------------------
    holds   eq. 1        1 + 1 = 2    It is 2.
    <BLANKLINE>
    1 claim: 1 holds
    """
    verdicts = list(verdicts)
    outcome = max(len(word) for word in ("verdict", *(verdict.outcome for verdict in verdicts)))
    free = width - outcome - 12 - 3
    columns = (outcome, 12, free // 3, free - free // 3)
    lines = _row(("verdict", "place", "claim", "measured"), columns)
    lines += [" ".join("-" * column for column in columns)]
    for verdict in verdicts:
        cells = (verdict.outcome, verdict.place, verdict.claim, verdict.measured)
        lines += [*_row(cells, columns), ""]
    return "\n".join([*lines, tally(verdicts)])


def _row(cells: Iterable[str], widths: Iterable[int]) -> list[str]:
    """One row of a table, its cells wrapped; a number keeps its per cent sign."""
    wrapped = [
        textwrap.wrap(cell.replace(" %", f"{NO_BREAK_SPACE}%"), width)
        for cell, width in zip(cells, widths, strict=True)
    ]
    height = max(map(len, wrapped))
    lines = []
    for i in range(height):
        parts = (
            (cell[i] if i < len(cell) else "").ljust(width)
            for cell, width in zip(wrapped, widths, strict=True)
        )
        lines.append(" ".join(parts).rstrip().replace(NO_BREAK_SPACE, " "))
    return lines


def tally(verdicts: Iterable[Verdict]) -> str:
    """How many claims hold and fail, in a line.

    Parameters
    ----------
    verdicts : iterable of Verdict
        What to count.

    Returns
    -------
    str
        The line.
    """
    outcomes = [verdict.outcome for verdict in verdicts]
    holds, fails, others = (outcomes.count(word) for word in ("holds", "fails", "not judged"))
    parts = [f"{holds} hold" + "s" * (holds == 1)] * bool(holds)
    parts += [f"{fails} fail" + "s" * (fails == 1)] * bool(fails)
    parts += [f"{others} not judged"] * bool(others)
    return f"{len(outcomes)} claim{'s' * (len(outcomes) != 1)}: {', '.join(parts)}"


def verdicts_json(verdicts: Iterable[Verdict]) -> str:
    """The verdicts as JSON, a list of objects.

    Parameters
    ----------
    verdicts : iterable of Verdict
        What to write.

    Returns
    -------
    str
        The text of the file.
    """
    rows = [verdict.to_dict() for verdict in verdicts]
    return json.dumps(rows, indent=2, ensure_ascii=False) + "\n"


def table_1_csv(fits: Refit) -> str:
    """Table 1 beside our own: one row per coefficient and window, after a commented header.

    Parameters
    ----------
    fits : refit.Refit
        The fits, from `refit.refit_table_1`.

    Returns
    -------
    str
        The text of the file.
    """
    stream = io.StringIO()
    lines = (
        f"Table 1 of Vial 2008 beside our own fits, hodograph {version('hodograph')}",
        "K(alpha0) and M(alpha0) of eq. 22 are polynomials in alpha0 (radians): a0 + a1 alpha0 ...",
        "fitted by least squares to K and M at each degree, and these to exact d_norm, v_norm by "
        "0.01",
        "the paper does not state its window: 'nearest' is the one, of those tried, that comes "
        "nearest to print",
        f"remade by: {COMMAND}",
    )
    stream.writelines(f"# {line}\n" for line in lines)
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(CSV_COLUMNS)
    for window, fit in (("nearest", fits.nearest), ("whole", fits.whole)):
        for letter, index, printed, ours, off in _coefficients(fit):
            row = [letter, f"a{index}", printed, f"{ours:.6g}", f"{off:.4g}"]
            writer.writerow([*row, window, fit.low_deg, fit.high_deg, fit.v_max])
    return stream.getvalue()


def _coefficients(fit: Table1) -> Iterable[tuple[str, int, float, float, float]]:
    """(letter, index, printed, ours, relative difference) for the seven of Table 1."""
    names = [*(("K", i) for i in range(4)), *(("M", i) for i in range(3))]
    printed = (*laws.TABLE_1_K, *laws.TABLE_1_M)
    ours = (*fit.K.tolist(), *fit.M.tolist())
    for (letter, index), one, other, off in zip(
        names, printed, ours, fit.differences().tolist(), strict=True
    ):
        yield letter, index, one, other, off


STYLE = """
body { font: 16px/1.45 system-ui, sans-serif; color: #111; max-width: 62rem; margin: 2rem auto;
  padding: 0 1rem; }
h1 { font-size: 1.6rem; line-height: 1.2; }
h2 { font-size: 1.25rem; margin-top: 2.2rem; border-bottom: 1px solid #bbb; }
figure { margin: 1.5rem 0; break-inside: avoid; }
figure img { width: 100%; max-width: 16cm; height: auto; display: block; }
figcaption { font-size: 0.92rem; margin-top: 0.3rem; max-width: 16cm; }
table { border-collapse: collapse; font-size: 0.88rem; width: 100%; }
caption { text-align: left; margin-bottom: 0.4rem; }
th, td { text-align: left; vertical-align: top; padding: 0.35rem 0.5rem;
  border-bottom: 1px solid #ccc; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.outcome { font-weight: 700; white-space: nowrap; }
.holds { color: #14532d; }
.fails { color: #9f1239; }
.domain { color: #4b5563; font-size: 0.82rem; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
@page { margin: 1.8cm; }
@media print {
  body { font-size: 10pt; max-width: none; margin: 0; padding: 0; }
  h2 { break-after: avoid; }
}
"""


def _page(contents: dict[str, bytes], fits: Refit, verdicts: list[Verdict]) -> str:
    """The report as one HTML page that needs nothing from outside."""
    title = "Projectile flight under quadratic drag: Vial 2008 remade and judged"
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
<p>Alexandre Vial's paper of 20 February 2008 gives the speed of a projectile under quadratic drag
in closed form, and describes its distance by a fitted law. Each of its figures is drawn again
here from exact values, and each of its numerical claims is measured and judged.</p>
<p>{escape(tally(verdicts))}. Made by <code>{escape(COMMAND)}</code>,
hodograph {escape(version("hodograph"))}: figures, measured values and our fits are all of that
run.</p>
<h2>Verdicts</h2>
{verdicts_html(verdicts)}
<h2>Table 1</h2>
{_table_1_rows(fits)}
<h2>Figures</h2>
{"".join(_figure_block(figure, contents[f"{figure.name}.png"]) for figure in FIGURES)}
<h2>Symbols</h2>
<p>v0 and alpha0 are the speed and the slope at launch, v_lim the terminal speed of fall,
v_norm = v0/v_lim; alpha_s is the slope at the landing, d the distance on level ground, d_ref the
same without drag, d_norm = d/d_ref. Eq. 22 is d_norm = (1 + K² v_norm²/M)<sup>-M</sup>. Numbers in
parentheses are the paper's equations; (16) is the motion in time, integrated numerically.</p>
</body>
</html>
"""


def verdicts_html(verdicts: Iterable[Verdict]) -> str:
    """The verdicts as an HTML table.

    Parameters
    ----------
    verdicts : iterable of Verdict
        From `verdicts.judge`.

    Returns
    -------
    str
        A ``table`` element.

    Examples
    --------
    >>> verdicts_html([]).startswith("<table>")
    True
    """
    rows = "".join(
        f'<tr><td class="outcome {verdict.outcome}">{escape(verdict.outcome)}</td>'
        f"<td>{text(verdict.place)}</td><td>{text(verdict.claim)}</td>"
        f"<td>{text(verdict.paper)}</td>"
        f'<td>{text(verdict.measured)}<br><span class="domain">{text(verdict.domain)}</span></td>'
        "</tr>\n"
        for verdict in verdicts
    )
    heads = ("Verdict", "Place", "Claim", "Printed", "Measured, and where")
    return (
        "<table>\n<caption>The paper's claims, in its order.</caption>\n<thead><tr>"
        + "".join(f'<th scope="col">{head}</th>' for head in heads)
        + f"</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>"
    )


def _table_1_rows(fits: Refit) -> str:
    windows = [
        f"{fit.low_deg}° to {fit.high_deg}°, v_norm to {fit.v_max:g}"
        for fit in (fits.nearest, fits.whole)
    ]
    rows = []
    for near, whole in zip(_coefficients(fits.nearest), _coefficients(fits.whole), strict=True):
        letter, index, printed, _, _ = near
        cells = [f"{printed:g}"]
        for _, _, _, ours, off in (near, whole):
            cells += [f"{ours:.5f}", f"{100 * off:+.2f} %"]
        numbers = "".join(f'<td class="number">{text(cell)}</td>' for cell in cells)
        rows.append(f'<tr><th scope="row">{letter}, a<sub>{index}</sub></th>{numbers}</tr>\n')
    heads = ["Printed", windows[0], "difference", windows[1], "difference"]
    return (
        "<table>\n<caption>Coefficients of K(alpha0) and M(alpha0), alpha0 in radians: as printed, "
        "and fitted again on the window that comes nearest to print and on the whole domain."
        '</caption>\n<thead><tr><th scope="col">Coefficient</th>'
        + "".join(f'<th scope="col" class="number">{text(head)}</th>' for head in heads)
        + f"</tr></thead>\n<tbody>\n{''.join(rows)}</tbody>\n</table>"
    )


def _figure_block(figure: _Figure, image: bytes) -> str:
    data = base64.b64encode(image).decode("ascii")
    return (
        f'<figure id="{figure.name}">'
        f'<img src="data:image/png;base64,{data}" alt="{escape(figure.alt)}">\n'
        f"<figcaption>Figure {figure.number}. {text(figure.caption)}</figcaption></figure>\n"
    )


def text(words: str) -> str:
    """Text for HTML, its numbers kept with their per cent signs."""
    return escape(words).replace(" %", "&nbsp;%").replace("&lt;=", "≤").replace("&gt;=", "≥")
