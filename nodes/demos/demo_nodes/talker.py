"""Nodes that publish a greeting repeatedly; those of the C++ package start counting at 1."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from bot_console_demos.demo_nodes.qos_options import qos_options
from bot_console_demos.running import run
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from std_msgs.msg import String


@dataclass(frozen=True)
class Manner:
    """How a talker behaves: `quote` surrounds the logged text, `period` is in s."""

    name: str = "talker"
    topic: str = "chatter"
    period: float = 1.0
    first: int = 0
    quote: str = '"'
    qos: QoSProfile | int = 10


CPP = Manner(first=1, quote="'", qos=7)
MINIMAL = Manner("minimal_publisher", "topic", 0.5)


class Talker(Node):
    """Publishes numbered greetings."""

    def __init__(self, manner: Manner) -> None:
        super().__init__(manner.name)
        self._number, self._quote = manner.first, manner.quote
        self._messages = self.create_publisher(String, manner.topic, manner.qos)
        self.create_timer(manner.period, self._tick)

    def _tick(self) -> None:
        message = String(data=f"Hello World: {self._number}")
        self._number += 1
        self.get_logger().info(f"Publishing: {self._quote}{message.data}{self._quote}")
        self._messages.publish(message)


class QosTalker(Talker):
    """Logs its reliability before it publishes."""

    def __init__(self, reliable: bool) -> None:
        super().__init__(Manner("talker_qos", qos=10 if reliable else qos_profile_sensor_data))
        self.get_logger().info("Reliable talker" if reliable else "Best effort talker")


def main_cpp(args: list[str] | None = None) -> None:
    """Entry point of `demo_nodes_cpp`."""
    run(partial(Talker, CPP), args)


def main_py(args: list[str] | None = None) -> None:
    """Entry point of `demo_nodes_py`."""
    run(partial(Talker, Manner()), args)


def main_qos(args: list[str] | None = None) -> None:
    """Entry point of the talker of `demo_nodes_py` with the options `--reliable` and `-n` (number of callbacks)."""
    reliable, cycles = qos_options(args, "number of sending attempts")
    run(partial(QosTalker, reliable), args, cycles)


def main_minimal(args: list[str] | None = None) -> None:
    """Entry point of every publisher of `examples_rclpy_minimal_publisher`, which differ only in their source code."""
    run(partial(Talker, MINIMAL), args)
