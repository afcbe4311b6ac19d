"""How often an image may be drawn: a limit on frames per second, and on bytes for slow links. Pure."""

from __future__ import annotations

BUDGET_BYTES_PER_S = 5000.0
"""Average bytes per second for pictures."""
MAX_PICTURES_PER_S, MIN_PICTURES_PER_S = 10.0, 0.125
"""Range of the limit (pictures per second)."""


class FrameLimit:
    """Says when the next picture may be drawn."""

    def __init__(self, rate: float = 2.0) -> None:
        self.rate = rate
        """Maximum pictures per second."""
        self._next = float("-inf")

    def change(self, factor: float) -> None:
        """Multiply the limit by a factor."""
        self.rate = min(MAX_PICTURES_PER_S, max(MIN_PICTURES_PER_S, self.rate * factor))

    def due(self, now: float) -> bool:
        """Whether a picture may be drawn at time `now` (s)."""
        return now >= self._next

    def drawn(self, now: float, size: int) -> None:
        """Record that a picture of `size` bytes was drawn; a large one delays the next."""
        self._next = now + max(1.0 / self.rate, size / BUDGET_BYTES_PER_S)

    def wait(self, now: float) -> float:
        """Seconds until the next picture may be drawn."""
        return max(0.0, self._next - now)
