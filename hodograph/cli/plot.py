"""Paths as a figure."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Path(NamedTuple):
    """Points of a path, its apex and landing (NaN where there is none), and its name."""

    x: Any
    y: Any
    apex: tuple[float, float]
    landing: tuple[float, float]
    name: str


MARKS = {"apex": "^", "landing": "o"}
WIDTH, FRAME = 6.2, 1.3  # inches of the axes across, and around them upright


def plot(paths: Sequence[Path], title: str, form: str, slope: float = 0.0) -> bytes:
    """The paths over ground of a slope in degrees; the same launches give the same bytes."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, _height(paths)), layout="constrained")
    ground = "ground at x = 0" if slope else "landing plane"
    axes = figure.add_subplot(xlabel="distance x (m)", ylabel=f"height y above the {ground} (m)")
    for path in paths:
        (line,) = axes.plot(path.x, path.y, label=path.name)
        for mark, place in zip(MARKS.values(), (path.apex, path.landing), strict=True):
            axes.plot(*place, mark, color=line.get_color(), markersize=5)
    marks = [
        axes.plot([], [], mark, color="0.3", markersize=5, label=word)[0]
        for word, mark in MARKS.items()
        if not all(math.isnan(getattr(path, word)[0]) for path in paths)
    ]
    axes.axline((0, 0), slope=math.tan(math.radians(slope)), color="0.6", linewidth=0.8)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_title(title, fontsize="small", wrap=True)
    axes.grid(alpha=0.3)
    axes.legend(handles=marks if len(paths) == 1 else None, fontsize="small")
    return rendered(figure, form)


def rendered(figure: Figure, form: str, dpi: int = 150) -> bytes:
    """The file of a figure, with no date in it and no random names."""
    from matplotlib import rc_context

    stream = io.BytesIO()
    undated = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}
    with rc_context({"svg.hashsalt": "hodograph"}):
        figure.savefig(stream, format=form, dpi=dpi, metadata=undated.get(form))
    return stream.getvalue()


def _height(paths: Sequence[Path]) -> float:
    """The figure's height in inches: as flat as the paths, within reason."""
    across = max(max(path.x) for path in paths) - min(min(path.x) for path in paths)
    heights = [0.0, *(max(path.y) for path in paths), *(min(path.y) for path in paths)]
    upright = max(heights) - min(heights)
    return FRAME + (min(max(WIDTH * upright / across, 1.7), 4.7) if across else 4.7)
