"""The node that reads the graph is replaced when its middleware has lost the names of existing nodes."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.console.graph.observer import DISCOVERY_POLLS, TOPIC, UNNAMED, UNNAMED_POLLS, Observer


class FakeNode:
    """A node that knows some nodes, and some endpoints that belong to none."""

    def __init__(self, *names: str, unnamed: int = 0) -> None:
        self.names = list(names)
        self.unnamed = unnamed
        self.ended = False

    def get_node_names(self) -> list[str]:
        return self.names

    def get_publishers_info_by_topic(self, topic: str) -> list[Any]:
        assert topic == TOPIC
        return [SimpleNamespace(node_name=each) for each in (*self.names, *[UNNAMED] * self.unnamed)]

    def end(self) -> None:
        self.ended = True


@pytest.fixture
def made_nodes() -> list[FakeNode]:
    return []


@pytest.fixture
def observer(made_nodes: list[FakeNode]) -> Observer:
    def make(like: Any) -> tuple[FakeNode, Callable[[], None]]:
        made_nodes.append(FakeNode())
        return made_nodes[-1], made_nodes[-1].end

    return Observer(FakeNode("console", "arm"), make)  # type: ignore[arg-type]


def test_endpoints_that_are_unnamed_for_a_moment_change_nothing(observer: Observer, made_nodes: list[FakeNode]) -> None:
    for unnamed in (1, 1, 0) * UNNAMED_POLLS:
        observer.node.unnamed = unnamed
        observer.poll()
    assert made_nodes == []


def test_another_node_is_used_once_it_knows_all_nodes(observer: Observer, made_nodes: list[FakeNode]) -> None:
    first = observer.node
    first.unnamed = 2
    for _ in range(UNNAMED_POLLS):
        observer.poll()
    (other,) = made_nodes
    observer.poll()
    assert observer.node is first, "the node has found nothing yet"
    other.names = ["console", "arm", "base"]
    observer.poll()
    assert observer.node is other
    other.unnamed = 1  # and again, if another node is lost
    for _ in range(UNNAMED_POLLS):
        observer.poll()
    made_nodes[1].names = ["console", "arm", "base"]
    observer.poll()
    assert observer.node is made_nodes[1] and other.ended
    observer.close()
    assert made_nodes[1].ended


def test_endpoints_that_nobody_can_name_lead_to_one_other_node_only(
    observer: Observer, made_nodes: list[FakeNode]
) -> None:
    observer.node.unnamed = 1
    for _ in range(UNNAMED_POLLS):
        observer.poll()
    made_nodes[0].names, made_nodes[0].unnamed = ["console", "arm"], 1
    for _ in range(DISCOVERY_POLLS + 5 * UNNAMED_POLLS):
        observer.poll()
    assert observer.node is made_nodes[0] and len(made_nodes) == 1
