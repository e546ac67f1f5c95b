"""Calls timed in turn, by a clock that the test itself moves on."""

import logging
import math
import os
import sys
import types

import pytest

from hodograph.report import clock


@pytest.fixture
def taking(monkeypatch):
    """Makes a call that takes so long, by a clock that nothing else moves; and the log of calls."""
    now, log = [0.0], []
    monkeypatch.setattr(clock, "time", types.SimpleNamespace(perf_counter=lambda: now[0]))

    def make(name, seconds):
        def call():
            log.append(name)
            now[0] += seconds

        return call

    return make, log


def test_each_in_turn(taking, caplog):
    make, log = taking
    caplog.set_level(logging.INFO, "hodograph")
    spent = clock.in_turn([make("a", 1.0), make("b", 0.25)], 6)
    assert log == ["a", "b"] * 6
    assert spent == [dict.fromkeys(range(6), 1.0), dict.fromkeys(range(6), 0.25)]
    assert caplog.messages == ["round 5 of 6", "round 6 of 6"]


@pytest.mark.parametrize(
    ("seconds", "turns"),
    [(math.inf, [*range(12)]), (12.0, [*range(12)]), (4.0, [0, 3, 6, 9]), (0.0001, [0])],
)
def test_a_slow_call_takes_its_turns_spread_out(taking, seconds, turns):
    make, _ = taking
    slow, quick = clock.in_turn([make("slow", 1.0), make("quick", 1e-9)], 12, seconds=seconds)
    assert list(slow) == turns
    assert list(quick) == [*range(12)]


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux lets a process choose its cores")
def test_cores_are_given_back():
    before = os.sched_getaffinity(0)
    with clock.one_core() as core:
        assert core
        assert len(os.sched_getaffinity(0)) == 1
    assert os.sched_getaffinity(0) == before
