"""What ``hodograph fit`` writes of the laws: fitted again, and all formulas compared."""

import logging
from typing import NamedTuple

from hodograph.builders import laws_figures
from hodograph.builders.formula_comparison import LAUNCHES, Compared, compare
from hodograph.builders.law_fits import WRITTEN, LawFit, fit_all
from hodograph.report import style, tables

log = logging.getLogger("hodograph")
COMMAND = "hodograph fit --out data/laws --force"
COEFFICIENTS, FORMULAS = "coefficients.csv", "formulas.csv"
FIGURES = ("formulas", "table_1_error")
FILES = (COEFFICIENTS, FORMULAS, *(f"{name}.{kind}" for name in FIGURES for kind in ("png", "pdf")))


class Book(NamedTuple):
    """The laws fitted again, and all formulas measured."""

    fits: list[LawFit]
    compared: list[Compared]


def make() -> Book:
    """Fit the library's laws again, and compare all formulas."""
    log.info("the library's laws, fitted")
    fits = fit_all()
    log.info("formulas compared")
    return Book(fits, compare())


def contents(book: Book) -> dict[str, bytes | str]:
    """What goes into each of `FILES`."""
    log.info("figures")
    drawn = (laws_figures.formulas(book.compared), laws_figures.table_1_error())
    found: dict[str, bytes | str] = {
        COEFFICIENTS: _coefficients(book.fits),
        FORMULAS: _formulas(book.compared),
    }
    for name, figure in zip(FIGURES, drawn, strict=True):
        found |= style.files(name, figure)
    return found


def summary(book: Book) -> str:
    """The formulas compared, and a line for each fitted law, as plain text."""
    errors = ("v<=1.5", "10-80 deg", "sqrt(10)", "v<=1e6")
    rows = [
        (
            row.formula.name,
            *(f"{error:.2e}" for error in (row.domain, row.inner, row.legendre, row.far)),
            str(row.formula.numbers),
            str(row.length),
            f"{row.nanoseconds:.0f}",
        )
        for row in book.compared
    ]
    lines = [
        *tables.plain(("largest relative error", *errors, "numbers", "length", "ns/call"), rows),
        "",
    ]
    for law in book.fits:
        same = "as written in laws" if law.coefficients == WRITTEN[law.name] else "NEW"
        lines.append(f"{law.name}: {', '.join(f'{c:g}' for c in law.coefficients)} ({same})")
    return "\n".join(lines)


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
    heads = ("law", "index", "coefficient", "unrounded", "worst")
    return tables.csv_text(about, heads, rows, command=COMMAND)


def _formulas(compared: list[Compared]) -> str:
    about = (
        "Formulas for d_norm; largest relative error for v_norm to 1.5 and 0 to 90 degrees, the",
        "same for 10 to 80 degrees, for Legendre's v_norm = sqrt(10) there, and for v_norm to 1e6;",
        "judged on points of no fit",
        f"ns: nanoseconds per launch in arrays of {LAUNCHES}, on the machine that wrote this",
        "v is v_norm, a alpha0 in radians, S and C its sine and cosine; length in characters",
    )
    rows = [
        (
            row.formula.name,
            row.formula.numbers,
            row.length,
            *(f"{error:.3g}" for error in (row.domain, row.inner, row.legendre, row.far)),
            f"{row.nanoseconds:.0f}",
            row.formula.source,
            row.formula.text,
        )
        for row in compared
    ]
    errors = ("error", "error_10_80", "error_sqrt_10", "error_all_v")
    heads = ("name", "numbers", "length", *errors, "ns", "source", "formula")
    return tables.csv_text(about, heads, rows, command=COMMAND)
