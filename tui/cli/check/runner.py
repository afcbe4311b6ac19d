"""Carries out the steps of a script one by one, and returns the outcome of each."""

from __future__ import annotations

import operator
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from typing import TypeVar

from bot_console.tui.cli.check.script import Step
from bot_console.tui.console.model import LogFilter, ParameterInfo, SetOutcome, parameter_in
from bot_console.tui.console.protocol import Console
from bot_console.tui.console.topics.port import Measure
from bot_console.tui.format import parse_value
from bot_console.tui.panes.alarms.alarm import Alarm, AlarmText
from bot_console.tui.text.value_text import value_text

T = TypeVar("T")
POLL_S = 0.05
"""Seconds between two checks."""
ANSWER_TIMEOUT_S = 10.0
"""Seconds that a node may take to answer."""
RATE_TIMEOUT_S = 3.0
"""Seconds, in addition to the measuring time, within which a rate has to be known."""
REQUESTER = "check"
SIGNS: Mapping[str, Callable[[float, float], bool]] = {
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq,
}  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """The outcome of a step and its duration in s; `why` says what failed, and is empty on success."""

    step: Step
    why: str
    seconds: float


class Runner:
    """Carries out steps on a system."""

    def __init__(
        self,
        console: Console,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._console = console
        self._clock = clock
        self._sleep = sleep

    def run(self, step: Step) -> Outcome:
        """Carry out one step."""
        began = self._clock()
        why = getattr(self, f"_{step.verb.replace('-', '_')}")(step)
        return Outcome(step, why, self._clock() - began)

    def _until(self, seconds: float, poll: Callable[[], str]) -> str:
        """Repeat a check until it passes, for at most `seconds`; returns the last failure, or an empty text."""
        deadline = self._clock() + seconds
        while (why := poll()) and self._clock() < deadline:
            self._sleep(POLL_S)
        return why

    def _answer(self, future: Future[T]) -> T | None:
        deadline = self._clock() + ANSWER_TIMEOUT_S
        while not future.done() and self._clock() < deadline:
            self._sleep(POLL_S)
        return future.result() if future.done() else None

    def _parameter(self, node: str, name: str) -> ParameterInfo | str:
        """A parameter, waiting for it briefly if necessary, or the reason why there is none."""

        def poll() -> str:
            tree = self._console.snapshot().parameters.get(node)
            if tree is None:
                return f"there is no node {node} with parameters"
            return "" if tree.get(name) else tree.problem or f"{node} has no parameter {name}"

        why = self._until(2.0, poll)
        found = None if why else self._console.snapshot().parameters[node].get(name)
        return found or why

    def _set_parameter(self, node: str, name: str, text: str) -> SetOutcome | str:
        """Set a parameter; returns the outcome, or the reason why the node could not be asked."""
        parameter = self._parameter(node, name)
        if isinstance(parameter, str):
            return parameter
        try:
            value = parse_value(text, parameter)
        except ValueError as error:
            return str(error)
        outcomes = self._answer(self._console.parameters.set(node, {name: value}))
        return outcomes[0] if outcomes else f"{node} does not answer"

    def _set(self, step: Step) -> str:
        outcome = self._set_parameter(*step.words)
        if isinstance(outcome, str):
            return outcome
        if outcome.accepted:
            return ""
        verdict = "not set" if outcome.refused_by == "node" else f"refused by the {outcome.refused_by}"
        return f"{verdict}: {outcome.reason}"

    def _expect_refused(self, step: Step) -> str:
        node, name, text, reason = step.words
        outcome = self._set_parameter(node, name, text)
        if isinstance(outcome, str):
            return outcome
        if outcome.accepted:
            return f"it was accepted: {name} is {value_text(outcome.value)} now"
        if outcome.refused_by in ("console", "node"):
            return f"it was neither accepted nor refused: {outcome.reason}"
        wanted = reason.lower() in outcome.reason.lower()
        return "" if wanted else f"it was refused for another reason: {outcome.reason}"

    def _expect(self, step: Step) -> str:
        if len(step.words) == 3:
            return self._expect_value(step)
        alarm = Alarm.of(AlarmText("", step.words[0]))
        try:
            return self._until(step.seconds, lambda: self._holds(alarm))
        finally:
            for path in alarm.paths:
                self._console.plots.unwatch(path, REQUESTER)

    def _holds(self, alarm: Alarm) -> str:
        for path in alarm.paths:
            answer = self._console.plots.watch(path, REQUESTER)
            if not answer.ok:
                return answer.text
        if alarm.poll(self._console.plots) or alarm.holds:
            return ""
        values = ", ".join(f"{path} = {alarm.values[path]:.6g}" for path in alarm.paths if path in alarm.values)
        return alarm.problem or values or f"nothing was received on {', '.join(alarm.paths)}"

    def _expect_value(self, step: Step) -> str:
        path, sign, text = step.words
        node, _, name = path.partition(":")
        parameter = self._parameter(node, name)
        if isinstance(parameter, str):
            return parameter
        try:
            wanted = parse_value(text.strip("\"'"), parameter)
        except ValueError as error:
            return str(error)

        def poll() -> str:
            now = parameter_in(self._console.snapshot().parameters, node, name)
            same = now is not None and now.value == wanted
            return "" if same is (sign == "==") else f"it is {value_text(now.value if now else None)}"

        return self._until(step.seconds, poll)

    def _assert_rate(self, step: Step) -> str:
        topic, sign, wanted = step.words
        traffic = self._console.topics
        traffic.measure([topic], REQUESTER)
        self._sleep(step.seconds)

        def poll() -> str:
            found = traffic.measured().get(topic, Measure())
            return found.problem or (f"nothing was received on {topic}" if found.rate is None else "")

        why = self._until(RATE_TIMEOUT_S, poll)
        rate = traffic.measured().get(topic, Measure()).rate
        traffic.measure([], REQUESTER)
        if why or rate is None:
            return why
        return "" if SIGNS[sign](rate, float(wanted)) else f"its rate is {rate:.4g} Hz"

    def _expect_node(self, step: Step) -> str:
        def poll() -> str:
            names = [each.name for each in self._console.snapshot().graph.nodes]
            shown = ", ".join(each for each in names if "/_" not in each)
            return "" if step.words[0] in names else f"there is none; nodes: {shown or 'none'}"

        return self._until(step.seconds, poll)

    def _expect_no_node(self, step: Step) -> str:
        def poll() -> str:
            there = any(each.name == step.words[0] for each in self._console.snapshot().graph.nodes)
            return "it exists" if there else ""

        return self._until(step.seconds, poll)

    def _expect_topic(self, step: Step) -> str:
        name, *types = step.words

        def poll() -> str:
            found = next((each for each in self._console.snapshot().graph.topics if each.name == name), None)
            if found is None:
                return "there is none"
            return "" if not types or types[0] in found.types else f"it is of type {', '.join(found.types)}"

        return self._until(step.seconds, poll)

    def _expect_log(self, step: Step) -> str:
        which = LogFilter(words=step.words[0])

        def poll() -> str:
            try:
                found = self._console.logs.matching(which, 0, 1)
            except ValueError as error:
                return str(error)
            return "" if found else "no line of the log matches"

        return self._until(step.seconds, poll)

    def _call(self, step: Step) -> str:
        answer = self._answer(self._console.topics.call_service(step.words[0], step.words[1], {}))
        if answer is None:
            return "no answer"
        return "" if answer.ok else answer.text or "it answered without success"

    def _wait(self, step: Step) -> str:
        self._sleep(step.seconds)
        return ""

    def _stop(self, step: Step) -> str:
        self._console.drive.stop(True, "a script")
        return self._until(
            step.seconds, lambda: "" if self._console.snapshot().drive.stop_confirmed else "it was not acknowledged"
        )
