"""Measures rate, bandwidth, age and latency of topics on serialized messages; only the newest message of a topic is
deserialized, when its value is read.
"""

from __future__ import annotations

import struct
import time
from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics.headline import headline
from bot_console.tui.console.topics.interfaces import HEADER, fields_of, interface
from bot_console.tui.console.topics.offered_topics import offered_qos, offered_types_of
from bot_console.tui.console.topics.port import Measure, Payload
from rclpy.node import Node
from rclpy.serialization import deserialize_message

WINDOW_S = 5.0
"""Seconds over which a rate is measured."""
MIN_MEASURED_S = 3.0
"""Seconds over which messages must have arrived for a reliable rate: the first ones often arrive together."""
TURN_S = 3.0
"""Seconds between two choices of the topics to measure."""
MAX_MESSAGES_PER_S = 1000.0
"""Maximum number of messages to measure per second."""
METER_POLL_S = 0.25
"""Minimum time (s) between two polls that are kept."""
OTHER_CLOCK_S = 3600.0
"""A stamp that differs by at least this (s) is considered to be from another clock."""
LITTLE, BIG = struct.Struct("<iI"), struct.Struct(">iI")
MAX_VALUE_BYTES = 16_384
"""Maximum size of a message whose value is read; images and the like would take too long."""
STAMP_OFFSET_BYTES = 4
"""The offset of a message's content, after the four bytes that identify its serialization."""


class Meter:
    """Counts the messages of one topic; `take` is called by the executor, `poll` by the drawing thread."""

    def __init__(self, stamped: bool, clock: Callable[[], int], *, known: bool = False) -> None:
        """`known` says that the topic was measured before and has only waited for its turn."""
        self._known = known
        self._has_header = stamped
        self._clock = clock
        self._count = self._size = self._stamps = 0
        self._late = 0
        """Sum of all latencies, in ns."""
        self._first = self._last = 0.0
        self.newest: bytes | None = None
        """The newest message, serialized; None before the first one, empty if it is too large."""
        self._polls: deque[tuple[float, float, int, int, int, int]] = deque([(time.monotonic(), 0.0, 0, 0, 0, 0)])

    def take(self, data: bytes, info: Mapping[str, int | None]) -> None:
        """Count a serialized message, at the time it was received rather than taken, since it may have been queued."""
        received = info["received_timestamp"] or self._clock()
        waited = min(max(self._clock() - received, 0) / 1e9, WINDOW_S)
        now = max(time.monotonic() - waited, self._last)
        self._count += 1
        self._size += len(data)
        self.newest = data if len(data) <= MAX_VALUE_BYTES else b""
        self._first, self._last = self._first or now, now
        if self._has_header and len(data) >= STAMP_OFFSET_BYTES + 8:
            seconds, nanoseconds = (LITTLE if data[1] & 1 else BIG).unpack_from(data, STAMP_OFFSET_BYTES)
            self._late += received - seconds * 1_000_000_000 - nanoseconds
            self._stamps += 1

    def poll(self) -> Measure:
        """The measurements over the last seconds."""
        now = time.monotonic()
        here = (now, self._last, self._count, self._size, self._late, self._stamps)
        polls = self._polls
        if now - polls[-1][0] >= METER_POLL_S:
            polls.append(here)
        while len(polls) > 2 and now - polls[1][0] > WINDOW_S:
            polls.popleft()
        begun, first, count, size, late, stamps = polls[0]
        new = self._count - count
        if not new:
            silent = now - begun >= WINDOW_S
            return Measure(0.0 if silent else None, 0.0 if silent else None, self._age(now), None, self._count)
        span, spaces = (self._last - first, new) if count else (self._last - self._first, new - 1)
        rate = spaces / span if span > 0 else None
        if rate and now - self._last > 2 / rate:
            rate = new / (now - begun)  # the topic has become slower or has ended
        stamped = self._stamps - stamps
        latency = (self._late - late) / stamped / 1e9 if stamped else None
        if latency is not None and abs(latency) > OTHER_CLOCK_S:
            latency = None
        bandwidth = rate * (self._size - size) / new if rate is not None else None
        provisional = not self._known and now - self._first < MIN_MEASURED_S
        return Measure(rate, bandwidth, self._age(now), latency, self._count, provisional=provisional)

    def _age(self, now: float) -> float | None:
        return now - self._last if self._count else None


class Meters:
    """Measures the topics in view.

    Each measured message costs about 40 us. If more than `MAX_MESSAGES_PER_S` arrive, the fastest topics take turns;
    the last measurement of a topic is shown until its next turn.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._meters: dict[str, tuple[Any, Meter, tuple[bool, bool]]] = {}
        self._values: dict[str, tuple[bytes, str]] = {}
        """The messages whose values were read last, with these values as text."""
        self._resting: dict[str, Measure] = {}
        """The last measurements of topics that wait for their next turn, the longest wait first."""
        self._wanted: frozenset[str] = frozenset()
        self._problems: dict[str, str] = {}
        self._timer: Any = None
        self._graph = GraphInfo()

    def measure(self, topics: Collection[str], graph: GraphInfo) -> None:
        """Measure these topics and no others, each with the QoS that is offered now; called by the executor."""
        self._wanted = frozenset(topics)
        for topic in list(self._meters):
            if topic not in self._wanted or self._meters[topic][2] != offered_qos(graph, topic).key:
                self._detach(topic)
        for known in (self._problems, self._resting, self._values):
            for topic in known.keys() - self._wanted:
                del known[topic]
        for topic in self._wanted - self._meters.keys() - self._resting.keys():
            self._begin(topic, graph)
        if self._wanted and self._timer is None:
            self._timer = self._node.create_timer(TURN_S, lambda: self.turn(self._graph))
        elif not self._wanted and self._timer is not None:
            self._node.destroy_timer(self._timer)
            self._timer = None
        self._graph = graph

    def _detach(self, topic: str) -> Meter:
        subscription, meter, _ = self._meters.pop(topic)
        self._node.destroy_subscription(subscription)
        return meter

    def _begin(self, topic: str, graph: GraphInfo) -> None:
        types = offered_types_of(graph, topic)
        if not types:
            return
        try:
            kind = interface(Payload.MESSAGE, types[0])
        except ValueError as error:
            self._problems[topic] = str(error)
            return
        offer = offered_qos(graph, topic)
        meter = Meter(_has_header(kind), time.time_ns, known=topic in self._resting)
        subscription = self._node.create_subscription(kind, topic, meter.take, offer.profile(), raw=True)
        self._meters[topic] = subscription, meter, offer.key
        self._problems.pop(topic, None)

    def turn(self, graph: GraphInfo) -> None:
        """Choose the topics to measure until the next turn."""
        rates = {topic: each.rate or 0.0 for topic, each in self.measured().items()}
        chosen = in_turn(rates, list(self._resting), MAX_MESSAGES_PER_S)
        for topic in [each for each in self._meters if each not in chosen]:
            self._resting[topic] = self._shown(topic, self._meters[topic][1].poll())
            self._detach(topic)
        for topic in [each for each in self._resting if each in chosen and each not in self._meters]:
            self._begin(topic, graph)
        for topic in [each for each in self._resting if each in self._meters]:
            if self._meters[topic][1].poll().rate is not None:
                del self._resting[topic]

    def _shown(self, topic: str, now: Measure) -> Measure:
        """The measurement of a topic; the previous one if its turn has only just begun."""
        return now if now.rate is not None else self._resting.get(topic, now)

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph: measured topics may have appeared, or changed the QoS that they offer."""
        if self._wanted:
            self.measure(self._wanted, graph)

    def measured(self) -> Mapping[str, Measure]:
        """All measurements; from any thread."""
        found = dict(self._resting)
        found.update({topic: self._shown(topic, meter.poll()) for topic, (_, meter, _) in list(self._meters.items())})
        return {**found, **{topic: Measure(problem=why) for topic, why in list(self._problems.items())}}

    def newest(self) -> Mapping[str, str]:
        """The newest value of each topic on one line; from any thread."""
        for topic, (subscription, meter, _) in list(self._meters.items()):
            data, (known, _) = meter.newest, self._values.get(topic, (None, ""))
            if data is not None and data is not known:
                self._values[topic] = data, value_text(data, subscription.msg_type)
        return {topic: text for topic, (_, text) in list(self._values.items())}


def value_text(data: bytes, kind: Any) -> str:
    """A serialized message as one line of text; empty if it cannot be read."""
    try:
        return headline(deserialize_message(data, kind), f"{kind.__module__.partition('.')[0]}/msg/{kind.__name__}")
    except (AttributeError, OverflowError, RuntimeError, TypeError, ValueError):
        return ""


def in_turn(rates: Mapping[str, float], resting: Sequence[str], budget: float) -> set[str]:
    """The topics to measure next, given their rates (Hz): all of them if the sum is within the budget.

    Otherwise the slow ones, and those of the fast ones that have waited longest.
    """
    if sum(rates.values()) <= budget:
        return set(rates)
    fair = budget / (2 * len(rates))
    chosen = {topic for topic, rate in rates.items() if rate <= fair}
    left = budget - sum(rates[topic] for topic in chosen)
    fast = [*(each for each in resting if each in rates), *(each for each in rates if each not in resting)]
    for topic in (each for each in fast if each not in chosen):
        if left >= rates[topic] or topic == fast[0]:
            chosen.add(topic)
            left -= rates[topic]
    return chosen


def _has_header(kind: Any) -> bool:
    """Whether messages of a type begin with a header, and thus with a stamp."""
    return next(iter(fields_of(kind).values()), "") == HEADER
