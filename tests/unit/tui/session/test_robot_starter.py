"""When a launch counts as up, so that a missing robot may be started: nodes of other programs do not count."""

import pytest
import rclpy
from bot_console.tui.session.robot_starter import GRAPH_POLL_S, SETTLED_S, RobotStarter, System
from geometry_msgs.msg import Twist
from rclpy.context import Context

OWN_DOMAIN = 91
"""A domain that contains no node of another test of this process."""
POLLS = int(SETTLED_S / GRAPH_POLL_S) + 2
"""Polls of an unchanged graph until its nodes count as up."""


@pytest.fixture
def make():
    """Makes nodes of one graph."""
    context = Context()
    context.init([], domain_id=OWN_DOMAIN)
    nodes = []

    def made(name):
        nodes.append(rclpy.create_node(name, context=context))
        return nodes[-1]

    yield made
    for each in nodes:
        each.destroy_node()
    context.try_shutdown()


def poll_until_settled(beside, node):
    for _ in range(POLLS):
        beside._poll(node)
    return beside.started


@pytest.fixture
def make_starter():
    """Makes a starter for a launch of `processes` programs, beside nodes of other programs that were there before."""
    return lambda processes, others: RobotStarter(
        System(lambda: (processes, 0), lambda text: None, lambda arguments: None, others), {}
    )


def test_node_of_another_program_does_not_stand_in_for_a_starting_process(make, make_starter):
    make("driver").create_publisher(Twist, "/cmd_vel", 10)
    looker = make("_looker")
    launched = make_starter(1, 1)
    assert not poll_until_settled(launched, looker)
    make("blind")
    assert poll_until_settled(launched, looker)


def test_nothing_is_decided_before_the_first_process_runs(make, make_starter):
    make("driver").create_publisher(Twist, "/cmd_vel", 10)
    assert not poll_until_settled(make_starter(0, 1), make("_looker"))


def test_launched_nodes_get_a_robot(make, make_starter):
    make("driver").create_publisher(Twist, "/cmd_vel", 10)
    assert poll_until_settled(make_starter(1, 0), make("_looker"))
