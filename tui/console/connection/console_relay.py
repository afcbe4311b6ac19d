"""A console that forwards everything to the console currently behind it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.log_protocol import LogSource, LogView
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
from bot_console.tui.console.protocol import Console, Samples
from bot_console.tui.console.recording import Recording
from bot_console.tui.console.robot.robot_model import Pose
from bot_console.tui.console.sensors.model import Sensors
from bot_console.tui.console.traffic import Traffic


class ConsoleRelay:
    """Lets its users keep one object while the console behind it is replaced."""

    def __init__(self, first: Console) -> None:
        self._now = first

    def snapshot(self) -> ConsoleSnapshot:
        """The newest snapshot."""
        return self._now.snapshot()

    @property
    def recording(self) -> Recording:
        """Records into bags."""
        return self._now.recording

    @property
    def traffic(self) -> Traffic:
        """Topics, services and actions."""
        return self._now.traffic

    @property
    def sensors(self) -> Sensors:
        """The robot's sensor data."""
        return self._now.sensors

    def log(self, seq: int) -> LogRecord | None:
        """The log record of that number."""
        return self._now.log(seq)

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """Numbers of the records that pass a filter."""
        return self._now.matching_logs(which, after, limit)

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Search for records that pass a filter."""
        return self._now.view_logs(which, instead_of)

    def open_log(self, path: str) -> LogSource:
        """Read a saved log."""
        return self._now.open_log(path)

    def clear_logs(self) -> None:
        """Discard all log records."""
        self._now.clear_logs()

    def changes(self, after: int = 0) -> Sequence[Change]:
        """Journal entries after a number."""
        return self._now.changes(after)

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Request new values of a node's parameters."""
        return self._now.set_parameters(node, values, source, atomically=atomically)

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of several nodes, all or none."""
        return self._now.set_all(values, source, by)

    def undo(self) -> Future[Answer]:
        """Revert the last change made by this console."""
        return self._now.undo()

    def redo(self) -> Future[Answer]:
        """Repeat the last undone change."""
        return self._now.redo()

    def watch(self, path: str, requester: str = "") -> Answer:
        """Collect a series."""
        return self._now.watch(path, requester)

    def unwatch(self, path: str, requester: str = "") -> None:
        """Stop collecting a series."""
        self._now.unwatch(path, requester)

    def samples(self, path: str, after: int = 0) -> Samples:
        """New samples of a series."""
        return self._now.samples(path, after)

    def plot_time(self, stamp: int | None = None) -> float:
        """The position of a time on the common axis of all series."""
        return self._now.plot_time(stamp)

    def pose_at(self, stamp: int) -> Pose | None:
        """The robot's pose at a time."""
        return self._now.pose_at(stamp)

    def plottable(self) -> Sequence[str]:
        """Paths that can be plotted."""
        return self._now.plottable()

    def drive(self, linear: float, angular: float) -> None:
        """Send a velocity command."""
        self._now.drive(linear, angular)

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop and send zero velocity, or with `hold=False` withdraw this console's stop."""
        self._now.all_stop(hold, reason)

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that is not processed yet."""
        self._now.hold_early(press)

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep that stop, or withdraw it if it was sent for this key press alone."""
        self._now.settle_early(press, keep=keep)

    def release(self, others: Sequence[str]) -> None:
        """Withdraw this console's stop and those of others."""
        self._now.release(others)

    def choose_robot(self, robot: str) -> None:
        """Drive another robot."""
        self._now.choose_robot(robot)

    def steer(self, hold: bool) -> None:
        """Take control of the robot, or hand it back."""
        self._now.steer(hold)

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call any service."""
        return self._now.call(service, type_name, fields)

    def set_logger_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        """Set a logger's level."""
        return self._now.set_logger_level(node, severity, logger)

    def logger_levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """The levels of a node's loggers."""
        return self._now.logger_levels(node)

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        """What a profile would change."""
        return self._now.profile_differences(name)

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Set a profile's values in the running nodes."""
        return self._now.apply_profile(name, reset_world=reset_world)

    def fetch_profile(self, address: str) -> Future[Answer]:
        """Download a parameter file and add it as a profile."""
        return self._now.fetch_profile(address)

    def open_profile(self, path: str) -> Answer:
        """Add a file as a profile."""
        return self._now.open_profile(path)

    def save_profile(self, name: str, description: str = "") -> Answer:
        """Save the current values as a profile."""
        return self._now.save_profile(name, description)

    def rename_profile(self, name: str, to: str) -> Answer:
        """Rename a profile."""
        return self._now.rename_profile(name, to)

    def delete_profile(self, name: str) -> Answer:
        """Delete the file of a profile."""
        return self._now.delete_profile(name)

    def save_parameters(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Write parameters to a file."""
        return self._now.save_parameters(path, nodes, only_changed=only_changed)

    def close(self) -> None:
        """Leave the ROS system."""
        self._now.close()
