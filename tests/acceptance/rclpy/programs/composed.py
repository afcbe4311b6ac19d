import rclpy
from listener import Listener
from rclpy.executors import SingleThreadedExecutor
from talker import Talker

rclpy.init()
executor = SingleThreadedExecutor()
talker, listener = Talker(), Listener()
executor.add_node(talker)
executor.add_node(listener)
try:
    executor.spin()
finally:
    executor.shutdown()
    listener.destroy_node()
    talker.destroy_node()
