"""A student's package `intelligent_robot`: what the project of the course week6 asks for, and no more."""

ROBOT = """\
import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

LIMITS = {"max_speed": (0.1, 5.0), "safety_distance": (0.1, 2.0), "detection_threshold": (0, 255)}
VALUES = {
    "robot_name": "Mine",
    "max_speed": 1.0,
    "safety_distance": 0.5,
    "detection_threshold": 100,
    "turn_rate": 1.0,
    "enable_safety": True,
}


class Robot(Node):
    def __init__(self):
        super().__init__("robot_navigator")
        for name, value in VALUES.items():
            self.declare_parameter(name, value, ParameterDescriptor(description=f"The {name} of the robot"))
        self.add_on_set_parameters_callback(self.validate)
        self.wheels = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.drive, 10)

    def validate(self, parameters):
        for each in parameters:
            low, high = LIMITS.get(each.name, (None, None))
            if low is not None and not low <= each.value <= high:
                return SetParametersResult(successful=False, reason=f"{each.name} must be {low} to {high}")
            if each.name == "robot_name" and not each.value:
                return SetParametersResult(successful=False, reason="a robot needs a name")
        return SetParametersResult(successful=True)

    def drive(self, scan):
        command = Twist()
        if min((each for each in scan.ranges if each > 0.0), default=0.0) < self.get_parameter("safety_distance").value:
            command.angular.z = self.get_parameter("turn_rate").value
        else:
            command.linear.x = self.get_parameter("max_speed").value
        self.wheels.publish(command)


def main():
    rclpy.init()
    try:
        rclpy.spin(Robot())
    except KeyboardInterrupt:
        pass
"""
OTHER = """\
import rclpy


def main():
    rclpy.init()
    try:
        rclpy.spin(rclpy.create_node("{name}"))
    except KeyboardInterrupt:
        pass
"""
OTHERS = {"sensor_node": "sensor_handler", "safety_node": "safety_monitor", "telemetry_node": "telemetry_publisher"}
"""The name of the node of each other program."""
CONFIG = """\
robot_navigator:
  ros__parameters:
    max_speed: {speed}
"""
LAUNCH = """\
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

PACKAGE = "intelligent_robot"
NODES = {
    "robot_node": "robot_navigator",
    "sensor_node": "sensor_handler",
    "safety_node": "safety_monitor",
    "telemetry_node": "telemetry_publisher",
}


def generate_launch_description():
    default = os.path.join(get_package_share_directory(PACKAGE), "config", "indoor_config.yaml")
    nodes = [
        Node(package=PACKAGE, executable=each, name=name, parameters=[LaunchConfiguration("config_file")])
        for each, name in NODES.items()
    ]
    return LaunchDescription([DeclareLaunchArgument("config_file", default_value=default), *nodes])
"""
