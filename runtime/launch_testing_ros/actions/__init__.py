"""Actions for tests of ROS systems."""

from launch_testing_ros.actions.enable_rmw_isolation import EnableRmwIsolation

__all__ = ["EnableRmwIsolation"]
