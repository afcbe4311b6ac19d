"""Frozen snapshots of a ROS system, as the panes see it.

Standard library only. Times are integer nanoseconds, distances m, angles rad, speeds m/s and rad/s. A part that has
not changed since the last snapshot is the same object, so a pane redraws by comparing identity.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, IntEnum
from types import MappingProxyType
from typing import TypeAlias

from bot_console.tui.console.parameters.unit import unit_of
from bot_console.tui.console.recording import RecordingInfo
from bot_console.tui.console.robot.robot_model import DriveInfo, WorldInfo

Value: TypeAlias = "bool | int | float | str | tuple[bool | int | float | str | bytes, ...] | None"
"""A parameter's value; arrays are tuples, None is NOT_SET."""


class Kind(IntEnum):
    """Parameter types with the codes of `rcl_interfaces/msg/ParameterType`."""

    NOT_SET = 0
    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    BYTE_ARRAY = 5
    BOOL_ARRAY = 6
    INTEGER_ARRAY = 7
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9

    @property
    def word(self) -> str:
        """The type word of `ros2 param` (`double`, `string array` ...)."""
        return "boolean" if self is Kind.BOOL else self.name.lower().replace("bool_", "boolean_").replace("_", " ")


class Severity(IntEnum):
    """Log severities with the codes of `rcl_interfaces/msg/Log`."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


@dataclass(frozen=True, slots=True)
class Range:
    """A descriptor's range, both ends included; `step` 0 is continuous."""

    low: float
    high: float
    step: float = 0.0


@dataclass(frozen=True, slots=True)
class ParameterInfo:
    """One parameter of one node: its value and what its descriptor says."""

    node: str
    name: str
    kind: Kind
    value: Value
    description: str = ""
    read_only: bool = False
    dynamic: bool = False
    range: Range | None = None
    constraints: str = ""
    default: Value = None
    origin: str = ""
    """Where the value came from, in words; empty when unknown."""

    declared_at: str = ""
    """`file:line` of the declaration, whose value `default` then is; empty when unknown."""

    @property
    def unit(self) -> str:
        """The unit that ends the description in parentheses, such as `m/s`; else empty."""
        return unit_of(self.description)

    @property
    def changed(self) -> bool:
        """Whether the value differs from the default."""
        return self.value != self.default


@dataclass(frozen=True, slots=True)
class ParameterTree:
    """The parameters of one node; `problem` says why they cannot be read, empty when they can."""

    node: str
    parameters: tuple[ParameterInfo, ...] = ()
    problem: str = ""

    def get(self, name: str) -> ParameterInfo | None:
        """The parameter of that name, if the node has it."""
        return next((each for each in self.parameters if each.name == name), None)


@dataclass(frozen=True, slots=True)
class Endpoint:
    """A publisher, subscription, service server or client of a node."""

    name: str
    types: tuple[str, ...]
    qos: str = ""
    """A short text such as `reliable volatile 10`; empty when unknown."""


@dataclass(frozen=True, slots=True)
class NodeInfo:
    """A node of the ROS graph by its fully qualified name."""

    name: str
    publishers: tuple[Endpoint, ...] = ()
    subscriptions: tuple[Endpoint, ...] = ()
    services: tuple[Endpoint, ...] = ()
    clients: tuple[Endpoint, ...] = ()
    action_servers: tuple[Endpoint, ...] = ()
    action_clients: tuple[Endpoint, ...] = ()

    @property
    def hidden(self) -> bool:
        """Whether any token of the name starts with an underscore."""
        return "/_" in self.name


@dataclass(frozen=True, slots=True)
class GraphInfo:
    """The ROS graph. `unheard`: why messages do not pass; `frozen`: stopped nodes, with pids; `silent`: no answer."""

    nodes: tuple[NodeInfo, ...] = ()
    topics: tuple[Endpoint, ...] = ()
    services: tuple[Endpoint, ...] = ()
    unheard: tuple[str, ...] = ()
    frozen: tuple[tuple[str, int], ...] = ()
    silent: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One log line; `seq` counts from 0 and never repeats."""

    seq: int
    stamp: int
    severity: Severity
    node: str
    text: str
    file: str = ""
    function: str = ""
    line: int = 0


@dataclass(frozen=True, slots=True)
class LogFilter:
    """Which records to show: those of a least severity that pass the words, and how.

    `words`, as every text of `hidden` and `only`, follows one grammar in every pane: blanks mean AND, `!word` excludes,
    `re:regex`, `node:name`, `sev:>=warn`, `at:file.py:12`, `time:14:03..14:05`.
    """

    minimum: Severity = Severity.UNSET
    words: str = ""
    hidden: tuple[str, ...] = ()
    """What passes one of these is not shown."""
    only: tuple[str, ...] = ()
    """What passes none of these is not shown; empty: all is."""
    folded: bool = False
    """Whether a row of equal records is shown as one, its newest."""


@dataclass(frozen=True, slots=True)
class LogState:
    """The log as a whole: records `first` .. `end` - 1 are kept, `dropped` fell out, counts are per severity."""

    first: int = 0
    end: int = 0
    dropped: int = 0
    counts: Mapping[Severity, int] = field(default_factory=lambda: MappingProxyType({}))


class ChangeSource(str, Enum):
    """Who asked for a parameter change."""

    EDIT = "edit"
    UNDO = "undo"
    REDO = "redo"
    PROFILE = "profile"
    FILE = "file"
    HISTORY = "history"
    ROLLBACK = "taken back"
    OTHER = "elsewhere"


@dataclass(frozen=True, slots=True)
class SetOutcome:
    """What became of one value that somebody asked a node to take.

    `refused_by` is `console` (it could not even be sent), `descriptor` (range, type, read-only), `callback` (the node's
    own rule), `node` (no answer, or it has no such parameter) or empty when accepted.
    """

    node: str
    name: str
    value: Value
    accepted: bool
    reason: str = ""
    refused_by: str = ""


@dataclass(frozen=True, slots=True)
class Change:
    """A journal entry: a parameter that changed, or a change that was refused."""

    seq: int
    stamp: int
    node: str
    name: str
    old: Value
    new: Value
    source: ChangeSource
    accepted: bool = True
    reason: str = ""
    by: str = ""
    """What it was a part of: the name of a profile, of a file."""
    run: int = 0
    """The run that saw it, by its start (ns since the epoch); 0 is this one."""


@dataclass(frozen=True, slots=True)
class JournalState:
    """The change journal as a whole, numbered as the log is, and whether undo and redo have something to do.

    Changes of earlier runs are numbered below 0.
    """

    first: int = 0
    end: int = 0
    dropped: int = 0
    can_undo: bool = False
    can_redo: bool = False
    unsaved: tuple[tuple[str, str], ...] = ()
    """Node and name of each value that was set from this console and is in no file, so that it would be lost."""
    problem: str = ""
    """Why changes are not kept for later runs; empty when they are, or when that was not asked for."""


class ProcessState(str, Enum):
    """Life of a launched process."""

    STARTING = "starting"
    RUNNING = "running"
    STOPPING = "stopping"
    EXITED = "exited"
    CRASHED = "crashed"
    MISSING = "missing"
    """Its executable is not here, and the launch goes on without it."""
    ABANDONED = "abandoned"


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
    """Its share of a processor; 1.0 is one whole."""
    memory: int | None = None
    """What it holds in main memory, in MB (10^6 bytes); None where it has none of its own, as a thread has."""


@dataclass(frozen=True, slots=True)
class LaunchEvent:
    """A line of the launch timeline."""

    seq: int
    stamp: int
    text: str
    severity: Severity = Severity.INFO


@dataclass(frozen=True, slots=True)
class LaunchInfo:
    """What the launcher knows; `problem` says why a launch file could not be run, `delayed` counts starts put off."""

    files: tuple[str, ...] = ()
    processes: tuple[ProcessInfo, ...] = ()
    timeline: tuple[LaunchEvent, ...] = ()
    problem: str = ""
    delayed: int = 0


@dataclass(frozen=True, slots=True)
class LaunchArgument:
    """An argument that a launch file declares; `default` None means required."""

    name: str
    description: str = ""
    default: str | None = None
    choices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Profile:
    """A named parameter file: the values it sets by node and parameter, and the world it was made for."""

    name: str
    path: str
    title: str = ""
    values: Mapping[tuple[str, str], Value] = field(default_factory=lambda: MappingProxyType({}))
    world: str = ""
    problem: str = ""
    launch: str = ""
    """The launch file that takes the place of the running system; empty for a parameter file."""
    arguments: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    """The arguments of that launch file."""


@dataclass(frozen=True, slots=True)
class ProfileDifference:
    """What a profile would change; `refusal` says why it would be refused, empty when it would be taken.

    `unsafe` says what it takes from the robot's safety, empty when nothing.
    """

    node: str
    name: str
    now: Value
    then: Value
    refusal: str = ""
    needs_reset: bool = False
    unsafe: str = ""
    unknown: bool = False
    """Whether the node has no such parameter, so that the value is left out."""


@dataclass(frozen=True, slots=True)
class LinkInfo:
    """The link to a robot on a network: its other end (empty where there is none), and how it is."""

    to: str = ""
    delay_ms: int | None = None
    """How long an answer takes."""
    silent_s: int = 0
    """Whole seconds for which nothing was answered; what is shown is that old."""
    lost: int = 0
    """Messages that did not arrive, as far as their numbers tell."""


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What this system can tell or do; each text is empty when it can, else says why it cannot."""

    launch: str = ""
    launched_elsewhere: str = ""
    world: str = ""
    change: str = ""


@dataclass(frozen=True, slots=True)
class ConsoleSnapshot:
    """Everything the panes show, at one moment. `seq` grows when any part changed."""

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
