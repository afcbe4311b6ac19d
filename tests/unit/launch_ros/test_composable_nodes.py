"""The requests that a launch file sends to a container to load nodes into it."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import pytest
from helpers.rigs import until
from launch.actions import EmitEvent, GroupAction, Shutdown, TimerAction
from launch.conditions import IfCondition
from launch.events import matches_action
from launch.substitutions import TextSubstitution
from launch_ros.actions import (
    LifecycleNode,
    LoadComposableNodes,
    PushROSNamespace,
    SetParameter,
    SetParametersFromFile,
    SetRemap,
)
from launch_ros.actions.load_composable_nodes import get_composable_node_load_request
from launch_ros.descriptions import ComposableNode
from launch_ros.events.lifecycle import ChangeState
from launching import Launch

from launch import LaunchContext

Found = dict[str, Any]


def request(tmp_path: Path, file: str = "", *before: Any, **options: Any) -> Any:
    context = LaunchContext()
    for each in before:
        each.execute(context)
    if file:
        path = tmp_path / "p.yaml"
        path.write_text(file)
        options["parameters"] = [path]
    described = ComposableNode(package="p", plugin="p::C", name="n", namespace="ns", **options)
    return get_composable_node_load_request(described, context)


def values(request: Any) -> Found:
    return {each.name: each.value.integer_value for each in request.parameters}


FILES: list[tuple[str, str, Found]] = [
    ("no keys of nodes", "a: 1\nb: 2\n", {"a": 1, "b": 2}),
    ("a full name", "/ns/n:\n  ros__parameters: {a: 1}\n", {"a": 1}),
    ("a namespace above", "/ns:\n  n:\n    ros__parameters: {a: 1, b.c: 2}\n", {"a": 1, "b.c": 2}),
    ("a name alone is of the root", "n:\n  ros__parameters: {a: 1}\n", {}),
    ("any node", "/**:\n  ros__parameters: {a: 1}\n", {"a": 1}),
    ("one level", "/*/n:\n  ros__parameters: {a: 1}\n", {"a": 1}),
    ("one level is not two", "/*/*/n:\n  ros__parameters: {a: 1}\n", {}),
    (
        "the last section for the node wins",
        "/**:\n  ros__parameters: {a: 1, b: 2}\n/ns/n:\n  ros__parameters: {a: 3}\n/x:\n  ros__parameters: {a: 9}\n",
        {"a": 3, "b": 2},
    ),
]


@pytest.mark.filterwarnings("ignore:node name not provided")
@pytest.mark.parametrize(("file", "found"), [row[1:] for row in FILES], ids=[row[0] for row in FILES])
def test_parameter_files_are_sent(tmp_path: Path, file: str, found: Found) -> None:
    assert values(request(tmp_path, file)) == found


def test_file_without_parameters_for_the_node_warns(tmp_path: Path) -> None:
    with pytest.warns(UserWarning, match="parameter files will not apply"):
        request(tmp_path, "/x:\n  ros__parameters: {a: 1}\n")


def test_parameters_for_all_nodes_come_first(tmp_path: Path) -> None:
    file = tmp_path / "all.yaml"
    file.write_text("/**:\n  ros__parameters: {a: 1, b: 2}\n")
    found = request(
        tmp_path, "", SetParametersFromFile(str(file)), SetParameter("b", 3), SetRemap("x", "y"), parameters=[{"a": 5}]
    )
    assert [(each.name, each.value.integer_value) for each in found.parameters] == [
        ("a", 1),
        ("b", 2),
        ("b", 3),
        ("a", 5),
    ]
    assert list(found.remap_rules) == ["x:=y"]


def test_false_condition_sends_no_request(tmp_path: Path) -> None:
    assert request(tmp_path, condition=IfCondition("false")) is None


def test_pushed_namespace_does_not_apply_to_the_container(run: Launch, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    class Node:
        def create_client(self, _kind: Any, name: str) -> None:
            asked.append(name)
            raise RuntimeError("enough")

    monkeypatch.setattr("launch_ros.actions.load_composable_nodes.get_ros_node", lambda _context: Node())
    load = LoadComposableNodes(
        target_container=["ns", TextSubstitution(text="/box")],
        composable_node_descriptions=[ComposableNode(package="p", plugin="p::C")],
    )
    run([GroupAction([PushROSNamespace("ns"), load])])
    assert asked == ["ns/box/_container/load_node"]


def test_shutdown_while_nodes_are_awaited_is_one_warning_for_each(
    run: Launch, log_lines: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    raised: list[object] = []
    monkeypatch.setattr(threading, "excepthook", lambda each: raised.append(each.exc_value))
    load = LoadComposableNodes(
        target_container="nobody",
        composable_node_descriptions=[ComposableNode(package="p", plugin="p::C")],
    )
    node = LifecycleNode(executable="true", name="silent", namespace="")
    configure = ChangeState(lifecycle_node_matcher=matches_action(node), transition_id=1)
    run([load, node, EmitEvent(event=configure), TimerAction(period=0.2, actions=[Shutdown()])])
    waited = [
        "Abandoning wait for the '/silent/change_state' service, due to shutdown.",
        "Abandoning wait for the 'nobody/_container/load_node' service, due to shutdown.",
    ]
    until(lambda: raised or sorted(each.partition("]: ")[2] for each in log_lines if "Abandoning" in each) == waited)
    assert not raised


def test_container_must_be_text_or_action() -> None:
    with pytest.raises(TypeError, match="'LoadComposableNodes' expected 'target_container' to be one of"):
        LoadComposableNodes(target_container=5, composable_node_descriptions=[])
