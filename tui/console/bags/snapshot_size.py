"""How much of the past is kept in memory, so that it can be saved as a bag. Standard library only."""

from __future__ import annotations

from dataclasses import dataclass

KEEP_MINUTES = 2.0
KEEP_MEGABYTES = 64.0
"""The default values of the settings `keep_minutes` and `keep_megabytes`."""


@dataclass(frozen=True, slots=True)
class SnapshotSize:
    """The limits on the messages kept in memory: seconds and bytes."""

    seconds: float
    bytes: int
