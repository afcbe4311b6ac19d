"""Valid and invalid names of nodes and namespaces."""

import rclpy

rclpy.init()
for name, namespace in (
    ("ok", ""),
    ("ok2", "/a/b"),
    ("bad name", ""),
    ("1st", ""),
    ("", ""),
    ("a/b", ""),
    ("n", "bad ns"),
    ("n", "a//b"),
    ("n", "/1"),
    ("x" * 300, ""),
):
    try:
        node = rclpy.create_node(name, namespace=namespace)
        print(node.get_fully_qualified_name(), node.get_logger().name)
    except Exception as error:
        print(name[:20], namespace, type(error).__name__)
rclpy.shutdown()
