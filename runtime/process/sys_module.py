"""`sys.argv`, `sys.path` and the standard streams, each node process's own: properties of the class of `sys`.

C code reads the streams from the module's dictionary, so a routing stream stands there. Python code gets properties.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any

from bot_console.runtime.process.thread_state import local


class RoutingStream:
    """A standard stream that leads each thread to that of its node process, all others to the real one."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._original = sys.__dict__[name]
        self._real = self._original

    def target(self) -> Any:
        """The stream that the calling thread means."""
        process = local.process
        if process.main_state is not None:
            stream = process.overrides.get(self._name) or getattr(process, self._name)
            if stream is not None:
                return stream
        return self._real

    def write(self, text: str) -> int:
        """Write to the calling thread's stream."""
        return self.target().write(text)

    def flush(self) -> None:
        """Flush the calling thread's stream."""
        self.target().flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self.target(), name)

    def __iter__(self) -> Any:
        return iter(self.target())

    def get(self) -> Any:
        """What `sys.stdout` is to the calling thread: this stream, unless someone put another in its place."""
        if local.process.main_state is not None:
            return local.process.overrides.get(self._name, self)
        return self if self._real is self._original else self._real

    def replace(self, stream: Any) -> None:
        """`sys.stdout = stream`, for the calling thread's process alone."""
        if local.process.main_state is not None:
            local.process.overrides[self._name] = None if stream is self else stream
        else:
            self._real = self._original if stream is self else stream


class _NoInput(io.TextIOBase):
    """Standard input of a node process: at its end, because the keyboard belongs to the console."""

    name = "<stdin>"
    encoding = "utf-8"
    errors = "strict"

    def readable(self) -> bool:
        return True

    def read(self, _size: int | None = -1) -> str:
        return ""

    def readline(self, _size: int = -1) -> str:  # type: ignore[override]
        return ""


NO_INPUT = _NoInput()


class VirtualSys(ModuleType):
    """The class of `sys` while node processes run."""


def _stream(name: str) -> property:
    def get(module: ModuleType) -> Any:
        return module.__dict__[name].get()

    def set_(module: ModuleType, stream: Any) -> None:
        module.__dict__[name].replace(stream)

    return property(get, set_)


def _value(name: str, of_process: Callable[[Any], Any]) -> property:
    """A variable of the process, or one that only a node process can replace for itself."""

    def get(module: ModuleType) -> Any:
        process = local.process
        return module.__dict__[name] if process.main_state is None else of_process(process)

    def set_(module: ModuleType, value: Any) -> None:
        process = local.process
        if process.main_state is None:
            module.__dict__[name] = value
        elif name in vars(process):
            setattr(process, name, value)
        else:
            process.overrides[name] = value

    return property(get, set_)


_STREAMS = ("stdin", "stdout", "stderr")
for _name in _STREAMS:
    setattr(VirtualSys, _name, _stream(_name))
VirtualSys.argv = _value("argv", lambda process: process.argv)  # type: ignore[attr-defined]
VirtualSys.path = _value("path", lambda process: process.path)  # type: ignore[attr-defined]
VirtualSys.excepthook = _value(  # type: ignore[attr-defined]
    "excepthook", lambda process: process.overrides.get("excepthook", sys.__excepthook__)
)


def install() -> Callable[[], None]:
    """Make the variables of `sys` each process's own; returns what undoes it."""
    streams = {name: RoutingStream(name) for name in _STREAMS}
    sys.__dict__.update(streams)
    sys.__class__ = VirtualSys

    def uninstall() -> None:
        sys.__class__ = ModuleType
        for name, stream in streams.items():
            if sys.__dict__[name] is stream:
                sys.__dict__[name] = stream._real

    return uninstall


def reinstall() -> None:
    """Put the routing streams back where code has written past the properties into the module's dictionary."""
    for name in _STREAMS:
        stream = sys.__dict__[name]
        if not isinstance(stream, RoutingStream):
            sys.__dict__[name] = RoutingStream(name)
