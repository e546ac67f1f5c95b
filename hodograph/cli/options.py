"""The options of the commands: what is launched, through what air, onto what ground."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from hodograph.cli.arguments import Parser
from hodograph.cli.units import number, numbers

MOST_POINTS = 1_000_000
BODIES = "baseball, basketball, golf, javelin, shot, shuttlecock, soccer, table-tennis or tennis"
PLOTS = (".pdf", ".png", ".svg")


def not_negative(value: float) -> bool:
    """Whether it is, and finite."""
    return 0 <= value < math.inf


def positive(value: float) -> bool:
    """Whether it is, and finite."""
    return 0 < value < math.inf


def add_speed(to: Parser) -> None:
    """The launch speed."""
    to.add_argument(
        "v0",
        metavar="V0",
        type=number("finite and >= 0", "m/s", not_negative),
        help="launch speed, m/s, or with its unit: 90mph, 120km/h, 130ft/s, 50kn",
    )


def add_angles(to: Parser) -> None:
    """The launch angle, or several."""
    to.add_argument(
        "angles",
        metavar="ANGLE",
        type=numbers("in [-90, 90] degrees", "degrees", lambda a: -90 <= a <= 90),
        help="launch angle above the horizontal, degrees, in [-90, 90]; several: 30,40,50",
    )


def add_target(to: Parser) -> None:
    """The target, from the launch."""
    for name, words in (("x", "distance"), ("y", "height above the launch")):
        to.add_argument(
            name,
            metavar=name.upper(),
            type=number("finite", "m", math.isfinite),
            help=f"{words} of the target, m, or with its unit: 120ft, 80yd, 15cm",
        )


def add_drag(to: Parser) -> None:
    """Drag by a terminal speed, a constant, a body of the catalogue or one's own, and gravity."""
    group = to.add_argument_group("drag, by one of --v-lim, --k, --body and --mass")
    one = group.add_mutually_exclusive_group(required=True)
    one.add_argument(
        "--v-lim",
        metavar="V",
        type=number("> 0 (inf is vacuum)", "m/s", lambda v: v > 0),
        help="terminal speed of fall, m/s; inf is vacuum",
    )
    one.add_argument(
        "--k",
        metavar="K",
        type=number("finite and >= 0", "1/m", not_negative),
        help="drag coefficient over mass, 1/m; 0 is vacuum",
    )
    one.add_argument("--body", metavar="NAME", help=BODIES)
    one.add_argument(
        "--mass",
        metavar="M",
        type=number("finite and > 0", "kg", positive),
        help="mass, kg, or with its unit: 145g, 5oz; with --cd, and --diameter or --area",
    )
    for name, unit, words in (
        ("cd", "", "drag coefficient"),
        ("diameter", "m", "diameter, m, or with its unit: 74mm, 2.9in"),
        ("area", "m^2", "area that --cd refers to, m^2"),
    ):
        group.add_argument(
            f"--{name}",
            metavar=name[0].upper(),
            type=number("finite and >= 0", unit, not_negative),
            help=f"{words} (with --mass)",
        )
    group.add_argument(
        "--rho",
        metavar="RHO",
        type=number("finite and >= 0", "kg/m^3", not_negative),
        help="density of the air, kg/m^3, with --body or --mass (default 1.225)",
    )
    group.add_argument(
        "--n",
        metavar="POWER",
        default=2.0,
        type=number("in [1, 10]", "", lambda n: 1 <= n <= 10),
        help="drag grows as this power of the speed, from 1 to 10 (default 2)",
    )
    to.add_argument(
        "--g",
        metavar="G",
        default=9.81,
        type=number("finite and > 0", "m/s^2", positive),
        help="gravity, m/s^2 (default 9.81)",
    )


def add_ground(to: Parser) -> None:
    """Where the ground is."""
    to.add_argument(
        "--height",
        metavar="H",
        default=0.0,
        type=number("finite", "m", math.isfinite),
        help="height of the launch above the ground, m; negative if below (default 0)",
    )


def add_slope(to: Parser) -> None:
    """How steep the ground is."""
    to.add_argument(
        "--slope",
        metavar="ANGLE",
        default=0.0,
        type=number("in (-90, 90) degrees", "degrees", lambda a: -90 < a < 90),
        help="slope of the ground, degrees; it rises ahead if positive (default 0)",
    )


def add_wind(to: Parser, *, crosswind: bool = True) -> None:
    """How the air moves."""
    winds = [("wind", "wind from behind; against if negative")]
    if crosswind:
        winds.append(("crosswind", "wind across"))
    for name, words in winds:
        to.add_argument(
            f"--{name}",
            metavar="W",
            default=0.0,
            type=number("finite", "m/s", math.isfinite),
            help=f"{words}, m/s (default 0)",
        )


def add_launch(to: Parser) -> None:
    """What `hodograph.Launch` asks for, the angles in degrees."""
    add_speed(to)
    add_angles(to)
    add_drag(to)
    add_ground(to)
    add_slope(to)
    add_wind(to)


def add_range(to: Parser) -> None:
    """A launch, and what is printed of it."""
    add_launch(to)
    add_json(to)


def add_json(to: Parser) -> None:
    """JSON in place of what is for people."""
    to.add_argument("--json", action="store_true", help="print JSON")


def add_at(to: Parser) -> None:
    """A launch, and where along its path."""
    add_launch(to)
    group = to.add_argument_group("where, by one of --t, --x, --y and --s")
    place = group.add_mutually_exclusive_group(required=True)
    for name, unit, words in (
        ("t", "s", "so many seconds after the launch"),
        ("x", "m", "at this distance, m"),
        ("y", "m", "at this height above the ground at x = 0, m, on the way down"),
        ("s", "m", "after this length of path through the air, m"),
    ):
        least, holds = (
            ("finite", math.isfinite) if name in "xy" else ("finite and >= 0", not_negative)
        )
        place.add_argument(
            f"--{name}", metavar=name.upper(), type=number(least, unit, holds), help=words
        )
    group.add_argument("--rising", action="store_true", help="with --y: on the way up")
    add_json(to)


def add_points(to: Parser) -> None:
    """How many points of a path, and how far apart."""
    to.add_argument(
        *("-n", "--points"),
        metavar="N",
        type=_points,
        default=200,
        help="number of points (default 200)",
    )
    to.add_argument(
        "--spacing",
        choices=("arc", "time", "x"),
        default="arc",
        help="points evenly spaced along the path (arc, the default), in time, or in x",
    )
    to.add_argument(
        "--dt",
        metavar="DT",
        type=number("finite and > 0", "s", positive),
        help="instead, a point every DT seconds, and the last one",
    )


def _points(text: str) -> int:
    try:
        found = int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be an integer; got {text.strip()!r}") from None
    if not 2 <= found <= MOST_POINTS:
        raise argparse.ArgumentTypeError(f"must be from 2 to {MOST_POINTS}; got {found}")
    return found


def add_trajectory(to: Parser) -> None:
    """What a path is, how far it goes, and where it is written."""
    add_launch(to)
    add_points(to)
    to.add_argument(
        "--to-apex",
        action="store_true",
        help="stop at the highest point, which is there for an unreachable landing too",
    )
    to.add_argument("--json", action="store_true", help="print JSON in place of CSV")
    to.add_argument(
        "--out",
        metavar="FILE",
        type=Path,
        help="file to write in place of standard output: .csv, or a plot: .pdf, .png, .svg",
    )
    to.add_argument("--force", action="store_true", help="replace an existing file")


def add_aim(to: Parser) -> None:
    """A launch speed, a target, and which of the two ways there."""
    add_speed(to)
    add_target(to)
    add_drag(to)
    add_wind(to)
    to.add_argument(
        "--velocity",
        metavar="VX,VY,VZ",
        default=(0.0, 0.0, 0.0),
        type=numbers("finite", "m/s", math.isfinite),
        help="velocity of the target: ahead, upward, across, m/s (default 0,0,0)",
    )
    to.add_argument(
        "--arc", choices=("low", "high"), default="low", help="the flat way there, or the steep one"
    )
    add_json(to)


def add_least_speed(to: Parser) -> None:
    """A target."""
    add_target(to)
    add_drag(to)
    add_wind(to, crosswind=False)
    add_json(to)


def add_best(to: Parser) -> None:
    """A launch speed, the ground and the wind."""
    add_speed(to)
    add_drag(to)
    add_ground(to)
    add_slope(to)
    add_wind(to, crosswind=False)
    add_json(to)


def add_explore(to: Parser) -> None:
    """The file to write the page to."""
    to.add_argument(
        "--out", metavar="FILE", type=Path, help="file to write (default is to open a browser)"
    )
    to.add_argument("--force", action="store_true", help="replace an existing file")


def add_exercise(to: Parser) -> None:
    """The exercise's constants, the language of what it writes, and the programs left blank."""
    for name, unit, words, usual in (
        ("mass", "kg", "mass", "1"),
        ("v0", "m/s", "launch speed", "70"),
        ("dt", "s", "time step of 6.3 to 6.5, and of 6.8", "0.001"),
        ("eta", "kg/s", "linear drag", "0.01"),
        ("lambda", "kg/m", "quadratic drag, 6.8", "0.1"),
        ("angle", "degrees", "launch angle of 6.3 and 6.8", "45"),
        ("g", "m/s^2", "gravity", "9.81"),
    ):
        to.add_argument(
            f"--{name}",
            dest="lambda_" if name == "lambda" else name,
            metavar=name[0].upper(),
            type=number("finite and > 0", unit, positive),
            help=f"{words}, {unit} (default {usual})",
        )
    to.add_argument(
        "--lang",
        choices=("en", "fr"),
        default="en",
        help="language of page, figures and comments (default en); programs are in French",
    )
    to.add_argument(
        "--student",
        action="store_true",
        help="instead, only the programs, with functions left blank, and tests for a class",
    )
