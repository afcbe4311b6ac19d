"""An executor that is notified of ready entities instead of searching all of them."""

from __future__ import annotations

from rclpy.executors import SingleThreadedExecutor


class EventsExecutor(SingleThreadedExecutor):
    """The same as `SingleThreadedExecutor`: every executor of this runtime is event-driven."""
