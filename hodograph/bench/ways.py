"""Every way to d_norm that `work_precision` sets side by side, and its settings."""

import math
from collections.abc import Iterator
from functools import partial

from hodograph import laws, reference
from hodograph.bench import methods, packages
from hodograph.bench.measurement import Sizes, Way
from hodograph.bench.methods import one_by_one
from hodograph.engine.domain import FloatArray
from hodograph.level import d_norm
from hodograph.tiers import dial

TOLERANCES = tuple(10.0**-k for k in range(2, 13))
STEPS = (8, 32, 128, 512)  # in `methods.time_scale`
TOLERANCES_IVP = (1e-4, 1e-6, 1e-8, 1e-10)
NODES = (4, 6, 8, 12, 16, 32, 64)
PRECISIONS = (15, 30)
TOLERANCES_ALONE = (1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)  # one launch a call
TOLERANCES_QUAD = (1e-6, 1e-13)

EULER, CROMER, RK2, RK4 = "Euler", "Euler-Cromer", "RK2", "RK4"
STEPPERS = {EULER: "euler", CROMER: "euler_cromer", RK2: "rk2", RK4: "rk4"}
SOLVERS = ("RK45", "DOP853", "LSODA")
IVP = "solve_ivp {}"
PAPER, ENGINE, TIER, DIAL = "paper's own route", "engine, always n nodes", "method=...", "rtol=..."
LAW, MPMATH, DIFFRAX, QUAD = "law", "mpmath", "diffrax Dopri8", "quad + Newton"
EXACT, DEFAULTS = "method='exact'", "defaults"
BALLISTICCALC = {"rk4": "py-ballisticcalc RK4", "rk45": "py-ballisticcalc Dormand-Prince"}
LAWS = {
    "table_1": laws.table_1,
    "d_norm_law": laws.d_norm_law,
    "d_norm_law_all": laws.d_norm_law_all,
}


def ways(sizes: Sizes) -> Iterator[Way]:
    """All of them; of the packages those that are installed."""
    many, several, each, few = sizes.many, sizes.several, sizes.each, sizes.few
    for name, method in STEPPERS.items():
        for steps in STEPS:
            compute = partial(methods.by_steps, method=method, steps=steps)
            yield Way(name, f"{steps} steps", compute, several)
    for method in SOLVERS:
        for rtol in TOLERANCES_IVP:
            one = partial(
                methods.by_solve_ivp, method=method, rtol=rtol, atol=1e-3 * rtol, scaled=True
            )
            yield Way(IVP.format(method), _asked(rtol), one_by_one(one), each)
    yield Way(PAPER, "", one_by_one(methods.by_paper), each)
    for nodes in NODES:
        compute = partial(methods.by_nodes, nodes=nodes)
        yield Way(ENGINE, f"{nodes} nodes", compute, many, general=False, checked=True)
    for tier in dial.METHODS:
        exact, setting = tier == "exact", f"method={tier!r}"
        compute = partial[FloatArray](d_norm, method=tier)
        v_max = dial.V_MAX.get(tier, math.inf)
        promise = dial.PROMISE if exact else float(dial.bounds()[tier].max())
        yield Way(TIER, setting, compute, many, v_max=v_max, checked=exact, promise=promise)
    for rtol in TOLERANCES:
        compute = partial[FloatArray](d_norm, rtol=rtol)
        yield Way(DIAL, _asked(rtol), compute, many, promise=rtol)
    for name, law in LAWS.items():
        yield Way(LAW, name, law, many)
    for dps in PRECISIONS:
        one = partial(reference.d_norm, dps=dps)
        yield Way(MPMATH, f"{dps} digits", one_by_one(one), few, checked=True)
    for rtol in TOLERANCES_IVP[1:]:
        batch = packages.by_diffrax(rtol=rtol, atol=1e-3 * rtol, scaled=True)
        if batch is not None:
            yield Way(DIFFRAX, _asked(rtol), batch, several)
    yield from _by_ballisticcalc(each)


def ways_alone(each: int) -> Iterator[Way]:
    """Those that a program would call for one launch, and the library called so."""
    yield Way(TIER, EXACT, one_by_one(d_norm), each, promise=dial.PROMISE)
    for rtol in TOLERANCES_ALONE:
        yield Way(DIAL, _asked(rtol), one_by_one(partial(d_norm, rtol=rtol)), each, promise=rtol)
    for rtol in TOLERANCES_QUAD:
        yield Way(QUAD, _asked(rtol), one_by_one(partial(methods.by_quad, rtol=rtol)), each)
    for method, setting, rtol in (("RK45", DEFAULTS, 1e-3), ("DOP853", _asked(1e-10), 1e-10)):
        one = partial(methods.by_solve_ivp, method=method, rtol=rtol, atol=1e-3 * rtol, scaled=True)
        yield Way(IVP.format(method), setting, one_by_one(one), each)
    yield Way(PAPER, "", one_by_one(methods.by_paper), each)
    yield from _by_ballisticcalc(each)


def _by_ballisticcalc(each: int) -> Iterator[Way]:
    for steps in STEPS:
        fire = packages.by_ballisticcalc(steps=steps)
        if fire is not None:
            yield Way(BALLISTICCALC["rk4"], f"{steps} steps", one_by_one(fire), each)
    for rtol in TOLERANCES_IVP:
        fire = packages.by_ballisticcalc(rtol=rtol)
        if fire is not None:
            yield Way(BALLISTICCALC["rk45"], _asked(rtol), one_by_one(fire), each)


def _asked(rtol: float) -> str:
    return f"rtol={rtol:.0e}"
