"""Evaluate the `parameters` of a node when it starts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import yaml
from launch.utilities import ensure_argument_type, perform_substitutions
from launch.utilities.type_utils import is_normalized_substitution
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

SCALARS = (float, int, str, bool, bytes)
ITEM_SCALARS = (bool, int, float, str)


def evaluate_parameters(context: LaunchContext, parameters: Sequence[Any]) -> tuple[Any, ...]:
    """Return each entry as a dict of plain values, a path, or a `Parameter`; raises `TypeError` for non-ROS types."""
    found: list[Any] = []
    for entry in parameters:
        if isinstance(entry, ParameterFile):
            found.append(entry.evaluate(context))
        elif isinstance(entry, Parameter):
            entry.evaluate(context)
            found.append(entry)
        else:
            found.append(evaluate_parameter_dict(context, entry))
    return tuple(found)


def evaluate_parameter_dict(context: LaunchContext, parameters: Mapping[Any, Any]) -> dict[str, Any]:
    """Return names and values."""
    found: dict[str, Any] = {}
    for key, value in parameters.items():
        name = perform_substitutions(context, key)
        if isinstance(value, ParameterValue):
            found[name] = value.evaluate(context)
        else:
            found[name] = check_value(name, _evaluate(context, name, value))
    return found


def _evaluate(context: LaunchContext, name: str, value: Any) -> Any:
    if is_normalized_substitution(value):
        return yaml_value(name, perform_substitutions(context, value))
    if not isinstance(value, tuple):
        return value
    items = cast("tuple[Any, ...]", value)
    if any(isinstance(each, list) for each in items):
        return [yaml_value(name, perform_substitutions(context, each)) if _is_list(each) else each for each in items]
    if not items:
        ensure_argument_type(items, SCALARS, "value")
    return items


def yaml_value(name: str, text: str) -> Any:
    """Parse a text as YAML; an empty one is returned unchanged."""
    if not text:
        return text
    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(
            f"Unable to parse the value of parameter {name} as yaml. If the parameter is meant to be a string, try "
            "wrapping it in launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
        ) from error


def check_value(name: str, value: object) -> Any:
    """Return the value, with lists as tuples; raises `TypeError` if no ROS parameter can have it."""
    if isinstance(value, SCALARS):
        return value
    if isinstance(value, Sequence):
        items = cast("Sequence[Any]", value)
        kinds: set[type] = {type(each) for each in items}
        if len(kinds) == 1 and kinds <= {*ITEM_SCALARS}:
            return tuple(items)
        raise TypeError(
            "Expected a non-empty sequence, with items of uniform type. Allowed sequence item types are "
            f'bool, int, float, str. Got inconsistent input for "{name}"'
        )
    raise TypeError(
        "Allowed value types are bytes, bool, int, float, str, Sequence[bool], Sequence[int], Sequence[float], "
        f'Sequence[str]. Got {type(value)} for "{name}". If the parameter is meant to be a string, try wrapping it in '
        "launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
    )


def _is_list(value: object) -> bool:
    return isinstance(value, list)
