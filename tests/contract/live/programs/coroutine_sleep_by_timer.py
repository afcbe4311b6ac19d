"""A coroutine callback that sleeps by a timer and a future."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node("napping")
group = ReentrantCallbackGroup()
log = []


async def sleep(seconds):
    future = Future()
    timer = node.create_timer(
        seconds, lambda: future.set_result(None) if not future.done() else None, callback_group=group
    )
    await future
    node.destroy_timer(timer)


async def work():
    starter.cancel()
    log.append("begin")
    await sleep(0.02)
    log.append("end")


starter = node.create_timer(0.001, work, callback_group=group)
while "end" not in log:
    rclpy.spin_once(node, timeout_sec=0.2)
print(log)
rclpy.shutdown()
