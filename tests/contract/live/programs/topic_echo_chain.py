"""Publishing in a callback: three nodes in one executor pass on a message."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import String

rclpy.init()
executor = SingleThreadedExecutor()
nodes = [rclpy.create_node(f"relay{n}") for n in range(3)]
log = []
publishers = {}
for n, node in enumerate(nodes):
    executor.add_node(node)
    publishers[n] = node.create_publisher(String, f"hop{n + 1}", 10)

    def relay(message, n=n):
        log.append((n, message.data))
        publishers[n].publish(String(data=message.data + "!"))

    node.create_subscription(String, f"hop{n}", relay, 10)
first = nodes[0].create_publisher(String, "hop0", 10)
while not (first.get_subscription_count() and all(publishers[n].get_subscription_count() for n in (0, 1))):
    executor.spin_once(timeout_sec=0.01)
first.publish(String(data="go"))
while len(log) < 3:
    executor.spin_once(timeout_sec=0.1)
print(log)
executor.shutdown()
rclpy.shutdown()
