"""The command line: ``hodograph range | trajectory | grid | reproduce | exercise | fit | ...``.

Data go to standard output, everything else to standard error.  A command imports what it needs
when it runs, so that a range does not wait for matplotlib.
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import warnings
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NoReturn

from hodograph.cli import launch as cli_launch
from hodograph.cli.arguments import (
    Command,
    Parser,
    add_commands,
    add_exercise,
    add_launch,
    add_out,
    add_points,
    parse,
    parser,
)
from hodograph.cli.streams import (
    FailedError,
    UsageError,
    progress_shown,
    put,
    say,
    show_warning,
)
from hodograph.report.versions import STAMP

DONE, FAILED, USAGE, INTERRUPTED = 0, 1, 2, 130


class _Version(argparse.Action):
    """Looks the version up only when it is asked for."""

    def __call__(self, *_: object) -> NoReturn:
        put(f"{STAMP}\n")
        raise SystemExit(DONE)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments, without the program's name; those of this process by default.

    Returns
    -------
    int
        The exit code: 0 done, 1 failed, 2 wrong usage, 130 interrupted.

    Examples
    --------
    >>> main(["range", "100", "40.924", "--k", "0.001"])
    range          600.841    m
    flight time     11.4291   s
    impact speed    62.6842   m/s
    impact angle   -53.3489   deg
    apex distance  331.753    m
    apex height    161.481    m
    apex time        5.38361  s
    status        converged
    0
    """
    try:
        with warnings.catch_warnings(), progress_shown():
            warnings.showwarning = show_warning
            return _run(sys.argv[1:] if argv is None else argv)
    except KeyboardInterrupt:
        say("interrupted")
        return INTERRUPTED


def _run(argv: Sequence[str]) -> int:
    try:
        args = parse(_parser(), argv)
        args.command(args)
    except SystemExit as done:  # --help, --version
        return int(done.code or DONE)
    except BrokenPipeError:  # the reader, `head` say, has seen enough
        return DONE
    except UsageError as error:
        return _fail(str(error), USAGE)
    except FailedError as error:
        return _fail(str(error), FAILED)
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        hint = " (--force)" if isinstance(error, FileExistsError) and not error.errno else ""
        return _fail(f"{where}{error.strerror or error}{hint}", FAILED)
    except MemoryError:
        return _fail("not enough memory", FAILED)
    except Exception as error:
        return _fail(f"unexpected {type(error).__name__}: {error}", FAILED)
    return DONE


def _fail(message: str, code: int) -> int:
    say(f"error: {message}")
    return code


# --- the commands -------------------------------------------------------------------------


def _grid(args: argparse.Namespace) -> None:
    from hodograph._files import check_targets
    from hodograph.grid import save_csv, save_npz, tabulate

    table, text = args.out / "d_norm.npz", args.out / "d_norm.csv"
    check_targets(table, text, force=args.force)
    grid = tabulate()
    _wrote([save_npz(grid, table, force=args.force), save_csv(grid, text, force=args.force)])


def _fit(args: argparse.Namespace) -> None:
    from hodograph.builders import laws_report
    from hodograph.paper import table_1
    from hodograph.report import folder

    folder.check(args.out, (*laws_report.FILES, table_1.FILE), force=args.force)
    book, found = laws_report.make(), table_1.search()
    contents = laws_report.contents(book) | {table_1.FILE: table_1.search_csv(found)}
    say("writing")
    folder.write(args.out, contents, force=args.force)
    put(f"{laws_report.summary(book)}\n{table_1.summary(found)}\n")


def _reproduce(args: argparse.Namespace) -> None:
    from hodograph.paper.report import reproduce, verdict_table

    verdicts = reproduce(args.out, force=args.force)
    put(verdict_table(verdicts).rstrip("\n") + "\n")


def _exercise(args: argparse.Namespace) -> None:
    from hodograph.exercise.report import carry_out, for_students
    from hodograph.exercise.results import summary
    from hodograph.exercise.setup import Setup
    from hodograph.exercise.words import Words

    names = (field.name for field in dataclasses.fields(Setup))
    given = {name: getattr(args, name, None) for name in names}
    try:
        setup = Setup(**{name: value for name, value in given.items() if value is not None})
    except ValueError as error:
        raise UsageError(str(error)) from None
    if args.student:
        for path in for_students(args.out, setup, force=args.force):
            say(f"wrote {path}")
        return
    words = Words(args.lang)
    put(summary(carry_out(args.out, setup, words, force=args.force), words) + "\n")


def _surrogate(args: argparse.Namespace) -> None:
    if args.compare:
        from hodograph.builders import interpolants
        from hodograph.report import folder

        names = (interpolants.COMPARISON, interpolants.SETTINGS)
        folder.check(args.out, names, force=args.force)
        texts = (interpolants.comparison(interpolants.compare()), interpolants.settings())
        for name, text in zip(names, texts, strict=True):
            put(text)
            _wrote(folder.write(args.out, {name: text}, force=args.force))
        return

    from hodograph.builders import certificate

    _wrote(certificate.write(args.out, force=args.force))


def _reference(args: argparse.Namespace) -> None:
    from hodograph.builders import reference_points

    _wrote(reference_points.write(args.out, force=args.force))


def _wrote(paths: Iterable[Path]) -> None:
    for path in paths:
        say(f"wrote {path}")


def _bench_speed(args: argparse.Namespace) -> None:
    from hodograph.bench import speed

    put(speed.speed_table(speed.bench(args.out, quick=args.quick, force=args.force)))


def _bench_stability(args: argparse.Namespace) -> None:
    from hodograph.bench import stability

    put(stability.summary_table(stability.bench(args.out, force=args.force)))


def _bench_work_precision(args: argparse.Namespace) -> None:
    from hodograph.bench import work_precision

    put(work_precision.choice_table(work_precision.bench(args.out, force=args.force)))


def _bench_scene(args: argparse.Namespace) -> None:
    from hodograph.bench import scene

    put(scene.scene_table(scene.measure()))


# --- their arguments -----------------------------------------------------------------------


def _parser() -> Parser:
    top = parser(
        "hodograph",
        "Projectile flight under quadratic drag, and the paper behind it remade.",
        "hodograph range 40 45 --v-lim 42.7",
        "Exit code: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n\n",
    )
    top.add_argument("--version", nargs=0, action=_Version, help="print the version and exit")
    commands = add_commands(top, "COMMAND", _COMMANDS)
    benches = add_commands(commands["bench"], "WHAT", _BENCHES)

    for name in ("range", "trajectory"):
        add_launch(commands[name])
    commands["range"].add_argument("--json", action="store_true", help="print one JSON object")
    path = commands["trajectory"]
    add_points(path)
    path.add_argument(
        "--to-apex",
        action="store_true",
        help="stop at the highest point, which is there for an unreachable landing too",
    )
    path.add_argument(
        "--out",
        metavar="FILE",
        type=Path,
        help="file to write in place of standard output: .csv, or a plot: .pdf, .png, .svg",
    )
    path.add_argument("--force", action="store_true", help="replace an existing file")

    add_exercise(commands["exercise"])
    commands["surrogate"].add_argument(
        "--compare",
        action="store_true",
        help="instead, other ways to interpolate and the dial measured: surrogate.csv, dial.csv",
    )
    benches["speed"].add_argument(
        "--quick", action="store_true", help="leave out the call with 10^7 launches"
    )
    add_out(benches["speed"], None)
    return top


_COMMANDS = (
    Command(
        "range",
        "range, flight time, impact and apex of one launch",
        "hodograph range 40 45 --v-lim 42.7 --height 1",
        cli_launch.range_,
    ),
    Command(
        "trajectory",
        "points of one trajectory, as CSV or as a plot",
        "hodograph trajectory 40 45 --v-lim 42.7 --out path.svg",
        cli_launch.trajectory,
    ),
    Command(
        "grid",
        "d_norm tabulated, written to d_norm.npz and d_norm.csv",
        "hodograph grid --out tables",
        _grid,
        ".",
    ),
    Command(
        "reproduce",
        "every figure, table and claim of the paper, with a verdict",
        "hodograph reproduce",
        _reproduce,
        "reproduction",
    ),
    Command(
        "exercise",
        "the teaching exercise carried out: figures, numbers, programs, a page",
        "hodograph exercise --mass 2 --angle 30 --lang fr",
        _exercise,
        "exercise",
    ),
    Command(
        "fit",
        "the library's laws fitted again, and all laws compared",
        "hodograph fit",
        _fit,
        "laws",
    ),
    Command(
        "reference",
        "answers to 30 digits, written to reference*.csv",
        "hodograph reference --out tables",
        _reference,
        ".",
    ),
    Command(
        "surrogate",
        "the surrogate and the error bounds of the dial, written to surrogate.npz, bounds.json",
        "hodograph surrogate --out tables",
        _surrogate,
        ".",
    ),
    Command(
        "bench",
        "measured against other ways to compute: time, or error",
        "hodograph bench scene",
    ),
    Command("help", "this page, or that of a command", "hodograph help range"),
)
_BENCHES = (
    Command(
        "speed",
        "time and memory, beside other ways",
        "hodograph bench speed --quick",
        _bench_speed,
    ),
    Command(
        "stability",
        "maps of the relative error, method by method",
        "hodograph bench stability --out maps",
        _bench_stability,
        ".",
    ),
    Command(
        "work-precision",
        "error against time a launch, and what to use",
        "hodograph bench work-precision",
        _bench_work_precision,
        "work_precision",
    ),
    Command(
        "scene",
        "what each quantity of a scene costs a launch",
        "hodograph bench scene",
        _bench_scene,
    ),
)
