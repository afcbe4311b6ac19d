"""A ROS domain on one machine: the folder of sockets in which the processes of a user find each other."""
