"""What a march is after, the points on its way, and what it finds, in units of a launch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import BoolArray, FloatArray
from hodograph.engine.driver import Codes
from hodograph.engine.status import Status


class Goal(NamedTuple):
    """Where x, y, t, s times these factors come to `value`, in units of the launch.

    `way` is the sign with which their sum passes it.
    """

    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
    value: FloatArray
    way: FloatArray

    def at(self, index: NDArray[Any]) -> Goal:
        """The elements at `index`."""
        return Goal(*(part[index] for part in self))

    def so_far(self, here: Point) -> FloatArray:
        """The sum at a point."""
        return self.x * here.x + self.y * here.y + self.t * here.t + self.s * here.s

    def size(self, here: Point | Found) -> FloatArray:
        """How large its terms are, in all."""
        x, y, t, s = self.x * here.x, self.y * here.y, self.t * here.t, self.s * here.s
        return np.abs(self.value) + np.abs(x) + np.abs(y) + np.abs(t) + np.abs(s)

    def is_ahead(self, here: Point, rest: FloatArray) -> BoolArray:
        """Whether the place lies ahead of a point; the sum grows, and may then turn and fall."""
        grows = self.rate(here) > 0
        return np.where(self.way > 0, grows & (rest >= 0), grows | (rest <= 0))

    def rate(self, here: Point) -> FloatArray:
        """How the sum grows at a point."""
        return here.quick * (self.x * here.cos + self.y * here.sin + self.s) + self.t


class Point(NamedTuple):
    """A point of the path, in units of the launch; lag is t - x / cos(alpha0), 0 unless wanted."""

    quick: FloatArray  # speed over the launch's
    slope: FloatArray
    sin: FloatArray
    cos: FloatArray
    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
    lag: FloatArray

    def at(self, index: NDArray[Any]) -> Point:
        """The elements at `index`."""
        return Point(*(part[index] for part in self))

    def put(self, index: NDArray[Any], part: Point) -> None:
        """Replace the elements at `index`."""
        for whole, piece in zip(self, part, strict=True):
            whole[index] = piece


class Found(NamedTuple):
    """A point in units of the launch, and the velocity there."""

    x: FloatArray
    y: FloatArray
    t: FloatArray
    s: FloatArray
    lag: FloatArray
    v_x: FloatArray
    v_y: FloatArray
    status: Codes

    def put(self, index: NDArray[Any], rows: Sequence[FloatArray], lost: BoolArray) -> None:
        """Fill in the elements at `index`."""
        for whole, row in zip(self[:-1], rows, strict=True):
            whole[index] = row
        self.status[index] = np.where(lost, Status.UNREACHABLE, Status.CONVERGED)
