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

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
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


def __getattr__(name: str) -> Any:
    """Import what a public name needs when it is first asked for."""
    value: Any
    if name in ("Landing", "Launch", "Trajectory"):
        from hodograph import launch

        value = getattr(launch, name)
    elif name in ("d_norm", "d_ref"):
        from hodograph import distance

        value = getattr(distance, name)
    elif name == "landing_angle":
        from hodograph import landing

        value = landing.landing_angle
    elif name == "optimal_angle":
        from hodograph import optimum

        value = optimum.optimal_angle
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
