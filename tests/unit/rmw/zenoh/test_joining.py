"""The lock of a domain's folder: waited for while it passes from hand to hand, not behind one that hangs in it."""

from __future__ import annotations

import fcntl
import itertools
import os
import threading

from bot_console.runtime.rmw.zenoh.domain import joining
from bot_console.runtime.rmw.zenoh.domain.joining import folder_lock

PATIENCE = 20.0
"""Seconds after which a test gives up; nothing is measured by it."""


def test_one_that_hangs_with_the_lock_stops_nobody_from_joining(tmp_path, monkeypatch):
    monkeypatch.setattr(joining, "PATIENCE", 0.01)
    monkeypatch.setattr(joining, "LONGEST_HOLD", 0.05)
    monkeypatch.setattr(joining, "LONGEST_WAIT", 0.05)
    handle = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    joined = threading.Event()

    def join():
        with folder_lock(str(tmp_path)):
            joined.set()

    threading.Thread(target=join, daemon=True).start()
    assert joined.wait(PATIENCE)
    os.close(handle)


def test_a_long_queue_is_waited_for_while_each_holds_it_only_shortly(tmp_path, monkeypatch):
    now, tries, holders = [0.0], [], itertools.count(1)

    def taken(handle, patience):
        now[0] += 0.9 * joining.LONGEST_HOLD
        tries.append(patience)
        return len(tries) == 50

    monkeypatch.setattr(joining, "_taken", taken)
    monkeypatch.setattr(joining, "_holder", lambda handle: next(holders))
    monkeypatch.setattr(joining, "is_stopped", lambda pid: False)
    monkeypatch.setattr(joining.time, "monotonic", lambda: now[0])
    with folder_lock(str(tmp_path)):
        assert len(tries) == 50
    monkeypatch.setattr(joining, "_holder", lambda handle: 7)
    del tries[:]
    with folder_lock(str(tmp_path)):
        assert len(tries) <= 3
