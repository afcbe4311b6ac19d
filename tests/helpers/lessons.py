"""What a lesson observes: parameters, changes, command lines and launches."""

from __future__ import annotations

from typing import Any

from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    Endpoint,
    GraphInfo,
    Kind,
    NodeInfo,
    ParameterInfo,
    ParameterTree,
)
from bot_console.tui.learn.activity import Activity
from bot_console.tui.learn.command_log import Command


def parameter(node: str, name: str, value: Any, **facts: Any) -> ParameterInfo:
    kind = {bool: Kind.BOOL, int: Kind.INTEGER, float: Kind.DOUBLE, str: Kind.STRING}[type(value)]
    return ParameterInfo(node, name, kind, value, **facts)


def snapshot(*parameters: ParameterInfo, topics: tuple[str, ...] = (), **parts: Any) -> ConsoleSnapshot:
    nodes = sorted({each.node for each in parameters})
    trees = {node: ParameterTree(node, tuple(each for each in parameters if each.node == node)) for node in nodes}
    graph = GraphInfo(tuple(NodeInfo(each) for each in nodes), tuple(Endpoint(each, ()) for each in topics))
    return ConsoleSnapshot(parameters=trees, graph=graph, **parts)


def change(name: str, value: Any, *, accepted: bool = True, reason: str = "") -> Change:
    return Change(0, 0, "/n", name, 0.0, value, ChangeSource.EDIT, accepted, reason)


def seen(*parameters: ParameterInfo, **facts: Any) -> Activity:
    activity = Activity(**facts)
    activity.observe(snapshot(*parameters))
    return activity


def refused(name: str, reason: str) -> Command:
    """A command line that set a parameter and was refused by the node."""
    return Command(("ros2", "param", "set", "/n", name, "9"), 0, errors=f"Setting parameter failed: {reason}\n")


def launched(*arguments: str, file: str = "x.launch.py", code: int | None = None, settled: bool = True) -> Activity:
    """The actions recorded after a launch file was launched in a workspace that contains only `x.launch.py`."""
    activity = Activity()
    files = {"x.launch.py": [("launch/x.launch.py", "Node()")]}
    activity.add_launches(
        (), [Command(("launch", "p", file, *arguments), code, settled)], lambda word: files.get(word, ())
    )
    return activity
