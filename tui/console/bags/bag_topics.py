"""The topics of a bag: their mean rates and sizes, and the messages at the time being viewed."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from bot_console.tui.console.bags.contents import Contents
from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics.headline import headline
from bot_console.tui.console.topics.message_tree import tree
from bot_console.tui.console.topics.node_topics import NodeTopics
from bot_console.tui.console.topics.port import LiveMessage, Measure, RequestedQos

UNREADABLE = (ImportError, AttributeError, ValueError, RuntimeError)
"""The exceptions raised for a message whose type is not available here, or whose bytes do not fit the type."""


class BagTopics(NodeTopics):
    """The topics port of a bag: shows the last message up to the time being viewed. Without a node, it cannot send."""

    def __init__(self, gate: Gate, contents: Contents, graph: GraphInfo) -> None:
        super().__init__(gate, lambda: graph)
        self._contents = contents
        self._topic = ""
        self._stamp: int | None = None
        self._heard = LiveMessage()
        self._means: Mapping[str, Measure] | None = None
        self._wanted: Collection[str] = ()
        self._values: dict[tuple[str, int], str] = {}
        """The displayed values, by topic and by the number of messages up to the time being viewed."""

    def time_moved(self, stamp: int | None) -> None:
        """View the messages at a time (ns since the epoch); None stands for the end of the bag."""
        self._stamp = stamp

    def measured(self) -> Mapping[str, Measure]:
        """The mean rate (Hz) and bytes per second of each topic over the whole bag."""
        if self._means is None:
            about = self._contents.metadata
            span = (about.end - about.begin) / 1e9 or 1.0
            self._means = {
                name: Measure(topic.count / span, self._contents.size(name) / span, count=topic.count)
                for name, topic in about.topics.items()
            }
        return self._means

    def measure(self, topics: Collection[str], requester: str = "") -> None:
        """Choose the topics whose values `newest` returns."""
        self._wanted = topics

    def newest(self) -> Mapping[str, str]:
        """The values of the measured topics at the time being viewed."""
        known, self._values = self._values, {}
        for topic in self._wanted:
            count = self._contents.count(topic, self._stamp) if topic in self._contents.metadata.topics else 0
            if count:
                at = topic, count
                self._values[at] = known[at] if at in known else self._value(*at)
        return {topic: text for (topic, _), text in self._values.items()}

    def _value(self, topic: str, count: int) -> str:
        try:
            return headline(self._contents.message(topic, count - 1), self._contents.metadata.topics[topic].type)
        except UNREADABLE:
            return ""

    def listen(self, topic: str, qos: RequestedQos | None = None) -> None:
        """Choose the topic whose messages `heard` returns."""
        self._topic = topic

    def heard(self) -> LiveMessage:
        """The message being viewed; the same object until another message is viewed."""
        topic, known = self._topic, self._contents.metadata.topics.get(self._topic)
        if known is None:
            return LiveMessage(topic, problem=f"{topic} is not in the recording" if topic else "")
        count = self._contents.count(topic, self._stamp)
        if (self._heard.topic, self._heard.count) == (topic, count):
            return self._heard
        problem = "no message has been recorded up to this time"
        if topic in self._contents.left_out:
            problem = "it is too large to be kept in memory"
        try:
            message = self._contents.message(topic, count - 1) if count else None
            fields = tree(message, known.type) if message is not None else ()
            self._heard = LiveMessage(topic, known.type, fields, count, problem="" if count else problem)
        except UNREADABLE as error:
            self._heard = LiveMessage(topic, known.type, (), count, problem=f"{known.type} cannot be read: {error}")
        return self._heard
