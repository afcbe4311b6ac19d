"""Samples that a thread of its own takes: all of them, in their order, and never for long without a pause."""

from collections import deque

from bot_console.runtime.rmw.zenoh import apart
from bot_console.runtime.rmw.zenoh.apart import PAUSE, TURN, take_apart


class Over(Exception):
    """No sample comes any more."""


class Channel:
    """Holds samples, and is over when it has given them all."""

    def __init__(self, samples):
        self._samples = deque(samples)

    def recv(self):
        if not self._samples:
            raise Over
        return self._samples.popleft()

    def try_recv(self):
        return self._samples.popleft() if self._samples else None


class Clock:
    """Stands in for the module `time`; each look at it takes a thousandth of a second."""

    def __init__(self):
        self.now, self.pauses = 0.0, []

    def monotonic(self):
        self.now += 0.001
        return self.now

    def sleep(self, seconds):
        self.pauses.append((self.now, seconds))
        self.now += seconds


def test_all_come_in_their_order_and_the_thread_ends():
    taken = []
    take_apart(Channel(range(1000)), taken.append, Over).join()
    assert taken == list(range(1000))


def test_it_pauses_after_each_turn(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(apart, "time", clock)
    take_apart(Channel(range(30)), lambda sample: None, Over).join()
    begins = [0.0, *(moment + seconds for moment, seconds in clock.pauses)]
    assert len(clock.pauses) > 3
    assert {seconds for _, seconds in clock.pauses} == {PAUSE}
    for begin, (end, _) in zip(begins, clock.pauses, strict=False):
        assert end - begin <= TURN + 0.002, "it has taken samples for too long"
