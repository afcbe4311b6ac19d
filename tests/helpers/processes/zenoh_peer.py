"""The other process of tests with two processes: a node with an entity of each kind, in the domain of the environment.

With the argument `patient` it never cuts a link because the other process gets no CPU time.
"""

import sys

from bot_console.runtime.importer import install

install()

import rclpy
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh import congestion_control
from bot_console.runtime.rmw.zenoh.domain.domain_bus import shared_bus
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import Trigger

if "patient" in sys.argv:
    congestion_control.WAIT_BEFORE_CUT_US = 600_000_000


class Peer(Node):
    """Latches a message, echoes, serves, counts, and offers a topic incompatible with reliable subscriptions."""

    def __init__(self) -> None:
        super().__init__("peer", namespace="other")
        self.declare_parameter("speed", 1.5)
        self.latched = self.create_publisher(
            String, "/latched", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        )
        self.latched.publish(String(data="overwritten"))
        self.latched.publish(String(data="kept"))
        self.echo = self.create_publisher(String, "/echo", 1000)
        self.create_subscription(String, "/say", self.echo.publish, 1000)
        self.poor = self.create_publisher(
            String, "/poor", QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        )
        self.create_timer(0.05, lambda: self.poor.publish(String(data="poor")))
        self.create_service(Trigger, "/pull", self.pull)
        self.create_service(Trigger, "/flood", self.flood)
        self.scans = 0
        everything = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0)
        self.create_subscription(LaserScan, "/scan", self.count_scan, everything)
        self.create_service(Trigger, "/scans", self.report_scans)
        self.server = ActionServer(self, Fibonacci, "/fibonacci", self.count)

    def pull(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Respond."""
        response.success, response.message = True, "pulled"
        self.get_logger().info("somebody pulled")
        return response

    def flood(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Log as fast as possible."""
        for number in range(20_000):
            self.get_logger().info(f"flood {number}")
        return response

    def count_scan(self, scan: LaserScan) -> None:
        """Count."""
        self.scans += 1

    def report_scans(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Report how many scans arrived."""
        response.message = str(self.scans)
        return response

    def count(self, handle):
        """Give feedback for each number."""
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        for _ in range(handle.request.order):
            feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
            handle.publish_feedback(feedback)
        handle.succeed()
        return Fibonacci.Result(sequence=feedback.sequence)


choose_middleware(shared_bus)
rclpy.init()
rclpy.spin(Peer())
