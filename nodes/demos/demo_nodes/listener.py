"""Nodes that log what they receive."""

from __future__ import annotations

from functools import partial

from bot_console_demos.demo_nodes.qos_options import qos_options
from bot_console_demos.running import run
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from std_msgs.msg import String


class Listener(Node):
    """Logs each message, between brackets or quotes."""

    def __init__(self, name: str, topic: str = "chatter", qos: QoSProfile | int = 10, marks: str = "[]") -> None:
        super().__init__(name)
        self._marks = marks
        self.create_subscription(String, topic, self._on_message, qos)

    def _on_message(self, message: String) -> None:
        before, after = self._marks
        self.get_logger().info(f"I heard: {before}{message.data}{after}")


class QosListener(Listener):
    """Logs its reliability before it subscribes."""

    def __init__(self, reliable: bool) -> None:
        super().__init__("listener_qos", qos=10 if reliable else qos_profile_sensor_data)
        self.get_logger().info("Reliable listener" if reliable else "Best effort listener")


class SerializedListener(Node):
    """Logs each message in its serialized form."""

    def __init__(self) -> None:
        super().__init__("serialized_subscriber")
        self.create_subscription(String, "chatter", self._on_bytes, 10, raw=True)

    def _on_bytes(self, message: bytes) -> None:
        self.get_logger().info(f'I heard: "{message}"')


def main(args: list[str] | None = None) -> None:
    """Entry point in both packages."""
    run(partial(Listener, "listener"), args)


def main_best_effort(args: list[str] | None = None) -> None:
    """Entry point of the best-effort listener of `demo_nodes_cpp`."""
    run(partial(Listener, "listener", qos=qos_profile_sensor_data), args)


def main_qos(args: list[str] | None = None) -> None:
    """Entry point of the listener of `demo_nodes_py` with the options `--reliable` and `-n` (number of callbacks)."""
    reliable, cycles = qos_options(args, "max number of spin_once iterations")
    run(partial(QosListener, reliable), args, cycles)


def main_serialized(args: list[str] | None = None) -> None:
    """Entry point of the serialized listener of `demo_nodes_py`."""
    run(SerializedListener, args)


def main_minimal(args: list[str] | None = None) -> None:
    """Entry point of every subscriber of `examples_rclpy_minimal_subscriber`."""
    run(partial(Listener, "minimal_subscriber", "topic", marks='""'), args)
