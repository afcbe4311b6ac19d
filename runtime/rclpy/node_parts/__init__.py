"""The subjects of `Node` (entities, parameters, graph), above all public modules of rclpy except `node` itself."""
