"""Two figures of laws judged: the formulas side by side, and the error of the paper's law."""

import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from hodograph import laws
from hodograph.builders.formula_comparison import V_MAX, Compared
from hodograph.level import d_norm
from hodograph.report.style import BLUE, GREY, RED, TEXT, dress, legend, note, one_panel


def table_1_error() -> Figure:
    """Relative error of the paper's law (eq. 22 with Table 1) over v_norm and alpha0.

    The region where it stays within the 0.2 % that the paper states is outlined, and the paper's
    domain, v_norm up to 1.5, is marked.

    >>> len(table_1_error().axes)  # the map and its colour bar
    2
    """
    v, degrees = np.linspace(0, 3, 151)[1:], np.linspace(0, 90, 181)[1:]
    alpha0 = np.deg2rad(degrees)
    off = 100 * (laws.table_1(v[:, np.newaxis], alpha0) / d_norm(v[:, np.newaxis], alpha0) - 1).T
    levels = [-20, -10, -5, -2, -1, -0.5, -0.2, 0.2, 0.5, 1, 2, 5, 10, 20]
    figure, axes = one_panel(10.0)
    norm = BoundaryNorm(levels, 256, extend="both")
    filled = axes.contourf(v, degrees, off, levels, cmap="RdBu_r", norm=norm, extend="both")
    axes.contour(v, degrees, np.abs(off), [0.2], colors="black", linewidths=1.1)
    axes.axvline(V_MAX, color="black", linewidth=0.9, linestyle="--")
    axes.text(
        V_MAX - 0.02, 40, "paper's limit", fontsize=TEXT, rotation=90, ha="right", va="center"
    )
    bar = figure.colorbar(filled, ax=axes, ticks=levels, pad=0.02)
    bar.ax.set_yticklabels([f"{level:g}" for level in levels])
    bar.set_label("error of Table 1 (%); outlined: within 0.2 %", fontsize=TEXT + 1)
    bar.ax.tick_params(labelsize=TEXT)
    axes.set_yticks(range(0, 91, 15))
    dress(axes, r"$v_\mathrm{norm} = v_0 / v_\mathrm{lim}$", r"$\alpha_0$ (degrees)", grid=False)
    return figure


def formulas(rows: list[Compared]) -> Figure:
    """Error of each formula for d_norm on the paper's domain against its length."""
    figure, axes = one_panel(9.0)
    for row in rows:
        color = BLUE if row.formula.source == "this library" else RED
        ends = 100 * row.domain, 100 * row.inner
        axes.plot([row.length] * 2, ends, color=color, lw=0.8)
        for error, fill in zip(ends, ("full", "none"), strict=True):
            axes.plot(row.length, error, "o", color=color, ms=6, fillstyle=fill, zorder=3)
        right = row.length > 120 or row.length < 40
        name, at = f"{row.formula.name} ({row.formula.numbers})", (row.length, 100 * row.domain)
        place = ((-8, 0), "right") if right else ((8, 0), "left")
        note(axes, name, at, place[0], fontsize=TEXT - 1, va="center", ha=place[1])
    axes.set_yscale("log")
    axes.set_xlim(0, 160)
    axes.set_ylim(3e-3, 1e3)
    axes.plot([], [], "o", color=GREY, label=r"$v_\mathrm{norm} \leq 1.5$, 0° to 90°")
    axes.plot([], [], "o", color=GREY, fillstyle="none", label="10° to 80°")
    legend(axes, loc="lower left")
    dress(
        axes,
        "length of the formula (characters); in parentheses, its fitted numbers",
        "largest relative error (%)",
    )
    return figure
