"""The parameter events expected after sets made here, so that each change is attributed to its source."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from bot_console.tui.console.model import ChangeSource, Value

EACH = 20
"""How many announcements of one parameter may be outstanding; a node that never announces leaves so many behind."""


@dataclass(frozen=True, slots=True)
class ParameterRequest:
    """A requested value: its source, and the operation it was part of."""

    node: str
    name: str
    value: Value
    source: ChangeSource
    by: str = ""


class Expected:
    """The requests that have not been announced yet."""

    def __init__(self) -> None:
        self._requests: dict[tuple[str, str], deque[ParameterRequest]] = {}

    def add(self, request: ParameterRequest) -> None:
        """Add a request."""
        self._requests.setdefault((request.node, request.name), deque(maxlen=EACH)).append(request)

    def announced(self, node: str, name: str, value: Value) -> ParameterRequest | None:
        """The request that an event answers; None if nobody here made one."""
        found = next((each for each in self._requests.get((node, name), ()) if each.value == value), None)
        if found:
            self.forget(found)
        return found

    def forget(self, request: ParameterRequest) -> None:
        """Remove a request that was refused or answered."""
        requests = self._requests.get((request.node, request.name))
        if requests and request in requests:
            requests.remove(request)
            if not requests:
                del self._requests[request.node, request.name]
