"""A subscriber class that ends spin with an exception."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Done(Exception):
    pass


class MinimalSubscriber(Node):
    def __init__(self):
        super().__init__("minimal_subscriber")
        self.subscription = self.create_subscription(String, "chatter", self.listener_callback, 10)
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.02, self.talk)
        self.count = 0

    def talk(self):
        if self.publisher.get_subscription_count():
            self.publisher.publish(String(data=f"n{self.count}"))

    def listener_callback(self, msg):
        self.get_logger().info(f"I heard: {msg.data!r}")
        self.count += 1
        if self.count == 3:
            raise Done("enough")


rclpy.init()
node = MinimalSubscriber()
try:
    rclpy.spin(node)
except Done as error:
    print("done:", error)
node.destroy_node()
rclpy.shutdown()
