"""What the panes know and may ask for, and the ROS node that stands behind it."""
