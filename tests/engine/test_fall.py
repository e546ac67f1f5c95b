"""The fall by Newton: the landing is the same whatever the guess was."""

from pathlib import Path

import numpy as np
import pytest

from hodograph.builders import reference_points as points
from hodograph.engine import fall, flight, power
from hodograph.engine.status import Status

DATA = Path(__file__).parents[2] / "data"


def fly(name, n):
    """The flights of a table whose landing is well conditioned, and their truth."""
    truth = points.load(DATA / name)
    size = truth["apex_y"] + np.abs(truth["height"])
    well = size < 30 * truth["x"] * np.abs(np.tan(truth["alpha"]))
    if "n" in truth:
        well &= truth["n"] == n
    v, a, h, x, t = (truth[key][well] for key in ("v_norm", "alpha0", "height", "x", "t"))
    # the tables are in units of v_lim; the landing is in those of the launch
    found = flight.fly(v, a, h / v / v, np.full_like(v, n), ("x", "t"))
    return found, found.reach * found.cos0 * v * v / x - 1, found.t * v / t - 1


@pytest.mark.parametrize("off", [0.0, 1e-6, 1e-4, -1.9e-4, 3e-4, 1e-2, -0.3, 3.0, 100.0])
@pytest.mark.parametrize(
    ("module", "name", "n"),
    [(fall, "reference.csv", 2.0), (power, "reference_power.csv", 3.0),
     (power, "reference_power.csv", 1.5)],
)  # fmt: skip
def test_a_guess_that_is_off_changes_nothing(monkeypatch, off, module, name, n):
    guess = module._first_guess
    monkeypatch.setattr(module, "_first_guess", lambda *args: guess(*args) * (1 + off))
    found, x, t = fly(name, n)
    assert (found.status == Status.CONVERGED).all()
    assert np.abs(x).max() <= 2e-14
    assert np.abs(t).max() <= 2e-14


def test_the_guess_is_near_on_the_domain_of_the_paper():
    """So near that one step ends it, but for one launch in a hundred."""
    grid = np.meshgrid(np.linspace(0.01, 1.5, 60), np.linspace(0.01, 1.53, 60))
    v, a = (part.ravel() for part in grid)
    found = flight.fly(v, a, np.zeros_like(v), np.full_like(v, 2.0), ("x",))
    assert np.mean(found.down.steps > 1) <= 0.01
    assert found.down.steps.max() <= 2
