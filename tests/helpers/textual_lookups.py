"""What Textual looks up again for each of the hundreds of apps of a run, or for each message, is looked up once.

A tenth of a test of the screen is spent on it. The answers are those of Textual.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from types import FunctionType
from typing import Any
from unittest.mock import patch
from weakref import WeakKeyDictionary

from textual import _callback
from textual import dom as dom_module
from textual.css.stylesheet import Stylesheet
from textual.message import Message
from textual.message_pump import MessagePump
from textual.reactive import Reactive


@contextmanager
def looked_up_once() -> Iterator[None]:
    """Within this block: the rules of style sheets and the source files of classes are found once per process.

    The parameters of a callback and the handlers of a message are those of their classes, and a reactive attribute that
    is not computed is read from where its value is.
    """
    _forget()  # a test may have put other handlers in their place
    with (
        patch.object(dom_module, "getfile", _file_of_class),
        patch.object(_callback, "_count_parameters", _number_of_parameters),
        patch.object(MessagePump, "_get_dispatch_methods", _bound_handlers),
        patch.object(type(MessagePump), "__setattr__", _set_attribute),
        patch.object(type(MessagePump), "__delattr__", _delete_attribute),
        patch.object(Reactive, "__get__", _value),
        patch.object(Stylesheet, "_parse_rules", _parsed_once),
    ):
        yield


_file_of_class = cache(inspect.getfile)
_count_parameters = _callback._count_parameters


def _number_of_parameters(call: Callable[..., Any]) -> int:
    """The number of parameters in its signature; for a plain function its code has the number."""
    plain = getattr(call, "__func__", call)
    if type(plain) is not FunctionType or hasattr(plain, "__wrapped__") or hasattr(plain, "__signature__"):
        return _count_parameters(call)
    code = plain.__code__
    stars = bool(code.co_flags & inspect.CO_VARARGS) + bool(code.co_flags & inspect.CO_VARKEYWORDS)
    own = plain is not call and code.co_argcount > 0
    return code.co_argcount + code.co_kwonlyargcount + stars - own


@cache
def _handlers(pump: type, name: str, message: type[Message]) -> tuple[tuple[type, Any], ...] | None:
    """Handlers of a message in the classes of a widget; None if `@on` may choose one, which depends on the message."""
    found = []
    for each in pump.__mro__:
        if any(issubclass(message, kind) for kind in each.__dict__.get("_decorated_handlers", ())):
            return None
        method = each.__dict__.get(f"_{name}") or each.__dict__.get(name)
        if method is not None and not getattr(method, "_textual_on", None):
            found.append((each, method))
    return tuple(found)


def _forget() -> None:
    _handlers.cache_clear()
    _is_computed.cache_clear()


def _set_attribute(cls: type, name: str, value: Any) -> None:
    """What a test puts into a class of widgets while the app runs is found from then on."""
    type.__setattr__(cls, name, value)
    _forget()


def _delete_attribute(cls: type, name: str) -> None:
    type.__delattr__(cls, name)
    _forget()


_get_dispatch_methods = MessagePump._get_dispatch_methods


def _bound_handlers(pump: MessagePump, name: str, message: Message) -> Iterator[tuple[type, Callable[..., Any]]]:
    handlers = _handlers(type(pump), name, type(message))
    if handlers is None:
        yield from _get_dispatch_methods(pump, name, message)
        return
    for each, method in handlers:
        if message._no_default_action:
            break
        yield each, method.__get__(pump, each)


_is_computed = cache(hasattr)
_get = Reactive.__get__


def _value(reactive: Reactive[Any], node: Any, kind: type) -> Any:
    if node is not None and not _is_computed(type(node), reactive.compute_name):
        value = node.__dict__.get(reactive.internal_name, _get)
        if value is not _get:
            return value
    return _get(reactive, node, kind)


_parsed: dict[object, Any] = {}
_colours: WeakKeyDictionary[Stylesheet, tuple[dict[str, str], int]] = WeakKeyDictionary()
_numbers: dict[object, int] = {}
_parse_rules = Stylesheet._parse_rules


def _parsed_once(sheet: Stylesheet, css: str, *where: Any, **how: Any) -> Any:
    asked = (css, *where, *how.items(), _number_of_colours(sheet))
    if asked not in _parsed:
        _parsed[asked] = _parse_rules(sheet, css, *where, **how)
    return _parsed[asked]


def _number_of_colours(sheet: Stylesheet) -> int:
    """The same for sheets with the same variables: there are hundreds of them, and two hundred texts are parsed with
    them.
    """
    known = _colours.get(sheet)
    if known is None or known[0] is not sheet._variables:
        number = _numbers.setdefault(tuple(sorted(sheet._variables.items())), len(_numbers))
        known = _colours[sheet] = sheet._variables, number
    return known[1]
