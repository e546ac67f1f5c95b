"""The memory of a call."""

import math
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


def test_memory_where_the_system_does_not_say(monkeypatch):
    monkeypatch.setattr(by_size.sys, "platform", "darwin")
    assert math.isnan(by_size.resident("VmHWM"))
    assert math.isnan(by_size._growth(10, 1e-3))
