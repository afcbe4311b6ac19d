"""Paces frames: as fast as the terminal accepts them, but no faster than a person needs. Pure."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable

FRAME_INTERVAL_S = 0.1
"""Seconds from one frame to the next, while no key is pressed."""

UNPACED_AFTER_KEY_S = 0.3
"""Seconds after a key during which frames are not paced, since they show its effect."""

MAX_IN_FLIGHT = 2
"""The maximum number of frames that the terminal has not answered yet."""

SLOW_ANSWER_S = 0.25
"""Seconds; if an answer takes longer, only one frame may be in flight, which keeps such a slow line busy."""

FRAME_TIMEOUT_S = 2.0
MIN_BYTES_PER_S = 2000.0
"""The lowest speed of a line in bytes per second, from which the wait for an answer is computed.

The wait doubles after each missing answer, up to a minute, so that output does not pile up in front of a stalled
terminal.
"""
MAX_FRAME_TIMEOUT_S = 60.0

MERGED_NEWS_S = 5.0
"""Seconds for which a merged frame is reported."""
MIN_MERGED_FRAMES = 10


class AnswerGate:
    """Counts frames that the terminal has not answered; never waits for a terminal that does not answer at all."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._asked: deque[tuple[float, float]] = deque()
        self._answers = False
        self._allowed = MAX_IN_FLIGHT
        self._missing_answers = 0
        self._drawn = self._pressed = float("-inf")
        self._merged: deque[float] = deque(maxlen=100)

    def wait(self) -> float:
        """Seconds until a frame may be drawn, unless an answer comes before; 0 for now."""
        now = self._clock()
        while self._asked and now >= self._asked[0][1]:
            self._asked.popleft()
            self._missing_answers += 1
        # Frames are held back only if the terminal has ever answered: many terminals and recorders never do.
        if self._answers and len(self._asked) >= self._allowed:
            return self._asked[0][1] - now
        if self.is_eager:
            return 0.0
        return max(0.0, self._drawn + FRAME_INTERVAL_S - now)

    @property
    def is_eager(self) -> bool:
        """Whether a key was pressed just now."""
        return self._clock() - self._pressed < UNPACED_AFTER_KEY_S

    def asked(self, size: int) -> None:
        """Record that a query was written, after that many bytes."""
        now = self._clock()
        timeout_s = (FRAME_TIMEOUT_S + size / MIN_BYTES_PER_S) * 2 ** min(self._missing_answers, 10)
        self._asked.append((now, now + min(timeout_s, MAX_FRAME_TIMEOUT_S)))

    def drawn(self) -> None:
        """Record that a frame was written."""
        self._drawn = self._clock()

    def answered(self) -> None:
        """Record that the terminal has answered the oldest query."""
        self._answers = True
        self._missing_answers = 0
        if self._asked:
            began, _ = self._asked.popleft()
            self._allowed = 1 if self._clock() - began > SLOW_ANSWER_S else MAX_IN_FLIGHT

    @property
    def has_unanswered(self) -> bool:
        """Whether a terminal that answers has not answered everything yet."""
        return self._answers and bool(self._asked)

    def pressed(self) -> None:
        """Record that a key was pressed: its effect is shown at once."""
        self._pressed = self._clock()

    def merged(self) -> None:
        """Record that a frame was held back and merged into a later one."""
        if self._answers and len(self._asked) >= self._allowed:
            self._merged.append(self._clock())

    @property
    def held_back(self) -> int:
        """The number of frames merged in the last seconds, at most 100; 0 while there are too few to notice."""
        since = self._clock() - MERGED_NEWS_S
        count = sum(each >= since for each in self._merged)
        return count if count >= MIN_MERGED_FRAMES else 0
