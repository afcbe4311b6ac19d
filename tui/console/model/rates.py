"""Topics with an expected rate or age, and whether they meet it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RateCheck:
    """A topic that is measured all the time because a rate or age is expected of it."""

    topic: str
    expected: str
    """The expectation, such as `10 Hz ± 20 %`."""
    measured: str = ""
    """The measurement, such as `4.2 Hz` or `nothing for 3 s`; empty while there is too little to measure."""
    late: bool | None = None
    """Whether it fails the expectation; None while that is unknown."""
    since: int = 0
    """Since when it does or does not, in ns since the epoch."""
    times: int = 0
    """How often it has fallen behind."""
