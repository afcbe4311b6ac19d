"""The part of `FakeConsole` that collects series."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import Value
from bot_console.tui.console.plot.port import Samples
from bot_console.tui.console.robot.robot_model import Pose

from fakes.profiles import CLOSED

START = 1_700_000_000_000_000_000


class FakeSeries:
    """Collects the samples that the test has put into `series`, and numeric parameters."""

    asked: list[tuple[Any, ...]]
    closed: bool
    now: float
    series: dict[str, tuple[list[float], list[float]]]
    unplottable: dict[str, str]
    past: dict[int, Pose]
    """The robot's poses, by time."""
    _watched: dict[str, set[str]]
    """The requesters of each path."""

    def _value(self, node: str, name: str) -> Value:
        raise NotImplementedError

    def _plot(self, path: str, value: Value) -> None:
        if self._watched.get(path) and isinstance(value, (bool, int, float)):
            times, values = self.series.setdefault(path, ([], []))
            times.append(self.now)
            values.append(float(value))

    def watch(self, path: str, requester: str = "") -> Answer:
        self.asked.append(("watch", path))
        if self.closed:
            return Answer(False, CLOSED)
        node, _, name = path.partition(":")
        number = isinstance(self._value(node, name), (bool, int, float))
        why = self.unplottable.get(path, "" if path in self.series or number else f"there is no topic {path}")
        if not why:
            self._watched.setdefault(path, set()).add(requester)
            if path not in self.series:
                self._plot(path, self._value(node, name))
        return Answer(not why, why or path)

    def unwatch(self, path: str, requester: str = "") -> None:
        self.asked.append(("unwatch", path))
        self._watched[path] = self._watched.get(path, set()) - {requester}

    def samples(self, path: str, after: int = 0) -> Samples:
        if not self._watched.get(path):
            return Samples((), (), after)
        times, values = self.series.get(path, ([], []))
        return Samples(times[after:], values[after:], len(times))

    def plot_time(self, stamp: int | None = None) -> float:
        return self.now if stamp is None else self.now + (stamp - START) / 1e9

    def pose_at(self, stamp: int) -> Pose | None:
        return self.past.get(stamp)

    def plottable(self) -> Sequence[str]:
        return sorted(self.series)
