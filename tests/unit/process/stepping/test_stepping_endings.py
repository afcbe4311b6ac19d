"""Stepped time: signals, the end of processes and of the run, and threads that block outside the clock."""

from __future__ import annotations

import threading
import time
from contextlib import suppress

from bot_console.runtime.process import NodeProcess, current, on_notice, stepped
from bot_console.runtime.process.node.thread_state import local
from ticking import ticker

SECOND = 10**9
LONG = 240.0


def test_signals_arrive_in_virtual_time(clock):
    order = []

    def target():
        try:
            time.sleep(1000)
        except KeyboardInterrupt:
            order.append(time.monotonic())
            raise

    process = NodeProcess("n", clock)
    process.start(target, stderr=order.append)
    clock.run_for(2.0)
    process.interrupt()
    assert process.wait(1.0) == -2
    assert order[0] == 2.0
    assert order[-1] == "KeyboardInterrupt\n"


def test_exception_raised_in_a_waiting_thread_ends_its_wait(clock):
    states = []

    def target():
        states.append(local.state)
        time.sleep(1000)

    process = NodeProcess("n", clock)
    process.start(target, stderr=len)
    clock.run_for(2.0)
    states[0].throw(KeyboardInterrupt)
    assert process.wait(1.0) == -2
    assert time.monotonic() == 2.0


def test_stop_escalates_in_virtual_time(clock):
    def target():
        current().on_interrupt(lambda signum: None)
        while True:
            with suppress(KeyboardInterrupt):
                time.sleep(1000)

    process = NodeProcess("n", clock)
    process.start(target)
    clock.run_for(0)
    assert process.stop(grace=5.0) == -9
    assert time.monotonic() == 10.0


def test_kill_unwinds_without_advancing_time(clock):
    unwound = []

    def target():
        try:
            time.sleep(1000)
        finally:
            unwound.append(time.monotonic())

    process = NodeProcess("n", clock)
    process.start(target)
    clock.run_for(1.0)
    process.kill()
    assert process.exit_code == -9
    clock.run_for(1.0)
    assert unwound == [1.0]


def test_closing_ends_running_processes():
    ended = threading.Event()

    def target():
        try:
            time.sleep(1000)
        finally:
            ended.set()

    with stepped() as clock:
        process = NodeProcess("n", clock)
        process.start(target)
        clock.run_for(1.0)
    assert ended.is_set()
    assert process.exit_code == -9


def test_thread_blocked_outside_the_clock_is_reported_and_others_continue():
    notices = []
    remove = on_notice(lambda process, text: notices.append((process.name, text)))
    lock = threading.Lock()
    lock.acquire()
    trace = []

    def blocker():
        lock.acquire()  # the stepped run cannot see this
        time.sleep(1.0)
        trace.append("blocker")

    line = blocker.__code__.co_firstlineno + 1
    with stepped(stall_s=0.02) as clock:
        stuck = NodeProcess("stuck", clock)
        stuck.start(blocker)
        NodeProcess("other", clock).start(ticker(trace, "other", 0.1, 3))
        clock.run_for(0.3)
        assert [name for _time, name in trace] == ["other"] * 3
        assert not clock.deterministic
        assert len(clock.stalls) == 1 and f"{__file__}:{line}, in blocker" in clock.stalls[0]
        lock.release()
    remove()
    assert notices[0][0] == "stuck" and f"{__file__}:{line}" in notices[0][1]


def test_detached_thread_takes_turns_again():
    release = threading.Lock()
    release.acquire()
    trace = []

    def blocker():
        release.acquire()
        time.sleep(1.0)
        trace.append(current().clock.steady_ns())

    with stepped(stall_s=0.02) as clock:
        stuck = NodeProcess("stuck", clock)
        stuck.start(blocker, stderr=lambda line: None)
        clock.run_for(0.3)
        release.release()
        while stuck.main_state.waits == 0:
            pass
        clock.run_for(2.0)
    assert trace == [1_300_000_000]
