"""Service names and types of a node."""

import rclpy
from std_srvs.srv import Empty, SetBool

rclpy.init()
node = rclpy.create_node("served", namespace="sim")
node.create_service(Empty, "reset", lambda q, r: r)
node.create_service(SetBool, "~/enable", lambda q, r: r)
own = node.get_service_names_and_types_by_node("served", "/sim")
print([each for each in own if "parameter" not in each[0] and "type_description" not in each[0]])
print(len([each for each in own if "parameter" in each[0]]))
print([each.srv_name for each in node.services if "param" not in each.srv_name and "type_desc" not in each.srv_name])
rclpy.shutdown()
