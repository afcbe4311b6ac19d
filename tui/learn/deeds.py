"""What has been seen of a system and of the command lines in its domain: the deeds that conditions ask about. Pure."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from bot_console.tui.console.model import Change, ConsoleSnapshot, ParameterInfo
from bot_console.tui.format import value_text
from bot_console.tui.learn.command_log import Command

MAX_STEP_M = 1.0
"""A greater distance between two snapshots is a robot that was moved elsewhere."""


@dataclass
class Deeds:
    """Everything seen since the lesson was opened; things are only added."""

    nodes: set[str] = field(default_factory=set[str])
    parameters: dict[tuple[str, str], ParameterInfo] = field(default_factory=dict[tuple[str, str], ParameterInfo])
    """By node and name, as seen last."""
    changes: list[Change] = field(default_factory=list[Change])
    commands: list[Command] = field(default_factory=list[Command])
    launches: set[str] = field(default_factory=set[str])
    topics: set[str] = field(default_factory=set[str])
    panes: set[str] = field(default_factory=set[str])
    curves: set[str] = field(default_factory=set[str])
    layouts: set[str] = field(default_factory=set[str])
    profiles: set[str] = field(default_factory=set[str])
    steered: bool = False
    metres: float = 0.0
    """The distance that the robot has driven."""
    _place: tuple[float, float] | None = None

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Take in a snapshot of the console."""
        self.nodes |= {each.name for each in snapshot.graph.nodes if not each.hidden}
        self.topics |= {each.name for each in snapshot.graph.topics}
        for tree in snapshot.parameters.values():
            self.parameters |= {(each.node, each.name): each for each in tree.parameters}
        self.launches |= {*snapshot.launch.files}
        if snapshot.active_profile:
            self.profiles.add(snapshot.active_profile)
        pose = snapshot.world.pose
        if pose is not None:
            place = (pose.x, pose.y)
            if self._place is not None:
                step = math.dist(place, self._place)
                self.metres += step if step < MAX_STEP_M else 0.0
            self._place = place

    def add_changes(self, changes: Iterable[Change]) -> None:
        """Take in entries of the journal that were made while the lesson was open."""
        self.changes += [each for each in changes if each.seq >= 0]

    def values_of(self, name: str) -> Sequence[ParameterInfo]:
        """The parameters of all nodes with that name."""
        return [each for (_, own), each in self.parameters.items() if own == name]

    def refusals(self, name: str) -> list[str]:
        """The reasons for which a value of a parameter was refused; empty ones for those of other terminals."""
        here = [each.reason for each in self.changes if each.name == name and not each.accepted]
        return here + ["" for each in self.commands if each.failed and is_set_of(each, name)]

    def values_set(self, name: str) -> list[str]:
        """The values that somebody has set, as texts."""
        here = [value_text(each.new) for each in self.changes if each.name == name and each.accepted]
        return here + [each.words[-1] for each in self.commands if each.code == 0 and is_set_of(each, name)]


def is_set_of(command: Command, name: str) -> bool:
    """Whether a command line is `param set NODE NAME VALUE`, of `ros2` or not."""
    plain = [each for each in command.verb if not each.startswith("--")]
    return plain[:2] == ["param", "set"] and len(plain) >= 5 and plain[3] == name


def names_of(found: Mapping[tuple[str, str], ParameterInfo]) -> list[str]:
    """The names of parameters, without those that every node has."""
    return sorted({name for _, name in found if name != "use_sim_time" and not name.startswith("qos_overrides.")})
