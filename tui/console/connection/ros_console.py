"""`RosConsole`: the `Console` protocol over a `ConsoleNode` in a separate thread.

Creating one is cheap: rclpy and numpy are imported in the thread, so that the first frame need not wait for them.
Until then, and after it was closed, a `NoConsole` takes the place of the `LinkedConsole`.
"""

from __future__ import annotations

import os
import threading
import time
import traceback
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from bot_console.tui.console.connection.console_relay import ConsoleRelay
from bot_console.tui.console.connection.no_console import CLOSED, STARTING, NoConsole, NothingKnown
from bot_console.tui.console.model import (
    Capabilities,
    ConsoleSnapshot,
    LaunchInfo,
    LinkInfo,
    Severity,
    Value,
)
from bot_console.tui.console.parameters.provenance import Learn, Provenance
from bot_console.tui.console.recording import Keeper
from bot_console.tui.console.robot.robot_model import DriveInfo

if TYPE_CHECKING:
    from bot_console.tui.console.connection.linked_console import LinkedConsole
    from bot_console.tui.console.graph.type_discovery import TypeSource
    from bot_console.tui.console.graph.watch import FrozenNodes, GraphEvents
    from bot_console.tui.console.launch.process_output import Add
    from bot_console.tui.console.logs.view import LogViews
    from bot_console.tui.console.node import ConsoleNode
    from bot_console.tui.console.parameters.history import History
    from bot_console.tui.console.parameters.profile_store import ProfileStore
    from bot_console.tui.console.robot.drive_node import DriveNode
    from bot_console.tui.console.robot.stop_means.configured import ConfiguredMeans

T = TypeVar("T")
NOWHERE = ("", "", 0)
LABEL = "bot-console"
NOTHING_LAUNCHED = LaunchInfo()
NO_LINK = LinkInfo()
NOT_YET = DriveInfo(
    stopped=True,
    stopped_here=True,
    unsent="the console is still connecting; the stop is sent as soon as it is connected",
)
NOT_CONNECTED = DriveInfo(
    stopped=True, stopped_here=True, unsent="this console is not connected; run bot-console stop in another terminal"
)


class RosConsole(ConsoleRelay):
    """The ROS system as the panes see it."""

    def __init__(
        self,
        *,
        launch_info: Callable[[], LaunchInfo] = lambda: NOTHING_LAUNCHED,
        profile_folders: Sequence[Path] = (),
        own_profiles: Path | None = None,
        workspace_profiles: Callable[[], Sequence[Path]] = lambda: (),
        active_profile: str = "",
        capabilities: Capabilities | None = None,
        graph_events: GraphEvents | None = None,
        history: Path | None = None,
        link: Callable[[], LinkInfo] = lambda: NO_LINK,
        foreign: bool = False,
        fetch: Callable[[str], Path] | None = None,
        buffer: Keeper | None = None,
        frozen: FrozenNodes | None = None,
        types: TypeSource | None = None,
        stop_means: Sequence[ConfiguredMeans] = (),
    ) -> None:
        """`own_profiles` is where profiles are saved; `workspace_profiles` finds further folders with profiles;
        `active_profile` is the name, or the absolute path, of the one with which the system starts.

        `history` is the file that keeps parameter changes for later runs; None: they are not kept. `fetch` returns the
        local copy of a remote parameter file, or raises `OSError`; it may run in any thread.

        `link` returns the state of the network; `foreign`: see `ConsoleNode`; `buffer` keeps the last minutes; `frozen`
        returns nodes of stopped processes; `types` builds missing message types; `stop_means` stop robots without lock.
        """
        self._profile_store_of = profile_folders, own_profiles, workspace_profiles, fetch
        self._launch_info = launch_info
        self._active_profile = active_profile
        self._capabilities = capabilities or Capabilities()
        self._graph_events, self._frozen, self._types, self._stop_means = graph_events, frozen, types, stop_means
        self._history_file = history
        self._link = link
        self._foreign = foreign
        self._buffer = buffer
        self._zeroed = False
        # Reentrant: a signal that ends the console stops the robot too, even during a stop.
        self._linking = threading.RLock()
        self._early_stop: tuple[bool, str] | None = None
        """The newest stop, or release, requested before the console was connected."""
        self._early_presses: set[str] = set()
        self._problem = ""
        self._faults: set[str] = set()
        self._robot: DriveNode | None = None
        """The node that stops the robot, whatever else works."""
        self._ready = threading.Event()
        self._linked: LinkedConsole | None = None
        self._thread = threading.Thread(target=self._serve, name="bot-console", daemon=True)
        self._closed = False
        self._snapshot = ConsoleSnapshot(capabilities=self._capabilities)
        self._views: LogViews | None = None
        self._add: Add = _nobody_reads
        self._heard: Container[str] = ()
        self._profile_names: dict[str, str] = {}
        self._provenance = Provenance(lambda path: self._profile_names.get(os.path.realpath(path), ""))
        self._learn: Learn = self._provenance.learn  # what is reported before the node exists is passed to it, too
        self._nothing = NothingKnown(self._snapshot, lambda which: self._views.open(which) if self._views else None)
        super().__init__(NoConsole(STARTING, self._nothing))

    def start(self) -> None:
        """Connect to the ROS system, in the background."""
        self._thread.start()

    def _serve(self) -> None:
        robot: DriveNode | None = None
        node: ConsoleNode | None = None
        try:
            robot = self._reach_robot()
            node, self._linked = self._join(robot)
            if self._closed:
                self._now = NoConsole(CLOSED, self._linked)
                node.close(CLOSED)
                return
            with self._linking:
                self._now = self._linked
            self._ready.set()
            node.spin()
        except Exception as error:  # the thread's outermost frame: the panes show what ended it
            self._problem = f"the console's link to ROS has ended: {_placed(error)}"
            self._only_stop(robot, node)
        finally:
            self._ready.set()

    def _reach_robot(self) -> DriveNode:
        """Connect to the robot's stop: first, so that no fault elsewhere can prevent a stop."""
        import rclpy
        from bot_console.tui.console.connection.stop_console import StopConsole
        from bot_console.tui.console.robot.drive_node import DriveNode
        from rclpy.context import Context

        context = Context()
        rclpy.init(args=[], context=context)
        robot = DriveNode(context, self._report_fault, self._stop_means)
        robot.start()
        with self._linking:
            self._now = StopConsole(STARTING, self._nothing, robot)
            self._robot = robot
            if self._early_stop is not None:
                robot.link.stop(*self._early_stop)
            for each in self._early_presses:
                robot.link.hold_early(each)
        return robot

    def _join(self, robot: DriveNode) -> tuple[ConsoleNode, LinkedConsole]:
        """Set up everything else."""
        from bot_console.tui.console.connection.linked_console import LinkedConsole
        from bot_console.tui.console.logs.store import LogStore
        from bot_console.tui.console.logs.view import LogViews
        from bot_console.tui.console.node import ConsoleNode
        from bot_console.tui.console.parameters.profile_store import ProfileStore

        logs = LogStore()
        self._add = logs.add
        self._views = LogViews(logs)
        history = self._guarded("the history", self._history)
        profile_store = self._guarded("the profiles", self._profile_store) or ProfileStore(())
        active = self._active_profile
        if os.path.isabs(active) and (opened := profile_store.open(active)).ok:
            active = opened.text
        self._profile_names = {os.path.realpath(each.path): each.name for each in profile_store.profiles}
        node = ConsoleNode(
            *(robot, logs.add, self._graph_events, self._provenance, history),
            foreign=self._foreign,
            frozen=self._frozen,
            types=self._types,
        )
        if node.journal.state.problem:
            self._warn(node.journal.state.problem)
        self._learn = node.learn
        node.setter.profile = active
        self._heard = node.loggers
        return node, LinkedConsole(node, logs, self._views, profile_store, self._capabilities, self._buffer)

    def _guarded(self, name: str, make: Callable[[], T]) -> T | None:
        """Make a part that the console can do without; if that fails, log it and return None."""
        try:
            return make()
        except Exception as error:
            self._warn(f"{name} cannot be used: {_placed(error)}")
            return None

    def _warn(self, text: str) -> None:
        self._add(time.time_ns(), Severity.WARN, LABEL, text, NOWHERE)

    def _report_fault(self, error: Exception) -> None:
        """Log an exception of the node that stops the robot, which keeps running; the same one is logged once."""
        text = f"an error in the connection to the robot, which stays up: {_placed(error)}"
        if text not in self._faults:
            self._faults.add(text)
            self._add(time.time_ns(), Severity.ERROR, LABEL, text, NOWHERE)

    def _only_stop(self, robot: DriveNode | None, node: ConsoleNode | None) -> None:
        """Keep running what can still stop the robot, after everything else has failed."""
        if robot is None:
            self._now = NoConsole(self._problem, self._nothing)
            return
        from bot_console.tui.console.connection.stop_console import StopConsole

        if node is not None:
            node.calls.close(self._problem)
        elif not self._closed:
            self._now = StopConsole(self._problem, self._nothing, robot)
        robot.follow_alone()

    def _history(self) -> History | None:
        if self._history_file is None:
            return None
        from bot_console.tui.console.parameters.history import History

        return History(self._history_file, time.time_ns())

    def _profile_store(self) -> ProfileStore:
        from bot_console.tui.console.parameters.profile_store import ProfileStore

        folders, own, workspace, fetch = self._profile_store_of
        return ProfileStore(folders, own, workspace(), fetch)

    def wait_ready(self, timeout: float) -> bool:
        """Wait until the console is connected or has failed to; returns whether it is connected."""
        return self._ready.wait(timeout) and self._linked is not None

    def record(self, stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
        """Add a log record that a process printed and that does not come over `/rosout`."""
        self._add(stamp, severity, name, text, site)

    def heard(self, name: str) -> bool:
        """Whether any line of the logger with that name has come over `/rosout`."""
        return name in self._heard

    def learn(self, kind: str, facts: Mapping[str, Any]) -> None:
        """Receive what a program or a launch reports about the origin of parameters."""
        self._learn(kind, facts)

    def start_values(self) -> Mapping[tuple[str, str], Value]:
        """The start values that nodes have reported, by node and parameter."""
        return self._provenance.starts()

    def printed(self, severity: int, label: str, text: str) -> None:
        """Receive a line that a process printed."""
        self._add(time.time_ns(), severity, label, text, NOWHERE)

    def snapshot(self) -> ConsoleSnapshot:
        """The newest snapshot; the same object when nothing changed."""
        old = self._snapshot
        launch, link = self._launch_info(), self._link()
        if not link.silent_s:
            self._zero_again()
        now = self._now.snapshot()
        if self._unsent:
            now = replace(now, drive=NOT_CONNECTED if self._problem else NOT_YET)
        new = replace(now, seq=old.seq, launch=launch, link=link, problem=self._problem)
        if not _same(old, new):
            self._snapshot = replace(new, seq=old.seq + 1)
        return self._snapshot

    def drive(self, linear: float, angular: float) -> None:
        """Send a velocity command."""
        if not self._link().silent_s:
            self._zero_again()
            super().drive(linear, angular)
        elif not self._zeroed:
            # Commands queued while the link is cut arrive late: the last of them has to be a zero.
            self._zeroed = True
            super().drive(0.0, 0.0)

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Stop the robot, or withdraw the stop; before the console is connected, the request is kept until it is."""
        with self._linking:
            if self._robot is None:
                self._early_stop = (hold, reason)
            super().all_stop(hold, reason)

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that is not processed yet; kept until the console is connected."""
        with self._linking:
            if self._robot is None:
                self._early_presses.add(press)
            super().hold_early(press)

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep that stop, or withdraw it if it was sent for this key press alone."""
        with self._linking:
            self._early_presses.discard(press)
            super().settle_early(press, keep=keep)

    @property
    def _unsent(self) -> bool:
        """Whether a stop was requested that could not be sent."""
        stopped = self._early_stop is not None and self._early_stop[0]
        return self._robot is None and (stopped or bool(self._early_presses))

    def await_standing(self, timeout_s: float) -> None:
        """Wait until a stop holds the robot, at most this long; returns at once when there is no connection."""
        if self._robot is not None:
            self._robot.link.await_standing(timeout_s)

    def _zero_again(self) -> None:
        """Repeat the zero velocity after a long silence, in which queued messages were lost."""
        if self._zeroed:
            self._zeroed = False
            super().drive(0.0, 0.0)

    def close(self) -> None:
        """Send zero velocity, then leave the ROS system; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        before, self._now = self._now, NoConsole(CLOSED, self._now)
        before.close()
        if self._thread.is_alive():
            self._thread.join(2.0)


def _placed(error: Exception) -> str:
    """The error message, with the place in the source where it was raised."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{error} ({place.filename}:{place.lineno})"


def _nobody_reads(stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
    """Discard a record that arrives before there is a log."""


def _parts(snapshot: ConsoleSnapshot) -> dict[str, object]:
    return {name: getattr(snapshot, name) for name in snapshot.__dataclass_fields__}


def _same(old: ConsoleSnapshot, new: ConsoleSnapshot) -> bool:
    """Whether every part is the same object, or an equal text or number."""
    parts = _parts(new)
    return all(value is getattr(old, name) or (isinstance(value, (str, int)) and value == getattr(old, name))
               for name, value in parts.items() if name not in ("seq", "stamp"))  # fmt: skip
