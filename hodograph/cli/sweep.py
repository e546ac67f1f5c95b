"""``hodograph sweep``: a table of d_norm of any size, chunk by chunk, to a file."""

from __future__ import annotations

import argparse
import contextlib
import errno
import logging
import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hodograph.cli.arguments import Parser
from hodograph.cli.streams import FailedError, UsageError, say

MOST = 1e7  # steps of an axis


def _axis(words: str, low: float, high: float, unit: str = "") -> Any:
    """Converter for ``0:10:0.001``, both ends of it, or for numbers between commas."""

    def convert(text: str) -> list[float]:
        where = f"numbers between commas, or START:STOP:STEP{unit}"
        try:
            if ":" in text:
                start, stop, step = (float(part) for part in text.split(":"))
                steps = (stop - start) / step
                if not (step > 0 and 0 <= steps <= MOST):
                    raise ValueError
                values = [start + step * i for i in range(math.floor(steps + 1e-9) + 1)]
                values[-1] = min(values[-1], max(stop, start))
            else:
                values = [float(part) for part in text.split(",")]
        except (ValueError, ZeroDivisionError, OverflowError):
            raise argparse.ArgumentTypeError(
                f"must be {where}, of {MOST:g} steps at most; got {text!r}"
            ) from None
        for value in values:
            if not low <= value <= high:
                raise argparse.ArgumentTypeError(f"must be {words}; got {value:g} in {text!r}")
        return values

    return convert


def _size(text: str) -> float:
    """Bytes: ``64MB``."""
    units = {"kB": 1e3, "MB": 1e6, "GB": 1e9}
    number, unit = text.strip()[:-2], text.strip()[-2:]
    with contextlib.suppress(ValueError):
        if unit in units and 0 < float(number) < math.inf:
            return float(number) * units[unit]
    raise argparse.ArgumentTypeError(f"must be a size such as 64MB (kB, MB, GB); got {text!r}")


def add_sweep(to: Parser) -> None:
    """Its arguments."""
    to.add_argument(
        "--v-norm",
        metavar="AXIS",
        required=True,
        type=_axis("in [0, 1e20]", 0, 1e20),
        help="launch speed over terminal speed: START:STOP:STEP, or numbers between commas",
    )
    to.add_argument(
        "--alpha0",
        metavar="AXIS",
        required=True,
        type=_axis("in [0, 90] degrees", 0, 90, " of degrees"),
        help="launch angle, degrees, likewise",
    )
    to.add_argument(
        "--n",
        metavar="AXIS",
        type=_axis("in [1, 10]", 1, 10),
        default=2.0,
        help="drag exponent, likewise (default 2)",
    )
    to.add_argument(
        "--rtol", metavar="R", type=float, help="relative error that will do (default: exact)"
    )
    to.add_argument(
        "--out", metavar="FILE", type=Path, required=True, help="the table: .zarr, or .nc (netCDF)"
    )
    to.add_argument(
        "--scheduler",
        metavar="WHERE",
        default="processes",
        help="processes (default), threads, or the address of a Dask scheduler",
    )
    to.add_argument(
        "--memory",
        metavar="SIZE",
        type=_size,
        default=64e6,
        help="what the arrays of one chunk may take (default 64MB)",
    )
    to.add_argument("--resume", action="store_true", help="finish a table that was begun")
    to.add_argument("--force", action="store_true", help="replace an existing table")


def sweep(args: argparse.Namespace) -> None:
    """Write the table."""
    import numpy as np

    from hodograph import sweep as library

    try:
        table = library.d_norm(
            v_norm=args.v_norm,
            alpha0=np.deg2rad(args.alpha0),
            n=args.n,
            rtol=args.rtol,
            memory=args.memory,
        )
        with _bar():
            path = library.write(
                table, args.out, scheduler=args.scheduler, resume=args.resume, force=args.force
            )
    except ImportError as error:
        raise FailedError(str(error)) from None
    except (TypeError, ValueError) as error:
        raise UsageError(str(error)) from None
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        raise FailedError(
            f"{args.out}: {error.strerror}; what was finished stays, and --resume goes on with it"
        ) from None
    say(f"wrote {path}")


class _Bar(logging.Handler):
    """How many chunks are done, as a bar."""

    def __init__(self) -> None:
        super().__init__()
        from tqdm import tqdm

        self.bar = tqdm(unit="chunk", file=sys.stderr)

    def emit(self, record: logging.LogRecord) -> None:
        if (total := getattr(record, "total", None)) is not None:
            self.bar.total = total
            self.bar.update(getattr(record, "done", 0) - self.bar.n)


@contextlib.contextmanager
def _bar() -> Iterator[None]:
    """A bar on a terminal, in place of a line for every chunk."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield
        return
    shown, log = _Bar(), logging.getLogger("hodograph")
    others = log.handlers[:]
    log.handlers[:] = [shown]
    try:
        yield
    finally:
        log.handlers[:] = others
        shown.bar.close()
