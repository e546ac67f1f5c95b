"""The engine on the whole domain, against answers computed to 30 digits (data/reference*.csv)."""

import mpmath
import numpy as np
import pytest
from helpers import DATA

from hodograph import Launch, d_norm, landing_angle, reference
from hodograph.builders import reference_points as points
from hodograph.engine.driver import BLOCK
from hodograph.engine.flight import fly
from hodograph.engine.status import Status
from hodograph.path import position
from hodograph.sensitivity import range_sensitivity

EPSILON = np.finfo(float).eps
FILE = DATA / "reference.csv"


@pytest.fixture(scope="module")
def truth():
    return points.load(FILE)


@pytest.fixture(scope="module")
def landing(truth):
    return Launch(truth["v_norm"], truth["alpha0"], 1.0, g=1.0, height=truth["height"]).landing()


def off(found, true):
    return np.abs(found / true - 1)


def test_the_file_is_what_it_says(truth):
    v, a, h = (truth[name] for name in points.INPUTS)
    assert v.size >= 600
    assert (v.min(), v.max()) == (1e-8, 1e8)
    assert np.sum((a < 1e-3) & (a > 0)) >= 50
    assert np.sum((np.pi / 2 - a) < 1e-3) >= 50
    assert np.sum(h > 0) >= 100
    assert np.sum(h < 0) >= 30
    assert np.sum(a < 0) >= 50
    launches = np.array(list(points.inputs()))
    if np.lib.NumpyVersion(np.__version__) >= "2.4.0":
        np.testing.assert_array_equal(launches, np.column_stack([v, a, h]))
    # the powers of ten and the angles are NumPy's, whose last bit varies with its version
    np.testing.assert_allclose(launches, np.column_stack([v, a, h]), rtol=1e-15)


def test_level_ground_to_1e_13(truth, landing):
    level = truth["height"] == 0
    assert np.all(landing.status == Status.CONVERGED)
    for name in ("x", "t", "speed", "alpha", "arc_length"):
        error = off(getattr(landing, name), truth[name])[level]
        assert error.max() <= 1e-13, name
        assert np.median(error) < 1e-15, name


def test_d_norm_and_landing_angle_to_1e_13(truth):
    level = truth["height"] == 0
    v, a = truth["v_norm"][level], truth["alpha0"][level]
    error = off(landing_angle(v, a), truth["alpha"][level])
    assert error.max() <= 1e-13
    assert np.median(error) < 1e-15
    # sin(2 alpha0) at the doubles passed in, from mpmath: near 90 degrees it has no room for error
    import mpmath

    context = mpmath.MPContext()
    context.dps = 40
    d_ref = np.array([float(context.sin(2 * context.mpf(angle))) for angle in a]) * v**2
    error = off(d_norm(v, a), truth["x"][level] / d_ref)
    assert error.max() <= 1e-13
    assert np.median(error) < 1e-15


def test_heights_and_downward_launches_where_well_conditioned(truth, landing):
    # an error e in the drop is one of e / tan(alpha_s) in x, e / (v sin(alpha_s)) in t and
    # e (1 - v^2 / sin(alpha_s)) / v in speed: a drop that is a small difference of apex and
    # height carries the rounding of both
    other = truth["height"] != 0
    x, t, speed, alpha = (truth[name] for name in ("x", "t", "speed", "alpha"))
    size = truth["apex_y"] + np.abs(truth["height"])
    conditions = {
        "x": size / (x * np.abs(np.tan(alpha))),
        "t": size / (t * speed * np.abs(np.sin(alpha))),
        "speed": size * (1 / speed + speed / np.abs(np.sin(alpha))) / speed,
    }
    for name, condition in conditions.items():
        error = off(getattr(landing, name), truth[name])
        well = other & (condition < 30)
        assert np.sum(well) > 0.6 * np.sum(other)
        assert error[well].max() <= 1e-13, name
        assert np.median(error[well]) < 1e-15, name
        ill = other & (condition >= 30)
        assert np.all(error[ill] <= 1e-13 + 2 * EPSILON * condition[ill]), name


def test_apex(truth):
    launch = Launch(truth["v_norm"], truth["alpha0"], 1.0, g=1.0)
    rising = truth["alpha0"] > 0
    for found, name in zip(launch.apex(), ("apex_x", "apex_y", "apex_t"), strict=True):
        assert off(found[rising], truth[name][rising]).max() <= 1e-13
        assert np.all(found[~rising] == 0)


def test_error_estimate_covers_the_error(truth, landing):
    true = np.maximum(off(landing.x, truth["x"]), off(landing.t, truth["t"]))
    assert np.all(landing.error >= true)
    assert landing.error.max() <= 1e-10  # a target within 1e-8 of its apex


@pytest.mark.slow
def test_a_sample_of_the_file_computed_again(truth, seed):
    rng = np.random.default_rng(seed)
    for i in rng.choice(truth["v_norm"].size, 60, replace=False):
        launch = [float(truth[name][i]) for name in points.INPUTS]
        flight = reference.flight(*launch, dps=40)
        for name in points.OUTPUTS:
            assert float(getattr(flight, name)) == pytest.approx(truth[name][i], rel=1e-15), launch


@pytest.mark.slow
def test_random_points_of_the_domain(seed):
    rng = np.random.default_rng(seed)
    for _ in range(150):
        v = 10 ** rng.uniform(-8, 8)
        gap = 10 ** rng.uniform(-14, 0.19)
        a = gap if rng.random() < 0.5 else np.pi / 2 - gap
        flight = reference.flight(v, a)
        landing = Launch(v, a, 1.0, g=1.0).landing()
        for name in ("x", "t", "speed", "alpha", "arc_length"):
            true = float(getattr(flight, name))
            assert getattr(landing, name) == pytest.approx(true, rel=1e-13), (v, a)


def blocks(size):
    return [slice(first, first + BLOCK) for first in range(0, size, BLOCK)]


@pytest.mark.slow
def test_a_million_random_launches():
    rng = np.random.default_rng(8)
    n = 1_000_000
    v = 10 ** rng.uniform(-8, 8, n)
    gap = 10 ** rng.uniform(-14, 0.19, n)
    alpha0 = np.where(rng.random(n) < 0.5, gap, np.pi / 2 - gap)
    steps = 0
    for block in blocks(n):
        flight = fly(
            v[block], alpha0[block], np.zeros_like(v[block]), np.full_like(v[block], 2.0), ()
        )
        assert np.all(flight.status == Status.CONVERGED)
        steps = max(steps, int(flight.down.steps.max()))
    assert steps <= 3  # the largest number seen, quoted in the docs


@pytest.mark.slow
def test_a_million_random_launches_with_landings_below():
    rng = np.random.default_rng(24)
    n = 1_000_000
    v = 10 ** rng.uniform(-8, 8, n)
    alpha0 = rng.uniform(-1.5707, np.pi / 2, n)
    alpha0[::2] *= 10 ** rng.uniform(-9, 0, n // 2)
    height = 10 ** rng.uniform(-12, 3, n)
    steps = 0
    for block in blocks(n):
        flight = fly(v[block], alpha0[block], height[block], np.full_like(v[block], 2.0), ())
        assert np.all(flight.status == Status.CONVERGED)
        steps = max(steps, int(flight.down.steps.max()))
    assert steps <= 12


def test_deep_fall_of_a_slow_downward_launch_gives_no_warning():
    landing = Launch(2.016e-06, -0.12956, 1.0, g=1.0, height=958.608253148003).landing()
    assert landing.success
    assert landing.speed == pytest.approx(1.0, rel=1e-15)


def flat_fire(v, alpha0):
    """d_norm where every slope is small: X (1 + z) = e^X - 1, z = 2 v^2 alpha0, d_norm = X / 2z."""
    with mpmath.workdps(50):
        z = 2 * mpmath.mpf(v) ** 2 * mpmath.mpf(alpha0)
        start = mpmath.log1p(2 * z) + mpmath.log1p(mpmath.log1p(z))
        return mpmath.findroot(lambda X: mpmath.log1p(X * (1 + z)) - X, start) / (2 * z)


@pytest.mark.parametrize("v", [1e8, 1e12, 1e16, 1e20])
@pytest.mark.parametrize("z", [1e-2, 1.0, 1e3, 2e10, 1e40])
def test_almost_level_launches_of_any_speed(v, z):
    alpha0 = min(z / 2 / v**2, 1e-12)
    truth = flat_fire(v, alpha0)
    assert float(abs(d_norm(v, alpha0) / truth - 1)) < 2e-15
    assert float(abs(reference.d_norm(v, alpha0, dps=30) / truth - 1)) < 1e-17


# --- every exponent, fast falls, targets under the apex ----------------------------------


def table(name):
    return points.load(DATA / name)


def of_each_n(truth):
    """Each exponent, and the rows that have it: a Launch takes one."""
    return [(float(n), truth["n"] == n) for n in np.unique(truth["n"])]


def landings(truth):
    """The fields of `Launch.landing` for every row of a table."""
    names = ("x", "t", "alpha", "speed", "arc_length", "error", "status")
    found = {name: np.empty(truth["v_norm"].size) for name in names}
    groups = of_each_n(truth) if "n" in truth else [(2.0, slice(None))]
    for n, at in groups:
        v, a, h = (truth[name][at] for name in points.INPUTS)
        landing = Launch(v, a, 1.0, g=1.0, height=h, n=n).landing()
        for name in names:
            found[name][at] = getattr(landing, name)
    return found


def conditions(truth):
    """Relative change of each field over that of the height and apex that a landing comes from.

    Along the path dy = sin(alpha) ds and d(alpha) = -cos(alpha) / v^2 ds, in units of v_lim.
    """
    x, t, alpha, speed, length = (
        truth[name] for name in ("x", "t", "alpha", "speed", "arc_length")
    )
    n = truth.get("n", 2.0)
    down = np.abs(np.sin(alpha))
    ds = (truth["apex_y"] + np.abs(truth["height"])) / down
    return {
        "x": ds * np.cos(alpha) / x,
        "t": ds / (speed * t),
        "alpha": ds * np.cos(alpha) / speed**2 / np.abs(alpha),
        "speed": ds * np.abs(down - np.minimum(speed, 1e30) ** n) / speed**2,
        "arc_length": ds / length,
    }


def row(truth, i):
    return {name: float(column[i]) for name, column in truth.items()}


def hold(truth, found, *, well=1e-13, note=""):
    """Every field to `well` and what the condition adds; the error estimate an upper one."""
    assert np.all(found["status"] == Status.CONVERGED)
    condition = conditions(truth)
    for name, factor in condition.items():
        error = off(found[name], truth[name])
        allowed = well + 4 * EPSILON * factor
        worst = np.argmax(error / allowed)
        assert error[worst] <= allowed[worst], (note, name, row(truth, worst))
    true = np.maximum(off(found["x"], truth["x"]), off(found["t"], truth["t"]))
    worst = np.argmax(true - found["error"])
    assert true[worst] <= found["error"][worst], (note, row(truth, worst))
    useful = 1e-12 + 100 * EPSILON * np.maximum(condition["x"], condition["t"])
    worst = np.argmax(found["error"] / useful)
    assert found["error"][worst] <= useful[worst], (note, row(truth, worst))


def hold_under_apex(truth, found, gap, *, note=""):
    """Targets `gap` under the apex: the answer, or the estimate, tells how much is known."""
    there = found["status"] == Status.CONVERGED
    # a few doubles under the apex, the answer may be that it is out of reach, but never a number
    near = gap <= 20 * EPSILON * truth["apex_y"]
    assert np.all(found["status"][~there] == Status.UNREACHABLE), note
    assert np.all(np.isnan(found["x"][~there])), note
    assert not np.any(~there & ~near), note
    truth = {name: column[there] for name, column in truth.items()}
    found, gap = {name: column[there] for name, column in found.items()}, gap[there]
    true = np.maximum(off(found["x"], truth["x"]), off(found["t"], truth["t"]))
    # a drop that is wrong by a part q of itself moves the landing by less than that of the fall
    q = np.minimum(EPSILON * truth["apex_y"] / gap, 1.0)
    moved = np.maximum(1 - truth["apex_x"] / truth["x"], 1 - truth["apex_t"] / truth["t"])
    part = q * np.maximum(moved, np.sqrt(EPSILON))
    power = truth["n"] * np.log1p(truth["v_norm"])  # v^n rounds with its exponent
    for less, more in (
        (true, found["error"]),
        (found["error"], 1e-12 + (100 + 4 * power) * part),
        (true, 1e-13 + 50 * part),
    ):
        worst = np.argmax(less / more)
        assert less[worst] <= more[worst], (note, row(truth, worst))


@pytest.mark.parametrize("number", range(2, len(points.TABLES) + 1))
def test_tables_hold_the_inputs_of_their_rules(number):
    made = points.TABLES[number - 1]
    truth = table(made.file)
    rows = np.array(list(made.rows()))
    assert list(truth) == [*made.inputs, *made.outputs]
    assert len(rows) >= (60 if made.solve.__name__ == "_slopes" else 96)
    read = np.column_stack([truth[name] for name in made.inputs])
    # the apex and the powers of ten may differ by a last bit on another machine
    np.testing.assert_allclose(rows, read, rtol=1e-15)


def test_every_exponent():
    truth = table("reference_power.csv")
    assert np.sum(truth["n"] != 2) >= 200
    hold(truth, landings(truth))


def test_apexes_of_every_exponent():
    truth = table("reference_power.csv")
    for n, at in of_each_n(truth):
        launch = Launch(truth["v_norm"][at], truth["alpha0"][at], 1.0, g=1.0, n=n)
        rising = truth["alpha0"][at] > 0
        for found, name in zip(launch.apex(), ("apex_x", "apex_y", "apex_t"), strict=True):
            assert off(found[rising], truth[name][at][rising]).max() <= 1e-13, (n, name)


def test_fast_level_and_downward_launches_from_a_height():
    truth = table("reference_fast.csv")
    hold(truth, landings(truth))


def test_targets_just_under_the_apex():
    truth = table("reference_apex.csv")
    hold_under_apex(truth, landings(truth), np.array([float(g) for g in _gaps(truth)]))


def _gaps(truth):
    """The fall from the apex, from all the digits in the file."""
    lines = (DATA / "reference_apex.csv").read_text().splitlines()[4:]
    with mpmath.workdps(40):
        tops = [mpmath.mpf(line.split(",")[-2]) for line in lines]
        return [top + mpmath.mpf(h) for top, h in zip(tops, truth["height"], strict=True)]


# --- points of paths ----------------------------------------------------------------------


def test_points_of_quadratic_paths_by_slope():
    truth = table("reference_points.csv")
    at = truth["n"] == 2
    v, a, alpha = (truth[name][at] for name in ("v_norm", "alpha0", "alpha"))
    for found, name in zip(position(v, a, alpha), ("x", "y", "t"), strict=True):
        # a point level with the launch has a height that is a difference
        high = position(v, np.maximum(a, 0), 0 * a).y if name == "y" else 0
        error = np.abs(found - truth[name][at])
        assert np.all(error <= 1e-13 * (np.abs(truth[name][at]) + high)), name


def test_apexes_among_the_points():
    truth = table("reference_points.csv")
    for n, same in of_each_n(truth):
        rows = same & (truth["alpha"] == 0)
        launch = Launch(truth["v_norm"][rows], truth["alpha0"][rows], 1.0, g=1.0, n=n)
        for found, name in zip(launch.apex(), ("x", "y", "t"), strict=True):
            assert off(found, truth[name][rows]).max() <= 1e-13


def test_points_of_the_fall_as_landings():
    """On a plane as low as the point, unless that is so near the apex that nothing is left."""
    truth = table("reference_points.csv")
    top = np.zeros(truth["n"].size)
    for n, same in of_each_n(truth):
        top[same] = Launch(truth["v_norm"][same], truth["alpha0"][same], 1.0, g=1.0, n=n).apex()[1]
    down = (truth["alpha"] < 0) & (top - truth["y"] > 1e-3 * top)
    assert np.sum(down) >= 60
    rows = {name: column[down] for name, column in truth.items()}
    rows["height"], rows["apex_y"] = -rows["y"], top[down]
    found = landings(rows)
    for name, factor in conditions(rows).items():
        error = off(found[name], rows[name])
        assert np.all(error <= 1e-13 + 4 * EPSILON * factor), name


def test_points_of_trajectories():
    """Points lie where they should along the path but for some 1e-9 of it: moved there."""
    truth = table("reference_paths.csv")
    rows = zip(*(truth[name] for name in ("n", *points.INPUTS, "part")), strict=True)
    for i, (n, v, a, h, part) in enumerate(rows):
        path = Launch(v, a, 1.0, g=1.0, height=h, n=n).trajectory(9)
        k = round(8 * part)
        x, y, t, alpha, speed, s = (
            float(truth[name][i]) for name in ("x", "y", "t", "alpha", "speed", "arc_length")
        )
        d = float(path.s[k]) - s
        assert abs(d) <= 1e-8 * s / part, (n, v, a, h, part)
        high = abs(y) + h + (0 if a <= 0 else float(path.y.max()))
        expected = {
            "x": (x + np.cos(alpha) * d, x),
            "y": (y + h + np.sin(alpha) * d, high),
            "t": (t + d / speed, t),
            "speed": (speed - (np.sin(alpha) + speed**n) / speed * d, speed),
        }
        for name, (value, size) in expected.items():
            error = abs(float(getattr(path, name)[k]) - value)
            bend = np.cos(alpha) / speed**2 + speed ** (n - 2) + 1 / speed**2
            assert error <= 1e-13 * abs(size) + 10 * (bend * d) ** 2 * (abs(size) + speed), (
                name,
                (n, v, a, h, part),
                error / abs(size),
            )


# --- derivatives --------------------------------------------------------------------------


def test_sensitivities():
    truth = table("reference_sensitivity.csv")
    v, a, h = (truth[name] for name in points.INPUTS)
    found = range_sensitivity(v, a, 1.0, g=1.0, height=h)
    assert off(found.range, truth["range"]).max() <= 1e-13
    for name in ("alpha0", "v0", "v_lim", "height"):
        error = np.abs(getattr(found, name) - truth[f"d_{name}"])
        # dR/dalpha0 passes through 0, and the others vanish for a landing just after the launch
        size = {"alpha0": 1.0, "v0": 0.1 / v, "v_lim": 0.1}.get(name, 0.0) * truth["range"]
        allowed = 1e-13 * (np.abs(truth[f"d_{name}"]) + size)
        worst = np.argmax(error / allowed)
        assert error[worst] <= allowed[worst], (name, [c[worst] for c in truth.values()])


@pytest.mark.slow
def test_a_sample_of_every_table_computed_again(seed):
    rng = np.random.default_rng(seed)
    for made in points.TABLES[1:]:
        rows = list(made.rows())
        lines = (DATA / made.file).read_text().splitlines()[4:]
        assert len(lines) == len(rows)
        for i in rng.choice(len(rows), 12, replace=False):
            found = made.solve(*rows[i])
            values = found if isinstance(found, dict) else vars(found)
            written = lines[i].split(",")[len(made.inputs) :]
            for name, digits in zip(made.outputs, written, strict=True):
                with mpmath.workdps(30):
                    assert abs(values[name] - mpmath.mpf(digits)) <= 1e-28 * abs(values[name])
