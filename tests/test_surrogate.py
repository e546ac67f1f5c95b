"""The surrogate: its promise on fresh points, its limits, its domain, and its file."""

import io
import json
from importlib.resources import files

import numpy as np
import pytest

from hodograph import certify, d_norm, landing_angle, surrogate

EDGE_V = [0.0, 5e-324, 1e-200, 1e-9, 1e-3, 0.5, 1.5, 9.999999, np.nextafter(10, 0), 10.0]
EDGE_A = [0.0, 5e-324, 1e-200, 1e-9, 1e-3, 0.5, 1.2, 1.5707, np.nextafter(np.pi / 2, 0), np.pi / 2]


def launches(seed, n, v_max=surrogate.V_MAX):
    """Fresh points every run: everywhere, and close to each side of the domain."""
    rng = np.random.default_rng(seed)
    v, a = v_max * rng.random((5, n)), np.pi / 2 * rng.random((5, n))
    part = 10 ** rng.uniform(-14, 0, (4, n))
    v[1] *= part[0]
    v[2] *= 1 - part[1]
    a[3] *= part[2]
    a[4] *= 1 - part[3]
    edges = np.meshgrid(np.minimum(EDGE_V, v_max), EDGE_A)
    return tuple(np.r_[x.ravel(), edge.ravel()] for x, edge in zip((v, a), edges, strict=True))


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
    found = json.loads(files("hodograph").joinpath("bounds.json").read_text())
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
        assert function(v[i], a[i]) == together[i]
    assert np.array_equal(function(v[::-3], a[::-3]), together[::-3])


def test_file_is_small_and_says_where_it_is_from():
    content = files("hodograph").joinpath("surrogate.npz").read_bytes()
    assert len(content) <= 500_000
    about = surrogate.load().about
    assert "hodograph 0." in about
    assert certify.COMMAND in about
    assert surrogate.load() is surrogate.load()


def test_bounds_belong_to_the_file():
    import hashlib

    found = json.loads(files("hodograph").joinpath("bounds.json").read_text())
    content = files("hodograph").joinpath("surrogate.npz").read_bytes()
    assert found["surrogate_sha256"] == hashlib.sha256(content).hexdigest(), certify.COMMAND


def test_remade_the_same(seed):
    content = certify.build()
    assert certify.build() == content
    tables = surrogate.parse(content)
    with np.load(io.BytesIO(content)) as data:
        assert sorted(data) == ["S", "T", "about"]
    # another machine may round the last digits otherwise
    v, a = launches(seed, 2000)
    for kernel in (surrogate.flat_d_norm, surrogate.flat_landing_angle):
        np.testing.assert_allclose(kernel(v, a, tables), kernel(v, a), rtol=1e-11)


@pytest.mark.slow
def test_command_remakes_both_files(tmp_path):
    for path in certify.write(tmp_path):
        there = files("hodograph").joinpath(path.name)
        if path.suffix == ".npz":
            assert path.read_bytes() == certify.build()
            continue
        new, old = json.loads(path.read_text()), json.loads(there.read_text("utf-8"))
        for quantity in ("d_norm", "landing_angle"):
            for name, tier in old[quantity].items():
                found = new[quantity][name]
                assert found["points"] == tier["points"]
                np.testing.assert_allclose(found["bounds"], tier["bounds"], rtol=0.02, atol=1e-13)


@pytest.mark.slow
def test_points_of_the_certificate():
    v, a = certify.points(10.0)
    assert v.size >= 1_000_000
    assert v.min() == 0
    assert v.max() <= 10
    assert a.min() == 0
    assert a.max() <= np.pi / 2


@pytest.mark.slow
def test_candidates_are_compared():
    rows = certify.compare()
    chosen, exact = rows[-2], rows[-1]
    assert chosen.error <= 1e-9
    assert chosen.microseconds <= exact.microseconds / 6
    assert certify.comparison(rows).count("\n") == len(rows) + 3


def test_command_refuses_to_replace_before_it_works(tmp_path, capsys):
    from hodograph.cli import main

    (tmp_path / "bounds.json").write_text("kept")
    assert main(["surrogate", "--out", str(tmp_path)]) == 1
    assert "exists" in capsys.readouterr().err
    (tmp_path / "dial.csv").write_text("kept")
    assert main(["surrogate", "--compare", "--out", str(tmp_path)]) == 1
    assert sorted(path.read_text() for path in tmp_path.iterdir()) == ["kept", "kept"]
