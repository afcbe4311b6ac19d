"""Parameters of a node as command line arguments."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import yaml
from bot_console.runtime.process.scratch import scratch_file
from bot_console.runtime.programs.hints import is_read
from bot_console.runtime.rmw.parameter_places import FROM_LAUNCH
from bot_console.runtime.workspace.parameter_files import hint_for
from launch_ros.descriptions.parameter_file import PREFIX

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

ParameterArgument = tuple[str, bool]
"""A file's path and True, or `name:=value` and False."""


def global_parameter_arguments(global_params: Iterable[Any]) -> list[ParameterArgument]:
    """Return what `SetParameter` and `SetParametersFromFile` have set; raises `AssertionError` for a missing file."""
    found: list[ParameterArgument] = []
    for each in global_params:
        if isinstance(each, tuple):
            pair = cast("tuple[Any, ...]", each)
            name, value = pair
            found.append((f"{name}:={value}", False))
        else:
            path = os.path.abspath(each)
            if not os.path.isfile(path):
                raise AssertionError
            found.append((path, True))
    return found


def own_parameter_arguments(
    context: LaunchContext, parameters: Sequence[Any], node_name: str | None, logger: Any, origin: str = ""
) -> list[ParameterArgument]:
    """Return a node's own parameters; a dict becomes a file for the node's full name, or, without one, for any node."""
    found: list[ParameterArgument] = []
    for each in parameters:
        if isinstance(each, Mapping):
            values = cast("Mapping[Any, Any]", each)
            found.append((write_parameters(values, node_name, origin), True))
        elif isinstance(each, Path):
            if each.is_file():
                found.append((str(each), True))
            else:
                logger.warning(f"Parameter file path is not a file: {each}")
                if not each.is_absolute():
                    hint = hint_for(str(each))
                    logger.warning(
                        f"{each} was looked for in {Path.cwd()}, the folder that launch was started in"
                        + (f"; {hint}" if hint else "")
                    )
        else:
            found.append((_rule(*each.evaluate(context)), False))
    return found


def _rule(name: str, value: object) -> str:
    return f"{name}:={yaml.dump(value)}"


def write_parameters(parameters: Mapping[str, object], node_name: str | None, origin: str = "") -> str:
    """Write a new parameter file and return its path. As upstream, lists get a tag that parameter parsers ignore.

    Where a person reads hints, it begins with a comment that names the `origin` of the values in a launch file.
    """
    content = {node_name or "/**": {"ros__parameters": dict(parameters)}}
    comment = f"{FROM_LAUNCH}{origin}\n" if origin and is_read() else ""
    return str(scratch_file(PREFIX, comment + yaml.dump(content, default_flow_style=False)))
