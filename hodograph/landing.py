"""The landing: the slope at which a given drop is reached, by Newton (eq. 20).

The fall is solved in P = tan^2(alpha).  With Y the height fallen in units of v_lim^2 / g, a the
start of the fall and w the square of the horizontal speed there,

    H(P) = expm1(2 w Y) / w,    dH/dP = exp(2 w Y) / u > 0,
    d ln(dH/dP) / dP = (w / u) (1 - sqrt(1 + 1 / P)) < 0.

H is what a vertical fall would make a straight line of: it increases and is concave, and
H <= P - P_a.  Newton in H therefore converges from every start, from below after at most one
step, and P_a + H(target) is a start from below.  After one full quadrature each later step
integrates only over the interval between two iterates.
"""

from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import quad
from scipy.special import exprel

from hodograph import domain, velocity
from hodograph.domain import FloatArray
from hodograph.position import FASTEST, arc, run_in
from hodograph.velocity import Start, log1p_ratio

CONVERGED, UNREACHABLE, NOT_CONVERGED, LEFT_DOMAIN = 0, 1, 2, 3

LAUNCHES_AT_ONCE = 16384
MAX_STEPS = 30
LAST_STEP = 1e-5  # of P: the iteration is of third order, so what remains is its cube
TERMINAL = 45.0  # depth of fall, past the loss of launch speed, where all but y and t is final
EPSILON = float(np.finfo(np.float64).eps)
SHALLOWEST = 1e-145  # below it a level flight is vacuum's for every v <= FASTEST, and scales


class Flight(NamedTuple):
    """Landings in units of the launch: lengths v_e^2 / g, times v_e / g, speeds v_e.

    v_e is v_norm, or `position.FASTEST` where that is less.  `reach` is x / cos(alpha0) and
    `tangent` is -tan(alpha_s).  What was not asked for is empty.
    """

    reach: FloatArray
    t: FloatArray
    speed: FloatArray
    tangent: FloatArray
    run_in: FloatArray  # path before the slope changes, while it does, and after, in v_e^2 / g
    curve: FloatArray
    tail: FloatArray
    delta: FloatArray  # slope come down in all, asinh(tan alpha0) + asinh(tangent)
    status: NDArray[np.int8]
    steps: NDArray[np.int8]
    error: FloatArray


class _Fall(NamedTuple):
    """Falls in units of v_x^2 / g and v_x / g, v_x the horizontal speed where they begin."""

    P: FloatArray
    delta: FloatArray
    sums: dict[str, FloatArray]  # y, and x / cos(alpha0), t if wanted
    error: FloatArray  # relative, of P: the cube of the last step
    steps: NDArray[np.int8]


def _thickness(P: FloatArray) -> FloatArray:
    """F(p) - p^2 at P = p^2: it grows as 2 p, then as a logarithm."""
    p = np.sqrt(P)
    return np.asarray(p / (np.sqrt(1 + P) + p) + np.arcsinh(p))


def _slope_gain(P0: FloatArray, P1: FloatArray, gain: FloatArray) -> FloatArray:
    """asinh(sqrt P1) - asinh(sqrt P0) from gain = P1 - P0, without subtracting the two."""
    span = np.sqrt(P1) * np.sqrt(1 + P0) + np.sqrt(P0) * np.sqrt(1 + P1)
    return np.arcsinh(gain / np.where(span > 0, span, 1.0))


def _descend(begin: Start, P_start: FloatArray, drop: FloatArray, wanted: tuple[str, ...]) -> _Fall:
    """Fall by `drop`, in units of v_x^2 / g, from slopes that are level or downward."""
    cos2 = begin.plus * begin.minus
    w = begin.v2 * cos2
    least = 2 * drop * exprel(2 * w * drop)  # H at the target: P - P_start is at least that
    thickness = _thickness(P_start)
    gain = least
    for _ in range(2):  # first guess: the thickness of u held at a mean value
        p = np.sqrt(P_start + gain)
        mean = (_thickness(P_start + gain) - thickness) * (2 / 3 + p) / (1 + p)
        gain = np.maximum((1 + w * mean) * least, least)
    P = P_start + gain
    delta = _slope_gain(P_start, P, gain)
    u = 1 + begin.v2 * velocity.bracket_gap(begin, delta)[0]
    sums = arc(begin, -np.arcsinh(np.sqrt(P_start)), delta, wanted)
    for name, sum_ in sums.items():
        sum_ /= cos2 if name == "y" else np.sqrt(cos2)

    error, steps = np.zeros_like(P), np.zeros(P.shape, np.int8)
    live = np.flatnonzero(drop > 0)
    while live.size and (number := int(steps[live[0]]) + 1) <= MAX_STEPS:
        P_, u_, w_, gain_ = P[live], u[live], w[live], gain[live]
        miss = drop[live] + sums["y"][live]
        newton = 2 * u_ * miss * exprel(2 * w_ * miss)
        thin = np.sqrt(1 + 1 / P_)  # dF/dP
        halley = 1 + np.maximum(np.minimum(newton * w_ * (1 - thin) / (2 * u_), 0.5), -0.5)
        gain_next = np.maximum(gain_ + newton / halley, least[live])
        step = gain_next - gain_
        P_next = P_ + step
        P[live], gain[live], steps[live] = P_next, gain_next, number
        relative = np.abs(step) / gain_next
        error[live] = relative**3
        going = ~(relative <= LAST_STEP)

        # a last step is short: its integrals are the midpoint's
        P_mid, u_mid = P_ + step / 2, u_ + w_ * thin * step / 2
        across = np.where(going, 0.0, step) / (2 * np.sqrt(P_mid))
        if "x" in sums:
            sums["x"][live] += across / u_mid
        if "t" in sums:
            sums["t"][live] += across / np.sqrt(u_mid)
        if not going.any():
            break

        # any other is itself an arc, launched from the upper of its two ends
        live, P_, P_next, u_, w_, step = (part[going] for part in (live, P_, P_next, u_, w_, step))
        delta = _slope_gain(P_start[live], P_next, gain[live])
        u[live] = 1 + begin.v2[live] * velocity.bracket_gap(begin.at(live), delta)[0]
        down = step >= 0
        high, u_high = np.where(down, P_, P_next), np.where(down, u_, u[live])
        p, secant, scale = np.sqrt(high), np.sqrt(1 + high), (1 + high) / u_high
        from_high = Start(
            w_ * scale, -p / secant, 1 / (secant * (secant + p)), (secant + p) / secant
        )
        delta = _slope_gain(high, np.where(down, P_next, P_), np.abs(step))
        part = arc(from_high, -np.arcsinh(p), delta, wanted)
        units = {"y": scale, "x": scale / secant, "t": np.sqrt(scale)}
        for name, sum_ in sums.items():
            sum_[live] += np.sign(step) * part[name] * units[name]
    return _Fall(P, _slope_gain(P_start, P, gain), sums, error, steps)


def _fly(v: FloatArray, alpha0: FloatArray, height: FloatArray, wanted: tuple[str, ...]) -> Flight:
    """`fly` for one block of finite inputs."""
    fast, run = run_in(v)
    shrink = np.where((height == 0) & (alpha0 > 0) & (alpha0 < SHALLOWEST), alpha0 / SHALLOWEST, 1)
    alpha = np.where(shrink < 1, SHALLOWEST, alpha0)
    sin0, cos0 = np.sin(alpha), np.cos(alpha)
    downward = alpha <= 0
    v2 = fast * fast
    lim2 = np.where(run > 0, 1 / FASTEST**2, 0.0)  # v_lim^2 in units of v_e^2

    # up to the apex
    begin = velocity.start(v2, sin0, cos0)
    slope = np.arcsinh(np.where(downward, 0.0, sin0) / cos0)
    up = arc(begin, None, slope, wanted)
    gap_up = velocity.bracket_gap(begin, slope)[0]
    lands_in_it = downward & (sin0 * run * lim2 + height < 0)
    whole_run, run = run, np.where(lands_in_it, height / np.where(run > 0, -sin0 * lim2, 1), run)
    rise = up["y"] + sin0 * run * lim2
    fall = rise + height
    status = np.where(fall < 0, UNREACHABLE, CONVERGED).astype(np.int8)

    # and down from there, or from the launch itself
    across2 = cos0 * cos0 / (1 + v2 * gap_up)
    w = v2 * across2
    drop = np.maximum(fall, 0.0) / across2
    deepest = TERMINAL + np.log(np.maximum(w, 1.0)) / 2
    beyond = np.maximum(w * drop - deepest, 0.0)  # a fall at terminal speed, in v_lim^2 / g
    drop = np.where(beyond > 0, deepest / np.where(beyond > 0, w, 1.0), drop)
    tops = Start(
        np.where(downward, v2, w),
        *(
            np.where(downward, part, level)
            for part, level in zip(begin[1:], (0.0, 1.0, 1.0), strict=True)
        ),
    )
    down = _descend(tops, np.where(downward, (sin0 / cos0) ** 2, 0.0), drop, wanted)
    gap_down = velocity.bracket_gap(tops, down.delta)[0]
    status[~(down.error <= LAST_STEP**3)] = NOT_CONVERGED

    u = 1 + tops.v2 * gap_down
    fallen = np.where(downward, 1.0, across2) * gap_down
    tail = np.divide(beyond, v2, out=np.zeros_like(v2), where=beyond > 0)
    curve = 0.5 * (gap_up * log1p_ratio(v2 * gap_up) + fallen * log1p_ratio(tops.v2 * gap_down))
    reach = time = np.empty(0)
    if "x" in wanted:
        reach = shrink * (up["x"] + run * lim2 + across2 / cos0 * down.sums["x"])
    if "t" in wanted:
        run_time = np.expm1(run) / np.where(run > 0, v, 1.0) / np.where(run > 0, fast, 1.0)
        time = shrink * (up["t"] + np.sqrt(across2) * down.sums["t"] + tail * fast + run_time)
    worth = (np.abs(rise) + np.abs(height)) / np.where(fall > 0, fall, 1.0)  # condition of the drop
    error = EPSILON * (8 + 2 * slope + 2 * down.delta + worth) + down.error
    speed = np.sqrt(across2 * (1 + down.P) / u) * np.exp(whole_run - run)
    return Flight(
        reach,
        time,
        speed,
        shrink * np.sqrt(down.P),
        run * lim2,
        shrink * curve,
        tail,
        shrink * (slope + down.delta),
        status,
        down.steps,
        error,
    )


def fly(
    v: FloatArray, alpha0: FloatArray, height: FloatArray, *, x: bool = True, t: bool = True
) -> Flight:
    """Landings of launches with finite inputs in 1-D arrays, `height` in units of v_e^2 / g."""
    wanted = ("y", *("t",) * t, *("x",) * x)
    parts = [
        _fly(v[at], alpha0[at], height[at], wanted)
        for at in (
            slice(first, first + LAUNCHES_AT_ONCE)
            for first in range(0, max(v.size, 1), LAUNCHES_AT_ONCE)
        )
    ]
    return Flight(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def climb(v: FloatArray, alpha0: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x, y, t of the apex above the launch, in v_e^2 / g and v_e / g; the launch if downward."""
    fast, run = run_in(v)
    sin0, cos0 = np.sin(np.maximum(alpha0, 0.0)), np.cos(np.maximum(alpha0, 0.0))
    slope = np.arcsinh(sin0 / cos0)
    up = arc(velocity.start(fast * fast, sin0, cos0), None, slope, ("x", "y", "t"))
    run *= np.where(alpha0 > 0, 1 / FASTEST**2, 0.0)
    return cos0 * (up["x"] + run), up["y"] + sin0 * run, up["t"]


def fly_level(v_norm: ArrayLike, alpha0: ArrayLike, *, x: bool) -> tuple[Any, ...]:
    """(shape, v_norm, alpha0, indices of the elements that fly, their `Flight`), level ground.

    The limits v_norm = 0 and alpha0 = 0 and NaN are left to the caller.
    """
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    v, a0 = v.ravel(), a0.ravel()
    flying = np.flatnonzero((v > 0) & (a0 > 0))
    v_, a0_ = v[flying], a0[flying]
    return shape, v, a0, flying, fly(v_, a0_, np.zeros_like(v_), x=x, t=False)


def warn_not_converged(status: NDArray[np.int8]) -> None:
    """One `RuntimeWarning` for the call, with the count."""
    if failed := int(np.count_nonzero(status == NOT_CONVERGED)):
        warnings.warn(
            f"landing not converged for {failed} of {status.size} launches (NaN returned)",
            RuntimeWarning,
            stacklevel=3,
        )


def landing_angle(v_norm: ArrayLike, alpha0: ArrayLike) -> Any:
    """Slope angle of the path where it comes back to the launch height (eq. 20).

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, v0 / v_lim, finite and >= 0.
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].

    Returns
    -------
    float or ndarray
        alpha_s in radians, in [-pi/2, 0], of the broadcast shape: -alpha0 at v_norm = 0, steeper
        with drag.  NaN where an input is NaN, or where the iteration failed (with one
        `RuntimeWarning`).

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    >>> import numpy as np
    >>> np.rad2deg(landing_angle([0.0, 1.0, 10.0], np.pi / 4)).round(6)
    array([-45.      , -58.214966, -81.99632 ])
    """
    shape, v, a0, flying, flight = fly_level(v_norm, alpha0, x=False)
    alpha = np.where(np.isnan(v), np.nan, -a0)
    warn_not_converged(flight.status)
    alpha[flying] = np.where(flight.status == CONVERGED, -np.arctan(flight.tangent), np.nan)
    return domain.restore(alpha, shape)


class VialNewton(NamedTuple):
    """What the paper's own iteration gives: the last angle, the steps taken, and its status."""

    alpha: Any
    steps: Any
    status: Any


def newton_vial(
    v_norm: ArrayLike, alpha0: ArrayLike, *, stop: float = np.deg2rad(0.01), max_steps: int = 50
) -> VialNewton:
    """The landing angle by the iteration that the paper prints (eq. 20), for comparison.

    Newton on y(alpha) in the angle itself, from -alpha0, each integral taken afresh with
    `scipy.integrate.quad` over eq. 13 as printed, until two iterates differ by less than `stop`.
    It leaves (-pi/2, pi/2) at its first step for fast, steep launches: use `landing_angle`.

    Parameters
    ----------
    v_norm : array_like
        Launch speed over terminal speed, finite and >= 0.
    alpha0 : array_like
        Launch angle in radians, in [0, pi/2].
    stop : float, optional
        The paper's stopping difference in radians, 0.01 degree by default; positive.
    max_steps : int, optional
        Steps before the iteration is given up, at least 1.

    Returns
    -------
    VialNewton
        `alpha` (the last iterate, NaN where the iteration failed), `steps`, and `status`:
        0 converged, 2 not converged within `max_steps`, 3 left the domain.

    Examples
    --------
    >>> import numpy as np
    >>> result = newton_vial([1.0, 5.0], np.pi / 4)
    >>> np.rad2deg(result.alpha).round(3), result.steps, result.status
    (array([-58.215,     nan]), array([4, 1]), array([0, 3]))
    """
    shape, (v, a0) = domain.broadcast(
        v_norm=(v_norm, domain.NON_NEGATIVE), alpha0=(alpha0, domain.LEVEL_ANGLE)
    )
    domain.check("stop", domain.as_float("stop", stop), domain.POSITIVE)
    domain.count("max_steps", max_steps, 1)
    rows = [
        _newton_vial(*pair, stop, max_steps) for pair in zip(v.ravel(), a0.ravel(), strict=True)
    ]
    columns = zip(*rows, strict=True) if rows else ((), (), ())
    return VialNewton(*(domain.restore(np.array(column), shape) for column in columns))


def _newton_vial(v: float, alpha0: float, stop: float, max_steps: int) -> tuple[float, int, int]:
    if np.isnan(v) or np.isnan(alpha0):
        return np.nan, 0, CONVERGED
    if alpha0 == 0:
        return 0.0, 0, CONVERGED

    def primitive(a: float) -> float:  # the bracket of eq. 9
        return float(np.log(np.tan(a / 2 + np.pi / 4)) + np.sin(a) / np.cos(a) ** 2)

    def v2(a: float) -> float:  # eq. 13
        w = (v * np.cos(alpha0)) ** 2
        return float(w / np.cos(a) ** 2 / (1 - w * (primitive(a) - primitive(alpha0))))

    alpha = -alpha0
    for step in range(1, max_steps + 1):
        with np.errstate(all="ignore"):
            y = quad(lambda a: v2(a) * np.tan(a), alpha0, alpha, limit=200, full_output=1)[0]
            change = y / (v2(alpha) * np.tan(alpha)) if v > 0 else 0.0
        alpha -= change
        if not abs(alpha) < np.pi / 2:
            return np.nan, step, LEFT_DOMAIN
        if abs(change) < stop:
            return alpha, step, CONVERGED
    return np.nan, max_steps, NOT_CONVERGED
