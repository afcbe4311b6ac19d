"""A launch file that is fully evaluated, with nothing started: the output of `--print --resolved`."""

# pyright: reportPrivateUsage=false
# Discovery is internal to launch and not for its users, so as upstream it has underscores.

from __future__ import annotations

import asyncio
import logging
import sys
from collections.abc import Iterator, Mapping
from typing import Any

import launch.logging
from launch.actions import (
    DeclareLaunchArgument,
    ExecuteLocal,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
)
from launch.actions.include_launch_description import IncludeBoundary
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.utilities import perform_substitutions
from launch_ros.actions import LoadComposableNodes, Node
from launch_ros.resolved_parameters import problem_of, resolve_parameters

STEP = "  "


def resolve_description(path: str, arguments: Mapping[str, str]) -> Iterator[str]:
    """Yield the lines of a launch file's tree with these arguments; raises any error that would end the launch."""
    context = LaunchContext(noninteractive=True)
    context.resolving = True
    loop = asyncio.new_event_loop()
    context._set_asyncio_loop(loop)
    screen = launch.logging.launch_config.get_screen_handler()
    launch.logging.launch_config.set_screen_handler(_problems_only())
    context._push_environment()
    try:
        include = IncludeLaunchDescription(path, launch_arguments=arguments.items())
        yield from _Resolver(context, arguments).lines(include, 0)
    finally:
        context._pop_environment()
        launch.logging.launch_config.set_screen_handler(screen)
        loop.close()


def _problems_only() -> logging.Handler:
    """Send only warnings and errors to stderr, as the tree shows what the launch file logs."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setLevel(logging.WARNING)
    return handler


class _Resolver:
    def __init__(self, context: LaunchContext, given: Mapping[str, str]) -> None:
        self._context = context
        self._given = given

    def lines(self, entity: Any, depth: int) -> Iterator[str]:
        """Yield an entity's own lines, then those of the entities below it."""
        if isinstance(entity, LaunchDescription):
            yield from self._below(entity.visit(self._context), depth)
            return
        if isinstance(entity, IncludeBoundary):
            entity.visit(self._context)
            return
        condition = getattr(entity, "condition", None)
        if condition is not None and not condition.evaluate(self._context):
            yield f"{STEP * depth}{_kind(entity)} (left out: its condition is false)"
            return
        if not hasattr(entity, "execute") or isinstance(entity, LoadComposableNodes):
            yield f"{STEP * depth}{_kind(entity)}"
            return
        later: list[tuple[str, Any]] = (
            [] if isinstance(entity, GroupAction) else entity.describe_conditional_sub_entities()
        )
        below = None if later and condition is None else entity.visit(self._context)
        for line in self._own(entity):
            yield f"{STEP * depth}{line}"
        for text, entities in later if condition is None else ():
            yield f"{STEP * (depth + 1)}{text}:"
            yield from (f"{STEP * (depth + 2)}{_kind(each)}" for each in entities)
        yield from self._below(below, depth + 1)

    def _below(self, entities: Any, depth: int) -> Iterator[str]:
        for each in entities or ():
            yield from self.lines(each, depth)

    def _own(self, entity: object) -> Iterator[str]:
        context = self._context
        if isinstance(entity, DeclareLaunchArgument):
            how = "given" if entity.name in self._given else "default or set before"
            yield f"argument {entity.name} = {context.launch_configurations[entity.name]!r} ({how})"
        elif isinstance(entity, IncludeLaunchDescription):
            yield f"include {entity.launch_description_source.location}"
        elif isinstance(entity, SetLaunchConfiguration):
            name = perform_substitutions(context, entity.name)
            yield f"{name} = {context.launch_configurations[name]!r}"
        elif isinstance(entity, SetEnvironmentVariable):
            name = perform_substitutions(context, entity.name)
            yield f"environment {name} = {context.environment[name]!r}"
        elif isinstance(entity, LogInfo):
            yield f"log {perform_substitutions(context, entity.msg)!r}"
        elif isinstance(entity, Node):
            yield from _node(entity)
        elif isinstance(entity, ExecuteLocal):
            yield f"process {' '.join(entity.process_description.final_cmd or ())}"
        else:
            yield _kind(entity)


def _node(node: Node) -> Iterator[str]:
    command = node.process_description.final_cmd
    if command is None:
        yield "node (left out: its executable is missing)"
        return
    origin = f"  [{node.origin}]" if node.origin else ""
    yield f"node {node.node_name}: {command[0]}{origin}"
    for source, target in node.expanded_remapping_rules or ():
        yield f"{STEP}remap {source} -> {target}"
    arguments = node.expanded_parameter_arguments or []
    name = node.node_name.replace(node.UNSPECIFIED_NODE_NAMESPACE, "")
    problem = problem_of(arguments, name)
    if problem:
        yield f"{STEP}the node will refuse its parameters: {problem}"
        return
    for each in resolve_parameters(arguments, name):
        yield f"{STEP}parameter {each.name} = {each.value!r}  ({each.type_name}, {each.source})"


def _kind(entity: object) -> str:
    return type(entity).__name__
