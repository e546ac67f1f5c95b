"""What a sweep costs, measured in the small."""

import pytest


@pytest.mark.slow
def test_costs():
    for name in ("xarray", "distributed", "zarr", "netCDF4"):
        pytest.importorskip(name, reason="it comes with the extra `sweep`")
    from hodograph.bench import sweep

    costs = sweep.measure(20_000, (10_000,))
    assert min(costs.call, costs.one, costs.two, costs.start, costs.disk, costs.file) > 0
    assert 30 < costs.memory[10_000] < 2000
    assert "a chunk more" in sweep.costs_table(costs)
