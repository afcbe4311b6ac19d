"""Asking nodes what they would say to values, without setting them: who can be asked, and how the question is put.

ROS 2 has no service for that, and to set values and put them back is no dry run: the robot would have had them. A node
that offers `~/check_parameters` of the type of `set_parameters_atomically` answers as that would, and sets nothing.
Those of `bot_console_robot` that have rules of their own offer it. Pure.
"""

from __future__ import annotations

from collections.abc import Mapping

from bot_console.tui.console.model import GraphInfo, Kind, Value
from bot_console.tui.console.parameter_types import field_of

SERVICE, TYPE = "check_parameters", "rcl_interfaces/srv/SetParametersAtomically"


def can_be_asked(graph: GraphInfo) -> frozenset[str]:
    """The nodes that offer the service."""
    ends = f"/{SERVICE}"
    return frozenset(
        each.name.removesuffix(ends) for each in graph.services if each.name.endswith(ends) and TYPE in each.types
    )


def question(values: Mapping[str, tuple[Kind, Value]]) -> dict[str, object]:
    """The request that asks for some values, each with its kind."""
    return {"parameters": [_parameter(name, kind, value) for name, (kind, value) in values.items()]}


def _parameter(name: str, kind: Kind, value: Value) -> dict[str, object]:
    given = list(value) if isinstance(value, tuple) else value
    return {"name": name, "value": {"type": int(kind), field_of(kind): given}}
