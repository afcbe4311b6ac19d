"""The base class of all generated classes."""

from __future__ import annotations

import os
import threading
import warnings
from array import array
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, cast

from bot_console.runtime.rosidl.slot_types import SlotTypes

NUMBER_SEQUENCES = ("sequence<float", "sequence<double", "sequence<int", "sequence<uint")

CHECK_VARIABLE = "ROS_PYTHON_CHECK_FIELDS"


class _CheckSetting(threading.local):
    """The environment's setting, per thread because each node process has its own environment; None until it is
    read.
    """

    value: bool | None = None


_asked = _CheckSetting()


def checks_asked_for() -> bool:
    """Whether fields are checked if the constructor gets no argument about it; off by default since Jazzy.

    The environment is read with a thread's first message, and again after a message module was imported, when upstream
    reads it; reading it for each message would take longer than creating the message.
    """
    value = _asked.value
    if value is None:
        value = _asked.value = os.environ.get(CHECK_VARIABLE, "") == "1"
    return value


def read_checks_again() -> None:
    """Read the environment again before this thread's next message."""
    _asked.value = None


class MessageType(type):
    """The class of message classes: as upstream, their constants can neither be set nor deleted."""

    def __setattr__(cls, name: str, value: object) -> None:
        cls._keep_constant(name, "setter")
        super().__setattr__(name, value)

    def __delattr__(cls, name: str) -> None:
        cls._keep_constant(name, "deleter")
        super().__delattr__(name)

    def _keep_constant(cls, name: str, missing: str) -> None:
        if name.isupper() and isinstance(cls.__dict__.get(name), (bool, int, float, str, bytes)):
            raise AttributeError(f"property '{name}' of 'Metaclass_{cls.__name__}' object has no {missing}")


def type_shown(value: object) -> str:
    """Return the class of a value as text; as upstream, a message class has a metaclass of its own."""
    if isinstance(value, MessageType):
        return f"<class '{value.__module__}.Metaclass_{value.__name__}'>"
    return str(type(value))


class Message(metaclass=MessageType):
    """A generated message; its class has `__slots__`, one for each field, and no dictionary."""

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream
    _fields_and_field_types: ClassVar[Mapping[str, str]] = {}
    SLOT_TYPES: ClassVar[SlotTypes] = SlotTypes()
    _check_fields: bool

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return the field names with their types, such as `sequence<double>`."""
        return dict(cls._fields_and_field_types)

    def _check(self, field: str, value: object) -> bool:
        """Reject a value with `AssertionError`, as rclpy does with checks on; return whether it may be kept as it
        is.
        """
        from bot_console.runtime.rosidl.checks import check

        return check(type(self), field, value)

    def _unknown(self, names: Iterable[str]) -> None:
        """Reject unknown keywords with `AssertionError` if checks are on; else ignore them as Jazzy, with a warning."""
        text = ", ".join(sorted(names))
        if self._check_fields:
            raise AssertionError(f"Invalid arguments passed to constructor: {text}")
        warnings.warn(f"{type(self).__name__} has no field named {text}: the value is ignored", stacklevel=3)

    def __repr__(self) -> str:
        name = ".".join([*type(self).__module__.split(".")[:-1], type(self).__name__])
        fields = ", ".join(
            f"{name}={_field_text(getattr(self, name), kind)}" for name, kind in self._fields_and_field_types.items()
        )
        return f"{name}({fields})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return False
        return all(_equal(getattr(self, name), getattr(other, name)) for name in self._fields_and_field_types)


def _field_text(value: Any, kind: str) -> str:
    """Return the text of a field: a sequence of numbers without its type, any other value unchanged."""
    numbers = isinstance(value, array) and kind.startswith(NUMBER_SEQUENCES) and "/" not in kind
    return repr(cast("array[Any]", value).tolist() if numbers else cast("Any", value))


def _equal(one: Any, other: Any) -> bool:
    different = one != other
    # As upstream, fixed-size arrays count as different only if all of their elements differ.
    return not different.all() if hasattr(different, "all") else not different


class ServiceType(type):
    """The type of service and action classes, which only hold other classes; `_later` names those that are imported on
    first use.
    """

    _later: tuple[str, ...] = ()

    def __getattr__(cls, name: str) -> Any:
        """Import a part of a service."""
        if name not in cls._later:
            raise AttributeError(f"type object {cls.__name__!r} has no attribute {name!r}")
        from importlib import import_module

        part = getattr(import_module(f"{cls.__module__}__parts"), f"{cls.__name__}_{name}")
        setattr(cls, name, part)
        return part

    def __dir__(cls) -> list[str]:
        """Include the parts that have not been imported yet."""
        return sorted({*super().__dir__(), *cls._later})

    def __call__(cls, *args: object, **kwargs: object) -> Any:
        """Reject instantiation, as upstream does."""
        kind = "Action" if hasattr(cls, "Goal") else "Service"
        raise NotImplementedError(f"{kind} classes can not be instantiated")
