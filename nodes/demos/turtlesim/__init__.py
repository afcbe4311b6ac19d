"""The package `turtlesim`: drawing turtles, as in ROS 2's first tutorials, without a window or Qt."""
