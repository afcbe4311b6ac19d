"""The old name of `rclpy.event_handler`; as upstream, importing it gives a warning."""

import warnings

from rclpy.event_handler import *  # noqa: F403 -- the same names
from rclpy.event_handler import EventHandler as QoSEventHandler  # noqa: F401 # pyright: ignore[reportUnusedImport] -- the class had this name

warnings.warn("importing 'qos_event' is deprecated; import 'event_handler' instead", stacklevel=2)
