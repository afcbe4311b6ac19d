"""Stepped time with threads that block, compute or start slowly, in real threads."""

from __future__ import annotations

import subprocess
import sys
import threading
import time

import pytest
from bot_console.runtime.process import NodeProcess, current, stepped, unpatched
from bot_console.runtime.process.node.thread_state import local
from ticking import ticker

STALL = 0.02
BURN = "import time\nwhile time.process_time() < 0.3: pass"

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems report too little")


def test_long_computation_lets_no_other_thread_run():
    trace = []

    def compute():
        until = time.thread_time() + 5 * STALL
        while time.thread_time() < until:
            pass
        trace.append((current().clock.steady_ns(), "computed"))

    with stepped(stall_s=STALL) as clock:
        NodeProcess("computing", clock).start(compute)
        NodeProcess("other", clock).start(ticker(trace, "other", 0.1, 1))
        clock.run_for(1.0)
        assert clock.deterministic
    assert trace == [(0, "computed"), (100_000_000, "other")]


def test_endless_computation_is_reported(notices):
    trace, stop = [], []

    def compute():
        current().clock.wakeup().wait(0)
        while not stop:
            pass

    with stepped(stall_s=STALL) as clock:
        hog = NodeProcess("hog", clock)
        hog.start(compute)
        NodeProcess("other", clock).start(ticker(trace, "other", 0.1, 3))
        clock.run_for(0.3)
        stop.append(True)
        assert [name for _, name in trace] == ["other"] * 3
        assert not clock.deterministic
        assert f"{__file__}:" in clock.stalls[0] and ", in compute" in clock.stalls[0]
    assert "has computed for long without waiting" in notices[0]


def test_waiting_for_a_computing_child_process_lets_no_other_thread_run():
    with stepped(stall_s=STALL) as clock:
        process = NodeProcess("calling", clock)
        process.start(lambda: subprocess.run([sys.executable, "-S", "-c", BURN], check=True))
        assert process.wait(1.0) == 0
        assert clock.deterministic
        assert clock.steady_ns() == 0


def test_time_stops_until_a_slow_start_reaches_its_first_wait(notices):
    lock = threading.Lock()
    lock.acquire()
    trace = []

    def slow():
        lock.acquire()
        trace.append(("up", current().clock.steady_ns()))
        time.sleep(0.05)
        trace.append(("slept", current().clock.steady_ns()))

    with stepped(stall_s=STALL) as clock:
        NodeProcess("slow", clock).start(slow)
        NodeProcess("other", clock).start(lambda: trace.append(("other", current().clock.steady_ns())))
        unpatched.later(STALL, lambda: release_after(clock, lock))
        clock.run_for(1.0)
    assert trace == [("other", 0), ("up", 0), ("slept", 50_000_000)]
    assert "waits for something outside the stepped run" in notices[0]


def release_after(clock, lock):
    """Release the lock some time after the thread that waits for it was judged to be blocked."""
    unpatched.later(STALL, lock.release if clock.stalls else lambda: release_after(clock, lock))


def test_signal_arrives_at_the_next_wait_however_long_the_turn_takes():
    trace = []

    def compute():
        unpatched.later(0.0, process.interrupt)
        while not local.state.called:
            pass
        until = time.thread_time() + 0.3
        while time.thread_time() < until:
            pass
        trace.append("computed")
        time.sleep(1.0)
        trace.append("slept")

    with stepped() as clock:
        process = NodeProcess("computing", clock)
        process.start(compute, stderr=lambda line: None)
        assert process.wait(10.0) == -2
        assert clock.deterministic
    assert trace == ["computed"]
