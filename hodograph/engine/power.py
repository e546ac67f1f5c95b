"""Arcs and falls under drag lambda v^n, n >= 1: the path that n = 2 need not take (eq. 8).

With w = v_norm cos(alpha0) and G(p) the integral of (1 + p^2)^((n - 1) / 2),

    U = 1 + n w^n (G(p0) - G(p)),    v_x = w U^(-1/n)                          eq. 8

and (15) integrates powers of U.  As in `velocity`, an arc is described from its own beginning:

    w^n (G(p0) - G(p)) = v^n K,    K = integral of C^n over delta,    C = cos(alpha0) / cos(alpha).

The arc is cut into panels.  On each, K at all nodes is one product of the integration matrix of
the nodes with C^n there, and nothing cancels.  The first panels are even in tau, as in `position`,
the others even in delta; both are short enough for the singularities of U and of C^n.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from hodograph.engine.domain import FloatArray, Rule
from hodograph.engine.fall import TINY, Descent, slope_gain
from hodograph.engine.position import gauss_legendre
from hodograph.engine.velocity import LN_LARGEST, Ahead, Start, expm1_ratio

EXPONENT = Rule("in [1, 10]", lambda a: (a >= 1) & (a <= 10))

NODES = 24  # of one panel
# The longest panels: in tau; in delta, where C^n has branch points pi/2 beside the apex, grows
# as exp(n delta), and U has zeros pi/n beside the fall.
LONGEST_TAU, LONGEST, GROWTH = 2.5, 1.5, 8.0
EARLY = 0.5  # delta up to which panels are even in tau
BLOCK = 16384  # nodes times launches held at once
GUESSES, GUESS_NODES, GUESS_LONGEST = 2, 8, 6.0  # of the fall, and the slope that these do for

MAX_STEPS = 100
LAST_STEP = 1e-6  # relative; the order of convergence is 3, so the error left is about its cube
# A step that changes the fall by no more than this factor is integrated by so many nodes.
LATER_STEP, LATER_NODES = 1.02, 8
# By so much of asinh(tan(alpha)) past where the speed can first be terminal, the fall is taken as
# vertical and terminal: what is neglected is exp(-n FINAL) and exp(-2 FINAL).
FINAL = 20.0


class Nodes(NamedTuple):
    """A panel at its nodes, arrays of (node, launch); alpha0 is where the arc begins."""

    n: FloatArray
    delta: FloatArray
    C: FloatArray  # cos(alpha0) / cos(alpha)
    S: FloatArray  # C sin(alpha)
    e: FloatArray  # U - 1
    U: FloatArray
    r: FloatArray  # U^(-1/n)
    dt: FloatArray  # C r d(delta)
    begin: Start
    scale: FloatArray  # of `Ahead`
    lever: FloatArray  # L of `Ahead`
    K2: FloatArray  # integral of C^(n - 2), where an integrand asks for it

    @property
    def bent(self) -> FloatArray:
        """Minus the derivative of L C^(1 - n) in delta, over C^(2 - n)."""
        return self.scale + (1 - self.n) * self.S * self.lever / self.C**2

    @property
    def tilt(self) -> FloatArray:
        """What is left of the derivative in alpha0 when it is integrated by parts."""
        C, turn = self.C, (self.n - 1) * self.begin.sin
        bent = C ** (1 - self.n) * self.bent * (1 - turn * self.K2) + turn * self.lever / C**2
        return self.dt * self.r * bent


# What can be integrated over an arc; the same as in `position`.
Integrand: TypeAlias = Callable[[Nodes], FloatArray]
INTEGRANDS: dict[str, Integrand] = {
    "x": lambda at: at.dt * at.r,
    "lag": lambda at: at.dt * -np.expm1(-np.log1p(at.e) / at.n),
    "y": lambda at: at.dt * at.r * at.S,
    "t": lambda at: at.dt,
    "s": lambda at: at.dt * at.r * at.C,  # length of path: dx / cos(alpha)
    "drive": lambda at: at.dt * at.r / at.U,
    "drive_t": lambda at: at.dt / at.U,
    "parts": lambda at: at.dt * at.r * at.C ** (1 - at.n) * at.bent,
    "push": lambda at: at.dt * at.r / at.U * at.lever,
    "push_turned": lambda at: at.dt * at.r / at.U * at.lever * at.K2,
    "drag": lambda at: at.dt * at.r / at.U * at.lever * at.e,
    "tilt": lambda at: at.tilt,
}
TURNED = ("push_turned", "tilt")


def cosines(begin: Start, delta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """C = cos(alpha0) / cos(alpha), and S = sin(alpha) C."""
    growth = np.expm1(delta)
    down, up = begin.plus / (1 + growth), begin.minus * (1 + growth)
    return 0.5 * (down + up), begin.sin - 0.5 * growth * (down + begin.minus)


def slowing(v: FloatArray, n: FloatArray) -> FloatArray:
    """eta: at delta = -eta the path, continued backwards, has infinite speed (exact at 90 deg)."""
    return np.asarray(np.log1p(np.maximum(v, 1e-300 ** (1 / np.asarray(n))) ** -n) / n)


@cache
def integration_matrix(count: int) -> FloatArray:
    """Integrals from 0 to each Gauss node on [0, 1], and to 1, of what is given at the nodes."""
    nodes, weights = (column[:, 0] for column in gauss_legendre(count))
    z = np.append(2 * nodes - 1, 1.0)
    P = legendre.legvander(z, count)  # (node, degree)
    integral = np.empty((count + 1, count))
    integral[:, 0] = (z + 1) / 2
    for k in range(1, count):
        integral[:, k] = (P[:, k + 1] - P[:, k - 1]) / 2
    matrix = integral @ (P[:-1, :count] * weights[:, np.newaxis]).T
    # for k = 0 the factor 2 k + 1 is 1; for the others it cancels that of the integral of P_k
    matrix.flags.writeable = False
    return matrix


def is_square(n: FloatArray) -> bool:
    """Whether drag is quadratic, which it is for all launches of a call or for none."""
    return n.size == 0 or bool(n.flat[0] == 2)


class Panels(NamedTuple):
    """How each arc is cut: so many panels even in tau up to `early`, then so many even in delta."""

    eta: FloatArray
    early: FloatArray
    in_tau: NDArray[np.intp]
    in_delta: NDArray[np.intp]


def cut(v: FloatArray, delta: FloatArray, n: FloatArray) -> Panels:
    """The panels of arcs that come down by `delta`."""
    eta = slowing(v, n)
    longest = np.minimum(LONGEST, GROWTH / n)
    length = np.log1p(delta / eta)
    short = (delta <= longest) & (length <= LONGEST_TAU / 2)
    early = np.where(short, delta, np.minimum(delta, EARLY * longest / LONGEST))
    in_tau = np.ceil(np.log1p(early / eta) / LONGEST_TAU)
    in_delta = np.ceil((delta - early) / longest)
    return Panels(eta, early, np.maximum(in_tau, 1).astype(np.intp), in_delta.astype(np.intp))


class Front(NamedTuple):
    """What the integrals over an arc have come to."""

    K: FloatArray  # of (v C)^n; early in the arc without v^n delta, which is most of it
    K2: FloatArray  # of C^(n - 2)
    sums: dict[str, FloatArray]


def _panel(
    begin: Start, n: FloatArray, at: FloatArray, width: FloatArray, K: FloatArray, K2: FloatArray,
    ahead: Ahead | None, wanted: tuple[str, ...], *, early: bool,
) -> Front:  # fmt: skip
    """Integrals over one panel of each arc, and K at its end.

    `at` is delta at the nodes, `width` d(delta) over the step between them.
    """
    matrix = integration_matrix(at.shape[0])
    v = np.sqrt(begin.v2)
    plus, minus = 0.5 * begin.plus, 0.5 * begin.minus
    growth = np.expm1(at)
    C = 1 + growth
    down = plus / C
    C *= minus
    C += down
    S = down + minus
    S *= growth
    np.subtract(begin.sin, S, out=S)
    if early:
        vn = v**n
        down -= minus
        down *= -growth  # C - 1
        inner = np.expm1(n * np.log1p(down, out=down), out=growth)
        inner *= vn
    else:
        inner = np.power(v * C, n, out=growth)
    inner *= width
    K_at = matrix @ inner
    K_at += K
    e = n * (K_at[:-1] + vn * at if early else K_at[:-1])
    turned = any(name in wanted for name in TURNED)
    K2_at = K2 + matrix @ (C ** (n - 2) * width) if turned else np.broadcast_to(K2, K_at.shape)
    U = 1 + e
    r = U ** (-1 / n)
    dt = gauss_legendre(at.shape[0])[1] * width
    dt *= C
    dt *= r
    lever = S if ahead is None else ahead.lever(begin, at)
    scale = S if ahead is None else ahead.scale
    here = Nodes(n, at, C, S, e, U, r, dt, begin, scale, lever, K2_at[:-1])
    sums = {name: np.add.reduce(INTEGRANDS[name](here), axis=0) for name in wanted}
    return Front(K_at[-1], K2_at[-1], sums)


def arc(
    begin: Start,
    delta: FloatArray,
    n: FloatArray,
    wanted: tuple[str, ...],
    ahead: Ahead | None = None,
) -> tuple[dict[str, FloatArray], FloatArray]:
    """Integrals over arcs, as `position.arc`, and U - 1 at their ends; begin.v2 is v_norm^2.

    With the integrands that need it, "K2" joins the results.
    """
    names = (*wanted, "K2") if any(name in wanted for name in TURNED) else wanted
    sums = {name: np.zeros_like(delta) for name in names}
    e_end = np.zeros_like(delta)
    width = BLOCK // NODES
    for first in range(0, delta.size, width):
        at = slice(first, first + width)
        front = _few(begin.at(at), delta[at], n[at], wanted, ahead and ahead.at(at))
        e_end[at] = n[at] * front.K
        for name in names:
            sums[name][at] = front.K2 if name == "K2" else front.sums[name]
    return sums, e_end


def _few(
    begin: Start, delta: FloatArray, n: FloatArray, wanted: tuple[str, ...], ahead: Ahead | None
) -> Front:
    """`arc` for as many as the cache holds, panel after panel."""
    v = np.sqrt(begin.v2)
    panels = cut(v, delta, n)
    total = Front(
        np.zeros_like(delta), np.zeros_like(delta), {name: np.zeros_like(delta) for name in wanted}
    )
    nodes = gauss_legendre(NODES)[0]

    def add(members: NDArray[np.intp], at: FloatArray, width: FloatArray, early: bool) -> None:
        own, K, K2 = begin.at(members), total.K[members], total.K2[members]
        target = ahead and ahead.at(members)
        part = _panel(own, n[members], at, width, K, K2, target, wanted, early=early)
        total.K[members], total.K2[members] = part.K, part.K2
        for name in wanted:
            total.sums[name][members] += part.sums[name]

    begun = np.zeros_like(delta)
    for number in range(panels.in_tau.max(initial=0)):
        members = np.flatnonzero(panels.in_tau > number)
        first, scale = begun[members], begun[members] + panels.eta[members]
        rest = np.log1p((panels.early[members] - first) / scale)
        length = rest / (panels.in_tau[members] - number)
        at = first + scale * np.expm1(length * nodes)
        add(members, at, (at + panels.eta[members]) * length, early=True)
        begun[members] = first + scale * np.expm1(length)
    total.K[:] += v**n * panels.early
    width = (delta - panels.early) / np.maximum(panels.in_delta, 1)
    for number in range(panels.in_delta.max(initial=0)):
        members = np.flatnonzero(panels.in_delta > number)
        length = width[members]
        add(members, panels.early[members] + length * (number + nodes), length, early=False)
    return total


def _bend(w2: FloatArray, P: FloatArray, U: FloatArray, n: FloatArray) -> FloatArray:
    """k that makes expm1(2 k Y) locally linear in P, Y the height fallen: w^2 if it is vertical."""
    log = np.log(np.maximum(w2, TINY)) * (n / 2) + np.log1p(P) * ((n - 1) / 2)
    log = log + np.log(U) * (2 / n - 1) - np.log(np.maximum(P, TINY)) / 2
    return np.asarray(np.exp(np.minimum(log, LN_LARGEST)))


def _newton(
    w2: FloatArray, P: FloatArray, U: FloatArray, n: FloatArray, miss: FloatArray
) -> FloatArray:
    """The step in P to where the fall is deeper by `miss`."""
    bent = 2 * _bend(w2, P, U, n) * miss
    return np.asarray(2 * U ** (2 / n) * miss * expm1_ratio(np.clip(bent, -50.0, 50.0)))


@np.errstate(all="ignore")  # where the nodes are too few
def _first_guess(begin: Start, P_start: FloatArray, drop: FloatArray, n: FloatArray) -> FloatArray:
    """P - P_start: straight with the bend of the start, then by few nodes over the whole fall."""
    cos2 = begin.plus * begin.minus
    w2 = begin.v2 * cos2
    at_start = _bend(w2, P_start, np.ones_like(w2), n)
    bend = np.where(P_start > 0, np.minimum(at_start, w2), w2)
    gain = 2 * drop * expm1_ratio(np.minimum(2 * bend * drop, 200.0))
    nodes, width = gauss_legendre(GUESS_NODES)[0], BLOCK // GUESS_NODES
    for first in range(0, gain.size, width):
        at = slice(first, first + width)
        own, P0, depth, n_, zero = begin.at(at), P_start[at], drop[at], n[at], np.zeros_like(w2[at])
        for _ in range(GUESSES):
            delta = slope_gain(P0, P0 + gain[at], gain[at])
            front = _panel(
                own, n_, delta * nodes, delta, zero, zero, None, ("y",),
                early=False,
            )  # fmt: skip
            miss = depth + front.sums["y"] / cos2[at]
            better = gain[at] + _newton(w2[at], P0 + gain[at], 1 + n_ * front.K, n_, miss)
            sound = (delta < GUESS_LONGEST) & (better >= depth)
            gain[at] = np.where(sound, better, gain[at])
    return gain


def descend(
    begin: Start, P_start: FloatArray, drop: FloatArray, n: FloatArray, wanted: tuple[str, ...]
) -> Descent:
    """Fall by `drop`, as `fall.descend`.

    Newton on expm1(2 k Y) in P, with k taken where it stands.  The height fallen grows by less
    than P / 2, which bounds P from below, and a bracket holds the iteration together elsewhere.
    """
    cos2 = begin.plus * begin.minus
    w2 = begin.v2 * cos2
    gain = _first_guess(begin, P_start, drop, n)
    low, high = drop.copy(), np.full_like(drop, np.inf)  # the bound, with room for rounding
    error, steps = np.zeros_like(drop), np.zeros(drop.shape, np.int8)

    U, sums = _from_start(begin, P_start, gain, n, wanted)
    todo = np.flatnonzero(drop > 0)
    for number in range(1, MAX_STEPS + 1):
        if not todo.size:
            break
        now, P = gain[todo], P_start[todo] + gain[todo]
        miss = drop[todo] + sums["y"][todo]
        low[todo] = np.where(miss > 0, np.maximum(now, low[todo]), low[todo])
        high[todo] = np.where(miss < 0, np.minimum(now, high[todo]), high[todo])
        following = now + _newton(w2[todo], P, U[todo], n[todo], miss)
        least, most = low[todo], high[todo]
        middle = np.where(np.isinf(most), 16 * now, np.sqrt(least) * np.sqrt(most))
        inside = (following >= least) & (following <= most)
        following = np.where(inside | (miss == 0), following, middle)
        relative = np.abs(following - now) / following
        gain[todo], error[todo], steps[todo] = following, np.minimum(relative, 1.0) ** 3, number
        near = (following <= LATER_STEP * now) & (now <= LATER_STEP * following)
        at = todo[near]
        if at.size:
            pieces, U[at] = _step(
                begin.at(at), P_start[at], now[near], gain[at], n[at], U[at], wanted
            )
            for name, piece in pieces.items():
                sums[name][at] += piece
        at = todo[~near]
        if at.size:
            U[at], whole = _from_start(begin.at(at), P_start[at], gain[at], n[at], wanted)
            for name, sum_ in whole.items():
                sums[name][at] = sum_
        todo = todo[~(relative <= LAST_STEP)]
    converged = np.ones(drop.shape, bool)
    converged[todo] = False
    P = P_start + gain
    return Descent(P, slope_gain(P_start, P, gain), sums, U, error, converged, steps)


def _from_start(
    begin: Start, P_start: FloatArray, gain: FloatArray, n: FloatArray, wanted: tuple[str, ...]
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """U, and the integrals from the start of the fall, in units of its beginning."""
    sums, e = arc(begin, slope_gain(P_start, P_start + gain, gain), n, wanted)
    return 1 + e, _in_units_of_the_fall(begin, sums)


def _in_units_of_the_fall(begin: Start, sums: dict[str, FloatArray]) -> dict[str, FloatArray]:
    cos2 = begin.plus * begin.minus
    units = {"x": np.sqrt(cos2), "t": np.sqrt(cos2)}
    return {name: sum_ / units.get(name, cos2) for name, sum_ in sums.items()}


def _step(
    begin: Start, P_start: FloatArray, gain: FloatArray, gain_next: FloatArray, n: FloatArray,
    U: FloatArray, wanted: tuple[str, ...],
) -> tuple[dict[str, FloatArray], FloatArray]:  # fmt: skip
    """What a short step adds to the integrals of a fall, in units of its beginning; U after it."""
    P = P_start + gain
    delta = slope_gain(P_start, P, gain)
    change = gain_next - gain
    width = slope_gain(np.minimum(P, P + change), np.maximum(P, P + change), np.abs(change))
    width = np.copysign(width, change)
    at = delta + width * gauss_legendre(LATER_NODES)[0]
    front = _panel(begin, n, at, width, (U - 1) / n, U, None, wanted, early=False)
    return _in_units_of_the_fall(begin, front.sums), 1 + n * front.K


def fall_to_final(
    begin: Start, P_start: FloatArray, n: FloatArray, wanted: tuple[str, ...]
) -> Descent:
    """The fall to the slope past which it is straight down and at terminal speed."""
    # U outgrows what it began with where tan(alpha) exceeds 1 / v_x, and that of the start
    cos2 = begin.plus * begin.minus
    slope = np.arcsinh(np.sqrt(P_start))
    first = np.maximum(np.maximum(slope, -0.5 * np.log(begin.v2 * cos2)), 0.0)
    final = first + FINAL * np.maximum(1.0, 2 / n)
    sums, e = arc(begin, final - slope, n, wanted)
    sums = _in_units_of_the_fall(begin, sums)
    done = np.ones(slope.shape, bool)
    zero = np.zeros_like(slope)
    return Descent(
        np.sinh(final) ** 2, final - slope, sums, 1 + e, zero, done, zero.astype(np.int8)
    )
