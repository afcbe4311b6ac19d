"""`Traffic` over the console's node."""

from __future__ import annotations

import shlex
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import Future
from functools import partial
from typing import Any, cast

import yaml
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.graph.type_discovery import TypeDiscovery, TypeSource
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics import forms
from bot_console.tui.console.topics.goals import Goals
from bot_console.tui.console.topics.interfaces import interface
from bot_console.tui.console.topics.listening import Listening
from bot_console.tui.console.topics.message_tree import tree
from bot_console.tui.console.topics.meters import Meters
from bot_console.tui.console.topics.publishing import MAX_RATE_HZ, Publishing
from bot_console.tui.console.traffic import Goal, LiveMessage, Measure, Payload, Repeated, Reply, Slot, Values
from rclpy.node import Node

ANSWER_TIMEOUT_S = 30.0
"""Seconds to wait for the response of a service called by a user."""
REMEMBERED = 50
"""Messages, requests and goals kept per name, so that they can be sent again."""


class NodeTraffic:
    """Topics, services and actions; its methods may be called from any thread, the executor does the work."""

    def __init__(
        self, node: Node, calls: Calls, graph: Callable[[], GraphInfo], types: TypeSource | None = None
    ) -> None:
        """`types` builds types that this program does not have; without it they stay unknown."""
        self._calls = calls
        self._graph = graph
        self._reported = TypeDiscovery(node, calls, types, self._follow_known)
        self._clock = node.get_clock()
        self._meters = Meters(node)
        self._listening = Listening(node, self._reported.explain)
        self._publishing = Publishing(node)
        self._goals = Goals(node)
        self._asked: dict[str, frozenset[str]] = {}
        """The topics to measure, by requester."""
        self._earlier: dict[str, list[Values]] = {}

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        self._reported.follow(graph)
        self._meters.follow(graph)
        self._listening.follow(graph)

    def _follow_known(self) -> None:
        """Retry with a type that has become available."""
        graph = self._graph()
        self._meters.follow(graph)
        self._listening.follow(graph)

    def close(self) -> None:
        """Stop publishing, and destroy all subscriptions and clients."""
        self._publishing.stop()
        self._goals.close()

    def _later(self, work: Callable[[], Any]) -> Future[Any]:
        """Run something in the executor."""

        async def run() -> Any:
            return work()

        return self._calls.run(run(), partial(Answer, False))

    def measure(self, topics: Collection[str], requester: str = "") -> None:
        """Measure these topics, and those that other requesters need."""
        self._asked[requester] = frozenset(topics)
        wanted = {topic for each in self._asked.values() for topic in each}
        self._later(lambda: self._meters.measure(wanted, self._graph()))

    def measured(self) -> Mapping[str, Measure]:
        """Their measurements."""
        return self._meters.measured()

    def listen(self, topic: str) -> None:
        """Keep the newest message of this topic."""
        self._later(lambda: self._listening.listen(topic, self._graph()))

    def heard(self) -> LiveMessage:
        """The newest message."""
        return self._listening.heard()

    def slots(self, payload: Payload, type_name: str, values: Values) -> Sequence[Slot]:
        """The form of a type."""
        try:
            return forms.slots(payload, type_name, values)
        except ValueError as error:
            raise ValueError(self._reported.explain(type_name, str(error))) from None

    def wrong(self, payload: Payload, type_name: str, path: str, text: str) -> str:
        """Why a text is not valid in a slot."""
        return forms.wrong(payload, type_name, path, text)

    def line(self, payload: Payload, name: str, type_name: str, values: Values, rate: float = 0.0) -> str:
        """The `ros2` command line that sends the same."""
        verbs = {Payload.MESSAGE: "topic pub", Payload.REQUEST: "service call", Payload.GOAL: "action send_goal"}
        how: list[str] = []
        if payload is Payload.MESSAGE:
            how = ["--rate", f"{rate:g}"] if rate else ["--once"]
        fields = forms.typed_fields(payload, type_name, values)
        text = yaml.safe_dump(_plain(fields), default_flow_style=True, width=10**9, sort_keys=False).strip()
        return shlex.join(["ros2", *verbs[payload].split(), *how, name, type_name, text])

    def earlier(self, name: str) -> Sequence[Values]:
        """What was sent from here."""
        return tuple(self._earlier.get(name, ()))

    def _remember(self, name: str, values: Values) -> None:
        known = self._earlier.setdefault(name, [])
        if dict(values) in known:
            known.remove(dict(values))
        known.append(dict(values))
        del known[:-REMEMBERED]

    def publish(self, topic: str, type_name: str, values: Values, rate: float = 0.0) -> Answer:
        """Publish once, or at a rate."""
        wrong = self._all_wrong(Payload.MESSAGE, type_name, values)
        wrong = wrong or ("" if 0 <= rate <= MAX_RATE_HZ else f"the rate must be between 0 and {MAX_RATE_HZ:g} Hz")
        if wrong:
            return Answer(False, wrong)
        self._remember(topic, values)
        self._later(lambda: self._publishing.publish(topic, type_name, values, rate, self._graph()))
        heard = any(each.name == topic for node in self._graph().nodes for each in node.subscriptions)
        message = f"publishing to {topic} at {rate:g} Hz" if rate else f"published to {topic}"
        return Answer(True, message + ("" if heard else ", where nobody listens"))

    def _all_wrong(self, payload: Payload, type_name: str, values: Values) -> str:
        try:
            forms.filled(payload, type_name, values)
        except ValueError as error:
            return str(error)
        return ""

    def repeated(self) -> Mapping[str, Repeated]:
        """The messages being published at a rate."""
        return self._publishing.repeated()

    def stop(self, topic: str = "") -> None:
        """Stop publishing at a rate."""
        self._later(lambda: self._publishing.stop(topic))

    def call(self, service: str, type_name: str, values: Values) -> Future[Reply]:
        """Call a service."""
        if not self._all_wrong(Payload.REQUEST, type_name, values):
            self._remember(service, values)
        return self._calls.run(self._call(service, type_name, values), partial(Reply, False))

    async def _call(self, service: str, type_name: str, values: Values) -> Reply:
        try:
            request, now = forms.filled(Payload.REQUEST, type_name, values)
            kind = interface(Payload.REQUEST, type_name)
            forms.stamp(request, now, lambda: self._clock.now().to_msg())
            began = time.monotonic()
            response = await self._calls.ask(kind, service, request, ANSWER_TIMEOUT_S)
        except (ValueError, NoAnswer) as error:
            return Reply(False, str(error))
        return Reply(True, "", time.monotonic() - began, tree(response, f"{type_name}_Response"))

    def send_goal(self, action: str, type_name: str, values: Values) -> Answer:
        """Send a goal."""
        wrong = self._all_wrong(Payload.GOAL, type_name, values)
        if wrong:
            return Answer(False, wrong)
        self._remember(action, values)
        self._later(lambda: self._goals.send(action, type_name, values))
        return Answer(True, f"goal sent to {action}")

    def goals(self) -> Mapping[str, Goal]:
        """The last goal of each action."""
        return self._goals.goals()

    def cancel(self, action: str) -> Answer:
        """Ask the action to cancel its last goal."""
        why_not = self._goals.why_not_cancel(action)
        if why_not:
            return Answer(False, why_not)
        self._later(lambda: self._goals.cancel(action))
        return Answer(True, f"asked {action} to cancel")


def _plain(value: Any) -> Any:
    """Nested fields as plain dictionaries, lists and numbers, suitable for YAML."""
    if isinstance(value, Mapping):
        fields = cast("Mapping[str, Any]", value)
        return {key: _plain(each) for key, each in fields.items()}
    if isinstance(value, bytes):
        return value[0] if len(value) == 1 else list(value)
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in cast("Sequence[Any]", value)]
    return value
