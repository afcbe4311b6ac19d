"""Publishing the wrong type, and wrong fields."""

import rclpy
from std_msgs.msg import Int32, String

rclpy.init()
node = rclpy.create_node("wrong")
publisher = node.create_publisher(String, "t", 10)
for wrong in (Int32(data=1), "text", None):
    try:
        publisher.publish(wrong)
    except Exception as error:
        print(type(error).__name__)
try:
    String(dta="x")
except Exception as error:
    print(type(error).__name__)
try:
    String().nonsense = 1
except Exception as error:
    print(type(error).__name__, error)
rclpy.shutdown()
