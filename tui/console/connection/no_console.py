"""The console before there is a connection, or after it has ended: refuses every request with the reason."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from typing import TypeVar

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_line import Stream
from bot_console.tui.console.log_protocol import LogFindings, LogSource, LogView
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    LogFilter,
    LoggerLevel,
    LogRecord,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
)
from bot_console.tui.console.protocol import ConsoleReading, Samples
from bot_console.tui.console.recording import Recording, RecordingInfo
from bot_console.tui.console.robot.robot_model import Pose
from bot_console.tui.console.sensors.idle_sensors import IdleSensors
from bot_console.tui.console.sensors.model import Sensors
from bot_console.tui.console.topics.idle_traffic import IdleTraffic
from bot_console.tui.console.traffic import Traffic

T = TypeVar("T")
STARTING = "the console is still connecting to the ROS system"
CLOSED = "the console has closed"
OpenView = Callable[[LogFilter], "LogView | None"]


class _NoNumbers(tuple[int, ...]):
    def place(self, number: int) -> int:
        return 0

    def count(self, index: object) -> int:
        return 0


class EarlyView:
    """A search requested before the log exists: it finds nothing until it can be opened."""

    def __init__(self, which: LogFilter, open_view: OpenView) -> None:
        self._which = which
        self._open_view = open_view
        self._view: LogView | None = None

    def poll(self) -> LogFindings:
        """What has been found so far."""
        if self._view is None:
            self._view = self._open_view(self._which)
        return self._view.poll() if self._view else LogFindings(_NoNumbers())


class NothingKnown:
    """The data of a console that has not connected yet; `open_view` starts the pending searches once there is a log."""

    def __init__(self, snapshot: ConsoleSnapshot, open_view: OpenView) -> None:
        self._snapshot = snapshot
        self._open_view = open_view

    def snapshot(self) -> ConsoleSnapshot:
        """An empty snapshot."""
        return self._snapshot

    def log(self, seq: int) -> LogRecord | None:
        """None: there are no records."""
        return None

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """Empty: there are no records."""
        return ()

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """A view that waits for the log."""
        return EarlyView(which, self._open_view)

    def open_log(self, path: str) -> LogSource:
        """Refused until there is a log."""
        raise ValueError(STARTING)

    def changes(self, after: int = 0) -> Sequence[Change]:
        """Empty: nothing has changed."""
        return ()

    def samples(self, path: str, after: int = 0) -> Samples:
        """No samples."""
        return Samples((), (), after)

    def plot_time(self, stamp: int | None = None) -> float:
        """The start of the axis."""
        return 0.0

    def pose_at(self, stamp: int) -> Pose | None:
        """None: the pose is unknown."""
        return None

    def plottable(self) -> Sequence[str]:
        """Empty: nothing can be plotted."""
        return ()

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        """Empty: nothing would change."""
        return ()


class NoRecording:
    """Refuses to record, with the reason."""

    info = RecordingInfo()

    def __init__(self, refusal: Answer) -> None:
        self._refusal = refusal

    def start(self, folder: str) -> Future[Answer]:
        """Refused."""
        return done(self._refusal)

    def stop(self) -> Future[Answer]:
        """Refused."""
        return done(self._refusal)

    def keep(self, folder: str) -> Future[Answer]:
        """Refused."""
        return done(self._refusal)


class NoConsole:
    """Refuses every request with the reason; queries are answered by `known`."""

    def __init__(self, why: str, known: ConsoleReading) -> None:
        self._why = why
        self._refusal = Answer(False, why)
        self._idle: Traffic = IdleTraffic(why)
        self._no_recording = NoRecording(self._refusal)
        self._blind: Sensors = IdleSensors(why)
        self.snapshot = known.snapshot
        self.log = known.log
        self.matching_logs = known.matching_logs
        self.view_logs = known.view_logs
        self.open_log = known.open_log
        self.changes = known.changes
        self.samples = known.samples
        self.plot_time = known.plot_time
        self.pose_at = known.pose_at
        self.plottable = known.plottable
        self.profile_differences = known.profile_differences

    @property
    def recording(self) -> Recording:
        """Refuses to record."""
        return self._no_recording

    @property
    def traffic(self) -> Traffic:
        """Refuses to send messages."""
        return self._idle

    @property
    def sensors(self) -> Sensors:
        """No sensor data."""
        return self._blind

    def clear_logs(self) -> None:
        """Do nothing: there are no records."""

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Refused by the console, value by value."""
        outcomes = (SetOutcome(node, name, value, False, self._why, "console") for name, value in values.items())
        return done(tuple(outcomes))

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        """Refused by the console, value by value."""
        wanted = ((node, name, value) for node, found in values.items() for name, value in found.items())
        return done(tuple(SetOutcome(*each, False, self._why, "console") for each in wanted))

    def undo(self) -> Future[Answer]:
        """Refused."""
        return done(self._refusal)

    def redo(self) -> Future[Answer]:
        """Refused."""
        return done(self._refusal)

    def watch(self, path: str, requester: str = "") -> Answer:
        """Refused."""
        return self._refusal

    def unwatch(self, path: str, requester: str = "") -> None:
        """Do nothing: no series are collected."""

    def drive(self, linear: float, angular: float) -> None:
        """Do nothing: there is no robot."""

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Do nothing: there is no connection to a robot."""

    def hold_early(self, press: str) -> None:
        """Do nothing."""

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Do nothing."""

    def release(self, others: Sequence[str]) -> None:
        """Do nothing: there is no connection to a robot."""

    def choose_robot(self, robot: str) -> None:
        """Do nothing."""

    def steer(self, hold: bool) -> None:
        """Do nothing."""

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Refused."""
        return done(self._refusal)

    def set_logger_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        """Refused."""
        return done(self._refusal)

    def logger_levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """Refused: the future raises `ValueError`."""
        refused: Future[tuple[LoggerLevel, ...]] = Future()
        refused.set_exception(ValueError(self._why))
        return refused

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Refused: the future raises `ValueError`."""
        return refused_profile(self._why)

    def fetch_profile(self, address: str) -> Future[Answer]:
        """Refused."""
        return done(self._refusal)

    def open_profile(self, path: str) -> Answer:
        """Refused."""
        return self._refusal

    def save_profile(self, name: str, description: str = "") -> Answer:
        """Refused."""
        return self._refusal

    def rename_profile(self, name: str, to: str) -> Answer:
        """Refused."""
        return self._refusal

    def delete_profile(self, name: str) -> Answer:
        """Refused."""
        return self._refusal

    def save_parameters(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Refused."""
        return self._refusal

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


class NoCommandLine:
    """The command line where no `ros2` line can be run."""

    def run(self, line: str) -> Future[str]:
        """Say that there is no command line."""
        return done("no ros2 command line is available here")

    def stream(self, line: str) -> Stream | None:
        """None: no line can be run."""
        return None

    def commands(self) -> Sequence[str]:
        """Empty: there are no commands."""
        return ()

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        """No completions."""
        return done(())


def refused_profile(why: str) -> Future[tuple[SetOutcome, ...]]:
    """A future that raises `ValueError` with the reason, as `Console.apply_profile` promises."""
    failed: Future[tuple[SetOutcome, ...]] = Future()
    failed.set_exception(ValueError(why))
    return failed


def done(value: T) -> Future[T]:
    """A future that is already done, with its result."""
    future: Future[T] = Future()
    future.set_result(value)
    return future
