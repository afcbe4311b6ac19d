"""The rates that are written beside topics, measured only while they are visible."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from bot_console.tui.console.topics.port import Measure, Topics
from bot_console.tui.text.figures import coarse_rate, steady
from bot_console.tui.text.redraw_interval import is_due

RATE_POLL_S = 2.0
READER = "graph"
IDLE = "idle"
"""Shown instead of a rate of 0, which is normal for a topic that is published once (transient local)."""


class Rates:
    """The rates of topics as texts."""

    def __init__(self) -> None:
        self.wanted: bool | None = None
        """Whether the user wants rates; None: where there is room for them."""
        self.texts: Mapping[str, str] = {}
        self._rates: dict[str, float | None] = {}
        self._polled = 0.0

    def shown(self, on: bool) -> Mapping[str, str]:
        """The texts if rates are on, otherwise nothing."""
        return self.texts if on else {}

    def poll(self, traffic: Topics, topics: Sequence[str], now: float) -> bool:
        """Measure these topics, and read the rates every few seconds; returns whether any text has changed."""
        if not is_due(self._polled, now, RATE_POLL_S):
            return False
        self._polled = now
        traffic.measure(topics, READER)
        known = traffic.measured()
        self._rates = {topic: self._steady(topic, known[topic]) for topic in topics if topic in known}
        texts = {topic: IDLE if rate == 0 else coarse_rate(rate) for topic, rate in self._rates.items()}
        before, self.texts = self.texts, texts
        return texts != before

    def stop_measuring(self, traffic: Topics) -> None:
        """Measure nothing."""
        if self._polled:
            self._polled = 0.0
            traffic.measure([], READER)

    def _steady(self, topic: str, measure: Measure) -> float | None:
        """The rate to show. As each new text may move lines of the drawing, provisional rates are ignored."""
        before = self._rates.get(topic)
        return before if measure.provisional else steady(before, measure.rate)
