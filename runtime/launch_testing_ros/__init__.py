"""What tests of ROS systems wait for, as upstream's `launch_testing_ros`."""

from launch_testing_ros.wait_for_topics import WaitForTopics

__all__ = ["WaitForTopics"]
