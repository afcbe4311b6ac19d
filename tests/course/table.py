"""Which check covers which row: checks register themselves; rows without a check are listed here with a reason."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from course.page import Page
from course.rows import Row

Check = Callable[[Page, Row], None]
CHECKS: dict[int, Check] = {}
OWN: set[int] = set()
"""Rows that are checked with our own robot instead of the page's."""
COMPLETE: set[int] = set()
"""Rows that are checked with substitutes for the executables that the page does not print (N8)."""
ALIKE: set[int] = set()
"""Rows that share one check, which does the same for each: once it has passed, it is not repeated."""
SLOW: set[int] = set()
"""Rows that are not checked in the default run."""


def row(
    *numbers: int, own: bool = False, complete: bool = False, alike: bool = False, slow: bool = False
) -> Callable[[Check], Check]:
    """Register a function as the check of these rows, and choose the workspace: as printed, completed, or ours.

    With `alike` the check does the same for all rows. With `slow` the rows are not checked in the default run.
    """

    def add(check: Check) -> Check:
        for number in numbers:
            assert number not in CHECKS, f"row {number} has two checks"
            CHECKS[number] = check
            if own:
                OWN.add(number)
            if complete:
                COMPLETE.add(number)
            if alike:
                ALIKE.add(number)
            if slow:
                SLOW.add(number)
        return check

    return add


def rows_from(first: int, last: int) -> Iterable[int]:
    """The rows from one number to another, both included."""
    return range(first, last + 1)


SHELL = "a command of the shell"
AIM = "an aim or advice, without an output of its own"
PROSE = "about documents, not about what runs"
BONUS = "not there: an extra that is left to the reader"

UNCHECKED: tuple[tuple[Iterable[int], str], ...] = (
    (rows_from(1, 5), AIM),
    ((62, 63), AIM),
    ((82, 84, 223, 225, 226, 227, 228, 229, 230, 259, 261, 269, 271, 308, 310, 311, 362, 364), SHELL),
    (rows_from(109, 116), AIM),
    ((222,), AIM),
    (rows_from(338, 341), PROSE),
    ((349,), PROSE),
    ((351, 354), BONUS),
    (rows_from(355, 360), AIM),
    (rows_from(379, 385), AIM),
)
"""Rows without a check, and why; a registered check takes precedence."""


def reason(number: int) -> str:
    """Why a row has no check."""
    return next((why for numbers, why in UNCHECKED if number in numbers), "nobody has written a check yet")
