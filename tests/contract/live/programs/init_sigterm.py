"""SIGTERM while spinning."""

import os
import signal
import threading

import rclpy
from rclpy.executors import ExternalShutdownException

rclpy.init()
node = rclpy.create_node("terminated")
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGTERM)).start()
try:
    rclpy.spin(node)
    print("spin returned")
except ExternalShutdownException:
    print("ExternalShutdownException")
print(rclpy.ok())
