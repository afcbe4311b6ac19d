"""Parameters and remap rules in XML and YAML."""

# ruff: noqa: UP006, UP035 (messages show the names of these types)
from __future__ import annotations

from typing import TYPE_CHECKING, Any, List

from launch_ros.descriptions.parameter_file import ParameterFile
from launch_ros.descriptions.parameter_value import ParameterValue

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser

TYPES: dict[str, Any] = {
    "int": int,
    "float": float,
    "bool": bool,
    "str": str,
    "list_of_int": List[int],
    "list_of_float": List[float],
    "list_of_bool": List[bool],
    "list_of_str": List[str],
    "yaml": None,
}


def parse_nested_parameters(params: list[Entity], parser: Parser) -> list[Any]:
    """Parse each `param` element as a dict or a `ParameterFile`."""
    return [_parameter(each, parser) for each in params]


def _parameter(entity: Entity, parser: Parser) -> Any:
    source = entity.get_attr("from", optional=True)
    name = entity.get_attr("name", optional=True)
    substitute = entity.get_attr("allow_substs", data_type=bool, optional=True)
    if source is not None and name is not None:
        raise RuntimeError("name and from attributes are mutually exclusive")
    if name is not None and substitute is not None:
        raise RuntimeError("'allow_substs' can only be used together with 'from' attribute")
    if source is not None:
        file = ParameterFile(
            parser.parse_substitution(source),
            allow_substs=False if substitute is None else parser.parse_if_substitutions(substitute),
        )
        entity.assert_entity_completely_parsed()
        return file
    if name is None:
        raise ValueError("param Entity should have name or from attribute")
    return _named_parameter(entity, parser)


def _named_parameter(entity: Entity, parser: Parser) -> dict[Any, Any]:
    name = tuple(parser.parse_substitution(entity.get_attr("name")))
    kind = _kind(entity.get_attr("type", optional=True))
    value = entity.get_attr("value", data_type=kind, optional=True)
    nested = entity.get_attr("param", data_type=list, optional=True)
    entity.assert_entity_completely_parsed()
    if value is not None and nested:
        raise RuntimeError("nested parameters and value attributes are mutually exclusive")
    if kind is not None and nested:
        raise RuntimeError("nested parameters and type attributes are mutually exclusive")
    if value is not None:
        return {name: ParameterValue(parser.parse_if_substitutions(value), value_type=kind)}
    if not nested:
        raise RuntimeError("either a value attribute or nested params are needed")
    found: dict[Any, Any] = {}
    for each in nested:
        found.update(_named_parameter(each, parser))
    return {name: found}


def _kind(name: str | None) -> Any:
    if name is None:
        return None
    if name not in TYPES:
        raise ValueError(f"Got invalid type identifier '{name}'")
    return TYPES[name]


def parse_remappings(entity: Entity, parser: Parser) -> list[tuple[Any, Any]] | None:
    """Parse the `remap` elements."""
    elements = entity.get_attr("remap", data_type=list, optional=True)
    if elements is None:
        return None
    rules = [
        (parser.parse_substitution(each.get_attr("from")), parser.parse_substitution(each.get_attr("to")))
        for each in elements
    ]
    for each in elements:
        each.assert_entity_completely_parsed()
    return rules
