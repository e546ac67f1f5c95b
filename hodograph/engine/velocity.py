"""The speed and the arc length along the path, in closed form (eq. 8-13, 19).

The slope is carried as s = asinh(tan alpha), and an arc is described from its own beginning:
delta = s0 - s >= 0 is how far the slope has come down.  With w = (v cos alpha0)^2,

    u = 1 + w (F(p0) - F(p)),    F(p) = asinh p + p sqrt(1 + p^2),    p = tan alpha,

is the bracket of eq. 13.  The difference of the two F is never formed: it is

    F(p0) - F(p) = delta + sinh(delta) cosh(2 s0 - delta),

a sum of terms of one sign, to which cos(alpha0) is brought as the factors 1 +/- sin(alpha0), so
that nothing cancels near the launch and nothing overflows near the vertical.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import FloatArray

LN_LARGEST = 709.0  # its exponential is still a double


class Start(NamedTuple):
    """Where an arc begins: v_norm^2, sin(alpha0) and 1 +/- sin(alpha0), each to full accuracy."""

    v2: FloatArray
    sin: FloatArray
    plus: FloatArray
    minus: FloatArray

    def at(self, index: NDArray[np.intp] | slice) -> Start:
        """The elements at `index`."""
        return Start(*(part[index] for part in self))


class Ahead(NamedTuple):
    """Where an arc ends, for derivatives of the range: they weight each point by its way to there.

    They hold L = scale cos(alpha0) (tan(alpha) - tan(alpha_s)) + level, alpha_s being the slope
    after `delta`.
    """

    delta: FloatArray
    scale: FloatArray
    level: FloatArray

    def at(self, index: NDArray[np.intp] | slice) -> Ahead:
        """The elements at `index`."""
        return Ahead(*(part[index] for part in self))

    def lever(self, begin: Start, delta: FloatArray) -> FloatArray:
        """L where the arc has come down by `delta`; the difference is not formed as one."""
        middle = 0.5 * (delta + self.delta)
        growth = np.exp(middle)
        C = begin.plus / growth + begin.minus * growth  # twice C at the middle
        return self.scale * C * np.sinh(0.5 * (self.delta - delta)) + self.level


def start(v2: FloatArray, sin0: FloatArray, cos0: FloatArray) -> Start:
    """The `Start` of launches at any angle."""
    far = 1 + np.abs(sin0)
    near = cos0 * cos0 / far
    up = sin0 >= 0
    return Start(v2, sin0, np.where(up, far, near), np.where(up, near, far))


def slope_drop(cos0: FloatArray, alpha0: FloatArray, alpha: FloatArray) -> FloatArray:
    """delta = asinh(tan alpha0) - asinh(tan alpha), without subtracting the two."""
    sine_gap = 2 * np.cos((alpha0 + alpha) / 2) * np.sin((alpha0 - alpha) / 2)
    return np.arcsinh(sine_gap / (cos0 * np.cos(alpha)))


def bracket_gap(begin: Start, delta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(q, C): u = 1 + v^2 q is the bracket of eq. 13, and C = cos(alpha0) / cos(alpha)."""
    growth = np.expm1(delta)
    decay = 1 / (1 + growth)
    down, up = begin.plus * decay, begin.minus * (1 + growth)
    gap = begin.plus * begin.minus * delta + 0.25 * growth * (1 + decay) * (
        begin.plus * down + begin.minus * up
    )
    return gap, 0.5 * (down + up)


def log1p_ratio(z: FloatArray) -> FloatArray:
    """ln(1 + z) / z, which is 1 at z = 0."""
    zero = z == 0
    return np.where(zero, 1.0, np.log1p(z) / np.where(zero, 1.0, z))


def expm1_ratio(z: FloatArray) -> FloatArray:
    """(e^z - 1) / z, which is 1 at z = 0; of `LN_LARGEST` where z is larger.

    `scipy.special.exprel`, without the import of SciPy, which takes longer than a flight.
    """
    z = np.minimum(z, LN_LARGEST)
    return np.divide(np.expm1(z), z, out=np.ones_like(z), where=z != 0)
