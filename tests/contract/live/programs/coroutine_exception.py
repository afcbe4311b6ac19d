"""An exception after an await leaves spin."""

import rclpy
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node("late_failure")
gate = Future()


async def work():
    await gate
    raise LookupError("after the wait")


node.create_guard_condition(work).trigger()
rclpy.spin_once(node, timeout_sec=1)
gate.set_result(None)
try:
    for _ in range(5):
        rclpy.spin_once(node, timeout_sec=0.1)
    print("nothing raised")
except LookupError as error:
    print("caught", error)
rclpy.shutdown()
