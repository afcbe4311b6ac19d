"""The ROS package `bot_console_robot`: the nodes of a small robot system, and the simulated robot that they control."""
