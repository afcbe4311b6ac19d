"""Several threads publish with one publisher."""

import threading

import rclpy
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("threads")
got = []
node.create_subscription(Int32, "t", lambda m: got.append(m.data), 1000)
publisher = node.create_publisher(Int32, "t", 1000)
while not publisher.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.01)
threads = [
    threading.Thread(target=lambda n=n: [publisher.publish(Int32(data=n * 10 + i)) for i in range(10)])
    for n in range(4)
]
for each in threads:
    each.start()
for each in threads:
    each.join()
while len(got) < 40:
    rclpy.spin_once(node, timeout_sec=0.1)
print(sorted(got) == list(range(40)), [each for each in got if each < 10] == list(range(10)))
rclpy.shutdown()
