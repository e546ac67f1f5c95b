"""The figures of the exercise, by the names it gives its files: one function a figure.

Each takes the `Findings` of a run and the `Words` to label it by, and returns a
`matplotlib.figure.Figure` of its own.
"""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from hodograph.exercise.convergence import Convergence
from hodograph.exercise.sections import THREE, Findings
from hodograph.exercise.setup import Setup
from hodograph.exercise.words import ENGLISH, Words
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

# RK2 is drawn broad and pale, so that RK4 shows on top of it.
_LOOKS: dict[str, dict[str, Any]] = {
    "euler": {"color": RED, "linestyle": "-", "marker": "o", "lw": LINE},
    "euler_cromer": {"color": GREEN, "linestyle": "--", "marker": "s", "lw": LINE},
    "rk2": {"color": "#7fb0e0", "linestyle": "-", "marker": "^", "lw": 4, "zorder": 1.5},
    "rk4": {"color": "black", "linestyle": ":", "marker": "D", "lw": LINE},
}
_PANELS = ("naive", "interpolated")


def _look(method: str, *, marker: bool = False) -> dict[str, Any]:
    return _LOOKS[method] | ({"markersize": 4} if marker else {"marker": ""})


def figure_1(found: Findings, words: Words = ENGLISH) -> Figure:
    """The exercise's figure 1: three launches under quadratic drag."""
    setup = found.setup
    figure, axes = one_panel(7.0)
    for (degrees, path), color, style in zip(
        found.figure_1.paths, (BLUE, RED, GREEN), ["-", "--", "-."], strict=True
    ):
        label = words("figures.theta", degrees=degrees)
        axes.plot(path.x, path.y, style, color=color, lw=LINE, label=label)
        axes.plot(path.x[-1], 0, "o", color=color, markersize=4, clip_on=False, zorder=3)
    _path_axes(axes, words)
    legend(axes)
    title(
        axes, words("figures.figure_1", mass=setup.mass, v0=setup.v0, lambda_=setup.figure_lambda)
    )
    return figure


def _path_axes(axes: Any, words: Words) -> None:
    axes.set_xlim(0, None)
    axes.set_ylim(0, None)
    dress(axes, words("axes.distance"), words("axes.height"))


def graphe1(method: str, found: Findings, words: Words = ENGLISH) -> Figure:
    """The trajectories of 6.3 and 6.4 by one method, with drag and without."""
    setup, pair = found.setup, found.paths[method]
    figure, axes = one_panel(6.6)
    for path, color, style in zip(pair, (BLUE, GREY), ("-", "--"), strict=True):
        flight = path.flight
        above = flight.y >= 0
        label = words("figures.eta", eta=path.eta, x=flight.impact_naive.x)
        axes.plot(flight.x[above], flight.y[above], style, color=color, lw=LINE, label=label)
    _path_axes(axes, words)
    axes.set_ylim(0, 1.25 * np.max(pair[1].flight.y))
    legend(axes, loc="upper center", ncols=2)
    name = words.name(method)
    title(axes, words("figures.graphe1", name=name, degrees=setup.angle, dt=setup.dt))
    return figure


def impact(found: Findings, words: Words = ENGLISH) -> Figure:
    """Distance against launch angle (6.5), and the errors of both impacts."""
    setup, run = found.setup, found.impacts
    figure, above, below = two_panels(10.5, 2, 1)
    above.plot(run.degrees, run.naive, "o", color=BLUE, markersize=3, clip_on=False)
    at = int(np.argmax(run.naive))
    above.plot(run.degrees[at], run.naive[at], "o", color=RED, markersize=6)
    top = run.degrees[at], run.naive[at]
    text = words("figures.top", degrees=run.best, x=run.naive[at])
    note(above, text, top, (0, -16), color=RED, ha="center")
    naive, interpolated = (1000 * (x - run.exact) for x in (run.naive, run.interpolated))
    below.plot(run.degrees, naive, color=BLUE, lw=1, label=words("figures.naive"))
    label = words("figures.interpolated")
    below.plot(run.degrees, interpolated, "--", color="black", lw=LINE, label=label)
    below.set_ylim(1.05 * naive.min(), -0.35 * naive.min())
    legend(below, ncols=2, loc="upper center")
    _angle_axes(above, below, words)
    title(above, words("figures.impact", eta=setup.eta, dt=setup.dt))
    return figure


def _angle_axes(above: Any, below: Any, words: Words) -> None:
    above.set_xlim(0, 90)
    above.set_xticks(range(0, 91, 15))
    above.set_ylim(0, None)
    dress(above, "", words("axes.x_max"))
    dress(below, words("axes.angle"), words("axes.distance_error"))


def comparaison_convergence(found: Findings, words: Words = ENGLISH) -> Figure:
    """The graph asked for in 6.6: the three methods' mean error against n, and xmax_converge."""
    setup = found.setup
    figure, axes = one_panel(8.5)
    runs = [run for run in found.loops if run.method in THREE]
    for run in runs:
        end, label = run.reached("naive", "scipy"), words.name(run.method)
        last = len(run.n) if end is None else end.n
        if end is not None:
            label = words("figures.end", name=label, n=end.n)
        error = run.errors["naive", "scipy"]
        axes.semilogy(run.n[:last], error[:last], label=label, **_look(run.method))
    _loop_axes(axes, runs, setup, words)
    axes.text(1, setup.limit, words("figures.limit", limit=setup.limit), fontsize=TEXT, va="top")
    axes.set_ylabel(words("axes.mean_error"), fontsize=TEXT + 1)
    legend(axes)
    title(axes, words("figures.convergence"))
    return figure


def _loop_axes(axes: Any, runs: list[Convergence], setup: Setup, words: Words) -> None:
    """n below, the delta that belongs to it above, and the limit as a line."""
    axes.axhline(setup.limit, color=GREY, lw=1)
    last = max(run.n[-1] for run in runs)
    axes.set_xlim(0, last)
    dress(axes, words("axes.n"), "")
    top = axes.secondary_xaxis("top", functions=(lambda n: n, lambda n: n))
    deltas = setup.delta_1 / 10.0 ** np.arange(1, 12)
    ticks = np.log(setup.delta_1 / deltas) / np.log(setup.ratio)
    inside = ticks <= last
    top.set_xticks(ticks[inside], [words.number(delta) for delta in deltas[inside]])
    top.tick_params(labelsize=TEXT)
    top.set_xlabel(words("axes.delta"), fontsize=TEXT)


def convergence_ordres(found: Findings, words: Words = ENGLISH) -> Figure:
    """The mean error of all methods against n, for either impact, and the exact answer (6.6)."""
    figure = new_figure(9.5)
    columns = figure.subplots(1, 2, sharey=True)
    for axes, name in zip(columns, _PANELS, strict=True):
        for run in found.loops:
            label = words.name(run.method)
            axes.semilogy(run.n, run.errors[name, "exact"], label=label, **_look(run.method))
        _loop_axes(axes, found.loops, found.setup, words)
        title(axes, words(f"figures.{name}"))
    columns[0].set_ylabel(words("axes.mean_error"), fontsize=TEXT + 1)
    handles, labels = columns[0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=labels, loc="outside lower center", ncols=4)
    return figure


def energie(found: Findings, words: Words = ENGLISH) -> Figure:
    """Energies in time without drag (6.7): the parts by RK2, and the total by every method."""
    setup, runs = found.setup, found.energies
    figure, above, below = two_panels(11.0, 1, 1)
    parts = next(energy for energy in runs if energy.method == "rk2")
    for values, color, style, name in (
        (parts.total, "black", "-", "total"),
        (parts.kinetic, RED, "--", "kinetic"),
        (parts.potential, BLUE, "-.", "potential"),
    ):
        above.plot(parts.t, values, style, color=color, lw=LINE, label=words(f"figures.{name}"))
    for energy in runs:
        below.plot(energy.t, energy.total, label=words.name(energy.method), **_look(energy.method))
    start = parts.total[0]
    above.set_ylim(0, 1.3 * start)
    above.set_xlim(0, parts.t[-1])
    legend(above, ncols=3, loc="upper center")
    most = max(np.max(np.abs(energy.total - energy.total[0])) for energy in runs)
    below.set_ylim(start - 1.2 * most, start + 2 * most)
    legend(below, ncols=4, loc="upper center")
    dress(above, "", words("axes.parts"))
    dress(below, words("axes.time"), words("axes.total"))
    title(above, words("figures.energie", degrees=setup.energy_degrees, dt=setup.energy_dt))
    return figure


# Marks that show one inside the other.
_DOTS: dict[str, dict[str, Any]] = {
    "euler": {"color": RED, "marker": "o", "markersize": 7, "mfc": "none", "ls": ""},
    "euler_cromer": {"color": GREEN, "marker": "s", "markersize": 4.5, "mfc": "none", "ls": ""},
    "rk2": {"color": "black", "marker": ".", "markersize": 4, "ls": ""},
}


def quadratique(found: Findings, words: Words = ENGLISH) -> Figure:
    """The trajectory with quadratic drag (6.8), by steps and exact, and with linear drag."""
    setup, run = found.setup, found.quadratic
    figure, axes = one_panel(7.4)
    linear, path = run.linear, run.path
    label = words("figures.hodograph", lambda_=setup.lambda_)
    axes.plot(path.x, path.y, color=BLUE, lw=LINE, label=label)
    every = max(1, round(float(f"{path.t[-1] / 30:.0e}") / setup.dt))
    for method, look in _DOTS.items():
        x, y = (row[:-1:every] for row in (run.flights[method].x, run.flights[method].y))
        axes.plot(x, y, label=words.short(method), **look)
    label = words("figures.linear", eta=setup.eta)
    axes.plot(linear.x, linear.y, "--", color=GREY, lw=LINE, label=label)
    _path_axes(axes, words)
    axes.set_xlim(0, 1.15 * run.exact)
    axes.set_ylim(0, 1.3 * np.max(path.y))
    legend(axes, loc="lower center")
    key, apart = "figures.quadratique", every * setup.dt
    title(axes, words(key, degrees=setup.angle, v0=setup.v0, dt=setup.dt, apart=apart))
    return figure


def quadratique_impact(found: Findings, words: Words = ENGLISH) -> Figure:
    """Distance against launch angle with quadratic drag (6.8), by the three methods and exact."""
    setup, runs = found.setup, found.quadratic_impacts
    figure, above, below = two_panels(10.5, 2, 1)
    exact, best = runs[0].exact, runs[0].best_exact
    above.plot(runs[0].degrees, exact, color=BLUE, lw=LINE, label=words("figures.exact"))
    above.axvline(best, color=GREY, lw=1)
    for run in runs:
        label, look = words.short(run.method), _DOTS[run.method]
        above.plot(run.degrees[::3], run.naive[::3], label=label, **look)
        error = 1000 * (run.interpolated - run.exact)
        below.plot(run.degrees, error, **_look(run.method))
    legend(above)
    _angle_axes(above, below, words)
    key = "figures.quadratique_impact"
    title(above, words(key, lambda_=setup.lambda_, dt=setup.dt, best=best))
    return figure


def quadratique_ordre(found: Findings, words: Words = ENGLISH) -> Figure:
    """Mean error over the angles against the step, with quadratic drag (6.8)."""
    run = found.quadratic
    figure = new_figure(11.0)
    columns = figure.subplots(1, 2, sharey=True)
    for i, (axes, name) in enumerate(zip(columns, _PANELS, strict=True)):
        for order in run.orders:
            method = words.name(order.method)
            label = words("figures.slope", name=method, slope=order.slopes[i])
            error = (order.naive, order.interpolated)[i]
            axes.loglog(order.dt, error, label=label, **_look(order.method, marker=True))
        dress(axes, words("axes.step"), "" if i else words("axes.mean_error"))
        title(axes, words(f"figures.{name}"))
        legend(axes, loc="upper center", bbox_to_anchor=(0.5, -0.18))
    return figure


def quadratique_energie(found: Findings, words: Words = ENGLISH) -> Figure:
    """What is missing in the balance of energy and work with quadratic drag (6.8)."""
    setup, run = found.setup, found.quadratic
    figure, axes = one_panel(7.0)
    for balance in run.balances:
        label = words("figures.balance", name=words.name(balance.method), order=balance.order)
        axes.loglog(
            balance.t[1:], np.abs(balance.residual[1:]), label=label, **_look(balance.method)
        )
    legend(axes, loc="center right", bbox_to_anchor=(1, 0.36))
    dress(axes, words("axes.time"), words("axes.imbalance"))
    key = "figures.quadratique_energie"
    dt = run.balances[0].dt
    title(axes, words(key, degrees=setup.angle, lambda_=setup.lambda_, dt=dt))
    return figure


def quadratique_limite(found: Findings, words: Words = ENGLISH) -> Figure:
    """The distance lost to weak quadratic drag, by RK4 and exact (6.8)."""
    setup, run = found.setup, found.quadratic
    weak = run.weak
    figure, axes = one_panel(6.6)
    drag = np.geomspace(weak.drag[-1], weak.drag[0], 141)
    exact = (1 - setup.launch(drag=drag, n=2).range() / setup.vacuum_range) / drag
    axes.semilogx(drag, exact, color=BLUE, lw=LINE, label=words("figures.exact"))
    label = words("figures.rk4", dt=setup.dt)
    axes.semilogx(weak.drag, weak.loss, "o", color=RED, markersize=4, label=label)
    label = words("figures.weak_limit", limit=weak.loss_limit)
    axes.axhline(weak.loss_limit, color=GREY, lw=1, ls="--", label=label)
    axes.set_ylim(0, 1.1 * weak.loss_limit)
    legend(axes, loc="lower left")
    dress(axes, words("axes.lambda"), words("axes.loss"))
    title(axes, words("figures.quadratique_limite", degrees=setup.angle, v0=setup.v0))
    return figure
