"""Power-law drag at any number of digits, with mpmath: an independent path to the truth.

Lengths are in v_lim²/g, times in v_lim/g, speeds in v_lim, angles in radians.  The equations are
in `hodograph.witness.reference_panels`; how a place or a landing is found along the path, in
`reference_march` and `reference_landing`.

All arguments are floats, mpmath's ``mpf``, whole numbers, fractions or strings, and count as the
exact numbers they are: the float ``math.pi / 2`` is a launch at 6e-17 rad from the vertical, and
a string is read at full working precision.

``v_norm``
    Launch speed over v_lim, > 0; 0 too for what concerns level ground.
``alpha0``
    Launch slope, from straight down to straight up; upward or level on level ground.
``height``
    Launch height above the landing plane; negative for a target above.
``slope``
    Angle of the ground, in (-pi/2, pi/2): it is met from above, where y = x tan(slope).
``n``
    Power of the speed that drag grows with, in [1, 10]; 2 is the paper's.
``dps``
    Significant digits wanted.  Results are ``mpmath.mpf`` rounded to so many.

A wrong type is a `TypeError`.  An illegal value, and a place or a landing plane that the path
does not reach, are a `ValueError`.  ``mpmath.mp`` is left alone, and threads may call at will.
"""

from dataclasses import dataclass
from typing import Any

import mpmath

from hodograph.witness import reference_landing as landing
from hodograph.witness import reference_numbers as read
from hodograph.witness.reference_march import to_slope
from hodograph.witness.reference_numbers import all_rounded, ctx, rounded, working, zero

__all__ = [
    "Flight", "Position", "Sensitivity", "d_norm", "flight", "landing_angle", "optimal_angle",
    "position", "sensitivity",
]  # fmt: skip


@dataclass(frozen=True)
class Flight:
    """A whole flight: the landing, then the apex measured from the launch point."""

    x: mpmath.mpf
    t: mpmath.mpf
    alpha: mpmath.mpf
    speed: mpmath.mpf
    arc_length: mpmath.mpf
    apex_x: mpmath.mpf
    apex_y: mpmath.mpf
    apex_t: mpmath.mpf


@dataclass(frozen=True)
class Position:
    """The state at one point of the path, measured from the launch point."""

    x: mpmath.mpf
    y: mpmath.mpf
    t: mpmath.mpf
    speed: mpmath.mpf
    arc_length: mpmath.mpf
    alpha: mpmath.mpf


@dataclass(frozen=True)
class Sensitivity:
    """The range and its derivatives, the landing plane held where it is."""

    range: mpmath.mpf  # v_lim²/g
    alpha0: mpmath.mpf  # v_lim²/g per radian
    v0: mpmath.mpf  # v_lim/g, at fixed v_lim
    v_lim: mpmath.mpf  # v_lim/g, at fixed v0
    height: mpmath.mpf  # length per length that the launch is raised


def flight(
    v_norm: Any, alpha0: Any, height: Any = 0, *, slope: Any = 0, n: Any = 2, dps: int = 30
) -> Flight:
    """Fly from the launch to the landing: on level ground, on the way down.

    A downward launch has its apex at the launch point; steep ground may cut the path short of
    it.  A launch from height 0 that climbs no more than the ground lands where it starts.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(flight(1, "0.5", dps=40).x, 40))
    0.548298974589262505892437829237004664949
    >>> print(mpmath.nstr(flight(1, "0.5", n="2.5").x, 20))
    0.56691925376495858775
    """
    with working(dps):
        h = read.number("height", height)
        v, a0 = read.speed(v_norm), read.angle("alpha0", alpha0)
        ground = read.angle("slope", slope)
        return all_rounded(_fly(v, a0, read.power(n), h, dps, ground), dps)


def _fly(
    v: read.Exact,
    a0: read.Exact,
    n: read.Exact,
    height: read.Exact,
    dps: int,
    slope: read.Exact = zero,
) -> Flight:
    h, top, fall = landing.land(v, a0, n, height, dps, slope=slope)
    apex = to_slope(h, h.start(), zero()) if h.tilt else top
    if fall is None:
        return Flight(zero(), zero(), a0(), v(), zero(), apex.x, apex.y, apex.t)
    end = top.joined(fall)
    alpha = ctx.atan(ctx.sinh(end.s))
    return Flight(end.x, end.t, alpha, h.speed(end), end.s_arc, apex.x, apex.y, apex.t)


def position(
    v_norm: Any,
    alpha0: Any,
    alpha: Any = None,
    *,
    t: Any = None,
    x: Any = None,
    s: Any = None,
    y: Any = None,
    rising: bool = False,
    n: Any = 2,
    dps: int = 30,
) -> Position:
    """Find the state where the path has one slope, time, distance, arc length or height.

    Exactly one is given: `alpha` in (-pi/2, alpha0]; the time `t`; the horizontal distance `x`,
    less than the path ever reaches; the arc length `s`; or the height `y` above the launch, on
    the way up if `rising`.

    Examples
    --------
    >>> import mpmath
    >>> top = position(1, "0.5", 0)
    >>> print(mpmath.nstr(top.y, 20))
    0.090317397437122537704
    >>> print(mpmath.nstr(position(1, "0.5", t=top.t, n=3).y, 20))
    0.092336046534418897881
    """
    places = {"alpha": alpha, "t": t, "x": x, "s": s, "y": y}
    given = [name for name, value in places.items() if value is not None]
    if len(given) != 1:
        raise TypeError(f"give exactly one of alpha, t, x, s and y, got {given or 'none'}")
    (name,) = given
    with working(dps):
        v, a0 = read.speed(v_norm), read.angle("alpha0", alpha0)
        place = read.number(name, places[name])
        h, point = landing.place(v, a0, read.power(n), name, place, rising, dps)
        slant = place() if name == "alpha" else ctx.atan(ctx.sinh(point.s))
        if point.delta == 0:
            slant = a0()
        high = place() if name == "y" else point.y
        found = Position(point.x, high, point.t, h.speed(point), point.s_arc, slant)
        return all_rounded(found, dps)


def sensitivity(
    v_norm: Any, alpha0: Any, height: Any = 0, *, n: Any = 2, dps: int = 30
) -> Sensitivity:
    """The range and its derivatives in alpha0, v0, v_lim and height.

    A launch that lands where it starts has none, and is refused.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(sensitivity(1, "0.5").alpha0, 20))
    0.43032771562832005448
    """
    with working(dps):
        h = read.number("height", height)
        v, a0 = read.speed(v_norm), read.angle("alpha0", alpha0)
        return all_rounded(Sensitivity(*landing.derivatives(v, a0, read.power(n), h, dps)), dps)


def d_norm(v_norm: Any, alpha0: Any, *, n: Any = 2, dps: int = 30) -> mpmath.mpf:
    """Range on level ground over range in a vacuum (eq. 21), in (0, 1].

    It is 1 at v_norm = 0 and at alpha0 = 0.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(d_norm(1, "0.5"), 30))
    0.6515958179050420125449915259
    """
    with working(dps):
        v, a0 = read.level_launch(v_norm, alpha0)
        power = read.power(n)
        if v() == 0 or a0() == 0:
            return mpmath.mpf(1)
        x = _fly(v, a0, power, zero, dps).x
        return rounded(x / (v() ** 2 * ctx.sin(2 * a0())), dps)


def landing_angle(v_norm: Any, alpha0: Any, *, n: Any = 2, dps: int = 30) -> mpmath.mpf:
    """Slope at the landing on level ground, in (-pi/2, 0]; -alpha0 at v_norm = 0.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(landing_angle(1, "0.5"), 30))
    -0.672884758034068958533869136249
    """
    with working(dps):
        v, a0 = read.level_launch(v_norm, alpha0)
        power = read.power(n)
        if v() == 0 or a0() == 0:
            return rounded(-a0(), dps)
        return rounded(_fly(v, a0, power, zero, dps).alpha, dps)


def optimal_angle(v_norm: Any, *, n: Any = 2, dps: int = 30) -> mpmath.mpf:
    """Launch angle of greatest range on level ground; pi/4 at v_norm = 0.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(mpmath.degrees(optimal_angle(1)), 20))
    40.977509184015531218
    """
    with working(dps):
        v, power = read.speed(v_norm, rest=True), read.power(n)
        return rounded(landing.best_angle(v, power, dps) if v() else ctx.pi / 4, dps)
