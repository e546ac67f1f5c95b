"""Figures held to bounds: met, missed, or not measured."""

import math
import platform
from collections.abc import Iterable
from dataclasses import dataclass

from hodograph.bench import measurement
from hodograph.bench.measurement import Sizes
from hodograph.report import tables
from hodograph.report.versions import versions


@dataclass(frozen=True)
class Target:
    """A figure, the bound it is held to, and whether it keeps it: None if it was not measured."""

    what: str
    bound: str
    measured: str
    met: bool | None


def at_most(what: str, bound: float, value: float) -> Target:
    """A figure that is not to be above its bound; NaN: it was not measured."""
    met = None if math.isnan(value) else value <= bound
    return Target(what, f"<= {bound:g}", _figure(value), met)


def at_least(what: str, bound: float, value: float) -> Target:
    """A figure that is not to be below its bound; NaN: it was not measured."""
    met = None if math.isnan(value) else value >= bound
    return Target(what, f">= {bound:g}", _figure(value), met)


def _figure(value: float) -> str:
    if math.isnan(value):
        return "-"
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def lines(targets: Iterable[Target]) -> list[str]:
    """The targets as the lines of a table."""
    verdicts = {True: "met", False: "missed", None: "not measured"}
    rows = [(one.what, one.bound, one.measured, verdicts[one.met]) for one in targets]
    return tables.plain(("target", "bound", "measured", ""), rows, left=(0, 3))


def comments(targets: Iterable[Target]) -> str:
    """The targets as comments at the end of a CSV file."""
    return "".join(
        f"# target: {one.what} {one.bound}; measured {one.measured}\n" for one in targets
    )


def conditions(sizes: Sizes, *, core: bool) -> str:
    """What measured, on what, and how often."""
    where = "one core" if core else "not held to one core"
    return (
        f"{versions(*measurement.PACKAGES)}; {platform.system()} {platform.machine()}, {where}; "
        f"{sizes.rounds} rounds; errors over {sizes.checked} launches"
    )
