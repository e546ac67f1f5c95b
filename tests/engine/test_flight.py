"""Flights in blocks: the Newton iteration of the landing."""

import numpy as np

from hodograph.engine.flight import fly
from hodograph.engine.status import Status


def test_a_million_random_launches_converge_in_few_steps():
    rng = np.random.default_rng(20080220)
    n = 200_000
    v = np.concatenate([rng.uniform(0, 1.5, n), 10 ** rng.uniform(-8, 8, n)])
    alpha0 = np.concatenate([rng.uniform(0, np.pi / 2, n), 10 ** rng.uniform(-9, 0.19, n)])
    flight = fly(v, alpha0, np.zeros_like(v), np.full_like(v, 2.0), ())
    assert np.all(flight.status == Status.CONVERGED)
    assert flight.down.steps.max() <= 4
