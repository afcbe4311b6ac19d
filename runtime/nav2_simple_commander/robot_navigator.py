"""`BasicNavigator`: sends goals to the action servers of Nav2 and waits for them, spinning itself.

Contract: the methods and log lines of upstream's `nav2_simple_commander` for Jazzy.
"""

from __future__ import annotations

import time
from enum import Enum
from typing import Any

import rclpy
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovarianceStamped
from lifecycle_msgs.srv import GetState
from nav2_simple_commander.tasks import ACTIONS, SERVICES
from rclpy.action import ActionClient
from rclpy.duration import Duration as RclpyDuration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

__all__ = ["BasicNavigator", "TaskResult"]


class TaskResult(Enum):
    """The outcome of a task, numbered as upstream."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
ENDED = {
    GoalStatus.STATUS_SUCCEEDED: TaskResult.SUCCEEDED,
    GoalStatus.STATUS_ABORTED: TaskResult.FAILED,
    GoalStatus.STATUS_CANCELED: TaskResult.CANCELED,
}


class BasicNavigator(Node):
    """Runs one task at a time: start it, poll `isTaskComplete`, then call `getResult`."""

    def __init__(self, node_name: str = "basic_navigator", namespace: str = "") -> None:
        super().__init__(node_name=node_name, namespace=namespace)
        self.initial_pose = PoseStamped()
        self.initial_pose.header.frame_id = "map"
        self.initial_pose_received = False
        self.goal_handle: Any = None
        self.result_future: Any = None
        self.feedback: Any = None
        self.status: int | None = None
        self._clients_of_actions: dict[str, Any] = {}
        self.localization_pose_sub = self.create_subscription(
            PoseWithCovarianceStamped, "amcl_pose", self._amclPoseCallback, LATCHED
        )
        self.initial_pose_pub = self.create_publisher(PoseWithCovarianceStamped, "initialpose", 10)

    def destroyNode(self) -> None:
        """Leave the graph, as `destroy_node` does."""
        self.destroy_node()

    def destroy_node(self) -> None:
        """Leave the graph."""
        for client in self._clients_of_actions.values():
            client.destroy()
        self._clients_of_actions.clear()
        super().destroy_node()

    # Control of a task.

    def isTaskComplete(self) -> bool:
        """Return whether the last task has ended; waits up to 0.1 s for that."""
        if not self.result_future:
            return True
        rclpy.spin_until_future_complete(self, self.result_future, timeout_sec=0.10)
        if not self.result_future.result():
            return False
        self.status = self.result_future.result().status
        if self.status != GoalStatus.STATUS_SUCCEEDED:
            self.debug(f"Task with failed with status code: {self.status}")
        else:
            self.debug("Task succeeded!")
        return True

    def cancelTask(self) -> None:
        """Request the cancellation of the last task."""
        self.info("Canceling current task.")
        if self.result_future:
            rclpy.spin_until_future_complete(self, self.goal_handle.cancel_goal_async())

    def getFeedback(self) -> Any:
        """Return the newest feedback of the last task; None before there is any."""
        return self.feedback

    def getResult(self) -> TaskResult:
        """Return the outcome of the last task."""
        return ENDED.get(self.status or 0, TaskResult.UNKNOWN)

    # Tasks that take some time.

    def goToPose(self, pose: PoseStamped, behavior_tree: str = "") -> bool:
        """Drive to a pose; returns False if the goal is rejected."""
        place = pose.pose.position
        self.info(f"Navigating to goal: {place.x} {place.y}...")
        refusal = f"Goal to {place.x} {place.y} was rejected!"
        return self._start("navigate_to_pose", refusal, pose=pose, behavior_tree=behavior_tree)

    def goThroughPoses(self, poses: list[PoseStamped], behavior_tree: str = "") -> bool:
        """Drive via poses; returns False if the goal is rejected."""
        self.info(f"Navigating with {len(poses)} goals....")
        refusal = f"Goal with {len(poses)} poses was rejected!"
        return self._start("navigate_through_poses", refusal, poses=poses, behavior_tree=behavior_tree)

    def followWaypoints(self, poses: list[PoseStamped]) -> bool:
        """Drive to poses one after the other; returns False if the goal is rejected."""
        self.info(f"Following {len(poses)} goals....")
        return self._start("follow_waypoints", f"Following {len(poses)} waypoints request was rejected!", poses=poses)

    def followGpsWaypoints(self, gps_poses: list[Any]) -> bool:
        """Drive to GPS positions one after the other; returns False if the goal is rejected."""
        self.info(f"Following {len(gps_poses)} gps goals....")
        refusal = f"Following {len(gps_poses)} gps waypoints request was rejected!"
        return self._start("follow_gps_waypoints", refusal, gps_poses=gps_poses)

    def spin(self, spin_dist: float = 1.57, time_allowance: int = 10) -> bool:
        """Turn by an angle (rad); returns False if the goal is rejected."""
        self.info(f"Spinning to angle {spin_dist}....")
        allowance = Duration(sec=time_allowance)
        return self._start("spin", "Spin request was rejected!", target_yaw=spin_dist, time_allowance=allowance)

    def backup(self, backup_dist: float = 0.15, backup_speed: float = 0.025, time_allowance: int = 10) -> bool:
        """Drive backwards (m, m/s); returns False if the goal is rejected."""
        self.info(f"Backing up {backup_dist} m at {backup_speed} m/s....")
        return self._straight("backup", "Backup request was rejected!", backup_dist, backup_speed, time_allowance)

    def driveOnHeading(self, dist: float = 0.15, speed: float = 0.025, time_allowance: int = 10) -> bool:
        """Drive straight ahead (m, m/s); returns False if the goal is rejected."""
        self.info(f"Drive {dist} m on heading at {speed} m/s....")
        refusal = "Drive On Heading request was rejected!"
        return self._straight("drive_on_heading", refusal, dist, speed, time_allowance)

    def _straight(self, name: str, refusal: str, distance: float, speed: float, allowance: int) -> bool:
        target = Point(x=float(distance))
        return self._start(name, refusal, target=target, speed=speed, time_allowance=Duration(sec=allowance))

    def assistedTeleop(self, time_allowance: int = 30) -> bool:
        """Let a person drive with assistance; returns False if the goal is rejected."""
        self.info("Running 'assisted_teleop'....")
        refusal = "Assisted Teleop request was rejected!"
        return self._start("assisted_teleop", refusal, time_allowance=Duration(sec=time_allowance))

    def followPath(self, path: object, controller_id: str = "", goal_checker_id: str = "") -> bool:
        """Follow a path; returns False if the goal is rejected."""
        self.info("Executing path...")
        fields = {"path": path, "controller_id": controller_id, "goal_checker_id": goal_checker_id}
        return self._start("follow_path", "Follow path was rejected!", **fields)

    def dockRobotByPose(self, dock_pose: PoseStamped, dock_type: str, nav_to_dock: bool = True) -> bool:
        """Dock at a pose; returns False if the goal is rejected."""
        self.info(f"Docking at pose: {dock_pose}...")
        return self._start(
            "dock_robot", "Docking request was rejected!", use_dock_id=False, dock_pose=dock_pose,
            dock_type=dock_type, navigate_to_staging_pose=nav_to_dock,
        )  # fmt: skip

    def dockRobotByID(self, dock_id: str, nav_to_dock: bool = True) -> bool:
        """Dock at a dock in the server's database; returns False if the goal is rejected."""
        self.info(f"Docking at dock ID: {dock_id}...")
        fields = {"use_dock_id": True, "dock_id": dock_id, "navigate_to_staging_pose": nav_to_dock}
        return self._start("dock_robot", "Docking request was rejected!", **fields)

    def undockRobot(self, dock_type: str = "") -> bool:
        """Leave the dock; returns False if the goal is rejected."""
        self.info(f"Undocking from dock of type: {dock_type}...")
        return self._start("undock_robot", "Undocking request was rejected!", dock_type=dock_type)

    # Requests that wait for their answer.

    def getPath(self, start: PoseStamped, goal: PoseStamped, planner_id: str = "", use_start: bool = False) -> Any:
        """Return a path between poses; None if there is none."""
        fields = {"start": start, "goal": goal, "planner_id": planner_id, "use_start": use_start}
        return self._path("compute_path_to_pose", "Getting path", **fields)

    def getPathThroughPoses(
        self, start: PoseStamped, goals: list[PoseStamped], planner_id: str = "", use_start: bool = False
    ) -> Any:
        """Return a path via poses; None if there is none."""
        fields = {"start": start, "goals": goals, "planner_id": planner_id, "use_start": use_start}
        return self._path("compute_path_through_poses", "Getting path", **fields)

    def smoothPath(
        self, path: object, smoother_id: str = "", max_duration: float = 2.0, check_for_collision: bool = False
    ) -> Any:
        """Return a smoother path; None if there is none."""
        limit = RclpyDuration(seconds=max_duration).to_msg()
        fields = {"path": path, "smoother_id": smoother_id, "max_smoothing_duration": limit}
        return self._path("smooth_path", "Smoothing path", check_for_collisions=check_for_collision, **fields)

    def _path(self, name: str, what: str, **fields: object) -> Any:
        self.info(f"{what}...")
        if not self._start(name, f"{what} was rejected!", **fields):
            return None
        rclpy.spin_until_future_complete(self, self.result_future)
        answer = self.result_future.result()
        self.status = answer.status
        if self.status != GoalStatus.STATUS_SUCCEEDED:
            self.warn(f"Getting path failed with status code: {self.status}")
            return None
        return answer.result.path

    def _start(self, action: str, refusal: str, **fields: object) -> bool:
        """Send a goal and wait until it is accepted or rejected; returns whether it was accepted."""
        kind = ACTIONS[action]()
        client = self._clients_of_actions.get(action)
        if client is None:
            client = self._clients_of_actions[action] = ActionClient(self, kind, action)
        self.debug(f"Waiting for '{kind.__name__}' action server")
        while not client.wait_for_server(timeout_sec=1.0):
            self.info(f"'{kind.__name__}' action server not available, waiting...")
        asked = client.send_goal_async(kind.Goal(**fields), self._feedbackCallback)
        rclpy.spin_until_future_complete(self, asked)
        self.goal_handle = asked.result()
        if not self.goal_handle.accepted:
            self.error(refusal)
            return False
        self.result_future = self.goal_handle.get_result_async()
        return True

    # The robot's pose, and whether Nav2 is active.

    def setInitialPose(self, initial_pose: PoseStamped) -> None:
        """Set the robot's initial pose."""
        self.initial_pose_received = False
        self.initial_pose = initial_pose
        self._setInitialPose()

    def waitUntilNav2Active(self, navigator: str = "bt_navigator", localizer: str = "amcl") -> None:
        """Wait until the localizer and the navigator report that they are active."""
        if localizer != "robot_localization":
            self._waitForNodeToActivate(localizer)
        if localizer == "amcl":
            while not self.initial_pose_received:
                self.info("Setting initial pose")
                self._setInitialPose()
                self.info("Waiting for amcl_pose to be received")
                rclpy.spin_once(self, timeout_sec=1.0)
        self._waitForNodeToActivate(navigator)
        self.info("Nav2 is ready for use!")

    def _waitForNodeToActivate(self, node_name: str) -> None:
        service = f"{node_name}/get_state"
        client = self.create_client(GetState, service)
        self._wait_for(client, service)
        while True:
            answer = client.call_async(GetState.Request())
            rclpy.spin_until_future_complete(self, answer)
            state = answer.result()
            if state is not None and state.current_state.label == "active":
                return
            time.sleep(2)

    def _setInitialPose(self) -> None:
        message = PoseWithCovarianceStamped(header=self.initial_pose.header)
        message.pose.pose = self.initial_pose.pose
        self.info("Publishing Initial Pose")
        self.initial_pose_pub.publish(message)

    def _amclPoseCallback(self, msg: PoseWithCovarianceStamped) -> None:
        self.debug("Received amcl pose")
        self.initial_pose_received = True

    def _feedbackCallback(self, msg: Any) -> None:
        self.debug("Received action feedback message")
        self.feedback = msg.feedback

    # Services of Nav2's servers.

    def changeMap(self, map_filepath: str) -> None:
        """Make the map server load another map."""
        answer = self._ask("map_server/load_map", "LoadMap", "change map", map_url=map_filepath)
        if answer.result:
            self.error("Change map request failed!")
        else:
            self.info("Change map request was successful!")

    def clearAllCostmaps(self) -> None:
        """Clear both costmaps."""
        self.clearLocalCostmap()
        self.clearGlobalCostmap()

    def clearLocalCostmap(self) -> None:
        """Clear the local costmap."""
        self._ask("local_costmap/clear_entirely_local_costmap", "ClearEntireCostmap", "Clear local costmaps")

    def clearGlobalCostmap(self) -> None:
        """Clear the global costmap."""
        self._ask("global_costmap/clear_entirely_global_costmap", "ClearEntireCostmap", "Clear global costmaps")

    def getGlobalCostmap(self) -> Any:
        """Return the global costmap."""
        return self._ask("global_costmap/get_costmap", "GetCostmap", "Get global costmaps").map

    def getLocalCostmap(self) -> Any:
        """Return the local costmap."""
        return self._ask("local_costmap/get_costmap", "GetCostmap", "Get local costmaps").map

    def lifecycleStartup(self) -> None:
        """Make all lifecycle managers start their nodes."""
        self._manage("Starting up", 0)
        self.info("Nav2 is ready for use!")

    def lifecycleShutdown(self) -> None:
        """Make all lifecycle managers shut down their nodes."""
        self._manage("Shutting down", 4)

    def _manage(self, what: str, command: int) -> None:
        self.info(f"{what} lifecycle nodes based on lifecycle_manager.")
        for name, kinds in self.get_service_names_and_types():
            if kinds[0] == "nav2_msgs/srv/ManageLifecycleNodes":
                self.info(f"{what} {name}")
                self._ask(name, "ManageLifecycleNodes", name, command=command)

    def _ask(self, service: str, kind: str, shown: str, **fields: object) -> Any:
        made = SERVICES[kind]()
        client = self.create_client(made, service)
        self._wait_for(client, shown)
        answer = client.call_async(made.Request(**fields))
        rclpy.spin_until_future_complete(self, answer)
        self.destroy_client(client)
        return answer.result()

    def _wait_for(self, client: Any, shown: str) -> None:
        while not client.wait_for_service(timeout_sec=1.0):
            self.info(f"{shown} service not available, waiting...")

    # Log lines.

    def info(self, msg: str) -> None:
        """Log at INFO."""
        self.get_logger().info(msg)

    def warn(self, msg: str) -> None:
        """Log at WARN."""
        self.get_logger().warning(msg)

    def error(self, msg: str) -> None:
        """Log at ERROR."""
        self.get_logger().error(msg)

    def debug(self, msg: str) -> None:
        """Log at DEBUG."""
        self.get_logger().debug(msg)
