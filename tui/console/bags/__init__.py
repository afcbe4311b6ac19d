"""Bags: records topics to MCAP files in rosbag2's folder layout, and reads, repairs and plays them. Uses only ROS and
`mcap`.
"""
