"""Launches in SI units: from v0, alpha0 and v_lim to metres and seconds."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Unpack, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.bodies import drag_constant, terminal_speed
from hodograph.engine import answers, domain, fields, labels, power, scene, state
from hodograph.engine.domain import FloatArray, Scalar, T
from hodograph.engine.fields import Scene
from hodograph.engine.results import Landing, State, Trajectory
from hodograph.engine.status import Status
from hodograph.level import cheapest
from hodograph.tiers import dial

__all__ = ["Landing", "Launch", "State", "Trajectory"]

SPACINGS = {"arc": "s", "time": "t", "x": "x"}
FROM_BODY = "from_body(v0, alpha0, mass=..., cd=..., diameter=...)"
OTHERS = dict.fromkeys(("mass", "cd", "diameter", "area", "rho"), FROM_BODY)  # what takes them
OTHERS["k"] = "from_drag(v0, alpha0, k)"


@dataclass(frozen=True, eq=False, repr=False)
class Launch(Scene[T]):
    """A launch under gravity and drag, quadratic unless `n` says otherwise, in SI units.

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
        Height of the launch above the ground at x = 0 in m, in [-1e30, 1e30]; negative for
        ground above it, which is met from above.
    slope : array_like, optional
        Angle of the ground in radians, rising along x, in (-pi/2, pi/2).
    wind, crosswind : array_like, optional
        Speed of the air in m/s along x, and along z, to the side, in [-1e30, 1e30]; v0 and alpha0
        are those seen from the ground.

    Notes
    -----
    The fields are read-only arrays of the launch's own.  Launches are compared by value (NaN is
    equal to NaN); an array of them has a length, elements and slices.  v0 / v_lim,
    the winds over v_lim and abs(height) g / v_lim^2 are at most 1e20.

    Every answer is told from the ground, but for lengths of path, which are those through the
    air: in a wind they are not those of the path over the ground.

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

    if TYPE_CHECKING:  # what may come in is wider than what is held

        @overload
        def __init__(
            self: Launch[np.float64],
            v0: Scalar,
            alpha0: Scalar,
            v_lim: Scalar,
            **scene: Unpack[fields.Options],
        ) -> None: ...
        @overload
        def __init__(
            self: Launch[FloatArray],
            v0: ArrayLike,
            alpha0: ArrayLike,
            v_lim: ArrayLike,
            **scene: Unpack[fields.ManyOptions],
        ) -> None: ...
        def __init__(self, *args: Any, **kwargs: Any) -> None: ...

    else:

        def __new__(cls, *args, **options):
            """Tell who describes a body, or its drag, which constructor takes that."""
            for word in options.keys() & OTHERS.keys():
                raise TypeError(f"Launch takes no {word}: use Launch.{OTHERS[word]}")
            return super().__new__(cls)

    @overload
    @classmethod
    def from_drag(
        cls, v0: Scalar, alpha0: Scalar, k: Scalar, **scene: Unpack[fields.Options]
    ) -> Launch[np.float64]: ...
    @overload
    @classmethod
    def from_drag(
        cls, v0: ArrayLike, alpha0: ArrayLike, k: ArrayLike, **scene: Unpack[fields.ManyOptions]
    ) -> Launch[FloatArray]: ...
    @classmethod
    def from_drag(
        cls,
        v0: ArrayLike,
        alpha0: ArrayLike,
        k: ArrayLike,
        *,
        n: ArrayLike = 2.0,
        **surroundings: Any,
    ) -> Launch[Any]:
        """A launch given by its drag coefficient over mass, k = lambda/m >= 0 (eq. 12).

        Parameters
        ----------
        v0, alpha0 : array_like
            As for `Launch`.
        k : array_like
            lambda / m, in 1/m for n = 2; v_lim = (g / k)^(1/n), and 0 is vacuum.
        n : array_like, optional
            Drag grows as the n-th power of the speed, n in [1, 10].
        **surroundings : array_like
            g, height, slope, wind and crosswind, as for `Launch`.

        Returns
        -------
        Launch
            The launch.

        Examples
        --------
        >>> round(float(Launch.from_drag(40.0, 0.7, 0.005376).v_lim), 3)
        42.717
        """
        labels.one_index(v0=v0, alpha0=alpha0, k=k, n=n, **surroundings)
        square = terminal_speed(k, g=surroundings.get("g", 9.81))  # sqrt(g / k), whatever n
        with np.errstate(over="ignore"):  # a terminal speed beyond the doubles is vacuum
            v_lim = square ** (2 / domain.checked("n", n, power.EXPONENT))
        return cls(v0, alpha0, v_lim, n=n, **surroundings)

    @overload
    @classmethod
    def from_body(
        cls, v0: Scalar, alpha0: Scalar, **body: Unpack[fields.Body]
    ) -> Launch[np.float64]: ...
    @overload
    @classmethod
    def from_body(
        cls, v0: ArrayLike, alpha0: ArrayLike, **body: Unpack[fields.ManyBodies]
    ) -> Launch[FloatArray]: ...
    @classmethod
    def from_body(
        cls,
        v0: ArrayLike,
        alpha0: ArrayLike,
        *,
        mass: ArrayLike,
        cd: ArrayLike,
        diameter: ArrayLike | None = None,
        area: ArrayLike | None = None,
        rho: ArrayLike = 1.225,
        **surroundings: Any,
    ) -> Launch[Any]:
        """A launch of a body under quadratic drag, from its mass, size and drag coefficient.

        Parameters
        ----------
        v0, alpha0 : array_like
            As for `Launch`.
        mass, cd, diameter, area, rho : array_like
            The body and the air, as for `hodograph.bodies.drag_constant`.
        **surroundings : array_like
            g, height, slope, wind and crosswind, as for `Launch`.

        Returns
        -------
        Launch
            The launch.

        Examples
        --------
        >>> ball = Launch.from_body(40.0, 0.7, mass=0.145, cd=0.35, diameter=0.074)
        >>> round(float(ball.v_lim), 2), round(float(ball.range()), 2)
        (39.28, 95.49)
        """
        body = {"mass": mass, "cd": cd, "diameter": diameter, "area": area, "rho": rho}
        labels.one_index(v0=v0, alpha0=alpha0, **body, **surroundings)
        k = drag_constant(mass, cd, diameter=diameter, area=area, rho=rho)
        v_lim = terminal_speed(k, g=surroundings.get("g", 9.81))
        return cls(v0, alpha0, v_lim, **surroundings)

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
            quadratic drag, in no wind, are then answered in the cheapest way known to meet it (see
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
        wanted = None if rtol is None else dial.choice(rtol, None)
        if wanted is None or not self.is_bare:
            return cast("T", answers.landing(self, "x")[0])
        by_one = partial(dial.range_alone, wanted=wanted)
        return cast("T", answers.level_range(self, cheapest(wanted), by_one))

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
        return cast("T", answers.landing(self, "t")[0])

    def landing(self) -> Landing[T]:
        """Everything about the landing.

        Returns
        -------
        Landing
            Place, time, speed, slope angle, arc length, status and error estimate.

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
        names: tuple[str, ...] = ("x", "t", "speed", "alpha", "arc_length", "error")
        names += () if self.is_bare else ("y", "z")
        *rows, status = answers.landing(self, *names)
        found = dict(zip(names, rows, strict=True))
        if self.is_bare:
            found["y"], found["z"] = 0 * found["x"], 0 * found["x"]
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
        x, y, t = answers.apex(self)
        return x, y, t

    @overload
    def at(
        self: Launch[np.float64], *, rising: bool | None = None, **place: Unpack[fields.Place]
    ) -> State[np.float64]: ...
    @overload
    def at(self, *, rising: bool | None = None, **place: Unpack[fields.Places]) -> State[Any]: ...
    def at(
        self,
        *,
        t: ArrayLike | None = None,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        s: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        rising: bool | None = None,
    ) -> State[Any]:
        """The state of the flight at a place of its path, and on past any ground.

        Parameters
        ----------
        t, x, y, s, alpha : array_like
            Exactly one of them, broadcast against the launch: the time in s and the length of
            path through the air in m, not negative; the distance and the height, as in
            `Trajectory`, in m; or the slope angle in radians, from alpha0 down.
        rising : bool, optional
            Goes with `y`: whether the path is there on its way up, or (as a rule) down.

        Returns
        -------
        State
            Time, place, speed, slope angle and length of path, of the common shape.  They are
            NaN, and the status 1, where the path never comes: beyond its asymptote, above its
            highest point, at an angle that it never had.  A headwind may turn a path back; then
            `x` is where it is first.

        Raises
        ------
        ValueError
            A value lies outside its range, or an angle is asked for in a wind, where over the
            ground a path may have it twice, or never.
        TypeError
            Not exactly one place is given, or it is not made of real numbers.

        Examples
        --------
        >>> import numpy as np
        >>> launch = Launch(40.0, np.pi / 4, 42.7)
        >>> net = launch.at(x=[50.0, 100.0, 500.0])
        >>> net.y.round(2), net.t.round(3), net.status
        (array([30.4 ,  1.12,   nan]), array([2.104, 4.939,   nan]), array([0, 0, 1], dtype=int8))
        """
        places = {"t": t, "x": x, "y": y, "s": s, "alpha": alpha}
        name, value = state.chosen(places, rising, self)
        (t, x, y, z, speed, alpha, s), status = answers.states(self, name, value, bool(rising))
        return State(t, x, y, z, speed, alpha, s, status, status == Status.CONVERGED)

    def trajectory(self, points: int = 200, spacing: str = "arc") -> Trajectory:
        """Points of the path from the launch to the landing.

        Parameters
        ----------
        points : int, optional
            How many, at least 2.
        spacing : {"arc", "time", "x"}, optional
            In what they are evenly spaced: the length of path through the air, the time, or the
            distance (then without a headwind, in which a path may turn back).

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
        if spacing not in SPACINGS:
            raise ValueError(f"spacing must be one of {', '.join(SPACINGS)}; got {spacing!r}")
        if spacing == "x" and np.any(np.less(self.wind, 0)):
            raise ValueError("spacing='x' is not for a headwind, in which a path may turn back")
        if spacing == "arc" and self.is_bare:
            t, *rows = answers.run(self, scene.paths(points), 6, answers.BARE, inner=(points,))[0]
            x, y, *others = rows
            return Trajectory(t, x, y, 0 * t, *others)
        end = self.landing()
        last = {"arc": end.arc_length, "time": end.t, "x": end.x}[spacing]
        rows = answers.path(self, SPACINGS[spacing], last, points)
        ends = end.t, end.x, end.y, end.z, end.speed, end.alpha, end.arc_length
        for row, final in zip(rows, ends, strict=True):
            row[..., -1] = final
        return Trajectory(*rows)
