"""The commands that follow a launch: ``range`` and ``trajectory``."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hodograph.cli import scene
from hodograph.cli.options import PLOTS
from hodograph.cli.show import STATUS, Row, require_finite, show
from hodograph.cli.streams import FailedError, UsageError, put, say
from hodograph.report.versions import STAMP

if TYPE_CHECKING:
    from hodograph.launch import Launch, Trajectory

UNDER = 1e-14  # how far under the apex a path ends, in rises
NO_DRAG = 1e-9  # v_norm whose square is less than a double can tell from 1
UNREACHABLE = "the landing height is never reached"


def range_(args: argparse.Namespace) -> None:
    """Landing and apex as a table, or as JSON."""
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = scene.launch(args)
        landing, (x, y, t) = launch.landing(), launch.apex()[:3]
    rows = [
        *_angles(args),
        Row("range_m", "range", "m", _across(args, landing.x)),
        Row("flight_time_s", "flight time", "s", landing.t),
        Row("impact_speed_m_per_s", "impact speed", "m/s", landing.speed),
        Row("impact_angle_deg", "impact angle", "deg", np.degrees(landing.alpha)),
        Row("apex_distance_m", "apex distance", "m", _across(args, x)),
        Row("apex_height_m", "apex height", "m", y),
        Row("apex_time_s", "apex time", "s", t),
    ]
    show(rows, landing.status, as_json=args.json)
    _require_landing(args, launch, landing.status)
    require_finite(*(row.values for row in rows))


def trajectory(args: argparse.Namespace) -> None:
    """Points of the path as CSV or JSON, or a plot; with --to-apex, up to its highest point."""
    out: Path | None = args.out
    if out is not None:
        if out.suffix.lower() not in (".csv", *PLOTS):
            words = f"{', '.join(('.csv', *PLOTS[:-1]))} or {PLOTS[-1]}"
            raise UsageError(f"argument --out: must end in {words}; got {str(out)!r}")
        if args.json:
            raise UsageError("argument --json: not allowed with argument --out")
        from hodograph._files import check_targets, write_whole

        check_targets(out, force=args.force)
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = scene.launch(args)
        if not args.to_apex:
            advice = "; --to-apex gives the path up to there"
            _require_landing(args, launch, launch.landing().status, advice)
        each = list(launch) if len(args.angles) > 1 else [launch]
        path = _to_apex if args.to_apex else _to_landing
        paths = [path(one, args, angle) for one, angle in zip(each, args.angles, strict=True)]
    require_finite(*(column for columns in paths for column in columns.values()))
    content: str | bytes
    if out is None or out.suffix.lower() == ".csv":
        content = _json(args, paths) if args.json else _csv(args, paths)
    else:
        content = _figure(args, each, paths, out.suffix.lower()[1:])
    if out is None:
        assert isinstance(content, str)
        put(content)
    else:
        say(f"wrote {write_whole(out, content, force=args.force)}")
    if args.to_apex:
        _require_landing(args, launch, launch.landing().status)


def _to_landing(launch: Launch, args: argparse.Namespace, angle: float) -> dict[str, Any]:
    """Points of the whole path."""
    return _columns(launch.trajectory(args.points), angle)


def _to_apex(launch: Launch, args: argparse.Namespace, angle: float) -> dict[str, Any]:
    """The same, as far as the highest point.

    This is the path to a plane just under that point, but for its end.
    """
    from hodograph.path import speed

    x, rise, t = replace(launch, height=0.0).apex()
    if rise == 0:  # level or downward: the launch is the highest point, and the only one
        only = {"t": 0.0, "x": 0.0, "y": args.height, "speed": args.v0}
        only |= {"alpha_deg": angle, "s": 0.0}
        return {name: np.array([value]) for name, value in only.items()}
    fall = rise * (1 - UNDER)
    path = replace(launch, height=-fall).trajectory(args.points)
    columns = _columns(path, angle)
    columns["y"] = (path.y + fall) + args.height
    if launch.v_norm < NO_DRAG:
        slowest = launch.v0 * np.cos(launch.alpha0)
    else:
        slowest = speed(launch.v_norm, launch.alpha0, 0.0) * launch.v_lim
    upright = angle == 90
    last = {"t": t, "x": 0 * x if upright else x, "y": args.height + rise}
    last |= {"speed": 0 * slowest if upright else slowest, "alpha_deg": 0.0}
    last["s"] = path.s[-1] - (path.x[-1] - x)
    for name, value in last.items():
        columns[name][-1] = value
    return columns


def _columns(path: Trajectory, angle: float) -> dict[str, Any]:
    """The columns of a file."""
    across = 0 * path.x if _upright(angle) else path.x
    last = {"speed": path.speed, "alpha_deg": path.alpha * (180 / math.pi), "s": path.s}
    return {"t": path.t, "x": across, "y": path.y} | last


# --- launches and their results -----------------------------------------------------------


def _angles(args: argparse.Namespace) -> list[Row]:
    """Which launch is which."""
    several = len(args.angles) > 1
    return [Row("launch_angle_deg", "launch angle", "deg", args.angles)] if several else []


def _unmet(args: argparse.Namespace, status: Any) -> str | None:
    """At which angles there is no result: words for a message, if at any."""
    missed = [a for a, code in zip(args.angles, np.ravel(status), strict=True) if code]
    if not missed:
        return None
    return f" at {scene.several(tuple(missed))} degrees" if len(args.angles) > 1 else ""


def _require_landing(
    args: argparse.Namespace, launch: Launch, status: Any, advice: str = ""
) -> None:
    missed = _unmet(args, status)
    if missed is None:
        return
    if STATUS[int(np.max(status))] != "unreachable":
        raise FailedError(f"the landing could not be computed{missed}")
    if len(args.angles) == 1:
        missed = f": the apex is {abs(launch.apex()[1]):.6g} m below it"
    raise FailedError(f"{UNREACHABLE}{missed}{advice}")


def _upright(angle: float) -> bool:
    """Whether it goes nowhere across, though the cosine of pi/2 rounded is not 0."""
    return abs(angle) == 90


def _across(args: argparse.Namespace, x: Any) -> Any:
    """Horizontal distance: none straight up or down in still air."""
    upright = [_upright(angle) for angle in args.angles]
    return np.where(upright if np.ndim(x) else upright[0], 0 * x, x)


# --- paths --------------------------------------------------------------------------------


def _csv(args: argparse.Namespace, paths: list[dict[str, Any]]) -> str:
    several = len(paths) > 1
    lines = [
        f"# {STAMP}: {scene.words(args)}",
        "# units: t s, x m, y m above the landing plane, speed m/s, alpha_deg deg, "
        "s m along the path",
        ",".join([*(["launch_deg"] if several else []), *paths[0]]),
    ]
    for angle, columns in zip(args.angles, paths, strict=True):
        values = zip(*(column.tolist() for column in columns.values()), strict=True)
        head = f"{angle!r}," if several else ""
        lines += [head + ",".join(map(repr, row)) for row in values]
    return "\n".join(lines) + "\n"


def _json(args: argparse.Namespace, paths: Iterable[dict[str, Any]]) -> str:
    several = len(args.angles) > 1
    each = [
        ({"launch_angle_deg": angle} if several else {})
        | {name: column.tolist() for name, column in columns.items()}
        for angle, columns in zip(args.angles, paths, strict=True)
    ]
    return json.dumps(each if several else each[0]) + "\n"


def _figure(
    args: argparse.Namespace, each: list[Launch], paths: list[dict[str, Any]], form: str
) -> bytes:
    from hodograph.cli.plot import Path as Drawn
    from hodograph.cli.plot import plot

    drawn = []
    for launch, columns, angle in zip(each, paths, args.angles, strict=True):
        x, y = launch.apex()[:2]
        still = 0.0 if _upright(angle) else 1.0
        end = (math.nan, math.nan) if args.to_apex else (columns["x"][-1], columns["y"][-1])
        drawn.append(
            Drawn(columns["x"], columns["y"], (still * float(x), float(y)), end, f"{angle:g}°")
        )
    return plot(drawn, scene.words(args), form)
