"""The dial: error <= rtol on fresh points, the tiers it picks, and what it refuses."""

import json
from importlib.resources import files

import numpy as np
import pytest

from hodograph import Launch, d_norm, laws, reference, surrogate
from hodograph.tiers import dial

RTOL = [0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-8, 1e-10, 1e-12, 1e-13]
EDGE_V = [
    0.0,
    5e-324,
    1e-200,
    1e-9,
    1.0,
    1.5,
    3.0,
    np.nextafter(3, 4),
    6.0,
    np.nextafter(6, 7),
    10.0,
    np.nextafter(10, 11),
]
EDGE_V += [20.0, 1e8, 1e15, 1e20]
EDGE_A = [0.0, 5e-324, 1e-9, 1e-3, 0.5, 1.2, 1.5707, np.nextafter(np.pi / 2, 0), np.pi / 2]


def launches(seed, n):
    rng = np.random.default_rng(seed)
    v = rng.choice([0.1, 1.5, 6.1, 10.5, 100.0], (7, n)) * rng.random((7, n))
    a = np.pi / 2 * rng.random((7, n))
    part = 10 ** rng.uniform(-14, 0, (4, n))
    v[1] *= part[0]
    v[2] = rng.choice([1.5, 6.0, 10.0], n) * (1 - part[1])
    a[3] *= part[2]
    a[4] = np.pi / 2 * (1 - part[3])
    v[5:] = 10 ** rng.uniform(0, 20, (2, n))
    a[6] *= 10 ** rng.uniform(-300, 0, n)
    edges = np.meshgrid(EDGE_V, EDGE_A)
    return tuple(np.r_[x.ravel(), edge.ravel()] for x, edge in zip((v, a), edges, strict=True))


@pytest.fixture(scope="module")
def fresh(seed):
    v, a = launches(seed, 20_000)
    return v, a, d_norm(v, a)


def test_points_crowd_towards_the_ends(seed):
    v, a = launches(seed, 20_000)
    for end in (1.5, 6.0, 10.0):
        assert np.sum((v < end) & (v > end * (1 - 1e-6))) > 1000
    assert np.sum(np.pi / 2 - a < 1e-6) > 1000


@pytest.mark.parametrize("rtol", RTOL)
def test_the_promise(fresh, rtol):
    v, a, exact = fresh
    assert np.all(np.abs(d_norm(v, a, rtol=rtol) - exact) <= rtol * exact)


def test_the_promise_against_mpmath(seed):
    rng = np.random.default_rng(seed)
    n = 40
    v = np.r_[20 * rng.random(n // 2), 10 ** rng.uniform(-6, 8, n // 2)]
    a = np.pi / 2 * np.r_[rng.random(n - 10), 10 ** rng.uniform(-6, 0, 10)]
    truth = [reference.d_norm(*launch, dps=30) for launch in zip(v, a, strict=True)]
    for rtol in (1e-13, 1e-12, 1e-8, 1e-4, 1e-2):
        found = d_norm(v, a, rtol=rtol).tolist()
        assert max(abs(d / t - 1) for d, t in zip(found, truth, strict=True)) <= rtol


@pytest.mark.parametrize("rtol", [1e-2, 1e-3, 1e-5, 1e-8, 1e-12])
def test_the_promise_of_a_range(rtol, seed):
    rng = np.random.default_rng(seed)
    n = 4000
    v0, v_lim = rng.uniform(0, 400, n), np.where(rng.random(n) < 0.1, np.inf, 60.0)
    height = np.where(rng.random(n) < 0.3, rng.uniform(-10, 50, n), 0.0)
    alpha0 = np.where(height == 0, 1.0, rng.choice([1.0, -1.0], n)) * rng.uniform(0, np.pi / 2, n)
    launch = Launch(v0, alpha0, v_lim, height=height)
    exact, dialled = launch.range(), launch.range(rtol=rtol)
    landed = np.isfinite(exact)
    assert np.array_equal(np.isfinite(dialled), landed)
    assert np.all(np.abs(dialled - exact)[landed] <= rtol * exact[landed])
    other = height != 0
    assert np.array_equal(dialled[other], exact[other], equal_nan=True)


@pytest.mark.parametrize(
    ("v_lim", "g"), [(1e20, 9.81), (1e10, 2.0), (1e15, 1e-20), (1e200, 1e-30), (1e10, 1e30)]
)
def test_a_range_at_the_end_of_the_domain(v_lim, g):
    launch = Launch(1e30, 0.5, v_lim, g=g)
    exact = launch.range()
    for rtol in (1e-1, 1e-2, 1e-6):
        assert launch.range(rtol=rtol) == pytest.approx(exact, rel=rtol)


def test_range_takes_shapes_nan_and_other_drag():
    launch = Launch([[40.0], [np.nan]], [0.5, np.pi / 2, -0.3], 42.7)
    exact, dialled = launch.range(), launch.range(rtol=1e-3)
    assert dialled.shape == exact.shape
    np.testing.assert_allclose(dialled, exact, rtol=1e-3)
    assert np.ndim(Launch(40.0, 0.5, 42.7).range(rtol=1e-3)) == 0
    linear = Launch(40.0, 0.5, 42.7, n=1.0)
    assert linear.range(rtol=1e-3) == pytest.approx(linear.range(), rel=1e-15)
    with pytest.raises(ValueError, match="rtol"):
        launch.range(rtol=0.0)


def test_default_is_exact_and_so_is_every_launch_out_of_reach(fresh):
    v, a, exact = fresh
    assert np.array_equal(d_norm(v, a, method="exact"), exact)
    assert np.array_equal(d_norm(v, a, rtol=1e-6)[v > 10], exact[v > 10])


def test_named_tiers(fresh):
    v, a, _ = fresh
    near = v <= 6
    assert np.array_equal(d_norm(v[near], a[near], method="law"), laws.d_norm_law(v[near], a[near]))
    near = v <= 1e20
    named = d_norm(v[near], a[near], method="law_all")
    assert np.array_equal(named, laws.d_norm_law_all(v[near], a[near]))
    near = v <= 10
    named = d_norm(v[near], a[near], method="surrogate")
    assert np.array_equal(named, surrogate.d_norm(v[near], a[near]))


def test_the_cheapest_that_serves(fresh):
    v, a, _ = fresh
    ways = {
        "law": laws.d_norm_law,
        "law_all": laws.d_norm_law_all,
        "surrogate": surrogate.d_norm,
    }
    column = np.minimum((a / (np.pi / 2) * 32).astype(int), 31)
    for rtol in RTOL:
        answer = d_norm(v, a, rtol=rtol)
        rest = np.ones(v.size, bool)
        for name, way in ways.items():
            bounds = np.full((77, 32), np.inf)
            table = dial.bounds()[name]
            bounds[: len(table)] = table
            if np.mean(bounds <= rtol) < 0.05:
                continue
            row = np.minimum(77 - 77 / (1 + v), 76).astype(int)
            serves = rest & (bounds[row, column] <= rtol)
            assert np.array_equal(answer[serves], way(v[serves], a[serves]))
            rest &= ~serves
        assert np.array_equal(answer[rest], d_norm(v[rest], a[rest]))


def test_what_serves_where():
    """So that a cheap tier is not lost unseen: each answers where its error is known to be less."""
    v = np.array([0.5, 1.4, 4.0, 9.0, 15.0, 1e6])
    served = {
        0.1: ["law", "law", "law", "law_all", "law_all", "law_all"],
        1e-4: ["law", "law", "surrogate", "surrogate", "exact", "exact"],
        1e-9: ["surrogate"] * 4 + ["exact"] * 2,
        1e-13: ["exact"] * 6,
    }
    for rtol, names in served.items():
        numbers = dial.picked(v, np.full(v.size, 0.7), rtol)
        assert [dial.METHODS[number] for number in numbers] == names


def test_order_and_company_do_not_matter(fresh, seed):
    v, a, _ = fresh
    order = np.random.default_rng(seed).permutation(v.size)[:20_000]
    for rtol in (1e-3, 1e-5, 1e-10):
        together = d_norm(v, a, rtol=rtol)
        assert np.array_equal(d_norm(v[order], a[order], rtol=rtol), together[order])
        for i in order[:50]:
            assert d_norm(v[i], a[i], rtol=rtol) == pytest.approx(together[i], rel=4e-15)


def test_shapes_and_nan():
    assert np.ndim(d_norm(1.0, 0.5, rtol=1e-3)) == 0
    assert d_norm(np.ones((3, 1)), np.full(4, 0.5), rtol=1e-3).shape == (3, 4)
    assert d_norm([], 0.5, rtol=1e-3).shape == (0,)
    named = [{"method": name} for name in dial.METHODS]
    for options in ({"rtol": 0.1}, {"rtol": 1e-3}, {"rtol": 1e-8}, *named):
        found = d_norm([np.nan, 1.0, 1.0], [0.5, np.nan, 0.5], **options)
        assert np.isnan(found).tolist() == [True, True, False]


def test_other_drag_is_exact():
    exact = d_norm([0.5, 2.0], 0.5, n=1.5)
    assert np.array_equal(d_norm([0.5, 2.0], 0.5, n=1.5, rtol=1e-2), exact)
    assert np.array_equal(d_norm([0.5, 2.0], 0.5, n=1.5, method="exact"), exact)
    for method in ("law", "law_all", "surrogate"):
        with pytest.raises(ValueError, match=f"n must be 2 for method='{method}'; got 1.5"):
            d_norm(0.5, 0.5, n=1.5, method=method)


@pytest.mark.parametrize(
    ("rtol", "error", "words"),
    [
        (0, ValueError, "rtol must be finite and > 0"),
        (-1e-3, ValueError, "rtol must be finite and > 0"),
        (np.nan, ValueError, "rtol must be finite and > 0"),
        (np.inf, ValueError, "rtol must be finite and > 0"),
        (1e-14, ValueError, "hodograph.reference"),
        ([1e-3, 1e-4], TypeError, "rtol must be one number"),
        ("loose", TypeError, "rtol must be real numbers"),
        (1e-3 + 0j, TypeError, "rtol must be real numbers"),
        (True, TypeError, "rtol must be real numbers"),
    ],
)
def test_bad_rtol(rtol, error, words):
    with pytest.raises(error, match=words):
        d_norm(1.0, 0.5, rtol=rtol)
    with pytest.raises(error, match=words):
        Launch(40.0, 0.5, 42.7).range(rtol=rtol)


def test_bad_method():
    with pytest.raises(ValueError, match="'law', 'law_all', 'surrogate', 'exact'; got"):
        d_norm(1.0, 0.5, method="fast")
    with pytest.raises(TypeError, match="method must be a string"):
        d_norm(1.0, 0.5, method=3)
    with pytest.raises(TypeError, match="rtol and method exclude each other"):
        d_norm(1.0, 0.5, rtol=1e-3, method="law")
    with pytest.raises(ValueError, match=r"v_norm must be in \[0, 6\] for method='law'"):
        d_norm(6.1, 0.5, method="law")
    with pytest.raises(ValueError, match=r"v_norm must be in \[0, 10\] for method='surrogate'"):
        d_norm(10.1, 0.5, method="surrogate")
    with pytest.raises(ValueError, match=r"v_norm must be in \[0, 1e20\]; got 1e\+76"):
        d_norm(1e76, 0.5, method="law_all")


@pytest.mark.parametrize("options", [{"rtol": 1e-3}, {"method": "law"}])
def test_bad_launches_are_refused_as_ever(options):
    with pytest.raises(ValueError, match=r"v_norm must be in \[0, 1e20\]"):
        d_norm(-1.0, 0.5, **options)
    with pytest.raises(ValueError, match="alpha0 must be in"):
        d_norm(1.0, 2.0, **options)
    with pytest.raises(TypeError, match="v_norm"):
        d_norm("fast", 0.5, **options)
    with pytest.raises((TypeError, ValueError), match="n must be"):
        d_norm(1.0, 0.5, n=0.5, **options)


def test_bounds_are_measured_with_a_margin():
    found = json.loads(files("hodograph.tiers").joinpath("bounds.json").read_text())
    assert found["margin"] >= 1.25
    assert found["engine_error"] == dial.PROMISE
    for name, table in dial.bounds().items():
        tier = found["d_norm"][name]
        assert tier["points"] >= 1_000_000
        assert tier["v_max"] == dial.V_MAX[name]
        assert tier["largest"] == table.max()
        assert table.min() >= dial.PROMISE
        assert table.shape == (np.ceil(77 - 77 / (1 + tier["v_max"])), 32)
    assert found["points_per_spline_cell"] >= 100
    assert set(found["landing_angle"]["surrogate"]) == {"v_max", "points", "largest"}


def test_bounds_hold_cell_by_cell(fresh):
    v, a, exact = fresh
    for name, table in dial.bounds().items():
        near = (v <= dial.V_MAX[name]) & (77 - 77 / (1 + v) < len(table))
        cell = dial.cell(v[near], a[near])
        error = np.abs(d_norm(v[near], a[near], method=name) - exact[near])
        assert np.all(error <= table[cell] * exact[near])


@pytest.mark.parametrize("rtol", [0.1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-12])
def test_one_launch_is_answered_as_in_arrays(rtol, seed):
    """By the same tier, in plain floats: none of the ways differs by more than rounding."""
    v, a = (part[::7] for part in launches(seed, 40))
    together = d_norm(v, a, rtol=rtol)
    assert v.size > 16
    for one, these in zip(zip(v.tolist(), a.tolist(), strict=True), together, strict=True):
        assert d_norm(*one, rtol=rtol) == pytest.approx(these, rel=4e-14)


@pytest.mark.parametrize("rtol", [1e-2, 1e-3, 1e-8])
@pytest.mark.parametrize("v", [0.0, 0.3, 1.2, 2.5, 7.0, 50.0, 1e7])
def test_range_of_one_launch(rtol, v):
    for alpha0, height, n in ((0.9, 0.0, 2), (0.9, 3.0, 2), (-0.4, 3.0, 2), (0.9, 0.0, 1)):
        exact = Launch(30 * v, alpha0, 30.0, height=height, n=n).range()
        found = Launch(30 * v, alpha0, 30.0, height=height, n=n).range(rtol=rtol)
        assert type(found) is np.float64
        assert found == pytest.approx(exact, rel=rtol if height == 0 and n == 2 else 1e-15)


def test_ways_of_one_launch():
    for method in ("law", "law_all", "surrogate", "exact"):
        assert d_norm(1.3, 0.6, method=method) == pytest.approx(
            d_norm(np.full(20, 1.3), 0.6, method=method)[0], rel=4e-15
        )
    with pytest.raises(ValueError, match=r"v_norm must be in .0, 6. for method='law'"):
        d_norm(6.1, 0.6, method="law")
    with pytest.raises(ValueError, match="n must be 2"):
        d_norm(1.0, 0.6, n=3, method="law")
    assert d_norm(1.0, 0.6, n=3, rtol=1e-3) == d_norm(1.0, 0.6, n=3)
