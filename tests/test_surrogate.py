"""The surrogate: its promise on fresh points, its limits, its domain, and its file."""

import io
import json
from importlib.resources import files

import numpy as np
import pytest

import hodograph
from hodograph import d_norm, landing_angle, surrogate
from hodograph.builders import certificate as certify
from hodograph.builders import interpolants as candidates
from hodograph.engine import position
from hodograph.tiers import dial, interpolant

EDGE_V = [0.0, 5e-324, 1e-200, 1e-9, 1e-3, 0.5, 1.5, 9.999999, np.nextafter(10, 0), 10.0]
EDGE_A = [0.0, 5e-324, 1e-200, 1e-9, 1e-3, 0.5, 1.2, 1.5707, np.nextafter(np.pi / 2, 0), np.pi / 2]


def launches(seed, n, v_max=interpolant.V_MAX):
    """Fresh points every run: everywhere, and close to each side of the domain."""
    rng = np.random.default_rng(seed)
    v, a = v_max * rng.random((5, n)), np.pi / 2 * rng.random((5, n))
    part = 10 ** rng.uniform(-14, 0, (4, n))
    v[1] *= part[0]
    v[2] = v_max * (1 - part[1])
    a[3] *= part[2]
    a[4] = np.pi / 2 * (1 - part[3])
    edges = np.meshgrid(np.minimum(EDGE_V, v_max), EDGE_A)
    return tuple(np.r_[x.ravel(), edge.ravel()] for x, edge in zip((v, a), edges, strict=True))


def test_points_crowd_towards_the_ends(seed):
    v, a = launches(seed, 10_000)
    assert np.sum(10 - v < 1e-6) > 1000
    assert np.sum(v < 1e-6) > 1000
    assert np.sum(np.pi / 2 - a < 1e-6) > 1000
    assert np.sum(a < 1e-6) > 1000


@pytest.mark.parametrize(
    ("cheap", "exact"),
    [(surrogate.d_norm, d_norm), (surrogate.landing_angle, landing_angle)],
    ids=["d_norm", "landing_angle"],
)
def test_error_is_at_most_1e_9(cheap, exact, seed):
    v, a = launches(seed, 40_000)
    truth = exact(v, a)
    assert np.all(np.abs(cheap(v, a) - truth) <= 1e-9 * np.abs(truth))


def test_bounds_of_the_file_hold(seed):
    found = json.loads(files("hodograph.tiers").joinpath("bounds.json").read_text())
    for name, exact in (("d_norm", d_norm), ("landing_angle", landing_angle)):
        largest = found[name]["surrogate"]["largest"]
        assert found[name]["surrogate"]["points"] >= 1_000_000
        assert largest <= 1e-9
        v, a = launches(seed, 20_000)
        truth = exact(v, a)
        assert np.all(np.abs(getattr(surrogate, name)(v, a) - truth) <= largest * np.abs(truth))


def test_limits_are_exact():
    a = np.linspace(0, np.pi / 2, 1001)
    assert np.all(surrogate.d_norm(0.0, a) == 1)
    assert np.all(surrogate.landing_angle(0.0, a) == -a)
    v = np.linspace(0, 10, 1001)
    assert np.all(surrogate.d_norm(v, 0.0) == 1)
    assert np.all(surrogate.landing_angle(v, 0.0) == 0)


def test_results_stay_in_their_ranges(seed):
    v, a = launches(seed, 20_000)
    d, alpha = surrogate.d_norm(v, a), surrogate.landing_angle(v, a)
    assert np.all((d > 0) & (d <= 1))
    assert np.all((alpha <= -a) & (alpha >= -np.pi / 2))


@pytest.mark.parametrize("function", [surrogate.d_norm, surrogate.landing_angle])
def test_steps_aside_beyond_its_domain(function):
    for v in (np.nextafter(10, 11), 1e300):
        with pytest.raises(ValueError, match=r"v_norm must be in \[0, 10\] for the surrogate"):
            function(v, 0.5)
    with pytest.raises(ValueError, match="alpha0 must be in"):
        function(1.0, -0.1)
    with pytest.raises(TypeError, match="v_norm"):
        function("fast", 0.5)


@pytest.mark.parametrize("function", [surrogate.d_norm, surrogate.landing_angle])
def test_shapes_nan_and_order(function, seed):
    assert np.ndim(function(1.0, 0.5)) == 0
    assert function(np.ones((3, 1)), np.full(4, 0.5)).shape == (3, 4)
    assert function([], 0.5).shape == (0,)
    assert np.isnan(function([np.nan, 1.0], [0.5, np.nan])).all()
    v, a = launches(seed, 5000)
    together = function(v, a)
    order = np.random.default_rng(seed).permutation(v.size)
    assert np.array_equal(function(v[order], a[order]), together[order])
    for i in order[:200]:
        assert function(v[i], a[i]) == pytest.approx(together[i], rel=4e-15)
    assert np.array_equal(function(v[::-3], a[::-3]), together[::-3])


def test_file_is_small_and_says_where_it_is_from():
    content = files("hodograph.tiers").joinpath("surrogate.npz").read_bytes()
    assert len(content) <= 500_000
    about = interpolant.load().about
    assert f"hodograph {hodograph.__version__}," in about
    assert certify.COMMAND in about
    assert interpolant.load() is interpolant.load()


def test_bounds_belong_to_the_file():
    import hashlib

    found = json.loads(files("hodograph.tiers").joinpath("bounds.json").read_text())
    content = files("hodograph.tiers").joinpath("surrogate.npz").read_bytes()
    assert found["surrogate_sha256"] == hashlib.sha256(content).hexdigest(), certify.COMMAND


def test_remade_the_same(seed):
    content = certify.build()
    assert certify.build() == content
    tables = interpolant.parse(content)
    with np.load(io.BytesIO(content)) as data:
        assert sorted(data) == ["S", "T", "about"]
    # another machine may round the last digits otherwise
    v, a = launches(seed, 2000)
    for kernel in (interpolant.flat_d_norm, interpolant.flat_landing_angle):
        np.testing.assert_allclose(kernel(v, a, tables), kernel(v, a), rtol=1e-11)


@pytest.mark.slow
def test_command_remakes_both_files(tmp_path):
    coefficients, bounds = certify.write(tmp_path)
    packaged = files("hodograph.tiers")
    found = interpolant.parse(coefficients.read_bytes())
    kept = interpolant.parse(packaged.joinpath("surrogate.npz").read_bytes())
    assert found.about == kept.about
    inside = (slice(2, -2), slice(2, -2))  # the outermost hang on less, and show more rounding
    for name in ("S", "T"):
        again, there = getattr(found, name), getattr(kept, name)
        np.testing.assert_allclose(again, there, rtol=0, atol=1e-9)
        np.testing.assert_allclose(again[inside], there[inside], rtol=0, atol=3e-12)

    new = json.loads(bounds.read_text())
    old = json.loads(packaged.joinpath("bounds.json").read_text("utf-8"))
    for key in ("engine", "margin", "engine_error", "points_per_spline_cell", "cells"):
        assert new[key] == old[key]
    for quantity in ("d_norm", "landing_angle"):
        assert set(new[quantity]) == set(old[quantity])
        for name, tier in old[quantity].items():
            again = new[quantity][name]
            assert again["points"] == pytest.approx(tier["points"], rel=1e-3)
            assert again["largest"] == pytest.approx(tier["largest"], rel=0.05)
            if "bounds" in tier:
                np.testing.assert_allclose(again["bounds"], tier["bounds"], rtol=0.05, atol=1e-13)


@pytest.fixture(scope="module")
def certificate():
    return certify.points()


@pytest.mark.slow
def test_points_of_the_certificate_crowd_towards_the_ends(certificate):
    v, a = certificate.v, certificate.a0
    assert v.size >= 1_000_000
    assert (v.min(), a.min(), a.max()) == (0, 0, np.pi / 2)
    assert v.max() == pytest.approx(1e20)
    assert np.sum(v < 1e-6) > 10_000
    for end in (6.0, 10.0):
        assert np.sum((v <= end) & (end - v < 1e-6)) > 10_000
    assert np.sum(a < 1e-6) > 10_000
    assert np.sum(np.pi / 2 - a < 1e-6) > 10_000
    decades = np.histogram(np.log10(v[v >= 10]), np.arange(1, 21))[0]
    assert decades.min() > 1000


@pytest.mark.slow
def test_every_cell_has_points_inside_and_on_all_four_edges(certificate):
    v, a, row, column = certificate
    down, across = 77 * v / (1 + v) - row, a / (np.pi / 2) * 32 - column  # from 0 to 1
    own = row * 32 + column

    def least(where):
        return np.bincount(own[where], minlength=77 * 32).min()

    assert np.all((np.abs(down - 0.5) <= 0.5 + 1e-9) & (np.abs(across - 0.5) <= 0.5 + 1e-9))
    for place in (down, across):
        for end in (0.0, 1.0):
            edge = np.abs(place - end) < 1e-9
            assert least(edge) >= 64
            for corner in (0.0, 1.0):
                other = across if place is down else down
                assert least(edge & (np.abs(other - corner) < 1e-9)) >= 1
    assert least((np.abs(down - 0.5) < 0.49) & (np.abs(across - 0.5) < 0.49)) >= 900


@pytest.mark.slow
def test_every_cell_of_the_spline_has_points(certificate):
    v, a = certificate.v, certificate.a0
    v, a = v[v <= 10], a[v <= 10]
    X = np.log(1 + v**2) / np.log(101)
    Y = np.log(1 + 200 * np.sin(a)) + 4 * (1 - np.cos(a) ** 0.25)
    at = np.minimum((X * 40).astype(int), 39), np.minimum(Y / (np.log(201) + 4) * 120, 119)
    count = np.bincount(at[0] * 120 + at[1].astype(int), minlength=4800)
    assert count.size == 4800
    found = json.loads(files("hodograph.tiers").joinpath("bounds.json").read_text("utf-8"))
    assert abs(count.min() - found["points_per_spline_cell"]) <= 2  # which side of an edge
    assert count.min() >= 100


@pytest.mark.slow
def test_candidates_are_compared():
    rows = candidates.compare()
    chosen, exact = rows[-2], rows[-1]
    assert chosen.error <= 1e-9
    assert chosen.microseconds <= exact.microseconds / 6
    assert candidates.comparison(rows).count("\n") == len(rows) + 3


def test_command_refuses_to_replace_before_it_works(tmp_path, capsys):
    from hodograph.cli.commands import main

    (tmp_path / "bounds.json").write_text("kept")
    assert main(["surrogate", "--out", str(tmp_path)]) == 1
    assert "exists" in capsys.readouterr().err
    (tmp_path / "dial.csv").write_text("kept")
    assert main(["surrogate", "--compare", "--out", str(tmp_path)]) == 1
    assert sorted(path.read_text() for path in tmp_path.iterdir()) == ["kept", "kept"]


def test_tables_cannot_be_changed():
    tables = interpolant.load()
    for table in (tables.S, tables.T, *dial.bounds().values(), *position.gauss_legendre(6)):
        with pytest.raises(ValueError, match="read-only"):
            table *= 1.01
