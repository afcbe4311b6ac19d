"""The topics of a missing robot that nodes need, by the resolved names and types of the graph."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
from bot_console.tui.console.robot.robot_needed import drives_stamped, endpoints, robot_wanted, visible_nodes
from domains import unused_domain
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.context import Context
from sensor_msgs.msg import LaserScan


class Nodes:
    """Makes nodes that subscribe to topics or publish them."""

    def __init__(self) -> None:
        self._context = Context()
        rclpy.init(args=[], context=self._context, domain_id=unused_domain())
        self._made: list[Any] = []

    def __call__(self, name: str, *, wants: Any = (), gives: Any = (), namespace: str = "") -> Any:
        made = rclpy.create_node(name, context=self._context, namespace=namespace, enable_rosout=False)
        self._made.append(made)
        for kind, topic in wants:
            made.create_subscription(kind, topic, lambda message: None, 10)
        for kind, topic in gives:
            made.create_publisher(kind, topic, 10)
        return made

    def close(self) -> None:
        for each in self._made:
            each.destroy_node()
        self._context.try_shutdown()


@pytest.fixture
def node() -> Iterator[Nodes]:
    nodes = Nodes()
    yield nodes
    nodes.close()


@pytest.fixture
def watcher(node: Nodes) -> Any:
    """The node that observes the graph."""
    return node("_watcher")


SCAN, ODOM, CMD = (LaserScan, "scan"), (Odometry, "/odom"), (Twist, "cmd_vel")
STAMPED = (TwistStamped, "cmd_vel")


def test_each_missing_topic_is_reported_with_the_nodes_that_need_it(node, watcher):
    assert robot_wanted(watcher) == ""
    node("one", wants=[SCAN])
    assert robot_wanted(watcher) == "nobody publishes /scan for /one"
    node("two", wants=[SCAN, ODOM], gives=[CMD])
    assert robot_wanted(watcher) == (
        "nobody publishes /scan for /one and /two, nobody publishes /odom for /two, "
        "nobody subscribes to /cmd_vel of /two"
    )
    node("three", wants=[SCAN])
    assert "nobody publishes /scan for /one and 2 others" in robot_wanted(watcher)


@pytest.mark.parametrize("gives", [SCAN, ODOM])
def test_no_robot_is_needed_if_there_is_one(gives, node, watcher):
    node("robot", gives=[gives])
    node("driver", wants=[SCAN, ODOM], gives=[CMD])
    assert robot_wanted(watcher) == ""


def test_a_base_that_takes_velocities_is_enough_for_a_node_that_only_drives(node, watcher):
    node("driver", gives=[CMD])
    assert robot_wanted(watcher) == "nobody subscribes to /cmd_vel of /driver"
    node("base", wants=[CMD])
    assert robot_wanted(watcher) == ""


def test_stamped_velocities_need_a_robot_that_takes_them(node, watcher):
    assert not drives_stamped(watcher)
    node("driver", gives=[STAMPED])
    assert robot_wanted(watcher) == "nobody subscribes to /cmd_vel of /driver"
    assert drives_stamped(watcher)
    base = node("base", wants=[STAMPED])
    assert robot_wanted(watcher) == ""
    base.destroy_node()
    node("other", gives=[CMD])
    assert not drives_stamped(watcher)


@pytest.mark.parametrize(
    "wanting",
    [
        {"wants": [(Twist, "scan")]},
        {"wants": [(LaserScan, "laser")]},
        {"wants": [SCAN], "namespace": "/other"},
        {"name": "_tool", "wants": [SCAN], "gives": [CMD]},
    ],
    ids=["type", "name", "namespace", "hidden"],
)
def test_topics_that_the_simulator_cannot_provide_are_not_needed(wanting, node, watcher):
    node(wanting.pop("name", "node"), **wanting)
    assert robot_wanted(watcher) == ""


def test_endpoints_are_equal_until_the_relevant_graph_changes(node, watcher):
    before = endpoints(watcher)
    assert endpoints(watcher) == before
    driver = node("driver")
    with_driver = endpoints(watcher)
    assert with_driver != before
    driver.create_publisher(Twist, "cmd_vel", 10)
    assert endpoints(watcher) != with_driver
    assert visible_nodes(watcher) == 1
