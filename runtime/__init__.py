"""ROS 2 without ROS 2: the runtime for nodes to which `import rclpy` refers here."""
