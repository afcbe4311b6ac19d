"""The nearest obstacle of a laser scan."""

import math

import rclpy
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float32

rclpy.init()
node = rclpy.create_node("nearest")
out = node.create_publisher(Float32, "nearest", 10)
results = []


def on_scan(scan):
    valid = [r for r in scan.ranges if scan.range_min <= r <= scan.range_max and not math.isinf(r)]
    out.publish(Float32(data=min(valid)))


node.create_subscription(LaserScan, "scan", on_scan, qos_profile_sensor_data)
node.create_subscription(Float32, "nearest", lambda m: results.append(round(m.data, 3)), 10)
scans = node.create_publisher(LaserScan, "scan", qos_profile_sensor_data)
while not (scans.get_subscription_count() and out.get_subscription_count()):
    rclpy.spin_once(node, timeout_sec=0.01)
message = LaserScan(angle_min=-1.0, angle_max=1.0, angle_increment=0.5, range_min=0.1, range_max=10.0)
message.ranges = [0.05, 2.5, math.inf, 1.25, 12.0]
message.header.frame_id = "laser"
scans.publish(message)
while not results:
    rclpy.spin_once(node, timeout_sec=0.1)
print(results, type(message.ranges).__name__, message.ranges[1])
rclpy.shutdown()
