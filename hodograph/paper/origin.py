"""Where Table 1 may come from: what `search` found, as a file and in a line."""

from __future__ import annotations

import logging
from typing import NamedTuple

from hodograph.paper.search import Conditioning, Found, conditioning, search
from hodograph.report import tables

FILE = "table_1_search.csv"
COMMAND = "hodograph fit --out data/laws --force"


class Origin(NamedTuple):
    """The nearest window of every way to fit, nearest first; and how well it is determined."""

    found: list[Found]
    conditioning: Conditioning


def trace() -> Origin:
    """Fit Table 1 in every plausible way; some seconds."""
    logging.getLogger("hodograph").info("Table 1, fitted in every plausible way")
    return Origin(search(), conditioning())


def csv_text(origin: Origin) -> str:
    """The content of `FILE`."""
    near = origin.conditioning
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
        for found in origin.found
    ]
    return tables.csv_text(about, heads, rows, command=COMMAND)


def summary(origin: Origin) -> str:
    """The nearest of all, in a line."""
    near = origin.found[0]
    return (
        f"Table 1: nearest is {near.variant}, {near.low_deg} to {near.high_deg} deg, v_norm to "
        f"{near.v_max:g}: all seven within {100 * near.worst:.2f} %"
    )
