"""The page as a file, without a browser."""

import re
import webbrowser
from importlib.resources import files
from pathlib import Path

import pytest

from hodograph.cli import commands as cli
from hodograph.explorer import page

PARTS = {part.name: part.read_text("utf-8") for part in files(page.__package__).iterdir()
         if part.name.endswith((".js", ".css", ".html"))}  # fmt: skip
MOST = 150_000  # bytes


def test_it_is_small():
    assert len(page.html().encode()) <= MOST


def test_it_needs_nothing_else():
    text = page.html()
    assert "{{" not in text
    assert not re.search(r"https?:|src=|@import|url\(|fetch\(|XMLHttpRequest|import\(", text)
    assert "default-src 'none'" in text  # and a browser holds it to that


def test_every_script_is_in_it():
    assert set(page.SCRIPTS) == {name for name in PARTS if name.endswith(".js")}


def test_no_part_is_long():
    assert {name: count for name, text in PARTS.items() if (count := text.count("\n")) > 400} == {}


def dictionary(language):
    text = re.search(rf"^  {language}: \{{(.*?)^  \}}", PARTS["words.js"], re.M | re.S)[1]
    text = re.sub(r"bodies: \{.*?\}", "", text, flags=re.S)
    return dict(re.findall(r'(\w+): "([^"]*)"', text))


def test_both_languages_have_every_word():
    english, french = dictionary("en"), dictionary("fr")
    assert english.keys() == french.keys()
    assert all(english.values())
    assert all(french.values())


def test_every_word_is_used_and_every_use_is_a_word():
    used = set(re.findall(r'data-(?:word|label|quantity)="(\w+)"', PARTS["page.html"]))
    code = "".join(text for name, text in PARTS.items() if name != "words.js")
    known = dictionary("en").keys()
    assert used <= known
    named = set(re.findall(r'word\((?:[\w.]+ (?:===|\|\|) [^)]*? \? )?"(\w+)"', code))
    assert named <= known
    assert {name for name in known if not re.search(rf'["\s]{name}["\s:=]', code)} == set()


def test_every_element_asked_for_is_there():
    asked = set(re.findall(r'\$\("([\w-]+)"\)', "".join(PARTS.values())))
    there = set(re.findall(r'id="([\w-]+)"', PARTS["page.html"]))
    assert asked <= there


def test_the_command_writes_it(tmp_path, capsys):
    target = tmp_path / "new" / "page.html"
    assert cli.main(["explore", "--out", str(target)]) == 0
    assert capsys.readouterr() == ("", f"hodograph: wrote {target}\n")
    assert target.read_text("utf-8") == page.html()
    assert cli.main(["explore", "--out", str(target)]) == 1
    assert "exists" in capsys.readouterr().err
    assert cli.main(["explore", "--out", str(target), "--force"]) == 0


@pytest.mark.parametrize("opens", [True, False])
def test_the_command_opens_it(monkeypatch, capsys, opens):
    opened = []

    def browse(address):
        opened.append(address)
        return opens

    monkeypatch.setattr(webbrowser, "open", browse)
    assert cli.main(["explore"]) == (0 if opens else 1)
    path = Path(capsys.readouterr().err.split()[-1])
    assert opened == [path.as_uri()]
    assert path.read_text("utf-8") == page.html()
    path.unlink()
    path.parent.rmdir()
