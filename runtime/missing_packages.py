"""What to say when a program imports a ROS 2 package that is not there."""

from __future__ import annotations

LIBRARIES = frozenset(
    {
        "cv_bridge",
        "diagnostic_updater",
        "image_geometry",
        "laser_geometry",
        "message_filters",
        "nav2_simple_commander",
        "rosbag2_py",
        "rqt_gui_py",
        "sensor_msgs_py",
        "tf2_geometry_msgs",
        "tf2_py",
        "tf2_ros",
        "tf_transformations",
    }
)
"""Python libraries beside rclpy that programs import."""
INTERFACES = ("_actions", "_interfaces", "_msg", "_msgs", "_srvs")
"""How the names of packages with interfaces usually end."""
NO_LIBRARY = (
    "{0} is a ROS 2 library of its own; bot-console brings rclpy, launch and the common messages only. Where {0} is "
    "installed as an ordinary Python package it can be imported, else this program needs a ROS 2 installation."
)
NO_INTERFACES = (
    "bot-console does not bring the interfaces of {0}. Put the sources of that package (package.xml with msg/, srv/ or "
    "action/) into the workspace; they are imported from there, and nothing has to be built."
)


def explain_missing_package(exception: BaseException) -> str | None:
    """Why a ROS 2 package cannot be imported, and what to do; None for every other exception."""
    if not isinstance(exception, ModuleNotFoundError) or exception.name is None:
        return None
    package = exception.name.partition(".")[0]
    if package in LIBRARIES:
        return NO_LIBRARY.format(package)
    return NO_INTERFACES.format(package) if package.endswith(INTERFACES) else None
