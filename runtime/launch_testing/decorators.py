"""What marks test cases and test descriptions."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Iterator
from typing import Any

PARAMETERS = "__parametrized__"
POST_SHUTDOWN = "__post_shutdown_test__"


def post_shutdown_test() -> Callable[[type[Any]], type[Any]]:
    """A class whose tests run when all processes have ended."""

    def mark(test_item: type[Any]) -> type[Any]:
        if not isinstance(test_item, type):
            raise TypeError("postcondition_test should decorate classes")
        setattr(test_item, POST_SHUTDOWN, True)
        return test_item

    return mark


def parametrize(argnames: str | Iterable[str], argvalues: Iterable[Any]) -> Callable[[Any], Any]:
    """A test description that is made, and tested, once for each row of values."""
    names = [each.strip() for each in argnames.split(",")] if isinstance(argnames, str) else list(argnames)

    def rows() -> Iterator[dict[str, Any]]:
        for value in argvalues:
            values = value if isinstance(value, list | tuple) else (value,)
            yield dict(zip(names, values, strict=True))

    def decorate(function: Any) -> Any:
        @functools.wraps(function)
        def described(*args: Any, **kwargs: Any) -> Any:
            return function(*args, **kwargs)

        setattr(described, PARAMETERS, lambda: [(functools.partial(function, **row), row) for row in rows()])
        return described

    return decorate
