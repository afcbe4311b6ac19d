"""A student's activity, which conditions ask for: in the system and on its domain's command lines. Pure."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from bot_console.tui.console.model import RESTARTED, Change, ConsoleSnapshot, ParameterInfo
from bot_console.tui.learn.command_log import Command
from bot_console.tui.text.value_text import value_text

MAX_STEP_M = 1.0
"""A greater distance between two snapshots does not count as driven: the robot was placed somewhere else."""

PRINT_OPTIONS = frozenset(
    ("-h", "--help", "-p", "--print", "--print-description", "-s", "--show-args", "--show-arguments")
)
"""Options with which `launch` only prints something."""

REFUSED = "Setting parameter failed"
"""The beginning of `param set`'s message when the node refuses a value."""


class LaunchRecord(NamedTuple):
    """A launch file of the workspace that was launched: its path in the workspace, and its text at that time.

    `command` is the index of the command line that launched it; -1 if it was started from the Launch pane.
    """

    file: str
    text: str
    command: int = -1


@dataclass
class Activity:
    """Everything seen since the lesson was opened; nothing is ever removed."""

    nodes: set[str] = field(default_factory=set[str])
    parameters: dict[tuple[str, str], ParameterInfo] = field(default_factory=dict[tuple[str, str], ParameterInfo])
    """The parameters by node and name, as seen last."""
    changes: list[Change] = field(default_factory=list[Change])
    commands: list[Command] = field(default_factory=list[Command])
    launches: list[LaunchRecord] = field(default_factory=list[LaunchRecord])
    topics: set[str] = field(default_factory=set[str])
    panes: set[str] = field(default_factory=set[str])
    curves: set[str] = field(default_factory=set[str])
    layouts: set[str] = field(default_factory=set[str])
    profiles: set[str] = field(default_factory=set[str])
    steered: bool = False
    metres: float = 0.0
    """The distance that the robot has driven."""
    _place: tuple[float, float] | None = None
    _last_listed: tuple[str, ...] = ()
    """The launch files that the console listed last."""

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Add what a snapshot of the console shows."""
        self.nodes |= {each.name for each in snapshot.graph.nodes if not each.hidden}
        self.topics |= {each.name for each in snapshot.graph.topics}
        for tree in snapshot.parameters.values():
            self.parameters |= {(each.node, each.name): each for each in tree.parameters}
        if snapshot.active_profile:
            self.profiles.add(snapshot.active_profile)
        pose = snapshot.world.pose
        if pose is not None:
            place = (pose.x, pose.y)
            if self._place is not None:
                step = math.dist(place, self._place)
                self.metres += step if step < MAX_STEP_M else 0.0
            self._place = place

    def add_launches(
        self, listed: Sequence[str], commands: Sequence[Command], find: Callable[[str], Sequence[tuple[str, str]]]
    ) -> None:
        """Add the launches that are new in the Launch pane and among all commands so far, with the files' present text.

        `find` returns the path and text of each file of the workspace that a word may name.
        """
        new = Counter(listed) - Counter(self._last_listed)
        self.launches += [LaunchRecord(*found) for each in new for found in find(each)]
        for number, command in enumerate(commands[len(self.commands) :], len(self.commands)):
            if command.verb[:1] == ("launch",) and not PRINT_OPTIONS.intersection(command.verb):
                self.launches += [LaunchRecord(*found, number) for word in command.verb[1:] for found in find(word)]
        self._last_listed = tuple(listed)
        self.commands = [*commands]

    def add_changes(self, changes: Iterable[Change]) -> None:
        """Add entries of the journal that were made while the lesson was open.

        Values that a node has after a restart are left out, since nobody set them, and so are those that a node has not
        answered, since it has not refused them.
        """
        self.changes += [each for each in changes if each.seq >= 0 and each.by != RESTARTED and each.answered]

    def arguments_of_up(self) -> set[str]:
        """The arguments of every `up` that works, among them the profile."""
        return {
            word for each in self.commands if each.verb[:1] == ("up",) and each.is_working for word in each.verb[1:]
        }

    def parameters_named(self, name: str) -> Sequence[ParameterInfo]:
        """The parameters of that name, of all nodes."""
        return [each for (_, own), each in self.parameters.items() if own == name]

    def refusals(self, name: str) -> list[str]:
        """The reasons for which values of a parameter were refused."""
        here = [each.reason for each in self.changes if each.name == name and not each.accepted]
        lines = [each.errors for each in self.commands if is_param_set(each, name)]
        return here + [each.rpartition(REFUSED)[2].strip(": \n") for each in lines if REFUSED in each]

    def set_values(self, name: str) -> list[str]:
        """The values that somebody has set, as texts: those of command lines, then the changes that the console saw."""
        reported = [value_text(each.new) for each in self.changes if each.name == name and each.accepted]
        lines = [each for each in self.commands if each.code == 0 and is_param_set(each, name)]
        return [each.words[-1] for each in lines if REFUSED not in each.errors] + reported


def is_param_set(command: Command, name: str) -> bool:
    """Whether a command line is `param set NODE NAME VALUE`, with or without `ros2`."""
    plain = [each for each in command.verb if not each.startswith("--")]
    return plain[:2] == ["param", "set"] and len(plain) >= 5 and plain[3] == name


def parameter_names(found: Mapping[tuple[str, str], ParameterInfo]) -> list[str]:
    """The sorted names of parameters, without those that every node has."""
    return sorted({name for _, name in found if name != "use_sim_time" and not name.startswith("qos_overrides.")})
