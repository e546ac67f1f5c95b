"""The commands that ask the inverse questions: ``best``."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

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
    args.angles, args.slope, args.wind, args.crosswind = (90.0,), 0.0, 0.0, 0.0
    with np.errstate(all="ignore"):
        launch = scene.launch(args)
        angle = scene.asked(
            best_angle, args.v0, launch.v_lim, n=args.n, g=args.g, height=args.height,
        )  # fmt: skip
        landing = replace(launch, alpha0=angle).landing()
    rows = [
        Row("launch_angle_deg", "launch angle", "deg", np.degrees(angle)),
        Row("range_m", "range", "m", landing.x),
        Row("flight_time_s", "flight time", "s", landing.t),
    ]
    status = 1 if np.isnan(angle) else landing.status
    _report(rows, status, args, f"{UNREACHABLE} at any angle")


def _report(rows: Sequence[Row], status: Any, args: argparse.Namespace, missed: str) -> None:
    show(rows, status, as_json=args.json)
    if status:
        raise FailedError(missed)
    require_finite(*(row.values for row in rows))
