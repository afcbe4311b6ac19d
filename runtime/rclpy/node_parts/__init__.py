"""The subjects of `Node` (entities, parameters, graph); they are above all public modules of rclpy except `node`."""
