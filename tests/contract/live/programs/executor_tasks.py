"""Tasks and coroutines in an executor."""

import rclpy
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node("tasks")
executor = rclpy.get_global_executor()
executor.add_node(node)
gate = Future()


async def work(name):
    value = await gate
    return f"{name} {value}"


task = executor.create_task(work, "task")
plain = executor.create_task(lambda: 7)
executor.spin_until_future_complete(plain)
print(plain.result(), task.done())
gate.set_result("open")
executor.spin_until_future_complete(task)
print(task.result(), task.exception(), task.cancelled())
rclpy.shutdown()
