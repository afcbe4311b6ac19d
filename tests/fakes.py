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
    DriveInfo,
    GridMap,
    Kind,
    LogFilter,
    LogRecord,
    ParameterInfo,
    ParameterTree,
    Pose,
    ProfileDifference,
    Range,
    SetOutcome,
    Severity,
    Value,
    WorldInfo,
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
        return ()

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
        return Answer(True, path)

    def unwatch(self, path: str) -> None:
        self.asked.append(("unwatch", path))

    def samples(self, path: str, after: int = 0) -> Samples:
        return Samples((), (), after)

    def plottable(self) -> Sequence[str]:
        return ()

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
        return ()

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        return done(())

    def save_parameters(self, path: str, nodes: Sequence[str] = ()) -> Answer:
        self.asked.append(("save", path))
        return Answer(True, f"saved to {path}")

    def run_line(self, line: str) -> Future[str]:
        self.asked.append(("run", line))
        return done("/robot_navigator\n")

    def close(self) -> None:
        self.asked.append(("close",))


def parameter(name: str, value: Value, kind: Kind, description: str = "", limits: Range | None = None) -> ParameterInfo:
    """A parameter of the navigator."""
    return ParameterInfo("/robot_navigator", name, kind, value, description, range=limits, default=value)


def live() -> FakeConsole:
    """A robot that drives, with parameters, log lines and a map."""
    navigator = (
        parameter("max_speed", 1.0, Kind.DOUBLE, "Maximum linear velocity (m/s)", Range(0.1, 5.0)),
        parameter("safety_distance", 0.5, Kind.DOUBLE, "Minimum obstacle clearance (m)", Range(0.1, 2.0)),
        parameter("detection_threshold", 100, Kind.INTEGER, "Sensor detection sensitivity", Range(0, 255)),
        parameter("turn_rate", 1.0, Kind.DOUBLE, "Maximum angular velocity (rad/s)", Range(0.1, 3.0)),
        parameter("enable_safety", True, Kind.BOOL, "Enable/disable safety features"),
        parameter("robot_name", "IntelligentRobot", Kind.STRING, "Robot identifier"),
        parameter("use_sim_time", False, Kind.BOOL),
    )
    simulator = tuple(
        replace(each, node="/simulator")
        for each in (
            parameter("lidar.beams", 360, Kind.INTEGER, "Beams of one scan", Range(1, 3600)),
            parameter("lidar.noise", 0.01, Kind.DOUBLE, "Standard deviation of a range (m)", Range(0.0, 1.0)),
            parameter("seed", 1, Kind.INTEGER, "Seed of everything random"),
        )
    )
    trees = {
        "/robot_navigator": ParameterTree("/robot_navigator", navigator),
        "/simulator": ParameterTree("/simulator", simulator),
    }
    console = FakeConsole(ConsoleSnapshot(parameters=MappingProxyType(trees), world=world(), drive=driving()))
    lines = (
        (Severity.INFO, "robot_navigator", "IntelligentRobot initialized!"),
        (Severity.INFO, "robot_navigator", "Max Speed: 1.0 m/s"),
        (Severity.WARN, "robot_navigator", "Obstacle at 0.42m - Turning!"),
        (Severity.ERROR, "safety_monitor", "Speed must be 0.1-5.0, got 10.0"),
        (Severity.DEBUG, "simulator", "step 1200"),
    )
    for number, (severity, node, text) in enumerate(lines):
        console.say(severity, node, text, START + number * 250_000_000)
    return console


def driving() -> DriveInfo:
    """A robot that goes straight on."""
    return DriveInfo("/cmd_vel", final=(1.0, 0.0), actual=(0.98, 0.0))


def world() -> WorldInfo:
    """A room of 10 by 6 m with a robot in it."""
    width, height = 100, 60
    rows = [bytes([100] * width)]
    rows += [bytes([100] + [0] * (width - 2) + [100])] * (height - 2)
    rows.append(rows[0])
    grid = GridMap(width, height, 0.1, Pose(), b"".join(rows))
    hits = tuple((9.8, 1.0 + 0.1 * step) for step in range(40))
    trail = tuple((2.0 + 0.1 * step, 3.0) for step in range(30))
    return WorldInfo(grid, Pose(5.0, 3.0, 0.0), "/ground_truth", trail, hits, None, 0.98, 0.0, 4.8)
