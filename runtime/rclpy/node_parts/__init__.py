"""The parts of `Node`, above all public modules of rclpy except `node` itself."""
