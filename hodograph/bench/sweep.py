"""What a sweep costs beside one call: processes, memory, chunks and the file (extra `sweep`)."""

from __future__ import annotations

import math
import os
import tempfile
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from hodograph import sweep
from hodograph.bench.by_size import in_a_process
from hodograph.engine import chunks
from hodograph.level import d_norm
from hodograph.report import clock, tables

CELLS, CHUNKS, MANY_CHUNKS = 4_000_000, 8, 400
SIZES = (1_000_000, 4_000_000, 16_000_000)  # whose memory is measured


@dataclass(frozen=True)
class Costs:
    """Seconds, bytes and MB: see `costs_table`."""

    cells: int
    call: float  # one call on the whole array
    start: float  # of two processes
    one: float  # process, the table written
    two: float
    chunk: float  # each chunk more, in one process
    disk: float  # bytes on disk a cell
    file: float  # reading back and writing what is computed, no drag in it
    netcdf: float  # from the chunks to one file
    memory: dict[int, float]  # MB of the process at its peak, by the cells of the table


def _axes(cells: int) -> dict[str, Any]:
    speeds = round(math.sqrt(cells))
    return {
        "v_norm": np.linspace(0.1, 10, speeds),
        "alpha0": np.deg2rad(np.linspace(5, 89.9, cells // speeds)),
    }


def _table(cells: int, chunks: int, rtol: float | None = None) -> Any:
    """A table of so many cells in about so many chunks."""
    whole = sweep.d_norm(**_axes(cells))
    per_cell = sweep.MEMORY / math.prod(max(length) for length in whole.chunksizes.values())
    return sweep.d_norm(**_axes(cells), rtol=rtol, memory=per_cell * cells / chunks)


@contextmanager
def _processes(count: int) -> Iterator[str]:
    """The address of so many worker processes."""
    with chunks.processes(count) as cluster:
        yield cluster.scheduler_address


def _timed(function: Any, *args: Any, **options: Any) -> float:
    begun = perf_counter()
    function(*args, **options)
    return perf_counter() - begun


def measure(cells: int = CELLS, sizes: tuple[int, ...] = SIZES) -> Costs:
    """Time a table of so many cells, and the memory of tables of those sizes."""
    axes = _axes(cells)
    with clock.one_core():
        call = _timed(d_norm, axes["v_norm"][:, np.newaxis], axes["alpha0"])
    table = _table(cells, CHUNKS)
    quick = [_table(cells, count, 1e-3) for count in (CHUNKS, MANY_CHUNKS)]
    counts = [one.d_norm.data.npartitions for one in quick]  # as rows can be divided
    warm = sweep.d_norm(v_norm=[1.0, 2.0], alpha0=[0.5, 1.0], memory=1)
    spent = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "table.zarr")
        for count in (1, 2):
            begun = perf_counter()
            with _processes(count) as address:
                start = perf_counter() - begun
                for one in (warm, *quick, table):
                    spent.append(_timed(sweep.write, one, path, scheduler=address, force=True))
        _, few, many, single, _, _, _, double = spent
        disk = sum(file.stat().st_size for file in path.rglob("*") if file.is_file()) / cells
        stored = sweep._opened(path)
        begun = perf_counter()
        sweep.write(stored, f"{folder}/copy.zarr", scheduler="threads")
        file = perf_counter() - begun
        begun = perf_counter()
        sweep.write(stored, f"{folder}/copy.nc", scheduler="threads")
        netcdf = perf_counter() - begun - file
    memory = {size: peak_memory(size) for size in sizes}
    return Costs(
        cells,
        call,
        start,
        single,
        double,
        (many - few) / (counts[1] - counts[0]),
        disk,
        file,
        netcdf,
        memory,
    )


def peak_memory(cells: int) -> float:
    """MB that a process of its own has at its peak, writing a table of so many cells.

    NaN where the system does not say.
    """
    script = (
        "import tempfile\n"
        "from hodograph import sweep\n"
        "from hodograph.bench.by_size import resident\n"
        "from hodograph.bench.sweep import _axes\n"
        "with tempfile.TemporaryDirectory() as folder:\n"
        f"    table = sweep.d_norm(**_axes({cells}), rtol=1e-3)\n"
        "    sweep.write(table, folder + '/table.zarr', scheduler='threads')\n"
        "print(resident('VmHWM'))\n"
    )
    return in_a_process(script, f"the table of {cells} cells")


def costs_table(costs: Costs) -> str:
    """The costs as plain text."""
    micro = 1e6 / costs.cells
    rows = [
        ("one call on the whole array", f"{costs.call * micro:.3g} µs a cell"),
        ("a sweep, one process", f"{costs.one * micro:.3g} µs a cell"),
        ("a sweep, two processes", f"{costs.two * micro:.3g} µs a cell"),
        ("two processes over one", f"{costs.one / costs.two:.2f} times as quick"),
        ("to start two processes", f"{costs.start:.2g} s"),
        ("a chunk more", f"{1e3 * costs.chunk:.2g} ms"),
        ("to write the file, with nothing to compute", f"{costs.file * micro:.2g} µs a cell"),
        ("to make one netCDF file of it", f"{costs.netcdf * micro:.2g} µs a cell"),
        ("on disk", f"{costs.disk:.2g} bytes a cell"),
        *(
            (f"memory at the peak, {size:.0e} cells", f"{held:.0f} MB")
            for size, held in costs.memory.items()
        ),
    ]
    words = (
        f"A table of {costs.cells:.0e} cells, v_norm from 0.1 to 10 and alpha0 from 5 to 89.9 "
        f"degrees, in {CHUNKS} chunks ({MANY_CHUNKS} for the cost of a chunk); "
        f"{os.cpu_count()} cores. Processes were running before they were timed. Memory is that of "
        "a process with threads, which computes to 1e-3, chunks of "
        f"{sweep.MEMORY / 1e6:.0f} MB."
    )
    lines = tables.plain(("what", "measured"), rows)
    return "\n".join([*lines, "", textwrap.fill(words, 90)]) + "\n"
