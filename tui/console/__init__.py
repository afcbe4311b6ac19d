"""The panes' model of a ROS system, what they can ask of it, and the ROS node behind both."""
