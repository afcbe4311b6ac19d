"""Samples taken by a worker thread: all of them, in order, and never for long without a pause."""

import threading
from collections import deque

from bot_console.runtime.rmw.zenoh import channel_worker
from bot_console.runtime.rmw.zenoh.channel_worker import MAX_POLL_S, PAUSE_S, TURN_S, ChannelWorker, drain_in_worker


class ChannelClosed(Exception):
    """Raised once no more samples come."""


class Channel:
    """Holds samples, and raises after the last one."""

    def __init__(self, samples):
        self._samples = deque(samples)

    def try_recv(self):
        if not self._samples:
            raise ChannelClosed
        return self._samples.popleft()


class EmptyChannel:
    """Never has a sample."""

    def try_recv(self):
        return None


class Clock:
    """Replaces the module `time`; each reading of the clock takes a millisecond."""

    def __init__(self):
        self.now = 0.0

    def monotonic(self):
        self.now += 0.001
        return self.now


class FakeEvent:
    """Replaces a thread's stop event.

    It records when and how long the thread waited for it, and is set after a number of waits.
    """

    def __init__(self, clock, count=1000):
        self.clock, self.left, self.waits = clock, count, []

    def wait(self, seconds):
        self.waits.append((self.clock.now, seconds))
        self.clock.now += seconds
        self.left -= 1
        return self.left <= 0


def test_samples_arrive_in_order_and_the_thread_ends():
    taken = []
    drain_in_worker(Channel(range(1000)), taken.append, ChannelClosed).join()
    assert taken == list(range(1000))


def test_worker_pauses_after_each_turn(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(channel_worker, "time", clock)
    taking = ChannelWorker(Channel(range(30)), lambda sample: None, ChannelClosed)
    taking._over = waits = FakeEvent(clock)
    taking.run()
    begins = [moment + seconds for moment, seconds in waits.waits]
    assert len(waits.waits) > 3
    assert {seconds for _, seconds in waits.waits[1:]} == {PAUSE_S}
    for begin, (end, _) in zip(begins, waits.waits[1:], strict=False):
        assert end - begin <= TURN_S + 0.002, "it has taken samples for too long"


def test_idle_worker_polls_less_and_less_often(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(channel_worker, "time", clock)
    taking = ChannelWorker(EmptyChannel(), lambda sample: None, ChannelClosed)
    taking._over = waits = FakeEvent(clock, 30)
    taking.run()
    lengths = [seconds for _, seconds in waits.waits]
    assert lengths == sorted(lengths) and lengths[-1] == MAX_POLL_S


def test_worker_can_be_ended():
    taking = drain_in_worker(EmptyChannel(), lambda sample: None, ChannelClosed)
    taking.end()
    assert not taking.is_alive() and taking not in threading.enumerate()


def test_waiting_samples_can_be_taken_at_once():
    taken = []
    ChannelWorker(Channel(range(30)), taken.append, ChannelClosed).take_waiting()
    assert taken == list(range(30))
