"""The panes' model of a ROS system, the requests they can make of it, and the ROS node behind both."""
