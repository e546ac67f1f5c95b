"""Launches in SI units: from v0, alpha0 and v_lim to metres and seconds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any, Generic, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hodograph.bodies import terminal_speed
from hodograph.engine import domain, one, power, scene
from hodograph.engine.domain import FloatArray, Scalar, T
from hodograph.engine.driver import Codes, apply
from hodograph.engine.record import Record
from hodograph.engine.status import Status
from hodograph.level import cheapest
from hodograph.tiers import dial

_FIELDS = ("v0", "alpha0", "v_lim", "g", "height", "n")
_CONVERGED = np.int8(Status.CONVERGED)


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
    n : array_like, optional
        Drag grows as the n-th power of the speed, n in [1, 10]; then v_lim = (m g / lambda)^(1/n).
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
    n: T = field(default=2.0, kw_only=True)  # type: ignore[assignment]  # becomes a T
    g: T = field(default=9.81, kw_only=True)  # type: ignore[assignment]  # becomes a T
    height: T = field(default=0.0, kw_only=True)  # type: ignore[assignment]  # becomes a T

    if TYPE_CHECKING:  # what may come in is wider than what is held

        @overload
        def __init__(
            self: Launch[np.float64],
            v0: Scalar,
            alpha0: Scalar,
            v_lim: Scalar,
            *,
            n: Scalar = 2.0,
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
            n: ArrayLike = 2.0,
            g: ArrayLike = 9.81,
            height: ArrayLike = 0.0,
        ) -> None: ...
        def __init__(self, *args: Any, **kwargs: Any) -> None: ...

    def __post_init__(self) -> None:
        """Check the fields and broadcast them."""
        plain = self.v0, self.alpha0, self.v_lim, self.g, self.height, self.n
        if one.is_legal(*plain):
            for name, value in zip(_FIELDS, plain, strict=True):
                self.__dict__[name] = np.float64(value)
            return
        shape, arrays = domain.broadcast(
            v0=(self.v0, domain.LAUNCH_SPEED),
            alpha0=(self.alpha0, domain.SLOPE_ANGLE),
            v_lim=(self.v_lim, domain.TERMINAL_SPEED),
            g=(self.g, domain.GRAVITY),
            height=(self.height, domain.HEIGHT),
            n=(self.n, power.EXPONENT),
        )
        v0, _, v_lim, g, height, _ = arrays
        domain.check_scene(v0, v_lim, g, height)
        state = {
            name: domain.restore(array, shape) for name, array in zip(_FIELDS, arrays, strict=True)
        }
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
        return replace(self, **{name: getattr(self, name)[index] for name in _FIELDS})

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
        n: Scalar = 2.0,
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
        n: ArrayLike = 2.0,
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
        n: ArrayLike = 2.0,
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
        n : array_like, optional
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
        domain.one_index(v0=v0, alpha0=alpha0, k=k, g=g, height=height, n=n)
        square = terminal_speed(k, g=g)  # sqrt(g / k), whatever n
        with np.errstate(over="ignore"):  # a terminal speed beyond the doubles is vacuum
            v_lim = square ** (2 / domain.checked("n", n, power.EXPONENT))
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
        if rtol is None:
            return cast("T", self._landing("x")[0])
        wanted = dial.choice(rtol, None)
        by_one = partial(dial.range_alone, wanted=wanted)
        if (fields := self._alone) and (distance := by_one(*fields)) is not None:
            return cast("T", np.float64(distance))

        def kernel(
            v0: FloatArray, alpha0: FloatArray, v_lim: FloatArray, *others: FloatArray
        ) -> tuple[list[FloatArray], Codes]:
            g, height, n = others
            x, codes = np.empty_like(v0), np.full(v0.shape, Status.CONVERGED, np.int8)
            level = (height == 0) & (alpha0 >= 0)
            at, rest = np.flatnonzero(level), np.flatnonzero(~level)
            (ratio,), codes[at] = by_tier(v0[at] / v_lim[at], alpha0[at], n[at])
            x[at] = ratio * 2 * np.sin(alpha0[at]) * np.cos(alpha0[at]) * v0[at] ** 2 / g[at]
            if rest.size:
                parts = (part[rest] for part in (v0, alpha0, v_lim, *others))
                (x[rest],), codes[rest] = exact(*parts)
            return [x], codes

        by_tier, exact = cheapest(wanted), scene.landings("x")
        return cast("T", self._apply(kernel, 1, alone=by_one)[0][0])

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
        return cast("T", self._landing("t")[0])

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
        names = ("x", "t", "speed", "alpha", "arc_length", "error")
        *rows, status = self._landing(*names)
        found = dict(zip(names, rows, strict=True))
        return Landing(**found, status=status, success=status == Status.CONVERGED)

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
        if (fields := self._alone) and (top := one.apex(*fields)):
            return cast("tuple[T, T, T]", tuple(map(np.float64, top)))
        x, y, t = self._apply(scene.apexes, 3, alone=one.apex)[0]
        return x, y, t

    def trajectory(self, points: int = 200) -> Trajectory:
        """Points of the path from the launch to the landing, evenly spaced in arc length.

        Parameters
        ----------
        points : int, optional
            How many, at least 2.

        Returns
        -------
        Trajectory
            Arrays of shape ``launch shape + (points,)``; all NaN where the landing is unreachable.

        Examples
        --------
        >>> import numpy as np
        >>> path = Launch(40.0, np.pi / 4, 42.7).trajectory(3)
        >>> path.x.round(2), path.y.round(2)
        (array([  0.  ,  51.48, 100.75]), array([ 0.  , 30.56,  0.  ]))
        """
        domain.count("points", points, 2)
        return Trajectory(*self._apply(scene.paths(points), 6, inner=(points,))[0])

    @property
    def _alone(self) -> tuple[float, float, float, float, float, float] | None:
        """The fields of a single launch as plain floats."""
        if type(self.v0) is not np.float64:
            return None
        own = self.__dict__
        return (
            float(own["v0"]), float(own["alpha0"]), float(own["v_lim"]),
            float(own["g"]), float(own["height"]), float(own["n"]),
        )  # fmt: skip

    def _landing(self, *names: str) -> list[Any]:
        """Quantities of the landing, and the status."""
        by_one = partial(scene.landing_of_one, names)
        if (fields := self._alone) and (found := by_one(*fields)) is not None:
            return [*found, _CONVERGED]
        rows, status = self._apply(scene.landings(*names), len(names), alone=by_one)
        return [*rows, status]

    def _apply(self, kernel: Any, rows: int, **options: Any) -> tuple[list[Any], Any]:
        arrays = [np.asarray(getattr(self, name)) for name in _FIELDS]
        return apply(kernel, arrays[0].shape, arrays, rows, exponent=5, **options)
