"""A pane that would stay empty leaves its place in a layout to another."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.robot.robot_model import Pose, WorldInfo
from bot_console.tui.layout.current_layout import Arrangement
from bot_console.tui.layout.tree import panes
from bot_console.tui.layout.unused import GIVE_UP_AFTER_S, UnusedPanes
from piloting import Clock

NODES = GraphInfo(nodes=(NodeInfo("/talker"),))
WITHOUT = ConsoleSnapshot(graph=NODES)


def test_unpublished_world_gives_up_its_place_after_a_while() -> None:
    clock = Clock()
    unused = UnusedPanes(clock)
    assert not unused.panes(WITHOUT)
    clock.now += GIVE_UP_AFTER_S
    assert unused.panes(WITHOUT) == {"world"}
    assert not unused.panes(replace(WITHOUT, world=WorldInfo(pose=Pose()))), "it comes back with a pose"


def test_world_keeps_its_place_until_there_are_nodes_and_while_odometry_is_offered() -> None:
    odometry = GraphInfo(NODES.nodes, (Endpoint("/odom", ("nav_msgs/msg/Odometry",)),))
    for graph in (GraphInfo(), odometry):
        clock = Clock()
        unused = UnusedPanes(clock)
        assert not unused.panes(replace(WITHOUT, graph=graph))
        clock.now += GIVE_UP_AFTER_S
        assert not unused.panes(replace(WITHOUT, graph=graph))


def test_the_graph_or_the_neighbours_take_the_place_of_an_empty_world() -> None:
    for size in ((60, 20), (80, 24), (120, 40)):
        arrangement = Arrangement()
        before = panes(arrangement.tree(*size) or "")
        arrangement.empty = frozenset(("world",))
        assert panes(arrangement.tree(*size) or "") == tuple({"world": "graph"}.get(each, each) for each in before)
    wide = panes(arrangement.tree(200, 60) or "")
    assert "world" not in wide and wide.count("graph") == 1
