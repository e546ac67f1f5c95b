"""One shot in still air under quadratic drag, in plain floats: what `aim` does, for less.

The iteration and its symbols are those of `aim`, without its bracket.  Every function returns None
where that would be wanted, and the arrays are to answer.
"""

from __future__ import annotations

from math import asinh, atan, exp, expm1, hypot, inf, log1p, pi, sqrt, tan

from hodograph.engine import scalar
from hodograph.engine.aim import CLOSE, CLOSER, LAST_STEP, NEAR, QUICK_STEPS

Shot = tuple[float, float, float, float]  # alpha0, t, speed, alpha, in units of the launch
Path = tuple[float, float, float, float, float, float, float, float]

STEEPEST = 1e6  # slopes beyond are for the arrays
FLATTEST = 1e-3  # and targets so near the envelope, by the rate at which the height changes


def path(v: float, T: float, D: float) -> Path:
    """x, y, t, p, m, bend, M and turn of a path where its slope is T - D: see `response`."""
    c = 1.0 / hypot(1.0, T)
    sin, p, v2, cos2 = T * c, T - D, v * v, c * c
    size = hypot(1.0, p)
    one, other = T * size, p / c
    delta = asinh(D * ((T + p) / (one + other)) if T * p > 0 else one - other)
    eta = scalar.layer(v2)
    length = log1p(delta / eta)
    plus, minus = scalar.halves(sin, c)
    x = y = t = push = tilt = drive = 0.0
    for node, weight in scalar.node_class(v2 * cos2, sin / cos2, asinh(T), delta, eta, length):
        stretch = expm1(length * node)
        at = eta * stretch
        growth = expm1(at)
        grown = 1.0 + growth
        down = plus / grown
        C = down + minus * grown
        bend = growth * (down + minus)
        S = sin - bend
        u = 1.0 + v2 * (cos2 * at + bend + growth * (down - minus) * S)
        dx = weight * (stretch + 1.0) * C / u
        lever = S - c * p
        x += dx
        y += dx * S
        t += dx * sqrt(u)
        drive += dx / u
        push += dx / u * lever
        tilt += dx / C * (1.0 - S * lever / (C * C))
    scale = eta * length
    push, U = scale * push, 1.0 + v2 * scalar.bracket_gap(sin, c, delta)
    fast = c * v2 > 1.0  # which loses the fewer digits
    gain = scale * tilt - 2.0 * sin * push if fast else c * D - 2.0 * (sin + v2) * push
    bend = 2.0 * v2 * (c / U) * (c * size)
    turn = cos2 * (1.0 - 2.0 * (sin + v2) * scale * drive)
    return c * scale * x, scale * y, scale * t, p, cos2 / U, bend, c * gain, turn


def _first_guess(v: float, X: float, Y: float, high: bool) -> tuple[float, float]:
    """T and D, as `aim.first_guess`; no root where `disc` is negative."""
    length, T, e = hypot(X, Y), 0.0, 0.0
    for _ in range(2):
        e = min(v * v * length, 0.5 + log1p(v))
        f = 1.0 + 2 * e / 3 if e < 1e-3 else (expm1(2 * e) - 2 * e) / (2 * e * e)
        disc = 1.0 - f * (2 * Y + X * X * f)
        root = sqrt(max(disc, 0.0))
        low = not high and disc > 0
        T = (2 * Y + X * X * f) / (X * (1 + root)) if low else (1 + root * high) / (X * f)
        if high:
            length = max(length, 0.6 * X * hypot(1.0, T))
    return T, X * scalar.expm1_ratio(2 * e) * (1.0 + T * T)


def _step(P: Path, X: float, Y: float, T: float, high: bool, last: tuple[float, float, bool]) -> (
    tuple[float, float, float, tuple[float, float, bool], float] | None
):  # fmt: skip
    """The steps of T and p, dp/dT, what joins `last`, and by how much p has passed."""
    x, y, _, p, m, bend, M, turn = P
    rx, ry, turn = X - x, Y - y, turn / m
    across = -rx / m
    part = 1.0 + 0.5 * bend * across
    steep = p < -1 and (p + across < -0.5 or Y <= 0)
    P2 = 0.0
    if steep:
        P2 = p * p - 2 * ry / m * scalar.expm1_ratio(max(min(bend * ry / (m * p), 30.0), -30.0))
        steep = P2 >= 1
    if not steep and part < 0.02:
        return None
    dp = -sqrt(P2) - p if steep else across / part
    size = hypot(1.0, p)
    after = max(hypot(1.0, p + dp) / size, 1.0)
    short = min(abs(dp) / size, abs(dp) * bend * after)
    if short > CLOSE:
        return 0.0, dp, 0.0, last, short
    if steep:
        g = x - X + ry / p * (1.0 + ry / (2 * m * p * p))
        s, q = -(M + turn * ry / p) / (p + dp) * (1.0 + T * T), atan(T)
        dpdT, model = (M / p + turn * m) / m, 4 * max(x, X)
    else:
        g = y - Y + p * rx - rx * rx / (2 * m)
        s, q = M + rx * (turn - rx * T / (1.0 + T * T) / m), T
        dpdT, model = turn, max((X - M) / T, X * X) if T else X * X
    K = (last[1] - s) / (q - last[0]) if last[2] == steep and q != last[0] else 0.0
    K = K if K > 0 else model
    disc = s * s + 2 * K * g
    if not disc > 0:
        return None
    root = sqrt(disc)
    if high:
        change = 2 * g / (root - s) if s < 0 else (s + root) / K
    else:
        change = -2 * g / (s + root) if s > 0 else (s - root) / K
    if steep:
        t = tan(max(min(change, 1.5), -1.5))
        if T * t >= 1:
            return None
        change = t * (1.0 + T * T) / (1.0 - T * t)
    return change, dp, dpdT, (q, s, steep), short


def meet(v: float, X: float, Y: float, high: bool) -> Shot | None:
    """The launch that meets a target; X > 0."""
    try:
        return _meet(v, X, Y, high)
    except (OverflowError, ZeroDivisionError, ValueError):
        return None


def _meet(v: float, X: float, Y: float, high: bool) -> Shot | None:
    disc = 1.0 - 2 * Y - X * X
    if disc <= 0 or not v <= scalar.V_NORM_MAX:
        return None
    root = 1.0 + sqrt(disc)
    low, most = (2 * Y + X * X) / (X * root), root / X
    T, D = _first_guess(v, X, Y, high)
    T = min(max(T, low), most)
    last = (inf, inf, high)
    for _ in range(QUICK_STEPS):
        P = path(v, T, D)
        found = _step(P, X, Y, T, high, last)
        if found is None:
            return None
        change, dp, dpdT, last, short = found
        T_new = T + change
        square = (1.0 + T_new * T_new) / (1.0 + T * T)
        if abs(square - 1.0) > 0.5:
            D *= sqrt(square) if last[2] else square
        else:
            D += change * (1.0 - dpdT) - dp
        if not (low * (1 - 1e-12) - 1e-12 <= T_new <= most * (1 + 1e-12) and 0 < D < STEEPEST):
            return None
        small = abs(change) <= LAST_STEP * max(abs(T), min(D, 1.0)) and short <= CLOSER
        T = T_new
        if small:
            return _arrive(path(v, T, D), X, Y, T, high, last)
    return None


def _arrive(P: Path, X: float, Y: float, T: float, high: bool, last: tuple[float, float, bool]) -> (
    Shot | None
):  # fmt: skip
    """What it is like where the target is met; None where that is near the envelope, or missed."""
    x, y, t, p, m, bend, M, _ = P
    found = _step(P, X, Y, T, high, last)
    rise = M / hypot(1.0, p)
    if found is None or not (rise < 0 if high else rise > 0) or abs(rise) < FLATTEST * X:
        return None
    change, dp, _, (_, _, steep), short = found
    if short > CLOSER or abs(change) > NEAR * max(abs(T), 1.0):
        return None
    t += ((Y - y) / p if steep else X - x) / sqrt(m)
    p += dp
    speed = sqrt(m) * exp(0.5 * bend * dp) * hypot(1.0, p)
    return atan(T), t, speed, atan(p)


def shot(
    high: bool,
    v0: float, x: float, y: float, v_lim: float, n: float, g: float, *moving: float,
) -> tuple[float, ...] | None:  # fmt: skip
    """The rows of `targets.shots` for one shot, whose arguments are legal."""
    time = v0 / g
    length = v0 * time
    if n != 2 or not x or any(moving) or not length > 0.0:
        return None
    found = meet(v0 / v_lim, abs(x) / length, y / length, high)
    if found is None:
        return None
    alpha0, t, speed, alpha = found
    return alpha0, pi if x < 0 else 0.0, t * time, speed * v0, alpha, 0.0
