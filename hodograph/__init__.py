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

from importlib import import_module

TYPE_CHECKING = False  # `typing` takes longer to import than all that is here
if TYPE_CHECKING:
    from typing import Any

    from hodograph import grid, laws, ode, reference, sensitivity, steppers, surrogate
    from hodograph.launch import Landing, Launch, Trajectory
    from hodograph.level import d_norm, d_ref, landing_angle, optimal_angle
    from hodograph.reach import best_angle

__version__ = "0.1.0"

__all__ = [
    "Landing",
    "Launch",
    "Trajectory",
    "__version__",
    "best_angle",
    "d_norm",
    "d_ref",
    "grid",
    "landing_angle",
    "laws",
    "ode",
    "optimal_angle",
    "reference",
    "sensitivity",
    "steppers",
    "surrogate",
]


_HOME = {
    "Landing": "launch",
    "Launch": "launch",
    "Trajectory": "launch",
    "best_angle": "reach",
    "d_norm": "level",
    "d_ref": "level",
    "landing_angle": "level",
    "optimal_angle": "level",
}


if not TYPE_CHECKING:  # a type checker shall know the public names, and no others

    def __getattr__(name: str) -> Any:
        """Import what a public name needs when it is first asked for."""
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        module = import_module(f"{__name__}.{_HOME.get(name, name)}")
        value = getattr(module, name) if name in _HOME else module
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted(__all__)
