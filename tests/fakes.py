"""`FakeConsole`: a scripted ROS system for tests of what is drawn, and sample snapshots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from bot_console.tui.console.log_store import LogStore
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    LaunchArgument,
    LogFilter,
    LogRecord,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
)
from bot_console.tui.console.protocol import Answer, Samples
from bot_console.tui.console.values import refusal

START = 1_700_000_000_000_000_000


def done(value: Any) -> Future[Any]:
    """A future that has its result."""
    future: Future[Any] = Future()
    future.set_result(value)
    return future


class FakeConsole:
    """A console over one snapshot; it takes what the descriptors allow, and remembers what it was asked."""

    def __init__(self, snapshot: ConsoleSnapshot | None = None) -> None:
        self.logs = LogStore(1000)
        self.current = snapshot or ConsoleSnapshot()
        self.asked: list[tuple[Any, ...]] = []
        self.refusals: dict[tuple[str, str], str] = {}
        self.series: dict[str, tuple[list[float], list[float]]] = {}
        self.unplottable: dict[str, str] = {}
        self.journal: list[Change] = []
        self.differences: dict[str, tuple[ProfileDifference, ...]] = {}
        self.now = 60.0

    def change(self, **parts: Any) -> None:
        """Replace parts of the snapshot."""
        self.current = replace(self.current, seq=self.current.seq + 1, **parts)

    def say(self, severity: Severity, node: str, text: str, stamp: int = START) -> None:
        """Log a line."""
        self.logs.add(stamp, severity, node, text, ("node.py", "callback", 7))
        self.change(logs=self.logs.state)

    def snapshot(self) -> ConsoleSnapshot:
        return self.current

    def log(self, seq: int) -> LogRecord | None:
        return self.logs.record(seq)

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        return self.logs.matching(which, after, limit)

    def clear_logs(self) -> None:
        self.logs.clear()
        self.change(logs=self.logs.state)

    def changes(self, after: int = 0) -> Sequence[Change]:
        return tuple(self.journal)

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        self.asked.append(("set", node, dict(values)))
        tree = self.current.parameters[node]
        outcomes: list[SetOutcome] = []
        for name, value in values.items():
            by, why = refusal(tree.get(name), value)
            own = self.refusals.get((node, name), "")
            outcomes.append(
                SetOutcome(node, name, value, not (why or own), why or own, by or ("callback" if own else ""))
            )
        taken = {each.name: each.value for each in outcomes if each.accepted}
        parameters = tuple(replace(each, value=taken.get(each.name, each.value)) for each in tree.parameters)
        trees = {**self.current.parameters, node: replace(tree, parameters=parameters)}
        self.change(parameters=MappingProxyType(trees))
        return done(tuple(outcomes))

    def undo(self) -> Future[Answer]:
        self.asked.append(("undo",))
        return done(Answer(True, "undone"))

    def redo(self) -> Future[Answer]:
        self.asked.append(("redo",))
        return done(Answer(False, "nothing to redo"))

    def watch(self, path: str) -> Answer:
        self.asked.append(("watch", path))
        why = self.unplottable.get(path, "" if path in self.series else f"there is no topic {path}")
        return Answer(not why, why or path)

    def unwatch(self, path: str) -> None:
        self.asked.append(("unwatch", path))

    def samples(self, path: str, after: int = 0) -> Samples:
        times, values = self.series.get(path, ([], []))
        return Samples(times[after:], values[after:], len(times))

    def plot_time(self, stamp: int | None = None) -> float:
        return self.now if stamp is None else self.now + (stamp - START) / 1e9

    def plottable(self) -> Sequence[str]:
        return sorted(self.series)

    def drive(self, linear: float, angular: float) -> None:
        self.asked.append(("drive", linear, angular))

    def all_stop(self, hold: bool = True) -> None:
        self.asked.append(("all_stop", hold))
        self.change(drive=replace(self.current.drive, stopped=hold))

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        self.asked.append(("call", service))
        return done(Answer(True))

    def set_logger_level(self, node: str, severity: Severity) -> Future[Answer]:
        return done(Answer(True))

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        return self.differences.get(name, ())

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        self.asked.append(("apply", name, reset_world))
        self.change(active_profile=name)
        return done(
            tuple(
                SetOutcome(each.node, each.name, each.then, not each.refusal, each.refusal)
                for each in self.differences.get(name, ())
            )
        )

    def save_parameters(self, path: str, nodes: Sequence[str] = ()) -> Answer:
        self.asked.append(("save", path))
        return Answer(True, f"saved to {path}")

    def run_line(self, line: str) -> Future[str]:
        self.asked.append(("run", line))
        return done("/robot_navigator\n")

    def close(self) -> None:
        self.asked.append(("close",))


class FakeLauncher:
    """A launcher that remembers what it was asked."""

    def __init__(self, arguments: Sequence[LaunchArgument] = (), files: Sequence[str] = ()) -> None:
        self.asked: list[tuple[Any, ...]] = []
        self.declared = arguments
        self.known = files
        self.broken = ""

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        self.asked.append(("launch", path, dict(arguments)))
        return done(Answer(True))

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        if self.broken:
            raise ValueError(self.broken)
        return self.declared

    def files(self) -> Sequence[str]:
        return self.known

    def start(self, key: str) -> Future[Answer]:
        return self._asked("start", key)

    def stop(self, key: str) -> Future[Answer]:
        return self._asked("stop", key)

    def kill(self, key: str) -> Future[Answer]:
        return self._asked("kill", key)

    def restart(self, key: str) -> Future[Answer]:
        return self._asked("restart", key)

    def _asked(self, verb: str, key: str) -> Future[Answer]:
        self.asked.append((verb, key))
        return done(Answer(True))
