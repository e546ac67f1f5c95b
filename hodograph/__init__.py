"""The flight of a projectile under quadratic drag, solved semi-analytically.

The speed along the path has a closed form in the slope angle; position follows by quadrature;
everything reduces to ``v_norm = v0 / v_lim`` and ``alpha0``.  Angles are in radians.

::

    hodograph.d_norm(v_norm, alpha0)                   range over the range without drag
    hodograph.Launch(v0, alpha0, v_lim).range()        a scene in SI units: range, time, apex, path
    hodograph.optimal_angle(v_norm)                    the launch angle of greatest range
    hodograph.aim(v0, x, y, v_lim)                     the launch that hits a target
    hodograph.calibrate(x, y, t)                       drag and launch out of a film
    hodograph.bodies                                   drag from mass, size and Cd; bodies of sport
    hodograph.laws, hodograph.sensitivity              formulas; derivatives of the range
    hodograph.ode, .steppers, .reference               three other ways to the same numbers

What stands at the top level of this package is public, and so is `laws`; the other folders are
machinery.
"""

from __future__ import annotations

import sys
from importlib import import_module

TYPE_CHECKING = False  # `typing` takes longer to import than all that is here
if TYPE_CHECKING:
    from typing import Any

    from hodograph import bodies, grid, laws, ode, reference, sensitivity, steppers, surrogate
    from hodograph.calibrate import Calibration, calibrate
    from hodograph.launch import Landing, Launch, State, Trajectory
    from hodograph.level import d_norm, d_ref, landing_angle, optimal_angle
    from hodograph.reach import Envelope, LeastSpeed, Shot, aim, best_angle, envelope, least_speed

__version__ = "0.3.0"

__all__ = [
    "Calibration",
    "Envelope",
    "Landing",
    "Launch",
    "LeastSpeed",
    "Shot",
    "State",
    "Trajectory",
    "__version__",
    "aim",
    "best_angle",
    "bodies",
    "calibrate",
    "d_norm",
    "d_ref",
    "envelope",
    "grid",
    "landing_angle",
    "laws",
    "least_speed",
    "ode",
    "optimal_angle",
    "reference",
    "sensitivity",
    "steppers",
    "surrogate",
    "sweep",
]


_HOME = {
    "Calibration": "calibrate",
    "Envelope": "reach",
    "Landing": "launch",
    "Launch": "launch",
    "LeastSpeed": "reach",
    "Shot": "reach",
    "State": "launch",
    "Trajectory": "launch",
    "aim": "reach",
    "best_angle": "reach",
    "calibrate": "calibrate",
    "d_norm": "level",
    "d_ref": "level",
    "envelope": "reach",
    "landing_angle": "level",
    "least_speed": "reach",
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

    class _Package(type(sys)):
        """`hodograph` itself: `hodograph.calibrate` is the function, whatever is imported first."""

        def __setattr__(self, name: str, value: Any) -> None:
            """Take the function where the import of its module would put that."""
            if name == "calibrate" and isinstance(value, type(sys)):
                value = value.calibrate
            super().__setattr__(name, value)

    sys.modules[__name__].__class__ = _Package


def __dir__() -> list[str]:
    return sorted(__all__)
