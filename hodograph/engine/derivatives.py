"""How the landing answers to a change of the launch, for drag of any exponent.

With the landing held at its height, and q = -tan(alpha_s), a change of the launch moves it by::

    dR = dx + (dy + dh) / q    (dx, dy: of the point of slope alpha_s, h: launch height),

and eq. 15 is differentiated under the integral.  In units of v0^2 / g and v0 / g, with
v = v_norm, (s, c) = (sin, cos)(alpha0), C = c / cos(alpha), L = c (tan(alpha) + q), U the bracket
of eq. 8, K2 the integral of C^(n - 2) over delta and T = 1 - s (n - 1) K2::

    v0 dR/dv0 = 2 / q times the integral of C L / U^(1 + 2/n) d(delta),    dR/dh = 1 / q,
    v_lim dR/dv_lim = 2 / q times the integral of C L (U - 1) / U^(1 + 2/n) d(delta),
    dR/dalpha0 = -R tan(alpha0) + c B / q,
    B = s + c q - 2 v^n times the integral of C L T / U^(1 + 2/n) d(delta).

All signs are one, but in B, which for a fast launch nearly vanishes.  The part of its integral
next to the launch is therefore integrated by parts, up to a slope where drag has done its work::

    s + c q - 2 v^n (...) = L C^(1 - n) T U^(-2/n) + integral of
        U^(-2/n) {[C^(2 - n) - (n - 1) sin(alpha) L C^(1 - n)] T + (n - 1) s L / C} d(delta),

the first term taken at that slope.  The first term of dR/dalpha0 is all of it for a vertical
launch, the range of which turns over.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hodograph.engine.domain import FloatArray
from hodograph.engine.flight import Flight, arc
from hodograph.engine.velocity import Ahead, Start, start

EARLY = 0.5  # slope come down, up to which the integral is taken by parts


class Derivatives(NamedTuple):
    """Of the range, in units of v0^2 / g; each times what makes it a pure number."""

    reach: FloatArray  # the range over cos(alpha0)
    alpha0: FloatArray  # Q dR/dalpha0
    v0: FloatArray  # Q v0 dR/dv0
    v_lim: FloatArray  # Q v_lim dR/dv_lim
    height: FloatArray  # Q dR/dh
    Q: FloatArray  # q, or 1 where q is beyond measure, after a fall at terminal speed


class _State(NamedTuple):
    """Where the path stands, as seen from the launch: C, U - 1 and K2."""

    C: FloatArray
    e: FloatArray
    K2: FloatArray

    @property
    def U(self) -> FloatArray:
        """The bracket of eq. 8."""
        return 1 + self.e


def derivatives(flight: Flight, *, of_angle: bool = False) -> Derivatives:
    """The derivatives of the range of one block of launches that land; or the one in alpha0 alone.

    The others are then NaN, but for that in height.
    """
    sin0, cos0, v, n = flight.sin0, flight.cos0, flight.v, flight.n
    q = np.sqrt(flight.down.P)
    deep = flight.beyond > 0  # there tan(alpha_s) has grown by exp(beyond), and q is divided out
    decay = np.exp(-flight.beyond)
    scale = np.where(deep, decay / np.maximum(q, 1.0), 1.0)
    flat = np.where(deep, -np.expm1(-flight.beyond), 0.0)
    end = flight.delta
    ahead = Ahead(end, scale, cos0 * flat)
    begin = start(v * v, sin0, cos0)

    near = np.minimum(EARLY, end)
    speeds = () if of_angle else ("push", "drag")
    first, e = arc(begin, np.arcsinh(sin0 / cos0), near, n, ("tilt", *speeds), ahead)
    C = 0.5 * (begin.plus * np.exp(-near) + begin.minus * np.exp(near))
    here = _State(C, e, first["K2"])
    turn = (n - 1) * sin0
    by_parts = ahead.lever(begin, near) * C ** (1 - n) * (1 - turn * here.K2) * here.U ** (-2 / n)
    by_parts += first["tilt"]
    nothing = np.full_like(v, np.nan)
    push, drag, late = first.get("push", nothing), first.get("drag", nothing), np.zeros_like(v)

    for leg, slope, delta, target in _legs(flight, (v * C) ** 2 * here.U ** (-2 / n), ahead, near):
        part, e = arc(leg, slope, delta, n, ("push", "push_turned", *speeds[1:]), target)
        unit = here.C**2 * here.U ** (-1 - 2 / n)
        own = unit * part["push"]
        turned = here.C ** (n - 2) * unit * part["push_turned"]
        late += (1 - turn * here.K2) * own - turn * turned
        push = push + own
        drag = drag + here.e * own + here.U * unit * part.get("drag", nothing)
        here = _State(cos0, here.e + here.U * e, here.K2 + here.C ** (n - 2) * part["K2"])
    B = by_parts - 2 * v**n * late
    # the fall at terminal speed, where C / U^(1/n) = 1 / v and L / q is 1 but near the ground
    final = v * v * np.maximum(q, 1.0)
    drag += np.divide(flat - flight.beyond * decay, final, out=np.zeros_like(v), where=deep)
    Q = np.where(deep, 1.0, q)
    by_angle = cos0 * B - Q * sin0 * flight.reach
    return Derivatives(flight.reach, by_angle, 2 * push, 2 * drag, scale, Q)


def _legs(
    flight: Flight, v2: FloatArray, ahead: Ahead, near: FloatArray
) -> list[tuple[Start, FloatArray, FloatArray, Ahead]]:
    """What follows after `near`, at v2: up to the apex or to the landing, and down from the apex.

    Each leg by its start, its slope there, how far it comes down, and the landing.
    """
    slope = np.arcsinh(flight.sin0 / flight.cos0) - near
    high = flight.slope > EARLY  # the apex comes later
    middle = start(v2, np.tanh(slope), 1 / np.cosh(slope))
    top = Start(*(np.where(high, a, b) for a, b in zip(flight.top, middle, strict=True)))
    flat, fallen = ahead.level / flight.cos0, np.where(high, flight.down.delta, 0.0)
    after = np.where(high, flight.slope, ahead.delta) - near
    later = Ahead(ahead.delta - near, ahead.scale, flat / np.cosh(slope))
    return [
        (middle, slope, after, later),
        (top, np.zeros_like(near), fallen, Ahead(fallen, ahead.scale, flat)),
    ]
