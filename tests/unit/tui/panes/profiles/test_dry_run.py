"""Which nodes are asked whether they would accept a profile."""

from __future__ import annotations

from bot_console.tui.console.model import (
    ConsoleSnapshot,
    Endpoint,
    GraphInfo,
    Kind,
    ParameterInfo,
    ParameterTree,
    ProfileDifference,
)
from bot_console.tui.console.parameters.dry_run import SERVICE, TYPE
from bot_console.tui.panes.profiles.dry_run import DryRun
from fakes.console import FakeConsole


def snapshot(*known: str) -> ConsoleSnapshot:
    """A graph with two nodes that can be asked; the parameters of some of them are known."""
    services = tuple(Endpoint(f"/{each}/{SERVICE}", (TYPE,)) for each in ("talker", "monitor"))
    trees = {
        f"/{each}": ParameterTree(f"/{each}", (ParameterInfo(f"/{each}", "a", Kind.INTEGER, 1),)) for each in known
    }
    return ConsoleSnapshot(graph=GraphInfo(services=services), parameters=trees)


def test_node_whose_parameters_are_no_longer_known_is_not_asked() -> None:
    asking = DryRun(FakeConsole(), lambda *_: None, lambda: None)
    differences = [ProfileDifference(f"/{each}", "a", 1, 2) for each in ("talker", "monitor")]
    asking.ask(differences, snapshot("talker", "monitor"))
    assert set(asking.answers) == {"/talker", "/monitor"}
    asking.ask(differences, snapshot("talker"))
    assert set(asking.answers) == {"/talker"}
