"""A two-dimensional array in a Float64MultiArray."""

import rclpy
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

rclpy.init()
node = rclpy.create_node("matrix")
got = []
node.create_subscription(Float64MultiArray, "m", got.append, 10)
publisher = node.create_publisher(Float64MultiArray, "m", 10)
while not publisher.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.01)
message = Float64MultiArray(data=[1.0, 2.0, 3.0, 4.0])
message.layout.dim = [
    MultiArrayDimension(label="rows", size=2, stride=4),
    MultiArrayDimension(label="cols", size=2, stride=2),
]
publisher.publish(message)
while not got:
    rclpy.spin_once(node, timeout_sec=0.1)
print(got[0].layout.dim[0].label, list(got[0].data), got[0] == message, got[0] is message)
rclpy.shutdown()
