"""The six figures of the paper, and one of Didion's law: one function a figure.

Each returns a `matplotlib.figure.Figure` of its own, 16 cm wide, that no window or global state
knows of: save it with ``figure.savefig(path)``, or show it by naming it in a notebook.
"""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc
from numpy.polynomial import Polynomial

from hodograph import laws
from hodograph.engine.domain import FloatArray
from hodograph.grid import tabulate
from hodograph.launch import Launch
from hodograph.laws.vial import V_LIM
from hodograph.level import d_norm, d_ref, optimal_angle
from hodograph.paper import references, table_1
from hodograph.paper.table_1 import v_axis
from hodograph.path import position, speed
from hodograph.report.style import (
    BLUE,
    GREEN,
    GREY,
    LINE,
    RED,
    TEXT,
    dress,
    legend,
    new_figure,
    note,
    one_panel,
    title,
    two_panels,
)

SCALE = 0.2  # of every speed and force in figure 1: length for v_lim, and for the weight
DOTS: dict[str, Any] = {"marker": "o", "ls": "", "color": BLUE, "markersize": 3.5, "clip_on": False}


def figure_1() -> Figure:
    """The trajectory and the Frenet frame: T, N, the velocities, and the two forces.

    A launch at v_norm = 1.5 and 60 degrees, drawn to scale; the frame is where the path still
    climbs at 40 degrees.  Speeds over v_lim and forces over the weight share one scale.
    """
    v_norm, alpha0, alpha = 1.5, np.deg2rad(60), np.deg2rad(40)
    path = Launch(v_norm, alpha0, 1.0, g=1.0).trajectory(300)
    x, y, _ = position(v_norm, alpha0, alpha)
    v = speed(v_norm, alpha0, alpha)
    T = np.array([np.cos(alpha), np.sin(alpha)])
    N = np.array([np.sin(alpha), -np.cos(alpha)])  # to the centre of curvature

    figure, axes = one_panel(10.5)
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
    weight, drag = np.array([0.0, -SCALE]), -SCALE * v * v * T
    launch = SCALE * v_norm * np.array([np.cos(alpha0), np.sin(alpha0)])
    arrow(here, SCALE * v * T, BLUE)
    arrow(here, 0.075 * T, "black", 2.4)
    arrow(here, 0.075 * N, "black", 2.4)
    arrow(here, weight, RED)
    arrow(here, drag, GREEN)
    arrow(origin, launch, BLUE)
    label(r"$\mathbf{v}$", here + SCALE * v * T, 0.025, 0.01, BLUE)
    label(r"$\mathbf{T}$", here + 0.075 * T, -0.022, 0.022)
    label(r"$\mathbf{N}$", here + 0.075 * N, 0.03, -0.005)
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
    """A trajectory with and without drag: 45 degrees at v0 = v_lim = 42.7 m/s."""
    alpha0 = np.pi / 4
    figure, axes = one_panel(5.4)
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
        note(axes, f"${text} = {at:.1f}$ m", (at, 0), (8, 5), color=color)
    legend(axes)
    axes.set_aspect("equal")
    axes.set_xlim(0, 235)
    axes.set_ylim(0, 52)
    dress(axes, "$x$ (m)", "$y$ (m)")
    title(axes, rf"$v_0 = v_\mathrm{{lim}} = {V_LIM}$ m/s, $\alpha_0 = 45°$, $g = 9.81$ m/s²")
    return figure


def figure_3() -> Figure:
    """The normalised distance d_norm as a map over v_norm and alpha0."""
    grid = tabulate()
    figure, axes = one_panel(10.0)
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
    """d_norm at 45 degrees, the Pearson VII function fitted to it, and the residual below."""
    v = v_axis()
    exact = d_norm(v, np.pi / 4)
    fit = laws.fit_pearson(v, exact)
    figure, above, below = two_panels(11.0, 2.4, 1)
    above.plot(v[::5], exact[::5], **DOTS, label="exact")
    name = rf"Pearson VII fit: $K = {fit.K:.4f}$, $M = {fit.M:.4f}$"
    above.plot(v, laws.pearson_vii(v, fit.K, fit.M), color=RED, linewidth=LINE, label=name)
    legend(above)
    below.plot(v, 100 * fit.residuals / exact, color=RED, linewidth=LINE, label="this fit")
    table = laws.table_1(v, np.pi / 4)
    below.plot(v, 100 * (table / exact - 1), "--", color=GREEN, linewidth=LINE, label="Table 1")
    below.axhline(0, color="black", linewidth=0.8)
    below.set_xlim(0, v[-1])
    below.set_ylim(-0.22, 0.35)
    legend(below, ncols=2, loc="upper center")
    dress(above, "", r"$d_\mathrm{norm}$ at $\alpha_0 = 45°$")
    dress(below, r"$v_\mathrm{norm}$", "deviation (%)")
    return figure


def figure_5() -> Figure:
    """K and M against alpha0: Table 1, our fit of it, and a fit to the whole domain.

    Below, the relative deviation of each polynomial from the points of its own window, cut off at
    1 %.
    """
    near, whole = table_1.fit(), table_1.whole()
    figure = new_figure(12.5)
    columns = figure.subplots(2, 2, sharex=True, height_ratios=(2, 1)).T
    curves = (
        ("-", RED, "Table 1 of the paper", table_1.PRINTED, near),
        ("--", "black", "our fit of these points", near.coefficients, near),
        (":", GREEN, "our fit of 1° to 90°, exact distances", whole.coefficients, whole),
    )
    for (above, below), name, part, limits in zip(
        columns, "KM", (slice(4), slice(4, 7)), ((0, 1), (0.65, 0.85)), strict=True
    ):
        named = r"eq. 22 fitted at 10°, 15° ... 80°, $v_\mathrm{norm} \leq 1.5$"
        points = np.rad2deg(near.alpha0), getattr(near, name)
        above.plot(*points, "o", color=BLUE, markersize=4, label=named)
        for style, color, text, seven, window in curves:
            curve, degrees = Polynomial(seven[part]), np.rad2deg(window.alpha0)
            fine = np.linspace(degrees[0], degrees[-1], 181)
            above.plot(fine, curve(np.deg2rad(fine)), style, color=color, lw=LINE, label=text)
            off = 100 * (curve(window.alpha0) / getattr(window, name) - 1)
            below.plot(degrees, off, style, color=color, linewidth=LINE)
        below.axhline(0, color="black", linewidth=0.8)
        dress(above, "", f"${name}$")
        dress(below, r"$\alpha_0$ (degrees)", "deviation (%)")
        above.set_xlim(0, 90)
        above.set_xticks(range(0, 91, 15))
        above.set_ylim(*limits)
        below.set_ylim(-1.05, 1.05)
    figure.align_ylabels()
    handles, labels = columns[0][0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=labels, loc="outside upper center", ncols=2)
    return figure


def figure_6() -> Figure:
    """The launch angle of greatest distance against v0 for a baseball, with the paper's law.

    The relative deviation of the law is below, with the bound that the paper states.
    """
    v = v_axis()
    v0 = v * V_LIM
    best, law = optimal_angle(v), laws.alpha_max_vial(v0)
    figure, above, below = two_panels(11.0, 2.4, 1)
    above.plot(v0[::5], np.rad2deg(best[::5]), **DOTS, label="best angle, of exact distances")
    name = "angle by the law of section 3.3"
    above.plot(v0, np.rad2deg(law), color=RED, linewidth=LINE, label=name)
    legend(above)
    title(above, rf"$v_\mathrm{{lim}} = {V_LIM}$ m/s")
    below.plot(v0, 100 * (law / best - 1), color=RED, linewidth=LINE)
    below.axhline(0, color="black", linewidth=0.8)
    for bound in (-0.08, 0.08):
        below.axhline(bound, color=GREY, linewidth=1, linestyle="--")
    below.text(1, 0.072, "bound stated: 0.08 %", fontsize=TEXT, color=GREY, va="top")
    below.set_ylim(-0.1, 0.1)
    below.set_xlim(0, v0[-1])
    dress(above, "", r"best $\alpha_0$ (degrees)")
    dress(below, r"$v_0$ (m/s)", "deviation (%)")
    return figure


def figure_didion() -> Figure:
    """What a cubic term in the drag, v^2 (1 + v/c) over the weight, does to the best angle."""
    v = np.array([0.05, 0.3, 0.6, 0.9, 1.2, 1.5, 1.9, 2.3, 2.7, 3.0])
    square = np.rad2deg(optimal_angle(v))
    figure, above, below = two_panels(11.0, 2, 1.4)
    fine = np.linspace(0, 3, 151)
    best = np.rad2deg(optimal_angle(fine))
    above.plot(fine, best, color="black", linewidth=LINE, label=r"$v^2$ alone")
    for c, style, color in ((10.0, "-", BLUE), (3.0, "--", RED), (1.0, ":", GREEN)):
        angles = np.array([references.best_angle_didion(each, c) for each in v])
        name = rf"$v^2(1 + v/c)$, $c = {c:g}\,v_\mathrm{{lim}}$"
        above.plot(v, angles, style, color=color, linewidth=LINE, label=name)
        below.plot(v, angles - square, style, color=color, linewidth=LINE, marker="o", markersize=3)
    below.axhline(0, color="black", linewidth=0.8)
    above.set_xlim(0, 3)
    legend(above)
    dress(above, "", r"best $\alpha_0$ (degrees)")
    dress(below, r"$v_\mathrm{norm}$", "difference (degrees)")
    return figure
