"""The exercise's questions answered in sentences that follow from the numbers of a run.

One function a section; each yields paragraphs of plain text in the language of its `words`.
"""

from collections.abc import Iterator

import numpy as np

from hodograph.exercise.convergence import Convergence
from hodograph.exercise.sections import SCIPY, THREE, Findings, Path
from hodograph.exercise.words import ENGLISH, Words
from hodograph.steppers import FIXED


def figure_1(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """On the exercise's figure 1."""
    drawn = found.figure_1.paths
    ranges = [words("figure_1.range", x=path.x[-1], degrees=degrees) for degrees, path in drawn]
    yield words(
        "figure_1.all",
        lambda_=found.setup.figure_lambda,
        ranges=words.listed(ranges),
        farthest=max(drawn, key=lambda pair: pair[1].x[-1])[0],
        best=found.figure_1.best,
    )


def trajectories(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.3."""
    first, vacuum = found.paths["rk2"]
    runs = [found.paths[method][0] for method in THREE]
    misses = [
        words.each(
            f"trajectories.{'far' if _miss(run) > 0 else 'near'}",
            {run.method: 1000 * abs(_miss(run))},
        )
        for run in runs
    ]
    yield words(
        "trajectories.drag",
        eta=found.setup.eta,
        lost=vacuum.exact - first.exact,
        vacuum=vacuum.exact,
        percent=100 * (vacuum.exact - first.exact) / vacuum.exact,
        misses=words.listed(misses),
    )
    cuts = [1000 * float(run.flight.impact.x - run.flight.impact_naive.x) for run in runs]
    step = 1000 * found.setup.dt * float(first.flight.impact.p)
    yield words("trajectories.cut", least=min(cuts), most=max(cuts), step=step)


def _miss(path: Path) -> float:
    return float(path.flight.impact.x - path.exact)


def scipy(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.4."""
    ours, theirs = found.paths["rk2"][0], found.paths[SCIPY][0]
    ratio = theirs.flight.evaluations / ours.flight.evaluations
    yield words("scipy.what", name=SCIPY)
    yield words("scipy.compared", dt=found.setup.dt, theirs=theirs.off, ours=ours.off, ratio=ratio)


def impact(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.5."""
    run = found.impacts
    short = 1000 * (run.exact - run.naive)
    inside = np.max(np.abs(run.interpolated - run.exact))
    yield words("impact.best", best=run.best, x=run.naive.max(), exact=run.best_exact)
    yield words("impact.error", mean=np.mean(short), most=np.max(short), inside=inside)


def convergence(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.6."""
    reference, loops = found.reference, found.loops
    yield words(
        "convergence.reference",
        dt=found.setup.reference_dt,
        off=1000 * reference.mean_off,
        inside=reference.mean_off_interpolated,
        limit=found.setup.limit,
    )
    asked = words("convergence.asked", ends=_ends(loops, "naive", "scipy", words))
    yield f"{asked} {_naive_order(found, words)}"
    slopes = {run.method: run.order("interpolated") for run in loops}
    yield words(
        "convergence.interpolated",
        ends=_ends(loops, "interpolated", "exact", words),
        slopes=words.each("convergence.slope_of", slopes),
    )
    if shifts := list(_shifts(found, words)):
        yield " ".join(shifts)
    yield from _conclusion(found, words)


def ending(run: Convergence, impact: str, reference: str, words: Words = ENGLISH) -> str:
    """Where the loop of a method ends, in words."""
    end = run.reached(impact, reference)
    name = words.short(run.method)
    if end is None:
        return words("convergence.no_end", n=len(run.n), name=name)
    return words("convergence.end", n=end.n, delta=end.delta, name=name)


def _ends(loops: list[Convergence], impact: str, reference: str, words: Words) -> str:
    return words.listed(ending(run, impact, reference, words) for run in loops)


def _naive_order(found: Findings, words: Words) -> str:
    run = next(run for run in found.loops if run.method == "rk2")
    half_steps = run.delta / 2 * np.mean(found.reference.speed)
    return words(
        "convergence.slope",
        slopes=words.listed(words.number(run.order("naive"), ".2f") for run in found.loops),
        orders=words.listed(str(FIXED[run.method].order) for run in found.loops),
        ratio=np.nanmean(run.errors["naive", "exact"] / half_steps),
    )


def _shifts(found: Findings, words: Words) -> Iterator[str]:
    """Where the loop as asked, to the last stored point, ends sooner or later for its errors."""
    for run in (run for run in found.loops if FIXED[run.method].order == 1):
        far = _miss(found.paths[run.method][0]) > 0
        naive, inside = run.reached("naive", "scipy"), run.reached("interpolated", "exact")
        if naive and inside and (naive.n < inside.n if far else naive.n > inside.n):
            key = f"convergence.{'sooner' if far else 'later'}"
            yield words(key, name=words.short(run.method), naive=naive.n, inside=inside.n)


def _conclusion(found: Findings, words: Words) -> Iterator[str]:
    ends = {run.method: run.reached("interpolated", "exact") for run in found.loops}
    cut = {run.method: run.reached("naive", "scipy") for run in found.loops}
    euler, rk2, rk4, cut2, cut4 = ends["euler"], ends["rk2"], ends["rk4"], cut["rk2"], cut["rk4"]
    if euler and rk2 and rk4 and cut2 and cut4:
        yield words(
            "convergence.conclusion",
            limit=found.setup.limit,
            longer=rk2.delta / euler.delta,
            fewer=euler.evaluations / rk2.evaluations,
            factor=float(f"{found.setup.limit / rk4.error:.0e}"),
            n=rk4.n,
            same=words(f"convergence.{'same' if cut2.n == cut4.n else 'nearly'}"),
            shorter=rk2.delta / cut2.delta,
        )


def energy(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.7."""
    start = float(found.energies[0].total[0])
    runs = {run.method: run for run in found.energies}
    keeping = [method for method, run in runs.items() if abs(run.gain) <= 1e-9 * start]
    drifting = [
        words(
            f"energy.{'gains' if run.gain > 0 else 'loses'}",
            name=words.short(method),
            gain=abs(run.gain),
            start=start,
            percent=100 * abs(run.gain) / start,
            power=run.power,
        )
        for method, run in runs.items()
        if method not in keeping
    ]
    yield words(
        "energy.drift",
        drifting=words.listed(drifting),
        keeping=words.listed(words.short(method) for method in keeping),
        worst=max(np.max(np.abs(runs[method].total - start)) for method in keeping),
    )
    yield words("energy.why", rate=found.setup.mass * found.setup.g**2 * found.setup.energy_dt / 2)
    yield words("energy.shadow", shadows=max(runs[m].shadow for m in ("euler", "euler_cromer")))


def quadratic(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.8: the flight, and how the methods may be tested."""
    run, setup = found.quadratic, found.setup
    x = float(run.flights["rk2"].impact.x)
    yield words(
        "quadratic.flight",
        ratio=setup.lambda_ * setup.v0**2 / (setup.mass * setup.g),
        exact=run.exact,
        dt=setup.dt,
        x=x,
        off=abs(x - run.exact),
    )
    yield words("quadratic.procedure")
    yield words("quadratic.largest", limits=words.each("quadratic.step", run.largest_steps))


def quadratic_impact(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.8: distance against angle."""
    runs = found.quadratic_impacts
    tops = {run.method: run.best_fitted for run in runs}
    errors = {run.method: float(np.max(np.abs(run.interpolated - run.exact))) for run in runs}
    yield words(
        "quadratic.angles",
        best=runs[-1].best,
        found=words.each("quadratic.best", tops),
        exact=runs[-1].best_exact,
        errors=words.each("quadratic.error", errors),
    )


def quadratic_order(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.8: order and error against the hodograph."""
    run = found.quadratic
    inside = {order.method: order.slopes[1] for order in run.orders}
    cut = words.listed(words.number(order.slopes[0], ".2f") for order in run.orders)
    yield words("quadratic.order", inside=words.each("convergence.slope_of", inside), cut=cut)
    yield words("quadratic.loop", ends=_ends(run.loops, "interpolated", "exact", words))


def quadratic_energy(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.8: energy and the work of drag."""
    balances = found.quadratic.balances
    sizes = words.each("quadratic.missing", {run.method: run.largest[-1] for run in balances})
    slopes = words.listed(words.number(run.order, ".2f") for run in balances)
    yield words("quadratic.balance", dt=balances[0].steps[-1], sizes=sizes, slopes=slopes)


def quadratic_terminal(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.8: terminal speed."""
    fall = found.quadratic.fall
    yield words(
        "quadratic.terminal",
        height=fall.height,
        v_lim=found.quadratic.v_lim,
        exact=abs(fall.exact),
        worst=max(abs(off) for method in fall.by_method.values() for off in method),
        steps=words.listed(f"{words.number(step)} s" for step in fall.dt),
    )


def quadratic_weak(found: Findings, words: Words = ENGLISH) -> Iterator[str]:
    """6.8: lambda to 0."""
    weak = found.quadratic.weak
    yield words(
        "quadratic.weak",
        limit=weak.loss_limit,
        last=weak.loss[-1],
        drag=weak.drag[-1],
        left=abs(weak.loss[-1] / weak.loss_limit - 1),
        off=np.max(np.abs(weak.by_rk4 / weak.exact - 1)),
        strongest=weak.drag[0],
    )
