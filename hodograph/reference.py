"""Quadratic drag at any number of digits, with mpmath: an independent path to the truth.

Lengths are in v_lim²/g, times in v_lim/g, speeds in v_lim. With s = asinh(tan α), so that
cosh s = 1/cos α, and σ(s) = s + sinh(2s)/2, which is the bracket of eq. 9, the equations of
motion (2) become ds/dt = −1/v and

    cosh²s / v² = B − σ(s),    B = σ(s0) + cosh²s0 / v_norm²               (eq. 13)
    dx = −v²/cosh s ds,   dy = −v² tanh s ds,   dt = −v ds                 (eq. 15)

The integrands of x and t keep one sign, and y is taken from the apex, so nothing cancels.
Their only singularities are the zeros of B − σ. One is real and lies at least
½ log1p(1/v_norm²) above s0: that is the drag layer of a fast launch. The others keep at
least π/2 away from the real axis. Panels no wider than 1, nor than their distance to the
real zero, therefore see an analytic integrand on a Bernstein ellipse of sum of semi-axes
above 5.8, and Gauss-Legendre gains 1.5 digits a node.

Inputs count as the exact numbers they are: the float ``math.pi / 2`` is a launch at
6e-17 rad from the vertical, and a string is read at full working precision.
Results are ``mpmath.mpf`` rounded to ``dps`` digits. All work is done in a private mpmath
context behind a lock: ``mpmath.mp`` is left alone and threads may call at will.
"""

import functools
import numbers
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, fields
from typing import Any, TypeVar

import mpmath

__all__ = [
    "Flight",
    "Position",
    "d_norm",
    "flight",
    "landing_angle",
    "optimal_angle",
    "position",
]

_ctx = mpmath.MPContext()
_lock = threading.RLock()
_Exact = Callable[[], mpmath.mpf]  # a number at the precision of the moment
_Integrand = Callable[[Any, Any], tuple[Any, ...]]
_Rule = list[tuple[mpmath.mpf, mpmath.mpf]]
_GUARD = 10  # digits kept beyond those asked for
_MAX_LOST = 200  # digits of cancellation between apex and target before giving up


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
    """The state at one slope, measured from the launch point."""

    x: mpmath.mpf
    y: mpmath.mpf
    t: mpmath.mpf
    speed: mpmath.mpf
    arc_length: mpmath.mpf


_T = TypeVar("_T", Flight, Position)


def flight(v_norm: Any, alpha0: Any, height: Any = 0, *, dps: int = 30) -> Flight:
    """Fly from the launch to the landing, on the way down.

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, > 0.
    alpha0 : float, mpf or str
        Launch slope in radians, in (-pi/2, pi/2].
    height : float, mpf or str
        Launch height above the landing plane in v_lim²/g; negative for a target above.
    dps : int
        Significant digits wanted.

    Returns
    -------
    Flight
        Lengths in v_lim²/g, times in v_lim/g, the speed in v_lim and the slope in radians.  A
        downward launch has its apex at the launch point. A launch that is level or
        downward from height 0 lands where it starts.

    Raises
    ------
    TypeError
        An argument is neither a number nor a string.
    ValueError
        For an illegal input, or a landing plane above the apex.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(flight(1, "0.5", dps=40).x, 40))
    0.548298974589262505892437829237004664949
    """
    with _working(dps):
        h = _number("height", height)
        return _rounded(_fly(*_launch(v_norm, alpha0), h, dps), dps)


def position(v_norm: Any, alpha0: Any, alpha: Any, *, dps: int = 30) -> Position:
    """Locate the point of slope `alpha`, in (-pi/2, alpha0] (eq. 13, 15 and 19).

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, > 0.
    alpha0 : float, mpf or str
        Launch slope in radians, in (-pi/2, pi/2].
    alpha : float, mpf or str
        Slope of the point in radians, in (-pi/2, alpha0].
    dps : int
        Significant digits wanted.

    Returns
    -------
    Position
        x, y and arc length in v_lim²/g, t in v_lim/g, speed in v_lim.  `y` is right to `dps`
        digits of the apex height or of the fall, whichever is larger.

    Raises
    ------
    TypeError
        An argument is neither a number nor a string.
    ValueError
        For an illegal input.

    Examples
    --------
    >>> import mpmath
    >>> top = position(1, "0.5", 0)
    >>> print(mpmath.nstr(top.y, 20))
    0.090317397437122537704
    """
    with _working(dps):
        v, a0 = _launch(v_norm, alpha0)
        a1 = _number("alpha", alpha)
        if a1() > a0() or a1() < -2 or _ctx.cos(a1()) <= 0:
            raise ValueError(f"alpha must be in (-pi/2, alpha0], got {alpha}")
        # Slopes close to one another cancel.
        near = a0() - a1()
        lost = max(0, _digits(1 / near)) if near > 0 else 0
        h = _hodograph(v(), a0(), dps + lost)
        s = _slope(a1())
        x, y, t = h.between(h.s0, s)
        return _rounded(Position(x, y, t, h.speed(s), h.arc_length(h.s0 - s)), dps)


def d_norm(v_norm: Any, alpha0: Any, *, dps: int = 30) -> mpmath.mpf:
    """Range on level ground over range in a vacuum (eq. 21).

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, >= 0.
    alpha0 : float, mpf or str
        Launch slope in radians, in [0, pi/2].
    dps : int
        Significant digits wanted.

    Returns
    -------
    mpf
        d_norm in (0, 1]; 1 at v_norm = 0 and at alpha0 = 0.

    Raises
    ------
    TypeError
        An argument is neither a number nor a string.
    ValueError
        For an illegal input.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(d_norm(1, "0.5"), 30))
    0.6515958179050420125449915259
    """
    with _working(dps):
        v, a0 = _launch(v_norm, alpha0, rest=True)
        _require_upward(a0(), alpha0)
        if v() == 0 or a0() == 0:
            return mpmath.mpf(1)
        x = _fly(v, a0, lambda: _ctx.mpf(0), dps).x
        return _round(x / (v() ** 2 * _ctx.sin(2 * a0())), dps)


def landing_angle(v_norm: Any, alpha0: Any, *, dps: int = 30) -> mpmath.mpf:
    """Slope at the landing on level ground.

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, >= 0.
    alpha0 : float, mpf or str
        Launch slope in radians, in [0, pi/2].
    dps : int
        Significant digits wanted.

    Returns
    -------
    mpf
        alpha_s in radians, in (-pi/2, 0]; -alpha0 at v_norm = 0.

    Raises
    ------
    TypeError
        An argument is neither a number nor a string.
    ValueError
        For an illegal input.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(landing_angle(1, "0.5"), 30))
    -0.672884758034068958533869136249
    """
    with _working(dps):
        v, a0 = _launch(v_norm, alpha0, rest=True)
        _require_upward(a0(), alpha0)
        if v() == 0 or a0() == 0:
            return _round(-a0(), dps)
        return _round(_fly(v, a0, lambda: _ctx.mpf(0), dps).alpha, dps)


def optimal_angle(v_norm: Any, *, dps: int = 30) -> mpmath.mpf:
    """Launch angle of greatest range on level ground: the zero of d(range)/d(alpha0).

    Moving s0 shifts the landing by (x', y') at fixed slope; the range is stationary when
    that shift lies along the path, x' + y'/tan|αs| = 0.

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, >= 0.
    dps : int
        Significant digits wanted.

    Returns
    -------
    mpf
        The angle in radians; pi/4 at v_norm = 0.

    Raises
    ------
    TypeError
        An argument is neither a number nor a string.
    ValueError
        For an illegal input.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(mpmath.degrees(optimal_angle(1)), 20))
    40.977509184015531218
    """
    with _working(dps):
        v = _number("v_norm", v_norm)
        _require_speed(v(), v_norm, rest=True)
        if v() == 0:
            return _round(_ctx.pi / 4, dps)
        rough = _bracketed(v, _ctx.mpf("0.001"), _ctx.mpf("0.8"), min(dps, 12))
        if dps <= 12:
            return _round(rough, dps)
        near = _ctx.mpf("1e-10")
        return _round(_bracketed(v, rough - near, rough + near, dps), dps)


@dataclass(frozen=True)
class _Hodograph:
    """Eq. 13 for one launch, with what its quadratures need."""

    v0: mpmath.mpf
    s0: mpmath.mpf
    b: mpmath.mpf
    layer: mpmath.mpf  # a lower bound of the distance from s0 up to the real zero of B − σ
    goal: int
    rule: _Rule

    def width(self, s: mpmath.mpf) -> mpmath.mpf:
        return min(self.layer + self.s0 - s, _ctx.mpf(1))

    def panel(self, top: mpmath.mpf, width: mpmath.mpf, f: _Integrand) -> list[mpmath.mpf]:
        half = width / 2
        columns = zip(*(f(self.b, top - half * (1 + z)) for z, _ in self.rule), strict=True)
        weights = [weight for _, weight in self.rule]
        return [half * _ctx.fdot(weights, column) for column in columns]

    def between(
        self, top: mpmath.mpf, bottom: mpmath.mpf, f: _Integrand | None = None
    ) -> list[mpmath.mpf]:
        """Integrate `f`, by default dx, dy and dt, from the slope `top` down to `bottom`."""
        f = f or _motion
        total = [_ctx.mpf(0)] * len(f(self.b, bottom))
        while top > bottom:
            width = min(self.width(top), top - bottom)
            total = [a + b for a, b in zip(total, self.panel(top, width, f), strict=True)]
            top = top - width if top - width > bottom else bottom
        return total

    def speed(self, s: mpmath.mpf) -> mpmath.mpf:
        p = _ctx.sinh(s)
        cosh = _ctx.sqrt(1 + p * p)
        return cosh / _ctx.sqrt(self.b - s - p * cosh)

    def arc_length(self, delta: mpmath.mpf) -> mpmath.mpf:
        """Eq. 19, with σ(s0) − σ(s0 − δ) in the form that does not cancel."""
        rise = delta + _ctx.sinh(delta) * _ctx.cosh(2 * self.s0 - delta)
        return _ctx.log1p((self.v0 / _ctx.cosh(self.s0)) ** 2 * rise) / 2


def _hodograph(v0: mpmath.mpf, alpha0: mpmath.mpf, dps: int) -> _Hodograph:
    """Set the working precision, then B of eq. 13."""
    goal = dps + _GUARD
    # B − σ loses the digits of v_norm² (1 + s0) near the launch.
    lost = _digits(v0**2 * (1 + abs(_slope(alpha0))))
    _ctx.dps = max(_ctx.dps, goal + _GUARD + max(0, lost))
    s0 = _slope(alpha0)
    cosh = _ctx.cosh(s0)
    return _Hodograph(
        v0=v0,
        s0=s0,
        b=s0 + _ctx.sinh(s0) * cosh + (cosh / v0) ** 2,
        layer=_ctx.log1p(1 / v0**2) / 2,
        goal=goal,
        rule=_gauss_legendre(round(goal / 1.4) + 4, goal + 5),
    )


def _motion(b: mpmath.mpf, s: mpmath.mpf) -> tuple[mpmath.mpf, ...]:
    """dx, dy and dt over −ds (eq. 15)."""
    p = _ctx.sinh(s)
    cosh = _ctx.sqrt(1 + p * p)
    vx2 = 1 / (b - s - p * cosh)
    dx = cosh * vx2
    return dx, p * dx, _ctx.sqrt(cosh * dx)


def _shift(b: mpmath.mpf, s: mpmath.mpf) -> tuple[mpmath.mpf, ...]:
    """Integrands left by d/dB of x and y, by parts."""
    p = _ctx.sinh(s)
    cosh = _ctx.sqrt(1 + p * p)
    dy = 1 / ((b - s - p * cosh) * cosh * cosh)
    return p * dy, dy


@dataclass(frozen=True)
class _Fall:
    x: mpmath.mpf
    t: mpmath.mpf
    s: mpmath.mpf
    delta: mpmath.mpf  # s0 − s, kept apart for a landing just after a downward launch


def _land(h: _Hodograph, drop: mpmath.mpf) -> _Fall:
    """Fall by `drop` from the apex, or from a downward launch."""
    top = min(h.s0, _ctx.mpf(0))
    start = h.s0 - top
    x, t, fallen = _ctx.mpf(0), _ctx.mpf(0), _ctx.mpf(0)
    tiny = _ctx.mpf(10) ** -h.goal
    while True:
        if (1 + abs(h.b) - top) * _ctx.exp(2 * top) < tiny:
            # Terminal velocity to all digits: dy = −dt = ds, dx = −2 exp(s) ds.
            rest = drop - fallen
            x -= 2 * _ctx.exp(top) * _ctx.expm1(-rest)
            return _Fall(x, t + rest, top - rest, start + rest)
        width = h.width(top)
        dx, dy, dt = h.panel(top, width, _motion)
        if fallen - dy >= drop:
            break
        x, t, fallen = x + dx, t + dt, fallen - dy
        top, start = top - width, start + width
    # The fall is convex in −s after the apex, so that Newton comes down from the far end;
    # a downward launch may not be convex, and bisects when a step leaves the bracket.
    low, high = _ctx.mpf(0), width
    delta = min(width, _ctx.sqrt(2 * drop * abs(h.b))) if h.s0 >= 0 and top == 0 else width
    while True:
        dx, dy, dt = h.panel(top, delta, _motion)
        excess = fallen - dy - drop
        low, high = (low, delta) if excess > 0 else (delta, high)
        step = excess / -_motion(h.b, top - delta)[1] if top != delta else _ctx.mpf("inf")
        if abs(step) <= 8 * tiny * delta:
            return _Fall(x + dx, t + dt, top - delta, start + delta)
        new = delta - step
        delta = new if low < new < high else (low + high) / 2


def _fly(v: _Exact, a0: _Exact, height: _Exact, dps: int) -> Flight:
    lost = 0
    while True:
        h = _hodograph(v(), a0(), dps + lost)
        up = h.between(max(h.s0, _ctx.mpf(0)), _ctx.mpf(0))
        drop = up[1] + height()
        # A target near the apex cancels against it.
        now = _digits(up[1] / abs(drop)) if drop != 0 != up[1] else 0 if up[1] == 0 else h.goal
        if now <= lost + 2:
            break
        lost = now + lost + 2
        if lost > _MAX_LOST:
            raise ValueError(f"height is minus the apex to {_MAX_LOST} digits, got {height()}")
    if drop < 0:
        least = _ctx.nstr(-up[1], 12)
        raise ValueError(f"height must be at least {least} (minus the apex), got {height()}")
    if drop == 0:
        zero = drop
        return Flight(zero, zero, a0(), v(), zero, zero, zero, zero)
    down = _land(h, drop)
    return Flight(
        x=up[0] + down.x,
        t=up[2] + down.t,
        alpha=_ctx.atan(_ctx.sinh(down.s)),
        speed=h.speed(down.s),
        arc_length=h.arc_length(down.delta),
        apex_x=up[0],
        apex_y=up[1],
        apex_t=up[2],
    )


def _stationarity(v: _Exact, angle: mpmath.mpf, dps: int) -> mpmath.mpf:
    """Differentiate the range on level ground with respect to s0.

    d/ds0 of x and y is v²/cosh s0 and v² tanh s0 from the moving end, less dB/ds0 times the
    integrals of cosh s/(B − σ)² and sinh s cosh s/(B − σ)². As dσ/ds = 2 cosh²s, those are
    integrated by parts, and the terms in v_norm² then cancel on paper. For weak drag terms of
    order 1 are left to cancel down to v_norm², whence the added digits.
    """
    h = _hodograph(v(), angle, dps + max(0, -2 * _digits(v())))
    s = _land(h, h.between(h.s0, _ctx.mpf(0))[1]).s
    sx, sy = h.between(h.s0, s, _shift)
    cosh, tanh = _ctx.cosh(s), _ctx.tanh(s)
    vx2 = (h.speed(s) / cosh) ** 2
    cosh0, tanh0 = _ctx.cosh(h.s0), _ctx.tanh(h.s0)
    half_db = cosh0**2 * (1 + tanh0 / h.v0**2)
    dx = half_db * (vx2 / cosh - sx) - tanh0 / cosh0
    dy = half_db * (vx2 * tanh + sy) - tanh0**2
    return dx - dy / _ctx.sinh(s)


def _bracketed(v: _Exact, a: mpmath.mpf, b: mpmath.mpf, dps: int) -> mpmath.mpf:
    """Anderson-Björck: regula falsi that keeps the bracket and still converges fast."""
    fa, fb = _stationarity(v, a, dps), _stationarity(v, b, dps)
    if fa * fb > 0:
        raise ArithmeticError("the range has no maximum in the bracket")
    while fb != 0:
        c = b - fb * (b - a) / (fb - fa)
        if abs(c - b) < _ctx.mpf(10) ** -(dps + 2):
            return c
        fc = _stationarity(v, c, dps)
        if fc * fb < 0:
            a, fa = b, fb
        else:
            scale = 1 - fc / fb
            fa *= scale if scale > 0 else _ctx.mpf(0.5)
        b, fb = c, fc
    return b


@functools.lru_cache(maxsize=64)
def _gauss_legendre(n: int, digits: int) -> _Rule:
    """Nodes and weights on [-1, 1], by Newton on the three-term recurrence."""
    rule: _Rule = []
    with _ctx.workdps(digits + 10):
        for i in range(n):
            z = _ctx.cos(_ctx.pi * (4 * i + 3) / (4 * n + 2))
            step = _ctx.mpf(1)
            while abs(step) > _ctx.mpf(10) ** (-digits // 2 - 2):
                p, slope = _legendre(n, z)
                step = p / slope
                z -= step
            slope = _legendre(n, z)[1]
            rule.append((z, 2 / ((1 - z * z) * slope**2)))
    return rule


def _legendre(n: int, z: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
    """P_n and its derivative."""
    p, q = _ctx.mpf(1), z
    for k in range(2, n + 1):
        p, q = q, ((2 * k - 1) * z * q - (k - 1) * p) / k
    return q, n * (p - z * q) / (1 - z * z)


@contextmanager
def _working(dps: int) -> Iterator[None]:
    if isinstance(dps, bool) or not isinstance(dps, int) or dps < 1:
        raise ValueError(f"dps must be a whole number of digits >= 1, got {dps!r}")
    with _lock, _ctx.workdps(dps + _GUARD):
        yield


def _digits(ratio: mpmath.mpf) -> int:
    return int(_ctx.ceil(_ctx.log10(ratio)))


def _slope(alpha: mpmath.mpf) -> mpmath.mpf:
    return _ctx.asinh(_ctx.tan(alpha))


def _number(name: str, value: Any) -> _Exact:
    """Read `value` at whatever precision the work has by the time of the call."""
    if isinstance(value, bool) or not (
        isinstance(value, str | numbers.Real) or hasattr(value, "_mpf_")
    ):
        raise TypeError(f"{name} must be a real number or a string, got {type(value).__name__}")

    def exact() -> mpmath.mpf:
        if hasattr(value, "_mpf_"):  # first, as an mpf is also a numbers.Real
            return _ctx.make_mpf(value._mpf_)
        if isinstance(value, numbers.Rational):
            return _ctx.mpf(int(value.numerator)) / int(value.denominator)
        return _ctx.mpf(value if isinstance(value, str) else float(value))

    try:
        finite = _ctx.isfinite(exact())
    except ValueError:
        finite = False
    if not finite:
        raise ValueError(f"{name} must be a finite number, got {value!r}")
    return exact


def _launch(v_norm: Any, alpha0: Any, *, rest: bool = False) -> tuple[_Exact, _Exact]:
    v, a0 = _number("v_norm", v_norm), _number("alpha0", alpha0)
    _require_speed(v(), v_norm, rest=rest)
    if abs(a0()) > 2 or _ctx.cos(a0()) <= 0:
        raise ValueError(f"alpha0 must be in (-pi/2, pi/2], got {alpha0}")
    return v, a0


def _require_speed(v: mpmath.mpf, given: Any, *, rest: bool) -> None:
    if v < 0 or (v == 0 and not rest):
        raise ValueError(f"v_norm must be {'>=' if rest else '>'} 0, got {given}")


def _require_upward(alpha0: mpmath.mpf, given: Any) -> None:
    if alpha0 < 0:
        raise ValueError(f"alpha0 must be in [0, pi/2] on level ground, got {given}")


def _round(value: mpmath.mpf, dps: int) -> mpmath.mpf:
    with _ctx.workdps(dps):
        return mpmath.mp.make_mpf((+value)._mpf_)


def _rounded(result: _T, dps: int) -> _T:
    values = {f.name: _round(getattr(result, f.name), dps) for f in fields(result)}
    return type(result)(**values)
