"""A subscriber, a publisher and a service in one node: the number counter."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int64
from std_srvs.srv import SetBool


class NumberCounter(Node):
    def __init__(self):
        super().__init__("number_counter")
        self.counter = 0
        self.pub = self.create_publisher(Int64, "number_count", 10)
        self.sub = self.create_subscription(Int64, "number", self.add, 10)
        self.srv = self.create_service(SetBool, "reset_counter", self.reset)
        self.get_logger().info("Number counter has been started")

    def add(self, msg):
        self.counter += msg.data
        self.pub.publish(Int64(data=self.counter))

    def reset(self, request, response):
        if request.data:
            self.counter = 0
            response.success, response.message = True, "Counter has been reset"
        else:
            response.success, response.message = False, "Counter has not been reset"
        return response


rclpy.init()
node = NumberCounter()
out = []
node.create_subscription(Int64, "number_count", lambda m: out.append(m.data), 10)
source = node.create_publisher(Int64, "number", 10)
client = node.create_client(SetBool, "reset_counter")
client.wait_for_service()
while not (source.get_subscription_count() and node.pub.get_subscription_count()):
    rclpy.spin_once(node, timeout_sec=0.01)
for number in (2, 3):
    source.publish(Int64(data=number))
while len(out) < 2:
    rclpy.spin_once(node, timeout_sec=0.1)
for flag in (False, True):
    future = client.call_async(SetBool.Request(data=flag))
    rclpy.spin_until_future_complete(node, future)
    print(future.result().success, future.result().message, node.counter)
print(out)
node.destroy_node()
rclpy.shutdown()
