"""How often an image may be drawn: a limit on frames per second, and on bytes for slow links. Pure."""

from __future__ import annotations

BUDGET_BYTES_PER_S = 5000.0
"""Bytes per second for pictures, in the mean."""
MAX_PICTURES_PER_S, MIN_PICTURES_PER_S = 10.0, 0.125
"""Pictures per second."""


class FrameLimit:
    """Says when the next picture may be drawn."""

    def __init__(self, rate: float = 2.0) -> None:
        self.rate = rate
        """Pictures per second at most."""
        self._next = float("-inf")

    def change(self, factor: float) -> None:
        """More pictures per second, or fewer."""
        self.rate = min(MAX_PICTURES_PER_S, max(MIN_PICTURES_PER_S, self.rate * factor))

    def due(self, now: float) -> bool:
        """Whether one may be drawn now (s)."""
        return now >= self._next

    def drawn(self, now: float, size: int) -> None:
        """One of so many bytes was drawn; what it took beyond its share is waited for."""
        self._next = now + max(1.0 / self.rate, size / BUDGET_BYTES_PER_S)

    def wait(self, now: float) -> float:
        """Seconds until the next one."""
        return max(0.0, self._next - now)
