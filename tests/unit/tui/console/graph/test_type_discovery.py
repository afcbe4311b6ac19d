"""Which nodes are asked for unknown types, and how often."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from bot_console.tui.console.calls import NoAnswer
from bot_console.tui.console.graph.type_discovery import Inquiry, TypeDiscovery
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo

SPOT = "told_nowhere/msg/Spot"


class Graph:
    """Replaces the console's node, its calls and the type source; only `/knows` can describe types."""

    def __init__(self) -> None:
        self.context = SimpleNamespace(get_domain_id=lambda: 0)
        self.asked: list[str] = []
        self.types: list[str] = []
        self.learned = 0
        self.reported = TypeDiscovery(cast("Any", self), cast("Any", self), cast("Any", self), self._one_more)

    def _one_more(self) -> None:
        self.learned += 1

    def has(self, *nodes: str, types: tuple[str, ...] = (SPOT,)) -> None:
        """Let these nodes publish the types; another node uses a type that is available here."""
        self._nodes = nodes
        topics = (Endpoint("/spots", types), Endpoint("/words", ("std_msgs/msg/String",)))
        self.reported.follow(GraphInfo(tuple(NodeInfo(each) for each in nodes), topics))

    def inquiries(self, domain: int, type_name: str) -> dict[str, Inquiry]:
        return {each: self._inquiry(type_name, f"of {each}") for each in self._nodes}

    def _inquiry(self, type_name: str, type_hash: str) -> Inquiry:
        reported = yield type_name, type_hash
        return "" if reported == "/knows" else "has not described it"

    def run(self, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        asyncio.run(work())

    async def ask(self, kind: object, service: str, request: Any) -> str:
        assert request.type_name.startswith("told_nowhere/") and request.include_type_sources
        self.types.append(request.type_name)
        node = service.rpartition("/")[0]
        assert request.type_hash == f"of {node}"
        self.asked.append(node)
        if node == "/hangs":
            raise NoAnswer(f"{service} did not answer within 5 s")
        return node

    def forget(self, prefix: str) -> None:
        assert prefix.endswith("/get_type_description")


def test_each_node_is_asked_once_until_one_describes_the_type() -> None:
    graph = Graph()
    graph.has("/hangs", "/other")
    graph.has("/hangs", "/other")
    assert graph.asked == ["/hangs", "/other"] and not graph.learned
    assert graph.reported.explain(SPOT, "") == f"the type {SPOT} is not known here: /other has not described it"

    graph.has("/hangs", "/knows", "/other")
    graph.has("/hangs", "/knows", "/last", "/other")
    assert graph.asked == ["/hangs", "/other", "/knows"] and graph.learned == 1
    assert graph.reported.explain(SPOT, "nothing to say") == "nothing to say"


def test_a_node_that_has_come_back_is_asked_again() -> None:
    graph = Graph()
    graph.has("/hangs")
    graph.has()
    graph.has("/hangs")
    assert graph.asked == ["/hangs", "/hangs"]
    assert "did not answer within 5 s" in graph.reported.explain(SPOT, "")


def test_further_types_of_a_learned_package_are_requested(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    graph = Graph()
    graph.has("/knows")
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "told_nowhere").mkdir()  # makes the package importable, as learning a type does
    graph.has("/knows", types=(SPOT, "told_nowhere/action/Draw_FeedbackMessage", "told_nowhere/action/Draw_SendGoal"))
    assert graph.types == [SPOT, "told_nowhere/action/Draw"] and graph.learned == 2
