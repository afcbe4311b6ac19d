"""The types of values in launch files: scalars, and lists of one scalar type."""

from __future__ import annotations

from typing import Any, cast, get_args, get_origin

SCALARS: tuple[type, ...] = (int, float, bool, str)


def is_typing_list(data_type: object) -> bool:
    """Whether a type is `List` or `List[...]`."""
    return data_type is list or get_origin(data_type) is list


def extract_type(data_type: object) -> tuple[Any, bool]:
    """Return the scalar type, and whether it is a list of that type; raises `ValueError` for other types."""
    scalar, is_list = data_type, False
    arguments = get_args(data_type) if is_typing_list(data_type) else ()
    if arguments:
        scalar, is_list = arguments[0], True
    if scalar not in SCALARS:
        raise ValueError(f"Unrecognized data type: {data_type}")
    return scalar, is_list


def is_instance_of_valid_type(value: object, can_be_str: bool = False) -> bool:
    """Whether a value is a scalar or a list of one type; with `can_be_str` the list may also contain strings."""
    if not isinstance(value, list):
        return isinstance(value, SCALARS)
    items = cast("list[Any]", value)
    kinds: list[type] = [type(each) for each in items]
    kind = next((each for each in kinds if each is not str), str)
    allowed = (kind, str) if can_be_str else (kind,)
    return kind in SCALARS and all(isinstance(each, allowed) for each in items)


def is_instance_of(value: object, data_type: object, can_be_str: bool = False) -> bool:
    """Whether a value has a type; an int is not a float, but a bool is an int. Raises `ValueError` for other types."""
    if data_type is None:
        return is_instance_of_valid_type(value, can_be_str=can_be_str)
    scalar, is_list = extract_type(data_type)
    allowed = (scalar, str) if can_be_str else (scalar,)
    if not is_list:
        return isinstance(value, allowed)
    if not isinstance(value, list):
        return False
    items = cast("list[Any]", value)
    return all(isinstance(each, allowed) for each in items)
