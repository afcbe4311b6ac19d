"""Program `republish`: forwards images from one transport (`in`, `in/compressed`) through another one (`out` ...)."""

from __future__ import annotations

import sys
from functools import partial
from typing import Any

from bot_console_demos.image_transport.transports import RAW, TRANSPORTS, available, decoded, encoded, topic_of
from bot_console_demos.running import run
from cv_bridge import CvBridgeError
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

USAGE = "usage: republish [IN_TRANSPORT [OUT_TRANSPORT]] --ros-args -r in:=TOPIC -r out:=TOPIC; transports: {}"
QUEUE = 10
"""Depth of the history of subscriptions and publishers."""


class Republisher(Node):
    """Subscribes only while its output has subscribers; offers all available transports if none is given."""

    def __init__(self, given: list[str]) -> None:
        super().__init__("image_republisher")
        defaults = [*given, *[RAW, ""][len(given) :]]
        self._from, chosen = (
            str(self.declare_parameter(name, default).value)
            for name, default in zip(("in_transport", "out_transport"), defaults, strict=True)
        )
        for name in filter(None, (self._from, chosen)):
            check(name)
        self._subscription: Any = None
        events = PublisherEventCallbacks(matched=lambda _: self._follow())
        self._publishers_by = {
            name: self.create_publisher(TRANSPORTS[name], topic_of("out", name), QUEUE, event_callbacks=events)
            for name in ([chosen] if chosen else available())
        }
        self.get_logger().info(f"Republishing {self._from} images as {', '.join(self._publishers_by)}")

    def _follow(self) -> None:
        wanted = any(each.get_subscription_count() for each in self._publishers_by.values())
        if wanted and self._subscription is None:
            kind, topic = TRANSPORTS[self._from], topic_of("in", self._from)
            self._subscription = self.create_subscription(kind, topic, self._on_image, QUEUE)
        elif not wanted and self._subscription is not None:
            self.destroy_subscription(self._subscription)
            self._subscription = None

    def _on_image(self, message: Any) -> None:
        try:
            image = decoded(message, self._from)
            for name, publisher in self._publishers_by.items():
                if publisher.get_subscription_count():
                    publisher.publish(encoded(image, name))
        except CvBridgeError as error:
            self.get_logger().error(f"Image dropped: {error}", throttle_duration_sec=1.0)


def check(transport: str) -> None:
    """Exit with the reason if a transport is not available."""
    if transport in available():
        return
    why = (
        "it needs OpenCV: pip install 'bot-console[opencv]'" if transport in TRANSPORTS
        else f"available transports: {', '.join(TRANSPORTS)}"
    )  # fmt: skip
    get_logger("image_republisher").fatal(f"no transport '{transport}': {why}")
    sys.exit(1)


def main(args: list[str] | None = None) -> None:
    """Republish until stopped."""
    words = remove_ros_args(args)[1:]
    if len(words) > 2 or any(each.startswith("-") for each in words):
        print(USAGE.format(", ".join(TRANSPORTS)), file=sys.stderr)
        sys.exit(1)
    run(partial(Republisher, words), args)


def list_transports(args: list[str] | None = None) -> None:
    """Print the transports, and what to install for those that are unavailable."""
    print("Declared transports:")
    for name in TRANSPORTS:
        print(f"image_transport/{name}{'' if name in available() else ' (*): pip install bot-console[opencv]'}")
