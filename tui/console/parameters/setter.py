"""Sets parameters and reports every outcome: accepted, refused (by whom and why) or unanswered."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.model import RESTARTED, ChangeSource, SetOutcome, Value, same
from bot_console.tui.console.parameters.expected_events import ExpectedEvents, ParameterRequest
from bot_console.tui.console.parameters.journal import Journal, Move, Step
from bot_console.tui.console.parameters.mirror import ParameterMirror
from bot_console.tui.console.values import refusal, to_message
from rcl_interfaces.msg import Parameter
from rcl_interfaces.srv import SetParameters, SetParametersAtomically


class ParameterSetter:
    """Sets parameters on any node and writes the journal. Coroutines run in the console's executor."""

    def __init__(self, calls: Calls, mirror: ParameterMirror, journal: Journal) -> None:
        self._calls = calls
        self._mirror = mirror
        self._journal = journal
        self.profile = ""
        """The profile that was applied last and not undone."""
        self._expected = ExpectedEvents()

    def announced(self, node: str, name: str, old: Value, new: Value) -> ChangeSource:
        """Process a parameter event; returns its source: that of the request that caused it, or `OTHER`."""
        request = self._expected.announced(node, name, new)
        source = request.source if request else ChangeSource.OTHER
        if not same(old, new):
            self._journal.record(time.time_ns(), node, name, (old, new), source, by=request.by if request else "")
        return source

    def restarted(self, node: str, name: str, old: Value, new: Value) -> None:
        """Record that a node has come back with another value, which nobody has set."""
        self._journal.record(time.time_ns(), node, name, (old, new), ChangeSource.OTHER, by=RESTARTED)
        self._journal.restarted(node, name)

    async def set(
        self,
        node: str,
        values: Mapping[str, Value],
        source: ChangeSource,
        by: str = "",
        *,
        atomically: bool = False,
        continues: bool = False,
        moves: list[Move] | None = None,
    ) -> tuple[SetOutcome, ...]:
        """Set parameters of one node; never raises, because every failure becomes an outcome.

        Accepted values can be undone: as a separate step, together with the step that this one `continues` or, if
        `moves` is given, as part of a step that the caller adds.
        """
        requests = [ParameterRequest(node, name, value, source, by) for name, value in values.items()]
        before = {name: self._value(node, name) for name in values}
        try:
            messages = [self._message(each) for each in requests]
        except ValueError as error:
            return self._all_refused(requests, before, ("console", str(error)))
        for each in requests:
            self._expected.add(each)
        kind: Any = SetParametersAtomically if atomically else SetParameters
        service = f"{node}/set_parameters_atomically" if atomically else f"{node}/set_parameters"
        try:
            answer = await self._calls.ask(kind, service, kind.Request(parameters=messages)) if requests else None
        except NoAnswer as error:
            return self._all_refused(requests, before, ("node", str(error)))
        results = [answer.result] * len(requests) if atomically and answer else answer.results if answer else ()
        outcomes = tuple(
            self._outcome(request, before[request.name], result.successful, result.reason)
            for request, result in zip(requests, results, strict=False)
        )
        changed = (each for each in outcomes if each.accepted and not same(before[each.name], each.value))
        taken = {each.name: each.value for each in changed}
        move = Move(node, {name: before[name] for name in taken}, taken)
        if taken and moves is None:
            self._journal.did(Step((move,)), source, continues=continues)
        elif taken and moves is not None:
            moves.append(move)
        return outcomes

    async def apply(self, name: str, wanted: Mapping[str, Mapping[str, Value]]) -> tuple[SetOutcome, ...]:
        """Set a profile's values as `set_all` does; the profile becomes active if nothing was refused."""
        before = self.profile
        outcomes, moves = await self._all_or_nothing(wanted, ChangeSource.PROFILE, name)
        if all(each.accepted for each in outcomes):
            self.profile = name
        if moves:
            renamed = (before, self.profile) if self.profile != before else None
            self._journal.did(Step(moves, renamed), ChangeSource.PROFILE)
        return outcomes

    async def set_all(
        self, wanted: Mapping[str, Mapping[str, Value]], source: ChangeSource, by: str
    ) -> tuple[SetOutcome, ...]:
        """Set parameters of several nodes: all or none. A single undo reverts all of them."""
        outcomes, moves = await self._all_or_nothing(wanted, source, by)
        if moves:
            self._journal.did(Step(moves), source)
        return outcomes

    async def _all_or_nothing(
        self, wanted: Mapping[str, Mapping[str, Value]], source: ChangeSource, by: str
    ) -> tuple[tuple[SetOutcome, ...], tuple[Move, ...]]:
        """Set the parameters; returns the outcomes and what can be undone: all, or what a failed rollback left."""
        outcomes: list[SetOutcome] = []
        moves: list[Move] = []
        # ROS has no transactions over several nodes, so nodes that will probably refuse are asked first, before any
        # other has changed.
        for node in sorted(wanted, key=lambda each: not self._will_refuse(each, wanted[each])):
            found = await self.set(node, wanted[node], source, by, atomically=True, moves=moves)
            outcomes += found
            bad = next((each for each in found if not each.accepted), None)
            if bad:
                reported = f"not set because {bad.node} refused {bad.name}: {bad.reason}"
                stuck = await self._roll_back(moves, reported)
                return _failed_outcomes(wanted, outcomes, stuck, reported), tuple(
                    each for each in moves if each.node in stuck
                )
        return tuple(outcomes), tuple(moves)

    def _will_refuse(self, node: str, values: Mapping[str, Value]) -> bool:
        return any(refusal(self._mirror.get(node, name), value)[1] for name, value in values.items())

    async def _roll_back(self, moves: Sequence[Move], why: str) -> Mapping[str, str]:
        """Restore the old values; returns the reasons by the nodes that refused."""
        stuck: dict[str, str] = {}
        for move in reversed(moves):
            outcomes = await self.set(move.node, move.before, ChangeSource.ROLLBACK, why, atomically=True, moves=[])
            stuck.update({each.node: each.reason for each in outcomes if not each.accepted})
        return stuck

    def _outcome(self, request: ParameterRequest, old: Value, accepted: bool, reason: str) -> SetOutcome:
        if accepted:
            self._expected.accept(request)
            return SetOutcome(request.node, request.name, request.value, True)
        self._expected.forget(request)
        why = reason or "the node gave no reason"
        by = refusal(self._mirror.get(request.node, request.name), request.value)[0] or "callback"
        self._refused(request, old, why, by)
        return SetOutcome(request.node, request.name, request.value, False, why, by)

    def _all_refused(
        self, requests: Sequence[ParameterRequest], before: Mapping[str, Value], why: tuple[str, str]
    ) -> tuple[SetOutcome, ...]:
        for each in requests:
            self._refused(each, before[each.name], why[1], why[0])
        return tuple(SetOutcome(each.node, each.name, each.value, False, why[1], why[0]) for each in requests)

    def _refused(self, request: ParameterRequest, old: Value, why: str, by: str) -> None:
        of = request.node, request.name, (old, request.value), request.source
        self._journal.record(time.time_ns(), *of, why, request.by, answered=by != "node")

    def _value(self, node: str, name: str) -> Value:
        """The value of a parameter, even if the event of the last accepted request has not arrived yet."""
        accepted = self._expected.accepted(node, name)
        known = self._mirror.get(node, name)
        return accepted.value if accepted else known.value if known else None

    def _message(self, request: ParameterRequest) -> Parameter:
        known = self._mirror.get(request.node, request.name)
        return to_message(request.name, request.value, known.kind) if known else to_message(request.name, request.value)

    async def move(self, source: ChangeSource) -> Answer:
        """Undo the last accepted change of this console, or repeat the last undone one."""
        take = self._journal.take_undo if source is ChangeSource.UNDO else self._journal.take_redo
        while step := take():
            if step.changes(source, self._value):  # else others have already made that change
                overwritten = step.overwritten(self._value)
                answer = await self._move(step, source)
                return Answer(True, answer.text + overwritten) if answer.ok else answer
        return Answer(False, f"nothing to {source.value}")

    async def _move(self, step: Step, source: ChangeSource) -> Answer:
        """Undo or redo a step; the part that a node refuses stays on the list."""
        done: list[Move] = []
        left: list[Move] = []
        refused: list[SetOutcome] = []
        for move in step.moves:
            values = move.values(source)
            outcomes = await self.set(move.node, values, source, atomically=len(values) > 1, moves=[])
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
        return Answer(True, f"{source.value}: {step.text(source)}")


def _failed_outcomes(
    wanted: Mapping[str, Mapping[str, Value]], asked: Sequence[SetOutcome], stuck: Mapping[str, str], reported: str
) -> tuple[SetOutcome, ...]:
    """The outcomes if not everything was accepted: refusals, and accepted values that could not be reverted."""
    known = {(each.node, each.name): each for each in asked}
    outcomes: list[SetOutcome] = []
    for node, values in wanted.items():
        for name, value in values.items():
            outcome = known.get((node, name))
            if outcome is None or (outcome.accepted and node not in stuck):
                outcome = SetOutcome(node, name, value, False, reported, "console")
            elif outcome.accepted:
                outcome = replace(outcome, reason=f"could not be taken back: {stuck[node]}")
            outcomes.append(outcome)
    return tuple(outcomes)
