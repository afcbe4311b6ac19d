"""An executor that is told what is ready instead of looking through all entities."""

from __future__ import annotations

from rclpy.executors import SingleThreadedExecutor


class EventsExecutor(SingleThreadedExecutor):
    """The same as `SingleThreadedExecutor`: every executor of this runtime is event-driven."""
