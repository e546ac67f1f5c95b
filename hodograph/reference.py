"""Power-law drag at any number of digits, with mpmath: an independent path to the truth.

Drag grows as the n-th power of the speed, n in [1, 10]; 2 is the paper's.  Lengths are in
v_lim²/g, times in v_lim/g, speeds in v_lim.  With s = asinh(tan α), so that cosh s = 1/cos α,
and δ = s0 − s, the slope fallen through since the launch, the equations of motion become

    W = v_x^−n,   W = W0 + n ∫ coshⁿs dδ                                     (eq. 13 for n = 2)
    dx = v_x² cosh s dδ,   dy = sinh s dx,   dt = v_x cosh s dδ,   d(arc) = cosh s dx    (eq. 15)

Every term of W is positive, the integrands of x, t and arc length keep one sign, and y is taken
from the apex, so nothing cancels.  For n = 2 the gain of W is elementary; else it is integrated
panel by panel, from its value at the beginning of the panel to every node, by the matrix that
integrates the polynomial through the nodes (Gauss collocation).

The singularities of the integrands are the zeros of W and, unless n is even, s = ± iπ/2.  One
zero is real and lies at least log1p(1/v_normⁿ)/n above s0: that is the drag layer of a fast
launch.  The same bound, with the speed of the moment, is the radius of a disc free of zeros, and
none but the real one is nearer to the real axis than π/n (n > 2) or π/2.  Panels are cut by these
distances, and in the layer itself they are even in the logarithm of the distance to the real
zero: Gauss-Legendre gains at least 1.4 digits a node.

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
from typing import Any, NamedTuple, TypeVar

import mpmath

__all__ = [
    "Flight",
    "Position",
    "Sensitivity",
    "d_norm",
    "flight",
    "landing_angle",
    "optimal_angle",
    "position",
    "sensitivity",
]

_ctx = mpmath.MPContext()
_lock = threading.RLock()
_Exact = Callable[[], mpmath.mpf]  # a number at the precision of the moment
_GUARD = 10  # digits kept beyond those asked for
_MAX_LOST = 200  # digits of cancellation between apex and target before giving up
_HALF_STRETCH = 2  # half the panels in the drag layer, in the logarithm of the distance


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


_T = TypeVar("_T", Flight, Position, Sensitivity)


def flight(v_norm: Any, alpha0: Any, height: Any = 0, *, n: Any = 2, dps: int = 30) -> Flight:
    """Fly from the launch to the landing, on the way down.

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, > 0.
    alpha0 : float, mpf or str
        Launch slope in radians, from straight down to straight up.
    height : float, mpf or str
        Launch height above the landing plane in v_lim²/g; negative for a target above.
    n : float, mpf or str
        Power of the speed that drag grows with, in [1, 10].
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
    >>> print(mpmath.nstr(flight(1, "0.5", n="2.5").x, 20))
    0.56691925376495858775
    """
    with _working(dps):
        h = _number("height", height)
        return _rounded(_fly(*_launch(v_norm, alpha0), _power(n), h, dps), dps)


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

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, > 0.
    alpha0 : float, mpf or str
        Launch slope in radians, from straight down to straight up.
    alpha, t, x, s, y : float, mpf or str
        Exactly one of: the slope in radians, in (-pi/2, alpha0]; the time; the horizontal
        distance, less than the path ever reaches; the arc length; the height above the launch.
    rising : bool
        With `y`: on the way up.
    n : float, mpf or str
        Power of the speed that drag grows with, in [1, 10].
    dps : int
        Significant digits wanted.

    Returns
    -------
    Position
        x, y and arc length in v_lim²/g, t in v_lim/g, speed in v_lim, the slope in radians.

    Raises
    ------
    TypeError
        An argument is neither a number nor a string, or not exactly one place is given.
    ValueError
        For an illegal input, or a place that the path does not reach.

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
    with _working(dps):
        v, a0 = _launch(v_norm, alpha0)
        place = _number(name, places[name])
        found = _position(v, a0, _power(n), name, place, rising, dps)
        return _rounded(found, dps)


def sensitivity(
    v_norm: Any, alpha0: Any, height: Any = 0, *, n: Any = 2, dps: int = 30
) -> Sensitivity:
    """The range and its derivatives in alpha0, v0, v_lim and height.

    A change of the launch shifts the point of slope s by (x', y'), and with q = −tan αs the
    landing by x' + (y' + height')/q.  At fixed s,

        x' = v_x0² cosh s0 s0' − (2/n) ∫ W' W^(−1−2/n) cosh s dδ,   and y' with sinh s as a factor,

    where W' is −n W0 v0'/v0, or n (W0 tanh s0 + coshⁿs0) s0', or −n (W − W0) v_lim'/v_lim.

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, > 0.
    alpha0 : float, mpf or str
        Launch slope in radians, from straight down to straight up.
    height : float, mpf or str
        Launch height above the landing plane in v_lim²/g; negative for a target above.
    n : float, mpf or str
        Power of the speed that drag grows with, in [1, 10].
    dps : int
        Significant digits wanted.

    Returns
    -------
    Sensitivity
        The range in v_lim²/g; per radian of alpha0 in v_lim²/g; per v0 and per v_lim in
        v_lim/g; per height.

    Raises
    ------
    TypeError
        An argument is neither a number nor a string.
    ValueError
        For an illegal input, a landing plane above the apex, or a launch that lands where it
        starts.

    Examples
    --------
    >>> import mpmath
    >>> print(mpmath.nstr(sensitivity(1, "0.5").alpha0, 20))
    0.43032771562832005448
    """
    with _working(dps):
        h = _number("height", height)
        return _rounded(_sensitivity(*_launch(v_norm, alpha0), _power(n), h, dps), dps)


def d_norm(v_norm: Any, alpha0: Any, *, n: Any = 2, dps: int = 30) -> mpmath.mpf:
    """Range on level ground over range in a vacuum (eq. 21).

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, >= 0.
    alpha0 : float, mpf or str
        Launch slope in radians, in [0, pi/2].
    n : float, mpf or str
        Power of the speed that drag grows with, in [1, 10].
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
        power = _power(n)
        _require_upward(a0(), alpha0)
        if v() == 0 or a0() == 0:
            return mpmath.mpf(1)
        x = _fly(v, a0, power, lambda: _ctx.mpf(0), dps).x
        return _round(x / (v() ** 2 * _ctx.sin(2 * a0())), dps)


def landing_angle(v_norm: Any, alpha0: Any, *, n: Any = 2, dps: int = 30) -> mpmath.mpf:
    """Slope at the landing on level ground.

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, >= 0.
    alpha0 : float, mpf or str
        Launch slope in radians, in [0, pi/2].
    n : float, mpf or str
        Power of the speed that drag grows with, in [1, 10].
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
        power = _power(n)
        _require_upward(a0(), alpha0)
        if v() == 0 or a0() == 0:
            return _round(-a0(), dps)
        return _round(_fly(v, a0, power, lambda: _ctx.mpf(0), dps).alpha, dps)


def optimal_angle(v_norm: Any, *, n: Any = 2, dps: int = 30) -> mpmath.mpf:
    """Launch angle of greatest range on level ground: the zero of d(range)/d(alpha0).

    Parameters
    ----------
    v_norm : float, mpf or str
        Launch speed over v_lim, >= 0.
    n : float, mpf or str
        Power of the speed that drag grows with, in [1, 10].
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
        v, power = _number("v_norm", v_norm), _power(n)
        _require_speed(v(), v_norm, rest=True)
        if v() == 0:
            return _round(_ctx.pi / 4, dps)
        return _round(_best(v, power, dps), dps)


class _Point(NamedTuple):
    """Where the integration has got to: the path since the launch or since the apex."""

    delta: mpmath.mpf  # s0 − s, kept apart for points just after the launch
    s: mpmath.mpf
    gain: mpmath.mpf  # W − W0
    x: mpmath.mpf
    y: mpmath.mpf
    t: mpmath.mpf
    s_arc: mpmath.mpf
    # Integrals of W^(−1−2/n) cosh s (1, sinh s) (1, W − W0) dδ; zeros unless asked for.
    x1: mpmath.mpf
    y1: mpmath.mpf
    x2: mpmath.mpf
    y2: mpmath.mpf


@dataclass(frozen=True)
class _Rule:
    """Gauss-Legendre on [0, 2], with what the panels need of it."""

    nodes: list[mpmath.mpf]
    weights: list[mpmath.mpf]
    stretch: list[mpmath.mpf]  # expm1 at the nodes of a panel evenly cut in the logarithm


@dataclass(frozen=True)
class _Hodograph:
    """Eq. 13 for one launch, with what its quadratures need."""

    v0: mpmath.mpf
    s0: mpmath.mpf
    n: mpmath.mpf
    w0: mpmath.mpf
    layer: mpmath.mpf  # a lower bound of the distance from s0 up to the real zero of W
    tiny: mpmath.mpf
    goal: int
    rule: _Rule
    matrix: list[list[mpmath.mpf]] | None  # None: n = 2 has a closed form
    vary: bool

    def start(self) -> _Point:
        return _Point(_ctx.mpf(0), self.s0, *[_ctx.mpf(0)] * 9)

    def vx(self, w: mpmath.mpf) -> mpmath.mpf:
        """W^(−1/n)."""
        if self.n == 1:
            return 1 / w
        if self.n == 2:
            return 1 / _ctx.sqrt(w)
        return _ctx.exp(-_ctx.ln(w) / self.n)

    def cosh_n(self, cosh: mpmath.mpf) -> mpmath.mpf:
        if self.n == int(self.n):
            return cosh ** int(self.n)
        return _ctx.exp(self.n * _ctx.ln(cosh))

    def speed(self, at: _Point) -> mpmath.mpf:
        return self.vx(self.w0 + at.gain) * _ctx.cosh(at.s)

    def rate(self, at: _Point, name: str) -> mpmath.mpf:
        """Derivative of a quantity with respect to δ."""
        p = _ctx.sinh(at.s)
        cosh, vx = _ctx.sqrt(1 + p * p), self.vx(self.w0 + at.gain)
        if name == "t":
            return vx * cosh
        return vx * vx * cosh * {"x": 1, "y": p, "s_arc": cosh}[name]

    def excess(self, at: _Point) -> mpmath.mpf:
        """(v_lim / speed)ⁿ − 1."""
        return (self.w0 + at.gain) / self.cosh_n(_ctx.cosh(at.s)) - 1

    def longest(self, at: _Point) -> mpmath.mpf:
        """The longest panel that begins here (see the module's docstring)."""
        near = self.layer + at.delta
        if near < 0.002 / self.n:
            return near * _ctx.expm1(2 * _HALF_STRETCH)
        excess = self.excess(at)
        clear = _ctx.log1p(1 + excess) / 2  # half the radius of the disc, times n
        if at.s < 0:  # once near the terminal speed, the zeros are behind
            behind = -_ctx.ln(abs(excess) + self.n * _ctx.exp(2 * at.s))
            clear = max(clear, behind / 2)
        return min(_ctx.mpf(1), max(clear, min(self.n * near, 2)) / self.n, 5 / self.n)

    def step(self, at: _Point, width: mpmath.mpf) -> _Point:
        """Integrate over one panel."""
        rule, near, half = self.rule, self.layer + at.delta, width / 2
        if width <= 2 * near:
            offsets = [half * z for z in rule.nodes]
            weights = [half * weight for weight in rule.weights]
            scales = [half] * len(offsets)
        else:
            half = _ctx.log1p(width / near) / 2
            stretch = rule.stretch
            if abs(half - _HALF_STRETCH) > self.tiny:
                stretch = [_ctx.expm1(half * z) for z in rule.nodes]
            offsets = [near * e for e in stretch]
            scales = [half * (near + offset) for offset in offsets]
            weights = [a * b for a, b in zip(scales, rule.weights, strict=True)]
        sines = [_ctx.sinh(at.s - offset) for offset in offsets]
        cosines = [_ctx.sqrt(1 + p * p) for p in sines]
        gains, gain = self._gains(at, width, offsets, scales, sines, cosines)
        w = [self.w0 + g for g in gains]
        vx = [self.vx(value) for value in w]
        dt = [v * c for v, c in zip(vx, cosines, strict=True)]
        dx = [d * v for d, v in zip(dt, vx, strict=True)]
        columns = [dx, [d * p for d, p in zip(dx, sines, strict=True)], dt]
        columns.append([d * c for d, c in zip(dx, cosines, strict=True)])
        if self.vary:
            for column in columns[:2]:
                columns.append([d / value for d, value in zip(column, w, strict=True)])
            for column in columns[4:6]:
                columns.append([d * g for d, g in zip(column, gains, strict=True)])
        done = [_ctx.fdot(weights, column) for column in columns]
        done += [_ctx.mpf(0)] * (8 - len(done))
        return _Point(
            at.delta + width,
            at.s - width,
            gain,
            *(old + new for old, new in zip(at[3:], done, strict=True)),
        )

    def _gains(
        self,
        at: _Point,
        width: mpmath.mpf,
        offsets: list[mpmath.mpf],
        scales: list[mpmath.mpf],
        sines: list[mpmath.mpf],
        cosines: list[mpmath.mpf],
    ) -> tuple[list[mpmath.mpf], mpmath.mpf]:
        """W − W0 at the nodes and at the end of a panel."""
        if self.matrix is None:
            # 2 ∫ cosh²s dδ = d + sinh(d) cosh(s + s − d), d the part of the panel behind
            p0 = _ctx.sinh(at.s)
            cosh0 = _ctx.sqrt(1 + p0 * p0)
            gains = [
                at.gain + d + _ctx.sinh(d) * (cosh0 * c + p0 * p)
                for d, c, p in zip(offsets, cosines, sines, strict=True)
            ]
            end = at.gain + width + _ctx.sinh(width) * _ctx.cosh(2 * at.s - width)
            return gains, end
        rates = [self.n * scale * self.cosh_n(c) for scale, c in zip(scales, cosines, strict=True)]
        gains = [at.gain + _ctx.fdot(row, rates) for row in self.matrix]
        return gains, at.gain + _ctx.fdot(self.rule.weights, rates)

    def slope_to(self, at: _Point, s: mpmath.mpf) -> _Point:
        """Go on to the slope `s`, which lies below."""
        while at.s > s:
            width = self.longest(at)
            if width >= at.s - s:
                return self.step(at, at.s - s)._replace(s=s)
            at = self.step(at, width)
        return at

    def go(
        self, at: _Point, name: str, target: mpmath.mpf, stop: Any = None
    ) -> tuple[_Point, bool]:
        """Go on until a quantity has grown to `target` or to the slope `stop`, and tell which."""
        sign = -1 if name == "y" and at.s <= 0 else 1
        while True:
            if stop is None and abs(self.excess(at)) + _ctx.exp(2 * at.s) < self.tiny:
                return self._tail(at, name, target), True
            width = self.longest(at)
            last = stop is not None and width >= at.s - stop
            if last:
                width = at.s - stop
            end = self.step(at, width)
            if sign * getattr(end, name) >= target:
                return self._seek(at, end, name, target), True
            if last:
                return end._replace(s=stop), False
            at = end

    def _tail(self, at: _Point, name: str, target: mpmath.mpf) -> _Point:
        """Terminal velocity to all digits: dδ = dt = −dy, dx = 2 exp(s) dδ."""
        last = 2 * _ctx.exp(at.s)
        if name == "x":
            if target - at.x >= last:
                raise _NeverError(at.x + last)
            rest = -_ctx.log1p((at.x - target) / last)
        else:
            rest = target - abs(getattr(at, name))
        s = at.s - rest
        return at._replace(
            delta=at.delta + rest,
            s=s,
            gain=_ctx.exp(-self.n * s) / 2**self.n - self.w0,
            x=at.x - last * _ctx.expm1(-rest),
            y=at.y - rest,
            t=at.t + rest,
            s_arc=at.s_arc + rest,
        )

    def _seek(self, at: _Point, end: _Point, name: str, target: mpmath.mpf) -> _Point:
        """Newton in one panel, which bisects when a step leaves the bracket."""
        sign = -1 if name == "y" and at.s <= 0 else 1
        low, high = _ctx.mpf(0), end.delta - at.delta
        width = high
        here, there = abs(getattr(at, name)), abs(getattr(end, name))
        part = (target - here) / (there - here)
        if name == "y" and at.s == 0:
            part = _ctx.sqrt(part)
        elif name == "y" and end.s <= 0 < at.s:
            part = 1 - _ctx.sqrt(1 - part)
        d = part * width
        while True:
            now = self.step(at, d)
            off = sign * getattr(now, name) - target
            low, high = (low, d) if off > 0 else (d, high)
            rate = sign * self.rate(now, name)
            step = off / rate if rate > 0 else width
            # as near as can be, in δ or in the quantity
            if abs(step) <= 8 * self.tiny * d or abs(off) <= self.tiny / 1000000 * target:
                return now
            # The next is off by the square of this step, over the distance to where the rate is 0.
            if 1000 * step**2 <= self.tiny * min(d, width - d) ** 2:
                return self.step(at, d - step)
            new = d - step
            d = new if low < new < high else (low + high) / 2


class _NeverError(Exception):
    """A distance that the path does not reach; holds the one that it tends to."""


def _hodograph(v: _Exact, a0: _Exact, n: _Exact, dps: int, *, vary: bool = False) -> _Hodograph:
    """Set the working precision, then W0 of eq. 13."""
    goal = dps + _GUARD
    _ctx.dps = max(_ctx.dps, goal + _GUARD)
    v0, s0, power = v(), _slope(a0()), n()
    rounded = goal + -goal % 10  # so that the rules are few
    nodes, digits = round(rounded / 1.4) + 4, rounded + 5
    closed = power == 2
    return _Hodograph(
        v0=v0,
        s0=s0,
        n=power,
        w0=_ctx.exp(power * _ctx.ln(_ctx.cosh(s0) / v0)),
        layer=_ctx.log1p(_ctx.exp(-power * _ctx.ln(v0))) / power,
        tiny=_ctx.mpf(10) ** -goal,
        goal=goal,
        rule=_gauss_legendre(nodes, digits),
        matrix=None if closed else _integration_matrix(nodes, digits),
        vary=vary,
    )


def _top(h: _Hodograph) -> tuple[_Point, _Point]:
    """The apex, or the launch if that is downward; and the same to count the fall from."""
    apex = h.slope_to(h.start(), _ctx.mpf(0))
    zero = _ctx.mpf(0)
    return apex, _Point(apex.delta, apex.s, apex.gain, *[zero] * 8)


def _joined(apex: _Point, fall: _Point) -> _Point:
    return _Point(*fall[:3], *(a + b for a, b in zip(apex[3:], fall[3:], strict=True)))


def _land(
    v: _Exact, a0: _Exact, n: _Exact, height: _Exact, dps: int, *, vary: bool = False
) -> tuple[_Hodograph, _Point, _Point | None]:
    """The launch, its apex, and the fall from there; None where the launch is the landing."""
    lost = 0
    while True:
        h = _hodograph(v, a0, n, dps + lost, vary=vary)
        apex, top = _top(h)
        drop = apex.y + height()
        # A target near the apex cancels against it.
        now = _digits(apex.y / abs(drop)) if drop != 0 != apex.y else 0 if apex.y == 0 else h.goal
        if now <= lost + 2:
            break
        lost = now + lost + 2
        if lost > _MAX_LOST:
            raise ValueError(f"height is minus the apex to {_MAX_LOST} digits, got {height()}")
    if drop < 0:
        least = _ctx.nstr(-apex.y, 12)
        raise ValueError(f"height must be at least {least} (minus the apex), got {height()}")
    return h, apex, h.go(top, "y", drop)[0] if drop > 0 else None


def _fly(v: _Exact, a0: _Exact, n: _Exact, height: _Exact, dps: int) -> Flight:
    h, apex, fall = _land(v, a0, n, height, dps)
    if fall is None:
        zero = _ctx.mpf(0)
        return Flight(zero, zero, a0(), v(), zero, zero, zero, zero)
    land = _joined(apex, fall)
    return Flight(
        x=land.x,
        t=land.t,
        alpha=_ctx.atan(_ctx.sinh(land.s)),
        speed=h.speed(land),
        arc_length=land.s_arc,
        apex_x=apex.x,
        apex_y=apex.y,
        apex_t=apex.t,
    )


def _position(
    v: _Exact, a0: _Exact, n: _Exact, name: str, place: _Exact, rising: bool, dps: int
) -> Position:
    lost = 0
    while True:
        h = _hodograph(v, a0, n, dps + lost)
        if name == "alpha":
            point, now = _at_slope(h, a0, place)
        else:
            point, now = _at(h, {"s": "s_arc"}.get(name, name), place(), rising)
        if now <= lost + 2 or lost > _MAX_LOST:
            break
        lost = now + 2
    alpha = place() if name == "alpha" else _ctx.atan(_ctx.sinh(point.s))
    if point.delta == 0:
        alpha = a0()
    y = place() if name == "y" else point.y
    return Position(point.x, y, point.t, h.speed(point), point.s_arc, alpha)


def _at_slope(h: _Hodograph, a0: _Exact, alpha: _Exact) -> tuple[_Point, int]:
    """The point of one slope, and how many digits were lost to cancellation."""
    a1 = alpha()
    near = a0() - a1
    if near < 0 or a1 < -2 or _ctx.cos(a1) <= 0:
        raise ValueError(f"alpha must be in (-pi/2, alpha0], got {_ctx.nstr(a1, 15)}")
    if near == 0:
        return h.start(), 0
    apex, top = _top(h)
    s = _slope(a1)
    if s >= 0:
        point = h.slope_to(h.start(), s)
        return point, _digits(1 / near)
    point = _joined(apex, h.slope_to(top, s))
    return point, max(_digits(1 / near), _lost(apex.y, point.y))


def _at(h: _Hodograph, name: str, target: mpmath.mpf, rising: bool) -> tuple[_Point, int]:
    """The point where a quantity has one value, and how many digits were lost."""
    start = h.start()
    climbs = h.s0 > 0
    if name != "y" and target < 0:
        raise ValueError(f"{name[0]} must be >= 0, got {_ctx.nstr(target, 15)}")
    if target == 0 and (name != "y" or rising or not climbs):
        return start, 0
    if climbs and (rising or name != "y"):
        point, reached = h.go(start, name, target, _ctx.mpf(0))
        if reached:
            steep = _lost(target, h.rate(point, name) * point.delta)
            return point, max(steep, 2 * _lost(h.s0, point.s))
        apex, top = point, _Point(*point[:3], *[_ctx.mpf(0)] * 8)
    else:
        apex, top = _top(h)
    rest = apex.y - target if name == "y" else target - getattr(apex, name)
    if rest < 0 or (name == "y" and rising):
        most = _ctx.nstr(apex.y, 12)
        raise ValueError(f"y must be at most {most}, the apex, got {_ctx.nstr(target, 15)}")
    try:
        fall, _ = h.go(top, name, rest)
    except _NeverError as never:
        most = _ctx.nstr(apex.x + never.args[0], 12)
        raise ValueError(f"x must be less than {most}, got {_ctx.nstr(target, 15)}") from None
    point = _joined(apex, fall)
    if name == "y":
        return point, _lost(apex.y, rest)
    steep = _lost(target, h.rate(point, name) * point.delta)
    return point, max(steep, _lost(target, rest), _lost(apex.y, point.y))


def _lost(large: mpmath.mpf, small: mpmath.mpf) -> int:
    """Digits that a difference of numbers of one size loses when it comes out small."""
    if large == 0:
        return 0
    return max(0, _digits(abs(large / small))) if small != 0 else _ctx.dps


def _sensitivity(v: _Exact, a0: _Exact, n: _Exact, height: _Exact, dps: int) -> Sensitivity:
    lost = 0
    while True:
        h, apex, fall = _land(v, a0, n, height, dps + lost, vary=True)
        if fall is None:
            raise ValueError("the launch is the landing: its range has no derivatives")
        q = -_ctx.sinh(fall.s)
        slow = [2 * h.w0 * part for part in (apex.x1, fall.x1, apex.y1 / q, fall.y1 / q)]
        drag = [2 * part for part in (apex.x2, fall.x2, apex.y2 / q, fall.y2 / q)]
        changes = [_tilts(h, apex, fall), slow, drag]
        now = max(_lost(sum(map(abs, terms)), sum(terms)) for terms in changes)
        if now <= lost + 2:
            break
        lost = now + 2
        if lost > _MAX_LOST:
            raise ArithmeticError(f"a derivative is lost to {_MAX_LOST} digits")
    by_alpha0, by_v0, by_v_lim = (sum(terms) for terms in changes)
    return Sensitivity(apex.x + fall.x, by_alpha0, by_v0 / h.v0, by_v_lim, 1 / q)


def _tilts(h: _Hodograph, apex: _Point, fall: _Point) -> list[mpmath.mpf]:
    """The terms of dR/dalpha0; ds0 = cosh s0 dalpha0, and v_x0 cosh s0 = v0."""
    p0, q = _ctx.sinh(h.s0), -_ctx.sinh(fall.s)
    cosh = _ctx.sqrt(1 + p0 * p0)
    by_w = -2 / h.n * h.n * (h.w0 * p0 + h.cosh_n(cosh) * cosh)
    return [
        h.v0**2,
        h.v0**2 * p0 / q,
        *(by_w * part for part in (apex.x1, fall.x1, apex.y1 / q, fall.y1 / q)),
    ]


def _stationarity(v: _Exact, n: _Exact, angle: mpmath.mpf, dps: int) -> mpmath.mpf:
    """dR/dalpha0 on level ground, whose terms for strong drag cancel from v_norm² down to 1."""
    lost = max(0, 2 * _digits(v()))
    h, apex, fall = _land(v, lambda: angle, n, lambda: _ctx.mpf(0), dps + lost, vary=True)
    assert fall is not None
    return sum(_tilts(h, apex, fall))


def _best(v: _Exact, n: _Exact, dps: int) -> mpmath.mpf:
    low, high = _ctx.mpf(0.5), _ctx.mpf(1.2 if n() > 3 else 0.8)
    while _stationarity(v, n, low, 12) < 0:
        low, high = low / 8, low
    rough = _bracketed(v, n, low, high, min(dps, 12))
    if dps <= 12:
        return rough
    near = rough * _ctx.mpf("1e-10")
    return _bracketed(v, n, rough - near, rough + near, dps)


def _bracketed(v: _Exact, n: _Exact, a: mpmath.mpf, b: mpmath.mpf, dps: int) -> mpmath.mpf:
    """Anderson-Björck: regula falsi that keeps the bracket and still converges fast."""
    fa, fb = _stationarity(v, n, a, dps), _stationarity(v, n, b, dps)
    if fa * fb > 0:
        raise ArithmeticError("the range has no maximum in the bracket")
    while fb != 0:
        c = b - fb * (b - a) / (fb - fa)
        if abs(c - b) < _ctx.mpf(10) ** -(dps + 2) * abs(c):
            return c
        fc = _stationarity(v, n, c, dps)
        if fc * fb < 0:
            a, fa = b, fb
        else:
            scale = 1 - fc / fb
            fa *= scale if scale > 0 else _ctx.mpf(0.5)
        b, fb = c, fc
    return b


@functools.lru_cache(maxsize=64)
def _gauss_legendre(n: int, digits: int) -> _Rule:
    """Nodes and weights on [0, 2], by Newton on the three-term recurrence."""
    nodes, weights = [], []
    with _ctx.workdps(digits + 10):
        for i in range(n):
            z = -_ctx.cos(_ctx.pi * (4 * i + 3) / (4 * n + 2))
            step = _ctx.mpf(1)
            while abs(step) > _ctx.mpf(10) ** (-digits // 2 - 2):
                p, slope = _legendre(n, z)
                step = p / slope
                z -= step
            slope = _legendre(n, z)[1]
            nodes.append(1 + z)
            weights.append(2 / ((1 - z * z) * slope**2))
        stretch = [_ctx.expm1(_HALF_STRETCH * z) for z in nodes]
    return _Rule(nodes, weights, stretch)


@functools.lru_cache(maxsize=64)
def _integration_matrix(n: int, digits: int) -> list[list[mpmath.mpf]]:
    """Row i integrates the polynomial through the nodes from 0 to node i.

    Expanded in Legendre polynomials, (2k + 1) P_k has the integral P_k+1 − P_k−1 (P_−1 = −1).
    """
    rule = _gauss_legendre(n, digits)
    with _ctx.workdps(digits + 10):
        table = [_legendres(n, z - 1) for z in rule.nodes]
        values = [row[1:-1] for row in table]
        integrals = [[c - a for a, c in zip(row, row[2:], strict=False)] for row in table]
        return [
            [w / 2 * _ctx.fdot(row, at) for w, at in zip(rule.weights, values, strict=True)]
            for row in integrals
        ]


def _legendres(n: int, z: mpmath.mpf) -> list[mpmath.mpf]:
    """P_−1 (taken for −1), P_0, ... P_n."""
    p = [_ctx.mpf(-1), _ctx.mpf(1), z]
    for k in range(2, n + 1):
        p.append(((2 * k - 1) * z * p[-1] - (k - 1) * p[-2]) / k)
    return p


def _legendre(n: int, z: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
    """P_n and its derivative."""
    *_, q, p = _legendres(n, z)
    return p, n * (q - z * p) / (1 - z * z)


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
        raise ValueError(f"alpha0 must be in [-pi/2, pi/2], got {alpha0}")
    return v, a0


def _power(value: Any) -> _Exact:
    n = _number("n", value)
    if not 1 <= n() <= 10:
        raise ValueError(f"n must be in [1, 10], got {value}")
    return n


def _require_speed(v: mpmath.mpf, given: Any, *, rest: bool) -> None:
    if v < 0 or (v == 0 and not rest):
        raise ValueError(f"v_norm must be {'>=' if rest else '>'} 0, got {given}")


def _require_upward(alpha0: mpmath.mpf, given: Any) -> None:
    if alpha0 < 0:
        raise ValueError(f"alpha0 must be in [0, pi/2] on level ground, got {given}")


def _round(value: mpmath.mpf, dps: int) -> mpmath.mpf:
    with _ctx.workdps(dps):
        return mpmath.mp.make_mpf((+value)._mpf_)  # noqa: TID251


def _rounded(result: _T, dps: int) -> _T:
    values = {f.name: _round(getattr(result, f.name), dps) for f in fields(result)}
    return type(result)(**values)
