"""The snapshot of a whole system, the network link to it, and its capabilities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from bot_console.tui.console.bags.port import RecordingInfo
from bot_console.tui.console.model.changes import JournalState
from bot_console.tui.console.model.graph import GraphInfo
from bot_console.tui.console.model.launch import LaunchInfo
from bot_console.tui.console.model.logs import LogState
from bot_console.tui.console.model.parameters import ParameterTree
from bot_console.tui.console.model.profiles import Profile
from bot_console.tui.console.model.rates import RateCheck
from bot_console.tui.console.robot.robot_model import DriveInfo, WorldInfo


@dataclass(frozen=True, slots=True)
class LinkInfo:
    """The network link to a robot: its state, and the address of the other end (empty if there is no link)."""

    to: str = ""
    delay_ms: int | None = None
    """Round-trip time in ms."""
    silent_s: int = 0
    """Whole seconds since the last response; everything on the screen is that old."""
    lost: int = 0
    """Messages that did not arrive, according to their sequence numbers."""


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What this system supports: each text is empty if it supports something, and otherwise says why not."""

    launch: str = ""
    launched_elsewhere: str = ""
    world: str = ""
    live: str = ""
    """Show what happens now; a recording cannot."""
    change: str = ""
    """Set, send, start and end things from here."""
    bag_options: tuple[str, ...] = ()
    """Options of `bag open` with which a bag is played into this system."""


@dataclass(frozen=True, slots=True)
class ConsoleSnapshot:
    """Everything that the panes show, at one time. `seq` increases whenever any part changes."""

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
    """The profile that was applied last and not undone; empty if there is none."""
    profile_changes: int = 0
    """How many values of the active profile differ from those of the running nodes."""
    rate_checks: tuple[RateCheck, ...] = ()
    """The topics with an expected rate or age; late ones come first."""
    capabilities: Capabilities = field(default_factory=Capabilities)
    problem: str = ""
    """Why the console itself cannot continue, for instance because its thread has died; empty when all is well."""
