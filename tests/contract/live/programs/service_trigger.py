"""A service and a synchronous-looking client."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Server(Node):
    def __init__(self):
        super().__init__("trigger_server")
        self.srv = self.create_service(Trigger, "fire", self.fire)
        self.count = 0

    def fire(self, request, response):
        self.count += 1
        self.get_logger().info(f"Incoming request {self.count}")
        response.success = True
        response.message = f"fired {self.count}"
        return response


class Client(Node):
    def __init__(self):
        super().__init__("trigger_client")
        self.cli = self.create_client(Trigger, "fire")
        while not self.cli.wait_for_service(timeout_sec=1.0):
            self.get_logger().info("service not available, waiting again...")


rclpy.init()
server = Server()
client = Client()
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(server)
executor.add_node(client)
for _ in range(2):
    future = client.cli.call_async(Trigger.Request())
    executor.spin_until_future_complete(future)
    client.get_logger().info(f"Result: {future.result().message}")
rclpy.shutdown()
