"""Typed values from texts and substitutions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from launch.substitution import Substitution
from launch.utilities.data_types import extract_type, is_instance_of, is_typing_list
from launch.utilities.normalize_to_list_of_substitutions_impl import normalize_to_list_of_substitutions
from launch.utilities.perform_substitutions_impl import perform_substitutions

ScalarValueType = int | float | bool | str
ListValueType = list[int] | list[float] | list[bool] | list[str]
AllowedValueType = ScalarValueType | ListValueType
ScalarTypesTuple = (int, float, bool, str)
AllowedTypesTuple = (*ScalarTypesTuple, list[int], list[float], list[bool], list[str])
AllowedTypesType = Any
StrSomeValueType = Any
SomeValueType = Any
NormalizedValueType = Any

__all__ = [
    "AllowedTypesTuple",
    "AllowedTypesType",
    "AllowedValueType",
    "ListValueType",
    "NormalizedValueType",
    "ScalarTypesTuple",
    "ScalarValueType",
    "SomeValueType",
    "StrSomeValueType",
    "coerce_list",
    "coerce_to_type",
    "extract_type",
    "get_typed_value",
    "is_instance_of",
    "is_instance_of_valid_type",
    "is_normalized_substitution",
    "is_substitution",
    "is_typing_list",
    "is_valid_scalar_type",
    "normalize_typed_substitution",
    "perform_typed_substitution",
]


def coerce_to_type(value: str, data_type: Any = None, *, can_be_str: bool = True) -> Any:
    """A scalar or list from a text; raises `ValueError` or `TypeError` where the text is none of the type."""
    if data_type is None:
        return _any_from(value)
    scalar, is_list = extract_type(data_type)
    if is_list:
        return _list_from(value, scalar)
    if scalar is str:
        return value
    if scalar is bool:
        return _bool_from(value)
    return scalar(value)


def coerce_list(value: Iterable[str], data_type: Any = None, *, can_be_str: bool = False) -> list[Any]:
    """A list from texts."""
    found = [coerce_to_type(each, data_type, can_be_str=can_be_str) for each in value]
    if not is_instance_of(found, None):
        raise ValueError("The result is a non-uniform list")
    return found


def get_typed_value(value: Any, data_type: Any, *, can_be_str: bool = True) -> Any:
    """A value of a type from a text or a list of texts; raises `ValueError`."""
    if isinstance(value, list):
        if data_type is None:
            return coerce_list(value)
        scalar, is_list = extract_type(data_type)
        if not is_list:
            raise TypeError(f"Cannot convert input '{value}' of type '{type(value)}' to '{data_type}'")
        return coerce_list(value, scalar, can_be_str=can_be_str)
    return coerce_to_type(value, data_type, can_be_str=can_be_str)


def _bool_from(value: str) -> bool:
    found = {"1": True, "0": False}.get(value, _yaml(value))
    if not isinstance(found, bool):
        raise ValueError(f"Cannot convert value '{value}' to '{bool}'")
    return found


def _list_from(value: str, scalar: Any) -> list[Any]:
    found = _yaml(value)
    if not isinstance(found, list):
        raise ValueError(f"Cannot convert value '{value}' to a list")
    if not is_instance_of(found, None if scalar is None else list[scalar]):
        raise ValueError(f"Cannot convert value '{value}' to a list of '{scalar}', got {found}")
    return found


def _any_from(value: str) -> Any:
    found = _yaml(value)
    if is_instance_of(found, None):
        return found
    if isinstance(found, list):
        raise ValueError("The result is a non-uniform list")
    raise TypeError(f"'{value}' is neither a scalar nor a list")


def _yaml(value: str) -> Any:
    import yaml

    try:
        return yaml.safe_load(value)
    except yaml.YAMLError:
        return value


def is_instance_of_valid_type(value: Any, *, can_be_str: bool = False) -> bool:
    """Whether a value is of any type that values in launch files may have."""
    return is_instance_of(value, None, can_be_str=can_be_str)


def is_valid_scalar_type(data_type: Any) -> bool:
    """Whether a type is one that a single value may have."""
    return data_type in ScalarTypesTuple


def is_substitution(value: Any) -> bool:
    """Whether something is a substitution, or an iterable with at least one and otherwise texts."""
    if isinstance(value, Substitution):
        return True
    if isinstance(value, str) or not isinstance(value, Iterable):
        return False
    items = list(value)
    return any(isinstance(each, Substitution) for each in items) and all(
        isinstance(each, (str, Substitution)) for each in items
    )


def is_normalized_substitution(value: Any) -> bool:
    """Whether something is a list of substitutions."""
    return isinstance(value, list) and bool(value) and all(isinstance(each, Substitution) for each in value)


def normalize_typed_substitution(value: Any, data_type: Any = None) -> Any:
    """A value as it is, or a list of substitutions, or a list of either; raises `TypeError` for the wrong type."""
    if isinstance(value, (list, tuple)) and not is_substitution(value):
        return [normalize_typed_substitution(each, None) for each in value]
    if is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if not is_instance_of(value, data_type):
        raise TypeError(f"value='{value}' is not an instance of {data_type}")
    return value


def perform_typed_substitution(context: Any, value: Any, data_type: Any = None) -> Any:
    """The value of what `normalize_typed_substitution` gave; raises `ValueError` for a text not of the type."""
    if is_normalized_substitution(value):
        return get_typed_value(perform_substitutions(context, value), data_type)
    if isinstance(value, list):
        scalar = None if data_type is None else extract_type(data_type)[0]
        found = [perform_typed_substitution(context, each, scalar) for each in value]
        if not is_instance_of(found, data_type):
            raise ValueError(f"Cannot convert value '{value}' to '{data_type}'")
        return found
    return value
