"""Times and durations."""

from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.time import Time

start = Time(seconds=10, nanoseconds=500)
print(start, start.nanoseconds, start.seconds_nanoseconds())
step = Duration(seconds=1.5)
print(step, step.nanoseconds, (start + step).nanoseconds, (start - step).nanoseconds, (start + step) - start)
print(Duration(seconds=1) < Duration(seconds=2), Duration(seconds=1) == Duration(nanoseconds=10**9))
print(start.to_msg(), step.to_msg(), Duration.from_msg(step.to_msg()) == step)
for call in (
    lambda: start + start,
    lambda: start - 5,
    lambda: start < Time(seconds=1, clock_type=ClockType.ROS_TIME),
    lambda: Time(seconds=-1),
    lambda: Time(seconds=2**70),
    lambda: start == 5,
):
    try:
        print(call())
    except Exception as error:
        print(type(error).__name__, error)
print(Clock(clock_type=ClockType.STEADY_TIME).now().clock_type)
