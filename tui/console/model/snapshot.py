"""The snapshot of a whole system, the link to it, and what it supports."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from bot_console.tui.console.model.changes import JournalState
from bot_console.tui.console.model.graph import GraphInfo
from bot_console.tui.console.model.launch import LaunchInfo
from bot_console.tui.console.model.logs import LogState
from bot_console.tui.console.model.parameters import ParameterTree
from bot_console.tui.console.model.profiles import Profile
from bot_console.tui.console.recording import RecordingInfo
from bot_console.tui.console.robot.robot_model import DriveInfo, WorldInfo


@dataclass(frozen=True, slots=True)
class LinkInfo:
    """The link to a robot on a network: the address of its other end (empty when there is no link), and its state."""

    to: str = ""
    delay_ms: int | None = None
    """How long an answer takes."""
    silent_s: int = 0
    """Whole seconds for which nothing was answered; what is shown is that old."""
    lost: int = 0
    """Messages that did not arrive, as far as their numbers tell."""


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What this system supports: each text is empty when it does, and otherwise says why it does not."""

    launch: str = ""
    launched_elsewhere: str = ""
    world: str = ""
    live: str = ""
    """To show what happens now, which a recording does not."""
    change: str = ""
    """To set, send, start and end things from here."""


@dataclass(frozen=True, slots=True)
class ConsoleSnapshot:
    """Everything the panes show, at one moment. `seq` grows whenever any part changes."""

    seq: int = 0
    stamp: int = 0
    graph: GraphInfo = field(default_factory=GraphInfo)
    parameters: Mapping[str, ParameterTree] = field(default_factory=lambda: MappingProxyType({}))
    logs: LogState = field(default_factory=LogState)
    journal: JournalState = field(default_factory=JournalState)
    world: WorldInfo = field(default_factory=WorldInfo)
    drive: DriveInfo = field(default_factory=DriveInfo)
    launch: LaunchInfo = field(default_factory=LaunchInfo)
    link: LinkInfo = field(default_factory=LinkInfo)
    recording: RecordingInfo = field(default_factory=RecordingInfo)
    profiles: tuple[Profile, ...] = ()
    active_profile: str = ""
    """The profile that was applied last and not undone; empty where there was none."""
    profile_changes: int = 0
    """How many values of the active profile the running nodes do not have."""
    capabilities: Capabilities = field(default_factory=Capabilities)
    problem: str = ""
    """Why the console itself cannot go on, for instance that its thread has died; empty when all is well."""
