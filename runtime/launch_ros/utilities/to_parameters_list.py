"""Parameters for a service request."""

from __future__ import annotations

from pathlib import Path
from typing import Any


def to_parameters_list(context: Any, node_name: str, namespace: str, evaluated_parameters: Any) -> list[Any]:
    """Parameter messages of a node from what `evaluate_parameters` gave; those of files by the node's full name."""
    from rclpy.parameter import Parameter, parameter_dict_from_yaml_file

    full_name = f"{namespace.rstrip('/')}/{node_name}"
    found: list[Any] = []
    for each in evaluated_parameters:
        if isinstance(each, Path):
            found += parameter_dict_from_yaml_file(str(each), use_wildcard=True, target_nodes=[full_name]).values()
        elif isinstance(each, dict):
            found += [
                Parameter(name, value=list(value) if isinstance(value, tuple) else value).to_parameter_msg()
                for name, value in each.items()
            ]
        else:
            name, value = each.evaluate(context)
            found.append(Parameter(name, value=list(value) if isinstance(value, tuple) else value).to_parameter_msg())
    return found
