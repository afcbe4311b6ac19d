"""Type checks of constructor arguments."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any


def ensure_argument_type(argument: object, types: object, argument_name: str, caller: str | None = None) -> None:
    """Raise `TypeError` unless an argument has one of the types."""
    expected: list[Any] = [*types] if isinstance(types, Iterable) else [types]
    if not all(isinstance(each, type) for each in expected):
        raise TypeError(f"'types' should be a type or a list of types, but got '{types}'")
    if isinstance(argument, tuple(expected)):
        return
    who = f"'{caller}' expected '{argument_name}' to be" if caller else f"Expected '{argument_name}' to be"
    raise TypeError(f"{who} one of {expected}, but got '{argument}' of type '{type(argument)}'")
