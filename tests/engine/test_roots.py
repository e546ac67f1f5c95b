"""Roots from a guess, against their closed forms."""

import numpy as np
import pytest

from hodograph.engine import roots

C = np.array([1e-12, 0.3, 1.0, 1.5, 2.9, 3.0, 50.0])


def cube(x, c):
    """Of slope -3 c^2 at its root, c."""
    return c**3 - x**3


@pytest.mark.parametrize("off", [0.0, 1e-16, 1e-9, 1e-4, 1e-2, 0.5])
def test_from_a_guess_that_is_near_and_one_that_is_not(off):
    x, found = roots.near(
        lambda x, c: cube(x, c) / c**2, C * (1 + off), -3.0, (0 * C, 10 * C + 1), (C,)
    )
    assert found.all()
    assert x == pytest.approx(C, rel=1e-15)


def test_a_wrong_slope_costs_steps_or_a_search_but_no_digits():
    for slope, off in ((-0.3, 1e-2), (-1.0, 1e-2), (-30.0, 1e-2), (3.0, 1e-2), (-30.0, 1e-8)):
        x, found = roots.near(
            lambda x, c: cube(x, c) / c**2, C * (1 + off), slope, (0 * C, 10 * C), (C,)
        )
        assert found.all()
        assert x == pytest.approx(C, rel=4e-15)


def test_nothing_outside_its_bracket_is_a_root():
    _, found = roots.near(lambda x, c: cube(x, c) / c**2, C, -3.0, (2 * C, 3 * C), (C,))
    assert not found.any()


def test_few_evaluations_from_near():
    seen = []

    def counted(x, c):
        seen.append(x.size)
        return cube(x, c) / c**2

    roots.near(counted, C * (1 + 1e-4), -2.8, (0 * C, 10 * C), (C,))
    assert len(seen) <= 4
