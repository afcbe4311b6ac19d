"""Launched processes as the panes see them, the timeline of a launch, and the arguments of a launch file."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from bot_console.tui.console.model.logs import Severity


class ProcessState(str, Enum):
    """The life cycle of a launched process."""

    STARTING = "starting"
    RUNNING = "running"
    STOPPING = "stopping"
    EXITED = "exited"
    CRASHED = "crashed"
    MISSING = "missing"
    """Its executable was not found, and the launch continues without it."""
    ABANDONED = "abandoned"


@dataclass(frozen=True, slots=True)
class Program:
    """The program of a process: its command without the prefix, and the options with which launch runs it."""

    command: tuple[str, ...]
    package: str = ""
    """The package of the program; empty if its path suffices."""
    prefix: str = ""
    folder: str = ""
    """The working directory; empty for that of the launch."""
    respawn: bool = False
    respawn_delay: float | None = None
    """Seconds before launch respawns it."""


@dataclass(frozen=True, slots=True)
class ProcessInfo:
    """A process that a launch file started. `group` is its path of launch files and groups, outermost first."""

    key: str
    label: str
    state: ProcessState
    pid: int | None = None
    nodes: tuple[str, ...] = ()
    group: tuple[str, ...] = ()
    restarts: int = 0
    exit_code: int | None = None
    problem: str = ""
    cpu: float | None = None
    """Its CPU usage; 1.0 is one whole CPU."""
    memory: int | None = None
    """Its resident memory in MB (10^6 bytes); None if it has no memory of its own, like a thread."""
    started: int = 0
    """When it last started, in ns since the epoch; 0 if never. The next two are likewise."""
    end_requested: int = 0
    """When its end was last requested, by a person or by the end of its launch."""
    ended: int = 0
    """When it last ended."""
    restart_policy: str = ""
    """When it is restarted after it has ended by itself, in words; empty: never, or as its launch file says."""
    program: Program | None = None
    """None if unknown, for instance with a launch host of an earlier version."""
    started_by: str = ""
    """The command in another terminal that has started it and alone can end it; empty: it is controlled from here."""


@dataclass(frozen=True, slots=True)
class LaunchEvent:
    """A line of the launch timeline."""

    seq: int
    stamp: int
    text: str
    severity: Severity = Severity.INFO


@dataclass(frozen=True, slots=True)
class LaunchInfo:
    """The state of the launcher: `problem` says why a launch file could not be run, `delayed` is the number of starts
    that timers delay.
    """

    files: tuple[str, ...] = ()
    processes: tuple[ProcessInfo, ...] = ()
    timeline: tuple[LaunchEvent, ...] = ()
    problem: str = ""
    delayed: int = 0


@dataclass(frozen=True, slots=True)
class LaunchArgument:
    """An argument that a launch file declares; it is required if `default` is None."""

    name: str
    description: str = ""
    default: str | None = None
    choices: tuple[str, ...] = ()
