"""Launches in SI units: from v0, alpha0 and v_lim to metres and seconds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any, Generic, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hodograph.engine import domain, velocity
from hodograph.engine import power as powerlaw
from hodograph.engine.domain import FloatArray, Scalar, T
from hodograph.engine.flight import (
    CONVERGED,
    INVALID,
    NOT_CONVERGED,
    Flight,
    blocks,
    climb,
    fly,
    least_speed,
    warn_not_converged,
)
from hodograph.engine.path import points
from hodograph.engine.record import Record
from hodograph.level import d_ref
from hodograph.tiers import dial

_BROADCAST = ("v0", "alpha0", "v_lim", "g", "height")


@dataclass(frozen=True, eq=False, repr=False)
class Landing(Record, Generic[T]):
    """Where, when and how a launch lands; fields have the launch's shape.

    Attributes
    ----------
    x, t, speed, alpha, arc_length
        Distance (m), time (s), speed (m/s), slope angle (rad) and length of path (m); NaN where
        `success` is false.
    status
        0 converged, 1 unreachable (the landing height is never reached), 2 not converged,
        3 a NaN among the inputs.
    success
        ``status == 0``.
    error
        Estimate of the relative error of `x` and `t`, no less than the true one.  `alpha` is no
        worse except just under the apex, where it is nearly level and rounding is a large part
        of it.
    """

    x: T
    t: T
    speed: T
    alpha: T
    arc_length: T
    status: np.int8 | NDArray[np.int8]
    success: np.bool_ | NDArray[np.bool_]
    error: T


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory(Record):
    """Points of a path, evenly spaced in arc length; the last axis runs along it.

    Attributes
    ----------
    t, x, y, speed, alpha, s
        Time (s), position (m; y above the landing plane), speed (m/s), slope angle (rad) and
        arc length (m).  The last point is the landing.
    """

    t: FloatArray
    x: FloatArray
    y: FloatArray
    speed: FloatArray
    alpha: FloatArray
    s: FloatArray


# Below this angle a launch onto its own level flies as in vacuum, and all but its speed scales.
SHALLOWEST = 1e-100


@dataclass(frozen=True, eq=False)
class _Scaled:
    """Flat launches in units of their own: the speed computed with, and its square over g."""

    v: FloatArray
    alpha0: FloatArray
    height: FloatArray
    speed: FloatArray  # in m/s
    g: FloatArray
    rest: FloatArray  # v0 over that speed
    shrink: FloatArray  # alpha0 over the angle computed with; 0 for a launch at rest on the ground

    def at(self, index: NDArray[np.bool_]) -> _Scaled:
        """The launches at `index`."""
        return _Scaled(*(getattr(self, field.name)[index] for field in fields(self)))

    def metres(self, lengths: FloatArray) -> FloatArray:
        """Lengths in units of the launch as metres."""
        return np.asarray(lengths * self.speed * (self.speed / self.g))


@dataclass(frozen=True, eq=False, repr=False)
class Launch(Record, Generic[T]):
    """A launch under gravity and drag, quadratic unless `n` says otherwise; fields broadcast.

    All is in SI units.

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, 0 or in [1e-30, 1e30].
    alpha0 : array_like
        Launch angle in radians above the horizontal, in [-pi/2, pi/2].
    v_lim : array_like
        Terminal speed of fall in m/s, at least 1e-30; ``inf`` is vacuum.
    n : float, optional
        Drag grows as the n-th power of the speed, n in [1, 10], the same for all launches; then
        v_lim = (m g / lambda)^(1/n).
    g : array_like, optional
        Gravity in m/s^2, in [1e-30, 1e30].
    height : array_like, optional
        Height of the launch above the landing plane in m, in [-1e30, 1e30]; negative for a target
        above it.

    Notes
    -----
    The fields are read-only arrays of the launch's own.  Launches are compared by value (NaN is
    equal to NaN); an array of them has a length, elements and slices.  v0 / v_lim and
    abs(height) g / v_lim^2 are at most 1e20.

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    A baseball hit at 45 degrees, with the paper's v_lim:

    >>> import numpy as np
    >>> launch = Launch(40.0, np.pi / 4, 42.7)
    >>> round(float(launch.range()), 3), round(float(launch.flight_time()), 4)
    (100.7..., 5.0...)
    """

    v0: T
    alpha0: T
    v_lim: T
    n: float = field(default=2.0, kw_only=True)
    g: T = field(default=9.81, kw_only=True)  # type: ignore[assignment]  # becomes one
    height: T = field(default=0.0, kw_only=True)  # type: ignore[assignment]

    if TYPE_CHECKING:  # what may come in is wider than what is held

        @overload
        def __init__(
            self: Launch[np.float64],
            v0: Scalar,
            alpha0: Scalar,
            v_lim: Scalar,
            *,
            n: float = 2.0,
            g: Scalar = 9.81,
            height: Scalar = 0.0,
        ) -> None: ...
        @overload
        def __init__(
            self: Launch[FloatArray],
            v0: ArrayLike,
            alpha0: ArrayLike,
            v_lim: ArrayLike,
            *,
            n: float = 2.0,
            g: ArrayLike = 9.81,
            height: ArrayLike = 0.0,
        ) -> None: ...
        def __init__(self, *args: Any, **kwargs: Any) -> None: ...

    def __post_init__(self) -> None:
        """Check the fields and broadcast them."""
        shape, arrays = domain.broadcast(
            v0=(self.v0, domain.LAUNCH_SPEED),
            alpha0=(self.alpha0, domain.SLOPE_ANGLE),
            v_lim=(self.v_lim, domain.TERMINAL_SPEED),
            g=(self.g, domain.GRAVITY),
            height=(self.height, domain.HEIGHT),
        )
        v0, _, v_lim, g, height = arrays
        domain.check_scene(v0, v_lim, g, height)
        state: dict[str, Any] = {"n": domain.option("n", self.n, powerlaw.EXPONENT)}
        for name, array in zip(_BROADCAST, arrays, strict=True):
            state[name] = domain.restore(array, shape)
        self.__setstate__(state)

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the fields, read-only: also those that a copy or a pickle brings."""
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
        self.__dict__.update(state)

    def __bool__(self) -> bool:
        """True, as of any object, whatever its length."""
        return True

    def __len__(self) -> int:
        """Launches along the first axis."""
        return int(np.shape(self._elements())[0])

    def __iter__(self) -> Iterator[Launch[Any]]:
        """The launches along the first axis, one by one."""
        return (self[index] for index in range(len(self)))

    def __getitem__(self, index: Any) -> Launch[Any]:
        """Some of the launches, by any index that an array of their shape takes."""
        self._elements()
        return replace(self, **{name: getattr(self, name)[index] for name in _BROADCAST})

    def _elements(self) -> FloatArray:
        if np.ndim(self.v0) == 0:
            raise TypeError("this Launch is a single one: it has no length, elements or index")
        return np.asarray(self.v0)

    @overload
    @classmethod
    def from_drag(
        cls,
        v0: Scalar,
        alpha0: Scalar,
        k: Scalar,
        *,
        n: float = 2.0,
        g: Scalar = 9.81,
        height: Scalar = 0.0,
    ) -> Launch[np.float64]: ...
    @overload
    @classmethod
    def from_drag(
        cls,
        v0: ArrayLike,
        alpha0: ArrayLike,
        k: ArrayLike,
        *,
        n: float = 2.0,
        g: ArrayLike = 9.81,
        height: ArrayLike = 0.0,
    ) -> Launch[FloatArray]: ...
    @classmethod
    def from_drag(
        cls,
        v0: ArrayLike,
        alpha0: ArrayLike,
        k: ArrayLike,
        *,
        n: float = 2.0,
        g: ArrayLike = 9.81,
        height: ArrayLike = 0.0,
    ) -> Launch[Any]:
        """A launch given by its drag coefficient over mass, k = lambda/m >= 0 (eq. 12).

        Parameters
        ----------
        v0, alpha0, g, height : array_like
            As for `Launch`.
        k : array_like
            lambda / m, in 1/m for n = 2; v_lim = (g / k)^(1/n), and 0 is vacuum.
        n : float, optional
            Drag grows as the n-th power of the speed, n in [1, 10].

        Returns
        -------
        Launch
            The launch.

        Examples
        --------
        >>> round(float(Launch.from_drag(40.0, 0.7, 0.005376).v_lim), 3)
        42.717
        """
        n = domain.option("n", n, powerlaw.EXPONENT)
        domain.one_index(v0=v0, alpha0=alpha0, k=k, g=g, height=height)
        square = velocity.terminal_speed(k, g=g)  # sqrt(g / k), whatever n
        with np.errstate(over="ignore"):  # a terminal speed beyond the doubles is vacuum
            v_lim = square if n == 2 else square ** (2 / n)
        return cls(v0, alpha0, v_lim, n=n, g=g, height=height)

    @property
    def v_norm(self) -> T:
        """Launch speed over terminal speed, v0 / v_lim: 0 in vacuum."""
        return cast("T", np.divide(self.v0, self.v_lim))

    def range(self, *, rtol: float | None = None) -> T:
        """Horizontal distance to the landing in m; NaN where it is unreachable.

        Parameters
        ----------
        rtol : float, optional
            Relative error that will do, at least 1e-13: launches onto level ground under
            quadratic drag are then answered in the cheapest way known to meet it (see
            `hodograph.d_norm`), the others exactly.

        Returns
        -------
        float or ndarray
            The distance, of the launch's shape.

        Examples
        --------
        >>> import numpy as np
        >>> round(float(Launch(100.0, np.deg2rad(40.924), np.sqrt(9.81 / 0.001)).range()), 3)
        600.841
        >>> round(float(Launch(40.0, np.pi / 4, 42.7).range(rtol=1e-6)), 3)
        100.7...
        """
        wanted = dial.choice(rtol, None)
        if wanted == "exact" or self.n != 2:
            return cast("T", self._landings(("x",), _distance)[0])
        flat = {
            name: np.asarray(getattr(self, name)).reshape(-1)
            for name in ("v0", "alpha0", "v_lim", "g", "height")
        }
        level = (flat["height"] == 0) & (flat["alpha0"] >= 0)
        v0, alpha0, v_lim, g = (flat[name][level] for name in ("v0", "alpha0", "v_lim", "g"))
        result = np.empty(level.size)
        ratio, left = dial.cheap(v0 / v_lim, alpha0, wanted)
        vacuum = d_ref(v0, alpha0, g=g)
        result[level] = ratio * np.where(np.isfinite(vacuum), vacuum, 0.0)
        exact = ~level
        exact[level] = np.isinf(vacuum)  # which the distance itself need not be
        exact[np.flatnonzero(level)[left]] = True
        if exact.any():
            others = replace(self, **{name: part[exact] for name, part in flat.items()})
            result[exact] = others.range()
        return cast("T", domain.restore(result, np.shape(self.v0)))

    def flight_time(self) -> T:
        """Time to the landing in s; NaN where it is unreachable.

        Returns
        -------
        float or ndarray
            The time, of the launch's shape.

        Examples
        --------
        >>> import numpy as np
        >>> float(Launch(9.81, np.pi / 2, np.inf).flight_time())
        2.0
        """
        return cast("T", self._landings(("t",), _time)[0])

    def landing(self) -> Landing[T]:
        """Everything about the landing.

        Returns
        -------
        Landing
            Distance, time, speed, slope angle, arc length, status and error estimate.

        Warns
        -----
        RuntimeWarning
            Some launches did not converge; one warning for the call.

        Examples
        --------
        >>> import numpy as np
        >>> landing = Launch(40.0, np.pi / 4, 42.7, height=[0.0, 1000.0, -1000.0]).landing()
        >>> landing.status
        array([0, 0, 1], dtype=int8)
        >>> landing.x.round(2)
        array([100.75, 175.23,    nan])
        """
        x, t, speed, alpha, length, error, status = self._landings(
            ("t", "x", "s"), _distance, _time, _speed, _alpha, _length, _error, _status
        )
        status = np.where(np.isnan(status), INVALID, status).astype(np.int8)[()]
        return Landing(x, t, speed, alpha, length, status, status == CONVERGED, error)

    def apex(self) -> tuple[T, T, T]:
        """Highest point of the path, which for a downward launch is the launch itself.

        Returns
        -------
        x, y, t : float or ndarray
            Distance (m), height above the landing plane (m) and time (s).

        Examples
        --------
        >>> import numpy as np
        >>> x, y, t = Launch(9.81, np.pi / 2, np.inf, height=1.0).apex()
        >>> round(float(y), 6), float(t)
        (5.905, 1.0)
        """
        results = np.full((3, np.size(self.v0)), np.nan)
        for at, (v0, alpha0, v_lim, g, height) in self._valid():
            x, y, t = climb(v0 / v_lim, alpha0, self.n)
            per_speed = v0 / g
            results[:, at] = x * v0 * per_speed, y * v0 * per_speed + height, t * per_speed
        x, y, t = (domain.restore(row, np.shape(self.v0)) for row in results)
        return x, y, t

    def trajectory(self, n: int = 200) -> Trajectory:
        """Points of the path from the launch to the landing, evenly spaced in arc length.

        Parameters
        ----------
        n : int, optional
            Number of points, at least 2.

        Returns
        -------
        Trajectory
            Arrays of shape ``launch shape + (n,)``; all NaN where the landing is unreachable.

        Examples
        --------
        >>> import numpy as np
        >>> path = Launch(40.0, np.pi / 4, 42.7).trajectory(3)
        >>> path.x.round(2), path.y.round(2)
        (array([  0.  ,  51.48, 100.75]), array([ 0.  , 30.56,  0.  ]))
        """
        domain.count("n", n, 2)
        results = np.full((len(fields(Trajectory)), np.size(self.v0), n), np.nan)
        failed = 0
        for at, scaled in self._blocks():
            flight = self._fly(scaled, ("t", "x", "s"))
            landed = flight.status == CONVERGED
            path = points(flight, scaled.alpha0, self.n, n)
            t, x, y, speed, alpha, s = (row[landed].T for row in path)  # one column a launch
            at, scaled = at[landed], scaled.at(landed)
            moving = np.where(scaled.shrink > 0, 1.0, 0.0)
            rows = (
                t * (scaled.speed / scaled.g) * scaled.shrink,
                scaled.metres(x) * scaled.rest * scaled.shrink,
                scaled.metres(y) * scaled.shrink**2,
                speed * scaled.speed * moving,
                alpha * np.where(scaled.shrink > 0, scaled.shrink, 1.0),
                scaled.metres(s) * scaled.shrink,
            )
            for result, row in zip(results, rows, strict=True):
                result[at] = row.T
            for result, first in zip(
                results[2:5], (self.height, self.v0, self.alpha0), strict=True
            ):
                result[at, 0] = np.reshape(first, -1)[at]
            failed += int(np.count_nonzero(flight.status == NOT_CONVERGED))
        warn_not_converged(failed, np.size(self.v0))
        return Trajectory(*(row.reshape(*np.shape(self.v0), n) for row in results))

    def _valid(self) -> Iterator[tuple[NDArray[np.intp], list[FloatArray]]]:
        """The launches without NaN, block by block: flat indices, v0, alpha0, v_lim, g, height."""
        flat = [
            np.asarray(part).reshape(-1)
            for part in (self.v0, self.alpha0, self.v_lim, self.g, self.height)
        ]
        for block in blocks(flat[0].size):
            parts = [part[block] for part in flat]
            valid = np.flatnonzero(~np.logical_or.reduce([np.isnan(part) for part in parts]))
            yield block.start + valid, [part[valid] for part in parts]

    def _blocks(self) -> Iterator[tuple[NDArray[np.intp], _Scaled]]:
        """The launches without NaN, block by block, in units of their own."""
        for at, (v0, alpha0, v_lim, g, height) in self._valid():
            begin = np.maximum(v0, least_speed(v_lim, g, height))
            still = begin == 0  # at rest on the ground
            speed = np.where(still, np.minimum(v_lim, 1.0), begin)
            shallow = (height == 0) & (alpha0 > 0) & (alpha0 < SHALLOWEST)
            angle = np.where(shallow, SHALLOWEST, alpha0)
            shrink = np.where(shallow, alpha0 / SHALLOWEST, np.where(still, 0.0, 1.0))
            v = np.where(still, 0.0, speed / v_lim)
            yield at, _Scaled(v, angle, height / speed * g / speed, speed, g, v0 / speed, shrink)

    def _fly(self, scaled: _Scaled, wanted: tuple[str, ...]) -> Flight:
        return fly(scaled.v, scaled.alpha0, scaled.height, self.n, wanted)

    def _landings(
        self,
        wanted: tuple[str, ...],
        *quantities: Callable[[_Scaled, Flight], FloatArray],
    ) -> list[Any]:
        """Quantities at the landing; NaN where there is none."""
        results = np.full((len(quantities), np.size(self.v0)), np.nan)
        failed = 0
        for at, scaled in self._blocks():
            flight = self._fly(scaled, wanted)
            for result, quantity in zip(results, quantities, strict=True):
                result[at] = quantity(scaled, flight)
            failed += int(np.count_nonzero(flight.status == NOT_CONVERGED))
        warn_not_converged(failed, np.size(self.v0))
        return [domain.restore(result, np.shape(self.v0)) for result in results]


def _if_landed(flight: Flight, values: FloatArray) -> FloatArray:
    """NaN where there is no landing."""
    return np.where(flight.status == CONVERGED, values, np.nan)


def _distance(scaled: _Scaled, flight: Flight) -> FloatArray:
    distance = scaled.metres(flight.reach * flight.cos0) * scaled.rest * scaled.shrink
    return _if_landed(flight, distance)


def _time(scaled: _Scaled, flight: Flight) -> FloatArray:
    return _if_landed(flight, flight.t * (scaled.speed / scaled.g) * scaled.shrink)


def _speed(scaled: _Scaled, flight: Flight) -> FloatArray:
    return _if_landed(flight, np.where(scaled.shrink > 0, flight.speed * scaled.speed, 0.0))


def _alpha(scaled: _Scaled, flight: Flight) -> FloatArray:
    shrink = np.where(scaled.shrink > 0, scaled.shrink, 1.0)
    alpha = np.where(flight.delta == 0, scaled.alpha0, -np.arctan(flight.tangent))
    return _if_landed(flight, alpha * shrink)


def _length(scaled: _Scaled, flight: Flight) -> FloatArray:
    return _if_landed(flight, scaled.metres(flight.curve + flight.tail) * scaled.shrink)


def _error(scaled: _Scaled, flight: Flight) -> FloatArray:
    return _if_landed(flight, flight.error)


def _status(scaled: _Scaled, flight: Flight) -> FloatArray:
    return flight.status.astype(np.float64)
