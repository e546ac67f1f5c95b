"""The commands that follow a launch: ``range``, ``at`` and ``trajectory``."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hodograph.cli import scene
from hodograph.cli.options import MOST_POINTS, PLOTS
from hodograph.cli.show import STATUS, Row, require_finite, show
from hodograph.cli.streams import FailedError, UsageError, put, say
from hodograph.report.versions import STAMP

if TYPE_CHECKING:
    from hodograph.launch import Launch

UNREACHABLE = "the landing height is never reached"


def range_(args: argparse.Namespace) -> None:
    """Landing and apex as a table, or as JSON."""
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = scene.launch(args)
        landing, (x, y, t) = launch.landing(), launch.apex()
    rows = [
        *_angles(args),
        Row("range_m", "range", "m", _across(args, landing.x)),
        *([Row("drift_m", "drift", "m", landing.z)] if args.crosswind else []),
        *([Row("landing_height_m", "landing height", "m", landing.y)] if args.slope else []),
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


def at(args: argparse.Namespace) -> None:
    """The state at a time, a distance, a height or a length of path."""
    name, place = next(
        (name, getattr(args, name)) for name in "txys" if getattr(args, name) is not None
    )
    if args.rising and name != "y":
        raise UsageError("argument --rising: not allowed without argument --y")
    options = {"rising": args.rising} if name == "y" else {}
    with np.errstate(all="ignore"):  # what overflows is reported below
        state = scene.asked(scene.launch(args).at, **{name: place}, **options)
    rows = [
        *_angles(args),
        Row("t_s", "time", "s", state.t),
        Row("x_m", "distance", "m", _across(args, state.x)),
        Row("y_m", "height", "m", state.y),
        *([Row("z_m", "drift", "m", state.z)] if args.crosswind else []),
        Row("speed_m_per_s", "speed", "m/s", state.speed),
        Row("angle_deg", "angle", "deg", np.degrees(state.alpha)),
        Row("s_m", "path", "m", state.s),
    ]
    show(rows, state.status, as_json=args.json)
    missed = _unmet(args, state.status)
    if missed is not None:
        unit = "s" if name == "t" else "m"
        raise FailedError(f"the path never comes to {name} = {place:.6g} {unit}{missed}")
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
        if args.spacing == "x" and args.wind < 0:
            raise UsageError("argument --spacing: no x against the wind, where paths may turn back")
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
    if args.dt is None:
        return _columns(launch.trajectory(args.points, spacing=args.spacing), args, angle)
    times = _times(args.dt, float(launch.flight_time()))
    return _columns(launch.at(t=times), args, angle) | {"t": times}


def _to_apex(launch: Launch, args: argparse.Namespace, angle: float) -> dict[str, Any]:
    """Points as far as the highest one."""
    x, y, t = launch.apex()
    if t == 0:  # level or downward: the launch is the highest point, and the only one
        return _columns(launch.at(t=np.zeros(1)), args, angle)
    top = launch.at(t=t)
    if args.dt is None:
        place, end = {"arc": ("s", top.s), "time": ("t", t), "x": ("x", x)}[args.spacing]
        where = np.linspace(0.0, end, args.points)
    else:
        place, where = "t", _times(args.dt, float(t))
    there: dict[str, Any] = {place: where}
    columns = _columns(launch.at(**there), args, angle) | there
    for name, value in {"t": t, "x": x, "y": y, "alpha_deg": 0.0, "s": top.s}.items():
        columns[name][-1] = value
    if _upright(args, angle):
        columns["x"][-1] = 0.0
        columns["speed"][-1] = abs(args.crosswind)
    return columns


def _times(dt: float, end: float) -> Any:
    """Every dt, and the end."""
    if end / dt > MOST_POINTS:
        raise UsageError(f"argument --dt: gives more than {MOST_POINTS} points in {end:.6g} s")
    times = dt * np.arange(math.ceil(end / dt * (1 - 1e-12)))
    return np.append(times, end)


def _columns(path: Any, args: argparse.Namespace, angle: float) -> dict[str, Any]:
    """The columns of a file."""
    across = 0 * path.x if _upright(args, angle) else path.x
    drift = {"z": path.z} if args.crosswind else {}
    last = {"speed": path.speed, "alpha_deg": path.alpha * (180 / math.pi), "s": path.s}
    return {"t": path.t, "x": across, "y": path.y} | drift | last


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
    if len(args.angles) == 1 and not args.slope:
        missed = f": the apex is {abs(launch.apex()[1]):.6g} m below it"
    raise FailedError(f"{UNREACHABLE}{missed}{advice}")


def _upright(args: argparse.Namespace, angle: float) -> bool:
    """Whether it goes nowhere across, though the cosine of pi/2 rounded is not 0."""
    return abs(angle) == 90 and args.wind == 0


def _across(args: argparse.Namespace, x: Any) -> Any:
    """Horizontal distance: none straight up or down in still air."""
    upright = [_upright(args, angle) for angle in args.angles]
    return np.where(upright if np.ndim(x) else upright[0], 0 * x, x)


# --- paths --------------------------------------------------------------------------------


def _csv(args: argparse.Namespace, paths: list[dict[str, Any]]) -> str:
    several, drift = len(paths) > 1, "z m across, " if args.crosswind else ""
    lines = [
        f"# {STAMP}: {scene.words(args)}",
        f"# units: t s, x m, y m above the landing plane, {drift}speed m/s, alpha_deg deg, "
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

    drawn, none = [], (math.nan, math.nan)
    for launch, columns, angle in zip(each, paths, args.angles, strict=True):
        x, y, t = launch.apex()
        still = 0.0 if _upright(args, angle) else 1.0
        apex = (still * float(x), float(y)) if t <= columns["t"][-1] else none
        end = none if args.to_apex else (columns["x"][-1], columns["y"][-1])
        drawn.append(Drawn(columns["x"], columns["y"], apex, end, f"{angle:g}°"))
    return plot(drawn, scene.words(args), form, args.slope)
