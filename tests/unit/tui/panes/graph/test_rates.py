"""The rates on the lines of the graph."""

from __future__ import annotations

from bot_console.tui.console.topics.port import Measure
from bot_console.tui.panes.graph.rates import RATE_POLL_S, Rates
from fakes.topics import FakeTopics


def test_rate_is_shown_once_it_is_reliable_and_stays_while_it_is_about_the_same() -> None:
    traffic, rates, now = FakeTopics([]), Rates(), 100.0
    shown: list[str] = []
    for measure in (
        Measure(12.7, provisional=True), Measure(9.4), Measure(9.6), Measure(8.0, provisional=True), Measure(20.0),
        Measure(0.0),
    ):  # fmt: skip
        traffic.figures["/scan"] = measure
        now += RATE_POLL_S
        rates.poll(traffic, ["/scan"], now)
        shown.append(rates.texts["/scan"])
    assert shown == ["", "9.4 Hz", "9.4 Hz", "9.4 Hz", "20 Hz", "idle"]
