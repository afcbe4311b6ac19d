"""asyncio beside rclpy: spinning in an executor thread of asyncio."""

import asyncio

import rclpy
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("bridge")


def serve(request, response):
    response.message = "hello asyncio"
    return response


node.create_service(Trigger, "t", serve)
client = node.create_client(Trigger, "t")


async def main():
    loop = asyncio.get_running_loop()
    client.wait_for_service()
    future = client.call_async(Trigger.Request())
    await loop.run_in_executor(None, lambda: rclpy.spin_until_future_complete(node, future))
    print(future.result().message)


asyncio.run(main())
rclpy.shutdown()
