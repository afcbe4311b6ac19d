"""A ROS domain on one machine: the socket folder through which a user's processes discover each other."""
