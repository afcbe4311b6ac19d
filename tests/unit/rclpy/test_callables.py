"""Callbacks are classified, and their arguments counted, as by `inspect`."""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Callable
from types import MethodType
from typing import Any

import pytest
from rclpy.impl.callables import accepts_arguments, is_coroutine, is_coroutine_function


class Methods:
    def one(self, a: Any) -> None: ...
    def two(self, a: Any, b: Any) -> None: ...
    def many(*everything: Any) -> None: ...
    def named(self, *, a: Any) -> None: ...

    async def later(self, a: Any) -> None: ...

    @classmethod
    def of_class(cls, a: Any) -> None: ...

    @staticmethod
    def static(a: Any, b: Any = 1) -> None: ...

    def __call__(self, a: Any, b: Any) -> None: ...


class Later:
    async def __call__(self, a: Any) -> None: ...


async def later(a: Any, b: Any = None) -> None: ...


def wrapped(a: Any, b: Any) -> None: ...


@functools.wraps(wrapped)
def wrapping(*everything: Any, **more: Any) -> None: ...


def signed(*everything: Any) -> None: ...


signed.__signature__ = inspect.signature(wrapped)  # type: ignore[attr-defined]

CALLBACKS: dict[str, Callable[..., Any]] = {
    "no argument": lambda: None,
    "one": lambda a: None,
    "two": lambda a, b: None,
    "three": lambda a, b, c: None,
    "a default": lambda a, b=1: None,
    "only defaults": lambda a=1, b=2, c=3: None,
    "any number": lambda *a: None,
    "one and more": lambda a, *b: None,
    "keywords": lambda a, **b: None,
    "a needed keyword": lambda a, *, b: None,
    "a keyword with a default": lambda a, *, b=1: None,
    "two keywords, one needed": lambda a, *, b=1, c: None,
    "positions only": eval("lambda a, b, /: None"),
    "method": Methods().one,
    "method of two": Methods().two,
    "method of any number": Methods().many,
    "method with a keyword": Methods().named,
    "class method": Methods.of_class,
    "static method": Methods.static,
    "object": Methods(),
    "async object": Later(),
    "async function": later,
    "async method": Methods().later,
    "partial": functools.partial(wrapped, 1),
    "async partial": functools.partial(later, 1),
    "builtin": [].append,
    "class": Methods,
    "wrapped": wrapping,
    "signed": signed,
    "method of a builtin": MethodType(divmod, 1),  # its signature is known to every supported Python
}


def by_inspect(callback: Callable[..., Any], count: int) -> bool:
    try:
        inspect.signature(callback).bind(*range(count))
    except TypeError:
        return False
    return True


@pytest.mark.parametrize("name", CALLBACKS)
def test_callback_is_classified_as_by_inspect(name: str) -> None:
    callback = CALLBACKS[name]
    assert [accepts_arguments(callback, count) for count in range(4)] == [
        by_inspect(callback, count) for count in range(4)
    ]
    assert is_coroutine_function(callback) == inspect.iscoroutinefunction(callback)


def test_callables_without_signature_raise_value_error() -> None:
    def no_self() -> None: ...

    for callback in (MethodType(no_self, 1), dict):  # type: ignore[arg-type]
        with pytest.raises(ValueError, match="signature"):
            inspect.signature(callback)
        with pytest.raises(ValueError, match="signature"):
            accepts_arguments(callback, 1)
    assert not accepts_arguments(3, 1)  # type: ignore[arg-type]


@pytest.mark.skipif(sys.version_info < (3, 12), reason="new in Python 3.12")
def test_function_marked_as_coroutine_function_is_recognized() -> None:
    marked = inspect.markcoroutinefunction(lambda: None)  # type: ignore[attr-defined]
    assert is_coroutine_function(marked)


def test_coroutine_object_is_recognized() -> None:
    coroutine = later(1)
    assert is_coroutine(coroutine)
    assert not is_coroutine(later)
    coroutine.close()
