"""What later releases of Jazzy have under this name."""

from rclpy.experimental.events_executor import EventsExecutor

__all__ = ["EventsExecutor"]
