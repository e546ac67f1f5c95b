"""The memory of a call."""

import sys

import pytest

from hodograph.bench import by_size


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell the peak")
@pytest.mark.parametrize("rtol", [None, 1e-3])
def test_peak_memory(rtol):
    taken = by_size.peak_memory(300_000, rtol)
    assert 0 < taken < 100


def test_peak_memory_of_a_call_that_fails(monkeypatch):
    monkeypatch.setattr(by_size.sys, "executable", "false")
    with pytest.raises(RuntimeError, match="failed: no message"):
        by_size.peak_memory(10)
