"""A turtle in the graph: its topics, services and action."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from bot_console_demos.turtlesim.canvas import Canvas, Pen
from bot_console_demos.turtlesim.motion import COMMAND_TIMEOUT_S, SIDE, Motion, Rotation, single
from geometry_msgs.msg import Twist
from rclpy.action import ActionServer, CancelResponse
from rclpy.duration import Duration
from rclpy.logging import LoggingSeverity
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.task import Future
from turtlesim.action import RotateAbsolute
from turtlesim.msg import Color, Pose
from turtlesim.srv import SetPen, TeleportAbsolute, TeleportRelative

QOS = QoSProfile(depth=1)
LIFE = Duration(seconds=COMMAND_TIMEOUT_S)


def _accept(_: Any) -> CancelResponse:
    return CancelResponse.ACCEPT


class Turtle:
    """Moves as commanded and draws on the canvas; call `update` once per frame."""

    def __init__(self, node: Node, name: str, x: float, y: float, heading: float) -> None:
        self._node = node
        self._motion = Motion(x, SIDE - y if y else SIDE, heading)
        self._pen = Pen()
        self._teleports: list[TeleportAbsolute.Request | TeleportRelative.Request] = []
        self._rotation: tuple[Any, Rotation, Future[float]] | None = None
        self._commanded = node.get_clock().now()
        self._velocities = node.create_subscription(Twist, f"{name}/cmd_vel", self._on_velocity, QOS)
        self._poses = node.create_publisher(Pose, f"{name}/pose", QOS)
        self._colors = node.create_publisher(Color, f"{name}/color_sensor", QOS)
        self._services = [
            node.create_service(SetPen, f"{name}/set_pen", self._on_set_pen),
            node.create_service(TeleportRelative, f"{name}/teleport_relative", self._on_teleport),
            node.create_service(TeleportAbsolute, f"{name}/teleport_absolute", self._on_teleport),
        ]
        self._rotations = ActionServer(
            node,
            RotateAbsolute,
            f"{name}/rotate_absolute",
            execute_callback=self._execute,
            handle_accepted_callback=self._on_rotation,
            cancel_callback=_accept,
        )

    def destroy(self) -> None:
        """Remove the turtle from the graph."""
        if self._rotation is not None:
            self._rotation[2].cancel()
            self._rotation = None
        self._rotations.destroy()
        for service in self._services:
            self._node.destroy_service(service)
        self._node.destroy_subscription(self._velocities)
        self._node.destroy_publisher(self._poses)
        self._node.destroy_publisher(self._colors)

    def _on_velocity(self, message: Twist) -> None:
        self._commanded = self._node.get_clock().now()
        sideways = message.linear.y if self._node.get_parameter("holonomic").value else 0.0
        self._motion.command(message.linear.x, sideways, message.angular.z)
        if self._rotation is not None:
            self._node.get_logger().warning("Velocity command received during rotation goal. Aborting goal")
            self._end_rotation("abort")

    def _on_set_pen(self, request: SetPen.Request, response: SetPen.Response) -> SetPen.Response:
        if request.off:
            self._pen = replace(self._pen, down=False)
        else:
            # Qt draws a pen without a width one pixel wide.
            self._pen = Pen((request.r, request.g, request.b), request.width or 1)
        return response

    def _on_teleport(self, request: Any, response: Any) -> Any:
        self._teleports.append(request)
        return response

    def _on_rotation(self, goal: Any) -> None:
        if self._rotation is not None:
            self._node.get_logger().warning(
                "Rotation goal received before a previous goal finished. Aborting previous goal"
            )
            self._end_rotation("abort")
        self._rotation = goal, Rotation(goal.request.theta, self._motion.heading), Future()
        goal.execute()

    async def _execute(self, goal: Any) -> RotateAbsolute.Result:
        if self._rotation is None or self._rotation[0] is not goal:
            return RotateAbsolute.Result()
        delta = await self._rotation[2]
        return RotateAbsolute.Result(delta=single(delta or 0.0))

    def _end_rotation(self, how: str) -> None:
        if self._rotation is None:
            return
        (goal, rotation, done), self._rotation = self._rotation, None
        getattr(goal, how)()
        done.set_result(rotation.delta)

    def _rotate(self) -> None:
        """Advance the action's goal by one frame, if there is one."""
        if self._rotation is None:
            return
        goal, rotation, _ = self._rotation
        if goal.is_cancel_requested:
            self._node.get_logger().info("Rotation goal canceled")
            self._end_rotation("canceled")
            self._motion.stop()
            return
        done = rotation.drive(self._motion)
        goal.publish_feedback(RotateAbsolute.Feedback(remaining=single(rotation.remaining)))
        if done:
            self._node.get_logger().info("Rotation goal completed successfully")
            self._end_rotation("succeed")
        else:
            self._commanded = self._node.get_clock().now()

    def update(self, canvas: Canvas) -> None:
        """Move for one frame, publish pose and colour, and draw."""
        motion = self._motion
        for request in self._teleports:
            before = motion.x, motion.y
            if isinstance(request, TeleportRelative.Request):
                motion.jump(request.linear, request.angular)
            else:
                motion.teleport(request.x, request.y, request.theta)
            if self._pen.down:
                canvas.line(before, (motion.x, motion.y), self._pen)
        self._teleports.clear()
        self._rotate()
        if self._node.get_clock().now() - self._commanded > LIFE:
            motion.stop()
        before = motion.x, motion.y
        hit = motion.step()
        if hit:
            self._node.get_logger().warning(f"Oh no! I hit the wall! (Clamping from [x={hit[0]:f}, y={hit[1]:f}])")
        self._report(canvas)
        if self._pen.down and before != (motion.x, motion.y):
            canvas.line(before, (motion.x, motion.y), self._pen)

    def _report(self, canvas: Canvas) -> None:
        motion = self._motion
        x, y = motion.position
        self._poses.publish(
            Pose(x=x, y=y, theta=motion.heading, linear_velocity=motion.speed, angular_velocity=motion.turn)
        )
        red, green, blue = canvas.color((motion.x, motion.y))
        self._colors.publish(Color(r=red, g=green, b=blue))
        logger = self._node.get_logger()
        if logger.is_enabled_for(LoggingSeverity.DEBUG):
            space = self._node.get_namespace()
            logger.debug(f"[{space}]: pos_x: {motion.x:f} pos_y: {motion.y:f} theta: {motion.heading:f}")
