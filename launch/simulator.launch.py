#!/usr/bin/env python3
"""Launches only the simulated robot, for nodes started elsewhere; also with a TurtleBot's frames, speed and laser."""

from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import LaunchDescription

PACKAGE = "bot_console_robot"
ALL_AROUND = 6.265732014659643
"""The field of view (rad) of a TurtleBot's laser, in which beam 359 does not coincide with beam 0."""
MODEL_SETTINGS = {
    "plain": ("indoor", 5.0, 3.141592653589793),
    "turtlebot3": ("arena", 0.22, ALL_AROUND),
    "turtlebot4": ("arena", 0.31, ALL_AROUND),
}
"""World, maximum speed (m/s) and field of view (rad)."""


def generate_launch_description():
    """Describe the system."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "world", default_value="", description="World of the simulator; empty: indoor, or arena for a TurtleBot"
            ),
            DeclareLaunchArgument("seed", default_value="1", description="Seed of the simulator"),
            DeclareLaunchArgument(
                "origin",
                default_value="start",
                choices=["start", "corner"],
                description="Origin of map and odom: start pose of the robot, or lower left corner of the world",
            ),
            DeclareLaunchArgument(
                "model",
                default_value="plain",
                choices=list(MODEL_SETTINGS),
                description="Robot whose frames, speed and laser are simulated",
            ),
            DeclareLaunchArgument("stamped", default_value="false", description="Accept TwistStamped on cmd_vel"),
            DeclareLaunchArgument(
                "navigation", default_value="false", description="Provide navigate_to_pose and the other Nav2 actions"
            ),
            OpaqueFunction(function=make_simulator),
            Node(
                package=PACKAGE,
                executable="navigation_node",
                name="bt_navigator",
                output="screen",
                parameters=[stamped()],
                condition=IfCondition(LaunchConfiguration("navigation")),
            ),
        ]
    )


def stamped():
    """The parameter that selects stamped velocity commands."""
    return {"enable_stamped_cmd_vel": ParameterValue(LaunchConfiguration("stamped"), value_type=bool)}


def make_simulator(context):
    """Make the simulator, configured for the chosen model."""
    model = LaunchConfiguration("model").perform(context)
    world, speed, view = MODEL_SETTINGS[model]
    return [
        Node(
            package=PACKAGE,
            executable="simulator_node",
            name="simulator",
            output="screen",
            parameters=[
                {
                    "world": LaunchConfiguration("world").perform(context) or world,
                    "seed": int(LaunchConfiguration("seed").perform(context)),
                    "origin": LaunchConfiguration("origin"),
                    "model": model,
                    "drive.max_speed": speed,
                    "lidar.field_of_view": view,
                    **stamped(),
                }
            ],
        )
    ]
