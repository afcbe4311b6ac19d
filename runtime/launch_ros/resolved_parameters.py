"""The parameters with which a node will start: value, type, and the part of the launch file each comes from."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bot_console.runtime.rmw.parameter_node_keys import ALL_NODES
from bot_console.runtime.rmw.parameter_precedence import ParameterTable, ParameterYamlError
from bot_console.runtime.rmw.parameter_types import word_of
from launch_ros.descriptions.parameter_file import PREFIX
from launch_ros.parameter_arguments import ParameterArgument


@dataclass(frozen=True)
class ResolvedParameter:
    """A parameter's value, the name of its type, and its source."""

    name: str
    value: Any
    type_name: str
    source: str


def resolve_parameters(arguments: Iterable[ParameterArgument], node_name: str) -> list[ResolvedParameter]:
    """Return a node's overrides by rcl's rules; raises `ParameterYamlError` for what the node would refuse."""
    together = ParameterTable()
    sources: dict[str, list[tuple[str, Any]]] = {}
    for argument, is_file in arguments:
        alone = ParameterTable()
        for table in (together, alone):
            _add(table, argument, is_file)
        source = _source(argument, is_file)
        for name, value in alone.for_node(node_name).items():
            sources.setdefault(name, []).append((source, value))
    return [
        ResolvedParameter(name, value, _type_name(value), _source_of(sources[name], value))
        for name, value in sorted(together.for_node(node_name).items())
    ]


def problem_of(arguments: Iterable[ParameterArgument], node_name: str) -> str:
    """Say why the node would refuse its parameters; empty if it would accept them."""
    try:
        resolve_parameters(arguments, node_name)
    except ParameterYamlError as error:
        return str(error)
    return ""


def _add(table: ParameterTable, argument: str, is_file: bool) -> None:
    if is_file:
        table.add_file(argument)
    else:
        name, _, value = argument.partition(":=")
        table.add_value(ALL_NODES, name, value)


def _source(argument: str, is_file: bool) -> str:
    if not is_file:
        return "set by name"
    return "launch file" if Path(argument).name.startswith(PREFIX) else argument


def _source_of(given: list[tuple[str, Any]], value: object) -> str:
    """Return the last source that gives the effective value."""
    return next((source for source, each in reversed(given) if each == value), given[-1][0])


def _type_name(value: Any) -> str:
    if isinstance(value, list):
        return f"{_type_name(value[0])}_array" if value else "empty array"
    return "not set" if value is None else word_of(value)
