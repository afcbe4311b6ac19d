"""YAML values in the arguments of verbs."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Generator
from typing import IO, Any, cast

MAX_BITS = 14_000
"""The maximum size of an integer, as Python prints no more than 4,300 digits and no field holds more than 64 bits."""


def read_values(source: str | IO[str]) -> Any:
    """Parse the values; raises `YAMLError`, and `RuntimeError` as `report_yaml_errors` does."""
    if source == "{}":  # the text of most calls without values; importing the library takes a fifth of a verb's time
        return {}
    import yaml

    with report_yaml_errors():
        found = yaml.safe_load(source)
        _refuse_endless(found, set())
        return found


@contextlib.contextmanager
def report_yaml_errors() -> Generator[None]:
    """Guard code that reads YAML: a `YAMLError` passes unchanged, as ROS 2 also shows it.

    The other exceptions that the library lets escape become `RuntimeError`s, which a command prints on one line.
    """
    try:
        yield
        return
    except (ValueError, TypeError, AttributeError, LookupError, OverflowError):
        why = "a tag has a value that it does not allow, or a number is endless"
    except RecursionError:
        why = "it is nested too deeply"
    raise RuntimeError(f"The passed value is not valid YAML: {why}")


def fill_message(message: Any, values: Any, **options: bool) -> list[Callable[[Any], None]]:
    """Set the fields of a message, as `set_message_fields` does, and check that it can be sent.

    Raises any exception about a value.
    """
    from rclpy.serialization import serialize_message
    from rosidl_runtime_py import set_message_fields

    stamps = set_message_fields(message, values, **options)
    try:
        serialize_message(message)  # a number out of range, or a list of the wrong length, shows only now
    except TypeError as error:
        raise TypeError(str(error)) from None  # `action` prints its repr
    return stamps or []


def _refuse_endless(value: object, seen: set[int]) -> None:
    """Raise `OverflowError` for integers too long to print; an alias is visited once, as it may contain itself."""
    if isinstance(value, int):
        if value.bit_length() > MAX_BITS:
            raise OverflowError("endless number")
    elif isinstance(value, (list, dict)) and id(cast(object, value)) not in seen:
        seen.add(id(cast(object, value)))
        for each in cast("dict[Any, Any]", value).items() if isinstance(value, dict) else cast("list[Any]", value):
            for part in cast("tuple[object, ...]", each) if isinstance(each, tuple) else (each,):
                _refuse_endless(part, seen)
