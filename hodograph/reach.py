"""What reaches a place: the shot that hits it, the least speed, the envelope, the best angle."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import aim_alone, domain, one, power, targets
from hodograph.engine.domain import FloatArray, Scalar
from hodograph.engine.driver import apply
from hodograph.engine.results import Envelope, LeastSpeed, Shot
from hodograph.engine.status import Status
from hodograph.laws.own import alpha_max_alone
from hodograph.level import best_on_level_ground

ARCS = {"low": -1.0, "high": 1.0}
AT_REST = (0.0, 0.0, 0.0)

__all__ = ["Envelope", "LeastSpeed", "Shot", "aim", "best_angle", "envelope", "least_speed"]


@overload
def aim(
    v0: Scalar,
    x: Scalar,
    y: Scalar,
    v_lim: Scalar,
    *,
    arc: str = "low",
    n: Scalar = 2.0,
    g: Scalar = 9.81,
    wind: Scalar = 0.0,
    crosswind: Scalar = 0.0,
    velocity: Sequence[Scalar] = (0.0, 0.0, 0.0),
) -> Shot[np.float64]: ...
@overload
def aim(
    v0: ArrayLike,
    x: ArrayLike,
    y: ArrayLike,
    v_lim: ArrayLike,
    *,
    arc: str = "low",
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    wind: ArrayLike = 0.0,
    crosswind: ArrayLike = 0.0,
    velocity: Sequence[ArrayLike] | FloatArray = (0.0, 0.0, 0.0),
) -> Shot[FloatArray]: ...
def aim(
    v0: ArrayLike,
    x: ArrayLike,
    y: ArrayLike,
    v_lim: ArrayLike,
    *,
    arc: str = "low",
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    wind: ArrayLike = 0.0,
    crosswind: ArrayLike = 0.0,
    velocity: Any = AT_REST,
) -> Shot[Any]:
    """The launch that hits a target, met while climbing or while falling.

    Parameters
    ----------
    v0 : array_like
        Launch speed in m/s, in [1e-30, 1e30].
    x, y : array_like
        Where the target is at the launch, from the muzzle: distance along x and height in m.  A
        target at negative x lies behind: the launch is towards it, at the azimuth pi.
    v_lim : array_like
        Terminal speed of fall in m/s, at least 1e-30; ``inf`` is vacuum.  v0 / v_lim is at most
        1e20.
    arc : {"low", "high"}
        Which of the two launches, one below and one above the angle that reaches highest there.
        In a wind or for a moving target, the earliest and the latest hit; where a falling target
        can be hit more than twice, two of these.
    n : array_like, optional
        Drag grows as the n-th power of the speed, n in [1, 10].
    g : array_like, optional
        Gravity in m/s^2, positive.
    wind, crosswind : array_like, optional
        Speed of the air in m/s, horizontal: along x, and along z.
    velocity : sequence of three array_like, optional
        Constant velocity of the target in m/s: along x, upward, and along z.

    Returns
    -------
    Shot
        Launch angle, azimuth, time, speed and slope of the hit, shortfall and status.  The target
        is missed by no more than some 1e-13 of the size of the flight.  Near the envelope, where
        both arcs meet, angles are as good as that allows: to about 1e-8 on the envelope itself.
        A target at the muzzle is hit at once by the low arc, whose angles are told as 0, and by
        the high one when it has come back from straight up.

    Warns
    -----
    RuntimeWarning
        Some iterations did not converge; one warning for the call.

    Raises
    ------
    ValueError
        An element lies outside its range, the shapes do not broadcast, or `arc` is unknown.
    TypeError
        An argument is not made of real numbers, or `velocity` not of three components.

    Examples
    --------
    >>> import numpy as np
    >>> low, high = (aim(40.0, 10.0, 20.0, 40.0, arc=arc) for arc in ("low", "high"))
    >>> np.rad2deg([low.alpha0, high.alpha0]).round(5)
    array([65.52533, 86.72944])
    """
    if arc not in ARCS:
        raise ValueError(f"arc must be 'low' or 'high'; got {arc!r}")
    by_one = partial(aim_alone.shot, arc == "high")
    scene: tuple[Any, ...] = v0, x, y, v_lim, n, g, wind, crosswind
    if (
        velocity is AT_REST
        and _is_legal(*scene)
        and (alone := by_one(*(float(part) for part in scene)))
    ):
        return _shot([np.float64(part) for part in alone], np.int8(Status.CONVERGED))
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        x=(x, domain.HEIGHT),
        y=(y, domain.HEIGHT),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        n=(n, power.EXPONENT),
        g=(g, domain.GRAVITY),
        wind=(wind, domain.WIND),
        crosswind=(crosswind, domain.WIND),
        **{f"velocity[{i}]": (part, domain.WIND) for i, part in enumerate(_components(velocity))},
    )
    _check(arrays[0], arrays[3], arrays[5], *arrays[1:3])
    kernel = targets.shots(ARCS[arc])
    rows, status = apply(
        kernel, shape, arrays, len(targets.ROWS), exponent=4, alone=by_one, what="aim", always=1
    )
    return _shot(rows, status)


def _shot(rows: list[Any], status: Any) -> Shot[Any]:
    found = dict(zip(targets.ROWS, rows, strict=True))
    return Shot(**found, status=status, success=status == Status.CONVERGED)


def _is_legal(
    v0: Any, x: Any, y: Any, v_lim: Any, n: Any, g: Any, wind: Any, crosswind: Any
) -> bool:
    """Whether these are plain numbers that make a legal scene, as `domain` has it."""
    moving = one.is_within(domain.LEAST, v0, domain.MOST)
    still = one.is_within(0.0, wind, 0.0) and one.is_within(0.0, crosswind, 0.0)
    return moving and still and all(one.is_legal(v0, 0.0, v_lim, g, a, n) for a in (x, y))


def _components(velocity: Any) -> tuple[Any, Any, Any]:
    try:
        x, y, z = velocity
    except (TypeError, ValueError):
        raise TypeError(
            "velocity must be three components: along x, upward, and along z, in m/s"
        ) from None
    return x, y, z


def _check(v0: FloatArray, v_lim: FloatArray, g: FloatArray, *lengths: FloatArray) -> None:
    """The ratios of a scene, whose parts are legal one by one."""
    for length in lengths:
        domain.check_scene(v0, v_lim, g, length)


@overload
def least_speed(
    x: Scalar, y: Scalar, v_lim: Scalar, *, n: Scalar = 2.0, g: Scalar = 9.81, wind: Scalar = 0.0
) -> LeastSpeed[np.float64]: ...
@overload
def least_speed(
    x: ArrayLike,
    y: ArrayLike,
    v_lim: ArrayLike,
    *,
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    wind: ArrayLike = 0.0,
) -> LeastSpeed[FloatArray]: ...
def least_speed(
    x: ArrayLike,
    y: ArrayLike,
    v_lim: ArrayLike,
    *,
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    wind: ArrayLike = 0.0,
) -> LeastSpeed[Any]:
    """The least launch speed that hits a target, and the angle that goes with it.

    Parameters
    ----------
    x, y, v_lim, n, g, wind : array_like
        As for `aim`.

    Returns
    -------
    LeastSpeed
        Speed in m/s and angle in radians, to about 1e-13: without drag sqrt(g (y + d)), d the
        distance of the target, at half the angle between its direction and the vertical.  NaN
        where an input is NaN; where more than 1e8 times that or v_lim is needed, which is told as
        unreachable; and where the iteration failed (with one `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    Over a fence of 3 m at 120 m, hit from 1 m:

    >>> import numpy as np
    >>> from hodograph.bodies import terminal_speed
    >>> k = 0.3 * 1.196 * np.pi * 0.0375**2 / 2 / 0.145
    >>> found = least_speed(120.0, 2.0, terminal_speed(k))
    >>> round(float(found.v0), 6), round(float(np.rad2deg(found.alpha0)), 5)
    (46.385716, 40.94419)
    """
    shape, arrays = domain.broadcast(
        x=(x, domain.HEIGHT),
        y=(y, domain.HEIGHT),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        n=(n, power.EXPONENT),
        g=(g, domain.GRAVITY),
        wind=(wind, domain.WIND),
    )
    _check(0 * arrays[0], arrays[2], arrays[4], *arrays[:2])
    rows, status = apply(targets.least_speeds, shape, arrays, 2, exponent=3, what="speed")
    return LeastSpeed(rows[0], rows[1], status=status, success=status == Status.CONVERGED)


@overload
def envelope(
    v0: Scalar, x: Scalar, v_lim: Scalar, *, n: Scalar = 2.0, g: Scalar = 9.81, wind: Scalar = 0.0
) -> Envelope[np.float64]: ...
@overload
def envelope(
    v0: ArrayLike,
    x: ArrayLike,
    v_lim: ArrayLike,
    *,
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    wind: ArrayLike = 0.0,
) -> Envelope[FloatArray]: ...
def envelope(
    v0: ArrayLike,
    x: ArrayLike,
    v_lim: ArrayLike,
    *,
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    wind: ArrayLike = 0.0,
) -> Envelope[Any]:
    """The greatest height that launches of one speed reach at a distance.

    Parameters
    ----------
    v0, x, v_lim, n, g, wind : array_like
        As for `aim`.

    Returns
    -------
    Envelope
        Height in m above the muzzle, negative below it, and the angle in radians that reaches it,
        to about 1e-13: without drag the parabola v0^2 / 2 g - g x^2 / 2 v0^2.  NaN and unreachable
        where no launch ever comes so far.

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    >>> envelope(40.0, [0.0, 50.0, 100.0, 150.0], 42.7).y.round(3)
    array([ 58.542,  45.579,   1.836, -96.328])
    """
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        x=(x, domain.HEIGHT),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        n=(n, power.EXPONENT),
        g=(g, domain.GRAVITY),
        wind=(wind, domain.WIND),
    )
    _check(arrays[0], arrays[2], arrays[4], arrays[1])
    rows, status = apply(targets.envelopes, shape, arrays, 2, exponent=3, what="envelope")
    return Envelope(rows[0], rows[1], status=status, success=status == Status.CONVERGED)


@overload
def best_angle(
    v0: Scalar,
    v_lim: Scalar,
    *,
    n: Scalar = 2.0,
    g: Scalar = 9.81,
    height: Scalar = 0.0,
    slope: Scalar = 0.0,
    wind: Scalar = 0.0,
) -> np.float64: ...
@overload
def best_angle(
    v0: ArrayLike,
    v_lim: ArrayLike,
    *,
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
    slope: ArrayLike = 0.0,
    wind: ArrayLike = 0.0,
) -> FloatArray: ...
def best_angle(
    v0: ArrayLike,
    v_lim: ArrayLike,
    *,
    n: ArrayLike = 2.0,
    g: ArrayLike = 9.81,
    height: ArrayLike = 0.0,
    slope: ArrayLike = 0.0,
    wind: ArrayLike = 0.0,
) -> Any:
    """Launch angle of greatest range along x, for any landing ground and in any wind.

    Parameters
    ----------
    v0, v_lim, n, g, wind : array_like
        As for `aim`.
    height : array_like, optional
        Height of the launch above the landing ground at x = 0 in m; negative for a target above.
    slope : array_like, optional
        Angle of that ground in radians, rising along x, in (-pi/2, pi/2).

    Returns
    -------
    float or ndarray
        The angle in radians, in [-pi/2, pi/2] (a strong wind may carry a launch backward farther),
        to about 1e-13: without drag or height pi/4 + slope/2.  NaN where an input is NaN; where no
        angle reaches the ground, or the wind carries a launch down a slope for ever; and where
        the iteration failed (with one `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    A shot of 14 m/s without drag, put from 2 m: tan(alpha) = v0 / sqrt(v0^2 + 2 g h)

    >>> import numpy as np
    >>> round(float(np.rad2deg(best_angle(14.0, np.inf, height=2.0))), 4)
    42.3896
    """
    moving = one.is_within(domain.LEAST, v0, domain.MOST)
    if moving and (found := _best_alone(v0, v_lim, g, height, n, slope, wind)) is not None:
        return np.float64(found)
    shape, arrays = domain.broadcast(
        v0=(v0, domain.MOVING),
        v_lim=(v_lim, domain.TERMINAL_SPEED),
        g=(g, domain.GRAVITY),
        height=(height, domain.HEIGHT),
        n=(n, power.EXPONENT),
        slope=(slope, domain.GROUND),
        wind=(wind, domain.WIND),
    )
    domain.check_scene(*arrays[:4])
    kernel = targets.best_angles(best_on_level_ground)
    return apply(kernel, shape, arrays, 1, exponent=4, alone=_best_alone, what="angle")[0][0]


def _best_alone(
    v0: Any, v_lim: Any, g: Any, height: Any, n: Any, slope: Any, wind: Any
) -> float | None:
    """The angle of one launch in plain floats, on level ground in still air; None otherwise."""
    still = one.is_within(0.0, slope, 0.0) and one.is_within(0.0, wind, 0.0)
    if not still:
        return None
    return one.best_angle(v0, v_lim, g, height, n, guess=alpha_max_alone)
