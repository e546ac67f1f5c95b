"""The measurements against truths from elsewhere, and verdicts that follow what is measured.

The verdicts of a whole run are in test_report.py.
"""

import numpy as np
import pytest

from hodograph import laws
from hodograph.laws import vial
from hodograph.paper import claims as verdicts
from hodograph.paper import measure, refit
from hodograph.paper.claims import Verdict


@pytest.fixture(scope="module")
def fits():
    return refit.refit_table_1()


# --- the fits ---


def test_vertical_column_of_the_fits_is_the_closed_form(fits):
    v = np.arange(1, 151) / 100
    exact = (np.arcsinh(v) + np.arctan(v)) / (2 * v * np.sqrt(1 + v * v))
    K, M = fits.table.K[-1], fits.table.M[-1]
    error = (1 + (K * v) ** 2 / M) ** -M / exact - 1
    assert np.max(np.abs(error)) == pytest.approx(fits.table.worst[-1], rel=1e-9)
    assert fits.table.worst[-1] < 1e-3


def test_K_vanishes_as_the_square_root_of_the_angle(fits):
    # weak drag: d_norm = 1 - (4 alpha / 3) v^2 for small angles
    assert fits.table.K[0] == pytest.approx(np.sqrt(4 / 3 * np.deg2rad(1)), rel=2e-3)


def test_free_fits_keep_the_bound_of_the_paper(fits):
    assert fits.table.worst[44] == pytest.approx(0.0016, abs=1e-4)
    assert np.max(fits.table.worst) < 0.002


def test_table_1_comes_back_on_a_window_only(fits):
    near = fits.nearest
    assert (near.low_deg, near.high_deg, near.v_max) == (9, 80, 1.3)
    assert pytest.approx([0.24207, 1.56854, -1.16548, 0.26454], rel=0.01) == near.K
    assert pytest.approx([0.675688, 0.046397, 0.031539], rel=0.01) == near.M
    assert np.max(np.abs(fits.whole.differences())) > 0.4


def test_a_table_of_the_printed_law_gives_the_printed_coefficients(fits):
    alpha0 = fits.table.alpha0
    K = 0.24207 + alpha0 * (1.56854 + alpha0 * (-1.16548 + alpha0 * 0.26454))
    M = 0.675688 + alpha0 * (0.046397 + alpha0 * 0.031539)
    fit = refit.fit_table_1(fits.table._replace(K=K, M=M), 10, 75)
    assert np.max(np.abs(fit.differences())) < 1e-9


def test_angle_law_comes_back():
    fit = refit.fit_angle_law(79.0)
    assert pytest.approx([0.0085864, 0.1366571], rel=1e-3) == [fit.K, fit.M]
    assert fit.worst < 0.0008


# --- the measurements ---


@pytest.mark.parametrize(
    ("low", "high", "percent", "within"),
    # of table 1 for v_norm to 1.5
    [(10, 80, 0.45, 0.01), (5, 5, 3.3, 0.05), (1, 90, 9.1, 0.1), (45, 45, 0.17, 0.01)],
)
def test_law_error_is_what_is_known(low, high, percent, within):
    error, v_norm, angle = measure.law_error().worst(low, high)
    assert 100 * abs(error) == pytest.approx(percent, abs=within)
    assert 0 < v_norm <= 1.5
    assert low <= angle <= high


def test_law_error_reads_its_own_table():
    v, degrees = np.array([0.0, 0.5, 1.0]), np.array([10.0, 20.0, 30.0, 40.0])
    error = np.zeros((3, 4))
    error[2, 0], error[1, 2], error[2, 2] = -0.05, 0.001, 0.003
    table = measure.LawError(v, degrees, error)
    assert table.worst() == (-0.05, 1.0, 10.0)
    assert table.worst(20, 40) == (0.003, 1.0, 30.0)
    assert table.within(0.002) == [(20.0, 20.0), (40.0, 40.0)]
    assert table.fastest(0.002, 20, 40) == 0.5
    assert table.fastest(0.1, 10, 40) == 1.0


def test_angle_law_error_is_what_is_known():
    v, error = measure.angle_law_error()
    assert v[-1] == 1.5
    assert 100 * np.max(np.abs(error)) == pytest.approx(0.012, abs=5e-4)


def test_legendre_deviation_is_what_is_known():
    deviation = 100 * measure.legendre_deviation(np.arange(30.0, 61.0))
    assert deviation.min() == pytest.approx(3.5, abs=0.05)
    assert deviation.max() == pytest.approx(4.0, abs=0.05)


def test_gaussian_is_missed_by_its_first_correction():
    # (1 + z/M)^-M = exp(-z) (1 + z^2/2M + ...): the largest difference is at z = 2
    shapes = (1e2, 1e3, 1e4)
    misses = measure.gaussian_misses(shapes)
    assert misses[-1] * shapes[-1] == pytest.approx(2 * np.exp(-2), rel=1e-3)


def test_closed_forms_agree_with_motion():
    assert max(measure.misses()) < 1e-10
    assert measure.power_law_miss() < 1e-10


@pytest.mark.parametrize("name", ["speed", "arc_length"])
def test_a_closed_form_slightly_off_is_seen(monkeypatch, name):
    right = getattr(measure, name)
    monkeypatch.setattr(measure, name, lambda *arguments: (1 + 1e-6) * right(*arguments))
    assert getattr(measure.misses(), name) == pytest.approx(1e-6, rel=1e-3)


def test_motion_in_si_gives_published_ranges():
    # TroyWigton/ProjectileTrajectory: v0, best angle, g = 9.81, k = 0.001 1/m
    d, _ = measure.fly_si(100.0, np.deg2rad(40.924), 9.81, 2.0, 0.002)
    assert d == pytest.approx(600.84063, abs=5e-6)
    # .223 bullet
    d, _ = measure.fly_si(975.0, np.deg2rad(24.7662), 9.81, 1.0, 0.0012)
    assert d == pytest.approx(2481.73, abs=5e-3)


def test_motion_in_si_gives_the_parabola():
    d, alpha_s = measure.fly_si(30.0, 1.2, 1.62, 5.0, 0.0)
    assert d == pytest.approx(30.0**2 * np.sin(2.4) / 1.62, rel=1e-10)
    assert alpha_s == pytest.approx(-1.2, rel=1e-10)


def test_spread_sees_a_body_that_scales_otherwise(monkeypatch):
    assert max(measure.spread()) < 1e-8
    right = measure.fly_si

    def off(v0, alpha0, g, m, drag):
        d, alpha_s = right(v0, alpha0, g, m, drag)
        return (d * 1.001, alpha_s - 1e-4) if g < 2 else (d, alpha_s)

    monkeypatch.setattr(measure, "fly_si", off)
    found = measure.spread()
    assert found.d_norm == pytest.approx(1e-3, rel=1e-3)
    assert found.alpha_s == pytest.approx(np.rad2deg(1e-4), rel=1e-3)


def test_newton_leaves_where_it_is_known_to():
    # from v_norm = 2 on at 45 degrees and above; nowhere on the paper's domain
    limits = measure.newton_thresholds(np.array([45.0, 60.0, 66.0, 75.0, 89.0]))
    assert np.all((limits > 1.5) & (limits <= 2.0))


def test_newton_over_the_domain():
    found = measure.newton_over_domain()
    assert found.failures == 0
    assert 1 <= found.steps_mean <= found.steps_most <= 10
    assert 0 < found.alpha_error_deg < 0.01
    # the stop of 0.01 degree is a fifth of what is left to 90 at 89.95: it costs 7 % in d there
    steep = measure.newton_over_domain((89.95,))
    assert 0.02 < steep.d_error < 0.2


def test_symmetry_and_its_loss():
    assert max(measure.vacuum_misses()) < 1e-12
    found = measure.asymmetry()
    assert found.least > 0
    assert found.at_15_deg == pytest.approx(found.by_motion, rel=1e-9)


def test_exponent_of_price_and_romano():
    assert 3 < measure.tilting_exponent() < 3.5
    assert measure.tilt(2.0, 0.5) < 0 < measure.tilt(4.0, 0.5)


# --- the verdicts ---


def test_a_misprinted_coefficient_fails(fits, monkeypatch):
    monkeypatch.setattr(laws, "TABLE_1_K", (0.24207, 1.56854 * 1.03, -1.16548, 0.26454))
    found = {verdict.id: verdict.holds for verdict in verdicts._table_1(fits)}
    assert not found["table_1_K_a1"]
    assert found["table_1_M_a1"]


def test_a_misprinted_angle_law_fails(monkeypatch):
    for module in (laws, vial):
        monkeypatch.setattr(module, "ALPHA_MAX_K", 0.0085864 * 1.02)
    monkeypatch.setattr(refit, "nearest_angle_law", lambda: refit.fit_angle_law(79.0))
    found = {verdict.id: verdict.holds for verdict in verdicts._angle_law()}
    assert not found["alpha_max_K"]
    assert not found["alpha_max_error"]
    assert found["alpha_max_M"]


def test_an_engine_slightly_off_fails(monkeypatch):
    right = measure.speed
    monkeypatch.setattr(measure, "speed", lambda *arguments: (1 + 1e-6) * right(*arguments))
    found = {verdict.id: verdict.holds for verdict in verdicts._motion()}
    assert not found["speed"]
    assert found["arc_length"]


def test_outcome_in_a_word():
    words = [Verdict("i", "p", "c", "p", "m", "d", holds).outcome for holds in (True, False, None)]
    assert words == ["holds", "fails", "not judged"]


def test_progress_is_told(fits, monkeypatch):
    for name in ("_motion", "_newton", "_similarity", "_settings", "_best_angle", "_angle_law"):
        monkeypatch.setattr(verdicts, name, lambda: iter(()))
    monkeypatch.setattr(verdicts, "_table_1", lambda fits: iter(()))
    heard = []
    assert verdicts.judge(fits, progress=heard.append) == []
    assert len(heard) == 7
