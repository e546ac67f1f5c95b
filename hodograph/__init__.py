"""The flight of a projectile under quadratic drag, solved semi-analytically.

::

    inputs --> domain --> velocity --> position --> landing --> distance --> grid
               checks     v(alpha)     x, y, t      alpha_s     d_norm        tables
                          closed form  quadrature   Newton         |
                                                      |            +--> optimum, laws
                                                      +--> launch: SI in, SI out

    ode, reference: two independent paths to the same numbers
    figures, report, cli: the paper remade, and the command line

The speed along the path has a closed form in the slope angle; position follows by quadrature;
everything reduces to ``v_norm = v0 / v_lim`` and ``alpha0``.  Angles are in radians.
"""

from __future__ import annotations

from hodograph.distance import d_norm, d_ref
from hodograph.landing import landing_angle
from hodograph.launch import Landing, Launch, Trajectory
from hodograph.optimum import optimal_angle

__version__ = "0.1.0"

__all__ = [
    "Landing",
    "Launch",
    "Trajectory",
    "__version__",
    "d_norm",
    "d_ref",
    "landing_angle",
    "optimal_angle",
]
