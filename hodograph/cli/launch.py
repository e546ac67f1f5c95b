"""The commands that follow one launch, ``range`` and ``trajectory``, and how they show it."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from hodograph.cli.streams import FailedError, UsageError, put, say
from hodograph.report.versions import STAMP

if TYPE_CHECKING:
    from hodograph.launch import Launch

PLOTS = (".pdf", ".png", ".svg")
RIGHT_ANGLE_OR_SO = 1.6  # an angle below it that is no whole number may be in radians
UNDER = 1e-14  # how far under the apex a path ends, in rises
NO_DRAG = 1e-9  # v_norm whose square is less than a double can tell from 1


def range_(args: argparse.Namespace) -> None:
    """Landing and apex as a table, or as JSON."""
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = _launch(args)
        landing, apex = launch.landing(), launch.apex()
    results = {
        "range_m": _across(args, landing.x),
        "flight_time_s": landing.t,
        "impact_speed_m_per_s": landing.speed,
        "impact_angle_deg": math.degrees(landing.alpha),
        "apex_distance_m": _across(args, apex[0]),
        "apex_height_m": apex[1],
        "apex_time_s": apex[2],
    }
    status = _STATUS[int(landing.status)]
    if args.json:
        known = {key: _finite_or_none(value) for key, value in results.items()}
        put(json.dumps(known | {"status": status.word}) + "\n")
    else:
        rows = zip(_ROWS, results.values(), strict=True)
        put(_table([(name, _digits(value), unit) for (name, unit), value in rows], status.word))
    _require_landing(launch, status)
    if not all(map(math.isfinite, results.values())):
        raise FailedError("a result is beyond the range of double precision")


def trajectory(args: argparse.Namespace) -> None:
    """Points of the path as CSV, or a plot of it; with --to-apex, as far as its highest point."""
    out: Path | None = args.out
    if out is not None:
        if out.suffix.lower() not in (".csv", *PLOTS):
            words = f"{', '.join(('.csv', *PLOTS[:-1]))} or {PLOTS[-1]}"
            raise UsageError(f"argument --out: must end in {words}; got {str(out)!r}")
        from hodograph._files import check_targets, write_whole

        check_targets(out, force=args.force)
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = _launch(args)
        columns = _to_apex(launch, args) if args.to_apex else _to_landing(launch, args)
        unreachable = args.to_apex and _status(launch).word == "unreachable"
    if not all(map(math.isfinite, (column.max() for column in columns))):
        raise FailedError("a result is beyond the range of double precision")
    content: str | bytes
    if out is None or out.suffix.lower() == ".csv":
        content = _csv(args, columns)
    else:
        content = _plot(args, columns[1], columns[2], out.suffix.lower()[1:])
    if out is None:
        assert isinstance(content, str)
        put(content)
    else:
        say(f"wrote {write_whole(out, content, force=args.force)}")
    if unreachable:
        raise FailedError(_shortfall(launch))


def _to_landing(launch: Launch, args: argparse.Namespace) -> list[Any]:
    """t, x, y, speed, degrees and s at points of the whole path."""
    path = launch.trajectory(args.n)
    if np.isnan(path.t).any():
        _require_landing(launch, _status(launch), "; --to-apex gives the path up to there")
    x = _across(args, path.x)
    return [path.t, x, path.y, path.speed, _degrees(path.alpha), path.s]


def _to_apex(launch: Launch, args: argparse.Namespace) -> list[Any]:
    """The same, as far as the highest point.

    This is the path to a plane just under that point, but for its end.
    """
    from hodograph.path import speed

    x, rise, t = replace(launch, height=0.0).apex()
    if rise == 0:  # level or downward: the launch is the highest point, and the only one
        only = (0.0, 0.0, args.height, args.v0, args.angle, 0.0)
        return [np.array([value]) for value in only]
    fall = rise * (1 - UNDER)
    path = replace(launch, height=-fall).trajectory(args.n)
    y = (path.y + fall) + args.height
    past = path.x[-1] - x
    if launch.v_norm < NO_DRAG:
        slowest = launch.v0 * np.cos(launch.alpha0)
    else:
        slowest = speed(launch.v_norm, launch.alpha0, 0.0) * launch.v_lim
    last = (t, x, args.height + rise, _across(args, slowest), 0.0, path.s[-1] - past)
    columns = [path.t, path.x, y, path.speed, _degrees(path.alpha), path.s]
    for column, value in zip(columns, last, strict=True):
        column[-1] = value
    columns[1] = _across(args, columns[1])
    return columns


# --- launches and their results -----------------------------------------------------------


class _Status(NamedTuple):
    word: str
    explanation: str


# In the order of `flight.CONVERGED`, `UNREACHABLE`, `NOT_CONVERGED`.
_STATUS = (
    _Status("converged", ""),
    _Status("unreachable", "the landing height is never reached"),
    _Status("not converged", "the landing could not be computed"),
)
_ROWS = (
    ("range", "m"),
    ("flight time", "s"),
    ("impact speed", "m/s"),
    ("impact angle", "deg"),
    ("apex distance", "m"),
    ("apex height", "m"),
    ("apex time", "s"),
)


def _launch(args: argparse.Namespace) -> Launch:
    from hodograph.launch import Launch

    alpha0 = math.radians(args.angle)
    if abs(args.angle) < RIGHT_ANGLE_OR_SO and args.angle != round(args.angle):
        radians = f"{args.angle:.6g} radians would be {math.degrees(args.angle):.6g}"
        say(f"hint: angles are in degrees; {radians}")
    options = {"g": args.g, "height": args.height}
    try:
        if args.v_lim is None:
            return Launch.from_drag(args.v0, alpha0, args.k, **options)
        return Launch(args.v0, alpha0, args.v_lim, **options)
    except ValueError as error:  # the arguments are good one by one, but not together
        raise UsageError(str(error)) from None


def _status(launch: Launch) -> _Status:
    return _STATUS[int(launch.landing().status)]


def _require_landing(launch: Launch, status: _Status, advice: str = "") -> None:
    if status.word == "unreachable":
        raise FailedError(_shortfall(launch) + advice)
    if status.explanation:
        raise FailedError(status.explanation)


def _shortfall(launch: Launch) -> str:
    unreachable = _STATUS[1].explanation
    return f"{unreachable}: the apex is {abs(launch.apex()[1]):.6g} m below it"


def _across(args: argparse.Namespace, x: Any) -> Any:
    """Horizontal distance: none straight up or down, where the cosine of pi/2 rounded is not 0."""
    return 0 * x if abs(args.angle) == 90 else x


def _degrees(alpha: Any) -> Any:
    return alpha * (180 / math.pi)


def _finite_or_none(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _digits(value: float) -> str:
    """Six significant digits; a dash where there is no landing."""
    if math.isnan(value):
        return "-"
    if 1e-4 <= abs(value) < 1e6:
        return f"{value:#.6g}".rstrip(".")
    return f"{abs(value) and value:.6g}"


def _table(rows: Sequence[tuple[str, str, str]], status: str) -> str:
    """Names, values with their decimal points in one column, units."""
    parts = [(name, *value.partition("."), unit) for name, value, unit in rows]
    name_width = max(len(name) for name, *_ in parts)
    whole_width = max(len(whole) for _, whole, *_ in parts)
    tail_width = max(len(point + tail) for _, _, point, tail, _ in parts)
    lines = [
        f"{name:<{name_width}}  {whole:>{whole_width}}{point + tail:<{tail_width}}  {unit}"
        for name, whole, point, tail, unit in parts
    ]
    return "\n".join([*lines, f"{'status':<{name_width}}  {status}"]) + "\n"


def _scene(args: argparse.Namespace) -> str:
    """The launch in words, as it was given."""
    drag = f"v_lim = {args.v_lim:.16g} m/s" if args.k is None else f"k = {args.k:.16g} /m"
    return (
        f"v0 = {args.v0:.16g} m/s, angle = {args.angle:.16g} deg, {drag}, "
        f"g = {args.g:.16g} m/s^2, height = {args.height:.16g} m"
    )


def _csv(args: argparse.Namespace, columns: Sequence[Any]) -> str:

    lines = [
        f"# {STAMP}: {_scene(args)}",
        "# units: t s, x m, y m above the landing plane, speed m/s, alpha_deg deg, "
        "s m along the path",
        "t,x,y,speed,alpha_deg,s",
    ]
    values = zip(*(column.tolist() for column in columns), strict=True)
    lines += [",".join(map(repr, row)) for row in values]
    return "\n".join(lines) + "\n"


def _plot(args: argparse.Namespace, x: Any, y: Any, form: str) -> bytes:
    """The path, in one of `PLOTS`; the same launch gives the same bytes."""
    import io

    from matplotlib import rc_context
    from matplotlib.figure import Figure

    stream = io.BytesIO()
    undated = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}
    with rc_context({"svg.hashsalt": "hodograph"}):
        figure = Figure(figsize=(7, 4), layout="constrained")
        axes = figure.add_subplot(
            xlabel="distance x (m)", ylabel="height y above the landing plane (m)"
        )
        axes.plot(x, y)
        axes.axhline(0, color="0.6", linewidth=0.8)
        axes.set_title(_scene(args), fontsize="small")
        axes.grid(alpha=0.3)
        figure.savefig(stream, format=form, dpi=150, metadata=undated.get(form))
    return stream.getvalue()
