"""The command line: ``hodograph range | trajectory | grid | reproduce | exercise | fit | ...``.

Data go to standard output, everything else to standard error.  A command imports what it needs
when it runs, so that a range does not wait for matplotlib.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Sequence
from typing import NoReturn

from hodograph.cli import calibrate, launch, makers, options, reach, sweep
from hodograph.cli.arguments import Command, Parser, add_commands, add_out, parse, parser
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

    for name, add in (
        ("range", options.add_range),
        ("at", options.add_at),
        ("trajectory", options.add_trajectory),
        ("aim", options.add_aim),
        ("least-speed", options.add_least_speed),
        ("best", options.add_best),
        ("calibrate", calibrate.add_calibrate),
        ("exercise", options.add_exercise),
        ("explore", options.add_explore),
    ):
        add(commands[name])
    commands["surrogate"].add_argument(
        "--compare",
        action="store_true",
        help="instead, other ways to interpolate and the dial measured: surrogate.csv, dial.csv",
    )
    benches["calls"].add_argument(
        "--quick", action="store_true", help="leave out calls with more than 10^5 launches"
    )
    sweep.add_sweep(commands["sweep"])
    commands["grid"].add_argument(
        "--format",
        choices=("npz", "netcdf"),
        default="npz",
        help="npz (default): d_norm.npz and d_norm.csv; netcdf: d_norm.nc (extra sweep)",
    )
    add_out(benches["speed"], None)
    return top


_COMMANDS = (
    Command(
        "range",
        "range, flight time, impact and apex of a launch or several",
        "hodograph range 90mph 30,40,50 --body baseball --height 1",
        launch.range_,
    ),
    Command(
        "at",
        "where a launch is at a time, a distance, a height or a length of path",
        "hodograph at 28m/s 17 --body soccer --x 9.15",
        launch.at,
    ),
    Command(
        "trajectory",
        "points of a trajectory or several, as CSV or as a plot",
        "hodograph trajectory 40 30,45,60 --v-lim 42.7 --out path.svg",
        launch.trajectory,
    ),
    Command(
        "aim",
        "the launch angle that hits a target",
        "hodograph aim 9 4.2 1.05 --body basketball --arc high",
        reach.aim,
    ),
    Command(
        "least-speed",
        "the least launch speed that reaches a target, and its angle",
        "hodograph least-speed 400ft 2 --body baseball",
        reach.least_speed,
    ),
    Command(
        "best",
        "launch angle of greatest range",
        "hodograph best 14m/s --body shot --height 2",
        reach.best,
    ),
    Command(
        "calibrate",
        "drag and launch out of the track of a film, with their uncertainties",
        "hodograph calibrate ball.csv --mass 430g --diameter 22cm --out ball.png",
        calibrate.calibrate,
    ),
    Command(
        "grid",
        "d_norm tabulated, written to d_norm.npz and d_norm.csv",
        "hodograph grid --out tables",
        makers.grid,
        ".",
    ),
    Command(
        "sweep",
        "d_norm over any number of speeds, angles and exponents, to a file (extra sweep)",
        "hodograph sweep --v-norm 0:10:0.01 --alpha0 0:90:0.5 --out table.zarr",
        sweep.sweep,
    ),
    Command(
        "reproduce",
        "every figure, table and claim of the paper, with a verdict",
        "hodograph reproduce",
        makers.reproduce,
        "reproduction",
    ),
    Command(
        "exercise",
        "the teaching exercise carried out: figures, numbers, programs, a page",
        "hodograph exercise --mass 2 --angle 30 --lang fr",
        makers.exercise,
        "exercise",
    ),
    Command(
        "explore",
        "a web page for a class, exact and without a network, opened or written",
        "hodograph explore --out explorer.html",
        makers.explore,
    ),
    Command(
        "fit",
        "the library's laws fitted again, and all laws compared",
        "hodograph fit",
        makers.fit,
        "laws",
    ),
    Command(
        "reference",
        "answers to 30 digits, written to reference*.csv",
        "hodograph reference --out tables",
        makers.reference,
        ".",
    ),
    Command(
        "surrogate",
        "the surrogate and the error bounds of the dial, written to surrogate.npz, bounds.json",
        "hodograph surrogate --out tables",
        makers.surrogate,
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
        "time of arrays, beside other ways",
        "hodograph bench speed",
        makers.bench_speed,
    ),
    Command(
        "calls",
        "one launch a call, way by way; time and memory from 1 to 10^7 launches a call",
        "hodograph bench calls --quick",
        makers.bench_calls,
        "calls",
    ),
    Command(
        "stability",
        "maps of the relative error, method by method",
        "hodograph bench stability --out maps",
        makers.bench_stability,
        ".",
    ),
    Command(
        "work-precision",
        "error against time a launch, and what to use",
        "hodograph bench work-precision",
        makers.bench_work_precision,
        "work_precision",
    ),
    Command(
        "scene",
        "what each quantity of a scene costs a launch",
        "hodograph bench scene",
        makers.bench_scene,
    ),
    Command(
        "aim",
        "shots at targets, beside ballistic-solver: time, and the miss",
        "hodograph bench aim",
        makers.bench_aim,
    ),
    Command(
        "sweep",
        "what a sweep costs: processes, memory, chunks, the file (extra sweep)",
        "hodograph bench sweep",
        makers.bench_sweep,
    ),
)
