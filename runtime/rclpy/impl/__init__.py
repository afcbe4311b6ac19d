"""Parts of rclpy that are not meant to be imported by programs."""
