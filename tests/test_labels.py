"""Labelled, lazy and dimensioned input: refused in one line, or taken where nothing is lost.

The packages that make such input are no dependency.  Stand-ins carry what the library looks at,
the module and the name of the type, and how attributes are found; where a package is installed,
the real thing is tried as well.
"""

import numpy as np
import pytest

from hodograph import Launch, d_norm, grid, laws, steppers
from hodograph.sensitivity import range_sensitivity

VALUES = np.array([0.5, 1.0, 1.5])
PLAIN = d_norm(VALUES, 0.5)


class Array:
    """Holds values and gives them to NumPy without a word."""

    def __init__(self, values):
        self.values = np.asarray(values, dtype=float)

    def __array__(self, dtype=None, copy=None):
        return self.values

    def __len__(self):
        return len(self.values)


def made_by(package, kind, base=Array):
    return type(kind, (base,), {"__module__": f"{package}.core"})


class Labelled(Array):
    """As pandas and xarray do, finds labels as if they were attributes."""

    labels = ("units", "unit", "a")

    def __getattr__(self, name):
        if name in Labelled.labels:
            return "m"
        raise AttributeError(name)


class Index(tuple):
    def equals(self, other):
        return self == other


class Indexed(Labelled):
    def __init__(self, values, index):
        super().__init__(values)
        self.index = Index(index)


Series = made_by("pandas", "Series", Indexed)


def refusals(name, value):
    """The message of every way in."""
    calls = [
        lambda: d_norm(value, 0.5),
        lambda: d_norm(1.0, [value]),
        lambda: Launch(value, 0.5, 1.0),
        lambda: Launch(1.0, 0.5, 1.0, height=value),
        lambda: Launch.from_drag(1.0, 0.5, value),
        lambda: grid.tabulate(value),
        lambda: range_sensitivity(value, 0.5, 1.0),
        lambda: laws.table_1(value, 0.5),
        lambda: laws.fit_pearson(value, VALUES),
        lambda: steppers.integrate(value, 0.5, 1.0, dt=0.1),
    ]
    for call in calls:
        with pytest.raises(TypeError, match=name) as caught:
            call()
        message = str(caught.value)
        assert "\n" not in message
        yield message


@pytest.mark.parametrize("kind", ["DataArray", "Dataset", "Variable"])
def test_xarray_is_refused(kind):
    child = type("Mine", (made_by("xarray", kind),), {"__module__": "mine"})
    with pytest.raises(TypeError, match="v_norm is an xarray Mine, "):
        d_norm(child(VALUES), 0.5)
    for message in refusals(kind, made_by("xarray", kind)(VALUES)):
        assert "xarray.apply_ufunc" in message


def test_dask_is_refused():
    for message in refusals("Array", made_by("dask", "Array")(VALUES)):
        assert "dask.array.map_blocks" in message


def test_series_of_one_index_pass():
    v, alpha0 = Series(VALUES, "abc"), Series([0.5, 0.5, 0.5], "abc")
    for found in (d_norm(v, alpha0), d_norm(v, 0.5), d_norm(v, [0.5] * 3), d_norm([v], alpha0)[0]):
        assert type(found) is np.ndarray
        np.testing.assert_array_equal(found, PLAIN)
    np.testing.assert_array_equal(Launch(v, alpha0, 1.0).v0, VALUES)


@pytest.mark.parametrize("index", ["cba", "abd", "ab"])
def test_series_of_other_indices_are_refused(index):
    v, other = Series(VALUES, "abc"), Series([0.5] * len(index), index)
    for call in (
        lambda: d_norm(v, other),
        lambda: d_norm(v, other, rtol=1e-3),
        lambda: d_norm([v, Series(VALUES, "abc")], [other]),
        lambda: Launch(v, 0.5, 1.0, height=other),
        lambda: Launch.from_drag(v, 0.5, other),
        lambda: range_sensitivity(v, other, 1.0),
        lambda: laws.fit_pearson(v, other),
        lambda: steppers.integrate(v, other, 1.0, dt=0.1),
    ):
        with pytest.raises(ValueError, match=r"pandas Series with different indices: align"):
            call()


def test_a_label_called_units_makes_no_quantity():
    np.testing.assert_array_equal(d_norm(Labelled(VALUES), 0.5), PLAIN)
    np.testing.assert_array_equal(d_norm(Series(VALUES, ("units", "unit", "a")), 0.5), PLAIN)
    flight = steppers.integrate(Labelled(VALUES), 0.5, 1.0, dt=0.01)
    assert flight.success.all()


def test_a_frame_is_refused():
    frame = type("DataFrame", (Array,), {"__module__": "pandas.core.frame", "columns": ["a"]})
    with pytest.raises(TypeError, match=r"v_norm is a pandas DataFrame.*pass its columns"):
        d_norm(frame(VALUES), 0.5)


# --- the packages themselves --------------------------------------------------------------


def test_real_xarray():
    xarray = pytest.importorskip("xarray")
    one = xarray.DataArray(VALUES, dims="v", attrs={"units": "1"})
    for value in (one, one.to_dataset(name="v"), one.variable):
        with pytest.raises(TypeError, match=r"v_norm is an xarray .*xarray\.apply_ufunc"):
            d_norm(value, 0.5)
    found = xarray.apply_ufunc(d_norm, one, xarray.DataArray([0.5, 0.6], dims="a"))
    assert found.shape == (3, 2)  # the advice works


def test_real_dask():
    dask = pytest.importorskip("dask.array")
    lazy = dask.from_array(VALUES, chunks=2)
    with pytest.raises(TypeError, match=r"v_norm is a dask Array.*dask\.array\.map_blocks"):
        d_norm(lazy, 0.5)
    np.testing.assert_array_equal(dask.map_blocks(d_norm, lazy, 0.5).compute(), PLAIN)


def test_real_pandas():
    pandas = pytest.importorskip("pandas")
    v = pandas.Series(VALUES, index=["units", "b", "c"])
    np.testing.assert_array_equal(d_norm(v, v * 0 + 0.5), PLAIN)
    with pytest.raises(ValueError, match="different indices"):
        d_norm(v, (v * 0 + 0.5)[::-1])
    with pytest.raises(TypeError, match="DataFrame"):
        d_norm(v.to_frame(), 0.5)


def test_real_pint():
    units = pytest.importorskip("pint").UnitRegistry()
    for value in (VALUES * units.dimensionless, 1.0 * units.m, [1.0 * units.m]):
        with pytest.raises(TypeError, match="v_norm carries units"):
            d_norm(value, 0.5)


def test_real_astropy():
    units = pytest.importorskip("astropy.units")
    for value in (0.5 * units.rad, [0.5, 1.0] * units.deg, [0.5 * units.rad]):
        with pytest.raises(TypeError, match="alpha0 carries units"):
            d_norm(1.0, value)
