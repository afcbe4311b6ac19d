import sys
from threading import Thread

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node


class Client(Node):
    def __init__(self):
        super().__init__("minimal_client")
        self.cli = self.create_client(AddTwoInts, "add_two_ints")
        while not self.cli.wait_for_service(timeout_sec=1.0):
            self.get_logger().info("service not available, waiting again...")

    def send_async(self, a, b):
        return self.cli.call_async(AddTwoInts.Request(a=a, b=b))

    def send_sync(self, a, b):
        return self.cli.call(AddTwoInts.Request(a=a, b=b))


def main():
    rclpy.init()
    way, a, b = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    client = Client()
    if way == "async":
        future = client.send_async(a, b)
        rclpy.spin_until_future_complete(client, future)
        answer = future.result()
    else:
        Thread(target=rclpy.spin, args=(client,), daemon=True).start()
        answer = client.send_sync(a, b)
    client.get_logger().info(f"Result of add_two_ints: for {a} + {b} = {answer.sum}")
    rclpy.shutdown()


if __name__ == "__main__":
    main()
