"""Asks nodes whether they would accept values, without setting them: which nodes can be asked, and the request.

ROS 2 has no service for that, and setting values and restoring them is not a dry run: the robot would have acted on
them. A node that offers `~/check_parameters`, of the type of `set_parameters_atomically`, responds as that service
would and sets nothing. Nodes of `bot_console_robot` with their own validation rules do. Pure functions.
"""

from __future__ import annotations

from collections.abc import Mapping

from bot_console.tui.console.model import GraphInfo, Kind, Value
from bot_console.tui.console.parameter_types import field_of

SERVICE, TYPE = "check_parameters", "rcl_interfaces/srv/SetParametersAtomically"


def can_be_asked(graph: GraphInfo) -> frozenset[str]:
    """The nodes that offer `~/check_parameters`."""
    ends = f"/{SERVICE}"
    return frozenset(
        each.name.removesuffix(ends) for each in graph.services if each.name.endswith(ends) and TYPE in each.types
    )


def question(values: Mapping[str, tuple[Kind, Value]]) -> dict[str, object]:
    """The fields of a request that checks values, each given with its kind."""
    return {"parameters": [_parameter(name, kind, value) for name, (kind, value) in values.items()]}


def _parameter(name: str, kind: Kind, value: Value) -> dict[str, object]:
    given = list(value) if isinstance(value, tuple) else value
    return {"name": name, "value": {"type": int(kind), field_of(kind): given}}
