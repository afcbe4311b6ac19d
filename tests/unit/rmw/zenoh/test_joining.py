"""The lock of a domain's folder: waited for while it passes from process to process, but not if its holder hangs."""

from __future__ import annotations

import fcntl
import itertools
import os
import threading
from collections.abc import Iterator

from bot_console.runtime.rmw.zenoh.domain import joining
from bot_console.runtime.rmw.zenoh.domain.joining import folder_lock

TIMEOUT_S = 240.0
"""Seconds until a test gives up; nothing is measured with it."""


def test_process_hanging_with_the_lock_stops_nobody_from_joining(tmp_path, monkeypatch):
    monkeypatch.setattr(joining, "LOCK_TIMEOUT_S", 0.01)
    monkeypatch.setattr(joining, "MAX_HOLD_S", 0.05)
    monkeypatch.setattr(joining, "MAX_WAIT_S", 0.05)
    handle = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    joined = threading.Event()

    def join():
        with folder_lock(str(tmp_path)):
            joined.set()

    threading.Thread(target=join, daemon=True).start()
    assert joined.wait(TIMEOUT_S)
    os.close(handle)


class Queue:
    """A lock acquired at a given try; `holders` has it at each poll and `used` is the processor time of the holder."""

    def __init__(self, monkeypatch, holders, seconds, got=50):
        self.tries, self.now = 0, 0.0
        self.used: Iterator[int] = itertools.repeat(0)

        def taken(handle, timeout_s):
            self.now += seconds
            self.tries += 1
            return self.tries == got

        monkeypatch.setattr(joining, "_acquire", taken)
        monkeypatch.setattr(joining, "_holder", lambda handle: next(holders))
        monkeypatch.setattr(joining, "_time_used", lambda pid: next(self.used))
        monkeypatch.setattr(joining, "is_stopped", lambda pid: pid == STOPPED)
        monkeypatch.setattr(joining.time, "monotonic", lambda: self.now)

    def waited_for(self, folder):
        """Return the number of tries until the wait ends."""
        with folder_lock(str(folder)):
            return self.tries


STOPPED = 99


def test_long_queue_is_waited_for_while_each_holds_the_lock_briefly(tmp_path, monkeypatch):
    queue = Queue(monkeypatch, itertools.count(1), 0.9 * joining.MAX_HOLD_S)
    assert queue.waited_for(tmp_path) == 50


def test_lock_found_free_in_a_poll_was_passed_on(tmp_path, monkeypatch):
    holders = itertools.chain.from_iterable((each, None) for each in range(1, 1000))
    assert Queue(monkeypatch, holders, 0.9 * joining.MAX_HOLD_S).waited_for(tmp_path) == 50


def test_holder_without_processor_time_is_considered_hanging(tmp_path, monkeypatch):
    queue = Queue(monkeypatch, itertools.repeat(7), 0.5)
    assert queue.waited_for(tmp_path) == 1 + joining.MAX_HOLD_S / 0.5


def test_slow_but_working_holder_is_waited_for_longer(tmp_path, monkeypatch):
    queue = Queue(monkeypatch, itertools.repeat(7), 0.5)
    queue.used = itertools.count()
    assert queue.waited_for(tmp_path) == 1 + joining.MAX_WAIT_S / 0.5


def test_wait_ends_even_if_no_holder_is_seen(tmp_path, monkeypatch):
    queue = Queue(monkeypatch, itertools.repeat(None), 0.5)
    assert queue.waited_for(tmp_path) == joining.MAX_WAIT_S / 0.5


def test_frozen_holder_is_not_waited_for(tmp_path, monkeypatch):
    assert Queue(monkeypatch, itertools.repeat(STOPPED), 0.1).waited_for(tmp_path) == 1


def test_processor_time_of_a_process_is_read():
    own = os.getpid()
    before = joining._time_used(own)
    while joining._time_used(own) == before:
        pass
    assert joining._time_used(None) == joining._time_used(-1) == 0
