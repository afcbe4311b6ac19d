"""The package `turtlesim`: turtles that draw, as the first tutorials of ROS 2 want them; no window, no Qt."""
