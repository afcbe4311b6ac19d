"""What a student writes for the bonus challenges of the course week6: programs of the package `intelligent_robot`."""

PRESETS = """\
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from std_srvs.srv import Trigger

SPEEDS = {"careful": 0.4, "fast": 1.8}


class Presets(Node):
    def __init__(self):
        super().__init__("presets")
        self.robot = AsyncParameterClient(self, "robot_navigator")
        self.robot.wait_for_services(10.0)
        for name, speed in SPEEDS.items():
            self.create_service(Trigger, f"/preset/{name}", lambda _, response, use=speed: self.use(use, response))

    def use(self, speed, response):
        self.robot.set_parameters([Parameter("max_speed", value=speed)])
        response.success = True
        return response


def main():
    rclpy.init()
    try:
        rclpy.spin(Presets())
    except KeyboardInterrupt:
        pass
"""
TUNER = """\
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from sensor_msgs.msg import LaserScan


class Tuner(Node):
    def __init__(self):
        super().__init__("tuner")
        self.speed = 0.0
        self.robot = AsyncParameterClient(self, "robot_navigator")
        self.create_subscription(LaserScan, "scan", self.tune, 10)

    def tune(self, scan):
        nearest = min((each for each in scan.ranges if each > 0.0), default=0.0)
        speed = round(min(max(nearest, 0.3), 1.5), 1)
        if speed != self.speed and self.robot.services_are_ready():
            self.speed = speed
            self.robot.set_parameters([Parameter("max_speed", value=speed)])


def main():
    rclpy.init()
    try:
        rclpy.spin(Tuner())
    except KeyboardInterrupt:
        pass
"""
HISTORY = """\
import rclpy
from rcl_interfaces.msg import ParameterEvent
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python


class History(Node):
    def __init__(self):
        super().__init__("history")
        self.create_subscription(ParameterEvent, "/parameter_events", self.keep, 10)

    def keep(self, event):
        with open("history.csv", "a") as file:
            for each in event.changed_parameters:
                value = parameter_value_to_python(each.value)
                print(event.stamp.sec, event.node, each.name, value, sep=",", file=file)


def main():
    rclpy.init()
    try:
        rclpy.spin(History())
    except KeyboardInterrupt:
        pass
"""
REMOTE = """\
from urllib.request import urlopen

import rclpy
import yaml
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient


class Remote(Node):
    def __init__(self):
        super().__init__("remote")
        robot = AsyncParameterClient(self, "robot_navigator")
        robot.wait_for_services(10.0)
        try:
            with urlopen("http://127.0.0.1:8000/remote.yaml", timeout=2.0) as response:
                values = yaml.safe_load(response.read(10_000))
        except (OSError, yaml.YAMLError) as error:
            self.get_logger().error(f"no values from the server: {error}")
            return
        robot.set_parameters([Parameter(name, value=value) for name, value in values.items()])


def main():
    rclpy.init()
    try:
        rclpy.spin(Remote())
    except KeyboardInterrupt:
        pass
"""
