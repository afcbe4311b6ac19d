"""Decorators for test cases and test descriptions."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

PARAMETERS = "__parametrized__"
POST_SHUTDOWN = "__post_shutdown_test__"
READY_TIMEOUT = "__ready_to_test_action_timeout__"
_Description = TypeVar("_Description")


def post_shutdown_test() -> Callable[[type[Any]], type[Any]]:
    """Mark a class whose tests run after all processes have ended."""

    def mark(test_item: type[Any]) -> type[Any]:
        if not isinstance(test_item, type):
            raise TypeError("postcondition_test should decorate classes")
        setattr(test_item, POST_SHUTDOWN, True)
        return test_item

    return mark


def ready_to_test_action_timeout(timeout: float) -> Callable[[_Description], _Description]:
    """Give the `ReadyToTest` of a test description this time-out (s) instead of 15."""

    def mark(description: _Description) -> _Description:
        setattr(description, READY_TIMEOUT, timeout)
        return description

    return mark


def parametrize(argnames: str | Iterable[str], argvalues: Iterable[Any]) -> Callable[[Any], Any]:
    """Create and test a test description once for each set of values: a tuple, or a single value."""
    names = [each.strip() for each in argnames.split(",")] if isinstance(argnames, str) else list(argnames)

    def rows() -> Iterator[dict[str, Any]]:
        for value in argvalues:
            yield dict(zip(names, value if isinstance(value, tuple) else (value,), strict=True))

    def decorate(function: Any) -> Any:
        @functools.wraps(function)
        def described(*args: Any, **kwargs: Any) -> Any:
            return function(*args, **kwargs)

        def made_with(row: dict[str, Any]) -> Any:
            return functools.update_wrapper(functools.partial(function, **row), function)  # keeps the function's marks

        setattr(described, PARAMETERS, lambda: [(made_with(row), row) for row in rows()])
        return described

    return decorate
