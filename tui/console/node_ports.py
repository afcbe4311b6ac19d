"""The ports of a console that has a ROS node, and the snapshot composed from them."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING

from bot_console.tui.console.bags.node_bags import NodeBags
from bot_console.tui.console.bags.port import GenericTypes, SnapshotKeeper
from bot_console.tui.console.command_gate import READ_ONLY, Gate
from bot_console.tui.console.graph.node_graph import NodeGraph
from bot_console.tui.console.launch.external_programs import ExternalPrograms
from bot_console.tui.console.launch.gated_launcher import GatedLauncher
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.logs.node_logs import NodeLogs
from bot_console.tui.console.model import Capabilities, ConsoleSnapshot, LaunchInfo, LinkInfo, Severity
from bot_console.tui.console.parameters.node_parameters import NodeParameters
from bot_console.tui.console.parameters.node_profiles import NodeProfiles
from bot_console.tui.console.parameters.provenance import Provenance
from bot_console.tui.console.plot.node_plots import NodePlots
from bot_console.tui.console.robot.robot_drive import RobotDrive
from bot_console.tui.console.sensors.node_sensors import NodeSensors
from bot_console.tui.console.topics.node_topics import NodeTopics

if TYPE_CHECKING:
    from bot_console.tui.console.graph.type_discovery import TypeSource
    from bot_console.tui.console.robot.drive_node import DriveNode

NOWHERE = ("", "", 0)
LABEL = "bot-console"


class NodePorts:
    """All ports of a console. They exist before the node does; `ConsoleNode` attaches them to the node."""

    def __init__(
        self,
        connect_robot: Callable[[], DriveNode],
        capabilities: Capabilities,
        *,
        launch_info: Callable[[], LaunchInfo],
        link: Callable[[], LinkInfo],
        buffer: SnapshotKeeper | None,
        types: TypeSource | None,
        generic: GenericTypes | None,
        processes: Callable[[], Mapping[int, Sequence[str]]],
        external_programs: ExternalPrograms,
    ) -> None:
        self.gate = Gate()
        self._capabilities = capabilities
        self._launch_info = launch_info
        self._external_programs = external_programs
        self._link = link
        self.problem = ""
        """Why the console itself cannot continue; empty when all is well."""
        provenance = Provenance(self._profile_at)
        self.start_values = provenance.starts
        self.logs = NodeLogs(self.gate)
        self.graph = NodeGraph(
            self.gate,
            launch_info,
            lambda: self.parameters.trees,
            processes,
            lambda: self.logs.state.end,
            self.logs.complaint,
        )
        self.topics = NodeTopics(self.gate, lambda: self.graph.info, types)
        self.drive = RobotDrive(
            self.gate,
            connect_robot,
            network=link,
            on_stop=self.topics.stop,
            report=lambda text: self.printed(Severity.WARN, LABEL, text),
        )
        self.plots = NodePlots(self.gate, lambda: self.graph.info, lambda: self.parameters.trees)
        self.parameters = NodeParameters(self.gate, provenance, self.plots.record_parameter)
        self.profiles = NodeProfiles(
            self.gate, self.parameters, lambda: self.topics.request("/reset", "std_srvs/srv/Trigger", {})
        )
        self.sensors = NodeSensors(self.gate, lambda: self.graph.info)
        self.bags = NodeBags(self.gate, buffer, generic)
        self.launcher: Launcher | None = None
        self._by_path: tuple[object, dict[str, str]] = (), {}
        self._snapshot = ConsoleSnapshot(capabilities=capabilities)

    def attach_launcher(self, launcher: Launcher) -> None:
        """Make this console's launcher available to the panes."""
        self.launcher = GatedLauncher(self.gate, launcher)

    def refuse_changes(self) -> None:
        """Make the console read-only; it can still stop the robot."""
        self.gate.read_only = READ_ONLY
        self._capabilities = replace(self._capabilities, change=READ_ONLY)

    def link_delay(self) -> float:
        """The latest round-trip time of the link to the robot, in s; 0 if it is unknown, or there is no link."""
        return (self._link().delay_ms or 0) / 1000

    def _profile_at(self, path: str) -> str:
        """The name of the profile with that path; empty if there is none."""
        if self._by_path[0] is not self.profiles.all:
            self._by_path = self.profiles.all, {os.path.realpath(each.path): each.name for each in self.profiles.all}
        return self._by_path[1].get(os.path.realpath(path), "")

    def printed(self, severity: int, label: str, text: str) -> None:
        """Add a line that a process printed to the log."""
        self.logs.add(time.time_ns(), severity, label, text, NOWHERE)

    def snapshot(self) -> ConsoleSnapshot:
        """The newest snapshot; the same object if nothing has changed. Unchanged parts stay the same objects."""
        old = self._snapshot
        world, launch = self.drive.world, self._launch_info()
        self.logs.discount_errors_of_ending(launch)
        launch = self._external_programs.merged_with(launch)
        new = ConsoleSnapshot(
            seq=old.seq,
            graph=self.graph.info,
            parameters=self.parameters.trees,
            logs=self.logs.state,
            journal=self.parameters.journal,
            world=world,
            drive=self.drive.info(world),
            launch=launch,
            link=self._link(),
            recording=self.bags.info,
            profiles=self.profiles.all,
            active_profile=self.profiles.active,
            profile_changes=self.profiles.changes,
            rate_checks=self.topics.rate_checks.poll(self.profiles.active_profile, self.parameters.trees),
            capabilities=self._capabilities,
            problem=self.problem,
        )
        if not all(_is_same(getattr(old, each.name), getattr(new, each.name)) for each in fields(new)):
            self._snapshot = replace(new, seq=old.seq + 1)
        return self._snapshot


def _is_same(old: object, new: object) -> bool:
    """Whether a part is the same object, or an equal text or number."""
    return new is old or (isinstance(new, (str, int)) and new == old)
