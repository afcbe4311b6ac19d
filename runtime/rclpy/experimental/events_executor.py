"""An executor that is notified of ready entities instead of searching all of them."""

from __future__ import annotations

from rclpy.executors import SingleThreadedExecutor


class EventsExecutor(SingleThreadedExecutor):
    """Works like `SingleThreadedExecutor`, as every executor of this runtime is event-driven."""
