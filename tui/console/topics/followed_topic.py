"""One topic that is heard for as long as somebody looks, however its offer changes."""

from __future__ import annotations

from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics.offered_topics import Offer, offered_qos, offered_types_of
from rclpy.node import Node
from rclpy.qos import QoSProfile


class FollowedTopic:
    """A subscription that comes with the topic, is made anew for another offer, and goes with the last look."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._topic = ""
        self._type = ""
        self._offer: object = None
        self._subscription: Any = None
        self._problem = ""

    def follow(self, graph: GraphInfo) -> None:
        """The graph is another: the topic may have come only now, or be offered with another QoS."""
        topic = self._topic
        types = offered_types_of(graph, topic) if topic else ()
        if not topic or not types:
            self._problem = f"there is no topic {topic} now" if topic and self._subscription is None else ""
            return
        offer = offered_qos(graph, topic)
        if self._subscription is not None and (types[0], offer.key) == (self._type, self._offer):
            return
        self._detach()
        try:
            kind = self._class(types[0])
        except ValueError as error:
            self._problem = str(error)
            return
        self._problem, self._type, self._offer = "", types[0], offer.key
        self._subscription = self._node.create_subscription(kind, topic, self._take, self._profile(offer))

    def _class(self, kind: str) -> type:
        """The class of a type's messages; raises `ValueError` with what is said where it cannot be heard."""
        raise NotImplementedError

    def _profile(self, offer: Offer) -> QoSProfile:
        """With which QoS to listen."""
        return offer.profile()

    def _take(self, message: Any) -> None:
        """A message came; called by the executor."""
        raise NotImplementedError

    def _detach(self) -> None:
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
        self._subscription = None
