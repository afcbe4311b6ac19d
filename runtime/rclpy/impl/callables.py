"""Classifies a callback and counts its arguments as `inspect` does.

Plain functions and methods are examined directly: importing `inspect` takes a tenth of a short program's time.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from types import CoroutineType, FunctionType, MethodType
from typing import TypeGuard

VARARGS = 0x04
"""The flag `inspect.CO_VARARGS`."""
COROUTINE = 0x80
"""The flag `inspect.CO_COROUTINE`."""


def is_coroutine(value: object) -> TypeGuard[CoroutineType[object, None, object]]:
    """Whether a value was returned by an `async def` function."""
    return isinstance(value, CoroutineType)


def is_coroutine_function(callback: object) -> TypeGuard[Callable[..., Coroutine[object, None, object]]]:
    """Whether a callback is an `async def` function, or is marked to count as one."""
    function = _plain(callback)
    if function is not None:
        return bool(function.__code__.co_flags & COROUTINE)
    import inspect

    return inspect.iscoroutinefunction(callback)


def accepts_arguments(callback: Callable[..., object], count: int) -> bool:
    """Whether a callback can be called with `count` positional arguments; raises `ValueError` if that is unknown."""
    function = _plain(callback)
    if function is not None:
        return _function_takes(function, count + isinstance(callback, MethodType))
    import inspect

    try:
        inspect.signature(callback).bind(*range(count))
    except TypeError:
        return False
    return True


def _plain(callback: object) -> FunctionType | None:
    """Return the function behind a function or method; None if attributes may affect `inspect` or `self` is missing."""
    is_method = isinstance(callback, MethodType)
    function = callback.__func__ if is_method else callback
    if type(function) is not FunctionType or function.__dict__ or (is_method and not function.__code__.co_argcount):
        return None
    return function


def _function_takes(function: FunctionType, count: int) -> bool:
    code = function.__code__
    keywords = code.co_varnames[code.co_argcount : code.co_argcount + code.co_kwonlyargcount]
    if not {*keywords} <= {*(function.__kwdefaults__ or ())}:
        return False
    needed = code.co_argcount - len(function.__defaults__ or ())
    return needed <= count and (count <= code.co_argcount or bool(code.co_flags & VARARGS))
