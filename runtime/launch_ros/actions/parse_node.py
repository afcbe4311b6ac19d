"""A node in XML and YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.process_attributes import parse_command_line
from launch_ros.actions.parse_parameters import parse_nested_parameters, parse_remappings

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


def parse_node(entity: Entity, parser: Parser, kwargs: dict[str, Any]) -> dict[str, Any]:
    """Add a node's attributes to the keyword arguments of its process."""
    for attribute, keyword in (("args", "arguments"), ("ros_args", "ros_arguments")):
        text = entity.get_attr(attribute, optional=True)
        if text is not None:
            kwargs[keyword] = parse_command_line(text, parser)
    kwargs["executable"] = parser.parse_substitution(entity.get_attr("exec"))
    for attribute, keyword in (
        ("pkg", "package"),
        ("name", "name"),
        ("namespace", "namespace"),
        ("exec_name", "exec_name"),
    ):
        text = entity.get_attr(attribute, optional=True)
        if text is not None:
            kwargs[keyword] = parser.parse_substitution(text)
    remappings = parse_remappings(entity, parser)
    if remappings is not None:
        kwargs["remappings"] = remappings
    parameters = entity.get_attr("param", data_type=list, optional=True)
    if parameters is not None:
        kwargs["parameters"] = parse_nested_parameters(parameters, parser)
    return kwargs
