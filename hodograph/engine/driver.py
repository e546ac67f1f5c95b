"""The one driver: what is done to every call, so that kernels see flat arrays and nothing else.

A public function checks and broadcasts its arguments with `domain.broadcast`, and hands them to
`apply` with a kernel.  A kernel takes flat arrays without NaN, of a size that the cache holds,
and returns its rows and a status for each element.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hodograph.engine.domain import FloatArray
from hodograph.engine.status import Status

BLOCK = 16384  # elements worked on at once, whatever the size of the input
FEW = 16  # launches in plain floats take no longer than in arrays

Codes: TypeAlias = NDArray[np.int8]
Kernel: TypeAlias = Callable[..., tuple[Sequence[FloatArray], Codes]]


def apply(
    kernel: Kernel,
    shape: tuple[int, ...],
    arrays: Sequence[FloatArray],
    rows: int,
    *,
    inner: tuple[int, ...] = (),
    exponent: int | None = None,
    alone: Callable[..., Any] | None = None,
    what: str = "landing",
    always: int = 0,
) -> tuple[list[Any], Any]:
    """The rows of a kernel over all elements, and their status, in the shape of the arguments.

    Parameters
    ----------
    kernel : callable
        Takes one block of each array, and returns the rows and the codes.
    shape : tuple of int
        The shape of the results; a NumPy scalar where it is empty.
    arrays : sequence of ndarray
        The arguments, checked and of one size.
    rows : int
        How many rows the kernel returns.
    inner : tuple of int, optional
        The shape of what a row holds for one element.
    exponent : int, optional
        Which argument is the drag exponent: linear and quadratic drag are then handed over apart.
    alone : callable, optional
        What the kernel does, of one launch in plain floats: its row or rows, or None where the
        kernel is to answer.  Up to `FEW` launches are asked so.
    what : str, optional
        What did not converge, in the words of the warning.
    always : int, optional
        How many of the rows, the last ones, hold for what is unreachable too.

    Returns
    -------
    rows : list of ndarray
        NaN wherever the status is not 0, but for the last ones as `always` says.
    status : ndarray of int8
        A `Status` for each element.

    Warns
    -----
    RuntimeWarning
        Some elements did not converge; one warning for the call.
    """
    flat = [np.reshape(array, -1) for array in arrays]
    size = flat[0].size
    results = np.full((rows, size, *inner), np.nan)
    status = np.full(size, Status.INVALID, np.int8)
    if alone is not None and size <= FEW:
        for i, launch in enumerate(zip(*(array.tolist() for array in flat), strict=True)):
            if (found := alone(*launch)) is not None:
                results[:, i], status[i] = found, Status.CONVERGED
    for first in range(0, size, BLOCK):
        parts = [array[first : first + BLOCK] for array in flat]
        for members in _groups(parts, exponent):
            if alone is not None and size <= FEW:
                members = members[status[members] == Status.INVALID]  # those left
            if not members.size:
                continue
            values, codes = kernel(*(part[members] for part in parts))
            done = codes == Status.CONVERGED
            at = first + members
            status[at] = codes
            told = done | (codes == Status.UNREACHABLE)
            for number, (result, value) in enumerate(zip(results, values, strict=True)):
                some = done if number < rows - always else told
                result[at[some]] = value if some.all() else value[some]
    failed = int(np.count_nonzero(status == Status.NOT_CONVERGED))
    if failed:
        warnings.warn(
            f"{what} not converged for {failed} of {size} launches (NaN returned)",
            RuntimeWarning,
            stacklevel=3,
        )
    shaped = [result.reshape((*shape, *inner))[()] for result in results]
    return shaped, status.reshape(shape)[()]


def _groups(parts: list[FloatArray], exponent: int | None) -> list[NDArray[np.intp]]:
    """Where there is no NaN; linear drag, quadratic drag and any other apart."""
    valid = ~np.isnan(parts[0])
    for part in parts[1:]:
        valid &= ~np.isnan(part)
    if exponent is None:
        return [np.flatnonzero(valid)]
    n = parts[exponent]
    first = n[0] if n.size else 2.0
    if first in (1.0, 2.0) and (n == first).all():  # as a rule
        return [np.flatnonzero(valid)]
    square, linear = n == 2, n == 1
    masks = (square, linear, ~square & ~linear)
    return [np.flatnonzero(valid & mask) for mask in masks]
