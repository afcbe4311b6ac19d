"""The base of clocks, for modules below `rclpy.clock`."""

from __future__ import annotations

from typing import Protocol


class Nanoseconds(Protocol):
    """A time."""

    @property
    def nanoseconds(self) -> int:
        """Nanoseconds since the clock's zero."""
        ...


class AnyClock:
    """Base of `rclpy.clock.Clock`, by which a logger recognises a clock without importing that module."""

    def now(self) -> Nanoseconds:
        """Return the current time, an object with `nanoseconds`."""
        raise NotImplementedError
