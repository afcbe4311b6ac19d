"""A bag as a read-only console: its topics, log, parameter changes, robot and series."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.contents import Contents
from bot_console.tui.console.bags.traffic import BagTraffic
from bot_console.tui.console.connection.no_console import NoConsole
from bot_console.tui.console.log_protocol import LogSource, LogView
from bot_console.tui.console.logs.file import open_log
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.view import LogViews
from bot_console.tui.console.model import (
    Capabilities,
    Change,
    ConsoleSnapshot,
    Endpoint,
    GraphInfo,
    JournalState,
    LinkInfo,
    LogFilter,
    LogRecord,
    ProfileDifference,
)
from bot_console.tui.console.plot.arrays import NotPlottable
from bot_console.tui.console.plot.paths import number_paths
from bot_console.tui.console.plot.series import parse_path, reader
from bot_console.tui.console.protocol import Samples
from bot_console.tui.console.robot.robot_model import Pose
from bot_console.tui.console.traffic import Traffic
from bot_console.tui.text.expression.tree import is_parameter

WHY = "this is a recording: it can be viewed, but nothing in it can be changed"


class PastReading:
    """The read-only data of a bag. The time axis begins with the bag."""

    def __init__(self, contents: Contents, name: str) -> None:
        self._contents = contents
        self.views = LogViews(contents.logs)
        self._begin = contents.metadata.begin
        self._series: dict[str, Samples] = {}
        known = contents.metadata.topics.values()
        topics = sorted((Endpoint(each.name, (each.type,)) for each in known), key=lambda topic: topic.name)
        self._snapshot = ConsoleSnapshot(
            seq=1,
            stamp=contents.metadata.end,
            graph=GraphInfo(topics=tuple(topics)),
            parameters=contents.parameters,
            logs=contents.logs.state,
            journal=JournalState(0, len(contents.changes)),
            world=contents.world,
            link=LinkInfo(f"recording {name}, {(contents.metadata.end - self._begin) / 1e9:.0f} s"),
            capabilities=Capabilities(launch=WHY, live=WHY, change=WHY),
        )

    def snapshot(self) -> ConsoleSnapshot:
        """The whole recording; always the same object."""
        return self._snapshot

    def log(self, seq: int) -> LogRecord | None:
        """The log record with that number."""
        return self._contents.logs.record(seq)

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """Numbers of the records that pass a filter."""
        return matching(self._contents.logs, which, after, limit)

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Search for records that pass a filter."""
        return self.views.open(which, instead_of)

    def open_log(self, path: str) -> LogSource:
        """Open a saved log to read it alongside the bag."""
        return open_log(path)

    def changes(self, after: int = 0) -> Sequence[Change]:
        """The parameter changes that parameter events reported."""
        return self._contents.changes[max(0, after) :]

    def watch(self, path: str) -> Answer:
        """Read a series; the answer says why if it cannot be plotted."""
        if path not in self._series:
            try:
                self._series[path] = self._parameter(path) if is_parameter(path) else self._field(path)
            except (NotPlottable, ImportError, AttributeError, ValueError) as error:
                return Answer(False, str(error))
        return Answer(True, path)

    def unwatch(self, path: str) -> None:
        """Discard a series."""
        self._series.pop(path, None)

    def samples(self, path: str, after: int = 0) -> Samples:
        """All samples of a series, delivered once."""
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
        times = [self.plot_time(stamp) for stamp, _, _ in found]
        headers = [math.nan if at is None else self.plot_time(at) for _, _, at in found]
        problem = "" if found else f"{topic} is too large to be kept in memory" * (topic in self._contents.left_out)
        return Samples(times, [value for _, value, _ in found], len(found), problem or "", headers)

    def _parameter(self, path: str) -> Samples:
        node, _, name = path.partition(":")
        tree = self._contents.trees.get(node)
        last = tree.get(name) if tree else None
        if last is None:
            raise NotPlottable(f"the recording contains no values of {path}")
        mine = [each for each in self._contents.changes if (each.node, each.name) == (node, name)]
        first = mine[0].old if mine else last.value
        points = [(self._begin, first), *((each.stamp, each.new) for each in mine)]
        fine = [(self.plot_time(stamp), float(value)) for stamp, value in points if isinstance(value, (int, float))]
        return Samples([time for time, _ in fine], [value for _, value in fine], len(fine))

    def plot_time(self, stamp: int | None = None) -> float:
        """Seconds since the start of the bag; None stands for its end."""
        return ((self._contents.metadata.end if stamp is None else stamp) - self._begin) / 1e9

    def pose_at(self, stamp: int) -> Pose | None:
        """The robot's pose at a time."""
        return self._contents.past.at(stamp)

    def plottable(self) -> Sequence[str]:
        """Paths of numeric fields and parameters."""
        topics = self._contents.metadata.topics
        paths = [f"{name}/{field}" for name, topic in topics.items() for field in number_paths(topic.type)]
        paths += [
            f"{node}:{each.name}"
            for node, tree in self._contents.trees.items()
            for each in tree.parameters
            if isinstance(each.value, (bool, int, float))
        ]
        return sorted(paths, key=lambda path: (path.endswith("()"), path.endswith("]"), path))

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        """None."""
        return ()


class OpenedBag(NoConsole):
    """Shows a bag; every request that would change something is refused with the reason."""

    def __init__(self, contents: Contents, name: str) -> None:
        self._reading = PastReading(contents, name)
        self.topics = BagTraffic(contents, WHY)
        super().__init__(WHY, self._reading)

    @property
    def traffic(self) -> Traffic:
        """The recorded messages."""
        return self.topics

    def watch(self, path: str, requester: str = "") -> Answer:
        """Read a series."""
        return self._reading.watch(path)

    def unwatch(self, path: str, requester: str = "") -> None:
        """Discard a series."""
        self._reading.unwatch(path)

    def close(self) -> None:
        """End the search of the log."""
        self._reading.views.close()


def _header(message: Any) -> int | None:
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    return stamp.sec * 1_000_000_000 + stamp.nanosec if stamp is not None and (stamp.sec or stamp.nanosec) else None
