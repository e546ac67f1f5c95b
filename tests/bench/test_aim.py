"""The bench of aim: its targets are hit, and the table says so."""

import pytest

from hodograph.bench import aim


def test_the_table_of_aim():
    found = aim.measure(count=40, each=4, rounds=1)
    for name in (aim.ARRAYS, aim.ONE):
        assert found[name].answered == 1.0
        assert found[name].worst < 1e-9
        assert found[name].micros > 0
    assert aim.ARRAYS in aim.targets_table(found)


def test_ballistic_solver_hits_to_a_centimetre():
    pytest.importorskip("ballistic_solver", reason="it comes with the extra `bench`")
    found = aim.measure(count=40, each=40, rounds=1)[aim.OTHER]
    assert found.answered > 0.9
    assert 1e-6 < found.worst < 0.1
