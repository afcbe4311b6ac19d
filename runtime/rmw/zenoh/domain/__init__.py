"""A ROS domain on one machine: the folder of sockets in which a user's processes find each other."""
