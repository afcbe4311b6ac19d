"""Types that values in launch files may have: scalars, and lists of one of them."""

from __future__ import annotations

from typing import Any, get_args, get_origin

SCALARS: tuple[type, ...] = (int, float, bool, str)


def is_typing_list(data_type: Any) -> bool:
    """Whether it is `List` or `List[...]`."""
    return data_type is list or get_origin(data_type) is list


def extract_type(data_type: Any) -> tuple[Any, bool]:
    """The scalar type, None for any, and whether it is a list of them; raises `ValueError` for other types."""
    is_list = is_typing_list(data_type)
    scalar = data_type
    if is_list:
        arguments = get_args(data_type)
        scalar = arguments[0] if arguments and isinstance(arguments[0], type) else None
    if scalar is not None and scalar not in SCALARS:
        raise ValueError(f"Unrecognized data type: {data_type}")
    return scalar, is_list


def is_scalar(value: object, scalar: Any, *, can_be_str: bool = False) -> bool:
    """Whether a value is exactly of a scalar type, or of any where the type is None."""
    if can_be_str and isinstance(value, str):
        return True
    return type(value) in SCALARS if scalar is None else type(value) is scalar


def is_instance_of(value: Any, data_type: Any, *, can_be_str: bool = False) -> bool:
    """Whether a value is of a type; an int is no float, and a bool no int."""
    if data_type is None:
        if isinstance(value, list):
            kinds = {type(each) for each in value}
            return len(kinds) <= 1 and all(is_scalar(each, None) for each in value)
        return is_scalar(value, None)
    scalar, is_list = extract_type(data_type)
    if not is_list:
        return is_scalar(value, scalar, can_be_str=can_be_str)
    return isinstance(value, list) and all(is_scalar(each, scalar, can_be_str=can_be_str) for each in value)
