"""The commands that make files and measure: ``grid``, ``fit``, ``reproduce``, ``bench`` ..."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Iterable
from pathlib import Path

from hodograph.cli.streams import FailedError, UsageError, put, say


def grid(args: argparse.Namespace) -> None:
    """d_norm tabulated."""
    from hodograph import grid as library
    from hodograph._files import check_targets

    if args.format == "netcdf":
        makers = {args.out / "d_norm.nc": library.save_netcdf}
    else:
        makers = {
            args.out / "d_norm.npz": library.save_npz,
            args.out / "d_norm.csv": library.save_csv,
        }
    check_targets(*makers, force=args.force)
    found = library.tabulate()
    try:
        _wrote([save(found, path, force=args.force) for path, save in makers.items()])
    except ImportError as error:
        raise FailedError(str(error)) from None


def fit(args: argparse.Namespace) -> None:
    """The laws fitted again, and Table 1 searched."""
    from hodograph.builders import laws_report
    from hodograph.paper import table_1
    from hodograph.report import folder

    folder.check(args.out, (*laws_report.FILES, table_1.FILE), force=args.force)
    book, found = laws_report.make(), table_1.search()
    contents = laws_report.contents(book) | {table_1.FILE: table_1.search_csv(found)}
    say("writing")
    folder.write(args.out, contents, force=args.force)
    put(f"{laws_report.summary(book)}\n{table_1.summary(found)}\n")


def reproduce(args: argparse.Namespace) -> None:
    """Every figure, table and claim."""
    from hodograph.paper.report import reproduce as remake
    from hodograph.paper.report import verdict_table

    verdicts = remake(args.out, force=args.force)
    put(verdict_table(verdicts).rstrip("\n") + "\n")


def exercise(args: argparse.Namespace) -> None:
    """The exercise, or its programs with blanks."""
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


def explore(args: argparse.Namespace) -> None:
    """The page for a class: written, or opened in a browser."""
    import tempfile
    import webbrowser

    from hodograph._files import write_whole
    from hodograph.explorer.page import html

    if args.out is not None:
        say(f"wrote {write_whole(args.out, html(), force=args.force)}")
        return
    path = write_whole(Path(tempfile.mkdtemp(prefix="hodograph-")) / "explorer.html", html())
    if not webbrowser.open(path.as_uri()):
        raise FailedError(f"no browser opened; the page is in {path}")
    say(f"opened {path}")


def surrogate(args: argparse.Namespace) -> None:
    """The interpolant and its bounds, or the ways to interpolate compared."""
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


def reference(args: argparse.Namespace) -> None:
    """The reference points."""
    from hodograph.builders import reference_points

    _wrote(reference_points.write(args.out, force=args.force))


def _wrote(paths: Iterable[Path]) -> None:
    for path in paths:
        say(f"wrote {path}")


def bench_speed(args: argparse.Namespace) -> None:
    """Time of arrays."""
    from hodograph.bench import speed

    put(speed.speed_table(speed.bench(args.out, force=args.force)))


def bench_calls(args: argparse.Namespace) -> None:
    """One launch a call, and more."""
    from hodograph.bench import calls

    put(calls.calls_table(calls.bench(args.out, quick=args.quick, force=args.force)))


def bench_stability(args: argparse.Namespace) -> None:
    """Maps of the error."""
    from hodograph.bench import stability

    put(stability.summary_table(stability.bench(args.out, force=args.force)))


def bench_work_precision(args: argparse.Namespace) -> None:
    """Error against cost."""
    from hodograph.bench import work_precision

    put(work_precision.choice_table(work_precision.bench(args.out, force=args.force)))


def bench_aim(args: argparse.Namespace) -> None:
    """Shots at targets."""
    from hodograph.bench import aim

    put(aim.targets_table(aim.measure()))


def bench_sweep(args: argparse.Namespace) -> None:
    """What a sweep costs."""
    from hodograph.bench import sweep

    put(sweep.costs_table(sweep.measure()))


def bench_scene(args: argparse.Namespace) -> None:
    """What each quantity costs."""
    from hodograph.bench import scene

    put(scene.scene_table(scene.measure()))
