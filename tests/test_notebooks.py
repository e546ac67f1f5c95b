"""The notebooks as they are stored, and the script that keeps their outputs fresh."""

import base64
import importlib.util
import json

import pytest
from helpers import ROOT

STORED = ("01_paper", "02_exercise", "03_laws", "04_reach", "05_calibrate")


def load():
    spec = importlib.util.spec_from_file_location("_notebooks", ROOT / "docs" / "run_notebooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


script = load()


@pytest.mark.parametrize("name", STORED)
def test_outputs_are_stored(name):
    """Every cell was run, in order and without an error; those that show something show it."""
    cells = json.loads((ROOT / "notebooks" / f"{name}.ipynb").read_text("utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == list(range(1, len(code) + 1))
    for cell in code:
        shows = "print(" in "".join(cell["source"]) or "Image(" in "".join(cell["source"])
        assert bool(cell["outputs"]) or not shows
        assert all(output["output_type"] != "error" for output in cell["outputs"])
        assert all(output.get("name") != "stderr" for output in cell["outputs"])


@pytest.mark.parametrize("name", STORED)
def test_stored_figures_are_small(name):
    """In a palette of colours, which the byte after the depth of a PNG tells."""
    cells = json.loads((ROOT / "notebooks" / f"{name}.ipynb").read_text("utf-8"))["cells"]
    outputs = [output for cell in cells for output in cell.get("outputs", [])]
    pictures = [found for output in outputs if (found := output.get("data", {}).get("image/png"))]
    assert pictures
    for picture in pictures:
        content = base64.b64decode("".join(picture))
        assert content[:8] == b"\x89PNG\r\n\x1a\n"
        assert content[25] == 3


@pytest.mark.parametrize(
    ("stored", "now", "is_same"),
    [
        ("x = 1.0000001 m", "x = 1.0000002 m", True),
        ("x = 1.0001 m", "x = 1.0002 m", False),
        ("off by 1.2e-13 m", "off by -3e-14 m", True),
        ("off by 1.2e-7 m", "off by 2.4e-7 m", False),
        ("a  1.5\n------", "a 1.5\n----", True),
        ("n = 57", "n = 58", False),
        ("Euler 3", "RK2 3", False),
        ("3", "3 4", False),
        ("1.5 m in 27 ns", "1.5 m in 1.2 µs", True),
        ("1.5 m in 27 ns", "1.6 m in 27 ns", False),
        ("1.5 ms", "1.5 m", False),
    ],
)
def test_texts_compared(stored, now, is_same):
    assert script.same(stored, now) is is_same


def notebook(*outputs):
    cell = {"cell_type": "code", "outputs": list(outputs)}
    return {"cells": [{"cell_type": "markdown"}, cell]}


def stream(text):
    return {"output_type": "stream", "name": "stdout", "text": text}


def picture(data):
    return {"output_type": "display_data", "data": {"image/png": data, "text/plain": "<Image>"}}


def test_notebooks_compared():
    same = notebook(stream("1\n2\n"), picture("abc"))
    assert script.differences(same, notebook(stream("1\n2\n"), picture("xyz"))) == []
    (found,) = script.differences(same, notebook(stream("1\n2\n")))
    assert found == "cell 2: stored stdout, image/png, text/plain; now stdout"
    (found,) = script.differences(notebook(), notebook(stream("5\n")))
    assert "stored nothing; now stdout" in found
    (found,) = script.differences(notebook(stream("5 m")), notebook(stream("7 m")))
    assert "'5 m'" in found
    joined = script._streams_joined([stream("1\n"), stream("2\n"), picture("abc")])
    assert [output.get("text") for output in joined] == ["1\n2\n", None]
