"""Wrong uses of the logger."""

import rclpy

rclpy.init()
node = rclpy.create_node("wrong_log")
log = node.get_logger()
for call in (
    lambda: log.info("x", nonsense=True),
    lambda: log.info("a", "b"),
    lambda: log.set_level("LOUD"),
    lambda: log.log("m", 99),
):
    try:
        print(call())
    except Exception as error:
        print(type(error).__name__)
log.info(str(42))
log.info("percent %d and {braces}")
rclpy.shutdown()
