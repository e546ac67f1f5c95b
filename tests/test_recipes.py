"""The recipes of the documentation, run as they stand where their package is installed."""

import re

import numpy as np
import pytest
from helpers import ROOT

import hodograph

PAGE = (ROOT / "docs" / "howto" / "recipes.md").read_text(encoding="utf-8")
BLOCKS = {
    name.lower(): code
    for name, code in re.findall(
        r"^## (\w+):.*?^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL
    )
}


def made_by(package):
    """What the recipe leaves behind."""
    pytest.importorskip(package)
    names = {}
    exec(compile(BLOCKS[package], package, "exec"), names)
    return names


def test_every_recipe_is_run():
    assert set(BLOCKS) == {"pint", "pandas", "xarray", "jax", "numba"}


def test_pint():
    found = made_by("pint")["home_run"]
    plain = hodograph.Launch(110 * 0.44704, np.deg2rad(28), 95 * 0.44704).range()
    assert found.units == "foot"
    assert found.magnitude == pytest.approx(plain / 0.3048, rel=1e-14)


def test_pandas():
    throws = made_by("pandas")["throws"]
    for row in throws.itertuples():
        launch = hodograph.Launch(row.v0, np.deg2rad(row.angle), 146.0)
        level = hodograph.d_ref(row.v0, np.deg2rad(row.angle)) * row.d_norm
        assert level == pytest.approx(launch.range(), rel=1e-14)
        assert row.range > level  # from a height


def test_xarray():
    table = made_by("xarray")["table"]
    assert table.dims == ("v_norm", "angle")
    assert (table[0] == 1).all()
    assert table.attrs["source"] == "a scale"


def test_jax():
    names = made_by("jax")
    distance, step = names["distance"], 1e-6
    launches = [hodograph.Launch(40.0, 0.7 + d, 42.7).range() for d in (step, -step)]
    assert names["slope"] == pytest.approx((launches[0] - launches[1]) / (2 * step), rel=1e-7)
    jax = pytest.importorskip("jax")
    v0 = np.array([10.0, 40.0])
    assert jax.vmap(distance, (0, None, None))(v0, 0.7, 42.7) == pytest.approx(
        hodograph.Launch(v0, 0.7, 42.7).range(), rel=1e-14
    )
    by_speed = jax.jit(jax.grad(distance))(40.0, 0.7, 42.7)
    exact = hodograph.sensitivity.range_sensitivity(40.0, 0.7, 42.7).v0
    assert by_speed == pytest.approx(exact, rel=1e-14)


def test_numba():
    farthest = made_by("numba")["farthest"]
    angles = np.linspace(0.5, 0.9, 9)
    assert farthest(40.0, angles) == hodograph.Launch(40.0, angles, 42.7).range().max()
