"""The fixed steps and SciPy's, against closed forms, `ode`, and the exercise written out."""

import math

import mpmath
import numpy as np
import pytest
from scipy import integrate as scipy_integrate

from hodograph import Launch, ode, steppers
from hodograph.steppers import ALOFT, FIXED, INVALID, LANDED, METHODS, UNSTABLE, integrate
from hodograph.witness import stepping_scipy

V0, G = 70.0, 9.81
ALPHA0 = np.deg2rad(np.arange(5.0, 90.0, 10.0))


def linear_exact(v0, alpha0, v_lim, g=G):
    """Range and flight time for linear drag, by Lambert's W with 50 digits."""
    rows = []
    with mpmath.workdps(50):
        tau = mpmath.mpf(v_lim) / g
        for alpha in np.ravel(alpha0):
            alpha = mpmath.mpf(float(alpha))
            z = 1 + v0 * mpmath.sin(alpha) / v_lim
            time = z + mpmath.lambertw(-z * mpmath.exp(-z)).real
            x = v0 * mpmath.cos(alpha) * tau * -mpmath.expm1(-time)
            rows.append((float(x), float(time * tau)))
    return np.array(rows).T


def exact_range(n, v_lim, alpha0=ALPHA0):
    return linear_exact(V0, alpha0, v_lim)[0] if n == 1 else Launch(V0, alpha0, v_lim).range()


# --- order --------------------------------------------------------------------------------

STEPS = 0.1 * 2.0 ** -np.arange(0, 4.01, 0.25)


@pytest.fixture(scope="module")
def errors():
    """Mean error of the range over the angles: {(n, method): (interpolated, naive) by step}."""
    table = {}
    for n in (1, 2):
        exact = exact_range(n, 30.0)
        for method in FIXED:
            rows = []
            for dt in STEPS:
                flights = integrate(V0, ALPHA0, 30.0, method=method, dt=dt, n=n)
                both = flights.impact.x, flights.impact_naive.x
                rows.append([np.mean(np.abs(x - exact)) for x in both])
            table[n, method] = np.array(rows).T
    return table


def slope(error):
    return np.polyfit(np.log(STEPS), np.log(error), 1)[0]


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize(
    ("method", "order"), [("euler", 1), ("euler_cromer", 1), ("rk2", 2), ("rk4", 4)]
)
def test_order(errors, n, method, order):
    assert FIXED[method].order == order
    assert slope(errors[n, method][0]) == pytest.approx(order, abs=0.05)


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("method", FIXED)
def test_naive_impact_hides_the_order(errors, n, method):
    assert slope(errors[n, method][1]) == pytest.approx(1, abs=0.2)


def test_naive_impact_makes_all_methods_of_higher_order_alike(errors):
    for n in (1, 2):
        naive = errors[n, "rk4"][1][-1]
        assert errors[n, "rk2"][1][-1] == pytest.approx(naive, rel=0.01)
        assert naive > 1e6 * errors[n, "rk4"][0][-1]


@pytest.mark.parametrize("n", [1, 1.5, 2, 3])
def test_methods_agree_with_the_adaptive_path(n):
    flight = ode.solve(V0, 0.9, 40.0, n=n, height=3.0, rtol=1e-12)
    found = integrate(V0, 0.9, 40.0, n=n, height=3.0, dt=0.005).impact
    assert found.x == pytest.approx(flight.x, rel=1e-10)
    assert found.t == pytest.approx(flight.t, rel=1e-10)
    assert math.hypot(found.p, found.q) == pytest.approx(flight.speed, rel=1e-10)
    assert math.atan2(found.q, found.p) == pytest.approx(flight.alpha, rel=1e-10)


@pytest.mark.parametrize("method", METHODS)
def test_every_method_tends_to_the_exact_answer(method):
    tight = {} if method in FIXED else {"rtol": 1e-10, "atol": 1e-10}
    flights = integrate(V0, ALPHA0, 981.0, n=1, dt=0.004, method=method, **tight)
    allowed = {1: 0.5, 2: 1e-5}.get(FIXED[method].order, 1e-7) if method in FIXED else 1e-5
    x, t = linear_exact(V0, ALPHA0, 981.0)
    assert np.max(np.abs(flights.impact.x - x)) < allowed
    assert np.max(np.abs(flights.impact.t - t)) < allowed / 10
    assert flights.success.all()


def test_midpoint_and_classical_are_exact_in_vacuum():
    for method in ("rk2", "rk4"):
        found = integrate(V0, ALPHA0, np.inf, method=method, dt=0.7).impact
        assert found.x == pytest.approx(V0**2 * np.sin(2 * ALPHA0) / G, rel=1e-13)
        assert found.q == pytest.approx(-V0 * np.sin(ALPHA0), rel=1e-13)


# --- the exercise, written out ------------------------------------------------------------

DT, ETA, MASS = 0.01, 0.01, 1.0


def f1(p, q):
    return -ETA / MASS * p


def f2(p, q):
    return -ETA / MASS * q - G


def euler(x, y, p, q):  # (6)
    return x + p * DT, y + q * DT, p + f1(p, q) * DT, q + f2(p, q) * DT


def euler_cromer(x, y, p, q):  # (7)
    p, q = p + f1(p, q) * DT, q + f2(p, q) * DT
    return x + p * DT, y + q * DT, p, q


def rk2(x, y, p, q):  # (17)
    k1p, k1q = f1(p, q) * DT, f2(p, q) * DT
    k2p, k2q = f1(p + k1p / 2, q + k1q / 2) * DT, f2(p + k1p / 2, q + k1q / 2) * DT
    k2x, k2y = p * DT + k1p * DT / 2, q * DT + k1q * DT / 2
    return x + k2x, y + k2y, p + k2p, q + k2q


def rk4(x, y, p, q):  # (20), (21)
    def rates(w):
        return np.array([w[2], w[3], f1(w[2], w[3]), f2(w[2], w[3])])

    w = np.array([x, y, p, q])
    k1 = DT * rates(w)
    k2 = DT * rates(w + k1 / 2)
    k3 = DT * rates(w + k2 / 2)
    k4 = DT * rates(w + k3)
    return tuple(w + k1 / 6 + k2 / 3 + k3 / 3 + k4 / 6)


def by_the_loop(step, alpha0):
    rows = [(0.0, 0.0, V0 * math.cos(alpha0), V0 * math.sin(alpha0))]
    while rows[-1][1] >= 0:
        rows.append(step(*rows[-1]))
    return np.array(rows).T


@pytest.mark.parametrize("step", [euler, euler_cromer, rk2, rk4], ids=lambda f: f.__name__)
def test_history_is_that_of_the_loop(step):
    rows = by_the_loop(step, np.pi / 4)
    found = integrate(V0, np.pi / 4, 981.0, method=step.__name__, dt=DT, n=1, history=True)
    stored = np.array([found.x, found.y, found.p, found.q])
    assert stored.shape == rows.shape
    np.testing.assert_allclose(stored, rows, rtol=1e-12, atol=1e-11)
    assert found.t == pytest.approx(DT * np.arange(rows.shape[1]))
    assert found.steps == rows.shape[1] - 1
    naive = found.impact_naive
    assert [naive.x, naive.y, naive.p, naive.q] == pytest.approx(rows[:, -2])
    assert naive.t == pytest.approx(found.t[-2])


@pytest.mark.parametrize("method", ["dopri5", "dop853"])
def test_scipy_ode_is_called_as_the_exercise_would(method):
    def rates(_t, w):
        return [w[2], w[3], f1(w[2], w[3]), f2(w[2], w[3])]

    solver = scipy_integrate.ode(rates).set_integrator(method)
    solver.set_initial_value([0.0, 0.0, V0 * math.cos(0.8), V0 * math.sin(0.8)])
    rows = [solver.y.copy()]
    while rows[-1][1] >= 0:
        rows.append(solver.integrate(len(rows) * DT).copy())
    found = integrate(V0, 0.8, 981.0, method=method, dt=DT, n=1, history=True)
    stored = np.array([found.x, found.y, found.p, found.q])
    np.testing.assert_allclose(stored, np.array(rows).T, rtol=1e-12, atol=1e-10)


@pytest.mark.parametrize("method", ["RK23", "RK45", "DOP853", "LSODA"])
def test_solve_ivp_gives_the_same_points(method):
    def rates(_t, w):
        k = G / 40.0**2 * math.hypot(w[0], w[1])
        return [-k * w[0], -k * w[1] - G, w[0], w[1]]

    found = integrate(V0, 0.8, 40.0, method=method, dt=0.25, history=True)
    start = [V0 * math.cos(0.8), V0 * math.sin(0.8), 0.0, 0.0]
    run = scipy_integrate.solve_ivp(rates, (0, 100), start, method, t_eval=found.t)
    stored = np.array([found.p, found.q, found.x, found.y])
    np.testing.assert_allclose(stored, run.y, rtol=1e-6, atol=1e-5)


def test_tolerances_reach_scipy():
    exact = Launch(V0, 0.8, 40.0).range()
    for method in steppers.SCIPY:
        loose, tight = (
            integrate(V0, 0.8, 40.0, method=method, dt=0.5, rtol=rtol, atol=1e-12)
            for rtol in (1e-3, 1e-11)
        )
        assert abs(tight.impact.x - exact) < 1e-3 * max(abs(loose.impact.x - exact), 1e-3)
        assert tight.evaluations >= loose.evaluations


# --- the tableaux -------------------------------------------------------------------------


def dense(method):
    rows = np.zeros((len(method.stages), len(method.stages)))
    for row, values in zip(rows, method.stages, strict=True):
        row[: len(values)] = values
    return rows, np.array(method.weights)


@pytest.mark.parametrize("name", FIXED)
def test_tableau(name):
    method = FIXED[name]
    a, b = dense(method)
    c = a.sum(axis=1)
    conditions = {
        1: [(b.sum(), 1)],
        2: [(b @ c, 1 / 2)],
        3: [(b @ c**2, 1 / 3), (b @ a @ c, 1 / 6)],
        4: [
            (b @ c**3, 1 / 4),
            (b @ (c * (a @ c)), 1 / 8),
            (b @ a @ c**2, 1 / 12),
            (b @ a @ a @ c, 1 / 24),
        ],
    }
    for order in range(1, method.order + 1):
        for found, wanted in conditions[order]:
            assert found == pytest.approx(wanted)
    assert sum(method.carry) == pytest.approx(1)
    if name != "euler_cromer":
        assert method.carry == (*method.weights, 0.0)


@pytest.mark.parametrize("name", FIXED)
def test_reach_is_the_end_of_the_stability_interval(name):
    method = FIXED[name]
    a, b = dense(method)

    def growth(z):
        return abs(1 + z * b @ np.linalg.solve(np.eye(len(b)) - z * a, np.ones(len(b))))

    assert growth(-method.reach) == pytest.approx(1)
    assert growth(-method.reach * 1.001) > 1
    assert growth(-method.reach * 0.999) < 1


# --- shapes, statuses ---------------------------------------------------------------------


def test_launches_broadcast_and_do_not_disturb_each_other():
    alpha0 = np.array([[0.2], [0.9], [1.5]])
    v_lim = np.array([20.0, np.inf])
    together = integrate(V0, alpha0, v_lim, dt=0.05, history=True)
    assert together.impact.x.shape == (3, 2)
    assert together.x.shape == (3, 2, together.t.size)
    for i in range(3):
        for j in range(2):
            alone = integrate(V0, alpha0[i, 0], v_lim[j], dt=0.05, history=True)
            assert alone.impact.x == pytest.approx(together.impact.x[i, j], rel=1e-14)
            end = together.steps[i, j] + 1
            assert end == alone.t.size
            np.testing.assert_allclose(together.y[i, j, :end], alone.y, rtol=1e-13, atol=1e-12)
            assert np.isnan(together.y[i, j, end:]).all()
            assert together.y[i, j, end - 1] < 0 <= together.y[i, j, end - 2]


def test_scalars_come_back():
    flight = integrate(V0, 0.7, 40.0, dt=0.1)
    assert np.ndim(flight.impact.x) == np.ndim(flight.status) == np.ndim(flight.steps) == 0
    assert flight.x is flight.t is None
    assert flight.impact.y == 0 <= flight.impact_naive.y


def test_no_launch_at_all():
    assert integrate(V0, [], 40.0, dt=0.1).impact.x.shape == (0,)


@pytest.mark.parametrize("method", METHODS)
def test_level_and_downward_launches_from_the_ground(method):
    flights = integrate(V0, [0.0, -0.3], 40.0, dt=0.01, method=method)
    assert flights.success.all()
    late = V0 * 0.01 if method == "euler" else 0.0  # Euler's first step is level
    assert flights.impact.x == pytest.approx([late, 0.0], abs=1e-6)


def test_a_step_longer_than_the_flight():
    flight = integrate(V0, 0.1, np.inf, dt=50.0)
    assert flight.impact.x == pytest.approx(V0**2 * math.sin(0.2) / G)
    assert flight.impact_naive.x == 0


def test_vertical_launch():
    flight = integrate(V0, np.pi / 2, 40.0, dt=0.001)
    assert flight.impact.t == pytest.approx(Launch(V0, np.pi / 2, 40.0).flight_time(), rel=1e-9)
    assert abs(flight.impact.x) < 1e-12


def test_long_falls_land_within_the_default_time():
    flights = integrate(
        [0.0, 200.0, 5.0],
        [0.0, 0.0, -1.5],
        [1.0, 10.0, 50.0],
        height=[100.0, 5.0, 4000.0],
        dt=0.005,
    )
    assert flights.success.all()


def test_aloft():
    flights = integrate(V0, [0.1, 1.5], 40.0, dt=0.01, t_max=3.0)
    assert flights.status.tolist() == [LANDED, ALOFT]
    assert np.isnan(flights.impact.x).tolist() == [False, True]
    assert np.isnan(flights.impact_naive.x).tolist() == [False, True]
    assert flights.steps[1] == 300
    for method in ("dopri5", "RK45"):
        assert integrate(V0, 1.5, 40.0, dt=0.01, t_max=3.0, method=method).status == ALOFT


@pytest.mark.parametrize("n", [1, 1.5, 2, 3])
@pytest.mark.parametrize("method", FIXED)
def test_a_step_too_large_for_the_drag(method, n):
    """On either side of the end of the stability interval at the launch."""
    limit = FIXED[method].reach * (10.0 / V0) ** (n - 1) * 10.0 / (n * G)
    for dt, status in ((1.01 * limit, UNSTABLE), (0.99 * limit, LANDED), (1e6, UNSTABLE)):
        flight = integrate(V0, 0.7, 10.0, dt=dt, n=n, method=method, history=True)
        assert flight.status == status
        assert np.isfinite(flight.impact.x) == flight.success == (status == LANDED)
        assert np.isfinite(flight.x).all()
    slow = integrate(1e-3, 0.7, 10.0, dt=1e6, n=1, method=method)
    assert slow.status == UNSTABLE


def test_explosion_on_the_way_down():
    """Slow at first, too fast for the step when it has fallen."""
    flight = integrate(0.0, 0.0, 50.0, height=1000.0, dt=5.2, method="euler")
    assert flight.status == UNSTABLE
    assert flight.steps >= 1
    assert np.isnan(flight.impact.x)


@pytest.mark.parametrize("n", [1, 2, 1e6])
@pytest.mark.parametrize(
    ("v0", "v_lim", "dt"),
    [(1e300, 1.0, 1e297), (1.0, 1e-320, 0.1), (1e150, np.inf, 1e147), (1e-300, 1e-300, 1e-303)],
)
def test_extremes_have_a_status_and_no_warning(v0, v_lim, dt, n):
    flight = integrate(v0, 0.7, v_lim, dt=dt, n=n, t_max=1000 * dt)
    assert flight.status in (LANDED, ALOFT, UNSTABLE)
    assert np.isfinite(flight.impact.x) == flight.success


@pytest.mark.parametrize("method", steppers.SCIPY)
def test_scipy_is_kept_from_hanging_on_an_overflow(method):
    """The drag is beyond the doubles at the launch, then only at a trial step."""
    assert integrate(V0, 0.7, 10.0, n=2000, dt=0.1, method=method, t_max=5.0).status == UNSTABLE
    flight = integrate(V0, 0.7, 65.0, n=2000, dt=0.1, method=method, t_max=5.0)
    assert flight.status in (ALOFT, UNSTABLE)


def test_nan_in_nan_out():
    flights = integrate(V0, [0.7, np.nan], [[40.0], [np.nan]], dt=0.1, history=True)
    assert flights.status.tolist() == [[LANDED, INVALID], [INVALID, INVALID]]
    assert np.isfinite(flights.impact.x).tolist() == [[True, False], [False, False]]
    assert np.isnan(flights.x[flights.status == INVALID]).all()
    assert len(steppers.STATUS) == 4


# --- what is refused ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"dt": 0}, ValueError, "dt must be finite and > 0; got 0.0"),
        ({"dt": -0.1}, ValueError, "dt must be finite and > 0; got -0.1"),
        ({"dt": math.nan}, ValueError, "dt must be finite and > 0; got nan"),
        ({"dt": math.inf}, ValueError, "dt must be finite and > 0; got inf"),
        ({"dt": [0.1, 0.2]}, TypeError, r"dt must be one number; got shape \(2,\)"),
        ({"dt": "0.1"}, TypeError, "dt must be real numbers; got str"),
        ({"dt": 1e-12}, ValueError, r"dt must be > t_max / 1e\+08, or the steps are too many"),
        ({"n": 0.5}, ValueError, "n must be finite and >= 1; got 0.5"),
        ({"n": math.inf}, ValueError, "n must be finite and >= 1; got inf"),
        ({"n": math.nan}, ValueError, "n must be finite and >= 1; got nan"),
        ({"t_max": 0}, ValueError, "t_max must be finite and > 0; got 0.0"),
        ({"t_max": math.inf}, ValueError, "t_max must be finite and > 0; got inf"),
        ({"method": "RK4"}, ValueError, "method must be one of euler, euler_cromer, rk2, rk4, dop"),
        ({"method": ["rk4"]}, ValueError, r"; got \['rk4'\]"),
        ({"v0": -1.0}, ValueError, "v0 must be finite and >= 0; got -1.0"),
        ({"v0": [1.0, math.inf]}, ValueError, "v0 must be finite and >= 0; got inf"),
        ({"v0": True}, TypeError, "v0 must be real numbers; got bool"),
        ({"v0": [1.0, True]}, TypeError, "v0 must be real numbers; got list"),
        ({"v0": [[1.0], [1.0, 2.0]]}, TypeError, "v0 must be real numbers in a regular array"),
        ({"v0": np.ma.masked_equal([1.0, 2.0], 2.0)}, TypeError, "v0 must be real numbers"),
        ({"alpha0": 90.0}, ValueError, r"alpha0 must be in \[-pi/2, pi/2\] radians; got 90.0"),
        ({"v_lim": 0.0}, ValueError, r"v_lim must be > 0 \(inf is vacuum\); got 0.0"),
        ({"g": 0.0}, ValueError, "g must be finite and > 0; got 0.0"),
        ({"height": -1.0}, ValueError, "height must be finite and >= 0; got -1.0"),
        (
            {"v0": np.ones(2), "alpha0": np.ones(3)},
            ValueError,
            r"do not broadcast together: v0 \(2,\), alpha0 \(3,\)",
        ),
        ({"rtol": 1e-6}, ValueError, "rtol is for SciPy's methods; rk4 has none"),
        ({"rtol": 0.0, "method": "RK45"}, ValueError, "rtol must be finite and >= 2.3e-14; got 0"),
        ({"rtol": 1e-20, "method": "DOP853"}, ValueError, "rtol must be finite and >= 2.3e-14;"),
        ({"atol": -1.0, "method": "dopri5"}, ValueError, "atol must be finite and > 0; got -1.0"),
        (
            {"history": True, "dt": 1e-6, "v0": np.ones(1000)},
            ValueError,
            "history would hold 2.*e.* nodes, and may hold 1e.08",
        ),
    ],
)
def test_refuses(change, error, message):
    with pytest.raises(error, match=message) as caught:
        integrate(**{"v0": 30.0, "alpha0": 0.7, "v_lim": 40.0, "dt": 0.1} | change)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("method", ["RK23", "RK45", "DOP853", "LSODA"])
def test_the_least_rtol_is_taken_as_given(method):
    solver = getattr(scipy_integrate, method)
    solver(lambda t, w: -w, 0.0, [1.0], 1.0, rtol=2.3e-14)  # SciPy warns if it takes another
    assert integrate(V0, 0.1, 40.0, dt=0.5, method=method, rtol=2.3e-14, atol=1e-3).success


def test_fixed_steps_leave_the_warnings_of_the_process_alone(monkeypatch):
    def refuse(**kwargs):
        raise AssertionError("catch_warnings is not safe in threads")

    monkeypatch.setattr(steppers.warnings, "catch_warnings", refuse)
    assert integrate(V0, 0.7, 40.0, dt=0.1).success


def test_refuses_units():
    class Quantity:
        units = "m/s"

    with pytest.raises(TypeError, match="v0 carries units"):
        integrate(Quantity(), 0.7, 40.0, dt=0.1)


class Labelled(list):
    """Passes for what a package made."""


def made_by(package, values, **more):
    return type("Made", (Labelled,), {"__module__": f"{package}.core", **more})(values)


def test_what_a_list_holds_is_looked_at():
    class Quantity(float):
        unit = "m/s"

    for part, message in (
        (made_by("xarray", [1.0]), "xarray Made; use xarray.apply_ufunc"),
        (made_by("dask", [1.0]), "dask Made; use dask.array.map_blocks"),
        (Quantity(1.0), "v0 carries units"),
        ([True], "v0 must be real numbers; got list"),
        (np.array([True]), "v0 must be real numbers; got list"),
    ):
        with pytest.raises(TypeError, match=message):
            integrate([[1.0], part], 0.7, 40.0, dt=0.1)


def test_tables_are_refused_and_an_index_is_none():
    with pytest.raises(TypeError, match="v0 is a pandas Made; pass its columns"):
        integrate(made_by("pandas", [30.0], columns=("v0",)), 0.7, 40.0, dt=0.1)
    assert integrate(made_by("pandas", [30.0]), 0.7, 40.0, dt=0.1).success.all()


def test_integers_beyond_64_bits():
    far = integrate(2**64, 0.7, math.inf, dt=1e17)
    assert far.impact.x == integrate(2.0**64, 0.7, math.inf, dt=1e17).impact.x
    assert far.success
    assert integrate([2**64, 2.0**64], 0.7, math.inf, dt=1e17).success.all()
    with pytest.raises(ValueError, match="v0 must be finite and >= 0; got inf"):
        integrate(10**400, 0.7, 40.0, dt=0.1)


def test_right_angles_in_single_precision():
    for degrees in (90, -90):
        rounded = np.deg2rad(np.float32(degrees))
        assert abs(float(rounded)) > math.pi / 2
        one, other = (
            integrate(5.0, angle, 40.0, dt=0.01, height=2.0)
            for angle in (rounded, math.radians(degrees))
        )
        assert one.impact.t == other.impact.t
    with pytest.raises(ValueError, match=r"got 45.0 \(if these are degrees: np.deg2rad\)"):
        integrate(30.0, [0.7, 45.0], 40.0, dt=0.1)


@pytest.mark.parametrize("method", METHODS)
def test_a_step_of_any_length_ends_with_a_status(method):
    for dt in (1e300, 1.7e308, 1e20, 1e9) + ((1e6, 50.0) if method in steppers.SCIPY else ()):
        for v_lim in (40.0, math.inf):
            flight = integrate(V0, 0.8, v_lim, dt=dt, method=method, n=2)
            assert flight.status == steppers.UNSTABLE
            assert np.isnan(flight.impact.x)
    for dt, t_max in ((1e-300, 1e-298), (5e-324, 1e-321), (1e300, 1.0)):
        flight = integrate(V0, 0.8, 40.0, dt=dt, t_max=t_max, method=method)
        assert flight.status in (steppers.ALOFT, steppers.UNSTABLE)
    with pytest.raises(ValueError, match="dt must be > t_max"):
        integrate(V0, 0.8, 40.0, dt=1e-300, method=method)


@pytest.mark.parametrize("method", steppers.SCIPY)
def test_scipy_stops_where_drag_asks_for_too_many_steps(method, monkeypatch):
    monkeypatch.setattr(stepping_scipy, "MAX_OWN", 5_000)
    flight = integrate(1.0, 0.7, 1e-10, dt=1e3, height=1.0, method=method)
    assert flight.status == steppers.UNSTABLE


def test_straight_down():
    for method in METHODS:
        flight = integrate(5.0, -math.pi / 2, math.inf, dt=0.01, height=2.0, method=method)
        assert flight.impact.y == 0
        t = (math.sqrt(25 + 2 * 9.81 * 2) - 5) / 9.81
        assert flight.impact.t == pytest.approx(t, rel=0.02 if "euler" in method else 1e-3)
