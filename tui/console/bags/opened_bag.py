"""The console's ports for an opened bag: its topics, log, parameter changes, robot and series.

They are the ports of a system that is never reached, so they refuse all commands, and show the contents of the bag.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.bag_topics import BagTopics
from bot_console.tui.console.bags.contents import Contents
from bot_console.tui.console.bags.node_bags import NodeBags
from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.graph.node_graph import NodeGraph
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.logs.node_logs import NodeLogs
from bot_console.tui.console.model import (
    Capabilities,
    Change,
    ConsoleSnapshot,
    Endpoint,
    GraphInfo,
    JournalState,
    LaunchInfo,
    LinkInfo,
    parameter_in,
)
from bot_console.tui.console.parameters.node_parameters import NodeParameters
from bot_console.tui.console.parameters.node_profiles import NodeProfiles
from bot_console.tui.console.parameters.provenance import Provenance
from bot_console.tui.console.plot.arrays import NotPlottable
from bot_console.tui.console.plot.paths import number_paths
from bot_console.tui.console.plot.port import Samples
from bot_console.tui.console.plot.series import parse_path, reader
from bot_console.tui.console.robot.port import Drive
from bot_console.tui.console.sensors.node_sensors import NodeSensors
from bot_console.tui.text.expression.tree import is_parameter

WHY = "this is a recording: it can be viewed, but nothing in it can be changed"


class BagParameters(NodeParameters):
    """The recorded parameters and their changes."""

    def __init__(self, gate: Gate, contents: Contents) -> None:
        super().__init__(gate, Provenance())
        self._contents = contents

    def changes(self, after: int = 0) -> Sequence[Change]:
        """The parameter changes that the recorded parameter events contain."""
        return self._contents.changes[max(0, after) :]


class BagDrive:
    """The recorded robot: its poses can be viewed, but it can be neither steered nor stopped."""

    def __init__(self, contents: Contents) -> None:
        self.pose_at = contents.past.at
        self.move = self.stop = self.hold_early = self.settle_early = self._ignore
        self.release = self.choose = self.steer = self._ignore

    def _ignore(self, *given: object, **named: object) -> None:
        """Do nothing: there is no robot."""


class BagPlots:
    """The plottable series of a bag; time starts at the first message."""

    def __init__(self, contents: Contents) -> None:
        self._contents = contents
        self._begin = contents.metadata.begin
        self._series: dict[str, Samples] = {}

    def watch(self, path: str, requester: str = "") -> Answer:
        """Read a series; an unsuccessful answer says why it cannot be plotted."""
        if path not in self._series:
            try:
                self._series[path] = self._parameter(path) if is_parameter(path) else self._field(path)
            except (NotPlottable, ImportError, AttributeError, ValueError) as error:
                return Answer(False, str(error))
        return Answer(True, path)

    def unwatch(self, path: str, requester: str = "") -> None:
        """Discard a series."""
        self._series.pop(path, None)

    def samples(self, path: str, after: int = 0) -> Samples:
        """All samples of a series, returned once."""
        found = self._series.get(path)
        return found if found is not None and after < found.cursor else Samples((), (), after)

    def _field(self, path: str) -> Samples:
        path = "/" + path.lstrip("/")
        topics = [each for each in self._contents.metadata.topics if path.startswith((f"{each}/", f"{each}."))]
        if not topics:
            raise NotPlottable(f"no topic of that name is in the recording, or the field does not exist: {path}")
        topic = max(topics, key=len)
        read = reader(*parse_path(path[len(topic) + 1 :]))
        found = [(stamp, read(message), _header(message)) for stamp, message in self._contents.messages(topic)]
        times = [self.time(stamp) for stamp, _, _ in found]
        headers = [math.nan if at is None else self.time(at) for _, _, at in found]
        problem = "" if found else f"{topic} is too large to be kept in memory" * (topic in self._contents.left_out)
        return Samples(times, [value for _, value, _ in found], len(found), problem or "", headers)

    def _parameter(self, path: str) -> Samples:
        node, _, name = path.partition(":")
        last = parameter_in(self._contents.trees, node, name)
        if last is None:
            raise NotPlottable(f"the recording contains no values of {path}")
        mine = [each for each in self._contents.changes if (each.node, each.name) == (node, name)]
        first = mine[0].old if mine else last.value
        points = [(self._begin, first), *((each.stamp, each.new) for each in mine)]
        fine = [(self.time(stamp), float(value)) for stamp, value in points if isinstance(value, (int, float))]
        return Samples([time for time, _ in fine], [value for _, value in fine], len(fine))

    def time(self, stamp: int | None = None) -> float:
        """Seconds since the start of the bag; None stands for its end."""
        return ((self._contents.metadata.end if stamp is None else stamp) - self._begin) / 1e9

    def plottable(self) -> Sequence[str]:
        """The paths of all numeric fields and parameters."""
        topics = self._contents.metadata.topics
        paths = [f"{name}/{field}" for name, topic in topics.items() for field in number_paths(topic.type)]
        paths += [
            f"{node}:{each.name}"
            for node, tree in self._contents.trees.items()
            for each in tree.parameters
            if isinstance(each.value, (bool, int, float))
        ]
        return sorted(paths, key=lambda path: (path.endswith("()"), path.endswith("]"), path))


class OpenedBag:
    """A console on a bag; refuses, with the reason, every request that would change something."""

    def __init__(self, contents: Contents, name: str) -> None:
        about = contents.metadata
        topics = sorted(
            (Endpoint(each.name, (each.type,)) for each in about.topics.values()), key=lambda each: each.name
        )
        graph = GraphInfo(topics=tuple(topics))
        self.gate = Gate(WHY)
        self.parameters = BagParameters(self.gate, contents)
        self.profiles = NodeProfiles(self.gate, self.parameters, _no_world)
        self.logs = NodeLogs(self.gate)
        self.logs.begin(contents.logs)
        self.plots = BagPlots(contents)
        self.drive: Drive = BagDrive(contents)
        self.topics = BagTopics(self.gate, contents, graph)
        self.graph = NodeGraph(self.gate, LaunchInfo, lambda: contents.trees, dict, int, lambda node, since: "")
        self.sensors = NodeSensors(self.gate, lambda: graph)
        self.bags = NodeBags(self.gate)
        self.launcher: Launcher | None = None
        self._snapshot = ConsoleSnapshot(
            seq=1,
            stamp=about.end,
            graph=graph,
            parameters=contents.parameters,
            logs=contents.logs.state,
            journal=JournalState(0, len(contents.changes)),
            world=contents.world,
            link=LinkInfo(f"bag {name}, {(about.end - about.begin) / 1e9:.0f} s"),
            capabilities=Capabilities(launch=WHY, live=WHY, change=WHY),
        )

    def snapshot(self) -> ConsoleSnapshot:
        """A snapshot of the whole recording; always the same object."""
        return self._snapshot

    def close(self) -> None:
        """Stop searching the log."""
        self.logs.close()


async def _no_world() -> None:
    """Do nothing: there is no simulator to reset."""


def _header(message: Any) -> int | None:
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    return stamp.sec * 1_000_000_000 + stamp.nanosec if stamp is not None and (stamp.sec or stamp.nanosec) else None
