"""Collects the time series being plotted: fields of topics, and parameters."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import GraphInfo, Kind, ParameterTree, Value
from bot_console.tui.console.plot.arrays import NotPlottable
from bot_console.tui.console.plot.paths import example, number_paths, plottable_class
from bot_console.tui.console.plot.port import Samples
from bot_console.tui.console.plot.series import Series, parse_path, reader
from bot_console.tui.console.topics.meters import Meter
from bot_console.tui.console.topics.offered_topics import Offer, offered_qos
from bot_console.tui.text.expression.tree import is_parameter, topic_of_rate
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

PLOT_QOS = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
OTHER_CLOCK_S = 3600.0
"""If a header's time differs from the time of reception by more than this (s), its clock is a simulator's."""
RATE_POLL_S = 0.5
"""Seconds between two samples of a topic's rate."""
NUMBERS = (Kind.BOOL, Kind.INTEGER, Kind.DOUBLE)


class _WatchedSeries:
    """A watched series and its source."""

    def __init__(self) -> None:
        self.series = Series()
        self.source: _Source | None = None
        self.qos: QoSProfile | None = None
        self.subscription: Any = None
        self.timer: Any = None
        self.problem = ""
        self.requesters: set[str] = set()


@dataclass(frozen=True, slots=True)
class _Source:
    """The topic of a watched series, and what takes its messages; `raw` ones are serialized."""

    topic: str
    kind: type
    take: Callable[..., None]
    raw: bool = False

    def profile(self, offer: Offer) -> QoSProfile:
        """The QoS to subscribe with: the value of a latched topic reaches only reliable, transient local ones."""
        return offer.profile() if self.raw or offer.latched else PLOT_QOS


class PlotWatch:
    """Collects watched series; `watch` and `unwatch` may be called from any thread."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._start = time.monotonic()
        self._started_at = time.time_ns()
        self._watched: dict[str, _WatchedSeries] = {}
        self._subscribing = threading.Lock()
        """Held while subscriptions are made and destroyed."""
        self._other_clock: float | None = None
        """Offset added to the times of a simulator's clock, so that its messages are shown beside others."""

    def now(self) -> float:
        """Seconds since the console's start, which is the time axis of all series."""
        return time.monotonic() - self._start

    def axis_time(self, stamp: int | None) -> float:
        """The position of a time (ns since the epoch; None: now) on the time axis."""
        return self.now() if stamp is None else (stamp - self._started_at) / 1e9

    def watch(self, path: str, graph: GraphInfo, trees: Mapping[str, ParameterTree], requester: str = "") -> Answer:
        """Start collecting a path; an unsuccessful answer says why it cannot be plotted."""
        if path in self._watched:
            self._watched[path].requesters.add(requester)
            return Answer(True, f"{path} is already plotted")
        try:
            if topic := topic_of_rate(path):
                self._watch_rate(path, topic, graph)
            elif is_parameter(path):
                self._watch_parameter(path, trees)
            else:
                self._watch_topic(path, graph)
        except NotPlottable as error:
            return Answer(False, str(error))
        self._watched[path].requesters.add(requester)
        return Answer(True, path)

    def _watch_parameter(self, path: str, trees: Mapping[str, ParameterTree]) -> None:
        node, _, name = path.partition(":")
        tree = trees.get(node)
        parameter = tree.get(name) if tree else None
        if parameter is None:
            raise NotPlottable(f"{node} has no parameter '{name}'" if tree else f"there is no node {node}")
        if parameter.kind not in NUMBERS:
            raise NotPlottable(f"{name} is of type {parameter.kind.word}, not a number")
        self._watched[path] = _WatchedSeries()
        self.record_parameter(node, name, parameter.value)

    def _watch_topic(self, path: str, graph: GraphInfo) -> None:
        topic, types, rest = _split(path, graph)
        if not rest:
            raise NotPlottable(f"name a field of {topic} as well, for instance {topic}/{example(types[0])}")
        steps, made = parse_path(rest)
        read = reader(steps, made)
        kind = plottable_class(types[0])
        if "[" not in rest:
            read(kind())
        watched = self._watched[path] = _WatchedSeries()
        watched.source = _Source(topic, kind, self._collector(watched, read))
        self.follow(graph)

    def _watch_rate(self, path: str, topic: str, graph: GraphInfo) -> None:
        """Collect the rate of a topic by counting its messages without deserializing them."""
        types = next((each.types for each in graph.topics if each.name == topic), ())
        if not types:
            raise NotPlottable(f"there is no topic {topic}")
        watched, meter = _WatchedSeries(), Meter(False, time.time_ns)

        def poll() -> None:
            rate = meter.poll().rate
            if rate is not None:
                watched.series.add(self.now(), rate)

        watched.source = _Source(topic, plottable_class(types[0]), meter.take, raw=True)
        watched.timer = self._node.create_timer(RATE_POLL_S, poll)
        self._watched[path] = watched
        self.follow(graph)

    def follow(self, graph: GraphInfo) -> None:
        """Subscribe to topics that are not subscribed yet, or whose publishers offer another QoS than before."""
        with self._subscribing:
            for watched in tuple(self._watched.values()):
                source = watched.source
                qos = source.profile(offered_qos(graph, source.topic)) if source else None
                if source is None or qos is None or qos == watched.qos:
                    continue
                before, watched.qos = watched.subscription, qos
                watched.subscription = self._node.create_subscription(
                    source.kind, source.topic, source.take, qos, raw=source.raw
                )
                if before is not None:
                    self._node.destroy_subscription(before)

    def _collector(self, watched: _WatchedSeries, read: Callable[[Any], float]) -> Callable[[Any], None]:
        def collect(message: Any) -> None:
            try:
                watched.series.add(self.now(), read(message), self._header_time(message))
                watched.problem = ""
            except NotPlottable as error:
                watched.problem = str(error)

        return collect

    def _header_time(self, message: Any) -> float:
        """The time in a message's header, on the time axis; NaN if there is none."""
        stamp = getattr(getattr(message, "header", None), "stamp", None)
        if stamp is None or not (stamp.sec or stamp.nanosec):
            return math.nan
        time = self.axis_time(stamp.sec * 1_000_000_000 + stamp.nanosec)
        if abs(time - self.now()) < OTHER_CLOCK_S:
            return time
        if self._other_clock is None:
            self._other_clock = self.now() - time
        return time + self._other_clock

    def record_parameter(self, node: str, name: str, value: Value) -> None:
        """Record a parameter's new value."""
        watched = self._watched.get(f"{node}:{name}")
        if watched and isinstance(value, (bool, int, float)):
            watched.series.add(self.now(), float(value))

    def unwatch(self, path: str, requester: str = "") -> None:
        """Stop collecting a series for a requester, and discard it unless another one still needs it."""
        watched = self._watched.get(path)
        if watched is None:
            return
        watched.requesters.discard(requester)
        if watched.requesters:
            return
        with self._subscribing:
            del self._watched[path]
            if watched.subscription is not None:
                self._node.destroy_subscription(watched.subscription)
            if watched.timer is not None:
                self._node.destroy_timer(watched.timer)

    def samples(self, path: str, after: int) -> Samples:
        """The new samples of a path; none if it is not watched."""
        watched = self._watched.get(path)
        if watched is None:
            return Samples((), (), after)
        new = watched.series.after(after)
        return replace(new, problem=watched.problem)

    def plottable(self, graph: GraphInfo, trees: Mapping[str, ParameterTree]) -> Sequence[str]:
        """The paths to numbers: topic fields and parameters first, then elements and functions of arrays."""
        paths = [
            f"{topic.name}/{field}" for topic in graph.topics if topic.types for field in number_paths(topic.types[0])
        ]
        paths += [
            f"{tree.node}:{each.name}" for tree in trees.values() for each in tree.parameters if each.kind in NUMBERS
        ]
        return sorted(paths, key=lambda path: (path.endswith("()"), path.endswith("]"), path))


def _split(path: str, graph: GraphInfo) -> tuple[str, tuple[str, ...], str]:
    """Split a path into the topic, its types, and the rest; the longest matching topic name wins."""
    path = "/" + path.lstrip("/")
    fitting = [
        each for each in graph.topics if path == each.name or path.startswith((each.name + "/", each.name + "."))
    ]
    if not fitting:
        raise NotPlottable(f"no topic of that name; '{path}' should begin with one of the topics of this system")
    topic = max(fitting, key=lambda each: len(each.name))
    return topic.name, topic.types, path[len(topic.name) + 1 :]
