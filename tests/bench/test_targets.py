"""The bench of aim: its targets are hit, and the table says so."""

import pytest

from hodograph.bench import targets


def test_the_table_of_aim():
    found = targets.measure(count=40, each=4, rounds=1)
    for name in (targets.ARRAYS, targets.ONE):
        assert found[name].answered == 1.0
        assert found[name].worst < 1e-9
        assert found[name].micros > 0
    assert targets.ARRAYS in targets.targets_table(found)


def test_ballistic_solver_hits_to_a_centimetre():
    pytest.importorskip("ballistic_solver", reason="it comes with the extra `bench`")
    found = targets.measure(count=40, each=40, rounds=1)[targets.OTHER]
    assert found.answered > 0.9
    assert 1e-6 < found.worst < 0.1
