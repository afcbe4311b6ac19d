"""The console on this machine's ROS 2."""
