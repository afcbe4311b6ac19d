"""Widgets that know nothing of ROS."""
