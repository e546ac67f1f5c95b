"""Two other packages as ways to d_norm, of the optional extra ``bench``.

Each function makes one, as `methods` describes them, and gives None where its package is not
installed.
"""

import math
import warnings
from typing import Any

import numpy as np

from hodograph.bench.methods import FIRST_STEP, Batch, Scalar, time_scale, units, vacuum
from hodograph.engine.domain import FloatArray


def by_diffrax(*, rtol: float = 1e-13, atol: float = 1e-16, scaled: bool = False) -> Batch | None:
    """A function for many launches at once by diffrax: Dopri8 in time, jit and vmap.

    Its first call for a length of arrays compiles.  The tolerances are those of one step; `scaled`
    is as for `methods.by_solve_ivp`.
    """
    try:
        import diffrax
        import jax
        import optimistix
    except ImportError:
        return None
    np_ = jax.numpy

    def rates(_t: Any, state: Any, scale: Any) -> Any:
        drag, weight = scale
        _, _, vx, vy = state
        v = drag * np_.sqrt(vx * vx + vy * vy)
        return vx, vy, -v * vx, -weight - v * vy

    def height(t: Any, y: Any, args: Any, **_: Any) -> Any:  # diffrax passes these by name
        return y[1]

    root = optimistix.Newton(rtol=rtol, atol=atol)
    event = diffrax.Event(height, root, direction=False)
    control = diffrax.PIDController(rtol=rtol, atol=atol)
    term, solver = diffrax.ODETerm(rates), diffrax.Dopri8()

    def one(v: Any, a: Any) -> Any:
        speed_unit, time_unit = units(v, np_.sin(a)) if scaled else (1.0, 1.0)
        drag, weight, v0 = speed_unit * time_unit, time_unit / speed_unit, v / speed_unit
        flight = diffrax.diffeqsolve(
            term, solver, 0.0, (2 * v + 1) / time_unit, FIRST_STEP if scaled else None,
            (0 * v, 0 * v, v0 * np_.cos(a), v0 * np_.sin(a)), (drag, weight),
            stepsize_controller=control, event=event, throw=False,
        )  # fmt: skip
        return flight.ys[0][0] * drag / (v * v * np_.sin(2 * a))

    many = jax.jit(jax.vmap(one))

    def batch(v_norm: FloatArray, alpha0: FloatArray) -> FloatArray:
        with jax.enable_x64(True):  # here only, not for the whole process
            return np.asarray(many(v_norm, alpha0))

    return batch


def by_ballisticcalc(*, steps: int | None = None, rtol: float = 1e-10) -> Scalar | None:
    """A function for one launch by the compiled engines of py-ballisticcalc, made for small arms.

    Its drag coefficient is held constant, and so is the air: terminal speed is so low, 10 feet a
    second, that the flight stays within the 30 feet of height in which the library takes the
    density of the launch.

    With `steps` it is its RK4, with so many steps in `time_scale`; else its Dormand-Prince 5(4),
    with the relative tolerance `rtol` of one step, and as the absolute one a thousandth of it in
    units of the flight.  NaN where no landing is found.
    """
    try:
        import py_ballisticcalc as pb
        import py_ballisticcalc_exts as engines
    except ImportError:
        return None
    v_lim, g = 10.0, pb.constants.cGravityImperial  # feet and seconds
    air = pb.Atmo.icao()
    step = engines.CythonizedRK4IntegrationEngine(None).DEFAULT_TIME_STEP
    still = {"cMinimumVelocity": 0.0, "cMaximumDrop": 0.0}  # until y = 0, however slow

    def shot(v0: float, alpha0: float, ballistic_coefficient: float) -> Any:
        drag = pb.DragModel(ballistic_coefficient, [pb.DragDataPoint(1.0, 1.0)])
        ammunition = pb.Ammo(drag, pb.Velocity.FPS(v0))
        return pb.Shot(ammo=ammunition, atmo=air, relative_angle=pb.Angular.Radian(alpha0))

    unit = pb.ShotProps.from_shot(shot(v_lim, 0.0, 1.0)).drag_by_mach(1.0)
    ballistic_coefficient = air.density_ratio * unit * v_lim**2 / g  # drag is g at v_lim

    def one(v_norm: float, alpha0: float) -> float:
        time = time_scale(v_norm, math.sin(alpha0)) * v_lim / g
        if steps is None:
            engine = engines.CythonizedDormandPrinceIntegrationEngine
            small = v_norm * v_lim * min(time, 1.0)  # of the lengths and the speeds
            setting = {"relative_tolerance": rtol, "absolute_tolerance": 1e-3 * rtol * small}
        else:
            engine = engines.CythonizedRK4IntegrationEngine
            setting = {"cStepMultiplier": time / steps / step}
        calculator = pb.Calculator(config=still | setting, engine=engine)
        with warnings.catch_warnings():  # it sets a filter for the whole process
            flight = calculator.fire(
                shot(v_norm * v_lim, alpha0, ballistic_coefficient),
                pb.Distance.Foot(1e9),
                flags=pb.TrajFlag.ZERO_DOWN,
                raise_range_error=False,
            )
        landing = flight.flag(pb.TrajFlag.ZERO_DOWN)
        if landing is None:
            return math.nan
        x = float(landing.distance >> pb.Distance.Foot) * float(g) / v_lim**2
        return x / vacuum(v_norm, alpha0)

    return one
