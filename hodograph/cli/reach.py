"""The commands that ask the inverse questions: ``aim``, ``least-speed`` and ``best``."""

from __future__ import annotations

import argparse
from dataclasses import replace

import numpy as np

from hodograph.cli import scene
from hodograph.cli.launch import UNREACHABLE
from hodograph.cli.show import Row, require_finite, show
from hodograph.cli.streams import FailedError, UsageError


def best(args: argparse.Namespace) -> None:
    """The launch angle of greatest range, and that range."""
    from hodograph.reach import best_angle

    if args.v0 == 0:
        raise UsageError("argument V0: must be > 0, since at rest every angle is as good")
    args.angles = (90.0,)
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = scene.launch(args)
        angle = best_angle(args.v0, launch.v_lim, n=args.n, g=args.g, height=args.height)
        landing = replace(launch, alpha0=angle).landing()
    rows = [
        Row("launch_angle_deg", "launch angle", "deg", np.degrees(angle)),
        Row("range_m", "range", "m", landing.x),
        Row("flight_time_s", "flight time", "s", landing.t),
    ]
    status = 1 if np.isnan(angle) else landing.status
    show(rows, status, as_json=args.json)
    if status:
        raise FailedError(f"{UNREACHABLE} at any angle")
    require_finite(*(row.values for row in rows))
