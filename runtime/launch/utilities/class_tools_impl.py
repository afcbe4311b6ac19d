"""Type checks for objects."""

from __future__ import annotations

import inspect


def isclassinstance(obj: object) -> bool:
    """Whether an object is neither a class nor a function."""
    return not inspect.isclass(obj) and not inspect.isroutine(obj)


def is_a(obj: object, entity_type: type) -> bool:
    """Whether an object is an instance of a class."""
    return isinstance(obj, entity_type)


def is_a_subclass(obj: object, entity_type: type) -> bool:
    """Whether an object is an instance of a class, or is a subclass of it."""
    return isinstance(obj, entity_type) or (inspect.isclass(obj) and issubclass(obj, entity_type))
