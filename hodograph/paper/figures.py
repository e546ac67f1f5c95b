"""The six figures of the paper, and two of laws judged: one function a figure.

Each returns a `matplotlib.figure.Figure` of its own, 16 cm wide, that no window or global state
knows of: save it with ``figure.savefig(path)``, or show it by naming it in a notebook.
"""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc
from numpy.polynomial import Polynomial

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.grid import tabulate
from hodograph.launch import Launch
from hodograph.level import d_norm, d_ref, optimal_angle
from hodograph.paper.refit import V_LIM, Refit, Table1, refit_table_1, v_axis
from hodograph.path import position, speed

WIDTH = 16 / 2.54  # inches
TEXT = 9  # points
BLUE, RED, GREEN, GREY = "#0b5394", "#b45309", "#15803d", "#6b7280"
LINE = 1.4
DPI = 200


def png(figure: Figure, *, dpi: float = DPI) -> bytes:
    """The figure as PNG, the same bytes for the same figure drawn afresh.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The figure.
    dpi : float, optional
        Dots an inch.

    Returns
    -------
    bytes
        The content of the file.

    Examples
    --------
    >>> png(figure_2())[1:4]
    b'PNG'
    """
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=dpi, metadata={"Software": None})
    return stream.getvalue()


def pdf(figure: Figure) -> bytes:
    """The figure as PDF, without a date in it.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The figure.

    Returns
    -------
    bytes
        The content of the file.

    Examples
    --------
    >>> pdf(figure_2())[:4]
    b'%PDF'
    """
    stream = io.BytesIO()
    nothing = dict.fromkeys(("CreationDate", "Creator", "Producer"))
    figure.savefig(stream, format="pdf", metadata=nothing)
    return stream.getvalue()


def new_figure(height_cm: float) -> Figure:
    """An empty figure of page width."""
    return Figure(figsize=(WIDTH, height_cm / 2.54), layout="constrained")


def dress(axes: Any, xlabel: str, ylabel: str, *, grid: bool = True) -> None:
    """Label the axes in the size of all figures, with a light grid or a frame."""
    axes.set_xlabel(xlabel, fontsize=TEXT + 1)
    axes.set_ylabel(ylabel, fontsize=TEXT + 1)
    axes.tick_params(labelsize=TEXT)
    if grid:
        axes.grid(color="#e5e7eb", linewidth=0.6)
        axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(not grid)


def figure_1() -> Figure:
    """The trajectory and the Frenet frame: T, N, the velocity, and the two forces.

    A launch at v_norm = 1.5 and 60 degrees, drawn to scale; the frame is where the path still
    climbs at 50 degrees.  Weight and drag share a scale.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> len(figure_1().axes)
    1
    """
    v_norm, alpha0, alpha = 1.5, np.deg2rad(60), np.deg2rad(50)
    path = Launch(v_norm, alpha0, 1.0, g=1.0).trajectory(300)
    x, y, _ = position(v_norm, alpha0, alpha)
    v = speed(v_norm, alpha0, alpha)
    T = np.array([np.cos(alpha), np.sin(alpha)])
    N = np.array([np.sin(alpha), -np.cos(alpha)])  # to the centre of curvature

    figure = new_figure(10.5)
    axes = figure.add_subplot()
    axes.plot(path.x, path.y, color=GREY, linewidth=LINE, zorder=1)

    def arrow(start: FloatArray, along: FloatArray, color: str, width: float = 1.8) -> None:
        style = {"arrowstyle": "-|>", "color": color, "linewidth": width, "mutation_scale": 12}
        style |= {"shrinkA": 0, "shrinkB": 0}
        axes.annotate("", xy=tuple(start + along), xytext=tuple(start), arrowprops=style)

    def label(text: str, at: FloatArray, dx: float, dy: float, color: str = "black") -> None:
        axes.text(
            at[0] + dx, at[1] + dy, text, color=color, fontsize=TEXT + 2, ha="center", va="center"
        )

    here, origin = np.array([x, y]), np.zeros(2)
    weight, drag = np.array([0.0, -0.2]), -0.2 * v * v * T
    launch = 0.15 * v_norm * np.array([np.cos(alpha0), np.sin(alpha0)])
    arrow(here, 0.35 * v * T, BLUE)
    arrow(here, 0.12 * T, "black", 2.4)
    arrow(here, 0.12 * N, "black", 2.4)
    arrow(here, weight, RED)
    arrow(here, drag, GREEN)
    arrow(origin, launch, BLUE)
    label(r"$\mathbf{v}$", here + 0.35 * v * T, 0.025, 0.01, BLUE)
    label(r"$\mathbf{T}$", here + 0.12 * T, -0.022, 0.022)
    label(r"$\mathbf{N}$", here + 0.12 * N, 0.03, -0.005)
    label(r"$m\mathbf{g}$", here + weight, 0.0, -0.025, RED)
    label(r"$-\lambda v^2\,\mathbf{T}$", here + drag, -0.07, 0.03, GREEN)
    label(r"$\mathbf{v}_0$", launch, -0.035, -0.01, BLUE)
    label("M", here, -0.03, 0.012)
    axes.plot(*here, "o", color="black", markersize=4)

    for start, angle, text in ((origin, alpha0, r"$\alpha_0$"), (here, alpha, r"$\alpha$")):
        size = 0.16
        axes.add_patch(Arc(tuple(start), size, size, theta2=np.rad2deg(angle), color=GREY))
        middle = (size / 2 + 0.03) * np.array([np.cos(angle / 3), np.sin(angle / 3)])
        label(text, start, *middle)
    axes.plot([x, x + 0.16], [y, y], color=GREY, linewidth=0.8, linestyle="--")
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_aspect("equal")
    axes.set_xlim(-0.06, 0.86)
    axes.set_ylim(-0.04, 0.56)
    dress(axes, r"$x\;/\;(v_\mathrm{lim}^2/g)$", r"$y\;/\;(v_\mathrm{lim}^2/g)$", grid=False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return figure


def figure_2() -> Figure:
    """A trajectory with and without drag: 45 degrees at v0 = v_lim = 42.7 m/s.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> figure_2().axes[0].get_xlabel()
    '$x$ (m)'
    """
    alpha0 = np.pi / 4
    figure = new_figure(5.4)
    axes = figure.add_subplot()
    for v_lim, color, name in ((np.inf, GREY, "without drag"), (V_LIM, BLUE, r"drag in $v^2$")):
        launch = Launch(V_LIM, alpha0, v_lim)
        path = launch.trajectory(300)
        style = "--" if color == GREY else "-"
        axes.plot(path.x, path.y, style, color=color, linewidth=LINE, label=name)
        axes.plot(path.x[-1], 0, "o", color=color, markersize=4, clip_on=False, zorder=3)
        top_x, top_y, _ = launch.apex()
        axes.plot(top_x, top_y, "o", color=color, markersize=4)
    d, reference = Launch(V_LIM, alpha0, V_LIM).range(), d_ref(V_LIM, alpha0)
    for at, text, color in ((d, "d", BLUE), (reference, r"d_\mathrm{ref}", GREY)):
        axes.annotate(
            f"${text} = {at:.1f}$ m",
            (at, 0),
            (8, 5),
            textcoords="offset points",
            fontsize=TEXT,
            color=color,
        )
    axes.legend(fontsize=TEXT, frameon=False)
    axes.set_aspect("equal")
    axes.set_xlim(0, 235)
    axes.set_ylim(0, 52)
    dress(axes, "$x$ (m)", "$y$ (m)")
    axes.set_title(
        rf"$v_0 = v_\mathrm{{lim}} = {V_LIM}$ m/s, $\alpha_0 = 45°$, $g = 9.81$ m/s²",
        fontsize=TEXT + 1,
    )
    return figure


def figure_3() -> Figure:
    """The normalised distance d_norm as a map over v_norm and alpha0.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> len(figure_3().axes)  # the map and its colour bar
    2
    """
    grid = tabulate()
    figure = new_figure(10.0)
    axes = figure.add_subplot()
    axis_v, axis_a, values = grid.v_norm, np.rad2deg(grid.alpha0), grid.d_norm.T
    levels = np.arange(7, 21) / 20
    filled = axes.contourf(axis_v, axis_a, values, levels=levels, cmap="viridis")

    def lines(levels: FloatArray) -> Any:
        colors = ["white" if level < 0.72 else "black" for level in levels]
        return axes.contour(axis_v, axis_a, values, levels=levels, colors=colors, linewidths=0.7)

    lines(levels[:-1:2])
    named, across = levels[1:-1:2], 60  # labels in a row, at one angle
    places = np.interp(named, values[across, ::-1], axis_v[::-1])
    axes.clabel(lines(named), fontsize=TEXT, fmt="%.1f", manual=[(v, across) for v in places])
    bar = figure.colorbar(filled, ax=axes, ticks=np.arange(4, 11) / 10, pad=0.02)
    bar.set_label(r"$d_\mathrm{norm} = d / d_\mathrm{ref}$", fontsize=TEXT + 1)
    bar.ax.tick_params(labelsize=TEXT)
    axes.set_yticks(range(0, 91, 15))
    dress(axes, r"$v_\mathrm{norm} = v_0 / v_\mathrm{lim}$", r"$\alpha_0$ (degrees)", grid=False)
    return figure


def figure_4() -> Figure:
    """d_norm at 45 degrees, the Pearson VII function fitted to it, and the residual below.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> len(figure_4().axes)
    2
    """
    v = v_axis()
    exact = d_norm(v, np.pi / 4)
    fit = laws.fit_pearson(v, exact)
    figure = new_figure(11.0)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2.4, 1))
    above.plot(v[::5], exact[::5], "o", color=BLUE, markersize=3.5, clip_on=False, label="exact")
    above.plot(
        v,
        laws.pearson_vii(v, fit.K, fit.M),
        color=RED,
        linewidth=LINE,
        label=rf"Pearson VII fit: $K = {fit.K:.4f}$, $M = {fit.M:.4f}$",
    )
    above.legend(fontsize=TEXT, frameon=False)
    below.plot(v, 100 * fit.residuals / exact, color=RED, linewidth=LINE, label="this fit")
    table = laws.table_1(v, np.pi / 4)
    below.plot(v, 100 * (table / exact - 1), "--", color=GREEN, linewidth=LINE, label="Table 1")
    below.axhline(0, color="black", linewidth=0.8)
    below.set_xlim(0, v[-1])
    below.set_ylim(-0.22, 0.35)
    below.legend(fontsize=TEXT, frameon=False, ncols=2, loc="upper center")
    dress(above, "", r"$d_\mathrm{norm}$ at $\alpha_0 = 45°$")
    dress(below, r"$v_\mathrm{norm}$", "deviation (%)")
    figure.align_ylabels()
    return figure


def figure_5(fits: Refit | None = None) -> Figure:
    """K and M against alpha0, with the polynomials of Table 1 and our own.

    Their relative deviations from the points are below, cut off at 3 %.

    Parameters
    ----------
    fits : refit.Refit, optional
        The fits to draw, from `refit.refit_table_1`; made afresh (some seconds) if left out.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    fits = refit_table_1() if fits is None else fits
    table = fits.table
    degrees = np.rad2deg(table.alpha0)
    fine = np.linspace(0, 90, 181)
    figure = new_figure(12.0)
    near, whole = fits.nearest, fits.whole
    panels = (
        ("K", table.K, laws.TABLE_1_K, whole.K, near.K, (0, 1)),
        ("M", table.M, laws.TABLE_1_M, whole.M, near.M, (0.65, 0.85)),
    )
    columns = figure.subplots(2, 2, sharex=True, height_ratios=(2, 1)).T
    for (axes, below), (name, points, printed, ours, nearest, limits) in zip(
        columns, panels, strict=True
    ):
        axes.plot(
            degrees[1::3],
            points[1::3],
            "o",
            color=BLUE,
            markersize=3.5,
            label=rf"eq. 22 fitted at each angle, $v_\mathrm{{norm}} \leq {table.v_max}$",
        )
        for coefficients, style, color, text in (
            (printed, "-", RED, "Table 1 of the paper"),
            (ours, "--", GREEN, _window(whole)),
            (nearest, ":", "black", _window(near)),
        ):
            curve = Polynomial(coefficients)
            axes.plot(fine, curve(np.deg2rad(fine)), style, color=color, lw=LINE, label=text)
            deviation = 100 * (curve(table.alpha0) / points - 1)
            below.plot(degrees, deviation, style, color=color, linewidth=LINE)
        below.axhline(0, color="black", linewidth=0.8)
        dress(axes, "", f"${name}$")
        dress(below, r"$\alpha_0$ (degrees)", "deviation (%)")
        axes.set_xlim(0, 90)
        axes.set_xticks(range(0, 91, 15))
        axes.set_ylim(*limits)
        below.set_ylim(-3.2, 3.2)
    figure.align_ylabels()
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside upper center", fontsize=TEXT, ncols=2, frameon=False
    )
    return figure


def _window(fit: Table1) -> str:
    return (
        f"our fit on {fit.low_deg}°-{fit.high_deg}°, "
        rf"$v_\mathrm{{norm}} \leq {fit.v_max}$"
    )


def figure_6() -> Figure:
    """The launch angle of greatest distance against v0 for a baseball, with the paper's law.

    The relative deviation of the law is below, with the bound that the paper states.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> figure_6().axes[1].get_xlabel()
    '$v_0$ (m/s)'
    """
    v = v_axis()
    v0 = v * V_LIM
    best, law = optimal_angle(v), laws.alpha_max_vial(v0)
    figure = new_figure(11.0)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2.4, 1))
    above.plot(
        v0[::5],
        np.rad2deg(best[::5]),
        "o",
        color=BLUE,
        markersize=3.5,
        clip_on=False,
        label="exact distances",
    )
    above.plot(
        v0,
        np.rad2deg(law),
        color=RED,
        linewidth=LINE,
        label="law of section 3.3",
    )
    above.legend(fontsize=TEXT, frameon=False)
    above.set_title(rf"$v_\mathrm{{lim}} = {V_LIM}$ m/s", fontsize=TEXT + 1)
    below.plot(v0, 100 * (law / best - 1), color=RED, linewidth=LINE)
    below.axhline(0, color="black", linewidth=0.8)
    for bound in (-0.08, 0.08):
        below.axhline(bound, color=GREY, linewidth=1, linestyle="--")
    below.text(1, 0.072, "bound stated: 0.08 %", fontsize=TEXT, color=GREY, va="top")
    below.set_ylim(-0.1, 0.1)
    below.set_xlim(0, v0[-1])
    dress(above, "", r"best $\alpha_0$ (degrees)")
    dress(below, r"$v_0$ (m/s)", "deviation (%)")
    figure.align_ylabels()
    return figure
