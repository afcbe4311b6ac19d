"""A coroutine service callback that awaits another service."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("awaiting")
inner_client = node.create_client(Trigger, "inner")


def inner(request, response):
    response.message = "inner"
    return response


async def outer(request, response):
    answer = await inner_client.call_async(Trigger.Request())
    response.message = f"outer got {answer.message}"
    return response


node.create_service(Trigger, "inner", inner, callback_group=ReentrantCallbackGroup())
node.create_service(Trigger, "outer", outer, callback_group=ReentrantCallbackGroup())
client = node.create_client(Trigger, "outer", callback_group=ReentrantCallbackGroup())
client.wait_for_service()
inner_client.wait_for_service()
future = client.call_async(Trigger.Request())
rclpy.spin_until_future_complete(node, future)
print(future.result().message)
rclpy.shutdown()
