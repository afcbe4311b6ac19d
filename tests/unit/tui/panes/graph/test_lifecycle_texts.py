"""What the graph says about the state of a lifecycle node."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import ConsoleSnapshot, GraphInfo, NodeInfo
from bot_console.tui.panes.graph.about import summary
from bot_console.tui.panes.graph.details import details

NAME = "/arm/gripper"


@pytest.mark.parametrize(
    ("state", "has_transitions"),
    [("unconfigured", True), ("inactive", True), ("active", True), ("activating", False), ("finalized", False)],
)
def test_key_for_transitions_is_named_only_in_states_that_have_some(state: str, has_transitions: bool) -> None:
    info = GraphInfo((NodeInfo(NAME),), lifecycle={NAME: state})
    first = details(ConsoleSnapshot(graph=info), NAME)[0]
    assert first.title == f"lifecycle {state}" and (first.about != "") == has_transitions
    line = summary(info, NAME, lambda topic: False)
    assert state in line and ("T changes it" in line) == has_transitions
