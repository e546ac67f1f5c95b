"""SciPy's methods, asked for the state at every step's end."""

import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from scipy import integrate

from hodograph.witness.stepping_fixed import Law
from hodograph.witness.stepping_inputs import Array

# SciPy has no classical method of order 4: nearest are the pairs of Dormand and Prince, which
# advance at order 5 and estimate the error by order 4.
_BY_ODE = ("dopri5", "dop853")
_BY_SOLVE_IVP = {name: getattr(integrate, name) for name in ("RK23", "RK45", "DOP853", "LSODA")}
SCIPY = (*_BY_ODE, *_BY_SOLVE_IVP)
MIN_RTOL = 2.3e-14  # SciPy warns below 100 ulp and uses that instead
MAX_OWN = 500_000  # evaluations for steps that SciPy chooses, some 20 s
_HUGE = 1e100


def by_scipy(
    method: str, law: Law, dt: float, state: Array, tolerances: dict[str, float]
) -> Iterator[Array]:
    """The nodes after `state`, until SciPy gives up."""
    shape = state.shape
    if not np.isfinite(law(state[:2])).all():
        return

    def rates(_t: float, flat: Array) -> Array:
        velocity = flat.reshape(shape)[:2]
        force = law(velocity)
        if not math.isfinite(np.vdot(force, force)):  # a trial step too far; SciPy rejects no NaN
            force = np.nan_to_num(force, nan=_HUGE, posinf=_HUGE, neginf=-_HUGE)
        return np.concatenate([force, velocity]).ravel()

    if method in _BY_ODE:
        solver = integrate.ode(rates)
        solver.set_integrator(method, nsteps=MAX_OWN // 10, **tolerances)
        solver.set_initial_value(state.ravel(), 0.0)
        step = 0
        while solver.successful():
            step += 1
            with _interruptible():
                node = np.array(solver.integrate(step * dt))
            yield node.reshape(shape)
    else:  # what solve_ivp does with t_eval, node by node
        solver = _BY_SOLVE_IVP[method](rates, 0.0, state.ravel(), math.inf, **tolerances)
        step = 1
        while solver.step() is None and solver.status == "running" and solver.nfev < MAX_OWN:
            inside = solver.dense_output()
            while step * dt <= solver.t:
                yield inside(step * dt).reshape(shape)
                step += 1


@contextmanager
def _interruptible() -> Iterator[None]:
    """Raise a KeyboardInterrupt that SciPy's compiled code has turned into another error."""
    try:
        yield
    except Exception as error:
        cause: BaseException | None = error
        while cause is not None:
            if isinstance(cause, KeyboardInterrupt):
                raise cause from None
            cause = cause.__cause__
        raise
