"""The table of d_norm and its files."""

import numpy as np
import pytest
from helpers import DATA

from hodograph import grid, reference


@pytest.fixture(scope="module")
def table():
    return grid.tabulate()


def test_axes_and_values(table):
    assert table.d_norm.shape == (151, 91)
    np.testing.assert_array_equal(table.v_norm, np.arange(151) / 100)
    np.testing.assert_allclose(np.rad2deg(table.alpha0), np.arange(91), rtol=1e-15)
    assert np.all(table.d_norm[0] == 1)
    assert np.all(table.d_norm[:, 0] == 1)
    for i, j in [(1, 1), (50, 30), (100, 45), (150, 89), (150, 90), (77, 13)]:
        truth = reference.d_norm(table.v_norm[i], table.alpha0[j])
        assert table.d_norm[i, j] == pytest.approx(float(truth), rel=1e-13)


def test_files_give_back_the_table(table, tmp_path):
    read = grid.load(grid.save_npz(table, tmp_path / "a.npz"))
    np.testing.assert_array_equal(read.v_norm, table.v_norm)
    np.testing.assert_array_equal(read.alpha0, table.alpha0)
    np.testing.assert_allclose(read.d_norm, table.d_norm, atol=1e-13)
    csv = grid.save_csv(table, tmp_path / "a.csv")
    rows = np.loadtxt(csv, delimiter=",", skiprows=5)
    assert rows.shape == (151 * 91, 3)
    np.testing.assert_allclose(rows[:, 2], table.d_norm.ravel(), atol=1e-13)
    header = csv.read_text().split("v_norm,alpha0_deg")[0]
    for word in ("hodograph", "tolerance", "degrees", "remade by: hodograph grid"):
        assert word in header


@pytest.mark.parametrize("save", [grid.save_npz, grid.save_csv])
def test_rewriting_gives_the_same_bytes(table, tmp_path, save):
    first = save(table, tmp_path / "first").read_bytes()
    assert save(grid.tabulate(), tmp_path / "second").read_bytes() == first


@pytest.mark.parametrize("save", [grid.save_npz, grid.save_csv])
def test_never_over_another_file(table, tmp_path, save):
    path = tmp_path / "kept"
    path.write_text("precious")
    with pytest.raises(FileExistsError, match="kept"):
        save(table, path)
    assert path.read_text() == "precious"
    save(table, path, force=True)
    assert path.read_bytes() != b"precious"
    assert [p.name for p in tmp_path.iterdir()] == ["kept"]  # nothing left beside it


def test_the_repository_holds_this_table(table, tmp_path):
    # byte for byte with the NumPy that wrote it; with another, to the last decimal
    made, kept = grid.save_csv(table, tmp_path / "new.csv"), DATA / "d_norm.csv"
    assert made.read_text().splitlines()[:6] == kept.read_text().splitlines()[:6]
    if np.lib.NumpyVersion(np.__version__) >= "2.4.0":
        assert made.read_bytes() == kept.read_bytes()
    rows, ours = (np.loadtxt(path, delimiter=",", skiprows=5) for path in (kept, made))
    np.testing.assert_allclose(ours, rows, rtol=1e-14, atol=1.1 * 10.0**-grid.DECIMALS)
    np.testing.assert_allclose(
        grid.load(DATA / "d_norm.npz").d_norm, table.d_norm, atol=0.6 * 10.0**-grid.DECIMALS
    )


@pytest.mark.parametrize("axes", [{"v_norm": 1.0}, {"alpha0": [[0.1]]}])
def test_axes_are_one_dimensional(axes):
    with pytest.raises(ValueError, match="1-D axis"):
        grid.tabulate(**axes)


def test_the_repository_s_files_keep_their_tolerance(seed):
    """The relative tolerance that their headers print, at cells drawn afresh."""
    read = grid.load(DATA / "d_norm.npz")
    rows = np.loadtxt(DATA / "d_norm.csv", delimiter=",", skiprows=5)[:, 2]
    rows = rows.reshape(read.d_norm.shape)
    assert f"relative tolerance {grid.TOLERANCE:g}" in (DATA / "d_norm.csv").read_text()[:200]
    rng = np.random.default_rng(seed)
    for i, j in zip(rng.integers(0, 151, 12), rng.integers(0, 91, 12), strict=True):
        truth = float(reference.d_norm(read.v_norm[i], read.alpha0[j]))
        for found in (read.d_norm[i, j], rows[i, j]):
            assert found == pytest.approx(truth, rel=grid.TOLERANCE, abs=0)


@pytest.mark.parametrize("kind", ["text", "empty", "npy", "npz", "broken", "shapes"])
def test_another_file_is_refused_in_one_line(tmp_path, kind):
    path = tmp_path / f"other.{kind}"
    with path.open("wb") as file:
        if kind == "text":
            file.write(b"v_norm,alpha0\n0,1\n")
        elif kind == "npy":
            np.save(file, np.ones(3))
        elif kind == "npz":
            np.savez(file, v_norm=np.ones(3))
        elif kind == "broken":
            file.write(b"PK\x03\x04 and no more")
        elif kind == "shapes":
            np.savez(file, v_norm=np.ones(3), alpha0=np.ones(2), d_norm=np.ones((2, 3)))
    with pytest.raises(ValueError, match="path must be a file that save_npz wrote") as caught:
        grid.load(path)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(FileNotFoundError, match="none"):
        grid.load(tmp_path / "none.npz")
