"""A subscription to one topic, which exists while somebody needs it and adapts to the QoS that is offered."""

from __future__ import annotations

from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics.offered_topics import Offer, offered_qos, offered_types_of
from rclpy.node import Node
from rclpy.qos import QoSProfile


class FollowedTopic:
    """Subscribes when the topic appears, again when its type or the offered QoS changes, and ends when no longer
    needed.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._topic = ""
        self._type = ""
        self._offer: object = None
        self._subscription: Any = None
        self._problem = ""

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph: the topic may have appeared, or be offered with another QoS."""
        topic = self._topic
        types = offered_types_of(graph, topic) if topic else ()
        if not topic or not types:
            self._problem = f"there is currently no topic {topic}" if topic and self._subscription is None else ""
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

        def take(message: Any) -> None:
            if topic == self._topic:  # else it was on its way when another topic was chosen
                self._take(message)

        self._subscription = self._node.create_subscription(kind, topic, take, self._profile(offer))

    def _class(self, kind: str) -> type:
        """The message class of a type; raises `ValueError` with a message for the user if it cannot be used."""
        raise NotImplementedError

    def _profile(self, offer: Offer) -> QoSProfile:
        """The QoS profile of the subscription."""
        return offer.profile()

    def _take(self, message: Any) -> None:
        """Process a message; called by the executor."""
        raise NotImplementedError

    def _detach(self) -> None:
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
        self._subscription = None
