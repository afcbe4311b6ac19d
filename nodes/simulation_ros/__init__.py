"""The ROS side of the simulator: parameters, messages, and finding worlds."""
