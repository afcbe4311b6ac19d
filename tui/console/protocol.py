"""The protocols between the panes and a ROS system. Standard library only.

`Console` covers everything on the ROS graph, `Launcher` everything about processes. The panes poll both: no method
blocks, and all of them except `close` must be called from the thread that draws, unless their docstring says otherwise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.log_protocol import LogSource, LogView
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    LaunchArgument,
    LogFilter,
    LoggerLevel,
    LogRecord,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
)

if TYPE_CHECKING:
    from bot_console.tui.console.recording import Recording
    from bot_console.tui.console.robot.robot_model import Pose
    from bot_console.tui.console.sensors.model import Sensors
    from bot_console.tui.console.traffic import Traffic


@dataclass(frozen=True, slots=True)
class Samples:
    """New samples of a watched series: times in s (steady, from the console's start) and values, of equal length."""

    times: Sequence[float]
    values: Sequence[float]
    cursor: int
    """Pass this to the next call to receive only later samples."""
    problem: str = ""
    """Why no samples come, for instance because an array is empty; empty when all is well."""
    headers: Sequence[float] = ()
    """The times in the message headers, on the same axis, NaN where there is none; empty if no message has one."""


class ConsoleReading(Protocol):
    """Read access to what is known about a ROS system."""

    def snapshot(self) -> ConsoleSnapshot:
        """The newest snapshot; parts that have not changed are the same objects as before."""
        ...

    def log(self, seq: int) -> LogRecord | None:
        """The record with that number; None when it was dropped or has not arrived yet."""
        ...

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """Numbers, ascending, of the kept records from `after` on that match the filter; with a limit, the newest.

        Raises `ValueError` with a readable message for a regular expression that does not compile.
        """
        ...

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Start a search that follows new records; it ends the one given as `instead_of`."""
        ...

    def open_log(self, path: str) -> LogSource:
        """Read a saved log and follow it as it grows; raises `ValueError` with the reason when that fails."""
        ...

    def changes(self, after: int = 0) -> Sequence[Change]:
        """Journal entries from number `after` on, oldest first; entries of earlier runs have negative numbers."""
        ...

    def samples(self, path: str, after: int = 0) -> Samples:
        """The samples of a watched series that came after a cursor."""
        ...

    def plot_time(self, stamp: int | None = None) -> float:
        """The position (s) of a time (ns since the epoch; None for now) on the time axis that all series share."""
        ...

    def pose_at(self, stamp: int) -> Pose | None:
        """The robot's pose at a time (ns since the epoch); None if it is unknown."""
        ...

    def plottable(self) -> Sequence[str]:
        """Paths that `watch` accepts, for completion."""
        ...

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        """What applying a profile now would change."""
        ...


class Console(ConsoleReading, Protocol):
    """A ROS system as the panes see it: what is known about it, and the requests it accepts."""

    @property
    def recording(self) -> Recording:
        """Recording of the system's topics into bags."""
        ...

    @property
    def traffic(self) -> Traffic:
        """The system's topics, services and actions."""
        ...

    @property
    def sensors(self) -> Sensors:
        """The system's diagnostics, images and frames."""
        ...

    def clear_logs(self) -> None:
        """Discard all records; numbering continues."""
        ...

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of one node, by its `set_parameters` or `set_parameters_atomically` service."""
        ...

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of several nodes (by node and name), all or none; a single undo reverts all of them.

        `by` names the operation they belong to. If one node refuses, nodes that had already accepted are set back, and
        every outcome says why; a value that could not be set back has `accepted` set and a reason.
        """
        ...

    def undo(self) -> Future[Answer]:
        """Restore the value from before the last accepted change made by this console."""
        ...

    def redo(self) -> Future[Answer]:
        """Repeat the last undone change."""
        ...

    def watch(self, path: str, requester: str = "") -> Answer:
        """Collect a series for as long as any requester needs it; the answer says why a path cannot be plotted.

        `/topic/field.sub[2]`, `/topic/array[2:8].mean()` (or min, max, sum, std, len; yaw of a quaternion), or
        `/node:parameter`.
        """
        ...

    def unwatch(self, path: str, requester: str = "") -> None:
        """Withdraw one requester's interest in a series; it is discarded when no requester is left."""
        ...

    def drive(self, linear: float, angular: float) -> None:
        """Send one velocity command (m/s, rad/s); the caller repeats it. Silently ignored while an all-stop holds.

        Raises `ValueError` for NaN and infinity.
        """
        ...

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop, or with `hold=False` withdraw this console's stop; either way send zero
        velocity now.

        A robot that others have stopped too stays locked until their stops are released. `DriveInfo.stop_confirmed`
        says whether the stop has been acknowledged. A robot without an emergency stop is sent zero velocities as long
        as it is stopped. May be called from any thread.
        """
        ...

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that is not processed yet, under a separate id; send zero velocity now.

        `press` identifies the key press. May be called from any thread.
        """
        ...

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep the stop for a key press until it is released like any other, or withdraw it and no other.

        May be called from any thread.
        """
        ...

    def release(self, others: Sequence[str]) -> None:
        """Withdraw this console's stop and the stops of others with these keys (see `DriveInfo.stops`)."""
        ...

    def choose_robot(self, robot: str) -> None:
        """Drive another of `DriveInfo.robots`; an all-stop always applies to all of them."""
        ...

    def steer(self, hold: bool) -> None:
        """Take control of the robot, so that only a person's commands count, or hand it back.

        While the console has control, the claim is repeated at least every 0.5 s; if it falls silent, the robot is
        locked.
        """
        ...

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call any service with the given request fields."""
        ...

    def set_logger_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        """Set the level of a node's logger, or of one of its children; UNSET inherits the parent's level."""
        ...

    def logger_levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """The levels of a node's logger and of its children that have logged; raises `ValueError` with the reason."""
        ...

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Set a profile's values on the running nodes, all or none; it becomes active unless something was refused.

        A launch profile sets no values: once it has been launched, it is the active one. The future raises
        `ValueError`, with the reason, for a profile that does not exist or cannot be used.
        """
        ...

    def open_profile(self, path: str) -> Answer:
        """Add a parameter file as a profile, to preview what it changes; the answer is its name, or why it failed."""
        ...

    def fetch_profile(self, address: str) -> Future[Answer]:
        """Add a parameter file from an `https://` address as a profile; the answer is its name, or why it failed."""
        ...

    def save_profile(self, name: str, description: str = "") -> Answer:
        """Save the parameters of everything that runs as one of the user's profiles, with a one-line description."""
        ...

    def rename_profile(self, name: str, to: str) -> Answer:
        """Rename one of the user's profiles; refused for any other profile, and for a name that is taken."""
        ...

    def delete_profile(self, name: str) -> Answer:
        """Delete the file of one of the user's profiles; refused for any other profile."""
        ...

    def save_parameters(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Write a ROS parameter file; an existing file keeps its comments.

        With `only_changed`, only the values that differ from the declared ones or, where those are unknown, from the
        start values.
        """
        ...

    def close(self) -> None:
        """Send zero velocity, then stop and join everything; a second call does nothing.

        Data already received stays readable. Pending and later requests are refused, so that every future is completed.
        """
        ...


class Launcher(Protocol):
    """The processes that launch files have started; their state is in `ConsoleSnapshot.launch`."""

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run another launch file."""
        ...

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments a launch file declares; raises `ValueError` with file and line when it cannot be read.

        A launch file is a program and may take a while, so this method may be called from any thread.
        """
        ...

    def files(self) -> Sequence[str]:
        """The launch files of the workspace, to choose from."""
        ...

    def start(self, key: str) -> Future[Answer]:
        """Start a process that has ended."""
        ...

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process as Ctrl-C does: SIGINT first, then the launch's escalation."""
        ...

    def kill(self, key: str) -> Future[Answer]:
        """Kill a process at once."""
        ...

    def restart(self, key: str) -> Future[Answer]:
        """Stop a process, then start it again."""
        ...
