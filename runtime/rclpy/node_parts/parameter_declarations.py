"""Parses and checks the tuples of `Node.declare_parameters`."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

from rclpy.parameter import Parameter
from rclpy.validate_parameter_name import validate_parameter_name

NAME_ONLY = """when declaring parameter named '{}', declaring a parameter only providing its name is deprecated. \
You have to either:
\t- Pass a name and a default value different to "PARAMETER NOT SET" (and optionally a descriptor).
\t- Pass a name and a parameter type.
\t- Pass a name and a descriptor with `dynamic_typing=True"""
STATIC_NOT_SET = "Cannot declare a statically typed parameter with default value of type PARAMETER_NOT_SET"
TYPE_AND_DYNAMIC = (
    "When declaring parameter {{{}}} passing a descriptor with`dynamic_typing=True` "
    "is not allowed when the parameter type is provided"
)


def read_declaration(
    index: int, declaration: Sequence[Any], namespace: str, overrides: Mapping[str, Parameter]
) -> tuple[Parameter, Any]:
    """The parameter, with the value of its override if there is one, and the descriptor that a tuple declares.

    The declared type is written into the descriptor. Raises `TypeError`, `ValueError` and
    `InvalidParameterException`.
    """
    if not 1 <= len(declaration) <= 3:
        raise TypeError(
            f"Invalid parameter tuple length at index {index} in parameters list: {declaration}; "
            "expecting length between 1 and 3"
        )
    name = _full_name(index, declaration[0], namespace)
    descriptor = _descriptor(index, declaration)
    if len(declaration) == 1:
        warnings.warn(NAME_ONLY.format(name), stacklevel=4)
        descriptor.dynamic_typing = True
    default = declaration[1] if len(declaration) > 1 else None
    if isinstance(default, Parameter.Type):
        _set_type(name, default, descriptor)
        value = None
    else:
        _infer_type(default, descriptor)
        value = default
    if name in overrides:
        value = overrides[name].value
    return Parameter(name, value=value), descriptor


def _full_name(index: int, name: Any, namespace: str) -> str:
    if not isinstance(name, str):
        raise TypeError(f"First element {name} at index {index} in parameters list is not a str.")
    name = f"{namespace}.{name}" if namespace else name
    validate_parameter_name(name)
    return name


def _descriptor(index: int, declaration: Sequence[Any]) -> Any:
    from rcl_interfaces.msg import ParameterDescriptor

    if len(declaration) < 3:
        return ParameterDescriptor()
    descriptor = declaration[2]
    if not isinstance(descriptor, ParameterDescriptor):
        raise TypeError(f"Third element {descriptor} at index {index} in parameters list is not a ParameterDescriptor.")
    return descriptor


def _set_type(name: str, wanted: Parameter.Type, descriptor: Any) -> None:
    """Set the descriptor's type to a declared type; raises `ValueError`."""
    if wanted == Parameter.Type.NOT_SET:
        raise ValueError(f"Cannot declare parameter {{{name}}} as statically typed of type NOT_SET")
    if descriptor.dynamic_typing is True:
        raise ValueError(TYPE_AND_DYNAMIC.format(name))
    descriptor.type = wanted.value


def _infer_type(default: Any, descriptor: Any) -> None:
    """Set the descriptor's type to that of a default value, except with dynamic typing; raises `ValueError`."""
    from rcl_interfaces.msg import ParameterValue

    if descriptor.dynamic_typing:
        return
    if isinstance(default, ParameterValue):
        descriptor.type = default.type
    else:
        descriptor.type = Parameter.Type.from_parameter_value(default).value
    if descriptor.type == Parameter.Type.NOT_SET.value:
        raise ValueError(STATIC_NOT_SET)
