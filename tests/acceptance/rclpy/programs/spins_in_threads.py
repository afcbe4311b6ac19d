import contextlib
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from std_msgs.msg import Int32

rclpy.init()
source, sink = rclpy.create_node("source"), rclpy.create_node("sink")
got = []


def take(msg):
    got.append(msg.data)
    if msg.data == 9:
        sink.get_logger().info(f"got {got}")
        rclpy.shutdown()


sink.create_subscription(Int32, "numbers", take, 20)
publisher = source.create_publisher(Int32, "numbers", 20)
source.create_timer(0.1, lambda: publisher.publish(Int32(data=len(sent.append(0) or sent) - 1)))
sent = []


def serve(node):
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()


threads = [threading.Thread(target=serve, args=(node,)) for node in (source, sink)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
print("joined")
