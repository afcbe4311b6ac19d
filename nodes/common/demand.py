"""Skips messages that have no subscriber: most of a robot's topics are rarely subscribed to."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.publisher import Publisher


def wanted(publisher: Publisher) -> bool:
    """Whether the publisher currently has a receiver.

    A middleware may have receivers that are not subscriptions, such as a recorder of the last minutes; it reports those
    itself.
    """
    is_heard: Callable[[], bool] | None = getattr(publisher, "_is_heard", None)
    return publisher.get_subscription_count() > 0 if is_heard is None else is_heard()
