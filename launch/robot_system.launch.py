#!/usr/bin/env python3
"""Launches the whole robot system: simulator, navigator, sensors, motion controller, safety monitor and telemetry.

Velocity commands go navigator -> motion controller -> safety monitor -> robot. A person's commands go to
`cmd_vel_teleop`.
"""

import os

from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import LaunchDescription

PACKAGE = "bot_console_robot"
PROFILES = ["indoor", "outdoor", "warehouse", "competition"]


def generate_launch_description():
    """Describe the system."""
    profiles = os.path.join(get_package_share_directory(PACKAGE), "config")
    profile = LaunchConfiguration("profile")
    navigator = LaunchConfiguration("navigator")
    config_file = LaunchConfiguration("config_file")
    use_sim_time = {"use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool)}
    follow_route = {"follow_route": ParameterValue(LaunchConfiguration("follow_route"), value_type=bool)}

    # Only one of them may drive to a goal: the controller in a straight line, or the navigator with Nav2's actions.
    goals = "goal_pose", PythonExpression(["'_direct_goal' if '", navigator, "' == 'goals' else 'goal_pose'"])

    def robot_node(executable, name, remappings=(), extra=None, **options):
        return Node(
            package=PACKAGE,
            executable=executable,
            name=name,
            output="screen",
            parameters=[config_file, use_sim_time, *([extra] if extra else [])],
            remappings=list(remappings),
            **options,
        )

    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "profile", default_value="indoor", choices=PROFILES, description="Environment: settings and world"
            ),
            DeclareLaunchArgument(
                "config_file",
                default_value=[profiles, "/", profile, "_config.yaml"],
                description="Path to robot configuration file; takes precedence over profile",
            ),
            DeclareLaunchArgument("seed", default_value="", description="Seed of the simulator; empty: the profile's"),
            DeclareLaunchArgument(
                "world", default_value="", description="World of the simulator; empty: the profile's"
            ),
            DeclareLaunchArgument(
                "origin", default_value="", description="Origin of map and odom: corner or start; empty: the profile's"
            ),
            DeclareLaunchArgument(
                "navigator",
                default_value="true",
                description="Who drives: robot_navigator (true), nobody (false), Nav2 goals (goals), or a Python file",
            ),
            DeclareLaunchArgument(
                "follow_route", default_value="false", description="Drive along the world's waypoints"
            ),
            DeclareLaunchArgument(
                "use_sim_time", default_value="false", description="Nodes use the simulator's /clock"
            ),
            OpaqueFunction(function=make_simulator),
            robot_node("sensor_node", "sensor_handler"),
            # While it is down the robot stands still, locked; after it has restarted, a person has to release it.
            robot_node("safety_node", "safety_monitor", respawn=True, respawn_delay=1.0),
            robot_node("controller_node", "motion_controller", [("cmd_vel", "cmd_vel_nav"), goals], follow_route),
            robot_node("telemetry_node", "telemetry_publisher"),
            OpaqueFunction(function=make_navigator),
        ]
    )


def make_navigator(context):
    """Make the navigator: the built-in one, the one with Nav2's actions, a Python file, or none."""
    chosen = LaunchConfiguration("navigator").perform(context)
    if chosen.lower() in ("false", "0"):
        return []
    if chosen.lower() not in ("true", "1", "goals") and not chosen.endswith(".py"):
        raise RuntimeError(f"navigator:={chosen}: expected true, false, goals or a Python file")
    program = {"package": PACKAGE, "executable": "navigation_node" if chosen == "goals" else "robot_node"}
    if chosen.endswith(".py"):  # The file need not be executable.
        program = {"executable": chosen, "prefix": "python3", "exec_name": os.path.basename(chosen)}
    return [
        Node(
            **program,
            name="bt_navigator" if chosen == "goals" else "robot_navigator",
            output="screen",
            parameters=[
                LaunchConfiguration("config_file"),
                {"use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool)},
            ],
            remappings=[("cmd_vel", "cmd_vel_desired")],
        )
    ]


def make_simulator(context):
    """Make the simulator with the given arguments; all other parameters come from the parameter file."""
    given = {}
    if seed := LaunchConfiguration("seed").perform(context):
        given["seed"] = int(seed)
    for name in ("world", "origin"):
        if value := LaunchConfiguration(name).perform(context):
            given[name] = value
    return [
        Node(
            package=PACKAGE,
            executable="simulator_node",
            name="simulator",
            output="screen",
            parameters=[LaunchConfiguration("config_file"), *([given] if given else [])],
        )
    ]
