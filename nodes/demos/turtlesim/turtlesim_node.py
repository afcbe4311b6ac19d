#!/usr/bin/env python3
"""Node `turtlesim`: a field on which turtles move and draw. The console's World pane shows it."""

from __future__ import annotations

import sys
from array import array
from typing import Any

from bot_console_demos.running import run
from bot_console_demos.turtlesim.canvas import Canvas
from bot_console_demos.turtlesim.motion import FRAME, PIXELS, SIDE, single
from bot_console_demos.turtlesim.turtle import Turtle
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor, ParameterEvent
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Image
from std_srvs.srv import Empty
from turtlesim.srv import Kill, Spawn

BACKGROUND = {"background_r": ("Red", 0x45), "background_g": ("Green", 0x56), "background_b": ("Blue", 0xFF)}
"""Parameters of the background: the name of the channel, and its default."""
FRAMES_PER_PICTURE = 12
"""Minimum number of frames between two published pictures, since five pictures per second are enough."""
WINDOW_HINT = "To see the turtle, run in another terminal: bot-console attach --pane world"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class TurtleSim(Node):
    """Spawns and kills turtles and moves them once per frame.

    The drawing is published on the hidden topic `~/_canvas`; upstream shows it in a window.
    """

    def __init__(self) -> None:
        super().__init__("turtlesim")
        self._canvas = Canvas()
        self._turtles: dict[str, Turtle] = {}
        self._counted = 0
        self._frames = 0
        self._shown: object = None
        for name, (channel, value) in BACKGROUND.items():
            what = ParameterDescriptor(description=f"{channel} channel of the background color")
            what.integer_range = [IntegerRange(from_value=0, to_value=255, step=1)]
            self.declare_parameter(name, value, what)
        self.declare_parameter(
            "holonomic", False, ParameterDescriptor(description="If true, then turtles will be holonomic")
        )
        self.create_service(Empty, "clear", self._on_clear)
        self.create_service(Empty, "reset", self._on_reset)
        self.create_service(Spawn, "spawn", self._on_spawn)
        self.create_service(Kill, "kill", self._on_kill)
        self.create_subscription(ParameterEvent, "/parameter_events", self._on_event, qos_profile_sensor_data)
        self._pictures = self.create_publisher(Image, "~/_canvas", LATCHED)
        self._background = self._read_background()
        self.get_logger().info(f"Starting turtlesim with node name {self.get_fully_qualified_name()}")
        self._spawn("", SIDE / 2.0, SIDE / 2.0, 0.0)
        self.create_timer(FRAME, self._update, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def _read_background(self) -> tuple[int, int, int]:
        red, green, blue = (int(self.get_parameter(each).value) for each in BACKGROUND)
        return red, green, blue

    def _on_event(self, event: ParameterEvent) -> None:
        if event.node == self.get_fully_qualified_name():
            self._background = self._read_background()

    def _spawn(self, name: str, x: float, y: float, heading: float) -> str:
        """Return the name of a new turtle at a position (m, rad); empty if the name is taken."""
        if name in self._turtles:
            return ""
        while not name or name in self._turtles:
            self._counted += 1
            name = f"turtle{self._counted}"
        x, y, heading = single(x), single(y), single(heading)
        self._turtles[name] = Turtle(self, name, x, y, heading)
        self.get_logger().info(f"Spawning turtle [{name}] at x=[{x:f}], y=[{y:f}], theta=[{heading:f}]")
        return name

    def _on_spawn(self, request: Spawn.Request, response: Spawn.Response) -> Spawn.Response:
        response.name = self._spawn(request.name, request.x, request.y, request.theta)
        if not response.name:
            self.get_logger().error(f"A turtle named [{request.name}] already exists")
        return response

    def _on_kill(self, request: Kill.Request, response: Kill.Response) -> Kill.Response:
        turtle = self._turtles.pop(request.name, None)
        if turtle is None:
            self.get_logger().error(f"Tried to kill turtle [{request.name}], which does not exist")
        else:
            turtle.destroy()
        return response

    def _on_clear(self, _: Any, response: Empty.Response) -> Empty.Response:
        self.get_logger().info("Clearing turtlesim.")
        self._canvas.clear()
        return response

    def _on_reset(self, _: Any, response: Empty.Response) -> Empty.Response:
        self.get_logger().info("Resetting turtlesim.")
        for turtle in self._turtles.values():
            turtle.destroy()
        self._turtles.clear()
        self._counted = 0
        self._spawn("", SIDE / 2.0, SIDE / 2.0, 0.0)
        self._canvas.clear()
        return response

    def _update(self) -> None:
        self._frames += 1
        if self._frames == 1:
            return  # as upstream: the first frame only starts the clock
        for _, turtle in sorted(self._turtles.items()):
            turtle.update(self._canvas)
        if self._frames % FRAMES_PER_PICTURE == 0 and self._pictures.get_subscription_count():
            self._show()

    def _show(self) -> None:
        """Publish the drawing if it has changed."""
        now = self._canvas.changes, self._background
        if now == self._shown:
            return
        self._shown = now
        message = Image(height=PIXELS, width=PIXELS, encoding="rgba8", step=4 * PIXELS)
        message.header.stamp = self.get_clock().now().to_msg()
        message.data = array("B", self._canvas.picture(self._background).tobytes())
        self._pictures.publish(message)


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    if sys.stdout is not None and sys.stdout.isatty():
        print(WINDOW_HINT, flush=True)
    run(TurtleSim, args)


if __name__ == "__main__":
    main()
