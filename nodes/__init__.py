"""The ROS package `bot_console_robot`: the nodes of a small robot system, and a simulated robot to run them on."""
