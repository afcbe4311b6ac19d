"""Reads several bags as one."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Iterator, Mapping, Sequence

from bot_console.tui.console.bags.metadata import Topic
from bot_console.tui.console.bags.reader import Bag, Entry


class MergedBags:
    """The messages of several bags in order; for a topic in more than one, the type and QoS in the first one count."""

    def __init__(self, bags: Sequence[Bag]) -> None:
        self._bags = bags

    @property
    def topics(self) -> Mapping[str, Topic]:
        """The recorded topics, by name."""
        found: dict[str, Topic] = {}
        for bag in self._bags:
            for name, topic in bag.topics.items():
                found.setdefault(name, topic)
        return found

    @property
    def span(self) -> tuple[int, int]:
        """Times of the first and the last message (ns since the epoch)."""
        spans = [bag.span for bag in self._bags if bag.span[1]]
        return (min(each[0] for each in spans), max(each[1] for each in spans)) if spans else (0, 0)

    def messages(self, topics: Collection[str] | None = None, begin: int = 0) -> Iterator[Entry]:
        """The messages received since a time (ns since the epoch), in order; raises `BagError` on damaged data."""
        return heapq.merge(*(bag.messages(topics, begin) for bag in self._bags), key=lambda entry: entry.received)
