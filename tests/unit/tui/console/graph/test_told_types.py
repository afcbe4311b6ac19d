"""Who is asked for types that nobody here has, and how often."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from types import SimpleNamespace
from typing import Any, cast

from bot_console.tui.console.calls import NoAnswer
from bot_console.tui.console.graph.told_types import ToldTypes
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo

SPOT = "told_nowhere/msg/Spot"


class Graph:
    """Stands for the console's node, its calls and what makes types of answers; only `/knows` knows."""

    def __init__(self) -> None:
        self.context = SimpleNamespace(get_domain_id=lambda: 0)
        self.asked: list[str] = []
        self.learned = 0
        self.told = ToldTypes(cast("Any", self), cast("Any", self), cast("Any", self), self._one_more)

    def _one_more(self) -> None:
        self.learned += 1

    def has(self, *nodes: str) -> None:
        """These nodes publish the type, and one has a type that is here."""
        self._nodes = nodes
        topics = (Endpoint("/spots", (SPOT,)), Endpoint("/words", ("std_msgs/msg/String",)))
        self.told.follow(GraphInfo(tuple(NodeInfo(each) for each in nodes), topics))

    def get_publishers_info_by_topic(self, topic: str) -> list[Any]:
        assert topic == "/spots"
        return [
            SimpleNamespace(node_name=each[1:], node_namespace="/", topic_type=SPOT, topic_type_hash=f"of {each}")
            for each in self._nodes
        ]

    def get_subscriptions_info_by_topic(self, topic: str) -> list[Any]:
        return []

    def run(self, work: Coroutine[Any, Any, None], refused: object) -> None:
        asyncio.run(work)

    async def ask(self, kind: object, service: str, request: Any) -> str:
        assert (request.type_name, request.include_type_sources) == (SPOT, True)
        node = service.rpartition("/")[0]
        assert request.type_hash == f"of {node}"
        self.asked.append(node)
        if node == "/hangs":
            raise NoAnswer(f"{service} did not answer within 5 s")
        return node

    def forget(self, prefix: str) -> None:
        assert prefix.endswith("/get_type_description")

    def learn(self, type_name: str, type_hash: str, told: str) -> str:
        return "" if told == "/knows" else "has not described it"


def test_each_node_is_asked_once_until_one_knows() -> None:
    graph = Graph()
    graph.has("/hangs", "/other")
    graph.has("/hangs", "/other")
    assert graph.asked == ["/hangs", "/other"] and not graph.learned
    assert graph.told.explain(SPOT, "") == f"the type {SPOT} is not known here: /other has not described it"

    graph.has("/hangs", "/knows", "/other")
    graph.has("/hangs", "/knows", "/last", "/other")
    assert graph.asked == ["/hangs", "/other", "/knows"] and graph.learned == 1
    assert graph.told.explain(SPOT, "nothing to say") == "nothing to say"


def test_a_node_that_has_come_back_is_asked_again() -> None:
    graph = Graph()
    graph.has("/hangs")
    graph.has()
    graph.has("/hangs")
    assert graph.asked == ["/hangs", "/hangs"]
    assert "did not answer within 5 s" in graph.told.explain(SPOT, "")
