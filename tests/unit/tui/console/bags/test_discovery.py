"""How long a player waits for subscriptions to its topics."""

from __future__ import annotations

import threading
from dataclasses import dataclass

import pytest
from bot_console.tui.console.bags.playing.discovery import MIN_S, TIMEOUT_S, await_subscriptions


class WaitRecorder(threading.Event):
    """Adds up the waiting times, and does not wait."""

    waited = 0.0

    def wait(self, timeout: float | None = None) -> bool:
        self.waited += timeout or 0.0
        return self.is_set()


@dataclass
class Publisher:
    """Is connected to one subscription after a time."""

    topic_name: str
    waits: WaitRecorder
    connected_s: float

    def get_subscription_count(self) -> int:
        return int(self.waits.waited >= self.connected_s)


@pytest.mark.parametrize(
    ("known", "connected_s", "waited"),
    [
        pytest.param(0, 0.0, MIN_S, id="nobody listens"),
        pytest.param(1, 0.0, MIN_S, id="a listener that is connected at once"),
        pytest.param(1, 1.2, 1.2, id="a listener that is connected late"),
        pytest.param(2, 0.0, TIMEOUT_S, id="a listener that is never connected"),
    ],
)
def test_player_waits_until_known_subscriptions_are_connected(known: int, connected_s: float, waited: float) -> None:
    waits = WaitRecorder()
    publishers = [Publisher("/quiet", waits, 0.0), Publisher("/heard", waits, connected_s)]
    await_subscriptions(publishers, lambda topic: known if topic == "/heard" else 0, waits)
    assert waits.waited == pytest.approx(waited, abs=0.1)


def test_player_that_is_stopped_waits_no_longer() -> None:
    waits = WaitRecorder()
    waits.set()
    await_subscriptions([Publisher("/heard", waits, 9.0)], lambda _: 1, waits)
    assert waits.waited < MIN_S
