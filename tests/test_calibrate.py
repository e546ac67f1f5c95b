"""Tracks made by the equations of motion, and what `calibrate` finds in them."""

import copy
import dataclasses
import math
import pickle
import subprocess
import sys
import time
from typing import NamedTuple

import numpy as np
import pytest

import hodograph
from hodograph import Calibration, calibrate, ode

G = 9.81


class Track(NamedTuple):
    """Points of a path without noise, its length, and the launch at the first of them."""

    t: np.ndarray
    x: np.ndarray
    y: np.ndarray
    size: float
    launch: dict[str, float]


def track(v0=14.4, alpha0=0.76, k=0.012, points=60, part=(0.0, 1.0), n=2.0, height=0.0, g=G):
    """A part of a flight, in shares of its time."""
    v_lim = math.inf if k == 0 else (g / k) ** (1 / n)
    flight = ode.solve(v0, alpha0, v_lim, n=n, g=g, height=height, rtol=1e-12, atol=1e-14)
    t = flight.t * np.linspace(*part, points)
    x, y, vx, vy = flight.at(t)
    launch = {
        "v0": math.hypot(vx[0], vy[0]),
        "alpha0": math.atan2(vy[0], vx[0]),
        "k": k,
        "x0": x[0],
        "y0": y[0],
    }
    return Track(t, x, y, math.hypot(np.ptp(x), np.ptp(y)), launch)


def noisy(made, sigma, seed=1):
    x, y = (
        row + sigma * noise
        for row, noise in zip(
            (made.x, made.y),
            np.random.default_rng(seed).standard_normal((2, made.x.size)),
            strict=True,
        )
    )
    return x, y


def near(found, launch, rtol=1e-6, **changed):
    for name, value in (launch | changed).items():
        assert getattr(found, name) == pytest.approx(value, rel=rtol, abs=rtol), name


# --- without noise ------------------------------------------------------------------------

KINDS = {
    "level ground": {},
    "slow": {"v0": 4.0, "k": 0.002},
    "fast": {"v0": 60.0, "alpha0": 0.3, "k": 0.05},
    "steep and fast": {"v0": 60.0, "alpha0": 1.4, "k": 0.05},
    "from above": {"alpha0": 0.2, "height": 20.0},
    "level, from above": {"alpha0": 0.0, "height": 20.0},
    "downward": {"alpha0": -0.5, "height": 30.0, "k": 0.03},
    "vacuum": {"k": 0.0},
    "rising only": {"part": (0.0, 0.4)},
    "falling only": {"part": (0.6, 1.0)},
    "in the middle": {"part": (0.3, 0.7), "k": 0.03},
    "few": {"points": 8},
    "on the moon": {"g": 1.62},
}


@pytest.mark.parametrize("kind", KINDS)
def test_the_launch_comes_back(kind):
    made = track(**KINDS[kind])
    g = KINDS[kind].get("g", G)
    found = calibrate(made.x, made.y, made.t, g=g)
    near(found, made.launch)
    assert found.success
    assert found.rms < 1e-9 * made.size
    assert found.t0 == made.t[0]
    assert found.g_track == pytest.approx(g, rel=1e-5)
    shape = calibrate(made.x, made.y, g=g)
    near(shape, made.launch, rtol=2e-6)
    assert shape.t0 is None
    assert np.isnan(shape.g_track)


@pytest.mark.parametrize("alpha0", [math.pi / 2, -math.pi / 2])
def test_vertical(alpha0):
    made = track(10.0, alpha0, 0.05, height=12.0)
    found = calibrate(made.x, made.y, made.t)
    near(found, made.launch, rtol=1e-5, x0=0.0)
    with pytest.raises(ValueError, match="x must not be the same for all points: give t"):
        calibrate(0 * made.x, made.y)


def test_dropped():
    """A launch from rest, whose elevation nothing tells."""
    made = track(0.0, -math.pi / 2, 0.3, height=4.0)
    x, y = noisy(made, 0.004)
    found = calibrate(x, y, made.t)
    assert abs(found.k - 0.3) < 3 * found.uncertainty["k"] < 0.006
    held = calibrate(x, y, made.t, fixed={"v0": 0.0, "alpha0": -math.pi / 2})
    assert abs(held.k - 0.3) < 3 * held.uncertainty["k"] < 3 * found.uncertainty["k"]
    downward = calibrate(x, y, made.t, fixed={"alpha0": -math.pi / 2})
    assert downward.v0 >= 0


@pytest.mark.parametrize("n", [1.0, 1.5, 3.0])
def test_other_exponents(n):
    v0, v_lim = 14.4, 12.0
    made = track(v0, 0.76, G / v_lim**n, n=n)
    near(calibrate(made.x, made.y, made.t, n=n), made.launch, v_lim=v_lim)
    near(calibrate(made.x, made.y, made.t, n=None), made.launch, n=n, rtol=1e-5)
    near(calibrate(made.x, made.y, n=n), made.launch, rtol=2e-6)


def test_no_drag_that_can_be_told():
    """A ball in vacuum, filmed coarsely: k = 0 ± u, and v_lim from below."""
    made = track(8.0, 0.9, 0.0, points=20)
    for seed in range(12):
        found = calibrate(*noisy(made, 0.02, seed), made.t)
        assert 0 <= found.k < 4 * found.uncertainty["k"]
        assert 8 < found.v_lim_low < 60
        if found.k < 2 * found.uncertainty["k"]:
            assert math.isinf(found.uncertainty["v_lim"])
        assert found.profile("v_lim", level=0.95)[1] == math.inf or found.k > 0


# --- rows, directions, units --------------------------------------------------------------


def test_rows_in_any_order_and_with_gaps():
    made = track()
    x, y = noisy(made, 0.02)
    found = calibrate(x, y, made.t)
    order = np.random.default_rng(3).permutation(x.size)
    shuffled = calibrate(x[order], y[order], made.t[order])
    near(shuffled, {name: getattr(found, name) for name in made.launch})
    np.testing.assert_allclose(shuffled.residuals, found.residuals[order], atol=1e-9)
    shape = calibrate(x, y)
    near(calibrate(x[order], y[order]), {name: getattr(shape, name) for name in made.launch})
    gaps = np.concatenate([x, [np.nan, 1.0]]), np.concatenate([y, [1.0, 2.0]])
    with_gaps = calibrate(*gaps, np.concatenate([made.t, [0.1, np.nan]]))
    near(with_gaps, {name: getattr(found, name) for name in made.launch})
    assert with_gaps.points == x.size
    assert np.isnan(with_gaps.residuals[-2:]).all()
    assert not np.isnan(with_gaps.residuals[:-2]).any()


def test_to_the_left():
    made = track()
    x, y = noisy(made, 0.02)
    for times in ((made.t,), ()):
        right, left = calibrate(x, y, *times), calibrate(-x, y, *times)
        assert (right.heading, left.heading) == (1, -1)
        for name in ("k", "v0", "alpha0", "y0"):
            assert getattr(left, name) == pytest.approx(getattr(right, name), rel=1e-7)
        assert left.x0 == pytest.approx(-right.x0)
        np.testing.assert_allclose(left.residuals, right.residuals * [-1, 1], atol=1e-9)
        assert left.uncertainty == pytest.approx(right.uncertainty, rel=1e-6)
    held = calibrate(-x, y, made.t, fixed={"x0": -0.1})
    assert held.x0 == -0.1
    bounded = calibrate(-x, y, made.t, bounds={"x0": (-0.3, -0.2)})
    assert bounded.x0 == pytest.approx(-0.2, abs=1e-3)


@pytest.mark.parametrize(
    ("scale", "words"),
    [
        ((1, -1, 1), "bends upwards: is y measured downwards"),
        ((100, 100, 1), r"falls at 9\d\d m/s\^2.*\(are x and y in cm\?\)"),
        ((1000, 1000, 1), r"\(are x and y in mm\?\)"),
        ((1 / 0.3048, 1 / 0.3048, 1), r"\(are x and y in feet\?\)"),
        ((431, 431, 1), r"\(pixels, or a wrong frame rate\?\)"),
        ((1, 1, 29.97), "falls at 0.01"),
    ],
)
def test_what_cannot_be_metres_and_seconds(scale, words):
    made = track(k=0.03)
    x, y = noisy(made, 0.01)
    with pytest.raises(ValueError, match=words) as caught:
        calibrate(scale[0] * x, scale[1] * y, scale[2] * made.t)
    assert "\n" not in str(caught.value)


def test_numbers_of_frames_are_known():
    made = track()
    with pytest.raises(ValueError, match="are t numbers of frames"):
        calibrate(made.x, made.y, np.arange(made.t.size))


def test_y_down_without_times():
    made = track()
    with pytest.raises(ValueError, match="is y measured downwards"):
        calibrate(made.x, -made.y)


@pytest.mark.parametrize("scale", [0.9, 1.05])
def test_a_wrong_scale_is_said(scale):
    made = track()
    x, y = noisy(made, 0.02)
    with pytest.warns(UserWarning, match="as if lengths were"):
        found = calibrate(scale * x, scale * y, made.t)
    assert found.g_track == pytest.approx(scale * G, rel=0.02)
    right = calibrate(x, y, made.t)
    assert abs(right.g_track - G) < 4 * right.uncertainty["g_track"]


@pytest.mark.parametrize("timed", [True, False])
def test_a_flight_in_reverse_is_said(timed):
    made = track(height=1.0)
    x, y = noisy(made, 0.01)
    t, rows = (made.t.max() - made.t, slice(None)) if timed else (None, slice(None, None, -1))
    with pytest.warns(UserWarning, match="gains speed, as by k = -0.01.* reverse"):
        found = calibrate(x[rows], y[rows], t)
    assert found.k == 0
    made = track(k=0.0)
    for x, y in ((made.x, made.y), noisy(made, 0.01, 3), noisy(made, 0.01, 4)):
        calibrate(x, y, made.t if timed else None)  # and here nothing is


def test_a_fall_upwards_by_what_is_held():
    made = track()
    with pytest.warns(UserWarning, match="falls with g = -") as caught:
        calibrate(made.x, made.y, made.t, fixed={"alpha0": -0.5})
    assert any("with what is held; or drag" in str(each.message) for each in caught)
    assert not any("j" in str(each.message) for each in caught)


# --- held, bounded, robust ----------------------------------------------------------------


def test_held():
    made = track()
    x, y = noisy(made, 0.02)
    free = calibrate(x, y, made.t)
    held = calibrate(x, y, made.t, fixed={"v0": 14.4, "v_lim": math.sqrt(G / 0.012)})
    assert held.v0 == 14.4
    assert held.k == pytest.approx(0.012)
    assert held.fitted == ("alpha0", "x0", "y0")
    assert held.uncertainty["alpha0"] < free.uncertainty["alpha0"]
    everything = {**made.launch, "t0": 0.0}
    none = calibrate(x, y, made.t, fixed=everything)
    assert none.fitted == ()
    assert none.rms == pytest.approx(0.02 * math.sqrt(2), rel=0.2)


def test_the_launch_is_where_it_is_said_to_be():
    """Away from the first point: at a time, a place, or a height."""
    whole = track()
    later = track(part=(0.3, 1.0))
    for fixed in ({"t0": 0.0}, {"y0": 0.0}, {"x0": 0.0}, {"x0": 0.0, "y0": 0.0}):
        found = calibrate(later.x, later.y, later.t, fixed=fixed)
        near(found, whole.launch, rtol=1e-5, t0=0.0)
    for fixed in ({"y0": 0.0}, {"x0": 0.0}, {"x0": 0.0, "y0": 0.0}):
        near(calibrate(later.x, later.y, fixed=fixed), whole.launch, rtol=1e-5)
    found = calibrate(later.x, later.y, later.t, fixed={"x0": 0.0}, bounds={"t0": (-0.5, 0.5)})
    near(found, whole.launch, rtol=1e-5, t0=0.0)


def test_bounded():
    made = track()
    x, y = noisy(made, 0.02)
    free = calibrate(x, y, made.t)
    assert calibrate(x, y, made.t, bounds={"k": (0.0, 0.011)}).k == pytest.approx(0.011, rel=1e-3)
    near(calibrate(x, y, made.t, bounds={"k": (0.0, 0.1)}), {"k": free.k, "v0": free.v0})
    vacuum = track(8.0, 0.9, 0.0, points=20)
    signed = [
        calibrate(*noisy(vacuum, 0.02, seed), vacuum.t, bounds={"k": (-math.inf, math.inf)})
        for seed in range(40)
    ]
    pulls = [each.k / each.uncertainty["k"] for each in signed]
    assert min(pulls) < -0.3
    assert abs(np.mean(pulls)) < 3 / math.sqrt(40)
    assert math.isinf(min(signed, key=lambda each: each.k).v_lim)


@pytest.mark.parametrize("loss", ["soft_l1", "huber", "cauchy", "arctan"])
def test_outliers(loss):
    made = track()
    x, y = noisy(made, 0.02)
    clean = calibrate(x, y, made.t)
    x[[7, 30, 44]] += [0.5, -1.0, 2.0]
    y[[12, 50]] -= 1.0
    misled, found = calibrate(x, y, made.t), calibrate(x, y, made.t, loss=loss)
    known = calibrate(x, y, made.t, loss=loss, sigma=0.02)
    for each in (found, known):
        assert abs(each.k - clean.k) < 2.5 * clean.uncertainty["k"]
        assert each.uncertainty["k"] < 2.5 * clean.uncertainty["k"]
    assert misled.uncertainty["k"] > 5 * clean.uncertainty["k"]
    assert found.sigma == pytest.approx(0.02, rel=0.35)
    without = calibrate(*noisy(made, 0.02), made.t, loss=loss)
    assert without.uncertainty["k"] == pytest.approx(clean.uncertainty["k"], rel=0.35)


# --- what is known of it ------------------------------------------------------------------


def test_the_uncertainty_is_that_of_least_squares():
    """By differences of the oracle: cov = sigma^2 (J' J)^-1."""
    made, sigma = track(), 0.02
    x, y = noisy(made, sigma)
    found = calibrate(x, y, made.t, sigma=sigma)
    at = {name: getattr(found, name) for name in ("v0", "alpha0", "k")}

    def path(**changed):
        a = at | changed
        flight = ode.solve(
            a["v0"], a["alpha0"], math.sqrt(G / a["k"]), height=5.0, rtol=1e-12, atol=1e-14
        )
        return np.concatenate(flight.at(made.t)[:2])

    columns = []
    for name, value in at.items():
        step = 1e-4 * value
        columns.append((path(**{name: value + step}) - path(**{name: value - step})) / (2 * step))
    one = np.ones_like(made.t)
    columns += [np.concatenate([one, 0 * one]), np.concatenate([0 * one, one])]
    J = np.stack(columns, axis=1)
    assert found.fitted == ("v0", "alpha0", "k", "x0", "y0")
    np.testing.assert_allclose(found.covariance, sigma**2 * np.linalg.inv(J.T @ J), rtol=1e-5)
    for name, variance in zip(found.fitted, np.diag(found.covariance), strict=True):
        assert found.uncertainty[name] == pytest.approx(math.sqrt(variance))
    misses = np.array([x, y]).T - (path().reshape(2, -1) - [[0], [5.0]]).T - [found.x0, found.y0]
    np.testing.assert_allclose(found.residuals, misses, atol=1e-9)
    assert found.rms == pytest.approx(math.sqrt(np.sum(misses**2) / 60))
    assert found.dof == 115
    assert found.chi2_reduced == pytest.approx(np.sum(misses**2) / sigma**2 / 115)
    assert found.sigma == pytest.approx(math.sqrt(found.chi2_reduced))
    assert found.aic == pytest.approx(np.sum(misses**2) / sigma**2 + 10)
    relative = found.uncertainty["k"] / found.k
    assert found.uncertainty["v_lim"] == pytest.approx(found.v_lim * relative / 2)
    assert found.v_lim == pytest.approx(math.sqrt(G / found.k))
    low = math.sqrt(G / (found.k + 2 * found.uncertainty["k"]))
    assert found.v_lim_low == pytest.approx(low)


def test_noise_that_is_found():
    """Student's t widens the interval; only the ratio of the two sigmas counts."""
    made = track(points=8)
    x, y = noisy(made, 0.02)
    known, found = calibrate(x, y, made.t, sigma=0.02), calibrate(x, y, made.t)
    assert np.isnan(found.chi2_reduced)
    student = 1.0476  # for 11 degrees of freedom: the tables' 68.27 % point
    expected = known.uncertainty["k"] * found.sigma / 0.02 * student
    assert found.uncertainty["k"] == pytest.approx(expected, rel=1e-3)
    ratio = calibrate(x, y, made.t, sigma=7.0, absolute_sigma=False)
    assert ratio.uncertainty == pytest.approx(found.uncertainty, rel=1e-6)
    pair = calibrate(x, y, made.t, sigma=(0.01, 0.04))
    each = calibrate(x, y, made.t, sigma=(np.full(8, 0.01), np.full(8, 0.04)))
    assert pair == each
    assert pair.k != known.k


def test_profile():
    made = track()
    found = calibrate(*noisy(made, 0.02), made.t, mass=0.43, diameter=0.22)
    for name in found.fitted:  # nearly linear, so nearly symmetric
        low, high = found.profile(name)
        value, u = getattr(found, name), found.uncertainty[name]
        assert (value - low, high - value) == pytest.approx((u, u), rel=0.03)
    low, high = found.profile("v_lim", level=0.95)
    below, above = found.profile(level=0.95)
    assert (low, high) == pytest.approx((math.sqrt(G / above), math.sqrt(G / below)))
    assert above - below == pytest.approx(2 * 1.98 * found.uncertainty["k"], rel=0.03)
    coarse = calibrate(*noisy(track(5.0, 1.0, 0.02, points=10), 0.03), track(5.0, 1.0, 0.02, 10).t)
    low, high = coarse.profile(level=0.95)
    assert low == 0 < high
    assert coarse.profile("v_lim", level=0.95).high == math.inf
    left = calibrate(-made.x + 0.01 * np.cos(np.arange(60)), made.y, made.t)
    low, high = left.profile("x0")
    assert low < left.x0 < high


def test_cd():
    made = track()
    found = calibrate(*noisy(made, 0.02), made.t, mass=0.43, diameter=0.22, rho=1.2)
    per_k = 2 * 0.43 / (1.2 * math.pi / 4 * 0.22**2)
    assert found.cd == pytest.approx(per_k * found.k)
    assert found.uncertainty["cd"] == pytest.approx(per_k * found.uncertainty["k"])
    assert calibrate(made.x, made.y, made.t).cd is None


def test_as_a_value():
    made = track()
    x, y = noisy(made, 0.02)
    found = calibrate(x, y, made.t)
    assert type(found.k) is float
    assert found == calibrate(x, y, made.t)
    assert found != calibrate(x, y)
    assert found != 1
    for other in (copy.deepcopy(found), pickle.loads(pickle.dumps(found))):
        assert other == found
        assert other.profile() == found.profile()
    plain = found.to_dict()
    assert plain["uncertainty"]["k"] == found.uncertainty["k"]
    assert plain["fitted"] == list(found.fitted)
    text = repr(found)
    assert text.startswith("Calibration(k=0.01")
    assert "±" in text
    assert "\n" not in text
    state = found.launch.at(t=made.t - found.t0)
    np.testing.assert_allclose(state.x + found.x0, x - found.residuals[:, 0], atol=1e-9)
    np.testing.assert_allclose(state.y, y - found.residuals[:, 1], atol=1e-9)


def test_compared_field_by_field():
    """Words, None and dicts too; NaN is equal to NaN, and 0 to -0."""
    made = track()
    found = calibrate(*noisy(made, 0.02), made.t)
    off = found.uncertainty | {"g_track": math.nan}
    with_nan = [dataclasses.replace(found, uncertainty=dict(off)) for _ in range(2)]
    assert with_nan[0] == with_nan[1]
    assert dataclasses.replace(found, x0=0.0) == dataclasses.replace(found, x0=-0.0)
    for other in (
        with_nan[0],
        dataclasses.replace(found, uncertainty={}),
        dataclasses.replace(found, fitted=("k",)),
        dataclasses.replace(found, t0=None),
        dataclasses.replace(found, cd=0.2),
        dataclasses.replace(found, residuals=found.residuals[1:]),
    ):
        assert other != found
        assert (found == other) is False


def test_the_name_is_the_function():
    """Whatever is imported first, as a module too."""
    lines = (
        "import hodograph.calibrate, hodograph",
        "assert hodograph.calibrate.__name__ == 'calibrate' and callable(hodograph.calibrate)",
        "from hodograph import calibrate",
        "from hodograph.calibrate import Calibration, calibrate as same",
        "assert calibrate is same is hodograph.calibrate and Calibration is hodograph.Calibration",
    )
    for order in (lines, lines[2:3] + lines[:2], lines[3:4] + lines):
        subprocess.run([sys.executable, "-c", "\n".join(order)], check=True)
    assert Calibration.__module__ == "hodograph.calibrate"
    assert hodograph.calibrate is calibrate


# --- how often it holds the truth ---------------------------------------------------------

FILMS = [  # v0, alpha0, v_norm, points, part, noise as a share of the size
    (6.0, 0.6, 0.1, 30, (0.0, 1.0), 0.001),
    (12.0, 1.0, 0.1, 300, (0.0, 1.0), 0.003),
    (10.0, 0.5, 0.3, 12, (0.0, 1.0), 0.001),
    (25.0, 0.9, 0.3, 100, (0.1, 0.8), 0.002),
    (15.0, 0.7, 0.5, 8, (0.0, 1.0), 0.001),
    (15.0, 1.3, 0.5, 40, (0.0, 1.0), 0.004),
    (40.0, 0.4, 1.0, 20, (0.2, 1.0), 0.001),
    (40.0, 0.8, 1.0, 60, (0.0, 0.5), 0.001),
    (30.0, 1.0, 1.5, 150, (0.5, 1.0), 0.001),
    (30.0, 0.2, 1.5, 25, (0.0, 1.0), 0.003),
    (60.0, 0.8, 2.5, 30, (0.0, 1.0), 0.005),
    (60.0, 1.2, 2.5, 8, (0.0, 1.0), 0.002),
    (90.0, 0.5, 5.0, 50, (0.0, 1.0), 0.003),
    (90.0, 0.9, 5.0, 200, (0.0, 0.6), 0.004),
]
SIGNED = {"k": (-math.inf, math.inf)}


def pulls(films, *, times=True, known=False, bounds=None, n=None):
    """By how many of their uncertainties the parameters are off, film by film."""
    found = []
    for case, (v0, alpha0, v_norm, points, part, share) in enumerate(FILMS):
        made = track(v0, alpha0, G * v_norm**2 / v0**2, points, part)
        sigma = share * made.size
        options = {"bounds": bounds or SIGNED}
        if not times:
            options |= {"sigma": (sigma, sigma), "absolute_sigma": known}
            options["fixed"] = {"x0": made.launch["x0"]}
        elif known:
            options["sigma"] = sigma
        for film in range(films):
            x, y = noisy(made, sigma, seed=1000 * case + film)
            one = calibrate(x, y, *((made.t,) if times else ()), **options)
            names = ("v0", "alpha0", "k", "y0")
            found.append(
                [(getattr(one, name) - made.launch[name]) / one.uncertainty[name] for name in names]
            )
    return np.array(found)


WAYS = {
    "in time": {},
    "in time, known noise": {"known": True},
    "curve": {"times": False},
    "curve, known noise": {"times": False, "known": True},
}


@pytest.mark.parametrize("way", WAYS)
def test_the_interval_holds_the_truth(way):
    """Some hundred films; the promise to the percent is held by the slow test."""
    off = pulls(12, **WAYS[way])
    room = 4 * 0.5 / math.sqrt(len(off))  # four standard deviations of a share
    assert np.mean(np.abs(off) < 1, axis=0) == pytest.approx(0.6827, abs=room)
    assert np.mean(np.abs(off) < 2, axis=0) == pytest.approx(0.9545, abs=room / 2)
    assert np.abs(off.mean(axis=0)).max() < 4 / math.sqrt(len(off))


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_the_promise_of_the_uncertainty(way):
    """68 ± 3 %, 95 ± 2 %, and no bias above 0.1 sigma, of a thousand films and more each."""
    off = pulls(100 if "time" in way else 70, **WAYS[way])
    assert np.mean(np.abs(off) < 1, axis=0) == pytest.approx(0.68, abs=0.03)
    assert np.mean(np.abs(off) < 2, axis=0) == pytest.approx(0.95, abs=0.02)
    assert np.abs(off.mean(axis=0)).max() < 0.1


def test_the_bound_at_no_drag_only_adds_to_it():
    """With k at least 0, as by default, an interval holds the truth no less often."""
    made = track(6.0, 0.6, 0.001, 20)
    held = []
    for seed in range(100):
        one = calibrate(*noisy(made, 0.005 * made.size, seed), made.t)
        assert one.k >= 0
        held.append(abs(one.k - 0.001) < one.uncertainty["k"])
    assert np.mean(held) > 0.75


# --- refusals -----------------------------------------------------------------------------

MADE = track()
REFUSED = {
    "x must be real numbers": (TypeError, {"x": MADE.x > 1}),
    "must be of one length": (ValueError, {"x": MADE.x[1:]}),
    r"got x \(2, 30\)": (ValueError, {"x": MADE.x.reshape(2, -1)}),
    r"x must be in \[-1e30, 1e30\] m": (ValueError, {"x": np.append(MADE.x[1:], np.inf)}),
    "at least 3 points; got 0 without NaN": (ValueError, {"y": MADE.y * np.nan}),
    "t must not be the same": (ValueError, {"t": 0 * MADE.t}),
    "sigma must be > 0": (ValueError, {"sigma": 0.0}),
    r"one a point; got shape \(3,\)": (ValueError, {"sigma": [1.0, 2.0, 3.0]}),
    "n must be in": (ValueError, {"n": 0.5}),
    "g must be in": (ValueError, {"g": -9.81}),
    "fixed has no 'speed'; it may hold v0": (ValueError, {"fixed": {"speed": 3.0}}),
    "n is an argument": (ValueError, {"fixed": {"n": 2.0}}),
    "if these are degrees: np.deg2rad": (ValueError, {"fixed": {"alpha0": 43.0}}),
    "needs a given n": (ValueError, {"fixed": {"v_lim": 20.0}, "n": None}),
    "bounds has 'k', which is not fitted": (
        ValueError,
        {"fixed": {"k": 0.0}, "bounds": {"k": (0, 1)}},
    ),
    r"must be \(least, greatest\)": (ValueError, {"bounds": {"k": (1, 0)}}),
    "loss must be one of linear, soft_l1": (ValueError, {"loss": "l1"}),
    "give exactly one of diameter": (TypeError, {"mass": 0.43}),
    "cd needs mass": (TypeError, {"diameter": 0.22}),
    "cd belongs to n = 2": (ValueError, {"mass": 0.43, "diameter": 0.22, "n": 1}),
    "mass must be one number": (TypeError, {"mass": [0.43, 0.44], "diameter": 0.22}),
    "rho must be finite and > 0": (ValueError, {"mass": 0.43, "diameter": 0.22, "rho": 0}),
    "x and y must not be the same": (ValueError, {"x": 0 * MADE.x, "y": 0 * MADE.y}),
    "fixed must be a dict": (TypeError, {"fixed": ["k"]}),
    "bounds must be a dict": (TypeError, {"bounds": [(0, 1)]}),
    r"fixed has 't0'.*give t": (ValueError, {"fixed": {"t0": 0.0}, "t": None}),
    r"bounds has 't0'.*give t": (ValueError, {"bounds": {"t0": (0, 1)}, "t": None}),
    "which is not fitted .n=None fits it": (ValueError, {"bounds": {"n": (1, 3)}}),
    "bound k, which is": (ValueError, {"bounds": {"v_lim": (20, 30)}}),
    r"bounds\['n'\] must be within": (ValueError, {"bounds": {"n": (11, 12)}, "n": None}),
    r"bounds\['alpha0'\].*np.deg2rad": (ValueError, {"bounds": {"alpha0": (40, 50)}}),
    r"bounds\['v0'\].*the latter > 0": (ValueError, {"bounds": {"v0": (-9, -1)}}),
    "a tuple of two": (ValueError, {"sigma": np.array([0.01, 0.02])}),
}


@pytest.mark.parametrize("words", REFUSED)
def test_refused(words):
    error, changed = REFUSED[words]
    with pytest.raises(error, match=words) as caught:
        calibrate(**({"x": MADE.x, "y": MADE.y, "t": MADE.t} | changed))
    assert "\n" not in str(caught.value)


def test_too_little_is_refused():
    with pytest.raises(ValueError, match="4 points are too few to fit v0, alpha0, k, y0: hold"):
        calibrate(MADE.x[::15], MADE.y[::15])
    straight = np.linspace(0.0, 1.0, 20)
    with pytest.raises(ValueError, match="does not determine"):
        calibrate(straight, -straight)
    found = calibrate(MADE.x, MADE.y, MADE.t)
    for name, level, words in (
        ("x", 0.5, "name must be one of v0, alpha0, k"),
        ("k", 1.5, r"level must be in \(0, 1\)"),
    ):
        with pytest.raises(ValueError, match=words):
            found.profile(name, level=level)
    with pytest.raises(ValueError, match="profile needs loss='linear'"):
        calibrate(MADE.x, MADE.y, MADE.t, loss="huber").profile()


def test_a_film_takes_milliseconds():
    made = track(points=100)
    x, y = noisy(made, 0.02)
    taken = []
    for _ in range(15):
        start = time.perf_counter()
        calibrate(x, y, made.t)
        taken.append(time.perf_counter() - start)
    assert min(taken) < 0.05  # some 6 ms, by a machine that has nothing else to do
