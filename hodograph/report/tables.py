"""Tables: as plain text for the terminal, and as CSV that says where it comes from."""

import csv
import io
import math
import textwrap
from collections.abc import Collection, Iterable, Sequence

from hodograph.report.versions import STAMP

NO_BREAK_SPACE = "\N{NO-BREAK SPACE}"


def plain(
    heads: Sequence[str], rows: Iterable[Sequence[str]], *, left: Collection[int] = (0,)
) -> list[str]:
    r"""The lines of a table whose columns are as wide as their widest cell.

    Columns of numbers are set to the right, those named by `left` to the left.  A row that has
    fewer cells than there are heads is filled up with empty ones.

    >>> print("\n".join(plain(("law", "error", "from"), [("one", "0.1", "here")], left=(0, 2))))
    law  error  from
    one    0.1  here
    """
    lines = [tuple(heads), *(tuple(row) + ("",) * (len(heads) - len(row)) for row in rows)]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    aligned = ["<" if i in left else ">" for i in range(len(widths))]
    return [
        "  ".join(
            f"{cell:{side}{width}}" for cell, side, width in zip(line, aligned, widths, strict=True)
        ).rstrip()
        for line in lines
    ]


def number(value: float, form: str = ".3g") -> str:
    """A number, or a dash for NaN.

    >>> number(1.23456), number(float("nan"))
    ('1.23', '-')
    """
    return "-" if math.isnan(value) else format(value, form)


def wrapped(
    heads: Sequence[str], rows: Iterable[Sequence[str]], widths: Sequence[int]
) -> list[str]:
    r"""The lines of a table of sentences, wrapped to columns of given widths.

    A number keeps its per cent sign, and a blank line follows each row.

    >>> print("\n".join(wrapped(("place", "claim"), [("eq. 1", "1 + 1 = 2 at 0 %")], (5, 11))))
    place claim
    ----- -----------
    eq. 1 1 + 1 = 2
          at 0 %
    <BLANKLINE>
    """
    lines = [*_wrapped_row(heads, widths), " ".join("-" * width for width in widths)]
    for row in rows:
        lines += [*_wrapped_row(row, widths), ""]
    return lines


def _wrapped_row(cells: Sequence[str], widths: Sequence[int]) -> list[str]:
    columns = [
        textwrap.wrap(cell.replace(" %", f"{NO_BREAK_SPACE}%"), width)
        for cell, width in zip(cells, widths, strict=True)
    ]
    lines = []
    for i in range(max(map(len, columns))):
        parts = [
            (column[i] if i < len(column) else "").ljust(width)
            for column, width in zip(columns, widths, strict=True)
        ]
        lines.append(" ".join(parts).rstrip().replace(NO_BREAK_SPACE, " "))
    return lines


def csv_text(
    about: Iterable[str],
    heads: Iterable[str],
    rows: Iterable[Iterable[object]],
    *,
    command: str,
    by: str = STAMP,
) -> str:
    """A CSV file, after commented lines that say what it is and what makes it again.

    These are the lines of `about`, the `command` to type, and the versions that the content was
    made `by`: empty where it does not depend on them.

    >>> print(csv_text(["primes"], ["n", "prime"], [(1, 2), (2, 3)], command="sieve", by="me 1"))
    # primes
    # me 1; remade by: sieve
    n,prime
    1,2
    2,3
    <BLANKLINE>
    """
    stream = io.StringIO()
    made = f"{by}; remade by: {command}" if by else f"remade by: {command}"
    stream.writelines(f"# {line}\n" for line in (*about, made))
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(heads)
    writer.writerows(rows)
    return stream.getvalue()


def csv_rows(text: str) -> list[dict[str, str]]:
    r"""The rows of a CSV file such as `csv_text` writes, by the names of their columns.

    >>> csv_rows("# primes\nn,prime\n1,2\n")
    [{'n': '1', 'prime': '2'}]
    """
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
