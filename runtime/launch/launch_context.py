"""The state of a launch: configurations, locals, environment, handlers, and the queue of events."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.event_queue import EventQueue
from launch.handler_registry import HandlerRegistry
from launch.inherited_arguments import Includes

if TYPE_CHECKING:
    from launch.event import Event


class LaunchContext:
    """The state that entities see while they are visited."""

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False) -> None:
        self.__argv = list(argv) if argv is not None else []
        self.noninteractive = noninteractive
        self._event_queue = EventQueue()
        self._event_handlers = HandlerRegistry()
        self._completion_futures: list[asyncio.Future[None]] = []
        self.__globals: dict[str, object] = {}
        self.__locals_stack: list[dict[str, object]] = []
        self.__locals: dict[str, object] = {}
        self.__configurations_stack: list[dict[str, Any]] = []
        self.__configurations: dict[str, Any] = {}
        self.__environment_stack: list[dict[str, str]] = []
        self.declared_arguments: set[str] = set()
        self.includes = Includes()
        self.read_configurations: set[str] = set()
        self.names_without_namespace: dict[str, str] = {}
        self.resolving = False
        """Whether the launch file is only evaluated and nothing is started."""
        self.__is_shutdown = False
        self.__asyncio_loop: asyncio.AbstractEventLoop | None = None
        self.__logger = launch.logging.get_logger(__name__)
        self.__environment_reset = dict(os.environ)

    @property
    def argv(self) -> list[str]:
        """The command line of the launch."""
        return self.__argv

    @property
    def is_shutdown(self) -> bool:
        """Whether the launch is shutting down."""
        return self.__is_shutdown

    def _set_is_shutdown(self, state: bool) -> None:
        self.__is_shutdown = state

    def _set_asyncio_loop(self, loop: asyncio.AbstractEventLoop | None) -> None:
        self.__asyncio_loop = loop

    @property
    def asyncio_loop(self) -> Any:
        """The launch's event loop; None unless it runs, which actions need not check."""
        return self.__asyncio_loop

    def add_completion_future(self, future: asyncio.Future[None]) -> None:
        """Prevent the launch from being idle until a future is done."""
        self._completion_futures.append(future)

    def _push_locals(self) -> None:
        self.__locals_stack.append(dict(self.__locals))

    def _pop_locals(self) -> None:
        if not self.__locals_stack:
            raise RuntimeError("locals stack unexpectedly empty")
        self.__locals = self.__locals_stack.pop()

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return globals and locals merged."""
        return {**self.__globals, **self.__locals}

    @property
    def locals(self) -> Any:
        """The locals, as attributes."""
        return _Locals(self.get_locals_as_dict())

    def extend_globals(self, extensions: Mapping[str, object]) -> None:
        """Add globals, visible to every entity."""
        self.__globals.update(extensions)

    def extend_locals(self, extensions: Mapping[str, object]) -> None:
        """Add locals, visible to entities visited from now on."""
        self.__locals.update(extensions)

    @property
    def launch_configurations(self) -> dict[str, Any]:
        """The launch configurations, by name."""
        return self.__configurations

    def _push_launch_configurations(self) -> None:
        self.__configurations_stack.append(self.__configurations)
        self.__configurations = dict(self.__configurations)

    def _pop_launch_configurations(self) -> None:
        if not self.__configurations_stack:
            raise RuntimeError("launch_configurations stack unexpectedly empty")
        self.__configurations = self.__configurations_stack.pop()

    @property
    def environment(self) -> Any:
        """The environment of the launching process itself."""
        return os.environ

    def _push_environment(self) -> None:
        self.__environment_stack.append(dict(os.environ))

    def _pop_environment(self) -> None:
        if not self.__environment_stack:
            raise RuntimeError("environment stack unexpectedly empty")
        _replace_environment(self.__environment_stack.pop())

    def _reset_environment(self) -> None:
        _replace_environment(self.__environment_reset)

    def register_event_handler(self, event_handler: object, append: bool = False) -> None:
        """Register a handler before the existing ones or, with `append`, after them."""
        self._event_handlers.add(event_handler, append=append)

    def unregister_event_handler(self, event_handler: object) -> None:
        """Unregister a handler; raises `ValueError` if it is not registered."""
        self._event_handlers.remove(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """Whether any handler matches."""
        return bool(self._event_handlers.matching(event))

    def emit_event_sync(self, event: Event) -> None:
        """Put an event into the queue, from the loop's thread."""
        self.__logger.debug("emitting event synchronously: '%s'", event.name)
        self._event_queue.put_nowait(event)

    async def emit_event(self, event: Event) -> None:
        """Put an event into the queue."""
        self.__logger.debug("emitting event: '%s'", event.name)
        self._event_queue.put_nowait(event)

    def perform_substitution(self, sub: Any) -> str:
        """Evaluate a substitution."""
        return sub.perform(self)


class _Locals:
    """Locals as attributes."""

    def __init__(self, values: dict[str, Any]) -> None:
        self.__dict__["_values"] = values

    def __getattr__(self, name: str) -> Any:
        values = self.__dict__["_values"]
        if name not in values:
            known = ", ".join(values)
            raise AttributeError(f"context.locals does not contain attribute '{name}', it contains: [{known}]")
        return values[name]

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"context.locals.{name} cannot be set: context.extend_locals() adds to them")


def _replace_environment(values: dict[str, str]) -> None:
    for name in [name for name in os.environ if name not in values]:
        del os.environ[name]
    os.environ.update(values)
