"""The chunks of a table: which are missing, who computes them, how each is written."""

from __future__ import annotations

import errno
import itertools
import logging
import math
import os
import signal
import sys
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray

UNDER_WAY = 3  # chunks handed out for each worker
NEAR = 64  # chunks along the first dimension whose graph is cut from the whole at once
log = logging.getLogger("hodograph")


def fill(table: xarray.Dataset, part: Path, pool: Executor, width: int) -> None:
    """Compute the chunks that are not there, and write them."""
    import zarr

    group = zarr.open_group(part, mode="r")
    arrays = [group[str(name)] for name in table.data_vars]

    def is_there(index: tuple[int, ...]) -> bool:
        keys = ((array.path, array.metadata.encode_chunk_key(index)) for array in arrays)
        return all((part / path / key).is_file() for path, key in keys)

    missing = [block for block in blocks(table) if not is_there(block[0])]
    total = math.prod(len(lengths) for lengths in table.chunksizes.values())
    done = total - len(missing)
    if not missing:
        return
    waiting, under_way = pieces(table, missing), set[Future[None]]()
    _tell(done, total)
    try:
        while under_way or done < total:
            for chunk, region in itertools.islice(waiting, UNDER_WAY * width - len(under_way)):
                under_way.add(pool.submit(store, chunk, str(part), region))
            finished, under_way = wait(under_way, return_when=FIRST_COMPLETED)
            for future in finished:
                future.result()
                done += 1
            _tell(done, total)
    finally:
        for future in under_way:
            future.cancel()


def blocks(table: xarray.Dataset) -> Iterator[tuple[tuple[int, ...], dict[Any, slice]]]:
    """The place of each chunk among the chunks, and among the cells."""
    dims = next(iter(table.data_vars.values())).dims
    edges = [np.cumsum((0, *table.chunksizes[dim])).tolist() for dim in dims]
    for index in itertools.product(*(range(len(edge) - 1) for edge in edges)):
        places = zip(dims, edges, index, strict=True)
        yield index, {dim: slice(edge[i], edge[i + 1]) for dim, edge, i in places}


def pieces(
    table: xarray.Dataset, places: Iterable[tuple[tuple[int, ...], dict[Any, slice]]]
) -> Iterator[tuple[xarray.Dataset, tuple[slice, ...]]]:
    """The chunks as lazy tables, each with its own part of the graph and no more.

    The whole graph is cut for the neighbours along the first dimension at once, so that what one
    chunk takes does not grow with the table.
    """
    import dask

    whole = table.drop_vars(list(table.coords))
    held, near, first = None, whole, 0
    for index, region in places:
        if index and index[0] // NEAR != held:
            held = index[0] // NEAR
            dim, begin = next(iter(region)), NEAR * held
            lengths = table.chunksizes[dim]
            first = sum(lengths[:begin])
            span = slice(first, first + sum(lengths[begin : begin + NEAR]))
            (near,) = dask.optimize(whole.isel({dim: span}))
        inner = dict(region)
        if index:
            inner[dim] = slice(region[dim].start - first, region[dim].stop - first)
        (chunk,) = dask.optimize(near.isel(inner))
        yield chunk, tuple(region.values())


def store(chunk: xarray.Dataset, part: str, region: tuple[slice, ...]) -> None:
    """Compute one chunk and write it; each of its files takes its name when it is whole."""
    import zarr

    values = chunk.compute(scheduler="synchronous")
    with zarr.config.set({"array.write_empty_chunks": True}):
        group = zarr.open_group(part, mode="r+")
        for name, variable in values.data_vars.items():
            group[str(name)][region] = variable.to_numpy()


def _tell(done: int, total: int) -> None:
    level = logging.INFO if done * 100 % total < 100 or done == total else logging.DEBUG
    log.log(level, "%d of %d chunks", done, total, extra={"done": done, "total": total})


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Threads and processes started here are spared Ctrl-C, which is this process's to answer."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    from multiprocessing import resource_tracker

    # Started among the others it would lift the mask; and it complains, when it has outlived us.
    sys.warnoptions.append("ignore::UserWarning:multiprocessing.resource_tracker")
    resource_tracker.ensure_running()
    sys.warnoptions.pop()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def processes(count: int) -> Any:
    """A Dask cluster of so many processes on this machine.

    Dask has its workers give memory back at once, and glibc then maps every large array afresh,
    which doubles the time of NumPy's arithmetic.  They keep what they have, as a process does by
    itself.
    """
    import dask
    import distributed

    environment = "distributed.nanny.pre-spawn-environ"
    kept = {f"{environment}.MALLOC_{what}_THRESHOLD_": 1 << 30 for what in ("TRIM", "MMAP")}
    with dask.config.set(kept):
        return distributed.LocalCluster(
            n_workers=count,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",
            silence_logs=logging.CRITICAL,
        )


@contextmanager
def workers(scheduler: str) -> Iterator[tuple[Executor, int]]:
    """Where chunks are computed, and how many at a time."""
    cores = os.cpu_count() or 1
    if scheduler == "threads":
        with ThreadPoolExecutor(cores) as pool:
            yield pool, cores
        return
    import distributed

    if scheduler == "processes":
        with uninterrupted():
            cluster = processes(cores)
        with cluster, distributed.Client(cluster) as client:
            try:
                yield client.get_executor(pure=False), cores
            except KeyboardInterrupt:
                cluster.shutdown_on_close = False  # at exit, where it would wait for 10 s
                raise
        return
    try:
        client = distributed.Client(scheduler, timeout="5s")
    except OSError:
        raise OSError(errno.EHOSTUNREACH, "no Dask scheduler answers", scheduler) from None
    with client:
        yield client.get_executor(pure=False), max(sum(client.nthreads().values()), 1)
