"""Bags: topics recorded to MCAP files in rosbag2's folder layout, read, repaired and played. Uses only ROS and
`mcap`.
"""
