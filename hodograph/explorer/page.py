"""The explorer as one file of HTML: its parts put together, nothing loaded from elsewhere.

The engine in it (`engine.js`, `linear.js`) is `hodograph.engine.scalar` and
`hodograph.engine.linear` in JavaScript, function for function.
"""

from __future__ import annotations

import json
from importlib.resources import files

from hodograph.bodies import CATALOGUE
from hodograph.report.versions import STAMP

# In the order in which they use one another.
SCRIPTS = (
    "engine.js",
    "linear.js",
    "scene.js",
    "steppers.js",
    "words.js",
    "state.js",
    "draw.js",
    "map.js",
    "panels.js",
    "ui.js",
)


def html() -> str:
    """The page.

    Returns
    -------
    str
        HTML that needs no other file and no network.

    Examples
    --------
    >>> html()[:15]
    '<!doctype html>'
    """
    bodies = {
        key: {"name": body.name, "mass": body.mass, "cd": body.cd, "diameter": body.diameter}
        for key, body in CATALOGUE.items()
    }
    script = "\n".join([f"const BODIES = {json.dumps(bodies)};", *map(_text, SCRIPTS)])
    page = _text("page.html")
    for name, part in (("style", _text("style.css")), ("version", STAMP), ("script", script)):
        page = page.replace("{{" + name + "}}", part)
    return page


def _text(name: str) -> str:
    return files("hodograph.explorer").joinpath(name).read_text(encoding="utf-8")
