"""The hodograph of one launch (eq. 13), and the path over one panel of it (eq. 15).

With s = asinh(tan α), so that cosh s = 1/cos α, and δ = s0 − s, the slope fallen through since
the launch, the equations of motion become

    W = v_x^−n,   W = W0 + n ∫ coshⁿs dδ                                     (eq. 13 for n = 2)
    dx = v_x² cosh s dδ,   dy = sinh s dx,   dt = v_x cosh s dδ,   d(arc) = cosh s dx    (eq. 15)

Every term of W is positive, and the integrands of x, t and arc length keep one sign.  For n = 2
the gain of W is elementary; else it is integrated from its value at the beginning of the panel
to every node, by the matrix that integrates the polynomial through the nodes (Gauss collocation).

The singularities of the integrands are the zeros of W and, unless n is even, s = ± iπ/2.  One
zero is real and lies at least log1p(1/v_normⁿ)/n above s0: that is the drag layer of a fast
launch.  The same bound, with the speed of the moment, is the radius of a disc free of zeros, and
none but the real one is nearer to the real axis than π/n (n > 2) or π/2.  Panels are cut by these
distances, and in the layer itself they are even in the logarithm of the distance to the real
zero: Gauss-Legendre gains at least 1.4 digits a node.
"""

from dataclasses import dataclass
from typing import NamedTuple

import mpmath

from hodograph.witness.reference_numbers import GUARD, Exact, ctx, s_of, zero
from hodograph.witness.reference_rules import (
    HALF_STRETCH,
    Rule,
    gauss_legendre,
    integration_matrix,
)

_Column = list[mpmath.mpf]


class Point(NamedTuple):
    """Where the integration has got to: the path since the launch or since its top."""

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

    def origin(self) -> "Point":
        """The same place, from which the path is now counted."""
        return Point(*self[:3], *[zero()] * 8)

    def joined(self, later: "Point") -> "Point":
        """The path to here, and that of `later`, which is counted from here."""
        return Point(*later[:3], *(a + b for a, b in zip(self[3:], later[3:], strict=True)))


@dataclass(frozen=True)
class Hodograph:
    """Eq. 13 for one launch, with what its quadratures need."""

    v0: mpmath.mpf
    s0: mpmath.mpf
    n: mpmath.mpf
    w0: mpmath.mpf
    layer: mpmath.mpf  # a lower bound of the distance from s0 up to the real zero of W
    tiny: mpmath.mpf
    goal: int
    rule: Rule
    matrix: list[_Column] | None  # None: n = 2 has a closed form
    vary: bool  # whether the integrals for the derivatives are wanted
    tilt: mpmath.mpf  # tangent of the ground's slope; y is counted from ground of this slope
    level: mpmath.mpf  # s of the ground, where the path is highest over it

    def start(self) -> Point:
        """The launch."""
        return Point(zero(), self.s0, *[zero()] * 9)

    def vx(self, w: mpmath.mpf) -> mpmath.mpf:
        """W^(−1/n)."""
        if self.n == 1:
            return 1 / w
        if self.n == 2:
            return 1 / ctx.sqrt(w)
        return ctx.exp(-ctx.ln(w) / self.n)

    def cosh_n(self, cosh: mpmath.mpf) -> mpmath.mpf:
        """The n-th power."""
        if self.n == int(self.n):
            return cosh ** int(self.n)
        return ctx.exp(self.n * ctx.ln(cosh))

    def speed(self, at: Point) -> mpmath.mpf:
        """The speed at a point."""
        return self.vx(self.w0 + at.gain) * ctx.cosh(at.s)

    def value(self, at: Point, name: str) -> mpmath.mpf:
        """A quantity at a point, y over ground of the slope in question."""
        return at.y - self.tilt * at.x if name == "y" else getattr(at, name)

    def rate(self, at: Point, name: str) -> mpmath.mpf:
        """Derivative of a quantity with respect to δ."""
        p = ctx.sinh(at.s)
        cosh, vx = ctx.sqrt(1 + p * p), self.vx(self.w0 + at.gain)
        if name == "t":
            return vx * cosh
        return vx * vx * cosh * {"x": 1, "y": p - self.tilt, "s_arc": cosh}[name]

    def excess(self, at: Point) -> mpmath.mpf:
        """(v_lim / speed)ⁿ − 1."""
        return (self.w0 + at.gain) / self.cosh_n(ctx.cosh(at.s)) - 1

    def longest(self, at: Point) -> mpmath.mpf:
        """The longest panel that begins here."""
        near = self.layer + at.delta
        if near < 0.002 / self.n:
            return near * ctx.expm1(2 * HALF_STRETCH)
        excess = self.excess(at)
        clear = ctx.log1p(1 + excess) / 2  # half the radius of the disc, times n
        if at.s < 0:  # once near the terminal speed, the zeros are behind
            behind = -ctx.ln(abs(excess) + self.n * ctx.exp(2 * at.s))
            clear = max(clear, behind / 2)
        return min(ctx.mpf(1), max(clear, min(self.n * near, 2)) / self.n, 5 / self.n)

    def step(self, at: Point, width: mpmath.mpf) -> Point:
        """Integrate over one panel."""
        offsets, scales = self._nodes(at, width)
        weights = _product(scales, self.rule.weights)
        sines = [ctx.sinh(at.s - offset) for offset in offsets]
        cosines = [ctx.sqrt(1 + p * p) for p in sines]
        gains, gain = self._gains(at, width, offsets, scales, sines, cosines)
        w = [self.w0 + g for g in gains]
        vx = [self.vx(value) for value in w]
        dt = _product(vx, cosines)
        dx = _product(dt, vx)
        columns = [dx, _product(dx, sines), dt, _product(dx, cosines)]
        if self.vary:
            slow = [[d / value for d, value in zip(c, w, strict=True)] for c in columns[:2]]
            columns += [*slow, *(_product(column, gains) for column in slow)]
        done = [ctx.fdot(weights, column) for column in columns]
        done += [zero()] * (8 - len(done))
        path = (old + new for old, new in zip(at[3:], done, strict=True))
        return Point(at.delta + width, at.s - width, gain, *path)

    def _nodes(self, at: Point, width: mpmath.mpf) -> tuple[_Column, _Column]:
        """How far behind `at` each node lies, and what its weight is to be multiplied with."""
        near, half = self.layer + at.delta, width / 2
        if width <= 2 * near:
            return [half * z for z in self.rule.nodes], [half] * len(self.rule.nodes)
        half = ctx.log1p(width / near) / 2
        stretch = self.rule.stretch
        if abs(half - HALF_STRETCH) > self.tiny:
            stretch = [ctx.expm1(half * z) for z in self.rule.nodes]
        offsets = [near * e for e in stretch]
        return offsets, [half * (near + offset) for offset in offsets]

    def _gains(
        self,
        at: Point,
        width: mpmath.mpf,
        offsets: _Column,
        scales: _Column,
        sines: _Column,
        cosines: _Column,
    ) -> tuple[_Column, mpmath.mpf]:
        """W − W0 at the nodes and at the end of a panel."""
        if self.matrix is None:
            # 2 ∫ cosh²s dδ = d + sinh(d) cosh(s + s − d), d the part of the panel behind
            p0 = ctx.sinh(at.s)
            cosh0 = ctx.sqrt(1 + p0 * p0)
            gains = [
                at.gain + d + ctx.sinh(d) * (cosh0 * c + p0 * p)
                for d, c, p in zip(offsets, cosines, sines, strict=True)
            ]
            return gains, at.gain + width + ctx.sinh(width) * ctx.cosh(2 * at.s - width)
        rates = [self.n * scale * self.cosh_n(c) for scale, c in zip(scales, cosines, strict=True)]
        gains = [at.gain + ctx.fdot(row, rates) for row in self.matrix]
        return gains, at.gain + ctx.fdot(self.rule.weights, rates)


def hodograph(
    v: Exact, a0: Exact, n: Exact, dps: int, *, vary: bool = False, slope: Exact = zero
) -> Hodograph:
    """Set the working precision, then W0 of eq. 13."""
    goal = dps + GUARD
    ctx.dps = max(ctx.dps, goal + GUARD)
    v0, s0, power = v(), s_of(a0()), n()
    rounded = goal + -goal % 10  # so that the rules are few
    size = round(rounded / 1.4) + 4, rounded + 5
    return Hodograph(
        v0=v0,
        s0=s0,
        n=power,
        w0=ctx.exp(power * ctx.ln(ctx.cosh(s0) / v0)),
        layer=ctx.log1p(ctx.exp(-power * ctx.ln(v0))) / power,
        tiny=ctx.mpf(10) ** -goal,
        goal=goal,
        rule=gauss_legendre(*size),
        matrix=None if power == 2 else integration_matrix(*size),
        vary=vary,
        tilt=ctx.tan(slope()),
        level=s_of(slope()),
    )


def _product(a: _Column, b: _Column) -> _Column:
    return [p * q for p, q in zip(a, b, strict=True)]
