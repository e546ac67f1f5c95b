"""How figures look: one width, one size of text, few colours; and the bytes of their files."""

import io
from typing import Any

from matplotlib.figure import Figure

WIDTH = 16.0  # cm
TEXT = 9  # points
BLUE, RED, GREEN, GREY = "#0b5394", "#b45309", "#15803d", "#6b7280"
LINE = 1.4
DPI = 200


def new_figure(height: float, width: float = WIDTH) -> Figure:
    """An empty figure of so many cm, which no window or global state knows of."""
    return Figure(figsize=(width / 2.54, height / 2.54), layout="constrained")


def one_panel(height: float, width: float = WIDTH) -> tuple[Figure, Any]:
    """A figure of so many cm, and its axes."""
    figure = new_figure(height, width)
    return figure, figure.add_subplot()


def two_panels(height: float, *ratios: float) -> tuple[Figure, Any, Any]:
    """A figure and its axes: a panel above, and one below on the same x axis."""
    figure = new_figure(height)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=ratios)
    figure.align_ylabels()
    return figure, above, below


def dress(axes: Any, xlabel: str, ylabel: str, *, grid: bool = True) -> None:
    """Label the axes in the size of all figures, with a light grid or a frame."""
    axes.set_xlabel(xlabel, fontsize=TEXT + 1)
    axes.set_ylabel(ylabel, fontsize=TEXT + 1)
    axes.tick_params(labelsize=TEXT)
    if grid:
        axes.grid(color="#e5e7eb", linewidth=0.6)
        axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(not grid)


def title(axes: Any, words: str) -> None:
    """A title in the size of the labels."""
    axes.set_title(words, fontsize=TEXT + 1)


def legend(axes: Any, **options: Any) -> None:
    """A key without a frame, of the axes or of a whole figure."""
    axes.legend(**{"fontsize": TEXT, "frameon": False} | options)


def note(
    axes: Any, words: str, at: tuple[Any, Any], offset: tuple[float, float], **options: Any
) -> None:
    """Words beside a point, so many points of type away."""
    options = {"fontsize": TEXT, "textcoords": "offset points"} | options
    axes.annotate(words, at, offset, **options)


def png(figure: Figure, *, dpi: float = DPI) -> bytes:
    """The figure as PNG, the same bytes for the same figure drawn afresh."""
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=dpi, metadata={"Software": None})
    return stream.getvalue()


def pdf(figure: Figure) -> bytes:
    """The figure as PDF, without a date in it."""
    stream = io.BytesIO()
    nothing = dict.fromkeys(("CreationDate", "Creator", "Producer"))
    figure.savefig(stream, format="pdf", metadata=nothing)
    return stream.getvalue()


def files(name: str, figure: Figure, *, dpi: float = DPI) -> dict[str, bytes]:
    """The figure as the contents of ``name.png`` and ``name.pdf``."""
    return {f"{name}.png": png(figure, dpi=dpi), f"{name}.pdf": pdf(figure)}
