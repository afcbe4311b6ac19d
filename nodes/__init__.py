"""The ROS package `intelligent_robot`: the nodes of a small robot system, and a simulated robot to run them on."""
