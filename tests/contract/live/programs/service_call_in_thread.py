"""A blocking call from another thread while the main thread spins."""

import threading

import rclpy
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("threaded")


def serve(request, response):
    response.message = "from main"
    return response


node.create_service(Trigger, "t", serve)
client = node.create_client(Trigger, "t")
client.wait_for_service()
result = []


def work():
    result.append(client.call(Trigger.Request()).message)


thread = threading.Thread(target=work)
thread.start()
while not result:
    rclpy.spin_once(node, timeout_sec=0.1)
thread.join()
print(result)
rclpy.shutdown()
