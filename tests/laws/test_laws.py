"""The paper's laws as printed, and fits that must give back what made the data."""

import numpy as np
import pytest

from hodograph import d_norm, laws, optimal_angle, reference
from hodograph.laws import formula


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


# --- the library's own laws: judged between the points of their fits -----------------------------

V = np.linspace(0.0013, 1.5, 97)[:, np.newaxis]
ANGLES = np.concatenate([[0.0, 1e-300, 1e-9, 1e-4], np.linspace(0.0021, np.pi / 2, 137)])


def test_first_order():
    # the closed form, and what the exact d_norm does for weak drag
    a = np.deg2rad([0.5, 5.0, 45.0, 80.0, 89.9])
    S, C = np.sin(a), np.cos(a)
    c1 = 3 * S / 4 + C**2 / (8 * S) + np.arctanh(S) * C**2 * (1 / 2 - C**2 / (8 * S**2))
    np.testing.assert_allclose(laws.first_order(a), c1, rtol=1e-9)
    for angle in ("0.3", "1.1"):
        slope = (1 - reference.d_norm("1e-8", angle, dps=40)) / 1e-16
        assert laws.first_order(float(angle)) == pytest.approx(float(slope), rel=1e-11)
    assert laws.first_order([0.0, np.pi / 2]).tolist() == [0.0, 0.75]
    np.testing.assert_allclose(laws.first_order([1e-12, 1e-5]), [4e-12 / 3, 4e-5 / 3], rtol=1e-7)


def test_d_norm_law():
    error = laws.d_norm_law(V, ANGLES) / d_norm(V, ANGLES) - 1
    assert np.abs(error).max() < 7.75e-5
    assert (laws.d_norm_law(V, 0.0) == 1).all()
    assert (laws.d_norm_law(0.0, ANGLES) == 1).all()
    weak = (1 - laws.d_norm_law(1e-4, ANGLES[4:])) / 1e-8
    np.testing.assert_allclose(weak, laws.first_order(ANGLES[4:]), rtol=1e-5)
    for v, least, most in ((2.0, 0.0010, 0.0015), (3.0, 0.010, 0.0135)):  # as the docstring says
        assert least < np.abs(laws.d_norm_law(v, ANGLES) / d_norm(v, ANGLES) - 1).max() < most
    by_reference = float(reference.d_norm("1.5", "1.0"))
    assert laws.d_norm_law(1.5, 1.0) == pytest.approx(by_reference, rel=8e-5)


def test_d_norm_law_all():
    v = np.concatenate([V[::3, 0], np.geomspace(1.53, 1e4, 120), np.geomspace(1.1e4, 1e20, 60)])
    error = laws.d_norm_law_all(v[:, np.newaxis], ANGLES[2:]) / d_norm(v[:, np.newaxis], ANGLES[2:])
    assert np.abs(error - 1).max() < 0.0086
    assert (laws.d_norm_law_all(v, 0.0) == 1).all()
    assert (laws.d_norm_law_all(0.0, ANGLES) == 1).all()
    weak = (1 - laws.d_norm_law_all(1e-4, ANGLES[4:])) / 1e-8
    np.testing.assert_allclose(weak, laws.first_order(ANGLES[4:]), rtol=1e-5)
    # strong drag: d g / v_lim^2 = cos(alpha0) (ln v + a constant)
    for a in (0.3, 0.8, 1.5):
        speeds = np.array([1e10, 1e20])
        low, high = laws.d_norm_law_all(speeds, a) * speeds**2 * np.sin(2 * a)
        assert (high - low) / np.cos(a) == pytest.approx(10 * np.log(10), rel=1e-3)


def test_d_norm_law_all_at_the_ends_of_its_domain():
    assert laws.d_norm_law_all(1e-320, 0.5) == 1
    assert laws.d_norm_law_all(1e-8, 1e-310) == 1
    assert laws.d_norm_law_all(1e20, 0.0) == 1
    for v, alpha0 in ((1e20, 1e-35), (1e18, 1e-30)):  # v^2 alpha0 alone counts
        square = v * (v * alpha0)
        gentle = d_norm(1e6, square / 1e12)
        assert laws.d_norm_law_all(v, alpha0) == pytest.approx(gentle, rel=0.0086)
    assert laws.d_norm_law_all(1e20, 0.5) == pytest.approx(d_norm(1e20, 0.5), rel=1e-3)


def test_alpha_max_law():
    v = np.linspace(0, 10, 1237)
    assert np.abs(laws.alpha_max_law(v) / optimal_angle(v) - 1).max() < 9.7e-5
    for top, bound in ((1e3, 3e-3), (1e6, 4.9e-3), (1e10, 9e-3)):
        far = np.geomspace(10, top, 57)
        assert np.abs(laws.alpha_max_law(far) / optimal_angle(far) - 1).max() < bound
    assert laws.alpha_max_law(0.0) == np.pi / 4
    everywhere = laws.alpha_max_law(np.geomspace(1e-3, 1e20, 500))
    assert np.all(np.diff(everywhere) < 0)
    assert np.all(everywhere > 0)


@pytest.mark.parametrize("law", [laws.d_norm_law, laws.d_norm_law_all])
def test_laws_broadcast(law):
    assert np.ndim(law(1, 1)) == 0
    assert law([0.5, 1.0], [[0.2], [0.4], [0.6]]).shape == (3, 2)
    assert law([], 0.5).shape == (0,)
    many = np.linspace(0, 1.5, 3 * formula.BLOCK + 7)
    np.testing.assert_array_equal(law(many, 0.7)[[0, 5000, -1]], law(many[[0, 5000, -1]], 0.7))
    assert np.isnan(law([np.nan, 1.0], [1.0, np.nan])).all()
    for bad in ((-1.0, 0.5), (1.0, -0.1), (1.0, 1.6), (np.inf, 0.5)):
        with pytest.raises(ValueError, match=r"v_norm|alpha0"):
            law(*bad)


LAWS = {
    "d_norm_law": 2,
    "d_norm_law_all": 2,
    "table_1": 2,
    "first_order": "alpha0",
    "alpha_max_law": "v_norm",
    "alpha_max_vial": "v_norm",
}


@pytest.mark.parametrize("name", LAWS)
def test_a_launch_alone_is_within_ulps_of_the_array(name, seed):
    """Scalars are computed in plain floats: the same formula with the functions of `math`."""
    rng = np.random.default_rng(seed)
    v = np.r_[0.0, 1e-300, 1e20, 10 ** rng.uniform(-9, 20, 300), rng.uniform(0, 2, 700)]
    a = np.pi / 2 * rng.permutation(np.r_[0.0, 1e-300, 1e-9, 1e-5, 1 - 1e-9, 1, rng.random(997)])
    arguments = (v, a) if LAWS[name] == 2 else (a,) if LAWS[name] == "alpha0" else (v,)
    law = getattr(laws, name)
    together = law(*arguments)
    alone = np.array([law(*one) for one in zip(*map(np.ndarray.tolist, arguments), strict=True)])
    # d_norm is exp(-M ln(...)), and the rounding of the exponent grows with it
    room = 8 + 2 * np.abs(np.log(np.maximum(together, 1e-300)))
    if name in ("first_order", "d_norm_law", "d_norm_law_all"):
        # c1 is in them, whose two largest terms cancel towards the horizontal
        room += 1 / np.maximum(np.sin(a), 1e-4) ** 2
    assert np.all(np.abs(alone - together) <= room * np.spacing(together))


@pytest.mark.parametrize("M", [1e-3, 0.7, 1e12, np.inf])
@pytest.mark.parametrize("x", [0.0, -1.3, 1e200])
def test_pearson_alone(x, M):
    together = laws.pearson_vii([x], 0.9, M, 2.0)[0]
    assert laws.pearson_vii(x, 0.9, M, 2.0) == pytest.approx(together, rel=1e-15)


@pytest.mark.parametrize("name", LAWS)
def test_a_law_of_one_number_of_any_type(name):
    """The same bits for an int, a single and a 0-d array; NaN is passed on."""
    law = getattr(laws, name)
    count = 2 if LAWS[name] == 2 else 1
    found = law(*[1.0] * count)
    assert type(found) is np.float64
    for one in (1, np.float64(1), np.float32(1), np.array(1.0)):
        assert law(*[one] * count) == found
        assert type(law(*[one] * count)) is np.float64
    assert np.isnan(law(*[np.nan] * count))
