"""The parts of a console that has a system, and the launch that belongs to it; imported after the first frame."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from bot_console.tui.arrangement.startup import System
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.tune.background_tuner import LocalTuner
from bot_console.tui.console.bags.port import SnapshotKeeper
from bot_console.tui.console.launch.external_programs import ExternalPrograms
from bot_console.tui.console.model import LaunchInfo, Severity
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.files.folders import config_folder, state_folder
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.session import robot_starter
from bot_console.tui.session.composition import embedded_launcher, node_process
from bot_console.tui.session.embedded.domain import nodes_there, socket_folder
from bot_console.tui.session.embedded.hooks import (
    DomainTypes,
    graph_events,
    halted_nodes,
    local_parameter_file,
    node_processes,
    take_over_streams,
)
from bot_console.tui.session.embedded.process_report_lines import log_process_reports
from bot_console.tui.session.embedded.ros2_command_line import Ros2CommandLine
from bot_console.tui.session.embedded.vitals import find_vitals
from bot_console.tui.session.embedded.workspaces import SIMULATOR_LAUNCH, SYSTEM_LAUNCH, config_folders
from bot_console.tui.session.launch_host.address import host_addresses, pid_of_address
from bot_console.tui.session.plugins import find_plugins
from bot_console.tui.session.protocol import ClosableLauncher
from bot_console.tui.session.robot_starter import RobotProcess
from bot_console.tui.settings.settings import read_settings

ROOT = Path(__file__).resolve().parents[2]
LAST_MESSAGE_TIMEOUT_S = 0.2
"""Seconds allowed for a robot to acknowledge its stop, or to receive its last zero, before anything is shut down."""
READY_TIMEOUT_S = 20.0
HISTORY = "history.sqlite"
"""The database of the parameter changes of all runs, in the user's state folder."""


class ConnectedParts:
    """The console and its launcher, and the system that it starts."""

    def __init__(
        self,
        options: Options,
        message: Sequence[tuple[Severity, str]] = (),
        system: Callable[[RosConsole], ClosableLauncher] = embedded_launcher,
        buffer: SnapshotKeeper | None = None,
    ) -> None:
        """`message` contains early lines for the log; `system` makes the launcher, in this process by default.

        `buffer` keeps the last minutes.
        """
        self._options = options
        self._last_message = message
        self._watching: RobotProcess | None = None
        self._forget_notices: Callable[[], None] = lambda: None
        settings = read_settings()
        self.console = RosConsole(
            launch_info=self._launch_info,
            profile_folders=[ROOT / "profiles", *options.profile_folders],
            active_profile="" if options.launch or options.attach else options.profile_file or options.profile,
            graph_events=graph_events,
            halted=halted_nodes,
            history=state_folder() / HISTORY,
            own_profiles=config_folder() / "profiles",
            workspace_profiles=config_folders,
            fetch=local_parameter_file,
            buffer=buffer,
            types=DomainTypes(),
            generic=DomainTypes(),
            stop_means=settings.stop_means,
            expected=settings.expected,
            processes=node_processes,
            external_programs=ExternalPrograms(node_processes, find_vitals, self._other_hosts),
        )
        self.launcher = system(self.console)
        self._local_tuner = LocalTuner()
        self.tuner = None if options.read_only else self._local_tuner

    def _other_hosts(self) -> list[int]:
        """The pids of the launch hosts that this console reaches, whose processes it can control."""
        return [pid_of_address(each) for each in host_addresses(socket_folder())] if self._options.attach else []

    def _launch_info(self) -> LaunchInfo:
        return self.launcher.info()

    def begin(self) -> System:
        """Start connecting, and start the system once connected; returns the services for the panes."""
        take_over_streams()
        self.console.start()
        threading.Thread(target=self._launch, name="start", daemon=True).start()
        self.console.attach_launcher(self.launcher)
        if self._options.read_only:
            self.console.refuse_changes()
        return System(self.console, Ros2CommandLine(self.launcher))

    def plugins(self) -> Sequence[PaneEntry]:
        """The panes of other packages."""
        return find_plugins()

    def _launch(self) -> None:
        """Start the system once the console is connected, so that not even the first log line is lost."""
        if not self.console.wait_ready(READY_TIMEOUT_S):
            return
        self._forget_notices = log_process_reports(self.console.printed, self.console.learn)
        options = self._options
        for severity, line in self._last_message:
            self.console.printed(severity, "bot-console", line)
        if options.attach:
            return
        if options.launch:
            others = len(nodes_there())
            self.launcher.launch(options.launch, options.launch_arguments)
            system = robot_starter.System(self._processes, self._report, self._start_robot, others)
            self._watching = robot_starter.begin(options, system, node_process)
            return
        arguments = {**options.profile_arguments, **robot_starter.arguments(options), **options.launch_arguments}
        self.launcher.launch(SYSTEM_LAUNCH, arguments)

    def _report(self, text: str) -> None:
        self.console.printed(Severity.INFO, "bot-console", text)

    def _start_robot(self, arguments: Mapping[str, str]) -> None:
        self.launcher.launch(SIMULATOR_LAUNCH, arguments)

    def _processes(self) -> tuple[int, int]:
        return robot_starter.processes(self.launcher.info())

    def close(self) -> None:
        """Send zero velocity, end the launched processes, then leave the graph.

        A robot that this console only attached to keeps running. If this console steers it, leaving the graph locks it.
        """
        if not self._options.attach:
            self.console.drive.stop(True, "bot-console was quit")
            self.console.drive.await_held(LAST_MESSAGE_TIMEOUT_S)
            # Otherwise its silence would count as a stop, which the robot would still have at its next start.
            self.console.drive.steer(False)
        if self._watching is not None:
            self._watching.stop()
        self.launcher.close()
        self._local_tuner.close()
        self._forget_notices()
        self.console.close()  # Its zero is the last command to a robot that outlives this program.
