"""`FakeConsole`: a scripted ROS system that implements the `Console` protocol without ROS."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType, SimpleNamespace
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import CLOSED, Gate, done
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.logs.file import open_log
from bot_console.tui.console.logs.port import LogView
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import SearchedView
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    LogFilter,
    LoggerLevel,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
    same,
)
from bot_console.tui.console.parameters.file.saving import save
from bot_console.tui.console.parameters.journal import Journal, Move, Step
from bot_console.tui.console.parameters.origin_text import origin_text
from bot_console.tui.console.parameters.profiles import cannot_apply, differences
from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.console.values import refusal

from fakes.bags import FakeBags
from fakes.profiles import FakeProfiles
from fakes.sensors import FakeSensors
from fakes.series import START, FakeSeries
from fakes.topics import FakeTopics


class FakeView(SearchedView):
    """A view whose search is complete whenever it is polled."""

    def poll(self) -> Any:
        while self.work():
            pass
        return super().poll()


EARLY = "early "
"""Prefix of the key of an early stop; the id of the key press follows."""


class FakeConsole(FakeProfiles, FakeSeries):
    """A console over one snapshot: it accepts values that the descriptors allow, and keeps the requests that it
    received."""

    def __init__(self, snapshot: ConsoleSnapshot | None = None) -> None:
        self.gate = Gate("")
        self.launcher: Launcher | None = None
        self.records = LogStore(1000)
        self.current = snapshot or ConsoleSnapshot()
        self.asked: list[tuple[Any, ...]] = []
        self.topics = FakeTopics(self.asked)
        self.sensors = self.graph = FakeSensors()
        self.sent: list[tuple[float, float]] = []
        """Velocities that have reached the robot."""
        self.refusals: dict[tuple[str, str], str] = {}
        self.series: dict[str, tuple[list[float], list[float]]] = {}
        self.unplottable: dict[str, str] = {}
        self.journal: list[Change] = []
        self.differences: dict[str, tuple[ProfileDifference, ...]] = {}
        """What profiles would change, where scripted; otherwise it follows from their values."""
        self.past = {}
        self.now = 60.0
        self.levels: dict[str, Severity] = {}
        """Logger levels that were set."""
        self.closed = False
        self._steps = Journal()
        self._watched = {}
        self._make_ports()

    def _make_ports(self) -> None:
        self.bags = FakeBags(self)
        self.topics.call_service = self.call
        self.parameters = SimpleNamespace(
            set=self.set_parameters,
            set_all=self.set_all,
            undo=self.undo,
            redo=self.redo,
            changes=self.changes,
            save=self.save_parameters,
        )
        self.profiles = SimpleNamespace(
            differences=self.profile_differences,
            apply=self.apply_profile,
            open=self.open_profile,
            fetch=self.fetch_profile,
            save=self.save_profile,
            rename=self.rename_profile,
            delete=self.delete_profile,
        )
        self.logs = SimpleNamespace(
            record=self.records.record,
            matching=self.matching_logs,
            view=self.view_logs,
            open=open_log,
            clear=self.clear_logs,
            set_level=self.set_logger_level,
            levels=self.logger_levels,
        )
        self.plots = SimpleNamespace(
            watch=self.watch,
            unwatch=self.unwatch,
            samples=self.samples,
            time=self.plot_time,
            plottable=self.plottable,
        )
        self.drive = SimpleNamespace(
            move=self.move,
            stop=self.stop,
            hold_early=self.hold_early,
            settle_early=self.settle_early,
            release=self.release,
            choose=self.choose_robot,
            steer=self.steer,
            pose_at=self.pose_at,
        )

    def change(self, **parts: Any) -> None:
        """Replace parts of the snapshot."""
        self.current = replace(self.current, seq=self.current.seq + 1, **parts)

    def show_text(self, severity: Severity, node: str, text: str, stamp: int = START) -> None:
        """Log a line."""
        self.records.add(stamp, severity, node, text, ("node.py", "callback", 7))
        self.change(logs=self.records.state)

    def snapshot(self) -> ConsoleSnapshot:
        return self.current

    def matching_logs(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        return matching(self.records, which, after, limit)

    def view_logs(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        return FakeView(self.records, which)

    def clear_logs(self) -> None:
        self.records.clear()
        self.change(logs=self.records.state)

    def changes(self, after: int = 0) -> Sequence[Change]:
        return tuple(each for each in self.journal if each.seq >= after)

    def set_parameters(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource = ChangeSource.EDIT,
        *,
        atomically: bool = False,
        continues: bool = False,
    ) -> Future[tuple[SetOutcome, ...]]:
        self.asked.append(("set", node, dict(values)))
        if self.closed:
            return done(
                tuple(SetOutcome(node, name, value, False, CLOSED, "console") for name, value in values.items())
            )
        outcomes, moves = self._moved(node, values, source, atomically=atomically)
        if moves:
            self._steps.did(Step(moves), source, continues=continues)
            self.set_journal()
        return done(outcomes)

    def _moved(
        self, node: str, values: Mapping[str, Value], source: ChangeSource, *, atomically: bool, by: str = ""
    ) -> tuple[tuple[SetOutcome, ...], tuple[Move, ...]]:
        before = {name: self._value(node, name) for name in values}
        outcomes = self.take(node, values, source, atomically=atomically, by=by)
        taken = {
            each.name: each.value for each in outcomes if each.accepted and not same(before[each.name], each.value)
        }
        return outcomes, (Move(node, {name: before[name] for name in taken}, taken),) if taken else ()

    def take(
        self, node: str, values: Mapping[str, Value], source: ChangeSource, *, atomically: bool = False, by: str = ""
    ) -> tuple[SetOutcome, ...]:
        """Set values on the node, as if `source` had requested it; return the outcomes."""
        outcomes = [self._result_of(node, name, value) for name, value in values.items()]
        bad = next((each for each in outcomes if not each.accepted), None)
        if atomically and bad:
            outcomes = [
                replace(each, accepted=False, reason=bad.reason, refused_by=each.refused_by or "callback")
                for each in outcomes
            ]
        for each in outcomes:
            if each.accepted and same(self._value(node, each.name), each.value):
                continue
            entry = Change(
                self._end, START, node, each.name, self._value(node, each.name), each.value, source,
                each.accepted, each.reason, by, answered=each.refused_by != "node",
            )  # fmt: skip
            self.journal.append(entry)
        taken = {each.name: each.value for each in outcomes if each.accepted}
        if taken:
            tree = self.current.parameters[node]
            parameters = tuple(
                replace(each, value=taken[each.name], origin=origin_text(source, START)) if each.name in taken else each
                for each in tree.parameters
            )
            self.change(
                parameters=MappingProxyType({**self.current.parameters, node: replace(tree, parameters=parameters)})
            )
            for name, value in taken.items():
                self._plot(f"{node}:{name}", value)
        self.set_journal()
        return tuple(outcomes)

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource = ChangeSource.EDIT, by: str = ""
    ) -> Future[tuple[SetOutcome, ...]]:
        self.asked.append(("set_all", {node: dict(found) for node, found in values.items()}, by))
        outcomes, moves = self._all_or_nothing(values, source, by)
        if moves:
            self._steps.did(Step(moves), source)
        self.set_journal()
        return done(outcomes)

    def _all_or_nothing(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource, by: str
    ) -> tuple[tuple[SetOutcome, ...], tuple[Move, ...]]:
        wanted = [(node, name, value) for node, found in values.items() for name, value in found.items()]
        if self.closed:
            return tuple(SetOutcome(*each, False, CLOSED, "console") for each in wanted), ()
        result = [self._result_of(*each) for each in wanted]
        bad = next((each for each in result if not each.accepted), None)
        if bad is None:
            made = [self._moved(node, found, source, atomically=True, by=by) for node, found in values.items()]
            return tuple(one for outcomes, _ in made for one in outcomes), tuple(
                one for _, some in made for one in some
            )
        self.take(bad.node, values[bad.node], source, atomically=True, by=by)
        reported = f"not set because {bad.node} refused {bad.name}: {bad.reason}"
        return tuple(
            replace(each, accepted=False, reason=reported, refused_by="console") if each.accepted else each
            for each in result
        ), ()

    def _result_of(self, node: str, name: str, value: Value) -> SetOutcome:
        tree = self.current.parameters.get(node)
        by, why = refusal(tree.get(name), value) if tree else ("node", f"no service {node}/set_parameters is offered")
        own = self.refusals.get((node, name), "")
        return SetOutcome(node, name, value, not (why or own), why or own, by or ("callback" if own else ""))

    def _value(self, node: str, name: str) -> Value:
        tree = self.current.parameters.get(node)
        known = tree.get(name) if tree else None
        return known.value if known else None

    def all_saved(self) -> None:
        self._steps.saved(())
        self.set_journal()

    @property
    def _end(self) -> int:
        """The number of the next change; changes of earlier runs have negative numbers."""
        return sum(each.seq >= 0 for each in self.journal)

    def set_journal(self) -> None:
        state = self._steps.state
        active = next((each for each in self.current.profiles if each.name == self.current.active_profile), None)
        self.change(
            journal=replace(state, first=0, end=self._end),
            profile_changes=len(differences(active, self.current.parameters)) if active else 0,
        )

    def undo(self) -> Future[Answer]:
        self.asked.append(("undo",))
        return self._move(ChangeSource.UNDO)

    def redo(self) -> Future[Answer]:
        self.asked.append(("redo",))
        return self._move(ChangeSource.REDO)

    def _move(self, source: ChangeSource) -> Future[Answer]:
        undone = source is ChangeSource.UNDO
        take = self._steps.take_undo if undone else self._steps.take_redo
        step = None if self.closed else take()
        while step is not None and not step.changes(source, self._value):
            step = take()
        if step is None:
            return done(Answer(False, CLOSED if self.closed else f"nothing to {source.value}"))
        overwritten = step.overwritten(self._value)
        refused: list[SetOutcome] = []
        left: list[Move] = []
        for move in step.moves:
            outcomes = self.take(move.node, move.values(source), source, atomically=True)
            bad = [each for each in outcomes if not each.accepted]
            refused += bad
            left += [move] if bad else []
        if left:
            self._steps.put_back(replace(step, moves=tuple(left)), source)
        elif step.profiles:
            self.change(active_profile=step.profiles[0 if undone else 1])
        if gone := tuple(each for each in step.moves if each not in left):
            self._steps.did(Step(gone, None if left else step.profiles), source)
        self.set_journal()
        moved = f"{source.value}: {step.text(source)}{overwritten}"
        return done(Answer(not left, "; ".join(each.reason for each in refused) or moved))

    def move(self, linear: float, angular: float, sideways: float = 0.0) -> None:
        self.asked.append(("drive", linear, angular, *([sideways] if sideways else [])))
        if not (math.isfinite(linear) and math.isfinite(angular)):
            raise ValueError("a velocity must be a finite number")
        if not (self.current.drive.stopped or self.closed):
            self.sent.append((linear, angular))

    def steer(self, hold: bool) -> None:
        self.asked.append(("steer", hold))

    def stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        self.asked.append(("all_stop", hold))
        if hold:
            self.topics.stop()
        if not self.closed:
            self.sent.append((0.0, 0.0))
            own = [each for each in self.current.drive.stops if each.here and not each.key.startswith(EARLY)]
            new = [RobotStop("ours", "this console", reason, here=True)] if hold and not own else []
            self.hold([each for each in self.current.drive.stops if hold or not each.here] + new)

    def hold_early(self, press: str) -> None:
        self.asked.append(("hold_early", press))
        self.hold([*self.current.drive.stops, RobotStop(EARLY + press, "this console", "ALL STOP", here=True)])

    def settle_early(self, press: str, *, keep: bool) -> None:
        self.asked.append(("settle_early", press, keep))
        stops = [each for each in self.current.drive.stops if keep or each.key != EARLY + press]
        self.hold([replace(each, key=press) if each.key == EARLY + press else each for each in stops])

    def release(self, others: Sequence[str]) -> None:
        self.asked.append(("release", *others))
        self.hold([each for each in self.current.drive.stops if not each.here and each.key not in others])

    def hold(self, stops: Sequence[RobotStop]) -> None:
        """Set the stops that the robot reports."""
        first = stops[0] if stops else RobotStop("")
        requested = any(each.here and not each.key.startswith(EARLY) for each in stops)
        before = self.current.drive.own_stops
        self.change(
            drive=replace(
                self.current.drive, stopped=bool(stops), stop_confirmed=bool(stops), stop_holder=first.holder,
                stop_reason=first.reason, lockable=True, stops=tuple(stops),
                stopped_here=any(each.here for each in stops),
                own_stops=(before or frozenset([f"stop {len(self.asked)}"])) if requested else frozenset(),
                press_waits=any(each.key.startswith(EARLY) for each in stops),
            )
        )  # fmt: skip

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        self.asked.append(("call", service))
        known = {each.name: each.types for each in self.current.graph.services}
        if self.closed or (known and type_name not in known.get(service, ())):
            return done(
                Answer(False, CLOSED if self.closed else f"no service {service} of type {type_name} is offered")
            )
        return done(Answer(True))

    def set_logger_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        known = {each.name for each in self.current.graph.services}
        if self.closed or (known and f"{node}/set_logger_levels" not in known):
            return done(Answer(False, CLOSED if self.closed else f"{node} offers no logger service"))
        self.levels[logger or node.strip("/").replace("/", ".")] = severity
        return done(Answer(True, f"{logger or node} logs {severity.name} and worse"))

    def logger_levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        known = {each.name for each in self.current.graph.services}
        if self.closed or (known and f"{node}/set_logger_levels" not in known):
            failed: Future[tuple[LoggerLevel, ...]] = Future()
            failed.set_exception(ValueError(CLOSED if self.closed else f"{node} offers no logger service"))
            return failed
        own = node.strip("/").replace("/", ".")
        found = {own: Severity.UNSET, **{each: level for each, level in self.levels.items() if each.startswith(own)}}
        return done(tuple(LoggerLevel(node, each, level) for each, level in found.items()))

    def profile_differences(self, name: str) -> Sequence[ProfileDifference]:
        scripted = self.differences.get(name)
        if scripted is not None:
            return scripted
        profile = next((each for each in self.current.profiles if each.name == name), None)
        return differences(profile, self.current.parameters) if profile else ()

    def apply_profile(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        self.asked.append(("apply", name, reset_world))
        profile = next((each for each in self.current.profiles if each.name == name), None)
        idle = profile and name not in self.differences and cannot_apply(profile, self.current.parameters)
        why = CLOSED if self.closed else profile.problem or idle if profile else f"there is no profile {name}"
        if why:
            failed: Future[tuple[SetOutcome, ...]] = Future()
            failed.set_exception(ValueError(why))
            return failed
        found = [each for each in self.profile_differences(name) if not each.unknown]
        outcomes = tuple(SetOutcome(e.node, e.name, e.then, not e.refusal, e.refusal) for e in found)
        moves: tuple[Move, ...] = ()
        if name not in self.differences:
            by_node: dict[str, dict[str, Value]] = {}
            for each in found:
                by_node.setdefault(each.node, {})[each.name] = each.then
            outcomes, moves = self._all_or_nothing(by_node, ChangeSource.PROFILE, name)
        before = self.current.active_profile
        if all(each.accepted for each in outcomes):
            self.change(active_profile=name)
        if moves:
            self._steps.did(Step(moves, (before, self.current.active_profile)), ChangeSource.PROFILE)
        self.set_journal()
        return done(outcomes)

    def save_parameters(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        self.asked.append(("save", path))
        if self.closed:
            return Answer(False, CLOSED)
        self._steps.saved(nodes)
        self.set_journal()
        place = self.folder / path if self.folder else Path(path)
        if not place.is_absolute():
            return Answer(True, f"saved to {path}")
        try:
            saved = save(place, self.current.parameters, tuple(nodes), only_changed=only_changed)
        except (OSError, ValueError) as error:
            return Answer(False, f"not saved: {error}")
        return Answer(True, saved.text(place))

    def close(self) -> None:
        self.asked.append(("close",))
        if not self.closed:
            self.sent.append((0.0, 0.0))
        self.closed = True
        self.gate.close(CLOSED)
