"""Recordings of real ROS 2, and helpers of the tests that replay them."""
