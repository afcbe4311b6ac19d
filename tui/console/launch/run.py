"""One run of launch: a LaunchService, the events sent to it, and the events it reports."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bot_console.tui.console.launch.delayed_starts import delayed_starts
from bot_console.tui.console.launch.fault import fault_text
from bot_console.tui.console.launch.tree import LaunchTree

if TYPE_CHECKING:
    from launch.events import Shutdown
    from launch.events.process import ProcessExited, ProcessStarted

    from launch import LaunchContext

MISSING = "launch_ros.events.NodeMissing"
"""The name of the event for a node that is left out. It is not imported because ROS 2 has no such event."""
CAUGHT = "Caught exception in launch (see debug for traceback): "


@dataclass(frozen=True)
class Listener:
    """Callbacks, called in the thread of a run, for the events of all its processes."""

    started: Callable[[LaunchRun, ProcessStarted, LaunchContext], None]
    """Receives `ProcessStarted` and the launch context."""
    printed: Callable[[Any], None]
    """Receives `ProcessIO`."""
    exited: Callable[[ProcessExited], None]
    """Receives `ProcessExited`."""
    missing: Callable[[LaunchRun, Any, LaunchContext], None]
    """Receives `NodeMissing`, if this launch has that event, and the launch context."""
    over: Callable[[Any], None]
    """Receives an action that has ended and that launch will not start again."""
    ending: Callable[[LaunchRun, str], None]
    """Receives the reason why the whole launch ends; empty if it has failed."""
    fault: Callable[[Exception], None]
    """Receives an exception raised by one of the other callbacks."""


class LaunchRun:
    """Runs a launch file, or single processes, until they have ended. Methods may be called from any thread."""

    def __init__(self, title: str, listener: Listener) -> None:
        self.title = self.path = title
        self.tree = LaunchTree(title)
        self.ending = False
        """Whether it accepts no more processes."""
        self._listener = listener
        self._lock = threading.Lock()
        self._service: Any = None
        self._early: list[Any] | None = []
        """Events emitted before the launch runs, to be handled first; None once it runs."""
        self._unwanted = False
        self._reason = ""
        self.logged = False
        """Whether launch itself has logged why the run failed."""

    def run_file(self, path: str, arguments: Mapping[str, str]) -> str:
        """Run a launch file to its end; returns why it could not be run, or an empty text if it could."""
        from launch.actions import IncludeLaunchDescription
        from launch.launch_description_sources import AnyLaunchDescriptionSource

        from launch import LaunchContext

        self.path = path
        source = AnyLaunchDescriptionSource(path)
        try:
            source.get_launch_description(LaunchContext())  # called again below, but then served from a cache
        except (Exception, SystemExit) as error:  # a launch file is a program: whatever it raises is shown to the user
            self.ending = True
            return fault_text(error, path, reading=True)
        return self._run([IncludeLaunchDescription(source, launch_arguments=arguments.items())])

    def run_action(self, make: Callable[[], Any], failed: Callable[[str], None]) -> str:
        """Run one process to its end, as in `start`; returns what went wrong with launch itself, or an empty text."""
        return self._run([self._guarded(make, failed)])

    def _run(self, entities: list[Any]) -> str:
        from launch.actions import OpaqueFunction

        from launch import LaunchDescription, LaunchService

        try:
            service = LaunchService(noninteractive=True)
            with self._lock:
                if self._unwanted:
                    return ""
                self._service = service
            begun = OpaqueFunction(function=self._on_begin)
            service.include_launch_description(LaunchDescription([*self._handlers(), begun, *entities]))
            code = service.run(shutdown_when_idle=True)
        finally:
            self.ending = True
        self.logged = code != 0
        failure = getattr(service, "failure", None)
        if failure is not None:
            return self.fault(failure)
        return f"{self.path}: {self._reason.removeprefix(CAUGHT)}" if code else ""

    def _on_begin(self, context: LaunchContext) -> None:
        """Emit the earlier events; from now on, `emit` passes events to the running loop."""
        with self._lock:
            early, self._early = self._early or [], None
        for event in early:
            context.emit_event_sync(event)

    def fault(self, error: BaseException) -> str:
        """The message for an error of this launch, with file and line."""
        return fault_text(error, self.path, self.tree.file_of)

    def _handlers(self) -> Iterable[Any]:
        from launch.actions import IncludeLaunchDescription, OpaqueFunction, RegisterEventHandler
        from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown

        heard = self._listener

        from launch import EventHandler

        def sanitize(hear: Callable[[Any, Any], None]) -> Callable[..., None]:
            def handle(event: Any, context: Any = None) -> None:
                try:
                    hear(event, context)
                except Exception as error:  # an error of the console must not end the launch of a robot
                    heard.fault(error)

            return handle

        def is_include(action: Any) -> bool:
            return isinstance(action, IncludeLaunchDescription)

        printed = sanitize(lambda event, context: heard.printed(event))
        includes = OnExecutionComplete(
            target_action=is_include,
            on_completion=sanitize(lambda event, context: self.tree.included(event.action)),
        )
        missing = sanitize(lambda event, context: heard.missing(self, event, context))

        def report_missing(context: Any) -> None:
            missing(context.locals.event, context)

        handlers = (
            includes,
            EventHandler(
                matcher=lambda event: event.name == MISSING,
                entities=[OpaqueFunction(function=report_missing)],
            ),
            OnProcessStart(on_start=sanitize(self._started)),
            OnProcessIO(on_stdout=printed, on_stderr=printed),
            OnProcessExit(on_exit=sanitize(lambda event, context: heard.exited(event))),
            OnShutdown(on_shutdown=sanitize(self._on_shutdown)),
        )
        return [RegisterEventHandler(each) for each in handlers]

    def _started(self, event: ProcessStarted, context: LaunchContext) -> None:
        self._report_when_over(event.action)
        self._listener.started(self, event, context)

    def _report_when_over(self, action: Any) -> None:
        def over(future: Any) -> None:
            self._listener.over(action)

        future = action.get_asyncio_future()
        if future is not None:
            future.add_done_callback(over)

    def _on_shutdown(self, event: Shutdown, context: LaunchContext) -> None:
        if self.ending:
            return
        self.ending = True
        self._reason = event.reason
        failed = event.reason.startswith(CAUGHT)  # such a failure is reported with file and line when the run is over
        self._listener.ending(self, "" if failed else event.reason)

    @property
    def has_begun(self) -> bool:
        """Whether launch has run at all; if it has not, there is no point in trying the same again."""
        return self._early is None

    @property
    def delayed_starts(self) -> int:
        """The number of starts that are pending in timers."""
        return 0 if self._service is None else delayed_starts(self._service)

    def start(self, make: Callable[[], Any], failed: Callable[[str], None]) -> None:
        """Run the action that `make` returns, outside the launch file's scopes; `failed` receives the reason if that
        fails.
        """
        from launch.events import IncludeLaunchDescription

        from launch import LaunchDescription

        self.emit(IncludeLaunchDescription(LaunchDescription([self._guarded(make, failed)])))

    def _guarded(self, make: Callable[[], Any], failed: Callable[[str], None]) -> Any:
        """Wrap a process so that its failure to start does not end the launch."""
        from bot_console.tui.console.launch.guarded_start import GuardedStart
        from launch.actions import GroupAction

        start = GuardedStart(make, self._report_when_over, failed)
        return GroupAction([start], scoped=True, forwarding=False)

    def emit(self, event: Any) -> None:
        """Queue an event without waiting for the launch, unlike `LaunchService.emit_event`.

        The caller may hold a lock that the launch is waiting for. A launch that does not run yet handles the event once
        it runs; a launch that is over does not handle it: see `ending`.
        """
        with self._lock:
            if self._early is not None:
                self._early.append(event)
                return
        loop = self._service.event_loop
        if loop is not None:
            with contextlib.suppress(RuntimeError):  # the loop has ended
                loop.call_soon_threadsafe(self._service.context.emit_event_sync, event)

    def shut_down(self) -> None:
        """End everything, or do not begin at all."""
        from launch.events import Shutdown

        with self._lock:
            self._unwanted = True
            service = self._service
            if self._early is not None:  # ROS 2 ignores a shutdown() before its loop runs
                self._early.append(Shutdown(reason="LaunchService.shutdown() called"))
        if service is not None:
            service.shutdown()
