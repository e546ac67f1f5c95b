"""The figures of the exercise, by the names it gives its files: one function a figure.

Each returns a `matplotlib.figure.Figure` of its own, as those of `figures` do.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from hodograph.exercise.quadratic import (
    BALANCE_DT,
    Quadratic,
)
from hodograph.exercise.scene import (
    DT,
    ETA,
    LAMBDA,
    RATIO,
    V0,
    Convergence,
    G,
    launch,
)
from hodograph.exercise.sections import ENERGY_DT, FIGURE_LAMBDA, Energy, Impacts, Path
from hodograph.launch import Trajectory
from hodograph.paper.figures import BLUE, GREEN, GREY, LINE, RED, TEXT, dress, new_figure

NAMES = {
    "euler": "Euler",
    "euler_cromer": "Euler-Cromer",
    "rk2": "RK2 (midpoint)",
    "rk4": "RK4",
    "dopri5": "SciPy dopri5",
}
_LOOKS: dict[str, dict[str, Any]] = {
    "euler": {"color": RED, "linestyle": "-", "marker": "o"},
    "euler_cromer": {"color": GREEN, "linestyle": "--", "marker": "s"},
    "rk2": {"color": BLUE, "linestyle": "-.", "marker": "^"},
    "rk4": {"color": "black", "linestyle": ":", "marker": "D"},
}
_PANELS = (("naive", "last stored point"), ("interpolated", "interpolated"))


def _legend(axes: Any, **options: Any) -> None:
    axes.legend(fontsize=TEXT, frameon=False, **options)


def _title(axes: Any, words: str) -> None:
    axes.set_title(words, fontsize=TEXT + 1)


def figure_1(paths: list[tuple[float, Trajectory]]) -> Figure:
    """The exercise's figure 1: three launches under quadratic drag.

    Parameters
    ----------
    paths : list
        From `exercise.figure_1`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = new_figure(7.0)
    axes = figure.add_subplot()
    for (degrees, path), color, style in zip(
        paths, (BLUE, RED, GREEN), ["-", "--", "-."], strict=True
    ):
        axes.plot(path.x, path.y, style, color=color, lw=LINE, label=rf"$\theta = {degrees:g}°$")
        axes.plot(path.x[-1], 0, "o", color=color, markersize=4, clip_on=False, zorder=3)
    axes.set_xlim(0, None)
    axes.set_ylim(0, None)
    _legend(axes)
    dress(axes, "$x$ (m)", "$y$ (m)")
    _title(
        axes,
        rf"$v_0 = {V0:g}$ m/s, 1 kg, drag $-\lambda v\,\mathbf{{v}}$, "
        rf"$\lambda = {FIGURE_LAMBDA}$ kg/m",
    )
    return figure


def graphe1(pair: tuple[Path, Path]) -> Figure:
    """The trajectories of 6.3 and 6.4 by one method, with drag and without.

    Parameters
    ----------
    pair : tuple of exercise.Path
        From `exercise.paths`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> from hodograph.exercise.sections import paths
    >>> graphe1(paths("euler")).axes[0].get_title()
    'Euler, DT = 0.001 s'
    """
    figure = new_figure(6.6)
    axes = figure.add_subplot()
    for path, color, style in zip(pair, (BLUE, GREY), ("-", "--"), strict=True):
        flight = path.flight
        above = flight.y >= 0
        label = rf"$\eta = {path.eta:g}$ kg/s: {flight.impact_naive.x:.2f} m"
        axes.plot(flight.x[above], flight.y[above], style, color=color, lw=LINE, label=label)
    axes.set_xlim(0, None)
    axes.set_ylim(0, None)
    _legend(axes, loc="lower center")
    dress(axes, "$x$ (m)", "$y$ (m)")
    _title(axes, f"{NAMES[pair[0].method]}, DT = {DT:g} s")
    return figure


def impact(found: Impacts) -> Figure:
    """Distance against launch angle (6.5), and what either impact is off by.

    Parameters
    ----------
    found : exercise.Impacts
        From `exercise.impacts`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = new_figure(10.5)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    above.plot(found.degrees, found.tab_rk2_impact, "o", color=BLUE, markersize=3, clip_on=False)
    at = int(np.argmax(found.tab_rk2_impact))
    above.plot(found.degrees[at], found.tab_rk2_impact[at], "o", color=RED, markersize=6)
    above.annotate(
        f"{found.best:g}°: {found.tab_rk2_impact[at]:.2f} m",
        (found.degrees[at], found.tab_rk2_impact[at]),
        (0, -16),
        textcoords="offset points",
        ha="center",
        fontsize=TEXT,
        color=RED,
    )
    naive, interpolated = (
        1000 * (x - found.exact) for x in (found.tab_rk2_impact, found.interpolated)
    )
    below.plot(found.degrees, naive, color=BLUE, lw=1, label="last stored point")
    below.plot(found.degrees, interpolated, "--", color="black", lw=LINE, label="interpolated")
    below.set_ylim(1.05 * naive.min(), -0.35 * naive.min())
    _legend(below, ncols=2, loc="upper center")
    above.set_xlim(0, 90)
    above.set_xticks(range(0, 91, 15))
    dress(above, "", r"$x_\mathrm{max}$ (m)")
    dress(below, r"$\theta$ (degrees)", "less the exact (mm)")
    _title(above, rf"RK2, $\eta = {ETA:g}$ kg/s, DT = {DT:g} s")
    figure.align_ylabels()
    return figure


def comparaison_convergence(found: list[Convergence]) -> Figure:
    """The mean error against n (6.6), for either impact, against the exact answer.

    Parameters
    ----------
    found : list of exercise_scene.Convergence
        From `exercise_scene.convergence`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = new_figure(9.5)
    columns = figure.subplots(1, 2, sharey=True)
    for axes, (name, words) in zip(columns, _PANELS, strict=True):
        for run in found:
            look = _LOOKS[run.method]
            axes.semilogy(
                run.n,
                run.errors[name, "exact"],
                color=look["color"],
                linestyle=look["linestyle"],
                lw=LINE,
                label=NAMES[run.method],
            )
        axes.axhline(found[0].limit, color=GREY, lw=1)
        axes.set_xlim(0, max(run.n[-1] for run in found))
        dress(axes, "$n$", "mean error (m)" if name == "naive" else "")
        _title(axes, f"impact: {words}")
        top = axes.secondary_xaxis("top", functions=(lambda n: n, lambda n: n))
        ticks = np.log(1 / np.array([0.1, 0.01])) / np.log(RATIO)
        top.set_xticks(ticks, ["0.1 s", "0.01 s"], fontsize=TEXT)
    limit = found[0].limit
    columns[0].text(1, limit / 1.3, f"{limit:g} m", fontsize=TEXT, color=GREY, va="top")
    handles, labels = columns[0].get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside lower center", fontsize=TEXT, ncols=4, frameon=False
    )
    return figure


def energie(found: list[Energy]) -> Figure:
    """Energies in time without drag (6.7): the parts by RK2, and the total by every method.

    Parameters
    ----------
    found : list of exercise.Energy
        From `exercise.energies`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> from hodograph.exercise.sections import energies
    >>> len(energie(energies()).axes)
    2
    """
    figure = new_figure(11.0)
    above, below = figure.subplots(2, 1, sharex=True)
    parts = next(energy for energy in found if energy.method == "rk2")
    for values, color, style, name in (
        (parts.total, "black", "-", "total"),
        (parts.kinetic, RED, "--", "kinetic"),
        (parts.potential, BLUE, "-.", "potential"),
    ):
        above.plot(parts.t, values, style, color=color, lw=LINE, label=name)
    for energy in found:
        look = _LOOKS[energy.method] | {"marker": ""}
        change = energy.total - energy.total[0]
        below.plot(energy.t, change, lw=LINE, label=NAMES[energy.method], **look)
    above.set_ylim(0, 1.3 * parts.total[0])
    above.set_xlim(0, parts.t[-1])
    _legend(above, ncols=3, loc="upper center")
    reach = max(np.max(np.abs(energy.total - energy.total[0])) for energy in found)
    below.set_ylim(-1.2 * reach, 2 * reach)
    _legend(below, ncols=4, loc="upper center")
    dress(above, "", "energy by RK2 (J)")
    dress(below, "$t$ (s)", "change of the total (J)")
    _title(above, rf"$\theta = 60°$, $\eta = 0$, DT = {ENERGY_DT} s")
    figure.align_ylabels()
    return figure


def quadratique(found: Quadratic) -> Figure:
    """The trajectory with quadratic drag (6.8), by steps and exact, and with linear drag.

    Parameters
    ----------
    found : exercise_quadratic.Quadratic
        From `exercise_quadratic.quadratic`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = new_figure(6.6)
    axes = figure.add_subplot()
    linear, path, flight = found.linear, found.path, found.rk2
    axes.plot(path.x, path.y, color=BLUE, lw=LINE, label=rf"hodograph, $\lambda = {LAMBDA}$ kg/m")
    axes.plot(
        flight.x[:-1:100],
        flight.y[:-1:100],
        "o",
        color=RED,
        markersize=4,
        label=f"RK2, DT = {DT:g} s, every 0.1 s",
    )
    axes.plot(
        linear.x, linear.y, "--", color=GREY, lw=LINE, label=rf"linear drag, $\eta = {ETA}$ kg/s"
    )
    axes.set_xlim(0, 1.15 * found.exact)
    axes.set_ylim(0, 1.3 * np.max(path.y))
    _legend(axes, loc="lower center")
    dress(axes, "$x$ (m)", "$y$ (m)")
    _title(axes, rf"$\theta = 45°$, $v_0 = {V0:g}$ m/s")
    return figure


def quadratique_ordre(found: Quadratic) -> Figure:
    """Mean error over the angles against the step, with quadratic drag (6.8).

    Parameters
    ----------
    found : exercise_quadratic.Quadratic
        From `exercise_quadratic.quadratic`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = new_figure(11.0)
    columns = figure.subplots(1, 2, sharey=True)
    for i, (axes, (_name, words)) in enumerate(zip(columns, _PANELS, strict=True)):
        for order in found.orders:
            label = f"{NAMES[order.method]}: slope {order.slopes[i]:.2f}"
            error = (order.naive, order.interpolated)[i]
            axes.loglog(order.dt, error, lw=LINE, markersize=4, label=label, **_LOOKS[order.method])
        dress(axes, "step (s)", "mean error (m)" if i == 0 else "")
        _title(axes, f"impact: {words}")
        _legend(axes, loc="upper center", bbox_to_anchor=(0.5, -0.18))
    return figure


def quadratique_energie(found: Quadratic) -> Figure:
    """What is missing in the balance of energy and work with quadratic drag (6.8).

    Parameters
    ----------
    found : exercise_quadratic.Quadratic
        From `exercise_quadratic.quadratic`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    figure = new_figure(7.0)
    axes = figure.add_subplot()
    for balance in found.balances:
        look = _LOOKS[balance.method] | {"marker": ""}
        label = f"{NAMES[balance.method]}: order {balance.order:.2f}"
        axes.loglog(balance.t[1:], np.abs(balance.residual[1:]), lw=LINE, label=label, **look)
    _legend(axes, loc="center right", bbox_to_anchor=(1, 0.36))
    dress(axes, "$t$ (s)", "missing in the balance (J)")
    _title(axes, rf"$\theta = 45°$, $\lambda = {LAMBDA}$ kg/m, DT = {BALANCE_DT} s")
    return figure


def quadratique_limite(found: Quadratic) -> Figure:
    """The distance lost to weak quadratic drag, by RK4 and exact (6.8).

    Parameters
    ----------
    found : exercise_quadratic.Quadratic
        From `exercise_quadratic.quadratic`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    weak = found.weak
    figure = new_figure(6.6)
    axes = figure.add_subplot()
    drag = np.geomspace(weak.drag[-1], weak.drag[0], 141)
    exact = (1 - launch(np.pi / 4, drag, 2).range() / (V0**2 / G)) / drag
    axes.semilogx(drag, exact, color=BLUE, lw=LINE, label="hodograph")
    axes.semilogx(weak.drag, weak.loss, "o", color=RED, markersize=4, label=f"RK4, DT = {DT:g} s")
    axes.axhline(
        weak.loss_limit,
        color=GREY,
        lw=1,
        ls="--",
        label=rf"limit $\lambda \to 0$: {weak.loss_limit:.2f}",
    )
    axes.set_ylim(0, 1.1 * weak.loss_limit)
    _legend(axes, loc="lower left")
    dress(axes, r"$\lambda$ (kg/m)", r"$(1 - x_\mathrm{max}/x_0)\,/\,\lambda$  (m/kg)")
    _title(axes, r"$\theta = 45°$; $x_0$ is the distance without drag")
    return figure
