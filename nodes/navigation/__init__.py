"""Ways over a map, and how to follow them. No ROS here."""
