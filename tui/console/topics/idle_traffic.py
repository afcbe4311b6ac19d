"""`Traffic` while there is no ROS system: nothing is known, and everything is refused with the reason."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.traffic import Goal, LiveMessage, Measure, Payload, Repeated, Reply, Slot, Values


class IdleTraffic:
    """Refuses everything with the reason."""

    def __init__(self, why: str) -> None:
        self._why = why

    def measure(self, topics: Collection[str], requester: str = "") -> None:
        """Do nothing."""

    def measured(self) -> Mapping[str, Measure]:
        """No measurements."""
        return {}

    def listen(self, topic: str) -> None:
        """Do nothing."""

    def heard(self) -> LiveMessage:
        """No message, with the reason."""
        return LiveMessage(problem=self._why)

    def slots(self, payload: Payload, type_name: str, values: Values) -> Sequence[Slot]:
        """No fields."""
        raise ValueError(self._why)

    def wrong(self, payload: Payload, type_name: str, path: str, text: str) -> str:
        """The reason: no text is valid."""
        return self._why

    def line(self, payload: Payload, name: str, type_name: str, values: Values, rate: float = 0.0) -> str:
        """An empty line."""
        raise ValueError(self._why)

    def earlier(self, name: str) -> Sequence[Values]:
        """Empty: nothing was sent."""
        return ()

    def publish(self, topic: str, type_name: str, values: Values, rate: float = 0.0) -> Answer:
        """Refused."""
        return Answer(False, self._why)

    def repeated(self) -> Mapping[str, Repeated]:
        """Empty: nothing is published."""
        return {}

    def stop(self, topic: str = "") -> None:
        """Do nothing: nothing is published."""

    def call(self, service: str, type_name: str, values: Values) -> Future[Reply]:
        """Refused."""
        refused: Future[Reply] = Future()
        refused.set_result(Reply(False, self._why))
        return refused

    def send_goal(self, action: str, type_name: str, values: Values) -> Answer:
        """Refused."""
        return Answer(False, self._why)

    def goals(self) -> Mapping[str, Goal]:
        """Empty: no goal was sent."""
        return {}

    def cancel(self, action: str) -> Answer:
        """Refused."""
        return Answer(False, self._why)
