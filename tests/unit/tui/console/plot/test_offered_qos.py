"""Series of topics whose publishers offer different QoS, or change it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from bot_console.tui.console.model import Endpoint
from bot_console.tui.console.ros_console import RosConsole
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rigs import until
from std_msgs.msg import Int32

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
WEAK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
PATH, RATE = "/gear/data", "rate(/gear)"


@pytest.fixture
def gearbox(shared_context: Context) -> Node:
    """A node that publishes its gear when it changes, and never twice; it is not spun."""
    return Node("gearbox", context=shared_context)


@pytest.fixture
def console(gearbox: Node) -> Iterator[RosConsole]:
    gearbox.create_publisher(Int32, "gear", LATCHED).publish(Int32(data=3))
    made = RosConsole()
    made.start()
    until(lambda: any(each.name == "/gear" for each in made.snapshot().graph.topics), "the topic")
    yield made
    made.close()


def published(console: RosConsole) -> list[Endpoint]:
    return [each for node in console.snapshot().graph.nodes for each in node.publishers]


def test_series_of_a_latched_topic_begins_with_its_current_value(console: RosConsole) -> None:
    assert console.plots.watch(PATH).ok
    until(lambda: list(console.plots.samples(PATH).values) == [3.0], "the value published before")


def test_series_goes_on_after_the_publisher_was_replaced_by_one_that_offers_less(
    console: RosConsole, gearbox: Node
) -> None:
    assert console.plots.watch(PATH).ok and console.plots.watch(RATE).ok
    until(lambda: len(console.plots.samples(PATH).values), "the value published before")
    for each in tuple(gearbox.publishers):
        if each.topic_name == "/gear":
            gearbox.destroy_publisher(each)
    until(lambda: not any(each.name == "/gear" for each in published(console)), "no publisher")
    again = gearbox.create_publisher(Int32, "gear", WEAK)

    def arrived() -> bool:
        again.publish(Int32(data=4))
        rates = console.plots.samples(RATE).values
        return console.plots.samples(PATH).values[-1] == 4.0 and len(rates) > 0 and max(rates) > 0

    until(arrived, "messages of the other publisher")
    console.plots.unwatch(PATH)
    console.plots.unwatch(RATE)
    until(lambda: not gearbox.get_subscriptions_info_by_topic("/gear"), "no subscription left")
