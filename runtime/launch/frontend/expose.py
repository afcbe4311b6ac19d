"""Names of actions and substitutions in XML and YAML."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, TypeVar

T = TypeVar("T", bound=Callable[..., Any])

action_parse_methods: dict[str, Callable[..., Any]] = {}
substitution_parse_methods: dict[str, Callable[..., Any]] = {}


def expose_action(name: str) -> Callable[[T], T]:
    """Register a class as the action with this name; its `parse(entity, parser)` returns class and keyword arguments.

    A function is registered as the parse method itself. Raises `RuntimeError` for anything else, and for a name that
    another class already uses.
    """
    return _exposer(name, action_parse_methods, "action")


def expose_substitution(name: str) -> Callable[[T], T]:
    """Register a class or function as the substitution with this name; `parse(data)` returns class and arguments."""
    return _exposer(name, substitution_parse_methods, "substitution")


def _exposer(name: str, methods: dict[str, Callable[..., Any]], kind: str) -> Callable[[T], T]:
    def expose(exposed: T) -> T:
        parse = _parse_method(exposed)
        if parse is None:
            raise RuntimeError(
                f"Exposed {kind} parser for {name} is not a callable or a class containing a parse method"
            )
        if name in methods and not _is_same(methods[name], parse):
            raise RuntimeError(f"Two {kind} parsing methods exposed with the same name: [{name}]")
        methods[name] = parse
        return exposed

    return expose


def _parse_method(exposed: object) -> Callable[..., Any] | None:
    if not inspect.isclass(exposed):
        return exposed if callable(exposed) else None
    parse = getattr(exposed, "parse", None)
    if not callable(parse):
        raise RuntimeError("Did not find a method called 'parse' in the class being decorated.")
    return parse


def _is_same(known: Any, parse: Any) -> bool:
    """Whether two parse methods are the same, even if one was loaded again from the same place."""
    return known is parse or (known.__module__, known.__qualname__) == (parse.__module__, parse.__qualname__)
