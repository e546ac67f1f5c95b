"""Draw the picture of README: paths of a baseball with and without drag, in wind.

Writes docs/images/paths.png: ``python docs/paths.py``.
"""

from pathlib import Path

import numpy as np

from hodograph.bodies import CATALOGUE
from hodograph.launch import Launch
from hodograph.report.style import BLUE, GREEN, GREY, LINE, RED, dress, note, one_panel

V_LIM = CATALOGUE["baseball"].v_lim()
SCENES = (  # words, terminal speed, wind in m/s, colour, how the words stand off the landing
    ("no drag", np.inf, 0.0, GREY, "right"),
    ("tailwind", V_LIM, 8.0, GREEN, "left"),
    ("still air", V_LIM, 0.0, BLUE, "center"),
    ("headwind", V_LIM, -8.0, RED, "right"),
)

figure, axes = one_panel(5.6)
for words, v_lim, wind, color, side in SCENES:
    path = Launch(40.0, np.deg2rad(40), v_lim, height=1.5, wind=wind).trajectory()
    style = "--" if v_lim == np.inf else "-"
    axes.plot(path.x, path.y, style, color=color, linewidth=LINE)
    landing = (path.x[-1], 0.0)
    note(axes, f"{words}\n{landing[0]:.0f} m", landing, (0, -6), ha=side, va="top", color=color)
axes.axhline(0.0, color=GREY, linewidth=0.8)
dress(axes, "x (m)", "y (m)")
axes.set(aspect="equal", xlim=(0, 170), ylim=(-14, 37))
figure.savefig(Path(__file__).parent / "images" / "paths.png", dpi=150)
