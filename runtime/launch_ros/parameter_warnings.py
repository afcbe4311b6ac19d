"""Warnings about parameters whose values differ from what a launch file seems to say; the result is that of ROS 2."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import launch.logging
import yaml
from bot_console.runtime.rmw.parameter_node_keys import key_matches
from bot_console.runtime.rmw.parameter_places import node_keys
from bot_console.runtime.rmw.parameter_scalars import INT64_MAX, INT64_MIN, scalar_value
from bot_console.runtime.rmw.parameter_types import word_of
from launch.utilities import perform_substitutions
from launch.utilities.type_utils import is_normalized_substitution
from launch_ros.descriptions.parameter_value import ParameterValue

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


def warn_of_files(files: Iterable[str], node_name: str, origin: str) -> None:
    """Warn of each file that has no key for the node."""
    for path in files:
        keys = _keys_of(path) if os.path.isfile(path) else ()
        if keys and not any(key_matches(key, node_name) for key, _ in keys):
            named = ", ".join(f"{key} (line {line})" for key, line in keys[:5])
            _warn(origin, f"parameter file {path} has no section for node {node_name}, only for {named}")


def _keys_of(path: str) -> tuple[tuple[str, int], ...]:
    """Return a file's node keys with their lines; none if it cannot be read, which the node reports better."""
    try:
        with open(path, encoding="utf-8") as file:
            return tuple(node_keys(file.read()))
    except (OSError, UnicodeDecodeError):
        return ()


def warn_of_values(
    context: LaunchContext, given: Mapping[Any, object], evaluated: Mapping[str, object], origin: str
) -> None:
    """Warn of values of a dict whose type changes on the way to the node."""
    for (_, entry), (name, found) in zip(given.items(), evaluated.items(), strict=False):
        value: Any = entry.given if isinstance(entry, ParameterValue) and entry.value_type is None else entry
        if is_normalized_substitution(value):
            text = perform_substitutions(context, value)
            if changes_in_yaml(text, found):
                _warn(origin, f"{name}: the text '{text}' is the {word_of(found)} {found!r} by YAML's rules")
        _warn_of_scalar(name, found, origin)


def _warn_of_scalar(name: str, value: object, origin: str) -> None:
    if isinstance(value, bytes):
        _warn(origin, f"{name}: bytes arrive as their base64 text")
    elif isinstance(value, int) and not INT64_MIN <= value <= INT64_MAX:
        _warn(origin, f"{name}: {value} has more than 64 bits and arrives as a double")
    elif isinstance(value, str) and changes_in_file(value):
        arrives = scalar_value(value)
        _warn(
            origin,
            f"{name}: the string '{value}' arrives as the {word_of(arrives)} {arrives!r}, because it is "
            "written without quotes",
        )


def warn_of_argument(name: str, value: object, origin: str) -> None:
    """Warn of a value for all nodes, which is passed as plain text."""
    if isinstance(value, (list, tuple)):
        _warn(origin, f"{name}: a list set for all nodes arrives as the string '{value}'")
    elif isinstance(value, str) and not isinstance(scalar_value(value), str):
        arrives = scalar_value(value)
        _warn(origin, f"{name}: the string '{value}' arrives as the {word_of(arrives)} {arrives!r}")


def changes_in_yaml(text: str, found: object) -> bool:
    """Whether YAML reads a text differently from a human reader."""
    plain = text.strip()
    if isinstance(found, bool):
        return plain.lower() not in ("true", "false")
    if isinstance(found, int):
        return str(found) != plain.removeprefix("+")
    return isinstance(found, float) and ":" in plain


def changes_in_file(text: str) -> bool:
    """Whether YAML writes a string without quotes that rcl reads as another type."""
    return not isinstance(scalar_value(text), str) and yaml.dump(text).splitlines()[0] == text


def _warn(origin: str, text: str) -> None:
    where = f"{origin}: " if origin else ""
    launch.logging.get_logger("launch").warning(f"{where}{text}")
