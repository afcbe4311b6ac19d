"""`bot-console graph --check` judges a graph that has been discovered, not the part that is known first."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.cli.verbs import graph as verb
from bot_console.tui.console.graph.expected import read
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo

ODOM = (Endpoint("/odom", ("nav_msgs/msg/Odometry",)),)
ONE = GraphInfo(nodes=(NodeInfo("/simulator", publishers=ODOM),))
TWO = GraphInfo(nodes=(*ONE.nodes, NodeInfo("/another", publishers=ODOM)))


def checked(text: str, *graphs: GraphInfo, wait: float) -> int:
    """The exit code for a graph that is discovered in these steps."""

    def steps() -> Iterator[GraphInfo]:
        yield from graphs
        while True:
            yield graphs[-1]

    discovered = steps()
    console: Any = SimpleNamespace(snapshot=lambda: SimpleNamespace(graph=next(discovered)))
    return verb._compare(console, read(text), argparse.Namespace(wait=wait, measure=0.0))


@pytest.mark.parametrize(
    "text", ["{exact: true, nodes: [/simulator], topics: {/odom: }}", "topics: {/odom: {publishers: [/simulator]}}"]
)
def test_what_must_not_exist_is_found_although_it_is_discovered_last(
    text: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert checked(text, ONE, TWO, wait=0.3) == 1 and "/another" in capsys.readouterr().out
    monkeypatch.setattr(verb, "GRAPH_SETTLED_S", 0.0)
    assert checked(text, GraphInfo(), ONE, wait=240.0) == 0
