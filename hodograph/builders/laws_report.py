"""The folder that ``hodograph fit`` writes: the laws fitted again, and all laws compared."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Callable, Iterable
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

from hodograph._files import check_targets, write_whole
from hodograph.builders import law_fits as fit
from hodograph.builders.formula_comparison import LAUNCHES, Compared, compare
from hodograph.builders.law_fits import LawFit, fit_all
from hodograph.paper import figures
from hodograph.paper.search import Conditioning, Found, conditioning, search

COMMAND = "hodograph fit --out data/laws --force"
TABLES = ("coefficients.csv", "formulas.csv", "table_1_search.csv")
FIGURES = ("formulas", "table_1_error")


class Book(NamedTuple):
    """What `remake` computed."""

    fits: list[LawFit]
    compared: list[Compared]
    found: list[Found]
    conditioning: Conditioning


def remake(
    out: str | os.PathLike[str],
    *,
    force: bool = False,
    progress: Callable[[str], None] = lambda message: None,
) -> Book:
    """Fit the library's laws again, compare all formulas, and search for the origin of Table 1.

    Writes ``coefficients.csv``, ``formulas.csv``, ``table_1_search.csv``, and the figures
    ``formulas`` and ``table_1_error`` as ``.png`` and ``.pdf``, each whole, once all is computed.

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
    Book
        What was computed.

    Raises
    ------
    OSError
        The folder cannot be written, or, as `FileExistsError`, it holds one of the files already.
        Both are found out before the computation.
    """
    folder = Path(out)
    names = (*TABLES, *(f"{name}.{kind}" for name in FIGURES for kind in ("png", "pdf")))
    check_targets(*(folder / name for name in names), force=force)
    progress("the library's laws, fitted")
    fits = fit_all()
    progress("formulas compared")
    compared = compare()
    progress("Table 1, fitted in every plausible way")
    book = Book(fits, compared, search(), conditioning())
    progress("figures")
    drawn = {
        "formulas": figures.figure_formulas(compared),
        "table_1_error": figures.figure_table_1_error(),
    }
    contents: dict[str, bytes | str] = {
        "coefficients.csv": _coefficients(fits),
        "formulas.csv": _formulas(compared),
        "table_1_search.csv": _search(book),
    }
    for name, figure in drawn.items():
        contents[f"{name}.png"] = figures.png(figure)
        contents[f"{name}.pdf"] = figures.pdf(figure)
    progress("writing")
    for name, content in contents.items():
        write_whole(folder / name, content, force=force)
    return book


def summary(book: Book) -> str:
    """The formulas compared, as plain text.

    Parameters
    ----------
    book : Book
        From `remake`.

    Returns
    -------
    str
        A table, and a line for each fitted law.
    """
    lines = [
        "largest relative error           v<=1.5    10-80 deg     v<=1e6  numbers  length  ns/call"
    ]
    for row in book.compared:
        lines.append(
            f"{row.formula.name:<28}{row.domain:>11.2e}{row.inner:>13.2e}{row.far:>11.2e}"
            f"{row.formula.numbers:>9}{row.length:>8}{row.nanoseconds:>9.0f}"
        )
    lines.append("")
    for law in book.fits:
        same = "as written in laws" if law.coefficients == fit.WRITTEN[law.name] else "NEW"
        lines.append(f"{law.name}: {', '.join(f'{c:g}' for c in law.coefficients)} ({same})")
    near = book.found[0]
    lines.append(
        f"Table 1: nearest is {near.variant}, {near.low_deg} to {near.high_deg} deg, v_norm to "
        f"{near.v_max:g}: all seven within {100 * near.worst:.2f} %"
    )
    return "\n".join(lines)


def _csv(about: Iterable[str], heads: Iterable[str], rows: Iterable[Iterable[object]]) -> str:
    stream = io.StringIO()
    lines = (*about, f"hodograph {version('hodograph')}; remade by: {COMMAND}")
    stream.writelines(f"# {line}\n" for line in lines)
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(heads)
    writer.writerows(rows)
    return stream.getvalue()


def _coefficients(fits: list[LawFit]) -> str:
    about = (
        "Coefficients of the laws in hodograph.laws, in the order of the formulas there",
        "unrounded: of the least largest relative error; worst: that error with the coefficients,",
        "on the points of the fit (alpha_max_law: v_norm to 10)",
    )
    rows = [
        (law.name, i, repr(short), f"{full:.6g}", f"{law.worst:.3e}")
        for law in fits
        for i, (short, full) in enumerate(zip(law.coefficients, law.unrounded, strict=True))
    ]
    return _csv(about, ("law", "index", "coefficient", "unrounded", "worst"), rows)


def _formulas(compared: list[Compared]) -> str:
    about = (
        "Formulas for d_norm; largest relative error for v_norm to 1.5 and 0 to 90 degrees, the",
        "same for 10 to 80 degrees, and for v_norm to 1e6; judged on points of no fit",
        f"ns: nanoseconds per launch in arrays of {LAUNCHES}, on the machine that wrote this",
        "v is v_norm, a alpha0 in radians, S and C its sine and cosine; length in characters",
    )
    rows = [
        (
            row.formula.name,
            row.formula.numbers,
            row.length,
            f"{row.domain:.3g}",
            f"{row.inner:.3g}",
            f"{row.far:.3g}",
            f"{row.nanoseconds:.0f}",
            row.formula.source,
            row.formula.text,
        )
        for row in compared
    ]
    heads = ("name", "numbers", "length", "error", "error_10_80", "error_all_v", "ns", "source")
    return _csv(about, (*heads, "formula"), rows)


def _search(book: Book) -> str:
    near = book.conditioning
    about = (
        "Table 1 of Vial 2008 fitted in several ways; for each, the window that comes nearest to",
        "print, and there the relative difference of each coefficient",
        f"K's cubic on 9 to 80 degrees: condition number {near.condition:.0f}; an end of the",
        "window moved by 1 degree changes a0..a3 by up to "
        + ", ".join(f"{100 * x:.1f} %" for x in near.one_degree)
        + f", and K itself by {100 * near.curve:.2f} %",
    )
    names = ("K_a0", "K_a1", "K_a2", "K_a3", "M_a0", "M_a1", "M_a2")
    heads = ("variant", "v_norm_max", "alpha0_min_deg", "alpha0_max_deg", "worst", *names)
    rows = [
        (
            found.variant,
            found.v_max,
            found.low_deg,
            found.high_deg,
            f"{found.worst:.4f}",
            *(f"{off:+.4f}" for off in found.off),
        )
        for found in book.found
    ]
    return _csv(about, heads, rows)
