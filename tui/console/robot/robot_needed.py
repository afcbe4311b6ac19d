"""Finds what a ROS system lacks without a robot: scans, odometry, a subscription to velocities."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from bot_console.tui.console.graph.full_name import node_name_of

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.topic_endpoint_info import TopicEndpointInfo

SOURCES = {"/scan": "sensor_msgs/msg/LaserScan", "/odom": "nav_msgs/msg/Odometry"}
"""The topics that a robot publishes, by resolved names; our simulator cannot publish under other names or types."""
VELOCITY = "/cmd_vel"
TWIST, STAMPED = KINDS = ("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped")
"""The velocity types; a robot takes one of them."""


def robot_wanted(node: Node) -> str:
    """Why the system that `node` sees needs a robot, as text for users; empty if it has one or needs none.

    Whatever publishes one of a robot's topics is a robot, a bag or a substitute, which a second robot would contradict.
    """
    if any(node.get_publishers_info_by_topic(topic) for topic in SOURCES):
        return ""
    reasons = [
        f"nobody publishes {topic} for {_enumerate_names(wanting)}"
        for topic, kind in SOURCES.items()
        if (wanting := _visible_nodes(node.get_subscriptions_info_by_topic(topic), kind))
    ]
    for kind in KINDS:
        drivers = _visible_nodes(node.get_publishers_info_by_topic(VELOCITY), kind)
        if drivers and not _visible_nodes(node.get_subscriptions_info_by_topic(VELOCITY), kind):
            reasons.append(f"nobody subscribes to {VELOCITY} of {_enumerate_names(drivers)}")
    return ", ".join(reasons)


def drives_stamped(node: Node) -> bool:
    """Whether velocities are published with a time stamp, and none without."""
    found = node.get_publishers_info_by_topic(VELOCITY)
    return bool(_visible_nodes(found, STAMPED)) and not _visible_nodes(found, TWIST)


def endpoints(node: Node) -> object:
    """The part of the graph that `robot_wanted` depends on; equal values mean that nothing relevant has changed."""
    topics = (*SOURCES, VELOCITY)
    found = [each for topic in topics for each in _endpoints(node, topic)]
    return sorted(node.get_node_names_and_namespaces()), [(each.node_name, each.topic_type) for each in found]


def visible_nodes(node: Node) -> int:
    """The number of nodes, without tools and the console."""
    return sum(not name.startswith("_") for name in node.get_node_names())


def _endpoints(node: Node, topic: str) -> Iterable[TopicEndpointInfo]:
    yield from node.get_publishers_info_by_topic(topic)
    yield from node.get_subscriptions_info_by_topic(topic)


def _visible_nodes(found: Iterable[TopicEndpointInfo], kind: str) -> list[str]:
    names = (node_name_of(each) for each in found if each.topic_type == kind)
    return sorted({name for name in names if not name.rpartition("/")[2].startswith("_")})


def _enumerate_names(names: list[str]) -> str:
    return " and ".join(names) if len(names) < 3 else f"{names[0]} and {len(names) - 1} others"
