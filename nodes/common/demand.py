"""Skips messages that nobody receives: most of a robot's topics are rarely subscribed to."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.publisher import Publisher


def wanted(publisher: Publisher) -> bool:
    """Whether anybody receives what is published there now.

    A middleware with listeners that are not subscriptions, such as one that records the last minutes, says so itself.
    """
    is_heard: Callable[[], bool] | None = getattr(publisher, "_is_heard", None)
    return publisher.get_subscription_count() > 0 if is_heard is None else is_heard()
