"""A timer that cancels itself, is reset, and is destroyed."""

import rclpy

rclpy.init()
node = rclpy.create_node("timers")
ticks = []


def tick():
    ticks.append(len(ticks))
    if len(ticks) == 3:
        timer.cancel()


timer = node.create_timer(0.005, tick)
for _ in range(20):
    rclpy.spin_once(node, timeout_sec=0.02)
print(ticks, timer.is_canceled(), timer.timer_period_ns)
timer.reset()
rclpy.spin_once(node, timeout_sec=0.5)
print(len(ticks), timer.is_canceled(), timer.is_ready())
print(node.destroy_timer(timer), len(list(node.timers)))
rclpy.shutdown()
