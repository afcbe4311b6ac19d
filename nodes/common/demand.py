"""Helps nodes to skip messages that nobody receives: most of a robot's topics rarely have subscribers."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.publisher import Publisher


def has_receiver(publisher: Publisher) -> bool:
    """Whether the publisher currently has a receiver.

    A middleware that has receivers other than subscriptions, such as a recorder of the last minutes, reports them
    itself.
    """
    is_heard: Callable[[], bool] | None = getattr(publisher, "_is_heard", None)
    return publisher.get_subscription_count() > 0 if is_heard is None else is_heard()
