"""The exit code after an uncaught interrupt."""

import os
import signal
import threading

import rclpy

rclpy.init()
node = rclpy.create_node("uncaught")
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
rclpy.spin(node)
