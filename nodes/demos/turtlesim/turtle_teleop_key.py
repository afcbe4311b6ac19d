#!/usr/bin/env python3
"""Node `teleop_turtle`: drives `turtle1` with the arrow keys, and turns it with goals of `rotate_absolute`."""

from __future__ import annotations

import contextlib
import sys
import threading
from typing import Any

import rclpy
from bot_console_demos.turtlesim.keyboard import Keyboard, NoKeyboard
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile
from turtlesim.action import RotateAbsolute

HELP = """Reading from keyboard
---------------------------
Use arrow keys to move the turtle.
Use g|b|v|c|d|e|r|t keys to rotate to absolute orientations. 'f' to cancel a rotation.
'q' to quit."""
NO_KEYBOARD = (
    "turtle_teleop_key reads the keyboard, but its standard input is not a terminal. Run it in a terminal of its own: "
    "bot-console run turtlesim turtle_teleop_key"
)
MOVES = {"A": (1.0, 0.0), "B": (-1.0, 0.0), "C": (0.0, -1.0), "D": (0.0, 1.0)}
"""Forward and turn velocity by the final character of an arrow key."""
DIRECTIONS = {
    "g": 0.0, "t": 0.7854, "r": 1.5708, "e": 2.3562, "d": 3.1416, "c": -2.3562, "v": -1.5708, "b": -0.7854,
}  # fmt: skip
"""Headings (rad) by key; on the keyboard, the keys lie around `f` in these directions."""


class TeleopTurtle(Node):
    """Converts keys to velocities and goals."""

    def __init__(self) -> None:
        super().__init__("teleop_turtle")
        self.declare_parameter("scale_angular", 2.0)
        self.declare_parameter("scale_linear", 2.0)
        self._twists = self.create_publisher(Twist, "turtle1/cmd_vel", QoSProfile(depth=1))
        self._rotations = ActionClient(self, RotateAbsolute, "turtle1/rotate_absolute")
        self._goal: Any = None

    def take(self, key: str) -> None:
        """Handle a key."""
        if key in MOVES:
            forward, turn = MOVES[key]
            twist = Twist()
            twist.linear.x = self.get_parameter("scale_linear").value * forward
            twist.angular.z = self.get_parameter("scale_angular").value * turn
            self._twists.publish(twist)
        elif key in DIRECTIONS:
            asked = self._rotations.send_goal_async(RotateAbsolute.Goal(theta=DIRECTIONS[key]))
            asked.add_done_callback(self._on_answer)
        elif key == "f" and self._goal is not None:
            self._goal.cancel_goal_async()

    def _on_answer(self, answer: Any) -> None:
        self._goal = answer.result()


def main(args: list[str] | None = None) -> None:
    """Read keys until `q`, Ctrl-C or the end of the terminal."""
    try:
        with Keyboard() as keyboard, contextlib.suppress(KeyboardInterrupt, EOFError):
            _drive(keyboard, args)
    except NoKeyboard:
        print(NO_KEYBOARD, file=sys.stderr)
        sys.exit(1)


def _drive(keyboard: Keyboard, args: list[str] | None) -> None:
    rclpy.init(args=args)
    node = TeleopTurtle()
    spinning = threading.Thread(target=_spin, args=(node,), daemon=True)
    spinning.start()
    try:
        print(HELP, flush=True)
        while rclpy.ok() and (key := keyboard.read()) != "q":
            node.take(key)
    finally:
        rclpy.try_shutdown()
        spinning.join(timeout=1.0)
        node.destroy_node()


def _spin(node: Node) -> None:
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node)


if __name__ == "__main__":
    main()
