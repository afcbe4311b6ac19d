"""Runs launch descriptions."""

# pyright: reportPrivateUsage=false
# The service uses the context's private methods, as upstream; its users should not.

from __future__ import annotations

import asyncio
import logging
import threading
import traceback
from collections.abc import Coroutine, Generator, Iterable
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, cast

import launch.logging
from bot_console.runtime.process.stepping.event_loop import new_event_loop
from bot_console.runtime.programs.exit_messages import limit_fault
from launch.event_handlers import OnIncludeLaunchDescription, OnShutdown
from launch.events import IncludeLaunchDescription, Shutdown
from launch.launch_context import LaunchContext
from launch.pending_entities import PendingEntities
from launch.user_interrupt import UserInterrupt
from launch.utilities import visit_all_entities_and_collect_futures

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_description_entity import LaunchDescriptionEntity


class LaunchService:
    """Visits launch descriptions and handles events until nothing is left to do. It may run in any thread."""

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False, debug: bool = False) -> None:
        self.__argv = list(argv) if argv is not None else []
        self.__debug = debug
        if debug:
            launch.logging.launch_config.level = logging.DEBUG
        self.__logger = launch.logging.get_logger("launch")
        config = launch.logging.launch_config
        self.__logger.info(f"All log files can be found below {config.log_dir}")
        self.__logger.info(f"Default logging verbosity is set to {logging.getLevelName(config.level)}")
        self.__context = LaunchContext(argv=self.__argv, noninteractive=noninteractive)
        self.__context.register_event_handler(OnIncludeLaunchDescription())
        self.__context.register_event_handler(OnShutdown(on_shutdown=self.__on_shutdown))
        self.__pending = PendingEntities()
        self.__running = threading.Lock()
        self.__shutting_down = False
        self.__return_code = 0
        self.__loop: asyncio.AbstractEventLoop | None = None
        self.__task: asyncio.Task[int] | None = None
        self.__guard = threading.Lock()
        self.__on_their_way: dict[Future[None], Event] = {}
        self.__stop_wanted: str | None = None
        self.__failure: Exception | None = None

    @property
    def context(self) -> LaunchContext:
        """The launch context."""
        return self.__context

    @property
    def event_loop(self) -> asyncio.AbstractEventLoop | None:
        """The event loop in which the service runs; None while it is not running."""
        return self.__loop

    @property
    def task(self) -> asyncio.Task[int] | None:
        """The task as which the service runs; None while it is not running."""
        return self.__task

    @property
    def failure(self) -> Exception | None:
        """The exception that ended the launch, with its traceback, or None (not upstream)."""
        return self.__failure

    @property
    def pending(self) -> list[LaunchDescriptionEntity]:
        """The entities that were started and are not done, including processes and timers (not upstream)."""
        return self.__pending.entities

    def include_launch_description(self, launch_description: object) -> None:
        """Include a description, before the service runs or while it is running."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def emit_event(self, event: Event) -> None:
        """Queue an event; if the service is running, block until its loop has taken the event.

        Raises `RuntimeError` in the thread of that loop, where upstream blocks for ever.
        """
        with self.__guard:
            loop = self.__loop
            if loop is _running_loop() and loop is not None:
                raise RuntimeError(
                    "LaunchService.emit_event() waits for the loop of the launch, so it cannot be called in it: "
                    "return the action EmitEvent(event=...) from the handler, or use context.emit_event_sync(event)"
                )
            if loop is None:
                self.__context.emit_event_sync(event)
                return
            taken: Future[None] = Future()
            self.__on_their_way[taken] = event
            loop.call_soon_threadsafe(self.__take, taken)
        taken.result()

    def __take(self, taken: Future[None]) -> None:
        with self.__guard:
            event = self.__on_their_way.pop(taken, None)
        if event is not None:
            self.__context.emit_event_sync(event)
            taken.set_result(None)

    def __stop_taking(self) -> None:
        """Detach the loop when it ends; events not yet taken are queued for the next run."""
        with self.__guard:
            self.__loop = self.__task = None
            left = list(self.__on_their_way)
        for taken in left:
            self.__take(taken)

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Run in a new event loop until the end; return 1 if an exception was caught, else 0."""
        loop = new_event_loop()
        loop.set_debug(self.__debug)
        try:
            return loop.run_until_complete(self.run_async(shutdown_when_idle=shutdown_when_idle))
        finally:
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.close()

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """Run in the current event loop; raises `RuntimeError` if the service is already running."""
        if not self.__running.acquire(blocking=False):
            raise RuntimeError("LaunchService cannot be run multiple times concurrently.")
        try:
            return await self.__run(shutdown_when_idle)
        finally:
            self.__stop_taking()
            self.__context._set_asyncio_loop(None)
            self.__running.release()

    async def __run(self, shutdown_when_idle: bool) -> int:
        loop = asyncio.get_running_loop()
        with self.__guard:
            self.__loop = loop
        self.__task = asyncio.current_task()
        self.__context._set_asyncio_loop(loop)
        self.__context._set_is_shutdown(False)
        self.__shutting_down = False
        self.__return_code = 0
        self.__context._event_queue.on_event = self.__pending.wake
        if self.__stop_wanted is not None:
            self._shutdown(reason=self.__stop_wanted, due_to_sigint=False)
        with UserInterrupt(self.__interrupted):
            while not (self.__shutting_down and self.__is_idle()):
                if shutdown_when_idle and not self.__shutting_down and self.__is_idle():
                    self._shutdown(reason="idle", due_to_sigint=False)
                await self.__step()
        return self.__return_code

    async def __step(self) -> None:
        """Handle the queued events, or wait until there is one or an entity is done."""
        try:
            self.__pending.raise_failures()
            if not self.__context._event_queue.empty():
                for _ in range(self.__context._event_queue.qsize()):
                    self.__handle(self.__context._event_queue.get_nowait())
                await asyncio.sleep(0)
            elif not self.__is_idle() or not self.__shutting_down:
                await self.__pending.changed()
        except asyncio.CancelledError:
            self._shutdown(reason="run task was canceled", due_to_sigint=False)
            self.__return_code = 1
        except Exception as error:  # launch files and handlers are the user's code
            self.__caught(error)

    def __caught(self, error: Exception) -> None:
        self.__failure = self.__failure or error
        self.__logger.debug(traceback.format_exc())
        message = f"Caught exception in launch (see debug for traceback): {limit_fault(error) or error}"
        self.__logger.error(message)
        self._shutdown(reason=message, due_to_sigint=False)
        self.__return_code = 1

    def __is_idle(self) -> bool:
        futures = self.__context._completion_futures
        futures[:] = [each for each in futures if not each.done()]
        return not self.__pending and not futures and self.__context._event_queue.empty()

    def __handle(self, event: Any) -> None:
        self.__logger.debug("processing event: '%s'", event)
        for handler in self.__context._event_handlers.matching(event):
            if handler not in self.__context._event_handlers:
                continue
            self.__context._push_locals()
            try:
                self.__visit(handler.handle(event, self.__context))
            finally:
                self.__context._pop_locals()

    def __visit(self, entities: object) -> None:
        if entities is None:
            return
        given = cast("Iterable[Any]", entities if isinstance(entities, Iterable) else (entities,))
        for entity in given:
            if entity is None:
                continue
            if not hasattr(entity, "visit"):
                raise RuntimeError(f"expected a LaunchDescriptionEntity from event_handler, got '{entity}'")
            for visited, future in visit_all_entities_and_collect_futures(entity, self.__context):
                self.__pending.add(future, visited)

    def __on_shutdown(self, event: object, context: LaunchContext) -> None:
        self.__shutting_down = True
        context._set_is_shutdown(True)

    def __interrupted(self, again: bool) -> None:
        text = "user interrupted with ctrl-c (SIGINT)"
        if again:
            self.__logger.warning(f"{text} again, ignoring...")
            return
        self.__logger.warning(text)
        self._shutdown(reason="ctrl-c (SIGINT)", due_to_sigint=True)

    def _shutdown(self, *, reason: str, due_to_sigint: bool) -> None:
        if self.__shutting_down:
            return
        self.__shutting_down = True
        self.__context._set_is_shutdown(True)
        self.__context.emit_event_sync(Shutdown(reason=reason, due_to_sigint=due_to_sigint))

    def shutdown(self, force_sync: bool = False) -> Coroutine[object, None, None] | None:
        """Shut down, from any thread; before the service runs, this makes it end as soon as it starts.

        Returns a coroutine unless `force_sync` is set; the request is made in either case.
        """
        reason = "LaunchService.shutdown() called"
        with self.__guard:
            loop = self.__loop
            if loop is None:
                self.__stop_wanted = reason
            elif loop is not _running_loop():
                loop.call_soon_threadsafe(lambda: self._shutdown(reason=reason, due_to_sigint=False))
                loop = None
        if loop is not None:
            self._shutdown(reason=reason, due_to_sigint=False)
        return None if force_sync else _NoOpCoroutine()


class _NoOpCoroutine(Coroutine[Any, Any, None]):
    """A coroutine with nothing to do, which may be awaited, made a task, or dropped without a warning."""

    def __await__(self) -> Generator[object, None, None]:
        return
        yield

    def send(self, value: object) -> Any:
        """End."""
        raise StopIteration

    def throw(self, *error: Any) -> Any:
        """Raise the given exception."""
        raise error[0]

    def close(self) -> None:
        """Do nothing."""


def _running_loop() -> asyncio.AbstractEventLoop | None:
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None
