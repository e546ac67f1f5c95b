"""The landing angle: the library's Newton and the paper's."""

import numpy as np
import pytest

from hodograph import landing_angle, ode, reference
from hodograph.engine import vial
from hodograph.engine.flight import fly
from hodograph.engine.status import Status


@pytest.mark.parametrize("v", [1e-6, 0.01, 0.4, 1.0, 1.5])
@pytest.mark.parametrize("degrees", [1e-4, 1.0, 20.0, 45.0, 70.0, 89.0, 89.99999, 90.0])
def test_against_mpmath_on_the_papers_domain(v, degrees):
    alpha0 = np.deg2rad(degrees)
    truth = float(reference.landing_angle(v, alpha0))
    assert landing_angle(v, alpha0) == pytest.approx(truth, rel=1e-15, abs=0)


def test_against_the_equations_of_motion():
    for v, alpha0 in [(0.5, 0.3), (1.5, 1.2), (20.0, 0.8)]:
        flight = ode.solve(v, alpha0, 1.0, g=1.0, rtol=1e-12, atol=1e-14)
        assert landing_angle(v, alpha0) == pytest.approx(flight.alpha, rel=1e-10)


def test_limits_are_exact():
    assert landing_angle(0.0, 0.7) == -0.7
    assert landing_angle(5.0, 0.0) == 0.0
    assert landing_angle(5.0, np.pi / 2) == -np.pi / 2
    assert landing_angle(1.0, 5e-324) == -5e-324


def test_a_million_random_launches_converge_in_few_steps():
    rng = np.random.default_rng(20080220)
    n = 200_000
    v = np.concatenate([rng.uniform(0, 1.5, n), 10 ** rng.uniform(-8, 8, n)])
    alpha0 = np.concatenate([rng.uniform(0, np.pi / 2, n), 10 ** rng.uniform(-9, 0.19, n)])
    flight = fly(v, alpha0, np.zeros_like(v), np.full_like(v, 2.0), ())
    assert np.all(flight.status == Status.CONVERGED)
    assert flight.down.steps.max() <= 4


class TestThePapersNewton:
    def test_agrees_where_it_works(self):
        v, alpha0 = np.meshgrid([0.1, 0.5, 1.0], np.deg2rad([10.0, 45.0, 60.0]))
        result = vial.newton_vial(v, alpha0, stop=1e-9)
        assert np.all(result.status == Status.CONVERGED)
        for found, speed, angle in zip(result.alpha.flat, v.flat, alpha0.flat, strict=True):
            assert found == pytest.approx(float(reference.landing_angle(speed, angle)), abs=2e-9)

    def test_stops_at_a_hundredth_of_a_degree(self):
        result = vial.newton_vial(1.0, np.pi / 4)
        truth = float(reference.landing_angle(1.0, np.pi / 4))
        assert 0 < abs(result.alpha - truth) < np.deg2rad(0.01)
        assert 2 <= result.steps <= 8

    @pytest.mark.parametrize("v", [2.0, 5.0])
    @pytest.mark.parametrize("degrees", [45.0, 60.0, 80.0])
    def test_leaves_the_domain_at_its_first_step(self, v, degrees):  # and says so
        result = vial.newton_vial(v, np.deg2rad(degrees))
        assert result.status == Status.LEFT_DOMAIN
        assert result.steps == 1
        assert np.isnan(result.alpha)

    def test_first_step_is_equation_20(self):
        # vacuum lands at -alpha0 at once; with weak drag the first change is y / y' there
        result = vial.newton_vial(0.0, 0.6)
        assert (result.alpha, result.steps) == (-0.6, 1)

    def test_gives_up_when_told(self):
        result = vial.newton_vial(1.0, np.pi / 4, stop=1e-300, max_steps=3)
        assert (result.status, result.steps) == (Status.NOT_CONVERGED, 3)
