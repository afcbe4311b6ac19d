"""Names and types of topics, and their endpoints."""

import time

import rclpy
from sensor_msgs.msg import Imu
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("graph", namespace="/ns")
node.create_publisher(String, "chatter", 10)
node.create_subscription(Imu, "imu", print, 5)
end = time.time() + 0.5
while time.time() < end and node.count_publishers("/ns/chatter") < 1:
    time.sleep(0.01)
names = [(name, types) for name, types in node.get_topic_names_and_types() if name.startswith("/ns")]
print(sorted(names))
print(node.count_publishers("/ns/chatter"), node.count_subscribers("/ns/imu"), node.count_publishers("chatter"))
info = node.get_publishers_info_by_topic("/ns/chatter")[0]
print(info.node_name, info.node_namespace, info.topic_type, info.endpoint_type, info.qos_profile.reliability)
print(node.get_node_names_and_namespaces())
rclpy.shutdown()
