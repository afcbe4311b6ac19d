#!/usr/bin/env python3
"""The simulated robot alone, for nodes that are started elsewhere; also under the names of a TurtleBot."""

from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import LaunchDescription

PACKAGE = "bot_console_robot"
SPEEDS = "{'plain': 5.0, 'turtlebot3': 0.22, 'turtlebot4': 0.31}"
VIEWS = "{'plain': 3.141592653589793, 'turtlebot3': 6.265732014659643, 'turtlebot4': 6.265732014659643}"
"""Fields of view in rad: a TurtleBot's laser looks all around, and beam 359 is not beam 0 again."""


def generate_launch_description():
    """Describe the system."""
    model = LaunchConfiguration("model")
    stamped = {"enable_stamped_cmd_vel": ParameterValue(LaunchConfiguration("stamped"), value_type=bool)}

    def by_model(table):
        return ParameterValue(PythonExpression([table, "['", model, "']"]), value_type=float)

    return LaunchDescription(
        [
            DeclareLaunchArgument("world", default_value="indoor", description="World of the simulator"),
            DeclareLaunchArgument("seed", default_value="1", description="Seed of the simulator"),
            DeclareLaunchArgument(
                "model",
                default_value="plain",
                choices=["plain", "turtlebot3", "turtlebot4"],
                description="Whose names, speed and laser the robot has",
            ),
            DeclareLaunchArgument("stamped", default_value="false", description="Take TwistStamped on cmd_vel"),
            DeclareLaunchArgument(
                "navigation", default_value="false", description="Offer navigate_to_pose and the other goals of Nav2"
            ),
            Node(
                package=PACKAGE,
                executable="simulator_node",
                name="simulator",
                output="screen",
                parameters=[
                    {
                        "world": LaunchConfiguration("world"),
                        "seed": LaunchConfiguration("seed"),
                        "model": model,
                        "drive.max_speed": by_model(SPEEDS),
                        "lidar.field_of_view": by_model(VIEWS),
                        **stamped,
                    }
                ],
            ),
            Node(
                package=PACKAGE,
                executable="navigation_node",
                name="bt_navigator",
                output="screen",
                parameters=[stamped],
                condition=IfCondition(LaunchConfiguration("navigation")),
            ),
        ]
    )
