"""When a message is of."""

from __future__ import annotations

from typing import Any

from rclpy.clock import Clock, ROSClock
from rclpy.logging import get_logger
from rclpy.time import Time

HEADERLESS = (
    "can not use message filters messages without timestamp infomation when 'allow_headerless' is disabled. "
    "auto assign ROSTIME to headerless messages once enabling constructor option of 'allow_headerless'."
)


def stamp_of(message: Any, allow_headerless: bool) -> Time | None:
    """The time of a message's header; of one without, now where that is allowed, else None with a warning."""
    header = getattr(message, "header", None)
    if header is not None and hasattr(header, "stamp"):
        stamp = header.stamp
        return stamp if isinstance(stamp, Time) else Time.from_msg(stamp)
    if allow_headerless:
        clock: Clock = ROSClock()
        return clock.now()
    get_logger("message_filters").warning(HEADERLESS)
    return None
