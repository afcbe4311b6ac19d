"""Bags: topics recorded to MCAP files in rosbag2's folder form, read, mended and played. ROS names and `mcap` alone."""
