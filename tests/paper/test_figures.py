"""The figures: what they show, that they can be read, and that they come out the same."""

import io
import itertools
import subprocess
import sys

import matplotlib
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.text import Text

from hodograph.paper import figures
from hodograph.report import style

NUMBERS = range(1, 7)
V_LIM = 42.7
NAMES = (*map(str, NUMBERS), "didion")


@pytest.fixture(scope="module")
def drawn():
    made = {name: getattr(figures, f"figure_{name}")() for name in NAMES}
    made |= {n: made[str(n)] for n in NUMBERS}
    for figure in made.values():
        FigureCanvasAgg(figure).draw()
    return made


def curve(axes, label):
    """x and y of the line whose legend starts with `label`."""
    (line,) = [line for line in axes.lines if str(line.get_label()).startswith(label)]
    return np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)


@pytest.mark.parametrize("number", NAMES)
def test_is_a_figure_at_page_width_with_named_axes(drawn, number):
    figure = drawn[number]
    assert isinstance(figure, Figure)
    assert figure.get_figwidth() == pytest.approx(16 / 2.54)
    for axes in figure.axes:
        assert axes.get_ylabel()
    assert all(axes.get_xlabel() for axes in figure.axes[-1 if number != "3" else 0 :][:1])


@pytest.mark.parametrize("number", NAMES)
def test_words_are_legible_and_clear_of_one_another(drawn, number):
    figure = drawn[number]
    words = [
        text
        for text in figure.findobj(Text)
        if text.get_visible() and text.get_text().strip() and text.get_window_extent().width > 0
    ]
    assert words
    assert min(text.get_fontsize() for text in words) >= 9
    page = figure.bbox
    beyond = {  # ticks outside the limits exist, but are not drawn
        tick.label1
        for axes in figure.axes
        for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim()))
        for tick in axis.get_major_ticks()
        if not low <= tick.get_loc() <= high
    }
    boxes = [(t.get_text(), t.get_window_extent()) for t in words if t not in beyond]
    boxes = [(t, box.shrunk(0.9, 0.8)) for t, box in boxes]
    for text, box in boxes:
        assert page.x0 <= box.x0, text
        assert box.x1 <= page.x1, text
        assert page.y0 <= box.y0, text
        assert box.y1 <= page.y1, text
    for (one, a), (other, b) in itertools.combinations(boxes, 2):
        assert not a.overlaps(b), f"{one!r} lies on {other!r}"


def test_figure_1_frame_lies_along_the_path(drawn):
    (axes,) = drawn[1].axes
    (path,) = [line for line in axes.lines if len(line.get_xdata()) == 300]
    x, y = path.get_xdata(), path.get_ydata()
    arrows = [t for t in axes.texts if getattr(t, "arrow_patch", None) is not None]
    spans = [np.array(t.xy) - np.array(t.xyann) for t in arrows]
    starts = [np.array(t.xyann) for t in arrows]
    v, T, N, weight, drag, launch = spans
    near = int(np.argmin(np.hypot(x - starts[0][0], y - starts[0][1])))
    along = np.array([x[near + 1] - x[near - 1], y[near + 1] - y[near - 1]])
    assert v @ along == pytest.approx(np.linalg.norm(v) * np.linalg.norm(along), rel=1e-3)
    assert abs(T @ N) < 1e-12
    assert N[1] < 0 < N[0]  # towards the centre of curvature
    assert weight[0] == 0 > weight[1]
    assert drag @ v < 0
    assert launch[1] / launch[0] == pytest.approx(np.tan(np.deg2rad(60)))
    one = np.linalg.norm(weight)  # the scale of all: v_lim, and the weight
    assert np.linalg.norm(launch) == pytest.approx(1.5 * one)
    speed = np.linalg.norm(v) / one  # drag over weight is (v / v_lim)^2
    assert speed < 1.5
    assert np.linalg.norm(drag) / one == pytest.approx(speed**2)


def test_figure_2_parabola_has_its_closed_form(drawn):
    (axes,) = drawn[2].axes
    x, y = curve(axes, "without drag")
    assert x[-1] == pytest.approx(V_LIM**2 / 9.81)
    assert y == pytest.approx(x - 9.81 * x**2 / V_LIM**2, abs=1e-9)
    dragged, _ = curve(axes, "drag")
    assert dragged[-1] == pytest.approx(x[-1] * 0.589, rel=1e-3)  # figure 4 at v_norm = 1


def test_figure_3_meets_the_closed_form_at_the_vertical(drawn):
    axes = drawn[3].axes[0]
    reached = []
    for lines in axes.collections:
        if getattr(lines, "filled", True):
            continue
        for level, path in zip(lines.levels, lines.get_paths(), strict=True):
            top = path.vertices[np.abs(path.vertices[:, 1] - 90) < 1e-9]
            if level == pytest.approx(0.5) or level == pytest.approx(0.8):
                v = top[:, 0]
                d = (np.arcsinh(v) + np.arctan(v)) / (2 * v * np.sqrt(1 + v * v))
                assert d == pytest.approx(level, abs=1e-3)
                reached.append(level)
    assert len(reached) == 2


def test_figure_4_shows_points_fit_and_residual(drawn):
    above, below = drawn[4].axes
    v, exact = curve(above, "exact")
    assert exact[0] == 1
    assert v[-1] == 1.5
    _, fit = curve(above, "Pearson VII")
    assert np.max(np.abs(fit[::5] / exact - 1)) == pytest.approx(0.0016, abs=1e-4)
    fine, residual = curve(below, "this fit")
    assert residual[::5] == pytest.approx(100 * (fit[::5] / exact - 1), abs=1e-9)
    assert fine[::5] == pytest.approx(v)
    _, table = curve(below, "Table 1")
    assert np.max(np.abs(table)) == pytest.approx(0.175, abs=0.005)  # 0.17 % at 45 degrees


def test_figure_5_shows_each_fit_against_the_points_of_its_own_window(drawn):
    (K, M, below, _) = drawn[5].axes
    for axes, printed in (
        (K, (0.24207, 1.56854, -1.16548, 0.26454)),
        (M, (0.675688, 0.046397, 0.031539)),
    ):
        degrees, drawn_ = curve(axes, "Table 1")
        a = np.deg2rad(degrees)
        assert drawn_ == pytest.approx(sum(c * a**i for i, c in enumerate(printed)))
        angle, points = curve(axes, "eq. 22")
        assert list(angle) == pytest.approx(list(range(10, 81, 5)))
        assert points == pytest.approx(np.interp(angle, degrees, drawn_), rel=0.008)
        _, ours = curve(axes, "our fit of these")
        assert ours == pytest.approx(drawn_, rel=1e-4)
    lengths = sorted(len(line.get_xdata()) for line in below.lines)
    assert lengths[-3:] == [15, 15, 90]  # and the line of zero


def test_figure_6_shows_the_law_and_its_bound(drawn):
    above, below = drawn[6].axes
    v0, law = curve(above, "angle by the law")
    assert law == pytest.approx(
        45 * (1 + 0.0085864**2 * v0**2 / 0.1366571) ** -0.1366571, rel=1e-12
    )
    assert v0[-1] == pytest.approx(1.5 * V_LIM)
    slow, best = curve(above, "best angle")
    assert best == pytest.approx(np.interp(slow, v0, law), rel=2e-4)
    deviation = max(below.lines, key=lambda line: len(line.get_xdata())).get_ydata()
    assert np.max(np.abs(deviation)) == pytest.approx(0.012, abs=5e-4)


def test_bytes_are_the_same_and_hold_no_date():
    one, other = figures.figure_3(), figures.figure_3()
    image, document = style.png(one), style.pdf(one)
    assert image == style.png(other)
    assert document == style.pdf(other)
    assert b"tIME" not in image
    assert b"Software" not in image
    assert b"Date" not in document
    assert imread(io.BytesIO(image)).shape[1] == int(16 / 2.54 * style.DPI)


def test_no_window_no_global_state():
    # In a process of its own: here other tests may have loaded what is to be left alone.
    code = (
        "import sys, matplotlib as m\n"
        "before = dict(m.rcParams)\n"
        "from hodograph.paper import figures\n"
        "from hodograph.report import style\n"
        "style.png(figures.figure_2())\n"
        "assert dict(m.rcParams) == before\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    assert matplotlib.rcParams["font.size"] == matplotlib.rcParamsDefault["font.size"]


def test_figure_didion_starts_and_stays_near_the_square_law(drawn):
    above, below = drawn["didion"].axes
    _, square = curve(above, "$v^2$ alone")
    assert square[0] == 45
    for line in below.lines:
        v, off = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        assert np.max(np.abs(off[v <= 1.5])) < 0.3
