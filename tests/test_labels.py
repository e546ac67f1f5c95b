"""Labelled, lazy and dimensioned input: kept, taken where nothing is lost, or refused in one line.

The packages that make such input are no dependency.  Stand-ins carry what the library looks at,
the module and the name of the type, and how attributes are found; where a package is installed,
the real thing is tried as well.
"""

import numpy as np
import pytest

from hodograph import (
    Launch,
    aim,
    calibrate,
    d_norm,
    d_ref,
    envelope,
    grid,
    landing_angle,
    laws,
    least_speed,
    optimal_angle,
    steppers,
)
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
    """The message of every way in where labels cannot be kept."""
    calls = [
        lambda: d_norm(1.0, [value]),
        lambda: Launch(value, 0.5, 1.0),
        lambda: Launch(1.0, 0.5, 1.0, height=value),
        lambda: Launch.from_drag(1.0, 0.5, value),
        lambda: grid.tabulate(value),
        lambda: range_sensitivity(value, 0.5, 1.0),
        lambda: aim(1.0, value, 0.5, 1.0),
        lambda: aim(1.0, 0.5, 0.5, 1.0, velocity=(0.0, value, 0.0)),
        lambda: least_speed(1.0, value, 1.0),
        lambda: envelope(1.0, value, 1.0),
        lambda: laws.fit_pearson(value, VALUES),
        lambda: steppers.integrate(value, 0.5, 1.0, dt=0.1),
    ]
    for call in calls:
        with pytest.raises(TypeError, match=name) as caught:
            call()
        message = str(caught.value)
        assert "\n" not in message
        if call is not calls[-1]:  # the steppers import nothing, and have words of their own
            yield message


@pytest.mark.parametrize("kind", ["DataArray", "Dataset", "Variable"])
def test_xarray_is_refused(kind):
    child = type("Mine", (made_by("xarray", kind),), {"__module__": "mine"})
    with pytest.raises(TypeError, match="v0 is an xarray Mine, "):
        Launch(child(VALUES), 0.5, 1.0)
    for message in refusals(kind, made_by("xarray", kind)(VALUES)):
        assert "hodograph.sweep.landings" in message
        assert ".to_numpy()" in message


def test_dask_is_refused():
    for message in refusals("Array", made_by("dask", "Array")(VALUES)):
        assert "hodograph.sweep.landings" in message
        assert ".compute()" in message


def test_series_of_one_index_pass():
    v, alpha0 = Series(VALUES, "abc"), Series([0.5, 0.5, 0.5], "abc")
    found = d_norm([v], [alpha0])[0]
    assert type(found) is np.ndarray
    np.testing.assert_array_equal(found, PLAIN)
    np.testing.assert_array_equal(Launch(v, alpha0, 1.0).v0, VALUES)


@pytest.mark.parametrize("index", ["cba", "abd", "ab"])
def test_series_of_other_indices_are_refused(index):
    v, other = Series(VALUES, "abc"), Series([0.5] * len(index), index)
    for call in (
        lambda: d_norm([v, Series(VALUES, "abc")], [other]),
        lambda: Launch(v, 0.5, 1.0, height=other),
        lambda: Launch.from_drag(v, 0.5, other),
        lambda: range_sensitivity(v, other, 1.0),
        lambda: calibrate(v, other),
        lambda: laws.fit_pearson(v, other),
        lambda: steppers.integrate(v, other, 1.0, dt=0.1),
    ):
        with pytest.raises(ValueError, match=r"pandas Series with different indices: align"):
            call()


def test_a_label_called_units_makes_no_quantity():
    np.testing.assert_array_equal(Launch(Labelled(VALUES), 0.5, 1.0).v0, VALUES)
    np.testing.assert_array_equal(d_norm(Labelled(VALUES), 0.5), PLAIN)
    flight = steppers.integrate(Labelled(VALUES), 0.5, 1.0, dt=0.01)
    assert flight.success.all()


def test_a_frame_is_refused():
    frame = type("DataFrame", (Array,), {"__module__": "pandas.core.frame", "columns": ["a"]})
    with pytest.raises(TypeError, match=r"v_norm is a pandas DataFrame.*pass its columns"):
        d_norm(frame(VALUES), 0.5)


# --- the packages themselves --------------------------------------------------------------


def test_xarray_by_dimension():
    """Broadcast by dimension, with coordinates and attributes; a Dataset has no one array."""
    xarray = pytest.importorskip("xarray")
    v = xarray.DataArray(VALUES, {"v": [1, 2, 3]}, "v", attrs={"units": "1", "source": "film"})
    alpha0 = xarray.DataArray([0.5, 0.6], dims="a")
    for found, function in (
        (d_norm(v, alpha0), d_norm),
        (landing_angle(v, alpha0=alpha0), landing_angle),
        (d_ref(v, alpha0, g=1.62), lambda v, a: d_ref(v, a, g=1.62)),
        (d_norm(v, alpha0, n=1.5, rtol=1e-6), lambda v, a: d_norm(v, a, n=1.5, rtol=1e-6)),
        (optimal_angle(v, n=alpha0 + 1), lambda v, a: optimal_angle(v, n=a + 1)),
    ):
        assert found.dims == ("v", "a")
        assert found.attrs["source"] == "film"
        assert found.attrs["long_name"]
        np.testing.assert_array_equal(found["v"], [1, 2, 3])
        np.testing.assert_allclose(found, function(VALUES[:, None], alpha0.to_numpy()), rtol=1e-14)
    assert landing_angle(v, 0.5).attrs["units"] == "rad"
    assert landing_angle(v, 0.5).name == "landing_angle"
    for value in (v.to_dataset(name="speed"), v.variable):
        with pytest.raises(TypeError, match="v_norm is an xarray "):
            d_norm(value, 0.5)
    with pytest.raises(ValueError, match="coordinates differ"):
        d_norm(v, v.assign_coords(v=[1, 2, 4]))
    with pytest.raises(TypeError, match="alpha0 is an array without dimensions"):
        d_norm(v, [0.5, 0.6, 0.7])


def test_lazy_stays_lazy():
    dask = pytest.importorskip("dask.array")
    lazy = dask.from_array(VALUES, chunks=2)
    for found in (d_norm(lazy, 0.5), d_norm(VALUES, lazy * 0 + 0.5), d_norm(lazy, 0.5, rtol=1e-12)):
        assert isinstance(found, dask.Array)
        np.testing.assert_allclose(found.compute(scheduler="synchronous"), PLAIN, rtol=1e-12)
    table = d_norm(lazy[:, np.newaxis], np.array([0.5, 0.6]))
    assert table.shape == (3, 2)
    assert table.chunks == ((2, 1), (2,))
    bad = d_norm(-lazy, 0.5)  # nothing is looked at yet
    with pytest.raises(ValueError, match="v_norm must be in"):
        bad.compute(scheduler="synchronous")
    xarray = pytest.importorskip("xarray")
    labelled = d_norm(xarray.DataArray(lazy, dims="v"), xarray.DataArray([0.5, 0.6], dims="a"))
    assert labelled.chunks is not None
    np.testing.assert_array_equal(labelled.compute(scheduler="synchronous")[:, 0], PLAIN)


def test_series_are_aligned():
    pandas = pytest.importorskip("pandas")
    v = pandas.Series(VALUES, index=["units", "b", "c"])
    for found in (d_norm(v, v * 0 + 0.5), d_norm(v, 0.5), d_norm(v, [0.5] * 3)):
        assert isinstance(found, pandas.Series)
        assert list(found.index) == ["units", "b", "c"]
        np.testing.assert_array_equal(found, PLAIN)
    np.testing.assert_array_equal(d_norm(v, (v * 0 + 0.5)[::-1]).loc[v.index], PLAIN)
    part = d_norm(v, pandas.Series([0.5, 0.5], index=["b", "d"]))
    assert part.loc["b"] == PLAIN[1]
    assert part.drop("b").isna().all()
    assert len(part) == 4
    missing = d_norm(pandas.Series([1.0, None], dtype="Float64"), 0.5)
    assert list(missing.isna()) == [False, True]
    twice = pandas.Series(VALUES, index=["b", "b", "c"])
    for other in (v, [0.5, 0.6]):
        with pytest.raises(ValueError, match="Series"):
            d_norm(twice, other)
    with pytest.raises(TypeError, match="DataFrame"):
        d_norm(v.to_frame(), 0.5)
    with pytest.raises(TypeError, match="complex"):
        d_norm(v * 1j, 0.5)
    np.testing.assert_array_equal(Launch(v, 0.5, 1.0).v0, VALUES)  # a Launch holds plain numbers
    with pytest.raises(ValueError, match="different indices"):
        Launch(v, 0.5, v[::-1])


def test_kinds_do_not_mix():
    pandas = pytest.importorskip("pandas")
    xarray = pytest.importorskip("xarray")
    with pytest.raises(TypeError, match="v_norm is of pandas and alpha0 of xarray"):
        d_norm(pandas.Series(VALUES), xarray.DataArray([0.5]))


@pytest.mark.parametrize("package", ["pandas", "dask.array", "xarray"])
def test_what_stands_beside_labels_is_checked_too(package):
    """A mask, or units, would be lost in an array beside a Series as they would alone."""
    module = pytest.importorskip(package)
    make = {"pandas": "Series", "dask.array": "asarray", "xarray": "DataArray"}[package]
    labelled, beside = getattr(module, make)(VALUES), np.ma.masked_array(VALUES / 2, [0, 1, 0])
    with pytest.raises(TypeError, match="alpha0 is a masked array"):
        d_norm(labelled, beside)
    beside = made_by("xarray", "Dataset")(VALUES)
    with pytest.raises(TypeError, match="alpha0 is an xarray Dataset"):
        d_norm(labelled, beside)


def test_lazy_shapes_must_broadcast():
    dask = pytest.importorskip("dask.array")
    with pytest.raises(ValueError, match=r"broadcast: v_norm \(3,\), alpha0 \(2,\)"):
        d_norm(dask.from_array(VALUES, chunks=2), np.array([0.1, 0.2]))


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
