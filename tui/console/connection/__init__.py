"""The implementations of `Console`: connected to a ROS system, forwarding to one, read-only, and without any."""
