"""Keep the outputs that are stored in notebooks/ fresh: run them again, compare or replace.

    python docs/run_notebooks.py            fail where what is stored is not what comes out now
    python docs/run_notebooks.py --write    store what comes out now
    python docs/run_notebooks.py --write notebooks/02_exercise.ipynb

It needs the extra ``docs``.  Text is compared, numbers in it to 1e-6 of their size (or 1e-9: what
is rounding differs from machine to machine); of a figure only that there is one, and of a duration
in ns, µs or ms.
"""

from __future__ import annotations

import argparse
import base64
import copy
import io
import math
import re
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
FOLDER = HERE.parent / "notebooks"
RELATIVE, ABSOLUTE = 1e-6, 1e-9
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?")
_DURATION = re.compile(_NUMBER.pattern + r" *(?:ns|µs|ms)\b")
_BLANKS = re.compile(r"[\s\-─]+")  # columns and rules are as wide as the numbers in them


def main(argv: list[str]) -> int:
    """Compare or write; 1 if a notebook is stale."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--write", action="store_true", help="store the outputs")
    parser.add_argument("paths", nargs="*", type=Path, help="notebooks (default: all)")
    args = parser.parse_args(argv)
    stale = 0
    for path in args.paths or sorted(FOLDER.glob("*.ipynb")):
        import nbformat

        stored = nbformat.read(path, 4)
        fresh = executed(stored)
        if args.write:
            shrink(fresh)
            nbformat.write(fresh, path)
            sys.stdout.write(f"{path.name}: written" + "\n")
            continue
        found = differences(stored, fresh)
        stale += bool(found)
        sys.stdout.write(f"{path.name}: {'stale' if found else 'fresh'}" + "\n")
        for words in found:
            sys.stdout.write(f"  {words}" + "\n")
    return int(stale > 0)


def executed(stored: Any) -> Any:
    """The notebook run from top to bottom in a new kernel; an error in it is raised."""
    from nbclient import NotebookClient

    fresh = copy.deepcopy(stored)
    client = NotebookClient(
        fresh, timeout=600, record_timing=False, resources={"metadata": {"path": str(FOLDER)}}
    )
    client.execute()
    for cell in fresh.cells:  # printed in one piece or in several, as it happened
        if cell.cell_type == "code":
            cell.outputs = _streams_joined(cell.outputs)
    fresh.metadata = copy.deepcopy(stored.metadata)  # without the version of this Python
    return fresh


def _streams_joined(outputs: list[Any]) -> list[Any]:
    joined: list[Any] = []
    for output in outputs:
        last = joined[-1] if joined else {}
        if output["output_type"] == "stream" and last.get("name") == output["name"]:
            last["text"] += output["text"]
        else:
            joined.append(output)
    return joined


def shrink(notebook: Any) -> None:
    """Store its figures in 256 colours, which a plot does with, and a third of the bytes."""
    from PIL import Image  # with which matplotlib writes a PNG

    for cell in notebook["cells"]:
        for output in cell.get("outputs", []):
            if stored := output.get("data", {}).get("image/png"):
                drawn = Image.open(io.BytesIO(base64.b64decode("".join(stored)))).convert("RGB")
                stream = io.BytesIO()
                plain = drawn.quantize(256, dither=Image.Dither.NONE)
                plain.save(stream, "PNG", optimize=True)
                output["data"]["image/png"] = base64.b64encode(stream.getvalue()).decode()


def differences(stored: Any, fresh: Any) -> list[str]:
    """What is not the same in the outputs of the two, a line for each cell."""
    found = []
    pairs = zip(stored["cells"], fresh["cells"], strict=True)
    for number, (old, new) in enumerate(pairs, 1):
        if old["cell_type"] != "code":
            continue
        here, there = _content(old["outputs"]), _content(new["outputs"])
        if [kind for kind, _ in here] != [kind for kind, _ in there]:
            kinds = [", ".join(kind for kind, _ in side) or "nothing" for side in (here, there)]
            found.append(f"cell {number}: stored {kinds[0]}; now {kinds[1]}")
            continue
        for (_, text), (_, now) in zip(here, there, strict=True):
            if not same(text, now):
                found.append(f"cell {number}: stored {text[:300]!r}; now {now[:300]!r}")
    return found


def _content(outputs: list[Any]) -> list[tuple[str, str]]:
    """Kind and text of each output; the text of a figure is empty."""
    content: list[tuple[str, str]] = []
    for output in outputs:
        if output["output_type"] == "stream":
            content.append((output["name"], output["text"]))
        for kind, data in sorted(output.get("data", {}).items()):
            content.append((kind, "" if kind.startswith("image/") else data))
    return content


def same(stored: str, now: str) -> bool:
    """Whether two texts have the same words, and numbers that are near enough."""
    stored, now = (_DURATION.sub("duration", text) for text in (stored, now))
    words = [_BLANKS.sub(" ", _NUMBER.sub("#", text)).strip() for text in (stored, now)]
    if words[0] != words[1]:
        return False
    pairs = zip(_NUMBER.findall(stored), _NUMBER.findall(now), strict=True)
    return all(
        math.isclose(float(one), float(other), rel_tol=RELATIVE, abs_tol=ABSOLUTE)
        for one, other in pairs
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
