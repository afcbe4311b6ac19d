"""The time stamp of a message."""

from __future__ import annotations

from typing import Any

from rclpy.clock import Clock, ROSClock
from rclpy.logging import get_logger
from rclpy.time import Time

HEADERLESS = (
    "can not use message filters {}messages without timestamp infomation when 'allow_headerless' is disabled. "
    "auto assign ROSTIME to headerless messages once enabling constructor option of 'allow_headerless'."
)
WORDS = {"approx": HEADERLESS.format("for "), "cache": HEADERLESS.format("")}
"""Warnings about messages without a stamp, by the kind of filter that cannot use them."""


def header_stamp(message: Any) -> Time:
    """Return the time in a message's header; raises `AttributeError` if it has no header."""
    stamp = message.header.stamp
    return stamp if isinstance(stamp, Time) else Time.from_msg(stamp)


def stamp_of(message: object, allow_headerless: bool, kind: str) -> Time | None:
    """Return the time in a message's header; without one, the current time if allowed, else None with a warning."""
    header = getattr(message, "header", None)
    if header is not None and hasattr(header, "stamp"):
        return header_stamp(message)
    if allow_headerless:
        clock: Clock = ROSClock()
        return clock.now()
    get_logger(f"message_filters_{kind}").warning(WORDS[kind])
    return None
