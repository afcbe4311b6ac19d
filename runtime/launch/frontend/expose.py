"""Names of actions and substitutions in XML and YAML."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

T = TypeVar("T")

action_parse_methods: dict[str, Callable[..., Any]] = {}
substitution_parse_methods: dict[str, Callable[..., Any]] = {}


def expose_action(name: str) -> Callable[[type[T]], type[T]]:
    """Let a class be an action of this name; its `parse(entity, parser)` gives class and keyword arguments."""
    return _exposer(name, action_parse_methods)


def expose_substitution(name: str) -> Callable[[type[T]], type[T]]:
    """Let a class be a substitution of this name; its `parse(data)` gives class and keyword arguments."""
    return _exposer(name, substitution_parse_methods)


def _exposer(name: str, methods: dict[str, Callable[..., Any]]) -> Callable[[type[T]], type[T]]:
    def expose(exposed: type[T]) -> type[T]:
        parse: Any = getattr(exposed, "parse", None)
        if parse is None:
            raise RuntimeError(f"Did not find a parse method in class {exposed.__name__}")
        methods[name] = parse
        return exposed

    return expose
