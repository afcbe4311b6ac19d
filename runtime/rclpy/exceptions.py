"""Exceptions that rclpy raises; words as Jazzy's."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy._rclpy_pybind11 import InvalidHandle as InvalidHandle
from rclpy.impl.reexports import reexporting


class NotInitializedException(Exception):
    """Something needs `rclpy.init`, which has not been called."""

    def __init__(self, *args: Any) -> None:
        more = f" msg:{args[0]}" if args else ""
        Exception.__init__(self, f"rclpy.init() has not been called.{more}")


class NoTypeSupportImportedException(Exception):
    """A message class has no type support."""

    def __init__(self, *args: Any) -> None:
        Exception.__init__(self, "no type_support imported", *args)


class ROSInterruptException(Exception):
    """A wait ended because of a shutdown."""

    def __init__(self, *args: Any) -> None:
        Exception.__init__(self, "rclpy.shutdown() has been called", *args)


class NameValidationException(Exception):
    """A name is not valid; shows the name with a caret under the place."""

    def __init__(self, name_type: str, name: str, error_msg: str, invalid_index: int, *args: Any) -> None:
        caret = " " * (invalid_index + 3)
        Exception.__init__(self, f"Invalid {name_type}: {error_msg}:\n  '{name}'\n{caret}^", *args)
        self.name_type = name_type
        self.name = name
        self.error_msg = error_msg
        self.invalid_index = invalid_index


class InvalidNamespaceException(NameValidationException):
    """A namespace is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None:
        NameValidationException.__init__(self, "namespace", name, error_msg, invalid_index, *args)


class InvalidNodeNameException(NameValidationException):
    """A node name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None:
        NameValidationException.__init__(self, "node name", name, error_msg, invalid_index, *args)


class InvalidTopicNameException(NameValidationException):
    """A topic name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None:
        NameValidationException.__init__(self, "topic name", name, error_msg, invalid_index, *args)


class InvalidServiceNameException(NameValidationException):
    """A service name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None:
        NameValidationException.__init__(self, "service name", name, error_msg, invalid_index, *args)


class ParameterException(Exception):
    """Something is wrong with one parameter or several; the names stand at the end of the message."""

    def __init__(self, error_msg: str, parameters: str | Sequence[str], *args: Any) -> None:
        Exception.__init__(self, f"{error_msg}: {parameters}", *args)


class ParameterNotDeclaredException(ParameterException):
    """A parameter was used that nobody declared."""

    def __init__(self, parameters: str | Sequence[str], *args: Any) -> None:
        ParameterException.__init__(self, "Invalid access to undeclared parameter(s)", parameters, *args)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter was declared a second time."""

    def __init__(self, parameters: str | Sequence[str], *args: Any) -> None:
        ParameterException.__init__(self, "Parameter(s) already declared", parameters, *args)


class InvalidParameterException(ParameterException):
    """A parameter name is not valid."""

    def __init__(self, parameter: Any, *args: Any) -> None:
        ParameterException.__init__(self, "Invalid parameter name", parameter, *args)


class InvalidParameterTypeException(ParameterException):
    """A parameter got a value of another type than its own."""

    def __init__(self, parameter: Any, expected_type: str, *args: Any) -> None:
        ParameterException.__init__(
            self,
            f"Trying to set parameter '{parameter.name}' to '{parameter.value}' of type '{parameter.type_.name}', "
            f"expecting type '{expected_type}'",
            parameter.name,
            *args,
        )
        self.param = parameter


class InvalidParameterValueException(ParameterException):
    """A parameter got a value that its range or a callback refuses."""

    def __init__(self, parameter: str, value: Any, reason: str, *args: Any) -> None:
        ParameterException.__init__(
            self, f"Invalid parameter value ({value}) for parameter. Reason: {reason}", parameter, *args
        )


class ParameterImmutableException(ParameterException):
    """A read-only parameter was to be changed or removed."""

    def __init__(self, parameter: str | Sequence[str], *args: Any) -> None:
        ParameterException.__init__(self, "Attempted to modify read-only parameter", parameter, *args)


class ParameterUninitializedException(ParameterException):
    """A parameter was read that was declared without a value."""

    def __init__(self, parameter: str, *args: Any) -> None:
        ParameterException.__init__(self, f"The parameter '{parameter}' is not initialized", parameter, *args)


__getattr__ = reexporting(__name__, "")
