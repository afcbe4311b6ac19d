"""Explains the import of a missing ROS 2 package: what provides the package, or why nothing does."""

from __future__ import annotations

import re

PIP = "{0} is an ordinary Python package: pip install {1}"
CPP = (
    "{0} is a library of ROS 2 around C++ ({1}); bot-console does not bring it. Run this program where ROS 2 is "
    "installed."
)
WINDOWS = "{0} makes windows of Qt, and bot-console has none. Its pane does the same: {1}."
SOURCE = (
    "{0} is a Python library of ROS 2 that bot-console does not bring. Put its sources into the workspace, or run this "
    "program where ROS 2 is installed."
)
NO_INTERFACES = (
    "bot-console does not bring the interfaces of {0}. Put the sources of that package (package.xml with msg/, srv/ or "
    "action/) into the workspace; they are imported from there, and nothing has to be built."
)
ROS_1 = "{0} belongs to ROS 1, and this is ROS 2: {1}."
INTERFACES = ("_actions", "_interfaces", "_msg", "_msgs", "_srvs")
"""Usual suffixes of interface packages."""

KNOWN: dict[str, tuple[str, str]] = {
    "PyKDL": (
        CPP,
        "the kinematics of Orocos; tf_transformations does most of what programs take of it",
    ),
    "actionlib": (ROS_1, "actions are in rclpy.action"),
    "cv2": (PIP, "'bot-console[opencv]' (or opencv-python-headless)"),
    "image_transport_py": (
        CPP,
        "the plugins of image_transport; cv_bridge and `ros2 run image_transport republish` are here",
    ),
    "moveit": (CPP, "the planners of MoveIt"),
    "moveit_py": (CPP, "the planners of MoveIt"),
    "open3d": (PIP, "open3d"),
    "pygame": (PIP, "pygame"),
    "python_qt_binding": (WINDOWS, "bot-console, keys 1 to 9"),
    "qt_gui": (WINDOWS, "bot-console, keys 1 to 9"),
    "rosbag2_py": (CPP, "the storage of rosbag2; the Python package rosbags reads and writes the same files"),
    "roslib": (ROS_1, "what it does is in rclpy and ament_index_python"),
    "rospkg": (ROS_1, "packages are found by ament_index_python"),
    "rospy": (ROS_1, "a node imports rclpy"),
    "rqt_gui": (WINDOWS, "bot-console, keys 1 to 9"),
    "rqt_gui_py": (WINDOWS, "bot-console, keys 1 to 9"),
    "scipy": (PIP, "scipy"),
    "serial": (PIP, "pyserial"),
    "tf": (ROS_1, "transforms are in tf2_ros, quaternions in tf_transformations"),
    "tf2_kdl": (CPP, "the types of KDL"),
    "transforms3d": (PIP, "transforms3d"),
    "ultralytics": (PIP, "ultralytics"),
    "xacro": (PIP, "xacro"),
} | {
    name: (SOURCE, "")
    for name in (
        "diagnostic_updater",
        "image_geometry",
        "laser_geometry",
        "nav2_common",
        "urdf_parser_py",
    )
}
"""How to get a package, by its import name: its origin, and the name to install."""


GAZEBO = "It starts Gazebo; the simulated robot stands in for it: bot_console_robot simulator.launch.py."
EXECUTABLES: dict[str, str] = {
    "gazebo_ros": GAZEBO,
    "ros_gz_sim": GAZEBO,
    "robot_state_publisher": "It is C++; the simulated robot publishes /tf and /tf_static itself.",
    "joint_state_publisher": "The simulated robot publishes /joint_states itself.",
    "nav2_bringup": "Nav2 is C++; `navigation:=true` of simulator.launch.py offers its goals for the simulated robot.",
    "rviz2": "It makes windows; the World pane of the console shows map, robot and scan.",
    "rqt_graph": "It makes windows; the Graph pane of the console is the same: bot-console rqt_graph.",
    "rqt_console": "It makes windows; the Logs pane of the console is the same: bot-console rqt_console.",
    "slam_toolbox": "It is C++, not here; the simulated robot publishes its map on /map.",
    "image_view": "It makes windows, and bot-console has none.",
}
"""Why a package has no executables here, and what to use instead."""
NO_EXECUTABLE = (
    "Packages in C++ are not here, because bot-console compiles nothing; "
    "Python ones run from their sources in the workspace."
)


def what_provides(package: str) -> str:
    """Return a sentence about what provides a package's executables, or an equivalent here."""
    if package in EXECUTABLES:
        return EXECUTABLES[package]
    if package in KNOWN:
        text, what = KNOWN[package]
        return text.format(package, what)
    return NO_EXECUTABLE


def explain_missing_package(exception: BaseException) -> str | None:
    """Explain why a package cannot be imported, and what to do; None for any other exception."""
    if not isinstance(exception, ModuleNotFoundError) or exception.name is None:
        return None
    package = exception.name.partition(".")[0]
    if package in KNOWN:
        text, what = KNOWN[package]
        return text.format(package, what)
    asks_for_interfaces = package.endswith(INTERFACES) or _imports_interfaces(exception, package)
    return NO_INTERFACES.format(package) if asks_for_interfaces else None


def _imports_interfaces(exception: BaseException, package: str) -> bool:
    """Whether the failed line imports messages, services or actions of a package, whatever its name."""
    import traceback

    lines = [each.line or "" for each in traceback.extract_tb(exception.__traceback__)]
    return any(re.match(rf"\s*(from|import) {re.escape(package)}\.(msg|srv|action)\b", each) for each in lines)
