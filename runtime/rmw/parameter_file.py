"""Parses ROS parameter files as rcl does: from YAML events, with rcl's error messages."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from typing import Any

from bot_console.runtime.files.remote_address import is_remote
from bot_console.runtime.programs import hints
from bot_console.runtime.rmw.parameter_node_keys import check_node_key
from bot_console.runtime.rmw.parameter_overrides import NodeOverrides, ParameterOverrides, ParameterYamlError
from bot_console.runtime.rmw.parameter_value import ValueWriter, yaml_events

KEYWORD = "ros__parameters"


def read_parameter_file(path: str, overrides: ParameterOverrides) -> None:
    """Add the values of a file, local or at an https:// address, to the overrides; raises `ParameterYamlError`."""
    import yaml

    if is_remote(path):
        from bot_console.runtime.files.remote_parameters import RemoteError, local_copy

        try:
            path = str(local_copy(path))
        except RemoteError as error:
            raise ParameterYamlError(str(error)) from None
    try:
        with open(path, "rb") as file:
            content = file.read()
    except (OSError, ValueError) as error:  # ValueError is raised for an impossible file name
        if isinstance(error, IsADirectoryError):
            raise ParameterYamlError("Error parsing a event near line 0") from None
        why = getattr(error, "strerror", None) or error
        hint = hint_for(path)
        cause = f"{os.path.abspath(path)}: {why}{hint and f'; {hint}'}"
        raise ParameterYamlError("Error opening YAML file", cause) from None
    reader = _Reader(overrides)
    handlers = {
        yaml.ScalarEvent: reader.scalar,
        yaml.SequenceStartEvent: reader.sequence_start,
        yaml.SequenceEndEvent: reader.sequence_end,
        yaml.MappingStartEvent: reader.mapping_start,
        yaml.MappingEndEvent: reader.mapping_end,
        yaml.AliasEvent: reader.alias,
    }
    try:
        for event in yaml_events(content):
            reader.line = event.start_mark.line + 1
            handler = handlers.get(event.__class__)
            if handler is not None:
                handler(event)
    except yaml.YAMLError as error:
        text = f"Error parsing a event near line {reader.line}"
        raise ParameterYamlError(text, _not_yaml(path, content, error)) from None
    except ParameterYamlError as error:
        error.hint = _misspelt(path, content, error)
        raise


def _not_yaml(path: str, content: bytes, error: Exception) -> str:
    """Say where and why a text is not YAML; names a tab as the cause, which the YAML library's message does not."""
    mark = getattr(error, "problem_mark", None)
    if mark is None:
        return ""
    number: int = mark.line
    problem: str = getattr(error, "problem", "")
    lines = content.decode("utf-8", "replace").splitlines()
    line = lines[number] if number < len(lines) else ""
    tab = "\t" in line[: len(line) - len(line.lstrip())]
    if not tab and (unspaced := _missing_space_hint(path, lines[: number + 1])):
        return unspaced
    return f"{path}:{number + 1}: {hints.TAB if tab else problem}"


def _misspelt(path: str, content: bytes, error: Exception) -> str:
    lines = content.decode("utf-8", "replace").splitlines()
    for number, line in enumerate(lines, 1):
        if line.strip().startswith("ros_parameters:"):
            return f"{path}:{number}: {hints.UNDERSCORE}"
    named = re.search(r"line (?:\d+)", str(error))
    return _missing_space_hint(path, lines[: int(named[0].split()[1])] if named else lines)


def _missing_space_hint(path: str, lines: list[str]) -> str:
    """Return a hint, with its place, at the last line up to the error that lacks the space after a colon; empty if none
    does.
    """
    for number in range(len(lines), max(0, len(lines) - 3), -1):
        if text := hints.unspaced_colon(lines[number - 1]):
            return f"{path}:{number}: {text}"
    return ""


class _Levels:
    """The names of the nesting levels above the reader's position, joined by a separator."""

    def __init__(self, separator: str) -> None:
        self.separator = separator
        self.count = 0
        self.path: str | None = None

    def add(self, name: str) -> None:
        if self.path is None:
            self.path = name
        else:
            joint = "" if self.path.endswith(self.separator) else self.separator
            self.path += joint + name
        self.count += 1

    def replace(self, path: str) -> None:
        self.path = path
        self.count += 1

    def remove(self) -> None:
        if self.count == 0:
            return
        self.count -= 1
        if self.count == 0 or self.path is None:
            self.path = None
        elif self.separator in self.path:
            self.path = self.path[: self.path.rindex(self.separator)]


class _Reader:
    """The reader's state. rcl's rules, with their corner cases, are about events, not about a tree."""

    def __init__(self, overrides: ParameterOverrides) -> None:
        self.line = 0
        self._overrides = overrides
        self._writer = ValueWriter()
        self._is_key = True
        self._in_parameters = False
        self._new_map = False
        self._depth = 0
        self._node_levels = _Levels("/")
        self._parameter_levels = _Levels(".")
        self._node: NodeOverrides | None = None
        self._index = 0

    def scalar(self, event: Any) -> None:
        if self._is_key:
            self._key(event.value)
            self._is_key = False
            return
        if not self._in_parameters or self._node is None or self._index >= len(self._node.names):
            raise ParameterYamlError(f"Cannot have a value before {KEYWORD} at line {self.line}")
        self._writer.scalar(event, self._node.values[self._index])
        if not self._writer.in_list:
            self._is_key = True

    def _key(self, name: str) -> None:
        if not name:
            raise ParameterYamlError(f"No key at line {self.line}")
        if self._in_parameters:
            self._parameter_key(name)
        elif name.startswith(KEYWORD):
            self._enter_parameters()
        else:
            self._node_levels.add(name)

    def _enter_parameters(self) -> None:
        key = self._node_levels.path
        if key is None:
            raise ParameterYamlError(f"There are no node names before {KEYWORD} at line {self.line}")
        check_node_key(key)
        self._node = self._overrides.node(key)
        self._node_levels.remove()
        self._in_parameters = True

    def _parameter_key(self, name: str) -> None:
        node = self._node
        if node is None or (self._new_map and self._index >= len(node.names)):
            raise ParameterYamlError(f"Internal error creating param namespace at line {self.line}")
        if self._new_map:
            # A map under a parameter's name turns that name into a prefix of the names in the map.
            self._parameter_levels.replace(node.names[self._index])
            self._new_map = False
        above = self._parameter_levels.path
        if above is None:
            self._index = node.find(name)
            return
        self._index = node.find(above)
        node.names[self._index] = f"{above}.{name}"

    def sequence_start(self, event: object) -> None:
        if self._is_key:
            raise ParameterYamlError(f"Sequences cannot be key at line {self.line}")
        if not self._in_parameters:
            raise ParameterYamlError(
                f"Sequences can only be values and not keys in params. Error at line {self.line}\n"
            )
        self._writer.start_list()

    def sequence_end(self, event: object) -> None:
        self._writer.end_list()
        self._is_key = True

    def mapping_start(self, event: object) -> None:
        self._depth += 1
        self._is_key = True
        # The map right below the keyword belongs to no parameter.
        self._new_map = not (self._in_parameters and self._depth - (self._node_levels.count + 1) == 2)

    def mapping_end(self, event: object) -> None:
        if not self._in_parameters:
            if self._depth == self._node_levels.count + 1:
                self._node_levels.remove()
        elif self._parameter_levels.count:
            self._parameter_levels.remove()
        else:
            self._in_parameters = False
        self._depth -= 1

    def alias(self, event: object) -> None:
        raise ParameterYamlError(f"Will not support aliasing at line {self.line}\n")


Find = Callable[[str], str]
"""Returns a hint about where a parameter file with that path may be; empty if it knows none."""

_finders: list[Find] = []


def register_hint_source(find: Find) -> None:
    """Register a function that gives such hints; does nothing if it is already registered."""
    if find not in _finders:
        _finders.append(find)


def hint_for(path: str) -> str:
    """Return a hint about where a missing parameter file may be; empty if there is none."""
    return next((hint for find in _finders if (hint := find(path))), "")
