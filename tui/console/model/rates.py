"""Topics whose rate or age is expected, and whether they are as expected."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RateCheck:
    """A topic that is measured all the time because something is expected of it."""

    topic: str
    expected: str
    """Such as `10 Hz ± 20 %`."""
    measured: str = ""
    """Such as `4.2 Hz` or `nothing for 3 s`; empty while too little was measured."""
    late: bool | None = None
    """Whether it is not as expected; None while that is not known."""
    since: int = 0
    """When it came to be so, in ns since the epoch."""
    times: int = 0
    """How often it has fallen behind."""
