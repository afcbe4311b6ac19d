"""Conditions of the graph that are logged as warnings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest
from bot_console.tui.console.graph.warning_log import GraphWarnings
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo

CMD_VEL = (Endpoint("/cmd_vel", ("geometry_msgs/msg/Twist",)),)
BASE = NodeInfo("/base", (), CMD_VEL)
NAVIGATOR, TELEOP = NodeInfo("/navigator", CMD_VEL), NodeInfo("/teleop", CMD_VEL)
HIDDEN = NodeInfo("/_bot_console", CMD_VEL)
RIVALS = GraphInfo((BASE, NAVIGATOR, TELEOP))


def logged(*graphs: GraphInfo) -> list[str]:
    lines: list[str] = []
    warnings = GraphWarnings(lambda *record: lines.append(record[3]))
    for each in graphs:
        warnings.follow(each)
    return lines


def test_two_publishers_of_a_velocity_topic_are_named_with_the_topic() -> None:
    (line,) = logged(RIVALS)
    assert line.startswith("/cmd_vel is published by /navigator and /teleop: the newest command wins")


@pytest.mark.parametrize("nodes", [(BASE, NAVIGATOR), (BASE, NAVIGATOR, HIDDEN), (NAVIGATOR, TELEOP)])
def test_console_beside_one_publisher_and_topics_without_subscriptions_cause_no_warning(
    nodes: Sequence[NodeInfo],
) -> None:
    assert not logged(GraphInfo(tuple(nodes)))


def test_lifecycle_publishers_cause_no_warning_unless_another_node_joins_them() -> None:
    managed = tuple(
        NodeInfo(name, CMD_VEL, services=(Endpoint(f"{name}/change_state", ("lifecycle_msgs/srv/ChangeState",)),))
        for name in ("/behavior_server", "/controller_server")
    )
    assert not logged(GraphInfo((BASE, *managed)))
    assert len(logged(GraphInfo((BASE, *managed, TELEOP)))) == 1


def test_topics_of_other_types_may_have_several_publishers() -> None:
    points = (Endpoint("/points", ("geometry_msgs/msg/Point",)),)
    nodes = NodeInfo("/a", points), NodeInfo("/b", points), NodeInfo("/c", (), points)
    assert not logged(GraphInfo(nodes))


def test_a_warning_is_logged_once_and_again_when_it_recurs() -> None:
    assert len(logged(RIVALS, RIVALS)) == 1
    assert len(logged(RIVALS, GraphInfo((BASE, NAVIGATOR)), RIVALS)) == 2


def test_duplicate_names_and_frozen_nodes_are_reported() -> None:
    doubled = GraphInfo((replace(BASE, copies=2),), frozen=(("/navigator", 42),))
    lines = logged(doubled, doubled)
    assert len(lines) == 2
    assert any(line.startswith("two nodes are called /base") for line in lines)
    assert any(line.startswith("/navigator is frozen") and "kill -CONT 42" in line for line in lines)
