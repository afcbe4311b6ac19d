"""Sleeping on a clock."""

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration

rclpy.init()
node = rclpy.create_node("sleeper")
before = node.get_clock().now()
print(node.get_clock().sleep_for(Duration(seconds=0.02)))
print((node.get_clock().now() - before) >= Duration(seconds=0.02))
steady = Clock(clock_type=ClockType.STEADY_TIME)
print(steady.sleep_until(steady.now() + Duration(seconds=0.01)))
try:
    steady.sleep_until(node.get_clock().now())
except Exception as error:
    print(type(error).__name__, error)
rclpy.shutdown()
