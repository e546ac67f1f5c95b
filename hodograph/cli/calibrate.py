"""The command ``calibrate``: drag out of a file with a track, as a table, JSON and a figure."""

from __future__ import annotations

import argparse
import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hodograph.cli.arguments import Parser
from hodograph.cli.options import PLOTS, not_negative, positive
from hodograph.cli.plot import rendered
from hodograph.cli.show import digits
from hodograph.cli.streams import FailedError, UsageError, put, say
from hodograph.cli.units import number, numbers
from hodograph.engine.record import rounded

if TYPE_CHECKING:
    from hodograph.calibrate import Calibration
    from hodograph.cli.track_file import Track

HELD = {
    "v0": "m/s",
    "alpha0": "degrees",
    "k": "1/m",
    "v_lim": "m/s",
    "x0": "m",
    "y0": "m",
    "t0": "s",
}
LOSSES = ("linear", "soft_l1", "huber", "cauchy", "arctan")


def add_calibrate(to: Parser) -> None:
    """The file, what is known of the film and of the body, and what is wanted of them."""
    to.add_argument("track", metavar="FILE", type=Path, help="CSV, or a text export of Tracker")
    _add_film(to)
    _add_fit(to)
    _add_body(to)
    to.add_argument("--json", action="store_true", help="print JSON")
    to.add_argument(
        "--out", metavar="FILE", type=Path, help="path and residuals as a plot: .pdf, .png, .svg"
    )
    to.add_argument("--force", action="store_true", help="replace an existing file")


def _add_positive(to: Any, *options: tuple[str, str, str]) -> None:
    """Numbers that are > 0, each by name, unit and words."""
    for name, unit, words in options:
        to.add_argument(
            f"--{name}",
            metavar=name[0].upper(),
            type=number("finite and > 0", unit, positive),
            help=words,
        )


def _add_film(to: Parser) -> None:
    film = to.add_argument_group("the file")
    film.add_argument("--columns", metavar="T,X,Y", help="names or numbers, or X,Y")
    _add_positive(
        film,
        ("scale", "m", "length of one unit of the file, m: of a pixel, say"),
        ("fps", "", "how many units of its time are a second, where it counts frames"),
    )
    film.add_argument("--y-down", action="store_true", help="y is measured downwards")
    film.add_argument("--curve", action="store_true", help="fit y(x), without the times")


def _add_fit(to: Parser) -> None:
    fit = to.add_argument_group("the fit")
    fit.add_argument(
        "--n", metavar="POWER", type=_power, default=2.0, help="of the drag (default 2), or free"
    )
    _add_positive(fit, ("g", "m/s^2", "gravity, m/s^2 (default 9.81)"))
    fit.add_argument(
        "--sigma",
        metavar="S",
        type=numbers("finite and >= 0", "m", not_negative),
        help="noise of the positions, m, or of x,y (default: found from the residuals)",
    )
    fit.add_argument(
        "--fix",
        metavar="NAME=VALUE",
        action="append",
        type=_held,
        default=[],
        help=f"a parameter to be held, {', '.join(HELD)} (alpha0 in degrees); more than once",
    )
    fit.add_argument("--loss", choices=LOSSES, default="linear", help="against outliers: soft_l1")


def _add_body(to: Parser) -> None:
    body = to.add_argument_group("the body, for Cd")
    _add_positive(
        body,
        ("mass", "kg", "mass, kg, or with its unit: 430g"),
        ("diameter", "m", "diameter, m, or with its unit: 22cm"),
        ("area", "m^2", "area that Cd is to refer to, m^2"),
        ("rho", "kg/m^3", "density of the air, kg/m^3 (default 1.225)"),
    )
    body.add_argument(
        "--cd-only", action="store_true", help="print Cd and its uncertainty, and nothing else"
    )


def _power(text: str) -> float | None:
    convert: Callable[[str], float] = number("in [1, 10], or free", "", lambda n: 1 <= n <= 10)
    return None if text.strip().lower() == "free" else convert(text)


_RANGES: dict[str, tuple[str, Callable[[float], bool]]] = {
    "v0": ("finite and >= 0", not_negative),
    "alpha0": ("in [-90, 90] degrees", lambda v: abs(v) <= 90),
    "k": ("finite and >= 0", not_negative),
    "v_lim": ("> 0 (inf is no drag)", lambda v: v > 0),
}


def _held(text: str) -> tuple[str, float]:
    name, equals, value = text.partition("=")
    name = name.strip().replace("-", "_")
    if not equals or name not in HELD:
        known = ", ".join(HELD)
        raise argparse.ArgumentTypeError(f"must be NAME=VALUE, with NAME of {known}; got {text!r}")
    words, holds = _RANGES.get(name, ("finite", math.isfinite))
    found = number(words, HELD[name], holds)(value)
    return name, math.radians(found) if name == "alpha0" else found


def calibrate(args: argparse.Namespace) -> None:
    """Read, fit, and show."""
    from hodograph.cli import track_file

    if args.cd_only and args.mass is None:
        raise UsageError("argument --cd-only: needs --mass, and --diameter or --area")
    if args.out is not None:
        _check_out(args)
    track = track_file.read(args.track, args.columns, args.scale, args.fps, times=not args.curve)
    if args.y_down:
        track = track._replace(y=-track.y)
    _tell(args, track)
    found = _fitted(args, track)
    if args.out is not None:
        from hodograph._files import write_whole

        form = args.out.suffix.lower()[1:]
        say(f"wrote {write_whole(args.out, _figure(found, track, form), force=args.force)}")
    if args.cd_only and found.cd is not None:
        put(" ".join(_pair(found.cd, found.uncertainty.get("cd"))) + "\n")
    elif args.json:
        put(json.dumps(_plain(found)) + "\n")
    else:
        put(_table(found))
    if not found.success:
        raise FailedError("the fit has not converged")


def _fitted(args: argparse.Namespace, track: Track) -> Calibration:
    from hodograph.calibrate import calibrate

    names = ("g", "mass", "diameter", "area", "rho")
    given = {name: value for name in names if (value := getattr(args, name)) is not None}
    if args.sigma is not None:
        given["sigma"] = args.sigma if len(args.sigma) > 1 else args.sigma[0]
    held = dict(args.fix)
    try:
        return calibrate(track.x, track.y, track.t, n=args.n, fixed=held, loss=args.loss, **given)
    except TypeError as error:  # of the body, half of which is missing
        raise UsageError(str(error)) from None
    except ValueError as error:
        raise FailedError(f"{args.track}: {_by_options(str(error), y_down=args.y_down)}") from None


def _by_options(words: str, *, y_down: bool) -> str:
    """What the library says of its arguments, said of the options."""
    words = re.sub(r"fixed=\{'(\w+)': \.\.\.\}", r"--fix \1=...", words)
    words = re.sub(r"fixed\['(\w+)'\]", r"--fix \1", words)
    return (
        words.replace("(fixed=...)", "(--fix NAME=VALUE)")
        .replace("fixed has", "--fix has")
        .replace("give it, as n=2", "give it, as --n 2")
        .replace("(y=-y)", "(leave --y-down out)" if y_down else "(--y-down turns it)")
    )


def _check_out(args: argparse.Namespace) -> None:
    from hodograph._files import check_targets

    if args.out.suffix.lower() not in PLOTS:
        raise UsageError(f"argument --out: must end in {', '.join(PLOTS)}; got {str(args.out)!r}")
    check_targets(args.out, force=args.force)


def _tell(args: argparse.Namespace, track: Track) -> None:
    """Which columns were taken."""
    words = [
        f"{role} is column {column.place + 1}"
        + (f" {column.name!r}" if column.name else "")
        + (f" in {column.unit}" if column.unit else "")
        for role, column in track.taken.items()
    ]
    missing = "" if track.t is not None else "; no times"
    lines = "line" if track.skipped == 1 else "lines"
    skipped = f"; {track.skipped} {lines} without numbers" if track.skipped else ""
    say(f"{args.track}: {track.x.size} rows; {', '.join(words)}{missing}{skipped}")


def _plain(found: Calibration) -> dict[str, Any]:
    """What JSON can hold: no residuals, and null for what is not finite."""

    def finite(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: finite(each) for name, each in value.items()}
        return None if isinstance(value, float) and not math.isfinite(value) else value

    kept = {name: value for name, value in found.to_dict().items() if name != "residuals"}
    return {name: finite(value) for name, value in kept.items()}


_ROWS = (
    ("k", "drag constant k", "1/m"),
    ("v_lim", "terminal speed", "m/s"),
    ("n", "drag exponent", ""),
    ("cd", "drag coefficient", ""),
    ("v0", "launch speed", "m/s"),
    ("alpha0", "launch angle", "deg"),
    ("x0", "launch at x", "m"),
    ("y0", "launch at y", "m"),
    ("t0", "launch at t", "s"),
    ("g_track", "g of the track", "m/s^2"),
)


def _table(found: Calibration) -> str:
    """Names, values with their uncertainties, units."""
    lines = []
    for name, words, unit in _ROWS:
        value, u = getattr(found, name), found.uncertainty.get(name)
        if value is None or (name == "n" and u is None) or math.isnan(value):
            continue
        if name == "alpha0":
            value, u = math.degrees(value), None if u is None else math.degrees(u)
        if name == "k" and found.n != 2:
            unit = f"m^{round(1 - found.n, 3):g} s^{round(found.n - 2, 3):g}"
        if name == "v_lim" and u == math.inf:  # drag is not told from none
            lines.append((words, f"> {digits(found.v_lim_low)}", "", f"{unit}  (95 %)"))
            continue
        lines.append((words, *_pair(value, u), unit))
    lines.append(("rms", digits(found.rms), "", "m"))
    if not math.isnan(found.chi2_reduced):
        lines.append(("reduced chi^2", digits(found.chi2_reduced), "", ""))
    lines.append(("points", str(found.points), "", ""))
    wide = max(len(value) for _, value, _, _ in lines)
    errors = max(len(u) for _, _, u, _ in lines)
    shown = (
        f"{words:<16}  {value:>{wide}}"
        + (f" ± {u:<{errors}}" if u else " " * (errors + 3))
        + f"  {unit}"
        for words, value, u, unit in lines
    )
    return "\n".join(line.rstrip() for line in shown) + "\n"


def _pair(value: float, u: float | None) -> tuple[str, str]:
    """A value and its uncertainty, to two digits of the latter."""
    if u is None or not math.isfinite(u) or u <= 0 or not math.isfinite(value):
        return digits(value), ""
    return rounded(value, u)


_FRAME = {"left": 0.11, "right": 0.98, "top": 0.95, "bottom": 0.09, "hspace": 0.06}


def _figure(found: Calibration, track: Track, form: str) -> bytes:
    """The points on the path, and by how much they miss it; the same track gives the same bytes."""
    from dataclasses import replace

    from matplotlib.figure import Figure

    x, y = track.x, track.y
    room = 0.03 * max(np.ptp(x[np.isfinite(x)]), np.ptp(y[np.isfinite(y)]))
    floor = min(np.nanmin(y), found.y0) - room  # a landing below all points
    path = replace(found.launch, height=found.y0 - floor).trajectory(400)
    along = found.x0 + found.heading * path.x
    seen = (along >= np.nanmin(x) - room) & (along <= np.nanmax(x) + room)
    figure = Figure(figsize=(7, 6))
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1.3), gridspec_kw=_FRAME)
    above.plot(along[seen], (path.y + floor)[seen], color="#0b5394")
    above.plot(x, y, ".", color="#b45309", markersize=5)
    value, u = _pair(found.k, found.uncertainty.get("k"))
    words = f"k = {value}" + (f" ± {u}" if u else "") + f", n = {found.n:.3g}"
    above.set_title(words, fontsize="small")
    for column, mark, name in ((0, "+", "x"), (1, ".", "y")):
        if found.residuals[:, column].any():
            below.plot(x, found.residuals[:, column], mark, label=name, color="0.3")
    below.axhline(0, label="_path", color="0.6", linewidth=0.8)
    above.set_ylabel("y (m)")
    below.set(xlabel="x (m)", ylabel="residual (m)")
    below.legend(fontsize="small")
    for axes in (above, below):
        axes.grid(alpha=0.3)
    return rendered(figure, form, dpi=120)
