"""A variable of a module that each node process has for itself: a property of the module's class."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

from .thread_state import local


def process_variable(name: str, of_process: Callable[[Any], Any]) -> property:
    """The module's own variable for the real process; for a node process what it set, else `of_process(process)`."""

    def get(module: ModuleType) -> Any:
        process = local.process
        if process.main_state is None:
            return module.__dict__[name]
        key = (module.__name__, name)
        return process.overrides[key] if key in process.overrides else of_process(process)

    def set_(module: ModuleType, value: Any) -> None:
        process = local.process
        if process.main_state is None:
            module.__dict__[name] = value
        else:
            process.overrides[module.__name__, name] = value

    return property(get, set_)


def replace_class(module: Any, virtual: type[ModuleType]) -> Callable[[], None]:
    """Give a module a class with such properties; returns what undoes it."""
    before = module.__class__
    module.__class__ = virtual

    def undo() -> None:
        module.__class__ = before

    return undo
