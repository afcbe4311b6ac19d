"""The simulator's parameters, and the settings made from them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from bot_console_robot.common.parameters import fixed, number, plain, proposed, whole
from bot_console_robot.simulation.frame_origins import ORIGINS
from bot_console_robot.simulation.lidar import LidarSettings
from bot_console_robot.simulation.odometry import OdometryNoise
from bot_console_robot.simulation.robot import DriveLimits
from bot_console_robot.simulation.simulation import Settings
from bot_console_robot.simulation_ros.models import MODELS
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

LIMITS, LIDAR, NOISE = DriveLimits(), LidarSettings(), OdometryNoise()
DECLARED: tuple[tuple[str, Any, ParameterDescriptor], ...] = (
    ("world", "indoor", plain("Name of a world or path of its file, used at reset")),
    ("seed", 1, whole("Seed of all random numbers, used at reset", 0, 2**31 - 1)),
    (
        "origin",
        "corner",
        plain("Origin of map and odom, used at reset: corner of the world, or start pose of the robot"),
    ),
    ("scan_rate", 10.0, number("Rate of the LIDAR (Hz)", 1.0, 50.0)),
    ("odom_rate", 20.0, number("Rate of odometry and ground truth (Hz)", 1.0, 100.0)),
    ("model", "plain", fixed(f"Robot whose frame and joint names are used: {', '.join(MODELS)}")),
    ("enable_stamped_cmd_vel", False, fixed("Subscribe to TwistStamped on cmd_vel, not Twist")),
    ("step_duration", 0.1, number("Simulated time of one call of the service step (s)", 0.01, 60.0)),
    ("map_resolution", 0.05, number("Size of a cell of the map, used at reset (m)", 0.02, 0.5)),
    ("drive.max_speed", LIMITS.max_speed, number("Maximum speed of the wheels (m/s)", 0.1, 10.0)),
    ("drive.max_turn_rate", LIMITS.max_turn_rate, number("Maximum turn rate (rad/s)", 0.1, 10.0)),
    ("drive.acceleration", LIMITS.acceleration, number("Maximum acceleration (m/s²)", 0.1, 20.0)),
    ("drive.deceleration", LIMITS.deceleration, number("Maximum deceleration (m/s²)", 0.1, 20.0)),
    ("drive.turn_acceleration", LIMITS.turn_acceleration, number("Maximum angular acceleration (rad/s²)", 0.1, 50.0)),
    ("drive.wheel_separation", LIMITS.wheel_separation, number("Distance between the wheels (m)", 0.05, 1.0)),
    ("drive.radius", LIMITS.radius, number("Radius of the round hull, used at reset (m)", 0.05, 0.5)),
    ("drive.command_timeout", LIMITS.command_timeout, number("Age at which a command expires (s)", 0.05, 5.0)),
    ("lidar.beams", LIDAR.beams, whole("Beams per scan", 3, 3600)),
    ("lidar.field_of_view", LIDAR.field_of_view, number("Field of view, centred ahead (rad)", 0.1, 2 * math.pi)),
    ("lidar.range_min", LIDAR.range_min, number("Minimum distance that can be measured (m)", 0.01, 1.0)),
    ("lidar.range_max", LIDAR.range_max, number("Maximum distance that can be measured (m)", 1.0, 50.0)),
    ("lidar.noise", LIDAR.noise, number("Standard deviation of a range (m)", 0.0, 0.5)),
    ("lidar.dropout", LIDAR.dropout, number("Share of beams without a return", 0.0, 1.0)),
    ("lidar.false_returns", LIDAR.false_returns, number("Share of beams that hit dust or rain", 0.0, 1.0)),
    ("odometry.distance_noise", NOISE.distance, number("Standard deviation after driving 1 m (m)", 0.0, 0.5)),
    ("odometry.heading_noise", NOISE.heading, number("Standard deviation after turning 1 rad (rad)", 0.0, 0.5)),
)


def declare(node: Node) -> None:
    """Declare all parameters."""
    for name, default, descriptor in DECLARED:
        node.declare_parameter(name, default, descriptor)


def settings(node: Node) -> Settings:
    """The settings that the present parameters specify."""

    def group(prefix: str) -> dict[str, Any]:
        return {name: value.value for name, value in node.get_parameters_by_prefix(prefix).items()}

    noise = group("odometry")
    return Settings(
        DriveLimits(**group("drive")),
        LidarSettings(**group("lidar")),
        OdometryNoise(noise["distance_noise"], noise["heading_noise"]),
    )


def problem(node: Node, changes: Iterable[Parameter]) -> str:
    """Why the parameters would contradict each other after changes; empty if they would not."""
    origin = {each.name: each.value for each in changes}.get("origin", node.get_parameter("origin").value)
    if origin not in ORIGINS:
        return f"origin must be one of {', '.join(ORIGINS)}, not '{origin}'"
    low, high = proposed(node, changes, "lidar.range_min", "lidar.range_max")
    if low >= high:
        return f"lidar.range_min ({low} m) must be less than lidar.range_max ({high} m)"
    model = str(node.get_parameter("model").value)
    return "" if model in MODELS else f"model must be one of {', '.join(MODELS)}, not '{model}'"
