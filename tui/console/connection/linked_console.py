"""The console while its node connects it to a ROS system."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.recordings import Recordings
from bot_console.tui.console.connection.no_console import CLOSED, refused_profile
from bot_console.tui.console.log_protocol import LogSource, LogView
from bot_console.tui.console.logs.file import open_log
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import LogViews
from bot_console.tui.console.model import (
    Capabilities,
    Change,
    ChangeSource,
    ConsoleSnapshot,
    LogFilter,
    LoggerLevel,
    LogRecord,
    Profile,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
)
from bot_console.tui.console.node import ConsoleNode
from bot_console.tui.console.parameters.profile_store import ProfileStore
from bot_console.tui.console.parameters.profiles import cannot_apply
from bot_console.tui.console.protocol import Samples
from bot_console.tui.console.recording import Keeper, Recording
from bot_console.tui.console.robot.robot_model import Pose
from bot_console.tui.console.sensors.model import Sensors
from bot_console.tui.console.traffic import Traffic

LAST_WORD = 0.15
"""Seconds allowed for the final zero Twist, or the lock, to reach the robot before anything is shut down."""
PROFILE_STORE_POLL_S = 1.0
"""Seconds between two checks for changed profiles: editors and nodes write them, too."""


class LinkedConsole:
    """Answers queries from what the node has observed, and sends requests through it."""

    def __init__(
        self,
        node: ConsoleNode,
        logs: LogStore,
        views: LogViews,
        profile_store: ProfileStore,
        capabilities: Capabilities,
        buffer: Keeper | None = None,
    ) -> None:
        self._node = node
        self._logs = logs
        self._views = views
        self._profile_store = profile_store
        node.node.create_timer(PROFILE_STORE_POLL_S, profile_store.reload_if_changed)
        self._capabilities = capabilities
        self._recordings = Recordings(buffer)
        self._once_there: set[str] = set()
        """Profiles that were in the profile store while they were active."""

    @property
    def recording(self) -> Recording:
        """Records into bags."""
        return self._recordings

    @property
    def traffic(self) -> Traffic:
        """Topics, services and actions."""
        return self._node.traffic

    @property
    def sensors(self) -> Sensors:
        """The robot's sensor data."""
        return self._node.sensors

    def snapshot(self) -> ConsoleSnapshot:
        """What the node knows now; each unchanged part is the same object as before."""
        node = self._node
        world = node.world.info
        active = self._active_profile()
        return ConsoleSnapshot(
            graph=node.graph.info,
            parameters=node.parameters.trees,
            logs=self._logs.state,
            journal=node.journal.state,
            world=world,
            drive=node.drive.info(world),
            profiles=self._profile_store.profiles,
            active_profile=active,
            profile_changes=node.profile_changes(self._profile(active)),
            capabilities=self._capabilities,
            recording=self._recordings.info,
        )

    def _active_profile(self) -> str:
        """The active profile; empty once its file has been deleted."""
        name = self._node.setter.profile
        if self._profile(name) is not None:
            self._once_there.add(name)
        elif name in self._once_there:
            return ""
        return name

    def log(self, seq: int) -> LogRecord | None:
        """The log record of that number."""
        return self._logs.record(seq)

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """Numbers of the records that pass a filter."""
        return matching(self._logs, which, after, limit)

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Search for records that pass a filter."""
        return self._views.open(which, instead_of)

    def open_log(self, path: str) -> LogSource:
        """Read a saved log."""
        return open_log(path)

    def clear_logs(self) -> None:
        """Discard all log records."""
        self._logs.clear()

    def changes(self, after: int = 0) -> Sequence[Change]:
        """Journal entries after a number."""
        return self._node.journal.after(after)

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        """Request new values of a node's parameters."""
        return self._node.set(node, values, source, atomically=atomically)

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of several nodes, all or none."""
        return self._node.set_all(values, source, by)

    def undo(self) -> Future[Answer]:
        """Revert the last change made by this console."""
        return self._node.undo()

    def redo(self) -> Future[Answer]:
        """Repeat the last undone change."""
        return self._node.redo()

    def watch(self, path: str, requester: str = "") -> Answer:
        """Collect a series."""
        return self._node.plots.watch(path, self._node.graph.info, self._node.parameters.trees, requester)

    def unwatch(self, path: str, requester: str = "") -> None:
        """Stop collecting a series."""
        self._node.plots.unwatch(path, requester)

    def samples(self, path: str, after: int = 0) -> Samples:
        """New samples of a series."""
        return self._node.plots.samples(path, after)

    def plot_time(self, stamp: int | None = None) -> float:
        """The position of a time on the common axis of all series."""
        return self._node.plots.axis_time(stamp)

    def pose_at(self, stamp: int) -> Pose | None:
        """The robot's pose at a time."""
        return self._node.world.past.at(stamp)

    def plottable(self) -> Sequence[str]:
        """Paths that can be plotted."""
        return self._node.plots.plottable(self._node.graph.info, self._node.parameters.trees)

    def drive(self, linear: float, angular: float) -> None:
        """Send a velocity command."""
        self._node.drive.drive(linear, angular)

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop and send zero velocity, or with `hold=False` withdraw this console's stop."""
        self._node.drive.stop(hold, reason)
        if hold:
            # otherwise repeated messages would drive the robot again as soon as it is released
            self._node.traffic.stop()

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that is not processed yet."""
        self._node.drive.hold_early(press)
        self._node.traffic.stop()

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep that stop, or withdraw it if it was sent for this key press alone."""
        self._node.drive.settle_early(press, keep=keep)

    def await_standing(self, timeout_s: float) -> None:
        """Wait until the robot's locks hold it, at most this long."""
        self._node.drive.await_standing(timeout_s)

    def release(self, others: Sequence[str]) -> None:
        """Withdraw this console's stop and those of others."""
        self._node.drive.stop(False, "", others)

    def choose_robot(self, robot: str) -> None:
        """Drive another robot, and show its sensor data."""
        self._node.choose_robot(robot)

    def steer(self, hold: bool) -> None:
        """Take control of the robot, or hand it back."""
        self._node.drive.steer(hold)

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call any service."""
        return self._node.call(service, type_name, fields)

    def set_logger_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        """Set a logger's level."""
        return self._node.set_logger_level(node, severity, logger)

    def logger_levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """The levels of a node's loggers."""
        return self._node.logger_levels(node)

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        """What a profile would change."""
        profile = self._profile(name)
        return self._node.differences(profile) if profile else ()

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Set a profile's values in the running nodes."""
        profile = self._profile(name)
        why_not = f"there is no profile {name}"
        if profile is not None:
            why_not = profile.problem or cannot_apply(profile, self._node.parameters.trees)
        if profile is None or why_not:
            return refused_profile(why_not)
        return self._node.apply(profile, reset_world)

    def _profile(self, name: str) -> Profile | None:
        return next((each for each in self._profile_store.profiles if each.name == name), None)

    def open_profile(self, path: str) -> Answer:
        """Add a file as a profile."""
        return self._profile_store.open(path)

    def fetch_profile(self, address: str) -> Future[Answer]:
        """Download a parameter file and add it as a profile."""
        return self._profile_store.fetch(address)

    def save_profile(self, name: str, description: str = "") -> Answer:
        """Save the current values as a profile."""
        answer = self._profile_store.save(name, description, self._node.parameters.trees)
        if answer.ok:
            self._node.journal.saved(())
        return answer

    def rename_profile(self, name: str, to: str) -> Answer:
        """Rename a profile, including the active one."""
        answer = self._profile_store.rename(name, to)
        if answer.ok and self._node.setter.profile == name:
            self._node.setter.profile = to
        return answer

    def delete_profile(self, name: str) -> Answer:
        """Delete the file of a profile."""
        return self._profile_store.delete(name)

    def save_parameters(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Write parameters to a file."""
        return self._node.save(path, nodes, only_changed)

    def close(self) -> None:
        """Send zero velocity, then leave the ROS system; pending requests are refused."""
        self._recordings.close()
        self._views.close()
        self._node.drive.close(LAST_WORD)
        self._node.close(CLOSED)
