"""Expects the parameter events of values that were set here, so that each change is attributed to its source."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from bot_console.tui.console.model import ChangeSource, Value

MAX_EVENTS_PER_PARAMETER = 20
"""How many outstanding requests are kept per parameter; a node that publishes no events leaves them behind."""


@dataclass(frozen=True, slots=True)
class ParameterRequest:
    """A requested value with its source and the operation that it is part of."""

    node: str
    name: str
    value: Value
    source: ChangeSource
    by: str = ""


class ExpectedEvents:
    """The requests whose events have not arrived yet."""

    def __init__(self) -> None:
        self._requests: dict[tuple[str, str], deque[ParameterRequest]] = {}
        self._accepted: dict[tuple[str, str], ParameterRequest] = {}

    def add(self, request: ParameterRequest) -> None:
        """Add a request when it is sent."""
        self._requests.setdefault((request.node, request.name), deque(maxlen=MAX_EVENTS_PER_PARAMETER)).append(request)

    def accept(self, request: ParameterRequest) -> None:
        """Record that a node has accepted a request, unless the event has arrived before the answer."""
        key = request.node, request.name
        if request in self._requests.get(key, ()):
            self._accepted[key] = request

    def accepted(self, node: str, name: str) -> ParameterRequest | None:
        """The last accepted request for a parameter, if its event has not arrived yet."""
        return self._accepted.get((node, name))

    def announced(self, node: str, name: str, value: Value) -> ParameterRequest | None:
        """The request that caused an event, which is then removed; None if the value was not set here."""
        found = next((each for each in self._requests.get((node, name), ()) if each.value == value), None)
        if found:
            self.forget(found)
        elif (node, name) in self._accepted:  # another program has set it since
            del self._accepted[node, name]
        return found

    def forget(self, request: ParameterRequest) -> None:
        """Remove a request that was refused, or whose event has arrived."""
        if self._accepted.get((request.node, request.name)) is request:
            del self._accepted[request.node, request.name]
        requests = self._requests.get((request.node, request.name))
        if requests and request in requests:
            requests.remove(request)
            if not requests:
                del self._requests[request.node, request.name]
