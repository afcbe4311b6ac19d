"""The rows of the topics pane, made from the graph."""

from __future__ import annotations

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.panes.topics.rows import Kind, rows


def test_topics_are_listed_in_natural_order() -> None:
    topics = tuple(Endpoint(f"/robot{number}/scan", ("std_msgs/msg/Float64",)) for number in (1, 10, 2, 20, 3))
    names = [each.name for each in rows(GraphInfo((NodeInfo("/n", topics),), topics), Kind.TOPICS, hidden=False)]
    assert names == [f"/robot{number}/scan" for number in (1, 2, 3, 10, 20)]
