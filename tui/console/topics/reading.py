"""`Traffic` of a read-only console: everything is shown, nothing is sent."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from bot_console.tui.console.topics.idle_traffic import IdleTraffic
from bot_console.tui.console.traffic import LiveMessage, Measure, Payload, Slot, Traffic, Values


class ReadingTraffic(IdleTraffic):
    """Measures and listens; refuses to publish, call or send anything, with the reason."""

    def __init__(self, why: str, traffic: Traffic) -> None:
        super().__init__(why)
        self._traffic = traffic

    def measure(self, topics: Collection[str], requester: str = "") -> None:
        """Measure these topics."""
        self._traffic.measure(topics, requester)

    def measured(self) -> Mapping[str, Measure]:
        """Their measurements."""
        return self._traffic.measured()

    def listen(self, topic: str) -> None:
        """Keep the newest message of this topic."""
        self._traffic.listen(topic)

    def heard(self) -> LiveMessage:
        """The newest message."""
        return self._traffic.heard()

    def slots(self, payload: Payload, type_name: str, values: Values) -> Sequence[Slot]:
        """The form of a type: its line can be copied."""
        return self._traffic.slots(payload, type_name, values)

    def wrong(self, payload: Payload, type_name: str, path: str, text: str) -> str:
        """Why a text is not valid in a slot."""
        return self._traffic.wrong(payload, type_name, path, text)

    def line(self, payload: Payload, name: str, type_name: str, values: Values, rate: float = 0.0) -> str:
        """The `ros2` command that would send it."""
        return self._traffic.line(payload, name, type_name, values, rate)
