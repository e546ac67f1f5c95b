"""What is launched, by the words of the command line: the drag, the launch, and both told again."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from hodograph.cli.arguments import nearest
from hodograph.cli.streams import UsageError, say

if TYPE_CHECKING:
    from hodograph.launch import Launch

Answer = TypeVar("Answer")

RIGHT_ANGLE_OR_SO = 1.6  # an angle below it that is no whole number may be in radians
AIR = 1.225  # kg/m^3, at sea level


def launch(args: argparse.Namespace) -> Launch[Any]:
    """A single launch for one angle, and an array for several."""
    from hodograph.launch import Launch

    _hint_at_radians(args.angles)
    alpha0 = [math.radians(angle) for angle in args.angles]
    return asked(
        Launch,
        args.v0,
        alpha0 if len(alpha0) > 1 else alpha0[0],
        v_lim(args),
        n=args.n,
        g=args.g,
        height=args.height,
        slope=math.radians(args.slope),
        wind=args.wind,
        crosswind=args.crosswind,
    )


def asked(question: Callable[..., Answer], *given: Any, **options: Any) -> Answer:
    """The answer, or why arguments that are good one by one are not so together."""
    try:
        return question(*given, **options)
    except ValueError as error:
        raise UsageError(str(error)) from None


def v_lim(args: argparse.Namespace) -> float:
    """The terminal speed, from whichever of the ways to tell the drag was taken."""
    from hodograph.bodies import terminal_speed

    _require_a_body(args)
    if args.v_lim is not None:
        return float(args.v_lim)
    with np.errstate(over="ignore"):  # a terminal speed beyond the doubles is vacuum
        return float(asked(terminal_speed, _k(args), g=args.g) ** (2 / args.n))


def _k(args: argparse.Namespace) -> float:
    """lambda / m."""
    from hodograph import bodies

    rho = AIR if args.rho is None else args.rho
    if args.k is not None:
        return float(args.k)
    if args.body is None:
        size = {"diameter": args.diameter, "area": args.area}
        return float(asked(bodies.drag_constant, args.mass, args.cd, **size, rho=rho))
    known = bodies.CATALOGUE
    if args.body not in known:
        near = nearest(args.body, known)
        words = f"did you mean {near!r}?" if near else f"known are {', '.join(known)}"
        raise UsageError(f"argument --body: unknown body {args.body!r}; {words}")
    return float(asked(known[args.body].k, rho))


def _require_a_body(args: argparse.Namespace) -> None:
    """Refuse parts of a body without the rest, and what is not for one."""
    parts = {"--cd": args.cd, "--diameter": args.diameter, "--area": args.area}
    given = [name for name, value in parts.items() if value is not None]
    if args.mass is None:
        if given:
            raise UsageError(f"argument {given[0]}: not allowed without argument --mass")
        if args.rho is not None and args.body is None:
            raise UsageError("argument --rho: not allowed without argument --mass or --body")
    elif "--cd" not in given:
        raise UsageError("argument --mass: needs --cd, the drag coefficient")
    elif len(given) != 2:
        raise UsageError("argument --mass: needs exactly one of --diameter and --area")
    if args.n != 2 and (args.mass is not None or args.body is not None):
        raise UsageError("argument --n: a drag coefficient is for n = 2; give --v-lim or --k")


def _hint_at_radians(angles: tuple[float, ...]) -> None:
    for angle in angles:
        if abs(angle) < RIGHT_ANGLE_OR_SO and angle != round(angle):
            radians = f"{angle:.6g} radians would be {math.degrees(angle):.6g}"
            say(f"hint: angles are in degrees; {radians}")
            return


def words(args: argparse.Namespace) -> str:
    """The launches in words, as they were given."""
    given = [f"v0 = {args.v0:.16g} m/s", f"angle = {several(args.angles)} deg", _drag(args)]
    given += [f"g = {args.g:.16g} m/s^2", f"height = {args.height:.16g} m"]
    for name, unit, usual in (
        ("n", "", 2),
        ("slope", " deg", 0),
        ("wind", " m/s", 0),
        ("crosswind", " m/s", 0),
    ):
        if (value := getattr(args, name)) != usual:
            given.append(f"{name} = {value:.16g}{unit}")
    return ", ".join(given)


def several(values: tuple[float, ...]) -> str:
    """Numbers as they would be given."""
    return ",".join(f"{value:.16g}" for value in values)


def _drag(args: argparse.Namespace) -> str:
    if args.v_lim is not None:
        return f"v_lim = {args.v_lim:.16g} m/s"
    if args.k is not None:
        return f"k = {args.k:.16g} /m"
    rho = "" if args.rho is None else f" in air of {args.rho:.16g} kg/m^3"
    if args.body is not None:
        return f"{args.body}{rho}"
    size = (
        f"area = {args.area:.16g} m^2" if args.diameter is None else f"d = {args.diameter:.16g} m"
    )
    return f"m = {args.mass:.16g} kg, Cd = {args.cd:.16g}, {size}{rho}"
