"""Setting parameters, with every outcome: taken, refused by whom and why, or not answered."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import replace

from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.model import ChangeSource, SetOutcome, Value
from bot_console.tui.console.parameters.journal import Journal, Move, Step
from bot_console.tui.console.parameters.mirror import ParameterMirror
from bot_console.tui.console.protocol import Answer
from bot_console.tui.console.values import refusal, to_message
from rcl_interfaces.msg import Parameter, SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically

EXPECTED = 200
"""How many announcements of our own sets may be outstanding."""


class ParameterSetter:
    """Sets parameters on any node and writes the journal. Coroutines run in the console's executor."""

    def __init__(self, calls: Calls, mirror: ParameterMirror, journal: Journal) -> None:
        self._calls = calls
        self._mirror = mirror
        self._journal = journal
        self.profile = ""
        """The profile that was applied last and not undone."""
        self._expected: deque[tuple[str, str, Value, ChangeSource]] = deque(maxlen=EXPECTED)

    def announced(self, node: str, name: str, old: Value, new: Value) -> ChangeSource:
        """A parameter event came: ours when it was expected, else a change made elsewhere; who has made it."""
        source = ChangeSource.OTHER
        for each in self._expected:
            if each[:2] == (node, name) and each[2] == new:
                source = each[3]
                self._expected.remove(each)
                break
        if old != new or source is not ChangeSource.OTHER:
            self._journal.record(time.time_ns(), node, name, (old, new), source)
        return source

    async def set(
        self, node: str, values: Mapping[str, Value], source: ChangeSource, *, atomically: bool = False
    ) -> tuple[SetOutcome, ...]:
        """Ask a node to take values; never raises, every failure is an outcome. What is taken can be undone."""
        outcomes, move = await self._moved(node, values, source, atomically=atomically)
        if move.after:
            self._journal.did(Step((move,)), source)
        return outcomes

    async def apply(self, name: str, wanted: Mapping[str, Mapping[str, Value]]) -> tuple[SetOutcome, ...]:
        """Set a profile's values, by node, all or nothing for each; one undo takes all of them back.

        The profile is the active one when nothing was refused.
        """
        outcomes: list[SetOutcome] = []
        moves: list[Move] = []
        for node, values in wanted.items():
            found, move = await self._moved(node, values, ChangeSource.PROFILE, atomically=True)
            outcomes += found
            moves += [move] if move.after else []
        before = self.profile
        if all(each.accepted for each in outcomes):
            self.profile = name
        if moves:
            renamed = (before, self.profile) if self.profile != before else None
            self._journal.did(Step(tuple(moves), renamed), ChangeSource.PROFILE)
        return tuple(outcomes)

    async def _moved(
        self, node: str, values: Mapping[str, Value], source: ChangeSource, *, atomically: bool
    ) -> tuple[tuple[SetOutcome, ...], Move]:
        """What became of each value, and what of it can be taken back."""
        before = {name: self._value(node, name) for name in values}
        outcomes = await self._set(node, values, source, atomically=atomically)
        taken = {each.name: each.value for each in outcomes if each.accepted}
        return outcomes, Move(node, {name: before[name] for name in taken}, taken)

    async def _set(
        self, node: str, values: Mapping[str, Value], source: ChangeSource, *, atomically: bool
    ) -> tuple[SetOutcome, ...]:
        before = {name: self._value(node, name) for name in values}
        try:
            messages = [self._message(node, name, value) for name, value in values.items()]
        except ValueError as error:
            return self._all_refused(node, values, before, source, ("console", str(error)))
        expected = [(node, name, value, source) for name, value in values.items()]
        self._expected.extend(expected)
        try:
            results = await self._ask(node, messages, atomically)
        except NoAnswer as error:
            return self._all_refused(node, values, before, source, ("node", str(error)))
        outcomes: list[SetOutcome] = []
        for entry, result in zip(expected, results, strict=False):
            outcomes.append(self._outcome(entry, before[entry[1]], result.successful, result.reason))
        return tuple(outcomes)

    async def _ask(self, node: str, messages: Sequence[Parameter], atomically: bool) -> Sequence[SetParametersResult]:
        if atomically:
            request = SetParametersAtomically.Request(parameters=list(messages))
            answer = await self._calls.ask(SetParametersAtomically, f"{node}/set_parameters_atomically", request)
            return [answer.result] * len(messages)
        answer = await self._calls.ask(
            SetParameters, f"{node}/set_parameters", SetParameters.Request(parameters=list(messages))
        )
        return answer.results

    def _outcome(
        self, entry: tuple[str, str, Value, ChangeSource], old: Value, accepted: bool, reason: str
    ) -> SetOutcome:
        node, name, value, source = entry
        if accepted:
            return SetOutcome(node, name, value, True)
        if entry in self._expected:
            self._expected.remove(entry)
        why = reason or "the node gave no reason"
        by = refusal(self._mirror.get(node, name), value)[0] or "callback"
        self._journal.record(time.time_ns(), node, name, (old, value), source, why)
        return SetOutcome(node, name, value, False, why, by)

    def _all_refused(
        self,
        node: str,
        values: Mapping[str, Value],
        before: Mapping[str, Value],
        source: ChangeSource,
        why: tuple[str, str],
    ) -> tuple[SetOutcome, ...]:
        for name, value in values.items():
            self._journal.record(time.time_ns(), node, name, (before[name], value), source, why[1])
        return tuple(SetOutcome(node, name, value, False, why[1], why[0]) for name, value in values.items())

    def _value(self, node: str, name: str) -> Value:
        known = self._mirror.get(node, name)
        return known.value if known else None

    def _message(self, node: str, name: str, value: Value) -> Parameter:
        known = self._mirror.get(node, name)
        return to_message(name, value, known.kind) if known else to_message(name, value)

    async def undo(self) -> Answer:
        """Take the last accepted change of this console back."""
        step = self._journal.take_undo()
        return Answer(False, "nothing to undo") if step is None else await self._move(step, ChangeSource.UNDO)

    async def redo(self) -> Answer:
        """Make the last undone change again."""
        step = self._journal.take_redo()
        return Answer(False, "nothing to redo") if step is None else await self._move(step, ChangeSource.REDO)

    async def _move(self, step: Step, source: ChangeSource) -> Answer:
        """Take a step back, or make it again; what a node refuses stays to be tried again."""
        done: list[Move] = []
        left: list[Move] = []
        refused: list[SetOutcome] = []
        for move in step.moves:
            values = _values(move, source)
            outcomes = await self._set(move.node, values, source, atomically=len(values) > 1)
            bad = [each for each in outcomes if not each.accepted]
            (left if bad else done).append(move)
            refused += bad[:1]
        renamed = step.profiles
        if renamed and not left:
            self.profile = renamed[0 if source is ChangeSource.UNDO else 1]
        if left:
            self._journal.put_back(replace(step, moves=tuple(left)), source)
        if done:
            self._journal.did(Step(tuple(done), None if left else renamed), source)
        if refused:
            return Answer(False, "; ".join(f"{each.node} {each.name}: {each.reason}" for each in refused))
        return Answer(True, f"{source.value}: {_text(step, source)}")


def _values(move: Move, source: ChangeSource) -> Mapping[str, Value]:
    return move.before if source is ChangeSource.UNDO else move.after


def _text(step: Step, source: ChangeSource) -> str:
    """A step in words: its values, or, where it is one of several nodes, how many there are."""
    if len(step.moves) == 1:
        (move,) = step.moves
        return f"{move.node} " + ", ".join(f"{name} = {value}" for name, value in _values(move, source).items())
    count = sum(len(each.after) for each in step.moves)
    name = f"profile {step.profiles[1]}, " if step.profiles else ""
    return f"{name}{count} values of {len(step.moves)} nodes"
