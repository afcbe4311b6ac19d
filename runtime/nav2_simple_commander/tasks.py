"""The actions and services of Nav2 by their servers' names; each client is created on first use."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from rosidl_runtime_py.utilities import get_action, get_service

ACTIONS: Mapping[str, Callable[[], Any]] = {
    name: partial(get_action, f"nav2_msgs/action/{kind}")
    for name, kind in {
        "assisted_teleop": "AssistedTeleop",
        "backup": "BackUp",
        "compute_path_through_poses": "ComputePathThroughPoses",
        "compute_path_to_pose": "ComputePathToPose",
        "dock_robot": "DockRobot",
        "drive_on_heading": "DriveOnHeading",
        "follow_gps_waypoints": "FollowGPSWaypoints",
        "follow_path": "FollowPath",
        "follow_waypoints": "FollowWaypoints",
        "navigate_through_poses": "NavigateThroughPoses",
        "navigate_to_pose": "NavigateToPose",
        "smooth_path": "SmoothPath",
        "spin": "Spin",
        "undock_robot": "UndockRobot",
    }.items()
}
SERVICES: Mapping[str, Callable[[], Any]] = {
    name: partial(get_service, f"nav2_msgs/srv/{name}")
    for name in ("ClearEntireCostmap", "GetCostmap", "LoadMap", "ManageLifecycleNodes")
}
