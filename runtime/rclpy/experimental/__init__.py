"""Names that later releases of Jazzy have here."""

from rclpy.experimental.events_executor import EventsExecutor

__all__ = ["EventsExecutor"]
