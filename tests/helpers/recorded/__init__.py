"""Recordings of real ROS 2, and what tests that replay them share."""
