#!/usr/bin/env python3
"""Node `bt_navigator`: Nav2's actions for the built-in robot, under the names that programs use.

`navigate_to_pose`, `navigate_through_poses`, `follow_waypoints`, `spin`, `backup`, `drive_on_heading`, `wait`,
`compute_path_to_pose`, and `goal_pose` for a goal without feedback. It plans on the map and publishes `cmd_vel`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import nav2_msgs.action  # pyright: ignore[reportMissingImports] -- made when it is imported
import nav2_msgs.msg  # pyright: ignore[reportMissingImports] -- made when it is imported
from bot_console_robot.common.parameters import fixed, number
from bot_console_robot.common.running import run
from bot_console_robot.navigation.action_goal import Goal, run_goal
from bot_console_robot.navigation.goal_motion import DriveStraight, FollowPath, Spin, Task, Wait
from bot_console_robot.navigation.path_following import Point
from bot_console_robot.navigation.planner import NoPath
from bot_console_robot.navigation.world_model import WorldModel
from bot_console_robot.simulation_ros.messages import heading_of, quaternion
from geometry_msgs.msg import Pose, PoseStamped, Twist, TwistStamped
from lifecycle_msgs.msg import State
from lifecycle_msgs.srv import GetState
from nav_msgs.msg import Path
from rclpy.action import ActionServer, CancelResponse
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

if TYPE_CHECKING:
    from rclpy.action.server import ServerGoalHandle

ACTIONS: Any = nav2_msgs.action  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- the same
MESSAGES: Any = nav2_msgs.msg  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- the same
"""The messages are generated when they are imported, so a type checker does not know them."""
CONTROL_PERIOD_S = 0.05
"""Interval between control steps, in s."""
NO_VALID_PATH = 208
"""Error code of Nav2."""
NAV2_NODES = ("bt_navigator", "amcl")
"""Nav2 nodes whose service `get_state` programs wait for before they start."""


class Navigator(Node):
    """Executes one goal at a time; a new goal replaces the present one."""

    def __init__(self) -> None:
        super().__init__("bt_navigator", enable_logger_service=True)
        self.declare_parameter("max_speed", 0.4, number("Maximum speed on a path (m/s)", 0.05, 3.0))
        self.declare_parameter("max_turn_rate", 1.0, number("Maximum turn rate (rad/s)", 0.1, 4.0))
        self.declare_parameter(
            "xy_goal_tolerance", 0.15, number("Distance to a goal at which it counts as reached (m)", 0.02, 1.0)
        )
        self.declare_parameter("yaw_goal_tolerance", 0.1, number("Heading tolerance at a goal (rad)", 0.02, math.pi))
        self.declare_parameter("robot_radius", 0.2, number("Radius of the robot, used for planning (m)", 0.05, 1.0))
        self.declare_parameter(
            "enable_stamped_cmd_vel", False, fixed("Publish TwistStamped on cmd_vel instead of Twist")
        )
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._stamped = bool(self.get_parameter("enable_stamped_cmd_vel").value)
        self._commands = self.create_publisher(TwistStamped if self._stamped else Twist, "cmd_vel", 10)
        self._plans = self.create_publisher(Path, "plan", 1)
        self._known = WorldModel(self, self._seconds)
        self._current: Goal | None = None
        self.create_subscription(PoseStamped, "goal_pose", self._on_goal_pose, 10)
        for name in NAV2_NODES:
            self.create_service(GetState, f"{name}/get_state", _active)
        self._servers = [
            self._server(ACTIONS.NavigateToPose, "navigate_to_pose", self._to_pose),
            self._server(ACTIONS.NavigateThroughPoses, "navigate_through_poses", self._through_poses),
            self._server(ACTIONS.FollowWaypoints, "follow_waypoints", self._waypoints),
            self._server(ACTIONS.Spin, "spin", self._spin),
            self._server(ACTIONS.BackUp, "backup", partial(self._straight, -1.0)),
            self._server(ACTIONS.DriveOnHeading, "drive_on_heading", partial(self._straight, 1.0)),
            self._server(ACTIONS.Wait, "wait", self._wait),
            self._server(ACTIONS.ComputePathToPose, "compute_path_to_pose", self._compute),
        ]
        self.create_timer(CONTROL_PERIOD_S, self._control, clock=self._steady)
        self.get_logger().info("Ready for goals on navigate_to_pose and goal_pose")

    def _server(self, kind: Any, name: str, execute: Callable[[Any], Any]) -> Any:
        return ActionServer(self, kind, name, execute, cancel_callback=_accept)

    def _seconds(self) -> float:
        return self._steady.now().nanoseconds * 1e-9

    def _control(self) -> None:
        goal, seen = self._current, self._known.observation()
        if goal is None or seen is None:
            return
        if goal.cancelled:
            self._end(goal)
            return
        self._drive(*goal.task.step(seen))
        if goal.task.done:
            self._end(goal)

    def _end(self, goal: Goal) -> None:
        self._drive(0.0, 0.0)
        if self._current is goal:
            self._current = None
        goal.finish()

    def _drive(self, speed: float, turn: float) -> None:
        twist = Twist()
        twist.linear.x, twist.angular.z = speed, turn
        if not self._stamped:
            self._commands.publish(twist)
            return
        message = TwistStamped(twist=twist)
        message.header.stamp, message.header.frame_id = self.get_clock().now().to_msg(), "base_link"
        self._commands.publish(message)

    def _begin(self, task: Task, handle: ServerGoalHandle | None = None) -> Goal:
        """Start a task, aborting the previous one."""
        before, self._current = self._current, None
        if before is not None:
            before.preempted = True
            before.finish()
        self._current = Goal(task, handle)
        return self._current

    def _plan(self, poses: Sequence[Pose]) -> tuple[list[Point], float]:
        """Return the path through all poses, and the heading of the last one; raises `NoPath`."""
        if not poses:
            raise NoPath("no pose was given")
        if self._known.pose is None:
            raise NoPath("the robot's position is unknown: nothing received on ground_truth or odom")
        here, points = self._known.pose[:2], list[Point]()
        for pose in poses:
            points += self._known.plan(points[-1] if points else here, (pose.position.x, pose.position.y))
        heading = heading_of(poses[-1].orientation)
        self._plans.publish(self._path([here, *points]))
        return points, heading

    def _path(self, points: Sequence[Point]) -> Path:
        path = Path()
        path.header.stamp, path.header.frame_id = self.get_clock().now().to_msg(), "map"
        poses: list[PoseStamped] = []
        for (x, y), (to_x, to_y) in zip(points, [*points[1:], points[-1]], strict=True):
            pose = PoseStamped(header=path.header)
            pose.pose.position.x, pose.pose.position.y = x, y
            pose.pose.orientation = quaternion(math.atan2(to_y - y, to_x - x))
            poses.append(pose)
        path.poses = poses
        return path

    def _on_goal_pose(self, message: PoseStamped) -> None:
        try:
            points, heading = self._plan([message.pose])
        except NoPath as error:
            self.get_logger().warning(f"Goal on goal_pose ignored: {error}")
            return
        self._announce(message.pose)
        goal = self._begin(FollowPath(points, heading, self._known.limits()))
        goal.done.add_done_callback(lambda done: self._publish_result(done.result() or 0))

    def _announce(self, pose: Pose) -> None:
        here = self._known.pose or (0.0, 0.0, 0.0)
        self.get_logger().info(
            f"Begin navigating from current location ({here[0]:.2f}, {here[1]:.2f}) "
            f"to ({pose.position.x:.2f}, {pose.position.y:.2f})"
        )

    def _publish_result(self, code: int) -> None:
        self.get_logger().info("Goal succeeded" if not code else f"Goal failed, error code {code}")

    async def _travel(
        self, handle: ServerGoalHandle, poses: Sequence[Pose], feedback: Callable[[FollowPath, Any], None], kind: Any
    ) -> int:
        """Drive through poses as one path; returns Nav2's error code, 0 when the goal is reached."""
        try:
            points, heading = self._plan(poses)
        except NoPath as error:
            self.get_logger().error(f"Goal failed: {error}")
            handle.abort()
            return NO_VALID_PATH
        self._announce(poses[-1])
        task = FollowPath(points, heading, self._known.limits())
        message = kind.Feedback()
        code = await run_goal(self, self._begin(task, handle), lambda: feedback(task, message), message)
        self._publish_result(code)
        return code

    async def _to_pose(self, handle: ServerGoalHandle) -> Any:
        code = await self._travel(handle, [handle.request.pose.pose], self._publish_path, ACTIONS.NavigateToPose)
        return ACTIONS.NavigateToPose.Result(error_code=code)

    async def _through_poses(self, handle: ServerGoalHandle) -> Any:
        poses = [each.pose for each in handle.request.poses]

        def report(task: FollowPath, message: Any) -> None:
            self._publish_path(task, message)
            message.number_of_poses_remaining = _left_of(poses, task, self._known.pose)

        return ACTIONS.NavigateThroughPoses.Result(
            error_code=await self._travel(handle, poses, report, ACTIONS.NavigateThroughPoses)
        )

    def _publish_path(self, task: FollowPath, message: Any) -> None:
        pose = self._known.pose or (0.0, 0.0, 0.0)
        message.current_pose.header.stamp = self.get_clock().now().to_msg()
        message.current_pose.header.frame_id = "map"
        place = message.current_pose.pose
        place.position.x, place.position.y = pose[0], pose[1]
        place.orientation = quaternion(pose[2])
        message.distance_remaining = task.left(pose)
        message.navigation_time.sec = int(self._current.age(self._seconds())) if self._current else 0
        message.estimated_time_remaining.sec = int(task.left(pose) / self._known.limits().speed)

    async def _waypoints(self, handle: ServerGoalHandle) -> Any:
        result = ACTIONS.FollowWaypoints.Result()
        message = ACTIONS.FollowWaypoints.Feedback()
        for index, stamped in enumerate(handle.request.poses):
            message.current_waypoint = index
            handle.publish_feedback(message)
            try:
                points, heading = self._plan([stamped.pose])
                goal = self._begin(FollowPath(points, heading, self._known.limits()), handle)
            except NoPath:
                code = NO_VALID_PATH
            else:
                code = await goal.done
                if handle.is_cancel_requested or goal.preempted:
                    goal.settle()
                    return result
            if code:
                missed = MESSAGES.MissedWaypoint(index=index, goal=stamped, error_code=code)
                result.missed_waypoints = [*result.missed_waypoints, missed]
        handle.succeed()
        return result

    async def _spin(self, handle: ServerGoalHandle) -> Any:
        task, message = Spin(handle.request.target_yaw, self._known.limits()), ACTIONS.Spin.Feedback()

        def report() -> None:
            message.angular_distance_traveled = task.turned

        goal = self._begin(task, handle)
        code = await run_goal(self, goal, report, message)
        return ACTIONS.Spin.Result(error_code=code, total_elapsed_time=goal.duration(self._seconds()))

    async def _straight(self, sign: float, handle: ServerGoalHandle) -> Any:
        kind = ACTIONS.BackUp if sign < 0 else ACTIONS.DriveOnHeading
        asked, message = handle.request, kind.Feedback()
        distance = sign * abs(asked.target.x)
        allowance = asked.time_allowance.sec + asked.time_allowance.nanosec * 1e-9
        task = DriveStraight(distance, asked.speed, allowance, self._known.limits())

        def report() -> None:
            message.distance_traveled = task.travelled

        goal = self._begin(task, handle)
        code = await run_goal(self, goal, report, message)
        return kind.Result(error_code=code, total_elapsed_time=goal.duration(self._seconds()))

    async def _wait(self, handle: ServerGoalHandle) -> Any:
        asked, message = handle.request.time, ACTIONS.Wait.Feedback()
        task = Wait(asked.sec + asked.nanosec * 1e-9)

        def report() -> None:
            message.time_left.sec, message.time_left.nanosec = divmod(int(task.left * 1e9), 1_000_000_000)

        goal = self._begin(task, handle)
        code = await run_goal(self, goal, report, message)
        return ACTIONS.Wait.Result(error_code=code, total_elapsed_time=goal.duration(self._seconds()))

    def _compute(self, handle: ServerGoalHandle) -> Any:
        asked = handle.request
        here = asked.start.pose.position
        start = (here.x, here.y) if asked.use_start else (self._known.pose or (math.nan, math.nan))[:2]
        goal = asked.goal.pose.position
        try:
            points = self._known.plan(start, (goal.x, goal.y))
        except NoPath as error:
            self.get_logger().warning(f"No path: {error}")
            handle.abort()
            return ACTIONS.ComputePathToPose.Result(error_code=NO_VALID_PATH)
        handle.succeed()
        return ACTIONS.ComputePathToPose.Result(path=self._path([start, *points]))


def _accept(_: Any) -> CancelResponse:
    return CancelResponse.ACCEPT


def _active(_: Any, response: GetState.Response) -> GetState.Response:
    response.current_state = State(id=State.PRIMARY_STATE_ACTIVE, label="active")
    return response


def _left_of(poses: Sequence[Pose], task: FollowPath, pose: tuple[float, float, float] | None) -> int:
    """Return how many poses of a path are still ahead: those no farther from its end than the robot."""
    ahead, count = task.left(pose or (0.0, 0.0, 0.0)), 0
    for before, after in zip(poses[::-1], [poses[-1], *poses[::-1]], strict=False):
        a, b = before.position, after.position
        ahead -= math.dist((a.x, a.y), (b.x, b.y))
        if ahead < 0.0:
            break
        count += 1
    return count


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(Navigator, args)


if __name__ == "__main__":
    main()
