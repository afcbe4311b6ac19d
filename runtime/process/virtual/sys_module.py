"""`sys.argv` and the standard streams per node process, as properties of the class of `sys`.

C code reads the streams from the module's dictionary, which therefore holds routing streams. Python code gets the
properties.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any

from ..node.thread_state import local
from .module_property import VirtualModule, process_variable, replace_class


class RoutingStream:
    """A standard stream that routes each thread to the stream of its node process, or to the real one."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._original = sys.__dict__[name]
        self.real = self._original
        """The stream that is used outside node processes."""

    def target(self) -> Any:
        """Return the calling thread's stream."""
        process = local.process
        if process.main_state is not None:
            # A stream that the node has assigned to `sys.stdout` precedes its capture, as in a separate process.
            stream = process.overrides.get(self._name) or getattr(process, self._name)
            if stream is not None:
                return stream
        return self.real

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
        """Get the calling thread's `sys.stdout`: this stream, unless it was replaced."""
        if local.process.main_state is not None:
            return local.process.overrides.get(self._name, self)
        return self if self.real is self._original else self.real

    def replace(self, stream: Any) -> None:
        """Handle `sys.stdout = stream`, for the calling thread's process only."""
        if local.process.main_state is not None:
            local.process.overrides[self._name] = None if stream is self else stream
        else:
            self.real = self._original if stream is self else stream


class VirtualSys(VirtualModule):
    """The class of the module `sys` while node processes run."""


def _stream(name: str) -> property:
    def get(module: ModuleType) -> Any:
        return module.__dict__[name].get()

    def set_(module: ModuleType, stream: Any) -> None:
        module.__dict__[name].replace(stream)

    return property(get, set_)


_STREAMS = ("stdin", "stdout", "stderr")


def _add_properties(virtual: Any) -> None:
    for name in _STREAMS:
        setattr(virtual, name, _stream(name))
    virtual.argv = process_variable("argv", lambda process: process.argv)
    virtual.excepthook = process_variable("excepthook", lambda _process: sys.__excepthook__)


_add_properties(VirtualSys)


def install() -> Callable[[], None]:
    """Make the variables of `sys` specific to node processes; returns a function that undoes it."""
    streams = {name: RoutingStream(name) for name in _STREAMS}
    sys.__dict__.update(streams)
    restore_class = replace_class(sys, VirtualSys)

    def uninstall() -> None:
        restore_class()
        for name, stream in streams.items():
            if sys.__dict__[name] is stream:
                sys.__dict__[name] = stream.real

    return uninstall


def reinstall() -> None:
    """Restore the routing streams after code has written to the module's dictionary, bypassing the properties."""
    for name in _STREAMS:
        stream = sys.__dict__[name]
        if not isinstance(stream, RoutingStream):
            sys.__dict__[name] = RoutingStream(name)
