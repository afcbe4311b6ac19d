"""`RosConsole`: the `Console` protocol over a `ConsoleNode` in a thread of its own.

Making one is cheap: rclpy and numpy are imported by the thread, so that the first frame need not wait for them.
"""

from __future__ import annotations

import threading
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from bot_console.tui.console.model import (
    Capabilities,
    Change,
    ChangeSource,
    ConsoleSnapshot,
    LaunchInfo,
    LogFilter,
    LogRecord,
    LogState,
    Profile,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
)
from bot_console.tui.console.protocol import Answer, LogFindings, LogView, Samples

if TYPE_CHECKING:
    from bot_console.tui.console.graph.watch import GraphEvents
    from bot_console.tui.console.logs.store import LogStore
    from bot_console.tui.console.logs.view import LogViews
    from bot_console.tui.console.node import ConsoleNode

T = TypeVar("T")
STARTING = "the console is still connecting to the ROS system"
CLOSED = "the console has closed"
NOWHERE = ("", "", 0)
NOTHING_LAUNCHED = LaunchInfo()
LAST_WORD = 0.15
"""Seconds that the final zero Twist has to reach the robot before anything is shut down."""


class _EarlyView:
    """A view that was asked for before there was a log: it has found nothing until it can be opened."""

    def __init__(self, open_view: Callable[[], LogView | None]) -> None:
        self._open_view = open_view
        self._view: LogView | None = None

    def look(self) -> LogFindings:
        if self._view is None:
            self._view = self._open_view()
        return self._view.look() if self._view else NOTHING_FOUND


class _NoNumbers(tuple[int, ...]):
    def place(self, number: int) -> int:
        return 0


NOTHING_FOUND = LogFindings(_NoNumbers())


class RosConsole:
    """The ROS system as the panes see it."""

    def __init__(
        self,
        *,
        launch_info: Callable[[], LaunchInfo] = lambda: NOTHING_LAUNCHED,
        profile_folders: Sequence[Path] = (),
        active_profile: str = "",
        capabilities: Capabilities | None = None,
        run_line: Callable[[str], str] | None = None,
        graph_events: GraphEvents | None = None,
    ) -> None:
        self._launch_info = launch_info
        self._profile_folders = profile_folders
        self._profiles: tuple[Profile, ...] = ()
        self._active_profile = active_profile
        self._capabilities = capabilities or Capabilities()
        self._run_line = run_line
        self._graph_events = graph_events
        self._node: ConsoleNode | None = None
        self._logs: LogStore | None = None
        self._views: LogViews | None = None
        self._problem = ""
        self._ready = threading.Event()
        self._thread = threading.Thread(target=self._serve, name="bot-console", daemon=True)
        self._closed = False
        self._snapshot = ConsoleSnapshot(capabilities=self._capabilities)

    def start(self) -> None:
        """Connect to the ROS system, in the background."""
        self._thread.start()

    def _serve(self) -> None:
        try:
            from bot_console.tui.console.logs.store import LogStore
            from bot_console.tui.console.logs.view import LogViews
            from bot_console.tui.console.node import ConsoleNode
            from bot_console.tui.console.parameters.profiles import find

            self._logs = LogStore()
            self._views = LogViews(self._logs)
            self._node = ConsoleNode(self._logs.add, self._graph_events)
            self._node.setter.profile = self._active_profile
            self._profiles = find(self._profile_folders)
            self._ready.set()
            if self._closed:
                self._node.close(CLOSED)
            else:
                self._node.spin()
        except Exception as error:  # the border of the thread: the panes show what ended it
            place = traceback.extract_tb(error.__traceback__)[-1]
            self._problem = f"the console's link to ROS has ended: {error} ({place.filename}:{place.lineno})"
            if self._node:
                self._node.calls.close(self._problem)
        finally:
            self._ready.set()

    def wait_ready(self, timeout: float) -> bool:
        """Wait until connected, or the connection failed; whether it is connected."""
        return self._ready.wait(timeout) and self._node is not None

    def record(self, stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
        """Take a log record that a process wrote to its console and that `/rosout` does not bring."""
        if self._logs:
            self._logs.add(stamp, severity, name, text, site)

    def heard(self, name: str) -> bool:
        """Whether `/rosout` has brought a line of the logger of that name."""
        return self._node is not None and name in self._node.loggers

    def printed(self, severity: int, label: str, text: str) -> None:
        """Take a line that a process printed."""
        if self._logs:
            self._logs.add(time.time_ns(), severity, label, text, NOWHERE)

    def snapshot(self) -> ConsoleSnapshot:
        """The newest snapshot; the same object when nothing changed."""
        old, node = self._snapshot, self._node
        launch = self._launch_info()
        if node is None:
            new = replace(old, launch=launch, problem=self._problem)
        else:
            world = node.world.info
            new = ConsoleSnapshot(
                seq=old.seq,
                graph=node.graph.info,
                parameters=node.parameters.trees,
                logs=self._logs.state if self._logs else LogState(),
                journal=node.journal.state,
                world=world,
                drive=node.drive.info((world.speed, world.turn) if world.pose else None),
                launch=launch,
                profiles=self._profiles,
                active_profile=node.setter.profile,
                profile_changes=node.profile_changes(self._profile(node.setter.profile)),
                capabilities=self._capabilities,
                problem=self._problem,
            )
        if not _same(old, new):
            self._snapshot = replace(new, seq=old.seq + 1)
        return self._snapshot

    def log(self, seq: int) -> LogRecord | None:
        """The log record of that number."""
        return self._logs.record(seq) if self._logs else None

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """Numbers of the records that pass a filter."""
        if not self._logs:
            return ()
        from bot_console.tui.console.logs.search import matching

        return matching(self._logs, which, after, limit)

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Search for what passes a filter."""
        if self._views:
            return self._views.open(which, instead_of)
        return _EarlyView(lambda: self._views.open(which) if self._views else None)

    def clear_logs(self) -> None:
        """Forget all log records."""
        if self._logs:
            self._logs.clear()

    def changes(self, after: int = 0) -> Sequence[Change]:
        """Journal entries from a number on."""
        return self._node.journal.after(after) if self._node else ()

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Ask a node to take values."""
        if self._node is None:
            refused = (SetOutcome(node, name, value, False, self._why_not, "console") for name, value in values.items())
            return _done(tuple(refused))
        return self._node.set(node, values, source, atomically=atomically)

    def undo(self) -> Future[Answer]:
        """Take the last change of this console back."""
        return self._node.undo() if self._node else _done(Answer(False, self._why_not))

    def redo(self) -> Future[Answer]:
        """Make the last undone change again."""
        return self._node.redo() if self._node else _done(Answer(False, self._why_not))

    def watch(self, path: str) -> Answer:
        """Collect a series."""
        node = self._node
        if node is None or self._closed:
            return Answer(False, self._why_not)
        return node.plots.watch(path, node.graph.info, node.parameters.trees)

    def unwatch(self, path: str) -> None:
        """Stop collecting a series."""
        if self._node and not self._closed:
            self._node.plots.unwatch(path)

    def samples(self, path: str, after: int = 0) -> Samples:
        """New samples of a series."""
        return self._node.plots.samples(path, after) if self._node else Samples((), (), after)

    def plot_time(self, stamp: int | None = None) -> float:
        """Where a moment lies on the time axis of all series."""
        return self._node.plots.axis_time(stamp) if self._node else 0.0

    def plottable(self) -> Sequence[str]:
        """Paths that can be plotted."""
        node = self._node
        return node.plots.plottable(node.graph.info, node.parameters.trees) if node else ()

    def drive(self, linear: float, angular: float) -> None:
        """Send a velocity command."""
        if self._node and not self._closed:
            self._node.drive.drive(linear, angular)

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop, or release it, and zero velocity now."""
        if self._node and not self._closed:
            self._node.drive.stop(hold, reason)

    def steer(self, hold: bool) -> None:
        """Hold the steering, or hand it back."""
        if self._node and not self._closed:
            self._node.drive.steer(hold)

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call any service."""
        return self._node.call(service, type_name, fields) if self._node else _done(Answer(False, self._why_not))

    def set_logger_level(self, node: str, severity: Severity) -> Future[Answer]:
        """Set a node's logger level."""
        return self._node.set_logger_level(node, severity) if self._node else _done(Answer(False, self._why_not))

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        """What a profile would change."""
        profile = self._profile(name)
        return self._node.differences(profile) if self._node and profile else ()

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Set a profile's values live."""
        profile = self._profile(name)
        why_not = self._why_not if self._node is None or self._closed else ""
        if not why_not:
            why_not = profile.problem if profile else f"there is no profile {name}"
        if self._node is None or profile is None or why_not:
            failed: Future[tuple[SetOutcome, ...]] = Future()
            failed.set_exception(ValueError(why_not))
            return failed
        return self._node.apply(profile, reset_world)

    def _profile(self, name: str) -> Profile | None:
        return next((each for each in self._profiles if each.name == name), None)

    def save_parameters(self, path: str, nodes: Sequence[str] = ()) -> Answer:
        """Write parameters to a file."""
        return self._node.save(path, nodes) if self._node else Answer(False, self._why_not)

    def run_line(self, line: str) -> Future[str]:
        """Run a `ros2 ...` command line in a thread of its own."""
        outcome: Future[str] = Future()
        run = self._run_line
        if run is None or self._closed:
            return _done(CLOSED if self._closed else "no ros2 command line is available here")

        def work() -> None:
            try:
                outcome.set_result(run(line))
            except Exception as error:  # the border of the thread
                outcome.set_exception(error)

        threading.Thread(target=work, name="ros2", daemon=True).start()
        return outcome

    @property
    def _why_not(self) -> str:
        """Why nothing can be asked."""
        return CLOSED if self._closed else self._problem or STARTING

    def close(self) -> None:
        """Zero velocity, then leave the ROS system; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        if self._views:
            self._views.close()
        if self._node:
            self._node.drive.close()
            threading.Event().wait(LAST_WORD)
            self._node.close(CLOSED)
        if self._thread.is_alive():
            self._thread.join(2.0)


def _parts(snapshot: ConsoleSnapshot) -> dict[str, object]:
    return {name: getattr(snapshot, name) for name in snapshot.__dataclass_fields__}


def _same(old: ConsoleSnapshot, new: ConsoleSnapshot) -> bool:
    """Whether every part is the same object, or an equal text or number."""
    parts = _parts(new)
    return all(value is getattr(old, name) or (isinstance(value, (str, int)) and value == getattr(old, name))
               for name, value in parts.items() if name not in ("seq", "stamp"))  # fmt: skip


def _done(value: T) -> Future[T]:
    future: Future[T] = Future()
    future.set_result(value)
    return future
