"""A module attribute with a value per node process, as a property of the module's class."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

from ..node.thread_state import local


def process_variable(name: str, of_process: Callable[[Any], Any]) -> property:
    """Return a property: in the real process it is the module's own variable, in a node process a value of its own.

    That is the value that the node process has set, or `of_process(process)`.
    """

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


class _EqualsModuleType(type):
    """Metaclass that makes a class with one module's properties equal to `ModuleType` for users of `type(module)`.

    The interpreter itself creates modules by `type(sys)(name)`: with these properties, new modules would share that
    module's variables.
    """

    def __new__(cls, name: str, bases: tuple[type, ...], members: dict[str, Any], **options: Any) -> Any:
        if any(type(base) is _EqualsModuleType and base is not VirtualModule for base in bases):
            bases = tuple(ModuleType if isinstance(base, _EqualsModuleType) else base for base in bases)
            return type(name, bases, members, **options)
        return super().__new__(cls, name, bases, members, **options)

    def __call__(cls, *arguments: Any, **options: Any) -> ModuleType:
        return ModuleType(*arguments, **options)

    def __instancecheck__(cls, instance: object) -> bool:
        return isinstance(instance, ModuleType)

    def __subclasscheck__(cls, subclass: type) -> bool:
        return issubclass(subclass, ModuleType)


class VirtualModule(ModuleType, metaclass=_EqualsModuleType):
    """Base class of modules with such properties; no other module is an instance."""


def replace_class(module: Any, virtual: type[VirtualModule]) -> Callable[[], None]:
    """Give a module a class with such properties; returns a function that undoes it."""
    before = module.__class__
    module.__class__ = virtual

    def undo() -> None:
        module.__class__ = before

    return undo
