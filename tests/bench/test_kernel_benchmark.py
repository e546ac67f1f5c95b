"""The kernel's time, guarded by pytest-benchmark: ``pytest -m slow`` and this file's name.

What a launch may cost is counted in a yardstick, a few array operations on as many elements, on
the same machine a moment later.  The limits are about twice what was measured.
``--benchmark-autosave`` and ``--benchmark-compare`` show a drift within them.
"""

import timeit

import numpy as np
import pytest

from hodograph import d_norm
from hodograph.bench import measurement

pytest.importorskip("pytest_benchmark", reason="pytest-benchmark comes with the extra `bench`")
pytestmark = pytest.mark.slow

COUNT = 10_000


def yardstick():
    """Seconds an element for exp, a root and a division, at its best."""
    x = np.linspace(0.0, 1.0, COUNT)
    turns = timeit.repeat(lambda: 1 / np.sqrt(1 + np.expm1(x)), repeat=200, number=1)
    return min(turns) / COUNT


@pytest.mark.parametrize(
    ("v_low", "v_high", "limit"),
    [(0.1, 20, 1300), (0.1, 1.5, 1100), (1, 1, 1100), (1e8, 1e8, 2600)],
)
def test_array(benchmark, v_low, v_high, limit):
    benchmark(d_norm, *measurement.Domain("", (v_low, v_high)).launches(COUNT))
    cost = benchmark.stats.stats.min / COUNT / yardstick()
    benchmark.extra_info["yardsticks"] = round(cost, 1)
    assert cost < limit


def test_one_launch(benchmark):
    benchmark(d_norm, 1.0, 0.7)
    cost = benchmark.stats.stats.min / yardstick()
    benchmark.extra_info["yardsticks"] = round(cost)
    assert cost < 20_000
