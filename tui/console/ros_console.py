"""`RosConsole` serves the ports of the panes with a `ConsoleNode` in a separate thread.

Creating one is cheap: rclpy and numpy are imported in that thread, so that the first frame need not wait for them.
"""

from __future__ import annotations

import os
import threading
import time
import traceback
from collections.abc import Callable, Container, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from bot_console.tui.console.bags.port import GenericTypes, SnapshotKeeper
from bot_console.tui.console.command_gate import CLOSED
from bot_console.tui.console.launch.external_programs import ExternalPrograms
from bot_console.tui.console.model import Capabilities, LaunchInfo, LinkInfo, Severity
from bot_console.tui.console.node_ports import LABEL, NodePorts
from bot_console.tui.console.own_context import WITHOUT_LOG_FILE

if TYPE_CHECKING:
    from bot_console.tui.console.graph.type_discovery import TypeSource
    from bot_console.tui.console.graph.watch import GraphEvents, HaltedNodes
    from bot_console.tui.console.node import ConsoleNode
    from bot_console.tui.console.parameters.history_file import History
    from bot_console.tui.console.parameters.profile_store import ProfileStore
    from bot_console.tui.console.robot.drive_node import DriveNode
    from bot_console.tui.console.robot.stop_means.configured import ConfiguredMeans

T = TypeVar("T")
NOTHING_LAUNCHED = LaunchInfo()
NO_LINK = LinkInfo()
PROFILE_STORE_POLL_S = 1.0
"""Seconds between two checks for changed profiles, which editors and nodes may write as well."""
END_TIMEOUT_S = 2.0
"""Seconds that the console's thread may take to end."""


class RosConsole(NodePorts):
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
        buffer: SnapshotKeeper | None = None,
        halted: HaltedNodes | None = None,
        types: TypeSource | None = None,
        generic: GenericTypes | None = None,
        stop_means: Sequence[ConfiguredMeans] = (),
        expected: str = "",
        processes: Callable[[], Mapping[int, Sequence[str]]] = dict,
        external_programs: ExternalPrograms | None = None,
    ) -> None:
        """`own_profiles` is the folder in which profiles are saved; `workspace_profiles` finds further folders with
        profiles. `active_profile` is the name, or the absolute path, of the profile with which the system starts.

        `history` is the file that keeps parameter changes for later runs; None: they are not kept. `fetch` returns the
        local copy of a remote parameter file, or raises `OSError`; it may run in any thread.

        `link` returns the state of the network. For `foreign`, see `ConsoleNode`. `buffer` keeps the last minutes.
        `halted` returns the nodes of stopped processes. `types` builds missing message types, and `generic` provides
        classes for those without a definition. `stop_means` stop robots without a lock. `expected` is the path of a
        file with the expected rates of topics. `processes` returns the nodes of the programs on this machine, by pid;
        `external_programs` finds those started in other terminals.
        """
        super().__init__(
            self._connect_robot,
            capabilities or Capabilities(),
            launch_info=launch_info,
            link=link,
            buffer=buffer,
            types=types,
            generic=generic,
            processes=processes,
            external_programs=external_programs or ExternalPrograms(),
        )
        self._profile_store_of = profile_folders, own_profiles, workspace_profiles, fetch
        self._active_profile = active_profile
        self._graph_events, self._halted, self._stop_means = graph_events, halted, stop_means
        self._history_file, self._expected_file = history, expected
        self._foreign = foreign
        self._faults: set[str] = set()
        self._ready = threading.Event()
        self._node: ConsoleNode | None = None
        self._heard: Container[str] = ()
        self._thread = threading.Thread(target=self._serve, name="bot-console", daemon=True)
        self._closed = False
        self.learn = self.parameters.learn
        """Receives what a program or a launch reports about the origin of parameters."""

    def start(self) -> None:
        """Connect to the ROS system in the background."""
        self._thread.start()

    def _serve(self) -> None:
        try:
            # The robot comes first, so that no fault elsewhere can prevent a stop.
            node = self._join(self.drive.connect())
            if self._closed:
                self._leave(node)
                return
            self._node = node
            self.gate.open(node.executor.create_task)
            self._ready.set()
            node.spin()
        except Exception as error:  # the thread's outermost frame: the panes show why it ended
            if self._closed:
                self._leave(None)
                return
            self.problem = f"the console's link to ROS has ended: {_error_with_place(error)}"
            self.gate.close(self.problem)
            self.drive.follow_alone()
        finally:
            self._ready.set()

    def _connect_robot(self) -> DriveNode:
        import rclpy
        from bot_console.tui.console.robot.drive_node import DriveNode
        from rclpy.context import Context

        context = Context()
        rclpy.init(args=WITHOUT_LOG_FILE, context=context)
        robot = DriveNode(context, self._report_fault, self._stop_means)
        robot.start()
        return robot

    def _join(self, robot: DriveNode) -> ConsoleNode:
        """Set up everything except the connection to the robot."""
        from bot_console.tui.console.node import ConsoleNode
        from bot_console.tui.console.parameters.profile_store import ProfileStore

        self.logs.begin()
        history = self._guarded("the history", self._history)
        store = self._guarded("the profiles", self._profile_store) or ProfileStore(())
        self.profiles.attach(store)
        active = self._active_profile
        if os.path.isabs(active) and (opened := store.open(active)).ok:
            active = opened.text
        if self._expected_file and not (answer := self.topics.expect(self._expected_file)).ok:
            self.printed(Severity.WARN, LABEL, f"settings, expected: {answer.text}")
        node = ConsoleNode(
            *(robot, self, self._graph_events, history),
            active_profile=active,
            foreign=self._foreign,
            halted=self._halted,
        )
        node.node.create_timer(PROFILE_STORE_POLL_S, store.reload_if_changed)
        if self.parameters.journal.problem:
            self.printed(Severity.WARN, LABEL, self.parameters.journal.problem)
        self._heard = node.loggers
        return node

    def _guarded(self, name: str, make: Callable[[], T]) -> T | None:
        """Make a part that the console can do without; if that fails, log the error and return None."""
        try:
            return make()
        except Exception as error:
            self.printed(Severity.WARN, LABEL, f"{name} cannot be used: {_error_with_place(error)}")
            return None

    def _report_fault(self, error: Exception) -> None:
        """Log an exception in the node that stops the robot, which keeps running; equal ones are logged once."""
        text = f"an error in the connection to the robot, which stays up: {_error_with_place(error)}"
        if text not in self._faults:
            self._faults.add(text)
            self.printed(Severity.ERROR, LABEL, text)

    def _history(self) -> History | None:
        if self._history_file is None:
            return None
        from bot_console.tui.console.parameters.history_file import History

        return History(self._history_file, time.time_ns())

    def _profile_store(self) -> ProfileStore:
        from bot_console.tui.console.parameters.profile_store import ProfileStore

        folders, own, workspace, fetch = self._profile_store_of
        return ProfileStore(folders, own, workspace(), fetch)

    def wait_ready(self, timeout: float) -> bool:
        """Wait until the console has connected or has failed to; returns whether it is connected."""
        return self._ready.wait(timeout) and self._node is not None

    def record(self, stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
        """Add a log record that a process printed and that does not arrive over `/rosout`."""
        self.logs.add(stamp, severity, name, text, site)

    def heard(self, name: str) -> bool:
        """Whether any line of the logger with this name has arrived over `/rosout`."""
        return name in self._heard

    def close(self) -> None:
        """Send zero velocity, then leave the ROS system; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        self.gate.close(CLOSED)
        self.bags.close()
        self.logs.close()
        self.drive.send_last_zero()
        self._leave(self._node)
        if self._thread.is_alive():
            self._thread.join(END_TIMEOUT_S)

    def _leave(self, node: ConsoleNode | None) -> None:
        if node is not None:
            node.close()
        self.drive.leave()
        self.parameters.close()


def _error_with_place(error: Exception) -> str:
    """The error message, with the place in the source where it was raised."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{error} ({place.filename}:{place.lineno})"
