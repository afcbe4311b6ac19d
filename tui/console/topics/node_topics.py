"""The port for topics, services and actions, served by the console's node."""

from __future__ import annotations

import importlib
import shlex
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import Future
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics.interfaces import interface
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
from bot_console.tui.console.topics.rate_checks import RateChecks
from bot_console.tui.files.folders import expanded_path

if TYPE_CHECKING:
    from bot_console.tui.console.calls import Calls
    from bot_console.tui.console.graph.type_discovery import TypeDiscovery, TypeSource
    from bot_console.tui.console.topics.goals import Goals
    from bot_console.tui.console.topics.listening import MessageListener
    from bot_console.tui.console.topics.meters import Meters
    from bot_console.tui.console.topics.publishing import MessagePublisher
    from rclpy.node import Node

ANSWER_TIMEOUT_S = 30.0
"""Seconds to wait for the response of a service called by a user."""
MAX_NAMED_TOPICS = 3
"""The number of topics that an answer lists by name."""
MAX_REMEMBERED = 50
"""The number of messages, requests and goals kept per name, so that they can be sent again."""


class NodeTopics:
    """Topics, services and actions. Methods may be called from any thread; the executor does the work."""

    _discovery: TypeDiscovery
    _meters: Meters
    _listening: MessageListener
    _publishing: MessagePublisher
    _goals: Goals
    _calls: Calls
    """These exist after `attach`."""

    def __init__(self, gate: Gate, graph: Callable[[], GraphInfo], types: TypeSource | None = None) -> None:
        """`types` builds types that this program lacks; without it, they stay unknown."""
        self._gate = gate
        self._graph = graph
        self._types = types
        self._attached = False
        self._requested: dict[str, frozenset[str]] = {}
        """The topics to measure, by requester."""
        self._earlier: dict[str, list[Values]] = {}
        self.rate_checks = RateChecks(self)

    def attach(self, node: Node, calls: Calls) -> None:
        """Create what watches and uses the topics, once the system has been reached."""
        from bot_console.tui.console.graph.type_discovery import TypeDiscovery
        from bot_console.tui.console.topics.goals import Goals
        from bot_console.tui.console.topics.listening import MessageListener
        from bot_console.tui.console.topics.meters import Meters
        from bot_console.tui.console.topics.publishing import MessagePublisher

        self._calls = calls
        self._clock = node.get_clock()
        self._discovery = TypeDiscovery(node, calls, self._types, self._follow_known)
        self._meters = Meters(node)
        self._listening = MessageListener(node, self._discovery.explain)
        self._publishing = MessagePublisher(node)
        self._goals = Goals(node)
        self._attached = True

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        if self._attached:
            self._discovery.follow(graph)
            self._meters.follow(graph)
            self._listening.follow(graph)

    def _follow_known(self) -> None:
        """Use a type that has just become available."""
        graph = self._graph()
        self._meters.follow(graph)
        self._listening.follow(graph)

    def close(self) -> None:
        """Stop publishing, and destroy all subscriptions and clients."""
        if self._attached:
            self._publishing.stop()
            self._goals.close()

    def measure(self, topics: Collection[str], requester: str = "") -> None:
        """Measure these topics for a requester, in addition to those that other requesters need."""
        self._requested[requester] = frozenset(topics)
        wanted = {topic for each in self._requested.values() for topic in each}
        self._gate.run_when_open(lambda: self._meters.measure(wanted, self._graph()))

    def measured(self) -> Mapping[str, Measure]:
        """The measurements of all requested topics."""
        return self._meters.measured() if self._attached else {}

    def newest(self) -> Mapping[str, str]:
        """The newest values of all requested topics."""
        return self._meters.newest() if self._attached else {}

    def expect(self, path: str) -> Answer:
        """Check topics against the rates and ages in a file."""
        from bot_console.tui.console.graph.expected import read_file

        place = expanded_path(path)
        if place.exists() and not place.is_file():
            return Answer(False, f"{path} cannot be used: it is not a regular file")  # a pipe would stop the console
        try:
            found = read_file(path).measured if path.strip() else {}
        except ValueError as error:
            return Answer(False, f"{path} cannot be used: {error}")
        if path.strip() and not found:
            return Answer(
                False, f"{path} expects no rate and no age; write for instance  topics: {{/scan: {{rate: 10}}}}"
            )
        self.rate_checks.expect(found)
        named = ", ".join(found) if len(found) <= MAX_NAMED_TOPICS else f"{len(found)} topics"
        return Answer(True, f"checking {named}" if found else "no file is checked any more")

    def listen(self, topic: str, qos: RequestedQos | None = None) -> None:
        """Keep the newest message of this topic."""
        self._gate.run_when_open(lambda: self._listening.listen(topic, self._graph(), qos or RequestedQos()))

    def heard(self) -> LiveMessage:
        """The newest message."""
        return self._listening.heard() if self._attached else LiveMessage(problem=self._gate.unreached)

    @property
    def _forms(self) -> Any:
        """The module for forms, imported on first use because it imports message types."""
        from bot_console.tui.console.topics import forms

        return forms

    def slots(self, payload: Payload, type_name: str, values: Values) -> Sequence[Slot]:
        """The form of a type."""
        if self._gate.unreached:
            raise ValueError(self._gate.unreached)
        try:
            return self._forms.slots(payload, type_name, values)
        except ValueError as error:
            raise ValueError(self._discovery.explain(type_name, str(error))) from None

    def wrong(self, payload: Payload, type_name: str, path: str, text: str) -> str:
        """Why a text is not valid in a slot; empty if it is."""
        return self._gate.unreached or self._forms.wrong(payload, type_name, path, text)

    def line(self, payload: Payload, name: str, type_name: str, values: Values, rate: float = 0.0) -> str:
        """The `ros2` command line that sends the same message, request or goal."""
        import yaml

        if self._gate.unreached:
            raise ValueError(self._gate.unreached)
        verbs = {Payload.MESSAGE: "topic pub", Payload.REQUEST: "service call", Payload.GOAL: "action send_goal"}
        how: list[str] = []
        if payload is Payload.MESSAGE:
            how = ["--rate", f"{rate:g}"] if rate else ["--once"]
        fields = self._forms.typed_fields(payload, type_name, values)
        text = yaml.safe_dump(_plain(fields), default_flow_style=True, width=10**9, sort_keys=False).strip()
        return shlex.join(["ros2", *verbs[payload].split(), *how, name, type_name, text])

    def earlier(self, name: str) -> Sequence[Values]:
        """The values sent from here to a topic, service or action."""
        return tuple(self._earlier.get(name, ()))

    def _remember(self, name: str, values: Values) -> None:
        known = self._earlier.setdefault(name, [])
        if dict(values) in known:
            known.remove(dict(values))
        known.append(dict(values))
        del known[:-MAX_REMEMBERED]

    def publish(self, topic: str, type_name: str, values: Values, rate: float = 0.0) -> Answer:
        """Publish a message once, or at a rate (Hz)."""
        from bot_console.tui.console.topics.publishing import MAX_RATE_HZ

        wrong = self._gate.refusal or self._field_errors(Payload.MESSAGE, type_name, values)
        wrong = wrong or ("" if 0 <= rate <= MAX_RATE_HZ else f"the rate must be between 0 and {MAX_RATE_HZ:g} Hz")
        if wrong:
            return Answer(False, wrong)
        self._remember(topic, values)
        self._gate.run_when_open(lambda: self._publishing.publish(topic, type_name, values, rate, self._graph()))
        heard = any(each.name == topic for node in self._graph().nodes for each in node.subscriptions)
        message = f"publishing to {topic} at {rate:g} Hz" if rate else f"published to {topic}"
        return Answer(True, message + ("" if heard else ", where nobody listens"))

    def _field_errors(self, payload: Payload, type_name: str, values: Values) -> str:
        try:
            self._forms.filled(payload, type_name, values)
        except ValueError as error:
            return str(error)
        return ""

    def repeated(self) -> Mapping[str, Repeated]:
        """The messages being published at a rate."""
        return self._publishing.repeated() if self._attached else {}

    def stop(self, topic: str = "") -> None:
        """Stop publishing at a rate."""
        if self._attached:
            self._gate.run_when_open(lambda: self._publishing.stop(topic))

    def call(self, service: str, type_name: str, values: Values) -> Future[Reply]:
        """Call a service."""
        if not (self._gate.refusal or self._field_errors(Payload.REQUEST, type_name, values)):
            self._remember(service, values)
        return self._gate.run(lambda: self._call(service, type_name, values), partial(Reply, False))

    async def _call(self, service: str, type_name: str, values: Values) -> Reply:
        from bot_console.tui.console.calls import NoAnswer
        from bot_console.tui.console.topics.message_tree import tree

        try:
            request, now = self._forms.filled(Payload.REQUEST, type_name, values)
            kind = interface(Payload.REQUEST, type_name)
            self._forms.stamp(request, now, lambda: self._clock.now().to_msg())
            began = time.monotonic()
            response = await self._calls.ask(kind, service, request, ANSWER_TIMEOUT_S)
        except (ValueError, NoAnswer) as error:
            return Reply(False, str(error))
        return Reply(True, "", time.monotonic() - began, tree(response, f"{type_name}_Response"))

    def call_service(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call a service of any type."""
        return self._gate.run(lambda: self.request(service, type_name, fields), partial(Answer, False))

    async def request(self, service: str, type_name: str, fields: Mapping[str, object]) -> Answer:
        """The coroutine behind `call_service`, for the console's executor."""
        from bot_console.tui.console.calls import NoAnswer
        from rcl_interfaces.msg import SetParametersResult
        from rosidl_runtime_py import set_message_fields

        package, _, rest = type_name.partition("/")
        try:
            kind = getattr(importlib.import_module(f"{package}.srv"), rest.rsplit("/", 1)[-1])
            request = kind.Request()
            set_message_fields(request, dict(fields))
            response = await self._calls.ask(kind, service, request)
        except (ImportError, AttributeError, TypeError, ValueError, OverflowError) as error:
            return Answer(False, f"{type_name} cannot be called like this: {error}")
        except NoAnswer as error:
            return Answer(False, str(error))
        result = getattr(response, "result", None)
        if isinstance(result, SetParametersResult):
            return Answer(result.successful, result.reason)
        message = getattr(response, "message", None)
        return Answer(bool(getattr(response, "success", True)), repr(response) if message is None else str(message))

    def send_goal(self, action: str, type_name: str, values: Values) -> Answer:
        """Send a goal."""
        wrong = self._gate.refusal or self._field_errors(Payload.GOAL, type_name, values)
        if wrong:
            return Answer(False, wrong)
        self._remember(action, values)
        self._gate.run_when_open(lambda: self._goals.send(action, type_name, values))
        return Answer(True, f"goal sent to {action}")

    def goals(self) -> Mapping[str, Goal]:
        """The last goal of each action."""
        return self._goals.goals() if self._attached else {}

    def cancel(self, action: str) -> Answer:
        """Ask the action to cancel its last goal."""
        why_not = self._gate.refusal or self._goals.why_not_cancel(action)
        if why_not:
            return Answer(False, why_not)
        self._gate.run_when_open(lambda: self._goals.cancel(action))
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
