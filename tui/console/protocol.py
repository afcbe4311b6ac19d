"""The protocols between the panes and a ROS system. Standard library only.

`Console` is everything of the ROS graph, `Launcher` everything of processes. Both are read by pulling: nothing here
blocks, and no method may be called from another thread than the one that draws, except `close`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    LaunchArgument,
    LogFilter,
    LogRecord,
    LogState,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
)

if TYPE_CHECKING:
    from bot_console.tui.console.recording import Recording
    from bot_console.tui.console.robot.robot_model import Pose
    from bot_console.tui.console.sights.model import Sights
    from bot_console.tui.console.traffic import Traffic


@dataclass(frozen=True, slots=True)
class Samples:
    """New samples of a watched series: times in s (steady, from the console's start) and values, of equal length."""

    times: Sequence[float]
    values: Sequence[float]
    cursor: int
    """Give this back to receive only what came after."""
    problem: str = ""
    """Why no samples come, for instance that an array is empty; empty when all is well."""
    headers: Sequence[float] = ()
    """The times in the headers of the messages, on the same axis, NaN where there is none; empty: nowhere."""


class LogNumbers(Protocol):
    """Numbers of log records, rising."""

    def __len__(self) -> int:
        """How many there are."""
        ...

    def __getitem__(self, index: int, /) -> int:
        """The number at an index; raises `IndexError` beyond the ends."""
        ...

    def place(self, number: int) -> int:
        """The index of the first that is not below a number."""
        ...

    def count(self, index: int, /) -> int:
        """How many equal records the one at an index stands for."""
        ...


@dataclass(frozen=True, slots=True)
class LogFindings:
    """What passes a filter as far as it was looked for: in the records from `begin` to before `end`."""

    numbers: LogNumbers
    begin: int = 0
    end: int = 0
    complete: bool = False
    """Whether everything was looked at that was there when the filter was asked for."""
    problem: str = ""
    """Why nothing, or not everything, was looked at; empty when all is well."""


class LogView(Protocol):
    """The records that pass a filter, searched for beside the thread that draws, the newest first."""

    def look(self) -> LogFindings:
        """What was found so far; the same object until there is more."""
        ...


class LogSource(Protocol):
    """Records to be shown in the Logs pane: those of the system, or of a file."""

    @property
    def name(self) -> str:
        """What it is, for a heading; empty for the system."""
        ...

    @property
    def state(self) -> LogState:
        """What is kept; the same object until there is more."""
        ...

    def record(self, seq: int) -> LogRecord | None:
        """The record of that number, or None when it has fallen out or has not come yet."""
        ...

    def view(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Search for what passes a filter, and go on as records come; ends the search whose place it takes."""
        ...

    def clear(self) -> None:
        """Forget all records; numbers go on."""
        ...

    def close(self) -> None:
        """Read no more."""
        ...


@dataclass(frozen=True, slots=True)
class LoggerLevel:
    """From which severity on a logger logs; UNSET: from that of its parent on."""

    node: str
    logger: str
    severity: Severity


class ConsoleReading(Protocol):
    """What is known of a ROS system."""

    def snapshot(self) -> ConsoleSnapshot:
        """The newest snapshot; unchanged parts are the same objects as before."""
        ...

    def log(self, seq: int) -> LogRecord | None:
        """The record of that number, or None when it has fallen out or has not come yet."""
        ...

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """Numbers, rising, of the kept records from `after` on that pass the filter; with a limit the newest ones.

        Raises `ValueError` with a readable text for a regular expression that does not compile.
        """
        ...

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Search for what passes a filter, and go on as records come; ends the search whose place it takes."""
        ...

    def open_log(self, path: str) -> LogSource:
        """Read a saved log, and go on as it grows; raises `ValueError` with the reason where that cannot be done."""
        ...

    def changes(self, after: int = 0) -> Sequence[Change]:
        """Journal entries numbered `after` and up, oldest first; those of earlier runs are numbered below 0."""
        ...

    def samples(self, path: str, after: int = 0) -> Samples:
        """Samples of a watched series from cursor `after` on."""
        ...

    def plot_time(self, stamp: int | None = None) -> float:
        """Where a moment (ns since the epoch; None is now) lies on the time axis of all series, in s."""
        ...

    def pose_at(self, stamp: int) -> Pose | None:
        """Where the robot was at a moment (ns since the epoch); None where that is not known."""
        ...

    def plottable(self) -> Sequence[str]:
        """Paths that `watch` takes, for completion."""
        ...

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        """What applying a profile would change now."""
        ...


class Console(ConsoleReading, Protocol):
    """A ROS system as the panes see it: what is known of it, and what can be asked of it."""

    @property
    def recording(self) -> Recording:
        """Records it into bags."""
        ...

    @property
    def traffic(self) -> Traffic:
        """Its topics, services and actions, as a person uses them."""
        ...

    @property
    def sights(self) -> Sights:
        """What it shows of itself: its diagnostics."""
        ...

    def clear_logs(self) -> None:
        """Forget all records; numbers go on."""
        ...

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Ask a node to take values, as `SetParameters` (or `SetParametersAtomically`) does."""
        ...

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        """Ask nodes to take values (by node and name), all of them or none; one undo takes all back.

        `by` names what they are a part of. Where one is refused, nodes that had taken theirs are put back, and each
        outcome says why; a value that could not be put back has `accepted` and a reason.
        """
        ...

    def undo(self) -> Future[Answer]:
        """Put back the value before the last accepted change made from this console."""
        ...

    def redo(self) -> Future[Answer]:
        """Make the last undone change again."""
        ...

    def watch(self, path: str, asker: str = "") -> Answer:
        """Collect a series, for as long as any asker wants it; says in words why it cannot be plotted.

        `/topic/field.sub[2]`, `/topic/array[2:8].mean()` (or min, max, sum, std, len; yaw of a quaternion), or
        `/node:parameter`.
        """
        ...

    def unwatch(self, path: str, asker: str = "") -> None:
        """For one asker, who wants it no more; a series that nobody wants is forgotten."""
        ...

    def drive(self, linear: float, angular: float) -> None:
        """Send a velocity command (m/s, rad/s) now; the pane repeats it. Refused silently while all-stop holds.

        Raises `ValueError` for NaN and infinity.
        """
        ...

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop, or take this console's stop back, and send zero velocity now.

        A robot that others have stopped as well stays locked until their stops are released.
        `DriveInfo.stop_confirmed` tells when it has been acknowledged. A robot that has none gets zeros while held.
        May be called from any thread.
        """
        ...

    def release(self, others: Sequence[str]) -> None:
        """Take back this console's stop, and those of others by the keys in `DriveInfo.stops`."""
        ...

    def choose_robot(self, robot: str) -> None:
        """Steer another one of `DriveInfo.robots`; an all-stop is for all of them."""
        ...

    def steer(self, hold: bool) -> None:
        """Hold the steering, so that only a person's commands count, or hand it back.

        While held it is said again at least every 0.5 s; a silent console that holds the steering locks the robot.
        """
        ...

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call any service with the given request fields."""
        ...

    def set_logger_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        """Set the level of a node's logger live, or of a child of it; UNSET is that of its parent."""
        ...

    def logger_levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """The levels of a node's logger and of its children that have logged; raises `ValueError` with the reason."""
        ...

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Set a profile's values live, all or nothing. It is the active one when nothing was refused; a launch profile
        that has been launched has no values, and is the active one.

        The future raises `ValueError`, with the reason, for a profile that is not there or cannot be used.
        """
        ...

    def open_profile(self, path: str) -> Answer:
        """Take a file in as a profile, so that it is seen what it would change; the text is its name, or why not."""
        ...

    def fetch_profile(self, address: str) -> Future[Answer]:
        """Take in what stands at an address (`https://`) as a profile; the text is its name, or why not."""
        ...

    def save_profile(self, name: str, description: str = "") -> Answer:
        """Save all that runs as a profile of the user's, under a name and with a line on what it is for."""
        ...

    def rename_profile(self, name: str, to: str) -> Answer:
        """Give a profile of the user's another name; refused for others, and where the name is taken."""
        ...

    def delete_profile(self, name: str) -> Answer:
        """Delete the file of a profile of the user's; refused for others."""
        ...

    def save_parameters(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Write a true ROS parameter file; an existing file keeps its comments.

        With `only_changed` it holds what differs from the declared values, else from the start values.
        """
        ...

    def close(self) -> None:
        """Send zero velocity, stop and join everything; a second call does nothing.

        What is known stays readable. Whatever is or was asked for is refused, so no future is left without an answer.
        """
        ...


class Stream(Protocol):
    """A line that goes on until it is stopped."""

    def lines(self) -> Sequence[str]:
        """The last lines it has printed; the same object until there are more."""
        ...

    @property
    def ended(self) -> bool:
        """Whether nothing more comes."""
        ...

    def stop(self) -> None:
        """Interrupt it, as Ctrl-C does."""
        ...


class CommandLine(Protocol):
    """Runs `ros2 ...` lines."""

    def run(self, line: str) -> Future[str]:
        """Run a line and give what it printed."""
        ...

    def stream(self, line: str) -> Stream | None:
        """Begin a line that goes on by itself, as `ros2 topic hz /odom` does; None for any other, which is not run."""
        ...

    def commands(self) -> Sequence[str]:
        """The words that a line may begin with, `ros2` itself left out."""
        ...

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        """What the last of the words may become, which is empty or begins an option; `snapshot` knows what runs."""
        ...


class Launcher(Protocol):
    """The processes that launch files started; what it knows is in `ConsoleSnapshot.launch`."""

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run one more launch file."""
        ...

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments a launch file declares; raises `ValueError` with the file and line when it cannot be read.

        A launch file is a program that may take its time, so this one method may be called from any thread.
        """
        ...

    def files(self) -> Sequence[str]:
        """Launch files of the workspace, for the picker."""
        ...

    def start(self, key: str) -> Future[Answer]:
        """Start an ended process again."""
        ...

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process as Ctrl-C does, with the launch's escalation."""
        ...

    def kill(self, key: str) -> Future[Answer]:
        """End a process at once."""
        ...

    def restart(self, key: str) -> Future[Answer]:
        """Stop, then start."""
        ...
