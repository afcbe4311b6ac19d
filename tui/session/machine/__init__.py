"""The console on the machine's own ROS 2."""
