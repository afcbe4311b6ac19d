"""The base of clocks, for modules below `rclpy.clock`."""

from __future__ import annotations

from typing import Any


class AnyClock:
    """Base of `rclpy.clock.Clock`, by which a logger knows one without importing that module."""

    def now(self) -> Any:
        """The time now; has `nanoseconds`."""
        raise NotImplementedError
