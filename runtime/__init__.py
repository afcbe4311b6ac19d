"""ROS 2 without ROS 2: the node runtime that `import rclpy` means here."""
