"""What nobody gets is not made: most of a robot's messages are for whoever happens to look."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.publisher import Publisher


def wanted(publisher: Publisher) -> bool:
    """Whether anybody gets what is published there now.

    Where the middleware has listeners that are no subscriptions, such as one that keeps what was, it says so itself.
    """
    is_heard: Callable[[], bool] | None = getattr(publisher, "_is_heard", None)
    return publisher.get_subscription_count() > 0 if is_heard is None else is_heard()
