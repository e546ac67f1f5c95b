"""The measurements against truths from elsewhere, and verdicts that follow what is measured.

The verdicts of a whole run are in test_report.py.
"""

import numpy as np
import pytest

from hodograph import d_norm, laws, ode, optimal_angle
from hodograph.engine.vial import newton_vial
from hodograph.laws import vial
from hodograph.paper import angle_law, claims, claims_of_laws, measure, references, table_1
from hodograph.paper.verdict import Verdict, tally
from hodograph.path import position
from hodograph.report import tables

# --- Table 1 ---


def test_the_digits_of_table_1_come_back():
    """As found by an implementation apart: trapezia of 0.05 degree, eq. 13 as printed."""
    found = table_1.fit()
    by_trapezia = [0.242073, 1.568532, -1.165484, 0.264550, 0.675616, 0.046457, 0.031559]
    assert found.coefficients == pytest.approx(by_trapezia, abs=6e-5)
    assert found.coefficients[:4] == pytest.approx([0.24207, 1.56854, -1.16548, 0.26454], abs=6e-5)
    assert found.curves[0] < 3e-5
    assert found.curves[1] < 1e-4
    K, M = table_1.rounding()
    assert pytest.approx(3.5e-5, abs=1e-6) == K
    assert pytest.approx(2.2e-6, abs=1e-7) == M
    assert found.left[0] < K
    assert found.left[1] > 10 * M


def test_with_the_stop_of_the_text_they_do_not():
    found = table_1.fit(table_1.Procedure(stop=np.deg2rad(0.01)))
    expected = [0.24181, 1.57167, -1.17194, 0.26819, 0.672724, 0.055139, 0.025362]
    assert found.coefficients == pytest.approx(expected, abs=2e-5)
    exact = table_1.fit(table_1.Procedure(stop=0))
    assert exact.coefficients == pytest.approx(found.coefficients, abs=1e-5)


@pytest.mark.parametrize("stop", [np.deg2rad(0.01), 0.01])
def test_the_iteration_is_that_of_the_library(stop):
    v, alpha0 = np.array([0.2, 1.0, 1.5]), np.deg2rad([10.0, 45.0, 80.0])
    by_quad = newton_vial(v[:, np.newaxis], alpha0, stop=stop).alpha
    x = position(v[:, np.newaxis], alpha0, by_quad).x
    expected = x / (v[:, np.newaxis] ** 2 * np.sin(2 * alpha0))
    assert table_1.newton_d_norm(v, alpha0, stop) == pytest.approx(expected, rel=1e-9)
    fine = table_1.newton_d_norm(v, alpha0, stop, 0.02)
    assert fine == pytest.approx(expected, rel=1e-5)
    assert np.isnan(table_1.newton_d_norm(np.array([5.0]), alpha0[1:2], stop)).all()


def test_vertical_column_of_the_fits_is_the_closed_form():
    v = np.arange(1, 151) / 100
    exact = (np.arcsinh(v) + np.arctan(v)) / (2 * v * np.sqrt(1 + v * v))
    whole, free = table_1.whole(), table_1.free_errors()
    error = (1 + (whole.K[-1] * v) ** 2 / whole.M[-1]) ** -whole.M[-1] / exact - 1
    assert np.max(np.abs(error)) == pytest.approx(free[-1], rel=1e-6)
    assert free[-1] < 1e-3
    assert free[44] == pytest.approx(0.0016, abs=1e-4)
    assert np.max(free) < 0.002


def test_K_vanishes_as_the_square_root_of_the_angle():
    # weak drag: d_norm = 1 - (4 alpha / 3) v^2 for small angles
    assert table_1.whole().K[0] == pytest.approx(np.sqrt(4 / 3 * np.deg2rad(1)), rel=2e-3)


def test_columns_agree_with_the_fit_angle_by_angle():
    v, alpha0 = np.arange(121) / 100, np.deg2rad([5.0, 45.0, 90.0])
    d = d_norm(v[:, np.newaxis], alpha0)
    K, M = table_1.fit_columns(v, d)
    for i in range(3):
        alone = laws.fit_pearson(v, d[:, i])
        assert (K[i], M[i]) == pytest.approx((alone.K, alone.M), rel=1e-6)
    held, same = table_1.fit_columns(v, d, M=M)
    assert held == pytest.approx(K, rel=1e-9)
    assert same is M or same == pytest.approx(M, rel=1e-15)


@pytest.mark.slow
def test_no_other_setting_gives_the_digits():
    found = table_1.search()
    assert found[0].varied == "nothing"
    near = found[0].fit.curves
    for varied, fit in found[1:]:
        if varied not in ("trapezia", "third stage"):
            assert max(fit.curves) > 2 * max(near), (varied, fit.how)
    assert found[-2].fit.curves[0] > 10 * near[0]
    assert "K within 0.0028 % of print" in table_1.summary(found)
    rows = tables.csv_rows(table_1.search_csv(found))
    assert len(rows) == len(found)
    assert float(rows[0]["stop_deg"]) == pytest.approx(0.573, abs=1e-3)


def test_the_best_polynomials_of_the_degrees_printed():
    assert table_1.least_error(10, 80) == pytest.approx(0.0028, abs=1e-4)
    assert table_1.least_error(15, 80) == pytest.approx(0.0012, abs=1e-4)


def test_the_cubic_is_badly_conditioned():
    near = table_1.conditioning()
    assert near.condition > 100
    assert near.one_angle.max() > 5 * near.curve


# --- the alpha_max law ---


def test_the_angle_law_fitted_again():
    fits = angle_law.search()
    exact, by_law = fits[:2]
    v0 = np.arange(76) * 0.02 * 42.7
    degrees = np.rad2deg(optimal_angle(v0 / 42.7))

    def misfit(K, M):
        return np.sum((45 * (1 + (K * v0) ** 2 / M) ** -M - degrees) ** 2)

    best = misfit(exact.K, exact.M)
    for change in (1 - 1e-4, 1 + 1e-4):
        assert misfit(exact.K * change, exact.M) > best
        assert misfit(exact.K, exact.M * change) > best
    assert best < misfit(laws.ALPHA_MAX_K, laws.ALPHA_MAX_M)
    assert exact.worst < 1e-4
    assert by_law.off[1] > 0.05
    assert min(fit.worst for fit in fits if fit.scan >= 0.1) > 0.0008


def test_the_best_angle_of_the_law_is_its_own_maximum():
    v = np.array([0.8, 1.5])
    best = np.deg2rad(angle_law.best_of_law(v))

    def reach(alpha0):
        return laws.table_1(v, alpha0) * np.sin(2 * alpha0)

    for off in (-1e-3, 1e-3):
        assert np.all(reach(best + off) < reach(best))


# --- its references ---


def test_the_vertical_throw_is_exact():
    assert references.throw_up_misses() < 1e-10


def test_a_cubic_term_that_is_nothing_changes_nothing():
    square = np.rad2deg(float(optimal_angle(1.2)))
    assert references.best_angle_didion(1.2, 1e9) == pytest.approx(square, abs=2e-3)


def test_a_cubic_term_moves_the_best_angle_as_a_scan_says():
    degrees = np.arange(35.0, 42.0, 0.5)
    x = [
        ode.solve(1.5, np.deg2rad(a), 1.0, g=1.0, drag=lambda v: v * v * (1 + v)).x for a in degrees
    ]
    top = np.polyfit(degrees, x, 4)
    best = [r.real for r in np.roots(np.polyder(top)) if 35 < r.real < 42 and abs(r.imag) < 1e-9]
    assert references.best_angle_didion(1.5, 1.0) == pytest.approx(best[0], abs=0.01)


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
    assert table.rms(20, 40) == pytest.approx(np.sqrt((0.001**2 + 0.003**2) / 9))
    assert table.share(0.002, 20, 40) == pytest.approx(8 / 9)
    assert table.fastest(0.1, 10, 40) == 1.0


def test_angle_law_error_is_what_is_known():
    v, error = angle_law.law_error()
    assert v[-1] == 1.5
    assert 100 * np.max(np.abs(error)) == pytest.approx(0.012, abs=5e-4)


def test_legendre_deviation_is_what_is_known():
    deviation = 100 * measure.errors(laws.table_1, np.sqrt([10.0]), np.arange(30.0, 61.0))
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
    exponent = measure.tilting_exponent()
    assert exponent == pytest.approx(3.4147992595, abs=1e-9)
    for n, sign in ((exponent - 0.02, -1), (exponent + 0.02, 1)):
        assert sign * measure.tilt(n, 1e-3 ** (1 / n), 0.5) > 0  # by (16)
    assert measure.tilt(2.0, 0.5) < 0 < measure.tilt(4.0, 0.5)


# --- the verdicts ---


def judged(group):
    return {verdict.id: verdict.holds for verdict in group()}


def test_a_misprinted_angle_law_fails(monkeypatch):
    monkeypatch.setattr(vial, "ALPHA_MAX_K", 0.0085864 * 1.02)
    found = next(claims_of_laws.angle_law_claims())
    assert found.id == "alpha_max_error"
    assert found.holds is False


def test_an_engine_slightly_off_fails(monkeypatch):
    right = measure.speed
    monkeypatch.setattr(measure, "speed", lambda *arguments: (1 + 1e-6) * right(*arguments))
    found = judged(claims._motion)
    assert not found["speed"]
    assert found["arc_length"]


@pytest.mark.parametrize(("ratio", "holds"), [(30_000.0, True), (12.3, False)])
def test_a_timed_claim_says_a_bound(monkeypatch, ratio, holds):
    monkeypatch.setattr(measure, "simplification", lambda: ratio)
    (found,) = [v for v in claims_of_laws.table_1_claims() if v.id == "simplified"]
    assert found.holds is holds
    assert ("more than 1000 times" if holds else "12 times") in found.measured


def test_the_law_is_quicker_than_the_iteration():
    assert measure.simplification() > 100  # it is some ten thousand times


def test_outcome_in_a_word():
    words = [Verdict("i", "p", "c", "p", "m", "d", holds).outcome for holds in (True, False, None)]
    assert words == ["holds", "fails", "not claimed"]


def test_what_is_not_claimed_is_not_counted_as_a_claim():
    made = [Verdict("i", "p", "c", "p", "m", "d", holds) for holds in (True, True, False, None)]
    assert tally(made) == "3 claims: 2 hold, 1 fails; 1 not claimed, measured"


def test_progress_is_told(monkeypatch, caplog):
    groups = tuple((name, lambda: iter(())) for name, _ in claims.GROUPS)
    monkeypatch.setattr(claims, "GROUPS", groups)
    caplog.set_level("INFO", "hodograph")
    assert claims.judge() == []
    assert len(caplog.messages) == len(groups)
