"""The loop of section 6.6: how the error falls with the step, and where it is small enough."""

from typing import NamedTuple

import numpy as np

from hodograph.engine.domain import FloatArray
from hodograph.exercise.setup import Setup, steps
from hodograph.launch import Launch

IMPACTS = ("naive", "interpolated")
REFERENCES = ("scipy", "exact")
ROUNDING = 1e-9  # metres, joules: below it an error may be of rounding


class Reached(NamedTuple):
    """Where the loop of 6.6 ends."""

    n: int
    delta: float  # s
    error: float  # m
    evaluations: int  # of the acceleration, at this delta, for all angles together


class Convergence(NamedTuple):
    """Mean errors of one method as delta falls."""

    method: str
    limit: float  # m
    n: FloatArray
    delta: FloatArray
    errors: dict[
        tuple[str, str], FloatArray
    ]  # by impact and reference, m; NaN where the steps exploded
    evaluations: FloatArray

    def reached(self, impact: str, reference: str) -> Reached | None:
        """Where the error is first below the limit; None if it never is, up to the last n."""
        error = self.errors[impact, reference]
        below = np.flatnonzero(error < self.limit)
        if below.size == 0:
            return None
        at = below[0]
        return Reached(
            int(self.n[at]), float(self.delta[at]), float(error[at]), int(self.evaluations[at])
        )

    def order(self, impact: str) -> float:
        """The slope of log error, against the exact answer, on log delta."""
        return slope(self.delta, self.errors[impact, "exact"])


def slope(step: FloatArray, error: FloatArray) -> float:
    """Slope of log error on log step by least squares, where the error is above rounding.

    NaN and errors below 1e-9 are left out; with fewer than three points it is NaN.

    >>> step = np.array([0.1, 0.05, 0.025])
    >>> round(slope(step, 3 * step**2), 6)
    2.0
    """
    good = error > ROUNDING
    if np.count_nonzero(good) < 3:
        return float("nan")
    return float(np.polyfit(np.log(step[good]), np.log(error[good]), 1)[0])


def convergence(
    setup: Setup, method: str, scene: Launch, references: dict[str, FloatArray]
) -> Convergence:
    """Smaller and smaller delta until the mean error is below the limit, 0.1 m.

    It ends when three deltas in a row are below with both impacts and against every reference,
    so that one error small by luck does not end it; or at n = 80.  `references` are what
    counts as exact, distances in m by name.
    """
    rows: list[list[float]] = []
    costs, deltas = [], []
    keys = [(impact, reference) for impact in IMPACTS for reference in references]
    while len(rows) < setup.most and not (len(rows) >= 3 and np.max(rows[-3:]) < setup.limit):
        delta = setup.delta_1 / setup.ratio ** (len(rows) + 1)  # (18)
        flights = steps(scene, method, delta)
        found = {"naive": flights.impact_naive.x, "interpolated": flights.impact.x}
        rows.append(
            [float(np.mean(np.abs(found[impact] - references[name]))) for impact, name in keys]
        )
        deltas.append(delta)
        costs.append(flights.evaluations)
    errors = dict(zip(keys, np.array(rows).T, strict=True))
    n = np.arange(1.0, len(rows) + 1)
    return Convergence(method, setup.limit, n, np.array(deltas), errors, np.array(costs, float))
