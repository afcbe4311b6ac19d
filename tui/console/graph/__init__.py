"""Watching the ROS graph."""
