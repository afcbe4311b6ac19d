"""The order of callbacks of one node: timer, subscription, service, client."""

import time

import rclpy
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("mixed")
log = []


def serve(request, response):
    log.append("service")
    return response


node.create_service(Trigger, "s", serve)
client = node.create_client(Trigger, "s")
publisher = node.create_publisher(Int32, "t", 10)
node.create_subscription(Int32, "t", lambda m: log.append(f"subscription {m.data}"), 10)
guard = node.create_guard_condition(lambda: log.append("guard"))
client.wait_for_service()
while not publisher.get_subscription_count():
    time.sleep(0.01)
timer = node.create_timer(0.001, lambda: (log.append("timer"), timer.cancel()))
publisher.publish(Int32(data=1))
publisher.publish(Int32(data=2))
client.call_async(Trigger.Request())
guard.trigger()
time.sleep(0.3)
while len(log) < 5:
    rclpy.spin_once(node, timeout_sec=0.1)
print(log)
rclpy.shutdown()
