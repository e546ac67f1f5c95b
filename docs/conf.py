import shutil
from importlib.metadata import version as installed_version
from pathlib import Path

from hodograph.explorer import page as explorer

project = "hodograph"
author = "The hodograph developers"
copyright = "The hodograph developers"
version = release = installed_version("hodograph")

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx-mathjax-offline",
]
exclude_patterns = ["_build", "_live"]
html_theme = "furo"
html_title = f"hodograph {release}"

# Sphinx reads only what lies under docs/, so the notebooks are copied there (git-ignored)
# at every build; the modification times come along, so an unchanged one is not redone.
here = Path(__file__).resolve().parent
shutil.rmtree(here / "notebooks", ignore_errors=True)
shutil.copytree(
    here.parent / "notebooks",
    here / "notebooks",
    ignore=shutil.ignore_patterns(".ipynb_checkpoints"),
)

# A page for each folder of the package that is not public, with a section for each module.
package = here.parent / "hodograph"
shutil.rmtree(here / "internals", ignore_errors=True)
(here / "internals").mkdir()
for init in sorted(package.glob("*/__init__.py")):
    folder = init.parent.name
    if folder == "laws":  # public: on the page of the API
        continue
    directive = "```{{eval-rst}}\n.. automodule:: hodograph.{}\n   :members:\n```\n"
    page = [f"# {folder}\n", directive.format(folder)]
    for path in sorted(init.parent.glob("[!_]*.py")):
        page += [f"## {folder}/{path.name}\n", directive.format(f"{folder}.{path.stem}")]
    (here / "internals" / f"{folder}.md").write_text("\n".join(page), encoding="utf-8")

# The page for a class, as the package makes it.
(here / "_live").mkdir(exist_ok=True)
(here / "_live" / "explorer.html").write_text(explorer.html(), encoding="utf-8")
html_extra_path = ["_live"]

# Pages with code are executed. One that raises is a warning with its traceback, and so fails a
# build with -W. Notebooks are shown as they are stored: run_notebooks.py keeps them fresh.
nb_execution_mode = "force"
nb_execution_excludepatterns = ["notebooks/*"]
nb_execution_show_tb = True
nb_execution_timeout = 300
nb_merge_streams = True

myst_enable_extensions = ["amsmath", "dollarmath"]
myst_heading_anchors = 3

# Types are told once, in words, by the docstrings; annotations are for the type checker.
autodoc_typehints = "none"
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_rtype = False

# With -n every reference has to resolve. The exceptions are the types in docstrings:
# prose ("float or array_like"), other libraries' names, whose pages are not at hand, and type
# variables.
nitpick_ignore_regex = [("py:class", r"(?!hodograph\.).*|.*\.T")]
