"""What counts as a robot that is there already: whoever gives scans or obeys velocities, and no console."""

import pytest
from bot_console.tui.cli.system import domain
from geometry_msgs.msg import Twist
from rclpy.context import Context
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


@pytest.fixture
def made(monkeypatch):
    """Makes nodes of a domain in which another process seems to be."""
    monkeypatch.setenv("ROS_DOMAIN_ID", "47")
    monkeypatch.setattr(domain, "others_take_part", lambda: True)
    context = Context()
    context.init([], domain_id=47)
    nodes = []

    def make(name):
        nodes.append(Node(name, context=context))
        return nodes[-1]

    yield make
    for each in nodes:
        each.destroy_node()
    context.try_shutdown()


def test_a_console_that_watches_the_velocities_is_none(made):
    made("_bot_console_drive").create_subscription(Twist, "/cmd_vel", lambda message: None, 10)
    made("talker")
    assert domain.robot_there() == []


def test_who_gives_scans_and_who_obeys_velocities_are(made):
    made("lidar").create_publisher(LaserScan, "/scan", 10)
    made("base").create_subscription(Twist, "/cmd_vel", lambda message: None, 10)
    assert domain.robot_there() == ["/base", "/lidar"]
