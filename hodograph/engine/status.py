"""What became of a launch: one code for all modules, with a message for each."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """The code of a result; it stands in arrays of ``int8``."""

    CONVERGED = 0
    UNREACHABLE = 1
    NOT_CONVERGED = 2
    INVALID = 3
    LEFT_DOMAIN = 4

    @property
    def message(self) -> str:
        """The code in words."""
        return _MESSAGES[self]


_MESSAGES = {
    Status.CONVERGED: "converged",
    Status.UNREACHABLE: "the place is never reached",
    Status.NOT_CONVERGED: "the iteration did not converge",
    Status.INVALID: "a NaN among the inputs",
    Status.LEFT_DOMAIN: "the iteration left the domain of the angle",
}
