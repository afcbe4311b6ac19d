"""The `Console` of each state: on a ROS system, linked to it, read only, and where there is none."""
