"""Maps of the relative error of d_norm over (v_norm, alpha0), one for each way to compute it."""

import logging
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import mpmath
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, LogLocator

from hodograph import reference
from hodograph.bench import methods
from hodograph.engine.domain import FloatArray
from hodograph.level import d_norm
from hodograph.report import folder, style, tables
from hodograph.report.style import GREY, TEXT

log = logging.getLogger("hodograph")
COMMAND = "hodograph bench stability"
FILES = ("stability.png", "stability.pdf", "stability.csv")
DIGITS = 20
RIGHT = 90.0  # degrees
WRONG = 1e-2  # an error that nobody would accept


class Method(NamedTuple):
    """A way to d_norm: its column in the CSV, its title on the map, and the function."""

    name: str
    title: str
    compute: Callable[[float, float], Any]


METHODS = (
    Method("hodograph", "hodograph", d_norm),
    Method("paper", "the paper's route: Newton in α, quad", methods.by_paper),
    Method("fixed_nodes", "64 fixed Gauss-Legendre nodes in α", methods.by_fixed_nodes),
    Method("solve_ivp", "solve_ivp 1e-10, event y = 0", methods.by_solve_ivp),
    Method("ode", "hodograph.ode 1e-10, landing polished", methods.by_ode),
)


def two_sided(low_deg: float, number: int) -> FloatArray:
    """Angles in degrees from `low_deg` to 90 - `low_deg`, as dense at either end.

    They are evenly spaced in ln(alpha / (90 - alpha)); an odd `number` has 45 among them.

    >>> two_sided(0.01, 5).round(3).tolist()
    [0.01, 0.939, 45.0, 89.061, 89.99]
    """
    end = _logit(low_deg)
    below = RIGHT / (1 + np.exp(-np.linspace(end, 0.0, (number + 1) // 2)))
    return np.concatenate([below, (RIGHT - below[: number // 2])[::-1]])


def _logit(degrees: Any) -> Any:
    return np.log(degrees / (RIGHT - degrees))


V_NORM = np.logspace(-3, 4, 29)
ALPHA0_DEG = two_sided(0.01, 29)


@dataclass(frozen=True, eq=False)
class Maps:
    """Relative errors over a grid; arrays of shape (alpha0, v_norm), NaN where a method failed."""

    v_norm: FloatArray
    alpha0_deg: FloatArray
    d_norm: FloatArray
    errors: dict[str, FloatArray]  # by `Method.name`


def measure(v_norm: FloatArray = V_NORM, alpha0_deg: FloatArray = ALPHA0_DEG) -> Maps:
    """The errors of every method on a grid, against mpmath; the angles are in degrees."""
    shape = (len(alpha0_deg), len(v_norm))
    truth, errors = np.empty(shape), {method.name: np.empty(shape) for method in METHODS}
    for row, alpha0 in enumerate(np.deg2rad(alpha0_deg)):
        for column, v in enumerate(v_norm):
            launch = float(v), float(alpha0)
            exact = reference.d_norm(*launch, dps=DIGITS)
            truth[row, column] = exact
            for method in METHODS:
                # the difference is taken in mpmath, or the truth would be rounded first
                found = mpmath.mpf(float(method.compute(*launch)))
                errors[method.name][row, column] = abs((found - exact) / exact)
        if (row + 1) % 4 == 0 or row + 1 == shape[0]:
            log.info(f"angle {row + 1} of {shape[0]}")
    return Maps(np.asarray(v_norm), np.asarray(alpha0_deg), truth, errors)


# --- the table ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Summary:
    """One method's map in numbers: quantiles over the points where it gave an answer.

    `wrong` is the share of all points where the answer given is off by more than 1 %.
    """

    name: str
    median: float
    nine_tenths: float
    largest: float
    v_norm: float
    alpha0_deg: float
    wrong: float
    failed: float


def summaries(maps: Maps) -> list[Summary]:
    """One `Summary` for each method, in the order of `METHODS`."""
    found = []
    for name, error in maps.errors.items():
        given = error[np.isfinite(error)]
        median, nine_tenths, largest, v, alpha0_deg = (np.nan,) * 5
        if given.size:
            median, nine_tenths, largest = np.quantile(given, [0.5, 0.9, 1.0]).tolist()
            row, column = np.unravel_index(np.nanargmax(error), error.shape)
            v, alpha0_deg = float(maps.v_norm[column]), float(maps.alpha0_deg[row])
        wrong, failed = float(np.mean(error > WRONG)), float(np.mean(np.isnan(error)))
        found.append(Summary(name, median, nine_tenths, largest, v, alpha0_deg, wrong, failed))
    return found


def summary_table(maps: Maps) -> str:
    """The summaries as plain text, and below them what the columns are."""
    heads = ("method", "median", "90 %", "max", "at v_norm, alpha0", "off > 1 %", "failed")
    rows = [
        (
            method.title,
            *(f"{error:.1e}" for error in (line.median, line.nine_tenths, line.largest)),
            f"{line.v_norm:.3g}, {line.alpha0_deg:.4g} deg",
            *(f"{share:.1%}" for share in (line.wrong, line.failed)),
        )
        for method, line in zip(METHODS, summaries(maps), strict=True)
    ]
    lines = [
        f"Relative error of d_norm at {maps.d_norm.size} points: "
        f"v_norm {maps.v_norm[0]:g} to {maps.v_norm[-1]:g}, "
        f"alpha0 {maps.alpha0_deg[0]:g} to {maps.alpha0_deg[-1]:g} degrees",
        "",
        *tables.plain(heads, rows, left=(0, 4)),
    ]
    lines += [
        "",
        "Quantiles are over the answers given; 'off > 1 %' counts answers given that are off by",
        "more than that, 'failed' where a method gave none. The fixed nodes have the exact landing",
        "angle. Truth: mpmath at 20 digits.",
    ]
    return "\n".join(lines) + "\n"


def csv_text(maps: Maps) -> str:
    """The maps as CSV: one row a point, the error of each method, ``nan`` where it failed."""
    about = (
        "relative errors of d_norm, by method",
        f"truth: mpmath at {DIGITS} digits; nan: the method failed",
    )
    rows = (
        (
            float(v),
            float(alpha0_deg),
            float(maps.d_norm[row, column]),
            *(f"{error[row, column]:.3e}" for error in maps.errors.values()),
        )
        for row, alpha0_deg in enumerate(maps.alpha0_deg)
        for column, v in enumerate(maps.v_norm)
    )
    heads = ("v_norm", "alpha0_deg", "d_norm", *maps.errors)
    return tables.csv_text(about, heads, rows, command=COMMAND)


# --- the figure ---------------------------------------------------------------------------

WIDTH, HEIGHT, DPI = 25, 15.5, 150  # cm, cm, dots an inch
SCALE, COLOURS = LogNorm(1e-16, 1.0), "viridis"
SHADE, STROKE, HATCH = "#e5e7eb", GREY, "////"  # where there is no answer
ANGLES = {0.01: "0.01°", 0.1: "0.1°", 1: "1°", 10: "10°", 45: "45°", 80: "80°", 89: "89°",
          89.9: "89.9°", 89.99: "89.99°"}  # fmt: skip


def figure(maps: Maps) -> Figure:
    """The maps side by side, on common axes and one logarithmic colour scale."""
    drawn = style.new_figure(HEIGHT, WIDTH)
    cells = drawn.subplots(2, 3, sharex=True, sharey=True)
    x, y = np.exp(_edges(np.log(maps.v_norm))), _edges(_logit(maps.alpha0_deg))
    for axes, method, line in zip(cells.flat, METHODS, summaries(maps), strict=False):
        axes.patch.set(facecolor=SHADE, edgecolor=STROKE, hatch=HATCH, linewidth=0)  # shows through
        error = np.ma.masked_invalid(np.clip(maps.errors[method.name], SCALE.vmin, SCALE.vmax))
        axes.pcolormesh(x, y, error, norm=SCALE, cmap=COLOURS, rasterized=True)
        axes.set_title(
            f"{method.title}\nmedian {line.median:.1g}, max {line.largest:.1g}", fontsize=TEXT
        )
        axes.tick_params(labelsize=TEXT)
        axes.set(xscale="log", xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
        axes.xaxis.set_major_locator(LogLocator(10, numticks=9))
        shown = [angle for angle in ANGLES if y[0] <= _logit(angle) <= y[-1]]
        axes.yaxis.set_major_locator(FixedLocator([float(_logit(angle)) for angle in shown]))
        axes.set_yticklabels([ANGLES[angle] for angle in shown])
    key = cells.flat[len(METHODS)]
    key.remove()
    for axes in cells[:, 0]:
        axes.set_ylabel("launch angle alpha0", fontsize=TEXT)
    for axes in (*cells[1, :2], cells[0, 2]):
        axes.set_xlabel("v_norm = v0 / v_lim", fontsize=TEXT)
        axes.tick_params(labelbottom=True)
    blank = drawn.add_subplot(2, 3, 6)
    blank.set_axis_off()
    bar = drawn.colorbar(
        ScalarMappable(SCALE, COLOURS),
        cax=blank.inset_axes((0.05, 0.62, 0.9, 0.09)),
        orientation="horizontal",
        extend="both",
    )
    bar.set_label("relative error of d_norm", fontsize=TEXT)
    bar.ax.tick_params(labelsize=TEXT)
    bar.set_ticks([10.0**power for power in range(-16, 1, 4)])
    empty = Patch(facecolor=SHADE, edgecolor=STROKE, hatch=HATCH, linewidth=0)
    style.legend(blank, handles=[empty], labels=["failed: no answer"], loc=(0.02, 0.25))
    return drawn


def _edges(centres: FloatArray) -> FloatArray:
    """Edges of the cells round their centres."""
    middle = (centres[1:] + centres[:-1]) / 2
    ends = 2 * centres[[0, -1]] - middle[[0, -1]]
    return np.concatenate([ends[:1], middle, ends[1:]])


def bench(
    out: str | os.PathLike[str],
    *,
    v_norm: FloatArray = V_NORM,
    alpha0_deg: FloatArray = ALPHA0_DEG,
    force: bool = False,
) -> Maps:
    """Measure, and write `FILES` into the folder `out`; a minute or so.

    Raises `OSError` before the computation where the files could not be written after it: as
    `FileExistsError` if one is there, unless `force`.
    """
    folder.check(out, FILES, force=force)
    maps = measure(v_norm, alpha0_deg)
    contents = style.files("stability", figure(maps), dpi=DPI)
    for path in folder.write(out, {**contents, "stability.csv": csv_text(maps)}, force=force):
        log.info(f"wrote {path}")
    return maps
