"""The entities of a new node."""

import rclpy

rclpy.init()
node = rclpy.create_node("fresh")
print([each.topic_name for each in node.publishers])
print(sorted(each.srv_name for each in node.services))
print(len(list(node.clients)), len(list(node.timers)), len(list(node.waitables)), len(list(node.guards)))
print(sorted(node.get_parameters_by_prefix("")), sorted(node._parameters))
bare = rclpy.create_node("bare", start_parameter_services=False, enable_rosout=False)
print([each.topic_name for each in bare.publishers], [each.srv_name for each in bare.services])
rclpy.shutdown()
