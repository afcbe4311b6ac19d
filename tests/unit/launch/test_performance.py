"""Work that must not grow faster than the launch, measured by counting calls."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from launch.actions import IncludeLaunchDescription, LogInfo, RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO
from launch.events.process import ProcessStdout
from launch.handler_registry import HandlerRegistry
from launching import Launch

from launch import EventHandler

FILE = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, LogInfo

LOADED = open({log!r}, "a")
LOADED.write("x")
LOADED.close()


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument("a", default_value="1"), {then}])
"""


def chain(folder: Path, name: str, depth: int, log: Path) -> Path:
    for level in range(depth):
        path = folder / f"{name}_{level + 1}.launch.py"
        then = f"IncludeLaunchDescription({str(path)!r})" if level < depth - 1 else "LogInfo(msg='end')"
        (folder / f"{name}_{level}.launch.py").write_text(FILE.format(log=str(log), then=then))
    return folder / f"{name}_0.launch.py"


@pytest.mark.parametrize("chains", [2, pytest.param(20, marks=pytest.mark.slow)])
def test_each_of_many_includes_is_read_once(run: Launch, tmp_path: Path, chains: int) -> None:
    log = tmp_path / "loaded"
    begin = [chain(tmp_path, f"c{number}", 50, log) for number in range(chains)]
    outcome = run([IncludeLaunchDescription(str(each)) for each in begin])
    assert outcome.code == 0
    assert outcome.message == ["end"] * chains
    assert len(log.read_text()) == 50 * chains


def test_event_consults_only_handlers_of_its_action() -> None:
    from launch.actions import ExecuteProcess

    registry = HandlerRegistry()
    actions = [ExecuteProcess(cmd=["x"]) for _ in range(200)]
    asked: list[Any] = []

    def action_handler(action: Any) -> OnProcessIO:
        handler = OnProcessIO(target_action=action, on_stdout=asked.append)
        matches = handler.matches
        handler.matches = lambda event: asked.append(action) or matches(event)  # type: ignore[method-assign]
        return handler

    for action in actions:
        registry.add(action_handler(action))
    event = ProcessStdout(text=b"x", action=actions[7], name="x-1", cmd=["x"], cwd=None, env=None, pid=1)
    assert len(registry.matching(event)) == 1
    assert asked == [actions[7]]


def test_handlers_are_consulted_newest_first() -> None:
    from launch.actions import ExecuteProcess

    action = ExecuteProcess(cmd=["x"])
    registry = HandlerRegistry()
    first = OnProcessExit(on_exit=[])
    second = EventHandler(matcher=lambda event: True)
    third = OnProcessExit(target_action=action, on_exit=[])
    last = OnProcessExit(on_exit=[])
    for each in (first, second, third):
        registry.add(each)
    registry.add(last, append=True)
    from launch.events.process import ProcessExited

    event = ProcessExited(returncode=0, action=action, name="x-1", cmd=["x"], cwd=None, env=None, pid=1)
    assert registry.matching(event) == [third, second, first, last] == list(registry)
    registry.remove(second)
    assert registry.matching(event) == [third, first, last]
    assert second not in registry


def test_registering_a_handler_is_an_action(run: Launch) -> None:
    handler = OnProcessExit(on_exit=[LogInfo(msg="never")])
    assert run([RegisterEventHandler(handler)]).message == []
