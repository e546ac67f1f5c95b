"""The commands that ask the inverse questions: ``aim``, ``least-speed`` and ``best``."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hodograph.cli import scene
from hodograph.cli.launch import UNREACHABLE
from hodograph.cli.show import Row, require_finite, show
from hodograph.cli.streams import FailedError, UsageError


def aim(args: argparse.Namespace) -> None:
    """The launch that hits a target, and how it arrives."""
    from hodograph import reach

    if len(args.velocity) != 3:
        raise UsageError("argument --velocity: must be three numbers, VX,VY,VZ")
    aside = args.crosswind or args.velocity[2] or args.x < 0
    with np.errstate(all="ignore"):  # what overflows is reported below
        shot = scene.asked(
            reach.aim, args.v0, args.x, args.y, scene.v_lim(args),
            arc=args.arc, n=args.n, g=args.g, wind=args.wind, crosswind=args.crosswind,
            velocity=args.velocity,
        )  # fmt: skip
    rows = [
        Row("launch_angle_deg", "launch angle", "deg", np.degrees(shot.alpha0)),
        *([Row("azimuth_deg", "azimuth", "deg", np.degrees(shot.azimuth))] if aside else []),
        Row("flight_time_s", "flight time", "s", shot.t),
        Row("impact_speed_m_per_s", "impact speed", "m/s", shot.speed),
        Row("impact_angle_deg", "impact angle", "deg", np.degrees(shot.alpha)),
    ]
    short = shot.shortfall
    missed = (
        f"{short:.6g} m too high" if math.isfinite(short) else "and so is any lower place there"
    )
    _report(rows, shot.status, args, f"the target is out of reach, {missed}")


def least_speed(args: argparse.Namespace) -> None:
    """The least launch speed that reaches a target, and its angle."""
    from hodograph import reach

    with np.errstate(all="ignore"):
        found = scene.asked(
            reach.least_speed, args.x, args.y, scene.v_lim(args),
            n=args.n, g=args.g, wind=args.wind,
        )  # fmt: skip
    rows = [
        Row("launch_speed_m_per_s", "launch speed", "m/s", found.v0),
        Row("launch_angle_deg", "launch angle", "deg", np.degrees(found.alpha0)),
    ]
    _report(rows, found.status, args, "the target is out of reach at any speed")


def best(args: argparse.Namespace) -> None:
    """The launch angle of greatest range, and that range."""
    from hodograph.reach import best_angle

    args.angles, args.crosswind = (90.0,), 0.0
    with np.errstate(all="ignore"):
        launch = scene.launch(args)
        angle = scene.asked(
            best_angle, args.v0, launch.v_lim, n=args.n, g=args.g, height=args.height,
            slope=math.radians(args.slope), wind=args.wind,
        )  # fmt: skip
        landing = replace(launch, alpha0=angle).landing()
    rows = [
        Row("launch_angle_deg", "launch angle", "deg", np.degrees(angle)),
        Row("range_m", "range", "m", landing.x),
        Row("flight_time_s", "flight time", "s", landing.t),
    ]
    status = 1 if np.isnan(angle) else landing.status
    blown = args.slope < 0 < args.wind and args.height >= 0
    missed = (
        "the wind carries some launch down the slope for ever"
        if blown
        else f"{UNREACHABLE} at any angle"
    )
    _report(rows, status, args, missed)


def _report(rows: Sequence[Row], status: Any, args: argparse.Namespace, missed: str) -> None:
    show(rows, status, as_json=args.json)
    if status:
        raise FailedError(missed)
    require_finite(*(row.values for row in rows))
