"""`FakeTopics`: scripted topics, services and actions with real forms and messages."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.topics import forms
from bot_console.tui.console.topics.message_tree import tree
from bot_console.tui.console.topics.port import (
    Goal,
    LiveMessage,
    Measure,
    Payload,
    Repeated,
    Reply,
    RequestedQos,
    Slot,
    Values,
)


class FakeTopics:
    """Keeps the requests that it received; the test sets measurements and messages."""

    def __init__(self, asked: list[tuple[Any, ...]]) -> None:
        self.asked = asked
        self.figures: dict[str, Measure] = {}
        self.values: dict[str, str] = {}
        """The newest values of topics, as they are shown."""
        self.messages: dict[str, tuple[Any, str]] = {}
        """The message that a topic delivers, and its type."""
        self.response: Reply = Reply(True, "", 0.0042)
        self.requesters: dict[str, tuple[str, ...]] = {}
        self.listening = ""
        self.qos: RequestedQos | None = None
        self.running: dict[str, Repeated] = {}
        self.sent_goals: dict[str, Goal] = {}
        self.remembered: dict[str, list[Values]] = {}
        self.problem = ""
        self._heard = LiveMessage()

    def measure(self, topics: Collection[str], requester: str = "") -> None:
        self.requesters[requester] = tuple(topics)

    @property
    def measuring(self) -> tuple[str, ...]:
        """The topics that are being measured for any requester."""
        return tuple(topic for topics in self.requesters.values() for topic in topics)

    def measured(self) -> Mapping[str, Measure]:
        return {topic: self.figures.get(topic, Measure()) for topic in self.measuring}

    def newest(self) -> Mapping[str, str]:
        return {topic: self.values[topic] for topic in self.measuring if topic in self.values}

    def expect(self, path: str) -> Answer:
        self.asked.append(("expect", path))
        return Answer(not self.problem, self.problem or "checking 1 topic")

    def listen(self, topic: str, qos: RequestedQos | None = None) -> None:
        self.listening, self.qos = topic, qos
        self._heard = LiveMessage(topic)
        if topic in self.messages:
            self.hear(*self.messages[topic])

    def hear(self, message: Any, type_name: str) -> None:
        """Deliver a message on the open topic."""
        self._heard = LiveMessage(
            self.listening, type_name, tree(message, type_name), self._heard.count + 1, 0.0, self.problem
        )

    def cannot_hear(self, problem: str) -> None:
        """Let the open topic have no messages, for the given reason."""
        self._heard = LiveMessage(self.listening, problem=problem)

    def heard(self) -> LiveMessage:
        return self._heard

    def slots(self, payload: Payload, type_name: str, values: Values) -> Sequence[Slot]:
        return forms.slots(payload, type_name, values)

    def wrong(self, payload: Payload, type_name: str, path: str, text: str) -> str:
        return forms.wrong(payload, type_name, path, text)

    def line(self, payload: Payload, name: str, type_name: str, values: Values, rate: float = 0.0) -> str:
        return f"ros2 {payload.value} {name} {dict(values)}"

    def earlier(self, name: str) -> Sequence[Values]:
        return tuple(self.remembered.get(name, ()))

    def _take(self, payload: Payload, name: str, type_name: str, values: Values) -> Answer:
        if self.problem:
            return Answer(False, self.problem)
        try:
            forms.filled(payload, type_name, values)
        except ValueError as error:
            return Answer(False, str(error))
        self.remembered.setdefault(name, []).append(dict(values))
        return Answer(True, f"sent to {name}")

    def publish(self, topic: str, type_name: str, values: Values, rate: float = 0.0) -> Answer:
        self.asked.append(("publish", topic, dict(values), rate))
        answer = self._take(Payload.MESSAGE, topic, type_name, values)
        if answer.ok and rate:
            self.running = {**self.running, topic: Repeated(type_name, rate)}
        return answer

    def repeated(self) -> Mapping[str, Repeated]:
        return self.running

    def stop(self, topic: str = "") -> None:
        self.running = {name: each for name, each in self.running.items() if topic and name != topic}

    def call(self, service: str, type_name: str, values: Values) -> Future[Reply]:
        self.asked.append(("call", service, dict(values)))
        answer = self._take(Payload.REQUEST, service, type_name, values)
        future: Future[Reply] = Future()
        future.set_result(self.response if answer.ok else Reply(False, answer.text))
        return future

    def send_goal(self, action: str, type_name: str, values: Values) -> Answer:
        self.asked.append(("goal", action, dict(values)))
        answer = self._take(Payload.GOAL, action, type_name, values)
        if answer.ok:
            self.sent_goals[action] = Goal(action, "executing")
        return answer

    def goals(self) -> Mapping[str, Goal]:
        return self.sent_goals

    def cancel(self, action: str) -> Answer:
        self.asked.append(("cancel", action))
        goal = self.sent_goals.get(action)
        if goal is None or not goal.active:
            return Answer(False, f"no goal of {action} that was sent from here is running")
        self.sent_goals[action] = replace(goal, status="canceled", active=False)
        return Answer(True, f"asked {action} to cancel")
