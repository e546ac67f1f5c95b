"""A claim of the paper and its verdict, and how numbers are put into its sentences.

Differences at the level of rounding or of an integrator's tolerance are given as a power of ten
that they stay below, so that the sentences are the same on every machine.
"""

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

SAME = 1e-8  # relative: below it a closed form and integration in time agree
OUTCOMES = {False: "fails", True: "holds", None: "not claimed"}


@dataclass(frozen=True)
class Verdict:
    """One statement of the paper, judged, or one thing that it leaves open, measured."""

    id: str
    place: str  # in the paper
    claim: str  # in words
    paper: str  # the number or formula that it gives
    measured: str  # what was found, in a sentence
    domain: str  # where it was looked for
    holds: bool | None  # None where the paper claims nothing that could fail

    def to_dict(self) -> dict[str, Any]:
        """The fields by name, in order."""
        return asdict(self)

    @property
    def outcome(self) -> str:
        """The verdict in a word or two: holds, fails, not claimed."""
        return OUTCOMES[self.holds]


def tally(verdicts: Iterable[Verdict]) -> str:
    """How many claims hold and fail, and what else was measured, in a line.

    >>> tally([Verdict("one", "eq. 1", "1 + 1 = 2", "2", "It is 2.", "here", True)])
    '1 claim: 1 holds'
    """
    outcomes = [verdict.holds for verdict in verdicts]
    holds, fails, others = (outcomes.count(word) for word in (True, False, None))
    parts = [f"{holds} hold" + "s" * (holds == 1)] * bool(holds)
    parts += [f"{fails} fail" + "s" * (fails == 1)] * bool(fails)
    claims = holds + fails
    line = f"{claims} claim{'s' * (claims != 1)}" + ": " * bool(parts) + ", ".join(parts)
    return line + f"; {others} not claimed, measured" * bool(others)


def less_than(value: float) -> str:
    """A power of ten that a small number stays clearly below.

    >>> less_than(3e-13), less_than(0.0)
    ('less than 1e-12', 'less than 1e-14')
    """
    return f"less than 1e{math.ceil(math.log10(3 * max(value, 1e-15)))}"


def percent(value: float, digits: int = 2, *, sign: bool = False) -> str:
    """A ratio in per cent.

    >>> percent(0.0123), percent(0.0123, 1, sign=True)
    ('1.23 %', '+1.2 %')
    """
    return f"{100 * value:{'+' if sign else ''}.{digits}f} %"
