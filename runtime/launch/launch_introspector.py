"""Formats launch descriptions as a tree of text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler
from launch.launch_description import LaunchDescription
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType


class LaunchIntrospector:
    """Formats a launch description as `ros2 launch --print` does; what needs a context is not evaluated."""

    def format_launch_description(self, launch_description: LaunchDescription) -> str:
        """Return the tree, one line per entity."""
        return "\n".join([f"{launch_description!r}", *_tree(launch_description.entities)])


def _tree(entities: Sequence[LaunchDescriptionEntity]) -> list[str]:
    lines: list[str] = []
    for number, entity in enumerate(entities):
        last = number == len(entities) - 1
        first, *below = _lines(entity)
        lines.append(f"{'└── ' if last else '├── '}{first}")
        lines += [f"{'    ' if last else '│   '}{each}" for each in below]
    return lines


def _lines(entity: object) -> list[str]:
    if isinstance(entity, LogInfo):
        return [f"LogInfo({_describe(entity.msg)})"]
    if isinstance(entity, EmitEvent):
        return [f"EmitEvent(event='{entity.event.name}')"]
    if isinstance(entity, ExecuteProcess):
        return [_process(entity)]
    if isinstance(entity, RegisterEventHandler):
        text, entities = entity.event_handler.describe()
        return [
            f"RegisterEventHandler('{entity.event_handler!r}'):",
            f"├── {text}",
            *(f"    {each}" for each in _tree(list(entities))),
        ]
    return [f"Action('{entity!r}')"]


def _process(action: ExecuteProcess) -> str:
    words = ", ".join(_describe(each) for each in action.process_description.cmd)
    cwd = None if action.cwd is None else f"'{_describe(action.cwd)}'"
    env = action.env
    shown = None if env is None else {_describe(name): _describe(value) for name, value in env}
    return f"ExecuteProcess(cmd=[{words}], cwd={cwd}, env={shown}, shell={action.shell})"


def _describe(value: SomeSubstitutionsType) -> str:
    return " + ".join(each.describe() for each in normalize_to_list_of_substitutions(value))
