"""The paper's laws as printed, and fits that must give back what made the data."""

import numpy as np
import pytest

from hodograph import laws, optimal_angle


def test_pearson_vii_between_lorentzian_and_gaussian():
    x = np.linspace(-3, 3, 13)
    np.testing.assert_allclose(laws.pearson_vii(x, 2.0, 1.0), 1 / (1 + 4 * x * x), rtol=1e-15)
    np.testing.assert_allclose(laws.pearson_vii(x, 2.0, np.inf), np.exp(-4 * x * x), rtol=1e-15)
    np.testing.assert_allclose(laws.pearson_vii(x, 0.5, 1e9), np.exp(-x * x / 4), rtol=1e-8)
    assert laws.pearson_vii(0.0, 1.0, 1.0, 45.0) == 45.0


def test_table_1_by_hand():
    # at alpha0 = 1 rad the polynomials are the sums of their coefficients
    K, M = 0.24207 + 1.56854 - 1.16548 + 0.26454, 0.675688 + 0.046397 + 0.031539
    assert laws.table_1(1.2, 1.0) == pytest.approx((1 + K * K * 1.44 / M) ** -M, rel=1e-14)
    assert laws.table_1(0.0, 0.5) == 1.0


def test_alpha_max_law_by_hand_and_against_the_optimum():
    v0 = 50.0
    by_hand = np.pi / 4 * (1 + (0.0085864 * v0) ** 2 / 0.1366571) ** -0.1366571
    assert laws.alpha_max_vial(v0) == pytest.approx(by_hand, rel=1e-14)
    speeds = np.linspace(0, 1.5 * 42.7, 30)  # "below 0.08 %"
    off = laws.alpha_max_vial(speeds) / optimal_angle(speeds / 42.7) - 1
    assert np.abs(off).max() < 8e-4


@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize(("K", "M"), [(0.3, 0.68), (0.9, 0.72), (0.0085864, 0.1366571)])
def test_pearson_fit_recovers(K, M, relative):
    x = np.linspace(0, 1.35 / K, 40)
    fit = laws.fit_pearson(x, 3 * laws.pearson_vii(x, K, M), h=3.0, relative=relative)
    assert pytest.approx(K, rel=1e-8) == fit.K
    assert pytest.approx(M, rel=1e-7) == fit.M
    assert np.abs(fit.residuals).max() < 1e-12


def test_pearson_fit_is_a_minimum():
    # perturbed data: the sum of squares rises on every side of the fit
    rng = np.random.default_rng(3)
    x = np.linspace(0, 1.5, 30)
    y = laws.pearson_vii(x, 0.9, 0.7) + rng.normal(0, 1e-3, x.size)
    fit = laws.fit_pearson(x, y)
    least = np.sum(fit.residuals**2)
    for dK, dM in [(1e-4, 0), (-1e-4, 0), (0, 1e-3), (0, -1e-3)]:
        assert np.sum((laws.pearson_vii(x, fit.K + dK, fit.M + dM) - y) ** 2) > least


def test_polynomial_fit_recovers_table_1():
    alpha0 = np.deg2rad(np.arange(1, 91))
    K = sum(a * alpha0**i for i, a in enumerate(laws.TABLE_1_K))
    fit = laws.fit_polynomial(alpha0, K, 3)
    np.testing.assert_allclose(fit.coefficients, laws.TABLE_1_K, rtol=1e-11)
    assert np.abs(fit.residuals).max() < 1e-13


@pytest.mark.parametrize(
    ("x", "y"), [([0, 1], [1]), ([[0, 1]], [[1, 2]]), ([1], [1]), ([0, np.nan], [1, 1])]
)
def test_bad_data(x, y):
    with pytest.raises(ValueError, match="x"):
        laws.fit_pearson(x, y)
