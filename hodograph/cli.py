"""The command line: ``hodograph range | trajectory | grid | reproduce | exercise | fit | ...``.

Data go to standard output, everything else to standard error.  A command imports what it needs
when it runs, so that a range does not wait for matplotlib.
"""

from __future__ import annotations

import argparse
import contextlib
import errno
import json
import math
import os
import sys
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, TextIO

import numpy as np

if TYPE_CHECKING:
    from hodograph.launch import Launch

DONE, FAILED, USAGE, INTERRUPTED = 0, 1, 2, 130
PLOTS = (".pdf", ".png", ".svg")
MOST_POINTS = 1_000_000


class _UsageError(Exception):
    """The command line asks for something that cannot be."""


class _FailedError(Exception):
    """The command was understood and has no result."""


class _Parser(argparse.ArgumentParser):
    """A parser that prints as the commands do: see `_put` and `_fail`."""

    def print_help(self, file: object = None) -> None:
        _put(self.format_help())

    def error(self, message: str) -> NoReturn:
        raise _UsageError(f"{message} (see {self.prog} --help)")


class _Version(argparse.Action):
    """Looks the version up only when it is asked for."""

    def __call__(self, *_: object) -> NoReturn:
        from importlib.metadata import version

        _put(f"hodograph {version('hodograph')}\n")
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
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning
            return _run(sys.argv[1:] if argv is None else argv)
    except KeyboardInterrupt:
        _say("interrupted")
        return INTERRUPTED


def _run(argv: Sequence[str]) -> int:
    try:
        args = _parser().parse_args(_shield(argv))
        args.command(args)
    except SystemExit as done:  # --help, --version
        return int(done.code or DONE)
    except BrokenPipeError:  # the reader, `head` say, has seen enough
        return DONE
    except _UsageError as error:
        return _fail(str(error), USAGE)
    except _FailedError as error:
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


# --- the commands -------------------------------------------------------------------------


def _range(args: argparse.Namespace) -> None:
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = _launch(args)
        landing, apex = launch.landing(), launch.apex()
    results = {
        "range_m": _across(args, landing.x),
        "flight_time_s": landing.t,
        "impact_speed_m_per_s": landing.speed,
        "impact_angle_deg": math.degrees(landing.alpha),
        "apex_distance_m": _across(args, apex[0]),
        "apex_height_m": apex[1],
        "apex_time_s": apex[2],
    }
    status = _STATUS[int(landing.status)]
    if args.json:
        known = {key: _finite_or_none(value) for key, value in results.items()}
        _put(json.dumps(known | {"status": status.word}) + "\n")
    else:
        rows = zip(_ROWS, results.values(), strict=True)
        _put(_table([(name, _digits(value), unit) for (name, unit), value in rows], status.word))
    _require_landing(launch, status)
    if not all(map(math.isfinite, results.values())):
        raise _FailedError("a result is beyond the range of double precision")


def _trajectory(args: argparse.Namespace) -> None:
    out: Path | None = args.out
    if out is not None:
        if out.suffix.lower() not in (".csv", *PLOTS):
            words = f"{', '.join(('.csv', *PLOTS[:-1]))} or {PLOTS[-1]}"
            raise _UsageError(f"argument --out: must end in {words}; got {str(out)!r}")
        from hodograph.files import check_targets, write_whole

        check_targets(out, force=args.force)
    with np.errstate(all="ignore"):  # what overflows is reported below
        launch = _launch(args)
        path = launch.trajectory(args.n)
        if np.isnan(path.t).any():
            _require_landing(launch, _STATUS[int(launch.landing().status)])
    across = _across(args, path.x)
    columns = [path.t, across, path.y, path.speed, _degrees(path.alpha), path.s]
    if not all(map(math.isfinite, (column.max() for column in columns))):
        raise _FailedError("a result is beyond the range of double precision")
    content: str | bytes
    if out is None or out.suffix.lower() == ".csv":
        content = _csv(args, columns)
    else:
        content = _plot(args, across, path.y, out.suffix.lower()[1:])
    if out is None:
        assert isinstance(content, str)
        _put(content)
        return
    _say(f"wrote {write_whole(out, content, force=args.force)}")


def _grid(args: argparse.Namespace) -> None:
    from hodograph.files import check_targets
    from hodograph.grid import save_csv, save_npz, tabulate

    table, text = args.out / "d_norm.npz", args.out / "d_norm.csv"
    check_targets(table, text, force=args.force)
    grid = tabulate()
    _say(f"wrote {save_npz(grid, table, force=args.force)}")
    _say(f"wrote {save_csv(grid, text, force=args.force)}")


def _fit(args: argparse.Namespace) -> None:
    from hodograph.lawbook import remake, summary

    _put(summary(remake(args.out, force=args.force, progress=_say)).rstrip("\n") + "\n")


def _reproduce(args: argparse.Namespace) -> None:
    from hodograph.report import reproduce, verdict_table

    verdicts = reproduce(args.out, force=args.force, progress=_say)
    _put(verdict_table(verdicts).rstrip("\n") + "\n")


def _exercise(args: argparse.Namespace) -> None:
    from hodograph.exercise_report import carry_out
    from hodograph.exercise_results import summary

    _put(summary(carry_out(args.out, force=args.force, progress=_say)) + "\n")


def _surrogate(args: argparse.Namespace) -> None:
    if args.compare:
        from hodograph import candidates
        from hodograph.files import check_targets, write_whole

        targets = [args.out / name for name in (candidates.COMPARISON, candidates.SETTINGS)]
        check_targets(*targets, force=args.force)
        ways = candidates.comparison(candidates.compare(progress=_say))
        texts = (ways, candidates.settings(progress=_say))
        for target, text in zip(targets, texts, strict=True):
            _put(text)
            _say(f"wrote {write_whole(target, text, force=args.force)}")
        return

    from hodograph import certify

    for path in certify.write(args.out, force=args.force, progress=_say):
        _say(f"wrote {path}")


def _reference(args: argparse.Namespace) -> None:
    from hodograph.points import write

    for path in write(args.out, force=args.force, progress=_say):
        _say(f"wrote {path}")


def _bench_speed(args: argparse.Namespace) -> None:
    from hodograph import timing
    from hodograph.files import check_targets, write_whole

    target = None if args.out is None else args.out / "speed.csv"
    if target is not None:
        check_targets(target, force=args.force)
    many = None if args.quick else timing.MANY
    speed = timing.measure(many=many, progress=_say)
    if target is not None:
        _say(f"wrote {write_whole(target, timing.csv_text(speed), force=args.force)}")
    _put(timing.speed_table(speed))


def _bench_stability(args: argparse.Namespace) -> None:
    from hodograph import stability

    maps = stability.bench_stability(args.out, force=args.force, progress=_say)
    _put(stability.summary_table(maps))


def _bench_trade(args: argparse.Namespace) -> None:
    from hodograph import trade, trade_report

    points = trade_report.bench_trade(args.out, force=args.force, progress=_say)
    _put(trade.choice_table(points))


def _bench_scene(args: argparse.Namespace) -> None:
    from hodograph import scene

    _put(scene.scene_table(scene.measure(progress=_say)))


# --- launches and their results -----------------------------------------------------------


class _Status(NamedTuple):
    word: str
    explanation: str


# In the order of `flight.CONVERGED`, `UNREACHABLE`, `NOT_CONVERGED`.
_STATUS = (
    _Status("converged", ""),
    _Status("unreachable", "the landing height is never reached"),
    _Status("not converged", "the landing could not be computed"),
)
_ROWS = (
    ("range", "m"),
    ("flight time", "s"),
    ("impact speed", "m/s"),
    ("impact angle", "deg"),
    ("apex distance", "m"),
    ("apex height", "m"),
    ("apex time", "s"),
)


def _launch(args: argparse.Namespace) -> Launch:
    from hodograph.launch import Launch

    alpha0 = math.radians(args.angle)
    options = {"g": args.g, "height": args.height}
    try:
        if args.v_lim is None:
            return Launch.from_drag(args.v0, alpha0, args.k, **options)
        return Launch(args.v0, alpha0, args.v_lim, **options)
    except ValueError as error:  # the arguments are good one by one, but not together
        raise _UsageError(str(error)) from None


def _require_landing(launch: Launch, status: _Status) -> None:
    if status.word == "unreachable":
        short = f"the apex is {-launch.apex()[1]:.6g} m below it"
        raise _FailedError(f"{status.explanation}: {short}")
    if status.explanation:
        raise _FailedError(status.explanation)


def _across(args: argparse.Namespace, x: Any) -> Any:
    """Horizontal distance: none straight up, where the cosine of pi/2 rounded is not zero."""
    return 0 * x if args.angle == 90 else x


def _degrees(alpha: Any) -> Any:
    return alpha * (180 / math.pi)


def _finite_or_none(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _digits(value: float) -> str:
    """Six significant digits; a dash where there is no landing."""
    if math.isnan(value):
        return "-"
    if 1e-4 <= abs(value) < 1e6:
        return f"{value:#.6g}".rstrip(".")
    return f"{abs(value) and value:.6g}"


def _table(rows: Sequence[tuple[str, str, str]], status: str) -> str:
    """Names, values with their decimal points in one column, units."""
    parts = [(name, *value.partition("."), unit) for name, value, unit in rows]
    name_width = max(len(name) for name, *_ in parts)
    whole_width = max(len(whole) for _, whole, *_ in parts)
    tail_width = max(len(point + tail) for _, _, point, tail, _ in parts)
    lines = [
        f"{name:<{name_width}}  {whole:>{whole_width}}{point + tail:<{tail_width}}  {unit}"
        for name, whole, point, tail, unit in parts
    ]
    return "\n".join([*lines, f"{'status':<{name_width}}  {status}"]) + "\n"


def _scene(args: argparse.Namespace) -> str:
    """The launch in words, as it was given."""
    drag = f"v_lim = {args.v_lim:.16g} m/s" if args.k is None else f"k = {args.k:.16g} /m"
    return (
        f"v0 = {args.v0:.16g} m/s, angle = {args.angle:.16g} deg, {drag}, "
        f"g = {args.g:.16g} m/s^2, height = {args.height:.16g} m"
    )


def _csv(args: argparse.Namespace, columns: Sequence[Any]) -> str:
    from importlib.metadata import version

    lines = [
        f"# hodograph {version('hodograph')}: {_scene(args)}",
        "# units: t s, x m, y m above the landing plane, speed m/s, alpha_deg deg, "
        "s m along the path",
        "t,x,y,speed,alpha_deg,s",
    ]
    values = zip(*(column.tolist() for column in columns), strict=True)
    lines += [",".join(map(repr, row)) for row in values]
    return "\n".join(lines) + "\n"


def _plot(args: argparse.Namespace, x: Any, y: Any, form: str) -> bytes:
    """The path, in one of `PLOTS`; the same launch gives the same bytes."""
    import io

    from matplotlib import rc_context
    from matplotlib.figure import Figure

    stream = io.BytesIO()
    undated = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}
    with rc_context({"svg.hashsalt": "hodograph"}):
        figure = Figure(figsize=(7, 4), layout="constrained")
        axes = figure.add_subplot(
            xlabel="distance x (m)", ylabel="height y above the landing plane (m)"
        )
        axes.plot(x, y)
        axes.axhline(0, color="0.6", linewidth=0.8)
        axes.set_title(_scene(args), fontsize="small")
        axes.grid(alpha=0.3)
        figure.savefig(stream, format=form, dpi=150, metadata=undated.get(form))
    return stream.getvalue()


# --- arguments -----------------------------------------------------------------------------


def _number(words: str, holds: Callable[[float], bool]) -> Callable[[str], float]:
    """Converter for a number for which `holds`."""

    def convert(text: str) -> float:
        text = text.strip()
        try:
            value = float(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be a number; got {text!r}") from None
        overflow = math.isinf(value) and "inf" not in text.lower()
        if overflow or not holds(value):  # NaN holds nowhere
            raise argparse.ArgumentTypeError(f"must be {words}; got {text!r}")
        return value

    return convert


def _points(text: str) -> int:
    try:
        number = int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be an integer; got {text.strip()!r}") from None
    if not 2 <= number <= MOST_POINTS:
        raise argparse.ArgumentTypeError(f"must be from 2 to {MOST_POINTS}; got {number}")
    return number


def _shield(argv: Sequence[str]) -> list[str]:
    """Negative numbers with a space in front, so that argparse takes none for an option."""
    shielded: list[str] = []
    for text in argv:
        negative = text.startswith("-")
        if negative and not (shielded and shielded[-1] == "--out"):
            with contextlib.suppress(ValueError):
                float(text)
                text = f" {text}"
        shielded.append(text)
    return shielded


def _add_launch(parser: argparse.ArgumentParser) -> None:
    finite = math.isfinite
    parser.add_argument(
        "v0",
        metavar="V0",
        type=_number("finite and >= 0", lambda v: finite(v) and v >= 0),
        help="launch speed, m/s",
    )
    parser.add_argument(
        "angle",
        metavar="ANGLE",
        type=_number("in (-90, 90] degrees", lambda a: -90 < a <= 90),
        help="launch angle above the horizontal, degrees, in (-90, 90]",
    )
    drag = parser.add_mutually_exclusive_group(required=True)
    drag.add_argument(
        "--v-lim",
        metavar="V",
        type=_number("> 0 (inf is vacuum)", lambda v: v > 0),
        help="terminal speed of fall, m/s; inf is vacuum",
    )
    drag.add_argument(
        "--k",
        metavar="K",
        type=_number("finite and >= 0", lambda k: finite(k) and k >= 0),
        help="drag coefficient over mass, 1/m, in place of --v-lim; 0 is vacuum",
    )
    parser.add_argument(
        "--g",
        metavar="G",
        default=9.81,
        type=_number("finite and > 0", lambda g: finite(g) and g > 0),
        help="gravity, m/s^2 (default 9.81)",
    )
    parser.add_argument(
        "--height",
        metavar="H",
        default=0.0,
        type=_number("finite", finite),
        help="height of the launch above the landing plane, m; negative if below (default 0)",
    )


def _add_out(parser: argparse.ArgumentParser, default: str | None) -> None:
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        default=None if default is None else Path(default),
        help=f"folder to write to, made if need be (default {default or 'is to write nothing'})",
    )
    parser.add_argument("--force", action="store_true", help="replace existing files")


def _parser() -> _Parser:
    parser = _Parser(
        prog="hodograph",
        description="Projectile flight under quadratic drag, and the paper behind it remade.",
        epilog="Exit code: 0 done, 1 failed, 2 wrong usage.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", nargs=0, action=_Version, help="print the version and exit")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    add = partial(_add_command, commands)

    one = add("range", _range, "range, flight time, impact and apex of one launch")
    _add_launch(one)
    one.add_argument("--json", action="store_true", help="print one JSON object")

    path = add("trajectory", _trajectory, "points of one trajectory, as CSV or as a plot")
    _add_launch(path)
    path.add_argument(
        "-n", metavar="N", type=_points, default=200, help="number of points (default 200)"
    )
    path.add_argument(
        "--out",
        metavar="FILE",
        type=Path,
        help="file to write in place of standard output: .csv, or a plot: .pdf, .png, .svg",
    )
    path.add_argument("--force", action="store_true", help="replace an existing file")

    _add_out(add("grid", _grid, "d_norm tabulated, written to d_norm.npz and d_norm.csv"), ".")
    _add_out(
        add("reproduce", _reproduce, "every figure, table and claim of the paper, with a verdict"),
        "reproduction",
    )
    _add_out(
        add("exercise", _exercise, "the teaching exercise carried out: figures, numbers, a page"),
        "exercise",
    )
    _add_out(add("fit", _fit, "the library's laws fitted again, and all laws compared"), "laws")
    _add_out(
        add("reference", _reference, "answers to 30 digits, written to reference*.csv"),
        ".",
    )
    words = "the surrogate and the error bounds of the dial, written to surrogate.npz, bounds.json"
    built = add("surrogate", _surrogate, words)
    built.add_argument(
        "--compare",
        action="store_true",
        help="instead, other ways to interpolate and the dial measured: surrogate.csv, dial.csv",
    )
    _add_out(built, ".")

    bench = add("bench", None, "measured against other ways to compute: time, or error")
    benches = bench.add_subparsers(metavar="WHAT", required=True)
    speed = _add_command(benches, "speed", _bench_speed, "time and memory, beside other ways")
    speed.add_argument("--quick", action="store_true", help="leave out the call with 10^7 launches")
    _add_out(speed, None)
    _add_out(
        _add_command(
            benches, "stability", _bench_stability, "maps of the relative error, method by method"
        ),
        ".",
    )
    _add_out(
        _add_command(
            benches, "trade", _bench_trade, "error against time a launch, and what to use"
        ),
        "trade",
    )
    _add_command(benches, "scene", _bench_scene, "what each quantity of a scene costs a launch")
    return parser


def _add_command(
    commands: argparse._SubParsersAction[_Parser],
    name: str,
    command: Callable[[argparse.Namespace], None] | None,
    words: str,
) -> _Parser:
    """A command; None where the commands below it do the work."""
    added = commands.add_parser(
        name, help=words, description=f"{words[0].upper()}{words[1:]}.", allow_abbrev=False
    )
    if command is not None:
        added.set_defaults(command=command)
    return added


# --- the two streams -----------------------------------------------------------------------


def _put(text: str) -> None:
    """Data, to standard output; what its encoding lacks becomes a question mark."""
    if sys.stdout is None:
        raise OSError(errno.EBADF, "standard output is closed")
    encoding = sys.stdout.encoding or "utf-8"
    try:
        sys.stdout.write(text.encode(encoding, "replace").decode(encoding))
        sys.stdout.flush()
    except OSError:
        _abandon_stdout()
        raise


def _abandon_stdout() -> None:
    """Send what is still to be flushed nowhere, so that Python's exit does not fail on it."""
    with contextlib.suppress(OSError), open(os.devnull, "wb") as nowhere:
        os.dup2(nowhere.fileno(), sys.stdout.fileno())


def _say(message: str) -> None:
    """One line of diagnostics, to standard error.

    In one write, as `print` does not do: an interruption within would leave a line without its end.
    """
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            sys.stderr.write(f"hodograph: {' '.join(message.split())}\n")
            sys.stderr.flush()


def _fail(message: str, code: int) -> int:
    _say(f"error: {message}")
    return code


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    _say(f"warning: {message}")
