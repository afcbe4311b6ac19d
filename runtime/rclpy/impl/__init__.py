"""Internal parts of rclpy, not meant to be imported by programs."""
