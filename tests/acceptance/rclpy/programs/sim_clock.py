import sys

import rclpy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock

rclpy.init()
node = rclpy.create_node("sim_clock")
publisher = node.create_publisher(Clock, "/clock", 10)
factor, state = float(sys.argv[1]), {"now": 0.0}


def tick():
    state["now"] += 0.1 * factor
    publisher.publish(Clock(clock=Time(seconds=round(state["now"], 6)).to_msg()))


timer = node.create_timer(0.1, tick)
rclpy.spin(node)
