#!/usr/bin/env python3
"""The simulated robot alone, for nodes that are started elsewhere; also under the names of a TurtleBot."""

from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import LaunchDescription

PACKAGE = "bot_console_robot"
ALL_AROUND = 6.265732014659643
"""The field of view (rad) of a TurtleBot's laser: beam 359 is not beam 0 again."""
MODELS = {
    "plain": ("indoor", 5.0, 3.141592653589793),
    "turtlebot3": ("arena", 0.22, ALL_AROUND),
    "turtlebot4": ("arena", 0.31, ALL_AROUND),
}
"""World, greatest speed (m/s) and field of view (rad)."""


def generate_launch_description():
    """Describe the system."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "world", default_value="", description="World of the simulator; empty: indoor, a TurtleBot's is arena"
            ),
            DeclareLaunchArgument("seed", default_value="1", description="Seed of the simulator"),
            DeclareLaunchArgument(
                "origin",
                default_value="start",
                choices=["start", "corner"],
                description="Where map and odom begin: start of the robot, or lower left corner of the world",
            ),
            DeclareLaunchArgument(
                "model",
                default_value="plain",
                choices=list(MODELS),
                description="Whose names, speed and laser the robot has",
            ),
            DeclareLaunchArgument("stamped", default_value="false", description="Take TwistStamped on cmd_vel"),
            DeclareLaunchArgument(
                "navigation", default_value="false", description="Offer navigate_to_pose and the other goals of Nav2"
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
    """The parameter for velocities with a time stamp."""
    return {"enable_stamped_cmd_vel": ParameterValue(LaunchConfiguration("stamped"), value_type=bool)}


def make_simulator(context):
    """The simulator, as its model has it."""
    model = LaunchConfiguration("model").perform(context)
    world, speed, view = MODELS[model]
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
