"""The middleware below rclpy: names, arguments, and the bus that carries messages."""
