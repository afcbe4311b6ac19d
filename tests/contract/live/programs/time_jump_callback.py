"""A jump callback on a clock whose time is set."""

from rclpy.clock import ClockType, JumpThreshold, ROSClock
from rclpy.duration import Duration
from rclpy.time import Time

clock = ROSClock()
jumps = []
threshold = JumpThreshold(min_forward=Duration(seconds=5), min_backward=Duration(seconds=-1), on_clock_change=True)
handle = clock.create_jump_callback(
    threshold, post_callback=lambda jump: jumps.append((jump.clock_change.name, jump.delta.nanoseconds))
)
clock._set_ros_time_is_active(True)
for second in (1, 3, 9, 2):
    clock.set_ros_time_override(Time(seconds=second, clock_type=ClockType.ROS_TIME))
print(jumps)
handle.unregister()
