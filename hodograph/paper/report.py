"""The paper remade in one folder: figures, table 1, verdicts, and a page to read or print."""

import json
import logging
import os
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from matplotlib.figure import Figure

from hodograph.paper import figures, table_1
from hodograph.paper.claims import judge
from hodograph.paper.table_1 import NAMES, PRINTED, Procedure
from hodograph.paper.verdict import OUTCOMES, Verdict, tally
from hodograph.report import folder, pages, style, tables
from hodograph.report.pages import Html
from hodograph.report.versions import made_by

log = logging.getLogger("hodograph")
COMMAND = "hodograph reproduce"
TABLE, VERDICTS, PAGE = "table_1.csv", "verdicts.json", "report.html"
TITLE = "Projectile flight under quadratic drag: Vial 2008 remade and judged"


@dataclass(frozen=True)
class _Figure:
    """A figure: how it is drawn, the claim that it stands beside, and the words that go with it."""

    name: str
    beside: str
    draw: Callable[[], Figure]
    caption: str
    alt: str


FIGURES = (
    _Figure("figure_1", "speed", figures.figure_1,
            "Figure 1. Trajectory and Frenet frame, for a launch at v_norm = 1.5 and 60°. Speeds "
            "over v_lim and forces over the weight are drawn to one scale; T and N are directions.",
            "A trajectory with the tangent T, the normal N, the velocities v0 and v, the weight mg "
            "and the drag at a point M on its rising part."),
    _Figure("figure_2", "position", figures.figure_2,
            "Figure 2. Trajectory with and without drag in v². The dots are the apex and the "
            "landing.",
            "Two trajectories from one launch: with drag it is lower, shorter, and steeper at its "
            "end."),
    _Figure("figure_3", "d_norm_similar", figures.figure_3,
            "Figure 3. Normalised distance d_norm = d/d_ref against v_norm and alpha0.",
            "Map of d_norm: 1 at rest and at 0°, falling with v_norm, least for steep, fast "
            "launches."),
    _Figure("figure_4", "pearson_form", figures.figure_4,
            "Figure 4. d_norm at 45°, a Pearson VII function fitted to it, and what the fit "
            "leaves. Table 1 gives the dashed line.",
            "d_norm falls from 1 as v_norm grows, and the fit follows it; a panel below shows its "
            "relative residual."),
    _Figure("figure_5", "table_1_origin", figures.figure_5,
            "Figure 5. K and M against alpha0: the points that table 1 was fitted to, as far as "
            "can be told, its polynomials and ours. Below, the relative deviation of each from the "
            "points of its own window.",
            "K rises with the angle and then falls a little; M rises. Panels below show how far "
            "the polynomials are from the points."),
    _Figure("figure_6", "alpha_max_error", figures.figure_6,
            "Figure 6. Launch angle of greatest distance against v0 for v_lim = 42.7 m/s, the law "
            "of section 3.3, and its relative deviation.",
            "The best angle falls from 45° as v0 grows, with the law beside it; a panel below "
            "shows its relative deviation within the stated bound."),
    _Figure("figure_didion", "ref_didion", figures.figure_didion,
            "Not in the paper. Best angle for the drag v²(1 + v/c) over the weight, v and c in "
            "v_lim of the square term, and its difference from the square alone.",
            "Curves of the best angle for a square drag and for three cubic terms beside it lie "
            "close together up to v_norm = 1.5, and part above: the cubic term then raises it."),
)  # fmt: skip
FILES = (
    *(f"{figure.name}.{kind}" for figure in FIGURES for kind in ("png", "pdf")),
    *(TABLE, VERDICTS, PAGE),
)


def reproduce(out: str | os.PathLike[str], *, force: bool = False) -> list[Verdict]:
    """Make the paper again in the folder `out`: its figures, its table, and the verdicts.

    The files are written whole, after the computation.  Before it comes `OSError` if the folder
    cannot be written: a `FileExistsError` if it holds one of `FILES` already, unless `force`.
    """
    folder.check(out, FILES, force=force)
    contents: dict[str, bytes | str] = {}
    for number, figure in enumerate(FIGURES, 1):
        log.info("figure %d of %d", number, len(FIGURES))
        contents |= style.files(figure.name, figure.draw())
    verdicts = judge()
    contents[TABLE] = table_1_csv()
    contents[VERDICTS] = verdicts_json(verdicts)
    contents[PAGE] = _page(contents, verdicts)
    log.info("writing")
    folder.write(out, contents, force=force)
    return verdicts


def verdict_table(verdicts: Iterable[Verdict], *, width: int = 100) -> str:
    """The verdicts as plain text: outcome, place, claim and what was measured, and their tally.

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
    rows = [(each.outcome, each.place, each.claim, each.measured) for each in verdicts]
    lines = tables.wrapped(("verdict", "place", "claim", "measured"), rows, columns)
    return "\n".join([*lines, tally(verdicts)])


def verdicts_json(verdicts: Iterable[Verdict]) -> str:
    """The verdicts as JSON, a list of objects; `holds` is null where nothing is claimed."""
    rows = [verdict.to_dict() for verdict in verdicts]
    return json.dumps(rows, indent=2, ensure_ascii=False) + "\n"


def _fits() -> list[tuple[str, table_1.Fit]]:
    degree = Procedure(stop=0.01 * table_1.DEGREE)
    return [
        ("stop at 0.01 rad", table_1.fit()),
        ("stop at 0.01°", table_1.fit(degree)),
        ("1° to 90°, exact", table_1.whole()),
    ]


def table_1_csv() -> str:
    """Table 1 beside our own fits: one row for each coefficient and fit."""
    about = (
        "Table 1 of Vial 2008 beside our own fits",
        "K(alpha0) and M(alpha0) of eq. 22 are polynomials in alpha0 (radians): a0 + a1 alpha0 ...",
        "the first fit gives the printed digits: Newton's iteration stopped at 0.01 radian",
    )
    heads = ("parameter", "coefficient", "paper", "ours", "relative_difference", "fit")
    window = ("alpha0_min_deg", "alpha0_max_deg", "alpha0_step_deg", "v_norm_max", "v_norm_step")
    rows = [
        (
            *name.split("_"),
            f"{printed:g}",
            f"{ours:.6g}",
            f"{off:.4g}",
            *(words, fit.how.low, fit.how.high, fit.how.step, fit.how.v_max, fit.how.v_step),
        )
        for words, fit in _fits()
        for name, printed, ours, off in zip(
            NAMES, PRINTED.tolist(), fit.coefficients.tolist(), fit.off.tolist(), strict=True
        )
    ]
    return tables.csv_text(about, (*heads, *window), rows, command=COMMAND)


# --- the page -------------------------------------------------------------------------------

STYLE = """
nav ul { columns: 2; padding-left: 1.2rem; }
.claim { border-left: 4px solid #9ca3af; padding: 0.1rem 0 0.1rem 0.8rem; margin: 1.1rem 0;
  break-inside: avoid; }
.claim.holds { border-color: #15803d; }
.claim.fails { border-color: #be123c; }
.claim { color: #111; }
.claim p { margin: 0.25rem 0; max-width: 46rem; }
.claim.holds .outcome { color: #14532d; }
.claim.fails .outcome { color: #9f1239; }
.place { color: #4b5563; }
.said { font-weight: 600; }
.outcomes { font-size: 1.1rem; list-style: none; padding: 0; }
math { font-size: 1.1em; }
math[display=block] { margin: 0.6rem 0; overflow-x: auto; overflow-y: hidden; }
.wide { overflow-x: auto; }
.wide th { white-space: nowrap; }
@media (max-width: 36rem) { body { margin: 0.5rem auto; } nav ul { columns: 1; }
  th, td { padding: 0.3rem 0.2rem; } .wide table { font-size: 0.74rem; } }
@media print { nav { display: none; } .claim { margin: 0.7rem 0; } }
"""
SECTIONS = (
    ("motion", "Section 2: the speed, the path and its length", "2"),
    ("distance", "Section 3.1: the normalised distance", "3.1"),
    ("laws", "Section 3.2: a law for the distance, and table 1", "3.2"),
    ("angle", "Section 3.3: the best angle", "3.3"),
    ("references", "What it refers to", "ref"),
)
# Symbols in running text: what is written, and how it is set.
_SYMBOLS = {
    r"(?<!\w)(v|d)_(norm|lim|ref)(?![a-z])": r"<i>\1</i><sub>\2</sub>",
    r"\balpha_(s|max)\b": r"<i>α</i><sub>\1</sub>",
    r"\balpha_?0\b": "<i>α</i><sub>0</sub>",
    r"\bv0\b": "<i>v</i><sub>0</sub>",
    r"\balpha\b": "<i>α</i>",
    r"\blambda\b": "<i>λ</i>",
    r"\bphi\b": "<i>φ</i>",
    r"\bsqrt\(10\)": "√10",
    r"\bsqrt\(": "√(",
    r"\bv\^n\b": "<i>v</i><sup><i>n</i></sup>",
    r"(\d)e(-?)0*(\d+)\b": r"\1×10<sup>\2\3</sup>",
    r"-&gt;": "→",
}


def symbols(words: str) -> Html:
    """Words for HTML, with the paper's symbols set as it sets them.

    >>> symbols("v_norm < 2 %")
    '<i>v</i><sub>norm</sub> &lt; 2&nbsp;%'
    """
    found = str(pages.text(words))
    for pattern, put in _SYMBOLS.items():
        found = re.sub(pattern, put, found)
    return Html(found.replace("1×10", "10"))


def _math(source: str) -> str:
    """MathML from symbols separated by spaces.

    ``{ a } / { b }`` is a fraction, and ``x_0^2`` has an index and a power.
    """
    tokens = source.split()

    def row() -> str:
        parts: list[str] = []
        while tokens and tokens[0] != "}":
            word = tokens.pop(0)
            if word == "{":
                parts.append(f"<mrow>{row()}</mrow>")
                tokens.pop(0)
            elif word == "/":
                above = parts.pop()
                tokens.pop(0)
                parts.append(f"<mfrac>{above}<mrow>{row()}</mrow></mfrac>")
                tokens.pop(0)
            else:
                parts.append(_letter(word))
        return "".join(parts)

    return f'<math display="block"><mrow>{row()}</mrow></math>\n'


def _letter(word: str) -> str:
    """A name, number or sign, with an index and a power."""
    found = re.fullmatch(r"(.[^_^]*)(?:_([^^]+))?(?:\^(.+))?", word)
    base, index, power = found.groups() if found else (word, None, None)
    parts = [(base, ""), (index, "sub"), (power, "sup")]
    kind = "".join(name for part, name in parts if part)
    inner = "".join(
        f"<{tag}>{part}</{tag}>"
        for part, _ in parts
        if part
        for tag in (
            "mn" if part[0].isdigit() else "mi" if part[0].isalpha() and part != "ln" else "mo",
        )
    )
    return f"<m{kind}>{inner}</m{kind}>" if kind else inner


EQUATIONS = {
    "motion": "v^2 = { v_0^2 cos^2 α_0 } / { cos^2 α ( 1 − { v_0^2 } / { v_lim^2 } cos^2 α_0 "
    "[ ln tan ( { α } / { 2 } + { π } / { 4 } ) + { sin α } / { cos^2 α } ]_α0^α ) } , (13)",
    "distance": "v_norm = { v_0 } / { v_lim } , d_norm = { d } / { d_ref } , "
    "d_ref = { v_0^2 sin 2 α_0 } / { g } , (21)",
    "laws": "d_norm = ( 1 + { K^2 v_norm^2 } / { M } )^−M , (22)",
    "angle": "α_max = 45° ( 1 + { K^2 v_0^2 } / { M } )^−M",
}  # of the paper, at the head of its section


def _section_of(verdict: Verdict) -> str:
    place = "ref" if "ref" in verdict.place else verdict.place
    return next((key for key, _, start in SECTIONS if place.startswith(start)), "laws")


def _card(verdict: Verdict) -> Html:
    kind = {"not claimed": "open"}.get(verdict.outcome, verdict.outcome)
    return Html(
        f'<article class="claim {kind}" id="{verdict.id}">\n'
        f'<p><span class="outcome">{verdict.outcome}</span> '
        f'<span class="place">{symbols(verdict.place)}</span></p>\n'
        f'<p class="said">{symbols(verdict.claim)}.</p>\n'
        f"<p>Printed: {symbols(verdict.paper.rstrip('.'))}. {symbols(verdict.measured)}</p>\n"
        f'<p class="domain">{symbols(verdict.domain)}</p>\n</article>\n'
    )


def verdicts_html(verdicts: Iterable[Verdict]) -> Html:
    """The verdicts as HTML, one ``article`` for each, in their order."""
    return Html("".join(map(_card, verdicts)))


def _outcome_lines(verdicts: list[Verdict]) -> Iterator[str]:
    """Three lines: what fails, what holds, what is not claimed."""
    for outcome, word in OUTCOMES.items():
        group = [verdict for verdict in verdicts if verdict.holds is outcome]
        what = "not claimed, measured" if outcome is None else word[:-1] + "s" * (len(group) == 1)
        links = ""
        if outcome is False and group:
            named = "; ".join(f'<a href="#{v.id}">{symbols(v.claim)}</a>' for v in group)
            links = f": {named}"
        yield f'<li class="{word}"><strong>{len(group)}</strong> {what}{links}</li>\n'


def _page(contents: dict[str, bytes | str], verdicts: list[Verdict]) -> str:
    """The report as one HTML page that needs nothing from outside."""
    beside = {figure.beside: figure for figure in FIGURES}
    body = [
        f'<ul class="outcomes">\n{"".join(_outcome_lines(verdicts))}</ul>\n',
        "<p>Alexandre Vial's paper of 20 February 2008 gives the speed of a projectile under "
        "quadratic drag in closed form, and describes its distance by a fitted law. Each of its "
        "figures is drawn again here from exact values, and each of its claims is measured and "
        "judged; what it leaves open is measured and not judged.</p>\n",
        f"<p>Made by <code>{pages.text(made_by(COMMAND))}</code>.</p>\n",
        "<nav><h2>Contents</h2><ul>\n",
        *(f'<li><a href="#{key}">{pages.text(name)}</a></li>\n' for key, name, _ in SECTIONS),
        '<li><a href="#table-1">Table 1</a></li>\n<li><a href="#symbols">Symbols</a></li>\n',
        "</ul></nav>\n",
    ]
    for key, name, _ in SECTIONS:
        body.append(f'<h2 id="{key}">{pages.text(name)}</h2>\n{_math(EQUATIONS.get(key, ""))}')
        for verdict in (each for each in verdicts if _section_of(each) == key):
            body.append(_card(verdict))
            if figure := beside.pop(verdict.id, None):
                body.append(_figure(figure, contents))
        if key == "laws":
            body.append(_table_1())
    body += [_figure(figure, contents) for figure in beside.values()]
    words = (
        "v0 and alpha0 are the speed and the slope at launch, v_lim the terminal speed of fall; "
        "alpha_s is the slope at the landing, d the distance on level ground, d_ref the same "
        "without drag. Numbers in parentheses are the paper's equations; (16) is the motion in "
        "time, integrated numerically."
    )
    body.append(f'<h2 id="symbols">Symbols</h2>\n<p>{symbols(words)}</p>\n')
    return pages.page(TITLE, "".join(body), style=STYLE)


def _figure(figure: _Figure, contents: dict[str, bytes | str]) -> Html:
    return pages.figure(
        figure.name, contents[f"{figure.name}.png"], symbols(figure.caption), figure.alt
    )


def _table_1() -> str:
    fits = [fit for _, fit in _fits()[:2]]
    rows = []
    for i, name in enumerate(NAMES):
        letter, index = name.split("_a")
        cells = [f"{PRINTED[i]:g}"]
        for fit in fits:
            cells += [f"{fit.coefficients[i]:.6f}", f"{100 * fit.off[i]:+.3f} %"]
        rows.append((Html(f"{letter}, a<sub>{index}</sub>"), *cells))
    heads = ("", "printed", "0.01 rad", "off", "0.01°", "off")
    caption = "K and M, alpha0 in radians: printed, and fitted with Newton stopped at either step."
    table = pages.table(caption, heads, rows)
    return f'<h3 id="table-1">Table 1</h3>\n<div class="wide">{table}</div>\n'
