"""Inputs by name: what each is, its unit and range, and the dimensions that it has."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from hodograph.engine import domain, power
from hodograph.engine.domain import Rule

# What an input is, its unit, and its legal range.
INPUTS: dict[str, tuple[str, str, Rule]] = {
    "v_norm": ("launch speed over terminal speed", "1", domain.V_NORM),
    "v0": ("launch speed", "m/s", domain.LAUNCH_SPEED),
    "alpha0": ("launch angle above the horizontal", "rad", domain.SLOPE_ANGLE),
    "v_lim": ("terminal speed of fall", "m/s", domain.TERMINAL_SPEED),
    "k": ("drag coefficient over mass", "(m/s)^(1-n)/s", domain.NON_NEGATIVE),
    "n": ("drag exponent", "1", power.EXPONENT),
    "g": ("gravity", "m/s^2", domain.GRAVITY),
    "height": ("height of the launch above the ground", "m", domain.HEIGHT),
    "slope": ("angle of the ground, rising along x", "rad", domain.GROUND),
    "wind": ("wind along x", "m/s", domain.WIND),
    "crosswind": ("wind along z", "m/s", domain.WIND),
}


def labelled(xarray: Any, name: str, value: Any) -> Any:
    """An input as a DataArray, its values checked unless they are lazy."""
    words, unit, rule = INPUTS[name]
    if isinstance(value, xarray.DataArray):
        given = value
    elif isinstance(value, tuple) and len(value) == 2 and _are_names(value[0]):
        array = domain.as_float(name, value[1])
        dims = [value[0]] if isinstance(value[0], str) else list(value[0])
        if len(dims) != array.ndim:
            raise ValueError(f"{name} has {array.ndim} dimensions, and the names {dims}")
        given = xarray.DataArray(array, dims=dims)
    else:
        array = domain.as_float(name, value)
        if array.ndim > 1:
            raise ValueError(
                f"{name} has {array.ndim} dimensions without names; name them: "
                f"{name}=(('a', 'b'), values), or an xarray.DataArray"
            )
        coords = {name: array} if array.ndim else None
        given = xarray.DataArray(array, coords, dims=(name,) * array.ndim)
    if given.chunks is None:
        domain.check(name, domain.as_float(name, given.to_numpy()), rule)
    return given.assign_attrs({"long_name": words, "units": unit} | given.attrs).rename(name)


def require_free(given: Mapping[str, Any], outputs: Iterable[str]) -> None:
    """Refuse dimensions and coordinates by the name of an output, or of an input without them."""
    for name, array in given.items():
        for word in (*array.dims, *array.coords):
            if word in outputs:
                raise ValueError(
                    f"{name} has a dimension or coordinate {word!r}, as an output is "
                    "called: rename it"
                )
        for dim in array.dims:
            if dim in given and given[dim].dims != (dim,):
                raise ValueError(
                    f"{name} has a dimension {dim!r}, which the input {dim} has not: rename it"
                )


def _are_names(dims: Any) -> bool:
    several = isinstance(dims, list | tuple) and all(isinstance(dim, str) for dim in dims)
    return isinstance(dims, str) or several


def chunks(sizes: Mapping[Any, int], cells: int) -> dict[Any, int]:
    """How long a chunk is along each dimension: the last ones whole, as far as `cells` go."""
    left, lengths = max(cells, 1), {}
    for dim in reversed(list(sizes)):
        pieces = -(-sizes[dim] // min(left, max(sizes[dim], 1)))
        lengths[dim] = -(-sizes[dim] // max(pieces, 1))
        left = max(left // max(lengths[dim], 1), 1)
    return lengths
