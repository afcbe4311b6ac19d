"""init and shutdown in the wrong order."""

import rclpy

for call in (
    lambda: rclpy.create_node("early"),
    lambda: rclpy.spin_once(None),
    lambda: rclpy.init(),
    lambda: rclpy.init(),
    lambda: rclpy.create_node("ok").get_name(),
    lambda: rclpy.shutdown(),
    lambda: rclpy.try_shutdown(),
    lambda: rclpy.ok(),
    lambda: rclpy.create_node("late"),
):
    try:
        print(call())
    except Exception as error:
        print(type(error).__name__)
