"""Names that are here in later releases of Jazzy."""

from rclpy.experimental.events_executor import EventsExecutor

__all__ = ["EventsExecutor"]
