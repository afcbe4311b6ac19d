"""SIGINT while spinning: KeyboardInterrupt, as with Ctrl-C."""

import os
import signal
import sys
import threading

import rclpy
from rclpy.executors import ExternalShutdownException

rclpy.init()
node = rclpy.create_node("interrupted")
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    rclpy.spin(node)
except KeyboardInterrupt:
    print("KeyboardInterrupt")
except ExternalShutdownException:
    print("ExternalShutdownException")
print(rclpy.ok())
node.destroy_node()
rclpy.try_shutdown()
sys.exit(2)
