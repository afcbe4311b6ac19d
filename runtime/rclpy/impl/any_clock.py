"""The base of clocks, for modules below `rclpy.clock`."""

from __future__ import annotations

from typing import Any


class AnyClock:
    """Base of `rclpy.clock.Clock`, by which a logger recognises a clock without importing that module."""

    def now(self) -> Any:
        """The current time, an object with `nanoseconds`."""
        raise NotImplementedError
