"""Parameters and remap rules in XML and YAML."""

# ruff: noqa: UP006, UP035 (messages show the names of these types)
from __future__ import annotations

from typing import Any, List

from launch.substitutions import TextSubstitution
from launch_ros.descriptions.parameter_file import ParameterFile
from launch_ros.descriptions.parameter_value import ParameterValue

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


def parse_nested_parameters(params: Any, parser: Any) -> list[Any]:
    """Each `param` element as a dict, or as a `ParameterFile`."""
    return [_parameter(each, parser) for each in params]


def _parameter(entity: Any, parser: Any) -> Any:
    source = entity.get_attr("from", optional=True)
    name = entity.get_attr("name", optional=True)
    if source is not None and name is not None:
        raise RuntimeError("name and from attributes are mutually exclusive")
    if source is not None:
        substitute = entity.get_attr("allow_substs", data_type=bool, optional=True)
        file = ParameterFile(
            parser.parse_substitution(source),
            allow_substs=False if substitute is None else parser.parse_if_substitutions(substitute),
        )
        entity.assert_entity_completely_parsed()
        return file
    if name is None:
        raise RuntimeError("param Entity should have name or from attribute")
    return _named(entity, parser)


def _named(entity: Any, parser: Any) -> dict[Any, Any]:
    name = tuple(parser.parse_substitution(entity.get_attr("name")))
    kind_name = entity.get_attr("type", optional=True)
    nested = entity.get_attr("param", data_type=list, optional=True)
    value = entity.get_attr("value", data_type=_kind(kind_name), optional=True)
    if value is not None and nested:
        raise RuntimeError("nested parameters and value attributes are mutually exclusive")
    if value is not None:
        result = _value(value, kind_name, parser)
        entity.assert_entity_completely_parsed()
        return {name: result}
    if not nested:
        raise RuntimeError("either a value attribute or nested params are needed")
    found: dict[Any, Any] = {}
    for each in nested:
        found.update(_named(each, parser))
    entity.assert_entity_completely_parsed()
    return {name: found}


def _value(value: Any, kind_name: str | None, parser: Any) -> Any:
    """A literal, or substitutions; typed where a type is named."""
    literal = _literal(value, parser)
    return literal if kind_name is None else ParameterValue(literal, value_type=_kind(kind_name))


def _literal(value: Any, parser: Any) -> Any:
    """A text without substitutions stays a text, whatever it looks like."""
    if isinstance(value, list):
        return [_literal(each, parser) for each in value]
    if not isinstance(value, str):
        return value
    pieces = parser.parse_substitution(value)
    if all(isinstance(each, TextSubstitution) for each in pieces):
        return "".join(each.text for each in pieces)
    return pieces


def _kind(name: str | None) -> Any:
    if name is None:
        return None
    if name not in TYPES:
        raise ValueError(f"Got invalid type identifier '{name}'")
    return TYPES[name]


def parse_remappings(entity: Any, parser: Any) -> list[tuple[Any, Any]] | None:
    """The `remap` elements."""
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
