"""How the range answers to a change of the launch, and the best angle for any landing height."""

from __future__ import annotations

from typing import Any, Generic, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, extremes, power
from hodograph.engine.derivatives import derivatives
from hodograph.engine.domain import FloatArray, Scalar, T
from hodograph.engine.driver import Codes, apply
from hodograph.engine.flight import fly
from hodograph.engine.record import plain, shown
from hodograph.reach import best_angle

__all__ = ["Sensitivity", "best_angle", "range_sensitivity"]


class Sensitivity(NamedTuple, Generic[T]):
    """The range in metres, and its derivatives: see `range_sensitivity`."""

    range: T
    alpha0: T  # m per radian
    v0: T  # m per m/s, at fixed v_lim
    v_lim: T  # m per m/s, at fixed v0; 0 in vacuum
    height: T  # m per m that the launch is raised

    def __repr__(self) -> str:
        """One line: numbers as they are, arrays by their shape."""
        return shown(self)

    def to_dict(self) -> dict[str, Any]:
        """The fields as plain numbers and nested lists, ready for ``json.dumps``."""
        return plain(self)


@overload
def range_sensitivity(
    v0: Scalar,
    alpha0: Scalar,
    v_lim: Scalar,
    *,
    g: Scalar = 9.81,
    height: Scalar = 0.0,
    n: Scalar = 2.0,
) -> Sensitivity[np.float64]: ...
@overload
def range_sensitivity(
    v0: ArrayLike,
    alpha0: ArrayLike,
    v_lim: ArrayLike,
    *,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
    n: ArrayLike = 2.0,
) -> Sensitivity[FloatArray]: ...
def range_sensitivity(
    v0: ArrayLike,
    alpha0: ArrayLike,
    v_lim: ArrayLike,
    *,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
    n: ArrayLike = 2.0,
    **others: Any,
) -> Sensitivity[Any]:
    """The range over level ground in still air, and its derivatives in alpha0, v0, v_lim, height.

    Sloping ground and wind are refused: there, differences of `hodograph.Launch.range`, which is
    exact to about 1e-14, give derivatives to about 1e-10.

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, in [1e-30, 1e30].
    alpha0 : array_like
        Launch angle in radians, in [-pi/2, pi/2].
    v_lim : array_like
        Terminal speed of fall in m/s, at least 1e-30; ``inf`` is vacuum.  v0 / v_lim is at most
        1e20.
    g : array_like, optional
        Gravity in m/s^2, positive.
    height : array_like, optional
        Height of the launch above the landing plane in m; negative for a target above it.
    n : array_like, optional
        Drag grows as the n-th power of the speed, n in [1, 10].

    Returns
    -------
    Sensitivity
        `range` in m, and its derivatives: `alpha0` in m per radian, `v0` at fixed v_lim and
        `v_lim` at fixed v0 (0 in vacuum) in m per m/s, and `height` in m per metre that the
        launch is raised; all of the broadcast shape.  NaN where an input is NaN, where the
        landing height is never reached, where a level launch goes nowhere, and where the
        iteration failed (with one `RuntimeWarning`).  The relative error is about 1e-13, where
        dR/dalpha0 passes through 0 in units of the range.  It is larger in two places.

        dR/dalpha0 of steep fast launches: up to 4e-12 near 78 degrees, and up to 2e-8 above that
        where the landing is within 1% of the highest point.

        A downward launch that lands so soon that its slope hardly changes: with f = g height
        / v0^2, dR/dalpha0 is off by about 2e-16 / f, and dR/dv0 and dR/dv_lim, which vanish
        with f, by up to 1e-15 of range / v0 and range / v_lim.  At 40 m/s and -0.5 rad, with
        v_lim 42.7 m/s, dR/dv0 has a relative error of 2e-11 from 1 mm, 1e-9 from 1 um and 2e-5
        from 1 nm.

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    A baseball at 45 degrees: a degree more costs 0.4 m, a metre per second more brings 3.3 m.

    >>> import numpy as np
    >>> found = range_sensitivity(40.0, np.pi / 4, 42.7)
    >>> print(f"{found.alpha0 * np.pi / 180:.2f} m per degree, {found.v0:.2f} m per m/s")
    -0.36 m per degree, 3.26 m per m/s
    """
    for word in others:
        if word in ("slope", "wind", "crosswind"):
            raise ValueError(
                f"range_sensitivity knows no {word}: take differences of Launch(...).range()"
            )
        raise TypeError(f"range_sensitivity() got an unexpected keyword argument {word!r}")
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        alpha0=(alpha0, domain.SLOPE_ANGLE),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        g=(g, domain.GRAVITY),
        height=(height, domain.HEIGHT),
        n=(n, power.EXPONENT),
    )
    domain.check_scene(arrays[0], *arrays[2:5])
    return Sensitivity(*apply(_sensitivity, shape, arrays, 5, exponent=5)[0])


def _sensitivity(
    v0: FloatArray,
    alpha0: FloatArray,
    v_lim: FloatArray,
    g: FloatArray,
    height: FloatArray,
    n: FloatArray,
) -> tuple[list[FloatArray], Codes]:
    own = extremes.scale(v0, alpha0, v_lim, g, height, n)
    flight = fly(own.v, own.alpha0, own.height, n, ("x",))
    found = derivatives(flight)
    length = own.length * own.rest
    with np.errstate(divide="ignore", invalid="ignore"):
        per_Q = np.where(found.Q > 0, 1 / found.Q, np.nan)  # a level launch goes nowhere
        rows = [
            found.reach * flight.cos0 * length * own.shrink + 0 * per_Q,
            found.alpha0 * per_Q * length,
            found.v0 * per_Q * own.time * own.shrink,
            found.v_lim * per_Q * (own.speed / v_lim) * own.time * own.rest * own.shrink,
            found.height * per_Q * own.rest / own.shrink,
        ]
    return rows, flight.status
