"""Hill climbing on a live robot: change a value by a step, score it for a period, then go on or turn back. Pure."""

from __future__ import annotations

MIN_STEP = 0.25
"""The smallest step, as a fraction of the first one; the search never stops, because the optimum may move."""
FORGETTING = 0.1
"""The fraction by which the best score moves towards the latest one in each period, since conditions change."""


class HillClimber:
    """Searches for the value with the highest score between `low` and `high`, from `value` in steps of `step`.

    A value that proved dangerous narrows the range permanently: neither it nor anything beyond it is tried again.
    """

    def __init__(self, low: float, high: float, value: float, step: float) -> None:
        self.low: float = low
        self.high: float = high
        self.value: float = min(high, max(low, value))
        self.best: float = self.value
        self._first = step
        self._step: float = step
        self._direction: float = 1.0
        self._best_score: float | None = None

    def record_score(self, score: float) -> float:
        """Record the score of the current value; returns the value to try next."""
        if self._best_score is None or score >= self._best_score:
            self.best, self._best_score = self.value, score
            return self._go(self.value)
        if self.value == self.best:
            # The same value did worse than before: conditions have changed, and so must the expectation.
            self._best_score = score
            return self._go(self.value)
        self._best_score -= FORGETTING * (self._best_score - score)
        self._direction = -self._direction
        self._step = max(MIN_STEP * self._first, 0.5 * self._step)
        self.value = self.best
        return self.value

    def record_danger(self) -> float:
        """Record that the current value was dangerous; returns the value to go back to, one step towards safety."""
        if self.value > self.low and (self._direction > 0 or self.value >= self.best):
            self.high = max(self.low, self.value - self._step)
            self._direction = -1.0
        else:
            self.low = min(self.high, self.value + self._step)
            self._direction = 1.0
        self.value = self.best = min(self.high, max(self.low, self.best))
        self._best_score = None
        return self.value

    def _go(self, origin: float) -> float:
        wanted = origin + self._direction * self._step
        if not self.low <= wanted <= self.high:
            self._direction = -self._direction
            wanted = origin + self._direction * self._step
        self.value = min(self.high, max(self.low, wanted))
        return self.value
