"""Convert texts and substitutions to typed values."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, cast

from launch.substitution import Substitution
from launch.utilities.data_types import (
    extract_type,
    is_instance_of,
    is_instance_of_valid_type,
    is_typing_list,
)
from launch.utilities.ensure_argument_type_impl import ensure_argument_type
from launch.utilities.normalize_to_list_of_substitutions_impl import normalize_to_list_of_substitutions
from launch.utilities.perform_substitutions_impl import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

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


def coerce_to_type(value: str, data_type: Any = None, can_be_str: bool = False) -> Any:
    """Convert a text to a scalar or list; with `can_be_str` it may remain a text.

    Raises `ValueError` for a text that does not have the type, `TypeError` for anything but a text.
    """
    ensure_argument_type(value, str, "value", "coerce_to_type")
    if data_type is None:
        return _parse_yaml(value, f"Failed to convert '{value}' using yaml rules", can_be_str)
    scalar, is_list = extract_type(data_type)
    if is_list:
        return _list_from(value, scalar, can_be_str)
    if scalar is str:
        return value
    if scalar is bool:
        return _bool_from(value, can_be_str)
    try:
        return scalar(value)
    except ValueError:
        if can_be_str:
            return value
        raise


def coerce_list(value: list[str], data_type: Any = None, can_be_str: bool = False) -> list[Any]:
    """Convert texts to a list; raises `ValueError` if their types differ, `TypeError` for anything but a list."""
    ensure_argument_type(value, list, "value", "coerce_list")
    found = [coerce_to_type(each, data_type, can_be_str=can_be_str) for each in value]
    if not is_instance_of_valid_type(found, can_be_str=can_be_str):
        raise ValueError(f"cannot convert value to {data_type}. Got value=`{value}`")
    return found


def get_typed_value(value: Any, data_type: Any, can_be_str: bool = False) -> Any:
    """Convert a text or a list of texts to a type; raises `ValueError`, and `TypeError` for a list as a scalar."""
    if not isinstance(value, list):
        return coerce_to_type(value, data_type, can_be_str=can_be_str)
    texts = cast("list[Any]", value)
    if data_type is None:
        return coerce_list(texts, can_be_str=can_be_str)
    scalar, is_list = extract_type(data_type)
    if not is_list:
        raise TypeError(f"Cannot convert input '{texts}' of type '{list}' to '{scalar}'")
    return coerce_list(texts, scalar, can_be_str=can_be_str)


def _bool_from(value: str, can_be_str: bool) -> bool | str:
    if value in ("0", "1"):
        return value == "1"
    found = _parse_yaml(value, f"Failed to convert '{value}' to '{bool}'", can_be_str)
    if isinstance(found, (bool, str) if can_be_str else bool):
        return found
    raise ValueError(f"Cannot convert value '{value}' to '{bool}'")


def _list_from(value: str, scalar: Any, can_be_str: bool) -> list[Any]:
    wanted = (str, scalar) if can_be_str else scalar
    problem = f"Cannot convert value '{value}' to a list of '{wanted}'"
    found = _parse_yaml(value, problem, can_be_str)
    if not isinstance(found, list):
        raise ValueError(problem)
    items = cast("list[Any]", found)
    if not all(isinstance(each, wanted) for each in items):
        raise ValueError(f"{problem}, got {items}")
    return items


def _parse_yaml(value: str, problem: str, can_be_str: bool) -> Any:
    """Parse a text as YAML; an empty text is returned unchanged, and so is, with `can_be_str`, one that is not YAML."""
    import yaml

    if not value:
        return value
    try:
        found = yaml.safe_load(value)
    except yaml.YAMLError as error:
        if can_be_str:
            return value
        raise ValueError(f"{problem}: yaml.safe_load() failed\n{error}") from error
    if not is_instance_of_valid_type(found, can_be_str=can_be_str):
        raise ValueError(f"{problem}: output type is not allowed, got {type(found)}")
    return found


def is_valid_scalar_type(data_type: Any) -> bool:
    """Whether a type is a scalar type."""
    return data_type in ScalarTypesTuple


def is_substitution(value: Any) -> bool:
    """Whether a value is a substitution, or an iterable of texts with at least one substitution."""
    if isinstance(value, Substitution):
        return True
    if isinstance(value, str) or not isinstance(value, Iterable):
        return False
    items: list[Any] = [*value]
    return any(isinstance(each, Substitution) for each in items) and all(
        isinstance(each, (str, Substitution)) for each in items
    )


def is_normalized_substitution(value: Any) -> bool:
    """Whether a value is a non-empty list of substitutions."""
    if not isinstance(value, list):
        return False
    items = cast("list[Any]", value)
    return bool(items) and all(isinstance(each, Substitution) for each in items)


def normalize_typed_substitution(value: Any, data_type: Any = None) -> Any:
    """Normalize a value: scalars unchanged, substitutions to a list, lists to a list of either; else `TypeError`."""
    if isinstance(value, ScalarTypesTuple):
        if not is_instance_of(value, data_type):
            raise TypeError(f"value='{value}' is not an instance of {data_type}")
        return value
    if is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if not isinstance(value, Iterable):
        raise TypeError(
            "value should be either a scalar, a substitutions, or a mixed list of scalars and substitutions. "
            f"Got `value={value}` of type `{type(value)}`. "
        )
    items: list[Any] = [*value]
    wanted = _type_of_items(value, data_type)
    given = _common_type(value, items)
    if given is not None and wanted not in (None, given):
        raise TypeError(f"Got a list of '{given}', expected a list of '{wanted}'. value='{value}'")
    return [
        normalize_to_list_of_substitutions(each) if is_substitution(each) else (float(each) if given is float else each)
        for each in items
    ]


def _type_of_items(value: Any, data_type: Any) -> Any:
    scalar, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise TypeError(
            "The provided value resolves to a list, though the required type is a scalar. "
            f"Got value='{value}', data_type='{scalar}'."
        )
    return scalar


def _common_type(value: Any, items: list[Any]) -> type | None:
    """Return the items' common type, ignoring substitutions; None if there are only these. Floats may include ints."""
    kinds: set[type] = set()
    for each in items:
        if isinstance(each, ScalarTypesTuple):
            kinds.add(type(each))
        elif not is_substitution(each):
            raise TypeError(
                "value is a list, and one of the items is not a scalar, a Substitution or a list of substitutions. "
                f"Got value='{value}'"
            )
    if not kinds:
        return None if items else str
    for kind in (str, bool, int):
        if kinds == {kind}:
            return kind
    if kinds <= {int, float}:
        return float
    raise TypeError(f"Input value is not an acceptable 'SomeValueType'.Got value='{value}'")


def perform_typed_substitution(context: LaunchContext, value: Any, data_type: Any = None) -> Any:
    """Evaluate the result of `normalize_typed_substitution`; raises `ValueError` if a text does not have the type."""
    if isinstance(value, ScalarTypesTuple):
        if data_type is not None and not is_instance_of(value, data_type):
            raise TypeError(f"value=`{value}` is a scalar and not an instance of `{data_type}`")
        return value
    if is_normalized_substitution(value):
        return coerce_to_type(perform_substitutions(context, value), data_type)
    if not isinstance(value, list):
        raise TypeError(f"Input value is not an acceptable 'NormalizedValueType'.Got value='{value}'")
    scalar, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise ValueError(
            f"The input value is a list, cannot convert it to a scalar. Got value='{value}', expected type {scalar}."
        )
    items = cast("list[Any]", value)
    found = [
        coerce_to_type(perform_substitutions(context, each), scalar) if is_normalized_substitution(each) else each
        for each in items
    ]
    if not is_instance_of(found, data_type):
        expected = f"Got value='{value}', expected type {scalar}."
        raise ValueError(
            "The output list is not uniform"
            if scalar is None
            else f"The output list does not match the expected type {expected}"
        )
    return found
