"""Writes `docs/what-runs.md`: the packages that public rclpy programs import, and how much of each is here.

    python tools/what_runs.py

A package counts as here where the runtime serves it; what is known to be missing of it is in the table below.
"""

from __future__ import annotations

import sys
from pathlib import Path

from bot_console.runtime.further_interfaces import unverified_folders
from bot_console.runtime.importer import install, is_embedded
from bot_console.runtime.missing_packages import explain_missing_package

PAGE = Path(__file__).resolve().parents[1] / "docs" / "what-runs.md"
HEAD = """# What runs

This page shows which ROS 2 packages your Python programs can import. It lists the packages that such programs import,
the most common ones first. "yes" means that no part is known to be missing, not that every part was compared with
ROS 2. `python tools/what_runs.py` generates the page from what the runtime provides.

| package | here | what is missing, or how to get it |
| --- | --- | --- |
"""
PARTS = {
    "cv_bridge": "compressed images and Bayer patterns need OpenCV: `pip install 'bot-console[opencv]'`",
    "control_msgs": "the interfaces of rarely used controllers",
    "irobot_create_msgs": "`Mouse`, `IrOpcode`, `WallFollow`, `DockServo`",
    "launch_ros": "C++ components",
    "nav2_msgs": "services added after the first Jazzy release",
    "launch_pytest": "`launch_service`, `launch_context` and `event_loop` for fixtures wider than a function",
    "launch_testing": "`loader` and `test_runner`; `bot-console test` and `launch_test` run test files",
    "message_filters": "`LatestTimeSynchronizer`, input aligner",
    "tf2_geometry_msgs": "`PyKDL` types",
    "turtlebot3_msgs": "`Patrol` as used by examples since 2025; `bot-console interface add FOLDER` adds a checkout",
    "tf_transformations": "`Arcball`, `clip_matrix`, `orthogonalization_matrix`",
}
"""What is missing of packages that are here."""
UNVERIFIED = "fields are known, the type hash was not compared with ROS 2"
BY_FREQUENCY = (
    *("rclpy", "std_msgs", "geometry_msgs", "sensor_msgs", "launch", "launch_ros", "ament_index_python", "nav_msgs"),
    *(
        "std_srvs",
        "cv_bridge",
        "example_interfaces",
        "tf_transformations",
        "tf2_ros",
        "rcl_interfaces",
        "builtin_interfaces",
    ),
    *("visualization_msgs", "turtlesim", "action_msgs", "tf2_msgs", "tf2_geometry_msgs", "sensor_msgs_py", "nav2_msgs"),
    *("message_filters", "lifecycle_msgs", "trajectory_msgs", "diagnostic_msgs", "launch_xml", "launch_yaml", "tf2_py"),
    *("rosidl_runtime_py", "action_tutorials_interfaces", "shape_msgs", "rosgraph_msgs", "unique_identifier_msgs"),
    *(
        "nav2_simple_commander",
        "launch_testing",
        "launch_testing_ros",
        "launch_pytest",
        "rosbag2_py",
        "control_msgs",
        "vision_msgs",
    ),
    *("geographic_msgs", "ackermann_msgs", "irobot_create_msgs", "tf2_sensor_msgs", "laser_geometry", "image_geometry"),
    *("map_msgs", "pcl_msgs", "can_msgs", "turtlebot3_msgs"),
    *("diagnostic_updater", "nav2_common", "xacro", "rqt_gui_py"),
)


def row(package: str) -> str:
    """A line of the table."""
    if is_embedded(package):
        missing = PARTS.get(package, "")
        return f"| `{package}` | {'partly' if missing else 'yes'} | {missing} |"
    if package in unverified_folders():
        missing = f"{PARTS[package]}; {UNVERIFIED}" if package in PARTS else UNVERIFIED
        return f"| `{package}` | {'partly' if package in PARTS else 'yes'} | {missing} |"
    why = explain_missing_package(ModuleNotFoundError(f"No module named '{package}'", name=package)) or ""
    return f"| `{package}` | no | {why} |"


def page() -> str:
    """The whole page."""
    install()
    return HEAD + "".join(f"{row(each)}\n" for each in BY_FREQUENCY)


def main() -> None:
    """Write it."""
    text = page()
    PAGE.write_text(text, encoding="utf-8")
    print(f"{PAGE}: {text.count('| yes |')} here, {text.count('| partly |')} partly", file=sys.stderr)


if __name__ == "__main__":
    main()
