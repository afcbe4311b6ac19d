"""What a `Node` is made of: above all public modules of rclpy but `node` itself."""
