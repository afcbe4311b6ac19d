"""Receives the newest message of one topic, and converts it to lines."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics.followed_topic import FollowedTopic
from bot_console.tui.console.topics.interfaces import interface
from bot_console.tui.console.topics.message_tree import tree
from bot_console.tui.console.topics.offered_topics import Offer
from bot_console.tui.console.topics.port import LiveMessage, Payload, RequestedQos
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

AS_OFFERED = RequestedQos()
RELIABILITY = {"reliable": ReliabilityPolicy.RELIABLE, "best_effort": ReliabilityPolicy.BEST_EFFORT}
DURABILITY = {"volatile": DurabilityPolicy.VOLATILE, "transient_local": DurabilityPolicy.TRANSIENT_LOCAL}
HISTORY = {"keep_last": HistoryPolicy.KEEP_LAST, "keep_all": HistoryPolicy.KEEP_ALL}
MAX_AGES = 10
"""The displayed age has this many steps per second, so that the object does not change at every poll."""


class MessageListener(FollowedTopic):
    """Keeps the newest message, and converts it to lines only on demand."""

    def __init__(self, node: Node, explain: Callable[[str, str], str]) -> None:
        """`explain` returns why a type is unknown or, if it does not know, the given text."""
        super().__init__(node)
        self._explain = explain
        self._qos = AS_OFFERED
        self._newest: tuple[int, Any, float] = (0, None, 0.0)
        self._live = LiveMessage()

    def listen(self, topic: str, graph: GraphInfo, qos: RequestedQos = AS_OFFERED) -> None:
        """Subscribe to this topic and no other; called by the executor."""
        if topic == self._topic and qos == self._qos and (self._subscription is None) == (not topic):
            return
        self._qos = qos
        self._detach()
        self._newest, self._problem = (0, None, 0.0), ""
        self._topic = topic
        self.follow(graph)

    def _class(self, kind: str) -> type:
        try:
            return interface(Payload.MESSAGE, kind)
        except ValueError as error:
            raise ValueError(self._explain(kind, str(error))) from None

    def _profile(self, offer: Offer) -> QoSProfile:
        """The requested profile, completed by what the publishers offer."""
        profile, qos = offer.profile(), self._qos
        if qos.reliability:
            profile.reliability = RELIABILITY[qos.reliability]
        if qos.durability:
            profile.durability = DURABILITY[qos.durability]
        if qos.history:
            profile.history = HISTORY[qos.history]
        if qos.depth:
            profile.depth = qos.depth
        return profile

    def _take(self, message: Any) -> None:
        self._newest = (self._newest[0] + 1, message, time.monotonic())

    def heard(self) -> LiveMessage:
        """The newest message, from any thread; the same object until something changes."""
        count, message, moment = self._newest
        age = round((time.monotonic() - moment) * MAX_AGES) / MAX_AGES if count else None
        old = self._live
        if (old.topic, old.count, old.problem, old.age) == (self._topic, count, self._problem, age):
            return old
        same = old.topic == self._topic and old.count == count
        fields = old.fields if same else ()
        if not same and message is not None:
            fields = tree(message, self._type)
        self._live = LiveMessage(self._topic, self._type, fields, count, age, self._problem)
        return self._live
