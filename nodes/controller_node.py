#!/usr/bin/env python3
"""Node `motion_controller`: ramps the robot's velocity towards the navigator's request, or follows waypoints."""

from __future__ import annotations

import math

from bot_console_robot.common.parameters import number, plain
from bot_console_robot.common.running import run
from bot_console_robot.motion import Gains, VelocityController, WaypointFollower
from bot_console_robot.safety.age_limits import MAX_AGE_NS
from geometry_msgs.msg import PoseStamped, Quaternion, Twist
from nav_msgs.msg import Odometry, Path
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile

CONTROL_PERIOD_S = 0.05
"""Interval between commands, in s."""
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class MotionController(Node):
    """Publishes `cmd_vel` from `cmd_vel_desired`, `goal_pose`, and the `route` while `follow_route` is true."""

    def __init__(self) -> None:
        super().__init__("motion_controller", enable_logger_service=True)
        self.declare_parameter("kp_linear", 3.0, number("Gain from speed or distance error (1/s)", 0.1, 20.0))
        self.declare_parameter("kp_angular", 6.0, number("Gain from turn rate or heading error (1/s)", 0.1, 20.0))
        self.declare_parameter("max_acceleration", 1.0, number("Maximum linear acceleration (m/s²)", 0.1, 10.0))
        self.declare_parameter("follow_route", False, plain("Drive along the world's waypoints, repeatedly"))
        self.add_post_set_parameters_callback(self._apply)
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._velocity = VelocityController()
        self._follower = WaypointFollower()
        self._route: list[tuple[float, float]] = []
        self._desired: tuple[float, float] | None = None
        self._desired_stamp = 0
        self._odometry: Odometry | None = None
        self._silent = True
        self._gains = self._read_gains()
        self._commands = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Twist, "cmd_vel_desired", self._on_desired, 10)
        self.create_subscription(Odometry, "odom", self._on_odometry, 10)
        self.create_subscription(PoseStamped, "goal_pose", self._on_goal, 10)
        self.create_subscription(Path, "route", self._on_route, LATCHED)
        self.create_timer(CONTROL_PERIOD_S, self._control, clock=self._steady)
        self.get_logger().info("Controlling the velocity")

    def _read_gains(self) -> Gains:
        names = ("kp_linear", "kp_angular", "max_acceleration")
        return Gains(*(float(self.get_parameter(name).value) for name in names))

    def _apply(self, changes: list[Parameter]) -> None:
        self._gains = self._read_gains()
        for change in changes:
            self.get_logger().info(f"✓ {change.name}: {change.value}")
            if change.name == "follow_route":
                self._start_route()

    def _start_route(self) -> None:
        following = bool(self.get_parameter("follow_route").value)
        self._follower.follow(self._route if following else [], loop=True)
        if following and not self._route:
            self.get_logger().warning("follow_route is true, but no waypoints have been received on topic 'route' yet")

    def _on_route(self, route: Path) -> None:
        self._route = [(each.pose.position.x, each.pose.position.y) for each in route.poses]
        if self.get_parameter("follow_route").value:
            self._start_route()

    def _on_goal(self, goal: PoseStamped) -> None:
        place = goal.pose.position
        if not (math.isfinite(place.x) and math.isfinite(place.y)):
            self.get_logger().warning("Goal on goal_pose ignored: its position is not a finite number")
            return
        self._follower.follow([(place.x, place.y)])
        self.get_logger().info(f"Going to x = {place.x:.2f} m, y = {place.y:.2f} m")

    def _on_odometry(self, message: Odometry) -> None:
        self._odometry = message  # Evaluated only when there is a goal: odometry arrives 20 times a second.

    def _on_desired(self, message: Twist) -> None:
        wanted = (message.linear.x, message.angular.z)
        self._desired = wanted if all(map(math.isfinite, wanted)) else (0.0, 0.0)
        self._desired_stamp = self._steady.now().nanoseconds

    def _control(self) -> None:
        fresh = self._steady.now().nanoseconds - self._desired_stamp <= MAX_AGE_NS
        allowed = self._desired if fresh else None
        target = self._follower.target
        pose = _pose_of(self._odometry) if target and self._odometry is not None else None
        if pose and target and self._follower.arrived(pose[0], pose[1]):
            self.get_logger().info(f"Reached x = {target[0]:.2f} m, y = {target[1]:.2f} m")
        if pose and self._follower.target:
            wanted = self._follower.steer(pose, allowed, CONTROL_PERIOD_S, self._gains)
        elif allowed:
            wanted = allowed
        else:
            self._fall_silent()
            return
        self._silent = False
        self._publish(*self._velocity.step(*wanted, CONTROL_PERIOD_S, self._gains))

    def _fall_silent(self) -> None:
        """Publish one zero velocity and then nothing, so that others can drive."""
        if not self._silent:
            self._silent = True
            self._velocity.reset()
            self._publish(0.0, 0.0)

    def _publish(self, linear: float, angular: float) -> None:
        command = Twist()
        command.linear.x, command.angular.z = linear, angular
        self._commands.publish(command)


def _pose_of(message: Odometry) -> tuple[float, float, float] | None:
    """Return x, y (m) and heading (rad), or None if one of them is not finite."""
    place = message.pose.pose
    pose = (place.position.x, place.position.y, _heading(place.orientation))
    return pose if all(map(math.isfinite, pose)) else None


def _heading(q: Quaternion) -> float:
    """Return the yaw (rad) of a quaternion."""
    return 2.0 * math.atan2(q.z, q.w)


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(MotionController, args)


if __name__ == "__main__":
    main()
