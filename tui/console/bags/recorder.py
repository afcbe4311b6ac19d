"""Records topics: subscribes to them as they appear, with the QoS they offer, and keeps the serialized bytes."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Protocol

from bot_console.tui.console.bags.port import GenericTypes
from bot_console.tui.console.bags.qos import offered_entries
from bot_console.tui.console.bags.sim_time import SimTime
from bot_console.tui.console.offered_qos import OfferedSubscription
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

PACE_S = 0.1
"""Seconds between two calls of `Recorder.turn`."""
TOPIC_POLL_S = 0.5
"""Seconds between two searches for new topics."""
MAX_CLOCK_DIFFERENCE_NS = 1_000_000_000
"""The longest time (ns) from sending to reception for which the two clocks count as synchronized."""
CLOCK = "/clock"
"""A console does not record it: it is a third of all messages, and `bag play --clock` derives it from the times of the
bag.
"""
BEST = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Sink(Protocol):
    """Receives recorded messages."""

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Add a topic."""
        ...

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message."""
        ...

    def flush(self) -> None:
        """Pass buffered data to the operating system."""
        ...


UNAVAILABLE = (ImportError, AttributeError, ValueError)
"""The exceptions raised when a type, or a type it contains, is not available here."""


def remarks(unknown: Mapping[str, str], generic: Iterable[str]) -> str:
    """The gaps of a bag, as text: topics, each with the reason, and definitions; empty if it lacks nothing."""
    missing = [f"{name} was not recorded: {why}" for name, why in sorted(unknown.items())]
    return "; ".join([*missing, *(f"{name} was recorded without a definition" for name in sorted(generic))])


class Recorder:
    """Passes all messages of the wanted topics to a sink each time `turn` is called.

    Its node is not spun: `turn` takes the waiting messages a few times a second, at a fraction of the cost of
    callbacks.
    """

    def __init__(
        self,
        node: Node,
        sink: Sink,
        wanted: Callable[[str, Sequence[str]], bool],
        find: Callable[[str], Any],
        *,
        poll_s: float = TOPIC_POLL_S,
        sim_time: bool = False,
        generic: GenericTypes | None = None,
        definition_timeout_s: float = 0.0,
    ) -> None:
        """`wanted` says whether to record a topic of certain types, and is asked every `poll_s` seconds.

        `find` returns the class of a type name, and raises `ImportError` and the like if there is none. If there still
        is none after `definition_timeout_s`, the topic is recorded without a definition, with a class of `generic`.
        With `sim_time`, messages are stamped with the time of /clock, and those before its first message are discarded.
        """
        self._node = node
        self._sink = sink
        self._wanted = wanted
        self._find = find
        self._poll_s = poll_s
        self._polled, self._flushed = -math.inf, time.monotonic()
        self._last = 0
        self._sim_time = SimTime(node) if sim_time else None
        self._generic = generic
        self._definition_timeout_s = definition_timeout_s
        self._searched: dict[str, float] = {}
        """When (monotonic s) each type that is not available here was first wanted."""
        self.paused = False
        """Whether messages are discarded instead of recorded."""
        self.subscribed: dict[str, OfferedSubscription] = {}
        self.unknown: dict[str, str] = {}
        """Topics that cannot be recorded for now, and why: a type may become known later."""
        self.generic: dict[str, str] = {}
        """Topics that are recorded without a definition, and why."""
        self.turn()

    def close(self) -> None:
        """Take the waiting messages and stop recording; afterwards the sink can be closed."""
        self.take()
        for each in self.subscribed.values():
            each.destroy()
        if self._sim_time is not None:
            self._sim_time.destroy()

    def turn(self) -> None:
        """Take waiting messages; search for new topics and flush when due. Call this every `PACE_S` seconds."""
        if self._sim_time is not None:
            self._sim_time.follow()  # not in `take`, which also has to work after a shutdown
        self.take()
        now = time.monotonic()
        if now - self._polled >= self._poll_s:
            self._polled = now
            self._poll()
        if now - self._flushed >= TOPIC_POLL_S:
            self._flushed = now
            self._sink.flush()
            for each in self.subscribed.values():
                each.follow()

    def take(self) -> None:
        """Pass the waiting messages to the sink."""
        now = time.time_ns()
        found = [(sent, name, data) for name, each in self.subscribed.items() for data, sent in each.drain()]
        if self._sim_time is not None:
            self._sim_time.update()
        for received, name, data, sent in () if self.paused else in_order(found, now, self._last):
            self._last = received
            at = received if self._sim_time is None else self._sim_time.at(received)
            if at is not None:
                self._sink.write(name, data, at, sent)

    def _poll(self) -> None:
        """Subscribe to new wanted topics."""
        for name, types in self._node.get_topic_names_and_types():
            if name not in self.subscribed and self._wanted(name, types):
                self._subscribe(name, types)

    def _subscribe(self, name: str, types: list[str]) -> None:
        if len(types) != 1:
            self.unknown[name] = f"it has several types: {', '.join(types)}"
            return
        offers = self._node.get_publishers_info_by_topic(name)
        type_hash = _hash(offers)
        qos = offered_entries(each.qos_profile for each in offers)
        try:
            kind = self._class(types[0], type_hash)
            self._sink.topic(name, kind, qos, type_hash)
        except UNAVAILABLE as error:
            why = f"its type {types[0]} is not available here ({error})"
            kind = self._without_definition(types[0], type_hash)
            if kind is None:
                self.unknown[name] = why
                return
            self._sink.topic(name, kind, qos, type_hash)
            self.generic[name] = why
        self.unknown.pop(name, None)
        self.subscribed[name] = OfferedSubscription(
            self._node, kind, name, _unused_callback, BEST, eager=False, once_weak=True, raw=True
        )

    def _class(self, type_name: str, type_hash: str) -> Any:
        """The class of a type; raises `UNAVAILABLE` if there is none with this type hash."""
        kind = self._find(type_name)
        here = self._generic.type_hash(kind) if self._generic is not None and type_hash else ""
        if here and here != type_hash:
            raise ValueError(f"it is defined otherwise than by {type_hash}")
        return kind

    def _without_definition(self, type_name: str, type_hash: str) -> Any:
        """The class with which serialized messages of an unknown type are recorded; None if there is none yet."""
        now = time.monotonic()
        waited = now - self._searched.setdefault(type_name, now)
        if self._generic is None or not type_hash or waited < self._definition_timeout_s:
            return None
        try:
            return self._generic.generic_class(type_name, type_hash)
        except ValueError:
            return None


def in_order(found: Iterable[tuple[int, str, bytes]], now: int, last: int) -> Iterator[tuple[int, str, bytes, int]]:
    """Assign times of reception to messages that were taken together, each given as (sent, topic, data).

    Yields (received, topic, data, sent) in order; no time is before `last`. The time of sending is used where it is
    plausible, since it is closer to the time of reception than `now` is; it is not plausible if the clocks differ.
    """
    stamped = [
        (sent if 0 <= now - sent < MAX_CLOCK_DIFFERENCE_NS else now, name, data, sent) for sent, name, data in found
    ]
    stamped.sort(key=_received)
    for received, name, data, sent in stamped:
        last = max(last, received)
        yield last, name, data, sent


def _received(entry: tuple[int, str, bytes, int]) -> int:
    return entry[0]


def _unused_callback(data: bytes) -> None:
    """The callback of subscriptions whose messages are taken directly; it is never called."""


def _hash(offers: Iterable[Any]) -> str:
    """The RIHS01 hash of a topic's type; empty if the graph does not contain it."""
    for each in offers:
        found = getattr(each, "topic_type_hash", None)
        if found is not None:
            return str(found)
    return ""
