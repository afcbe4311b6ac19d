"""A service that calls another one, in a reentrant group with two threads."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("nested")
group = ReentrantCallbackGroup()
inner_client = node.create_client(Trigger, "inner", callback_group=group)


def inner(request, response):
    response.message = "inner"
    return response


def outer(request, response):
    inner_client.wait_for_service()
    response.message = "outer of " + inner_client.call(Trigger.Request()).message
    return response


node.create_service(Trigger, "inner", inner, callback_group=group)
node.create_service(Trigger, "outer", outer, callback_group=group)
client = node.create_client(Trigger, "outer", callback_group=group)
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(node)
client.wait_for_service()
future = client.call_async(Trigger.Request())
executor.spin_until_future_complete(future)
print(future.result().message)
executor.shutdown()
rclpy.shutdown()
