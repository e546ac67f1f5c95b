"""What is asked of a path: its landing, a place on it, the derivatives and the best angle.

A result that is the difference of larger numbers is found again with as many digits more as the
first attempt shows to be lost.
"""

from typing import NamedTuple

import mpmath

from hodograph.witness.reference_march import NeverError, to_slope, top, until
from hodograph.witness.reference_numbers import Exact, ctx, digits, lost, s_of, zero
from hodograph.witness.reference_panels import Hodograph, Point, hodograph

_MAX_LOST = 200  # digits of cancellation between apex and target before giving up


class Landing(NamedTuple):
    """The launch, its top over the ground, and the fall from there.

    The top is the apex on level ground; the fall is None where the launch is the landing.
    """

    h: Hodograph
    top: Point
    fall: Point | None


def land(
    v: Exact,
    a0: Exact,
    n: Exact,
    height: Exact,
    dps: int,
    *,
    vary: bool = False,
    slope: Exact = zero,
) -> Landing:
    """Fly to the ground, which is met from above."""
    more = 0
    while True:
        h = hodograph(v, a0, n, dps + more, vary=vary, slope=slope)
        high, fall = top(h), None
        drop = h.value(high, "y") + height()
        now = lost(_size(h, high), drop)  # a target near the top cancels against it
        if now <= more + 2:
            if drop > 0:
                fall = until(h, high.origin(), "y", drop)[0]
                now = lost(_size(h, fall), drop) if h.tilt else 0
            if now <= more + 2:
                break
        more = now + more + 2
        if more > _MAX_LOST:
            raise ValueError(f"height is minus the apex to {_MAX_LOST} digits, got {height()}")
    if drop < 0:
        least = ctx.nstr(-h.value(high, "y"), 12)
        raise ValueError(f"height must be at least {least} (minus the apex), got {height()}")
    return Landing(h, high, fall)


def _size(h: Hodograph, at: Point) -> mpmath.mpf:
    """The size of the terms that make up the height over the ground; arc length bounds |y|."""
    return abs(h.tilt * at.x) + at.s_arc if h.tilt else abs(at.y)


def place(
    v: Exact, a0: Exact, n: Exact, name: str, value: Exact, rising: bool, dps: int
) -> tuple[Hodograph, Point]:
    """The point with one slope, or with one value of a quantity."""
    more = 0
    while True:
        h = hodograph(v, a0, n, dps + more)
        if name == "alpha":
            point, now = _at_slope(h, a0, value)
        else:
            point, now = _at(h, {"s": "s_arc"}.get(name, name), value(), rising)
        if now <= more + 2 or more > _MAX_LOST:
            return h, point
        more = now + 2


def _at_slope(h: Hodograph, a0: Exact, alpha: Exact) -> tuple[Point, int]:
    """The point of one slope, and how many digits were lost to cancellation."""
    a1 = alpha()
    near = a0() - a1
    if near < 0 or a1 < -2 or ctx.cos(a1) <= 0:
        raise ValueError(f"alpha must be in (-pi/2, alpha0], got {ctx.nstr(a1, 15)}")
    if near == 0:
        return h.start(), 0
    s = s_of(a1)
    if s >= 0:
        return to_slope(h, h.start(), s), digits(1 / near)
    apex = top(h)
    point = apex.joined(to_slope(h, apex.origin(), s))
    return point, max(digits(1 / near), lost(apex.y, point.y))


def _at(h: Hodograph, name: str, target: mpmath.mpf, rising: bool) -> tuple[Point, int]:
    """The point where a quantity has one value, and how many digits were lost."""
    climbs = h.s0 > 0
    if name != "y" and target < 0:
        raise ValueError(f"{name[0]} must be >= 0, got {ctx.nstr(target, 15)}")
    if target == 0 and (name != "y" or rising or not climbs):
        return h.start(), 0
    if climbs and (rising or name != "y"):
        point, reached = until(h, h.start(), name, target, zero())
        if reached:
            steep = lost(target, h.rate(point, name) * point.delta)
            return point, max(steep, 2 * lost(h.s0, point.s))
        apex = point
    else:
        apex = top(h)
    rest = apex.y - target if name == "y" else target - getattr(apex, name)
    if rest < 0 or (name == "y" and rising):
        most = ctx.nstr(apex.y, 12)
        raise ValueError(f"y must be at most {most}, the apex, got {ctx.nstr(target, 15)}")
    try:
        fall, _ = until(h, apex.origin(), name, rest)
    except NeverError as never:
        most = ctx.nstr(apex.x + never.args[0], 12)
        raise ValueError(f"x must be less than {most}, got {ctx.nstr(target, 15)}") from None
    point = apex.joined(fall)
    if name == "y":
        return point, lost(apex.y, rest)
    steep = lost(target, h.rate(point, name) * point.delta)
    return point, max(steep, lost(target, rest), lost(apex.y, point.y))


def derivatives(
    v: Exact, a0: Exact, n: Exact, height: Exact, dps: int
) -> tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf, mpmath.mpf, mpmath.mpf]:
    """The range; its derivatives in alpha0, v0, v_lim and height.

    A change of the launch shifts the point of slope s by (x', y'), and with q = −tan αs the
    landing by x' + (y' + height')/q.  At fixed s,

        x' = v_x0² cosh s0 s0' − (2/n) ∫ W' W^(−1−2/n) cosh s dδ,   and y' with sinh s as a factor,

    where W' is −n W0 v0'/v0, or n (W0 tanh s0 + coshⁿs0) s0', or −n (W − W0) v_lim'/v_lim.
    """
    more = 0
    while True:
        h, apex, fall = land(v, a0, n, height, dps + more, vary=True)
        if fall is None:
            raise ValueError("the launch is the landing: its range has no derivatives")
        q = -ctx.sinh(fall.s)
        slow = [2 * h.w0 * part for part in (apex.x1, fall.x1, apex.y1 / q, fall.y1 / q)]
        drag = [2 * part for part in (apex.x2, fall.x2, apex.y2 / q, fall.y2 / q)]
        changes = [_tilts(h, apex, fall), slow, drag]
        now = max(lost(sum(map(abs, terms)), sum(terms)) for terms in changes)
        if now <= more + 2:
            break
        more = now + 2
        if more > _MAX_LOST:
            raise ArithmeticError(f"a derivative is lost to {_MAX_LOST} digits")
    by_alpha0, by_v0, by_v_lim = (sum(terms) for terms in changes)
    return apex.x + fall.x, by_alpha0, by_v0 / h.v0, by_v_lim, 1 / q


def _tilts(h: Hodograph, apex: Point, fall: Point) -> list[mpmath.mpf]:
    """The terms of dR/dalpha0; ds0 = cosh s0 dalpha0, and v_x0 cosh s0 = v0."""
    p0, q = ctx.sinh(h.s0), -ctx.sinh(fall.s)
    cosh = ctx.sqrt(1 + p0 * p0)
    by_w = -2 * (h.w0 * p0 + h.cosh_n(cosh) * cosh)
    shifts = (by_w * part for part in (apex.x1, fall.x1, apex.y1 / q, fall.y1 / q))
    return [h.v0**2, h.v0**2 * p0 / q, *shifts]


def best_angle(v: Exact, n: Exact, dps: int) -> mpmath.mpf:
    """The launch angle at which the range on level ground is stationary."""
    low, high = ctx.mpf(0.5), ctx.mpf(1.2 if n() > 3 else 0.8)
    while _stationarity(v, n, low, 12) < 0:
        low, high = low / 8, low
    rough = _bracketed(v, n, low, high, min(dps, 12))
    if dps <= 12:
        return rough
    near = rough * ctx.mpf("1e-10")
    return _bracketed(v, n, rough - near, rough + near, dps)


def _stationarity(v: Exact, n: Exact, angle: mpmath.mpf, dps: int) -> mpmath.mpf:
    """dR/dalpha0 on level ground, whose terms for strong drag cancel from v_norm² down to 1."""
    more = max(0, 2 * digits(v()))
    h, apex, fall = land(v, lambda: angle, n, zero, dps + more, vary=True)
    assert fall is not None
    return sum(_tilts(h, apex, fall))


def _bracketed(v: Exact, n: Exact, a: mpmath.mpf, b: mpmath.mpf, dps: int) -> mpmath.mpf:
    """Anderson-Björck: regula falsi that keeps the bracket and still converges fast."""
    fa, fb = _stationarity(v, n, a, dps), _stationarity(v, n, b, dps)
    if fa * fb > 0:
        raise ArithmeticError("the range has no maximum in the bracket")
    while fb != 0:
        c = b - fb * (b - a) / (fb - fa)
        if abs(c - b) < ctx.mpf(10) ** -(dps + 2) * abs(c):
            return c
        fc = _stationarity(v, n, c, dps)
        if fc * fb < 0:
            a, fa = b, fb
        else:
            scale = 1 - fc / fb
            fa *= scale if scale > 0 else ctx.mpf(0.5)
        b, fb = c, fc
    return b
