"""The ROS side of the simulator: its parameters, messages and worlds."""
