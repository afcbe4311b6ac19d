"""A node in simulated time follows /clock."""

import rclpy
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock

rclpy.init()
node = rclpy.create_node("sim", parameter_overrides=[Parameter("use_sim_time", value=True)])
publisher = node.create_publisher(Clock, "/clock", 10)
print(node.get_clock().now().nanoseconds, node.get_clock().ros_time_is_active)
ticks = []
node.create_timer(1.0, lambda: ticks.append(node.get_clock().now().nanoseconds // 10**9))
while not publisher.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.01)
for second in range(1, 5):
    message = Clock()
    message.clock.sec = second
    publisher.publish(message)
    while node.get_clock().now().nanoseconds != second * 10**9:
        rclpy.spin_once(node, timeout_sec=0.1)
    for _ in range(3):
        rclpy.spin_once(node, timeout_sec=0.02)
print(ticks)
rclpy.shutdown()
