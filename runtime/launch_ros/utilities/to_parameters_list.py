"""Convert parameters for a service request."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import yaml
from launch_ros.utilities.evaluate_parameters import evaluate_parameter_dict
from launch_ros.utilities.normalize_parameters import normalize_parameter_dict
from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

PARAMETERS_KEY = "ros__parameters"


def to_parameters_list(
    context: LaunchContext, node_name: str, namespace: str | None, evaluated_parameters: Any
) -> list[Any]:
    """Return a node's `rclpy` parameters from the result of `evaluate_parameters`; from files, only those for the node.

    Issues a `UserWarning` for a file without parameters for the node. Raises `OSError`, `yaml.YAMLError`,
    `RuntimeError` for a file whose keys cannot be matched, and `TypeError` for invalid parameter values.
    """
    full_name = _full_name(node_name, namespace)
    found: list[Any] = []
    for each in evaluated_parameters:
        if isinstance(each, Path):
            values: Mapping[Any, Any] = _values_of_file(context, each, full_name)
        else:
            values = _values_of(context, each)
        found += [Parameter(name, value=_as_list(value)) for name, value in values.items()]
    return found


def _values_of(context: LaunchContext, entry: Any) -> Mapping[Any, Any]:
    if isinstance(entry, Mapping):
        return cast("Mapping[Any, Any]", entry)
    return dict([entry.evaluate(context)])


def _as_list(value: object) -> Any:
    if not isinstance(value, tuple):
        return value
    items = cast("tuple[Any, ...]", value)
    return [*items]


def _full_name(node_name: str, namespace: str | None) -> str:
    name = node_name if node_name.startswith("/") else f"/{node_name}"
    return name if not namespace or namespace == "/" else f"/{namespace.strip('/')}{name}"


def _values_of_file(context: LaunchContext, path: Path, full_name: str) -> dict[str, Any]:
    """Return the values under matching keys, of which later ones win; a file without node keys consists of values."""
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    if not isinstance(content, Mapping):
        raise RuntimeError(f"invalid yaml file {path}, error: it has no keys")
    tree = cast("Mapping[Any, Any]", content)
    sections = list(_sections(tree, []))
    values: dict[str, Any] = {}
    for key, section in sections:
        if _key_matches(key, full_name, path):
            values.update(section or {})
    if not sections:
        values = dict(tree)
    elif not values:
        warnings.warn(
            "node name not provided to launch; parameter files will not apply "
            f"({path} has no section for node {full_name})",
            UserWarning,
            stacklevel=2,
        )
    return evaluate_parameter_dict(context, normalize_parameter_dict(values))


def _sections(content: Mapping[Any, Any], above: list[str]) -> Iterator[tuple[str, Any]]:
    """Yield node keys, in which nested namespaces are joined, each with its parameters."""
    for key, value in content.items():
        if key == PARAMETERS_KEY:
            yield "/".join(above), value
            return
        if isinstance(value, Mapping):
            below = cast("Mapping[Any, Any]", value)
            yield from _sections(below, [*above, str(key).lstrip("/")])


def _key_matches(key: str, full_name: str, path: Path) -> bool:
    """Whether a key matches the node: `*` stands for one part of a name, `**` for any number of parts."""
    pattern = (key if key.startswith("/") else f"/{key}").replace("/*", r"(/\w+)")
    try:
        return re.fullmatch(pattern, full_name) is not None
    except re.error as error:
        raise RuntimeError(f"invalid yaml file {path}, error: {error}") from error
