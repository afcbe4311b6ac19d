"""How a failed process is restarted automatically: how often and after which delays. Standard library only."""

from __future__ import annotations

from dataclasses import dataclass

STEADY_S = 60.0
"""Seconds that a process must have run for its earlier failures to be forgotten."""


@dataclass(frozen=True, slots=True)
class RestartPolicy:
    """Restarts a failed process up to `attempts` times in a row, after a delay that doubles each time."""

    attempts: int = 5
    delay: float = 1.0
    """Seconds before the first restart."""
    max_delay: float = 30.0
    """The longest delay, in seconds."""

    def delay_before(self, attempt: int) -> float:
        """Seconds to wait before an attempt; the first one is number 1."""
        return min(self.max_delay, self.delay * 2.0 ** min(attempt - 1, 60))

    @property
    def text(self) -> str:
        """The policy in words."""
        last = self.delay_before(self.attempts)
        times = "once" if self.attempts == 1 else f"up to {self.attempts} times"
        return f"on failure, {times}, after {self.delay:g}" + (f" to {last:g} s" if last != self.delay else " s")


DEFAULT_RESTARTS = RestartPolicy()
