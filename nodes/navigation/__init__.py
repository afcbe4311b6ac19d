"""Path planning on a map, and path following. No ROS here."""
