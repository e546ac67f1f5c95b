"""The paper's Newton iteration (eq. 20): where it works, where it stops, where it leaves."""

import numpy as np
import pytest

from hodograph import reference
from hodograph.engine import vial
from hodograph.engine.status import Status


def test_agrees_where_it_works():
    v, alpha0 = np.meshgrid([0.1, 0.5, 1.0], np.deg2rad([10.0, 45.0, 60.0]))
    result = vial.newton_vial(v, alpha0, stop=1e-9)
    assert np.all(result.status == Status.CONVERGED)
    for found, speed, angle in zip(result.alpha.flat, v.flat, alpha0.flat, strict=True):
        assert found == pytest.approx(float(reference.landing_angle(speed, angle)), abs=2e-9)


def test_stops_at_a_hundredth_of_a_degree():
    result = vial.newton_vial(1.0, np.pi / 4)
    truth = float(reference.landing_angle(1.0, np.pi / 4))
    assert 0 < abs(result.alpha - truth) < np.deg2rad(0.01)
    assert 2 <= result.steps <= 8


@pytest.mark.parametrize("v", [2.0, 5.0])
@pytest.mark.parametrize("degrees", [45.0, 60.0, 80.0])
def test_leaves_the_domain_at_its_first_step(v, degrees):  # and says so
    result = vial.newton_vial(v, np.deg2rad(degrees))
    assert result.status == Status.LEFT_DOMAIN
    assert result.steps == 1
    assert np.isnan(result.alpha)


def test_first_step_is_equation_20():
    # vacuum lands at -alpha0 at once; with weak drag the first change is y / y' there
    result = vial.newton_vial(0.0, 0.6)
    assert (result.alpha, result.steps) == (-0.6, 1)


def test_gives_up_when_told():
    result = vial.newton_vial(1.0, np.pi / 4, stop=1e-300, max_steps=3)
    assert (result.status, result.steps) == (Status.NOT_CONVERGED, 3)
