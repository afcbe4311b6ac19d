"""The `/rosout` publisher of a node, for its logger and that logger's children."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from rclpy import logging
from rclpy.constants import S_TO_NS
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.publisher import Publisher

ROSOUT = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class LoggingNode(Protocol):
    """What publishing log lines needs of a node."""

    def get_logger(self) -> RcutilsLogger:
        """Return the node's logger."""
        ...

    def create_publisher(self, msg_type: type[Message], topic: str, qos_profile: QoSProfile) -> Publisher:
        """Create a publisher."""
        ...


class Rosout:
    """Publishes a node's log lines."""

    def __init__(self, node: LoggingNode) -> None:
        from rcl_interfaces.msg import Log

        self._log = Log
        self._name = node.get_logger().name
        self.publisher = node.create_publisher(Log, "/rosout", ROSOUT)
        self._endpoint = self.publisher._endpoint
        logging.register_rosout(self._name, self._publish)

    def _publish(self, severity: int, name: str, text: str, file: str, function: str, line: int, stamp_ns: int) -> bool:
        message = self._log()
        # Bypasses the properties and their checks, which the logger's own values do not need, as this runs for each
        # line.
        stamp = message._stamp
        stamp._sec, stamp._nanosec = divmod(stamp_ns, S_TO_NS)
        message._level = severity
        message._name = name
        message._msg = _encodable(text)
        message._file = _encodable(file)  # a path can consist of any bytes
        message._function = function
        message._line = line
        return self._endpoint.publish_own(message)

    def close(self) -> None:
        """Stop publishing."""
        logging.unregister_rosout(self._name)


def _encodable(text: str) -> str:
    return text if text.isascii() else text.encode("utf-8", "replace").decode()
