"""The exceptions that rclpy raises, with Jazzy's messages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy._rclpy_pybind11 import InvalidHandle as InvalidHandle
from rclpy.impl.reexports import reexporting


class NotInitializedException(Exception):
    """Something needs `rclpy.init`, which has not been called."""

    def __init__(self, *args: object) -> None:
        more = f" msg:{args[0]}" if args else ""
        Exception.__init__(self, f"rclpy.init() has not been called.{more}")


class NoTypeSupportImportedException(Exception):
    """A message class has no type support."""

    def __init__(self, *args: object) -> None:
        Exception.__init__(self, "no type_support imported", *args)


class ROSInterruptException(Exception):
    """A wait was interrupted by a shutdown."""

    def __init__(self, *args: object) -> None:
        Exception.__init__(self, "rclpy.shutdown() has been called", *args)


class NameValidationException(Exception):
    """A name is invalid; shows the name with a caret below the offending character."""

    def __init__(self, name_type: str, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        caret = " " * (invalid_index + 3)
        Exception.__init__(self, f"Invalid {name_type}: {error_msg}:\n  '{name}'\n{caret}^", *args)
        self.name_type = name_type
        self.name = name
        self.error_msg = error_msg
        self.invalid_index = invalid_index


class InvalidNamespaceException(NameValidationException):
    """A namespace is invalid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        NameValidationException.__init__(self, "namespace", name, error_msg, invalid_index, *args)


class InvalidNodeNameException(NameValidationException):
    """A node name is invalid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        NameValidationException.__init__(self, "node name", name, error_msg, invalid_index, *args)


class InvalidTopicNameException(NameValidationException):
    """A topic name is invalid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        NameValidationException.__init__(self, "topic name", name, error_msg, invalid_index, *args)


class InvalidServiceNameException(NameValidationException):
    """A service name is invalid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        NameValidationException.__init__(self, "service name", name, error_msg, invalid_index, *args)


class ParameterException(Exception):
    """One or several parameters are at fault; the message ends with their names."""

    def __init__(self, error_msg: str, parameters: str | Sequence[str], *args: object) -> None:
        Exception.__init__(self, f"{error_msg}: {parameters}", *args)


class ParameterNotDeclaredException(ParameterException):
    """A parameter was used without being declared."""

    def __init__(self, parameters: str | Sequence[str], *args: object) -> None:
        ParameterException.__init__(self, "Invalid access to undeclared parameter(s)", parameters, *args)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter was declared twice."""

    def __init__(self, parameters: str | Sequence[str], *args: object) -> None:
        ParameterException.__init__(self, "Parameter(s) already declared", parameters, *args)


class InvalidParameterException(ParameterException):
    """A parameter name is invalid."""

    def __init__(self, parameter: Any, *args: object) -> None:
        ParameterException.__init__(self, "Invalid parameter name", parameter, *args)


class InvalidParameterTypeException(ParameterException):
    """A parameter was given a value of another type than its own."""

    def __init__(self, parameter: Any, expected_type: str, *args: object) -> None:
        ParameterException.__init__(
            self,
            f"Trying to set parameter '{parameter.name}' to '{parameter.value}' of type '{parameter.type_.name}', "
            f"expecting type '{expected_type}'",
            parameter.name,
            *args,
        )
        self.param = parameter


class InvalidParameterValueException(ParameterException):
    """A parameter was given a value that its range or a callback rejects."""

    def __init__(self, parameter: str, value: object, reason: str, *args: object) -> None:
        ParameterException.__init__(
            self, f"Invalid parameter value ({value}) for parameter. Reason: {reason}", parameter, *args
        )


class ParameterImmutableException(ParameterException):
    """An attempt to change or remove a read-only parameter."""

    def __init__(self, parameter: str | Sequence[str], *args: object) -> None:
        ParameterException.__init__(self, "Attempted to modify read-only parameter", parameter, *args)


class ParameterUninitializedException(ParameterException):
    """A parameter that was declared without a value was read."""

    def __init__(self, parameter: str, *args: object) -> None:
        ParameterException.__init__(self, f"The parameter '{parameter}' is not initialized", parameter, *args)


__getattr__ = reexporting(__name__, "")
