"""Robot models whose frame and joint names the simulator can use, so that programs written for them work."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Model:
    """Names of frames and joints; heights above the ground and the wheel radius in m."""

    footprint: str = "base_footprint"
    base: str = "base_link"
    scan: str = "base_scan"
    imu: str = "imu_link"
    wheels: tuple[str, str] = ("wheel_left_link", "wheel_right_link")
    joints: tuple[str, str] = ("wheel_left_joint", "wheel_right_joint")
    base_height: float = 0.01
    scan_height: float = 0.17
    wheel_radius: float = 0.033
    scan_from_front: bool = False
    """Whether beam 0 of a full turn points forward instead of backward."""


MODELS = {
    "plain": Model(),
    "turtlebot3": Model(scan_from_front=True),
    "turtlebot4": Model(
        scan="rplidar_link",
        wheels=("left_wheel", "right_wheel"),
        joints=("left_wheel_joint", "right_wheel_joint"),
        base_height=0.0,
        wheel_radius=0.0358,
    ),
}
"""The models, by the value of the simulator's parameter `model`."""
