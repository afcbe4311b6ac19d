"""ROS arguments, unknown arguments, and the arguments that remain."""

import rclpy
from rclpy.utilities import remove_ros_args

words = ["prog", "--ros-args", "-p", "a:=1", "-r", "x:=y", "--", "--mine", "3"]
print(remove_ros_args(args=words))
for bad in (
    ["--ros-args", "--nonsense"],
    ["--ros-args", "-p", "a"],
    ["--ros-args", "-r", "x"],
    ["--ros-args", "-p", "a:=[1, b]"],
):
    try:
        rclpy.init(args=bad)
        print("fine")
        rclpy.shutdown()
    except Exception as error:
        print(type(error).__name__)
rclpy.init(args=words)
print(rclpy.ok())
rclpy.shutdown()
