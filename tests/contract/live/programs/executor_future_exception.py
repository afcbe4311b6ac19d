"""A future with an exception, and one that is cancelled."""

import rclpy
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node("futures")
future = Future()
future.add_done_callback(lambda f: print("callback", type(f.exception()).__name__))
future.set_exception(KeyError("missing"))
rclpy.spin_until_future_complete(node, future)
try:
    future.result()
except KeyError as error:
    print("caught", error)
other = Future()
other.cancel()
print(other.cancelled(), other.done(), other.result())
rclpy.shutdown()
